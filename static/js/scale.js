// Where a slider stands for a value: whole positions from -100 to 100 over a decade each way, or evenly over a range.

/** Positions of a slider: from `-REACH` or 0 to `REACH`. */
export const REACH = 100;

/** Logarithmic around `center`: a tenth of it to ten times it. Position 0 is the centre to the bit. */
export function logarithmic(center, min, max) {
  const low = Math.max(center / 10, min);
  const high = Math.min(center * 10, max);
  const position = (value) => REACH * Math.log10(value / center);
  return {
    min: Math.ceil(position(low)),
    max: Math.floor(position(high)),
    position: (value) => (value > 0 ? Math.round(position(Math.min(Math.max(value, low), high))) : -REACH),
    value: (at) => (at === 0 ? center : rounded(center * 10 ** (at / REACH))),
  };
}

/** Even from `low` to `high`; for values without a decade around them. */
export function linear(low, high, steps = REACH) {
  const span = high - low;
  return {
    min: 0,
    max: steps,
    position: (value) => Math.round(((Math.min(Math.max(value, low), high) - low) / span) * steps),
    value: (at) => rounded(low + (span * at) / steps),
  };
}

/** Four digits are as fine as a slider can be meant. */
function rounded(value) {
  return Number(value.toPrecision(4));
}
