// Numbers for people: few digits, no needless zeros, one minus sign.

/** A number with `digits` significant digits; an em dash for what is not a number. */
export function formatNumber(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) {
    return "—";
  }
  if (value === 0) {
    return "0";
  }
  const magnitude = Math.abs(value);
  if (magnitude < 1e-4 || magnitude >= 1e6) {
    return value.toExponential(digits - 1).replace("e+", "e").replaceAll("-", "−");
  }
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(magnitude)));
  return value.toFixed(Math.min(decimals, 8)).replace("-", "−");
}

/** A printed number as it was printed: no digits beyond its own, no exponent for a small one. */
export function formatPrinted(value) {
  return value.toFixed(8).replace(/\.?0+$/u, "");
}

/** A number as one types it: exactly, in the shortest form. */
export function formatExact(value) {
  return String(value);
}

/** What was typed, as a number where it is one; else as typed, so that the core can say what is wrong with it. */
export function parseTyped(text) {
  const trimmed = text.trim();
  const number = Number(trimmed.replace(/^([^.,]*),([^.,]*)$/u, "$1.$2").replace("−", "-"));
  return trimmed === "" || !Number.isFinite(number) ? trimmed : number;
}

/** A time in seconds, for sentences. */
export function formatSeconds(seconds) {
  return `${Number(seconds.toPrecision(3))} s`;
}
