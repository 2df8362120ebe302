// Where a figure's panels are on its canvas: pixels to times and values, and back. All pixels are the device's.

const NUMBERS = 8;
/** How far from a panel a pointer still means it, in panel heights. */
const REACH = 0.35;

/** Decades on a symmetric-logarithmic axis, as `draw_figure` documents it. */
const DECADES = 3;

/** Panels from what `draw_figure` returns, eight numbers each; `symlog` says what the vertical axes are. */
export function readPanels(numbers, symlog) {
  const panels = [];
  for (let n = 0; n + NUMBERS <= (numbers?.length ?? 0); n += NUMBERS) {
    const [left, top, right, bottom, atLeft, atRight, atBottom, atTop] = numbers.subarray(n, n + NUMBERS);
    const map = symlog ? symmetric(atBottom, atTop) : (y) => y;
    panels.push({ left, top, right, bottom, atLeft, atRight, atBottom, atTop, map });
  }
  return panels;
}

/** The panel that a point is in or next to, or null. */
export function panelAt(panels, x, y) {
  let best = null;
  let least = Infinity;
  for (const panel of panels) {
    const distance = Math.max(panel.top - y, y - panel.bottom, 0);
    const within = x >= panel.left && x <= panel.right && distance <= REACH * (panel.bottom - panel.top);
    if (within && distance < least) {
      [best, least] = [panel, distance];
    }
  }
  return best;
}

/** What the horizontal axis says at a pixel, kept inside the panel. */
export function abscissaAt(panel, x) {
  const share = (x - panel.left) / (panel.right - panel.left);
  return panel.atLeft + Math.min(Math.max(share, 0), 1) * (panel.atRight - panel.atLeft);
}

/** The pixel of a value on the horizontal axis; null outside. */
export function pixelOfAbscissa(panel, value) {
  const share = (value - panel.atLeft) / (panel.atRight - panel.atLeft);
  return share >= 0 && share <= 1 ? panel.left + share * (panel.right - panel.left) : null;
}

/** The pixel of a value on the vertical axis; null outside. */
export function pixelOfOrdinate({ top, bottom, atBottom, atTop, map }, value) {
  const share = (map(value) - map(atBottom)) / (map(atTop) - map(atBottom));
  return share >= 0 && share <= 1 ? bottom - share * (bottom - top) : null;
}

/** Linear within c of zero, decades beyond; c is three decades below the power of ten at or above the larger end. */
function symmetric(low, high) {
  const c = 10 ** (Math.ceil(Math.log10(Math.max(Math.abs(low), Math.abs(high)))) - DECADES);
  return (y) => Math.asinh(y / (2 * c));
}
