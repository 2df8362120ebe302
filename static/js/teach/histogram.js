// How points are spread over a class: ten bars, and the same numbers as a table for those who do not see them.

import { element } from "../dom.js";
import { texts } from "../strings/classroom.js";

const SVG = "http://www.w3.org/2000/svg";
const own = texts.board;
const SIZE = { width: 400, height: 150, left: 24, bottom: 24, top: 18 };
const GAP = 4;

/** The figure of ten counts. */
export function histogram(counts) {
  const { width, height, left, bottom, top } = SIZE;
  const most = Math.max(1, ...counts);
  const wide = (width - left) / counts.length;
  const high = height - bottom - top;
  const picture = drawn("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": own.histogramAlt(counts), class: "histogram" });
  picture.append(drawn("line", { class: "axis", x1: left, x2: width, y1: height - bottom, y2: height - bottom }));
  counts.forEach((count, n) => {
    const x = left + n * wide;
    const tall = (count / most) * high;
    const middle = x + wide / 2;
    picture.append(
      drawn("rect", { class: "bar", x: x + GAP / 2, y: height - bottom - tall, width: wide - GAP, height: tall }),
      label(middle, height - bottom - tall - 4, count > 0 ? String(count) : ""),
      label(middle, height - 8, `${n * 10}`),
    );
  });
  return element("figure", { class: "histogram-box" }, element("figcaption", {}, own.histogram), picture);
}

function label(x, y, text) {
  const node = drawn("text", { x, y, "text-anchor": "middle" });
  node.textContent = text;
  return node;
}

function drawn(tag, attributes) {
  const node = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) {
    node.setAttribute(name, value);
  }
  return node;
}
