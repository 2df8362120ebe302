// The arm without WebGL: seen from the side and from above, drawn as lines on a plain canvas from the core's points.

import { strings } from "../strings/index.js";

/** What must be in view, m: ahead and up from the side, ahead and across from above. */
const SIDE = { low: [-0.2, 0], high: [0.6, 0.9] };
const TOP = { low: [-0.2, -0.3], high: [0.6, 0.3] };
const PATH_POINTS = 400;
const GRID = 0.1;
/** Room for the labels, layout pixels. */
const HEAD = 48;
const FONT = "12px system-ui, sans-serif";

/** Draws what `ArmView.draw` draws, as far as lines can. */
export function drawFlat(bindings, runs, canvas, view) {
  const context = canvas.getContext("2d");
  context.setTransform(view.scale, 0, 0, view.scale, 0, 0);
  context.clearRect(0, 0, canvas.width, canvas.height);
  const [width, height] = [canvas.width / view.scale / Math.max(view.arms.length, 1), canvas.height / view.scale];
  const style = getComputedStyle(canvas);
  const color = (name) => style.getPropertyValue(name).trim();
  view.arms.forEach((id, column) => {
    const pose = bindings.arm_pose(runs, id, view.time_s, view.exaggeration);
    const paths = bindings.arm_paths(runs, id, PATH_POINTS, view.exaggeration);
    const left = column * width;
    const room = height - HEAD;
    const wide = width > height;
    const boxes = wide
      ? [{ x: left, y: HEAD, width: width / 2, height: room }, { x: left + width / 2, y: HEAD, width: width / 2, height: room }]
      : [{ x: left, y: HEAD, width, height: 0.6 * room }, { x: left, y: HEAD + 0.6 * room, width, height: 0.4 * room }];
    const colors = { arm: color(`--scheme-${id}`), ink: color("--ink"), muted: color("--muted"), line: color("--line") };
    drawProjection(context, boxes[0], SIDE, strings.stage.side, ([x, , z]) => [x, z], pose, paths, colors, view);
    drawProjection(context, boxes[1], TOP, strings.stage.top, ([x, y]) => [x, y], pose, paths, colors, view);
  });
}

function drawProjection(context, box, { low, high }, title, project, pose, paths, colors, { time_s }) {
  const margin = 6;
  const scale = Math.min((box.width - 2 * margin) / (high[0] - low[0]), (box.height - 2 * margin) / (high[1] - low[1]));
  const middle = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
  const place = (point) => {
    const [across, up] = project(point);
    return [box.x + box.width / 2 + (across - middle[0]) * scale, box.y + box.height / 2 - (up - middle[1]) * scale];
  };
  const line = (points, width, color, alpha) => {
    context.beginPath();
    for (const point of points) {
      context.lineTo(...point);
    }
    Object.assign(context, { lineWidth: width, strokeStyle: color, globalAlpha: alpha, lineCap: "round", lineJoin: "round" });
    context.stroke();
  };
  context.save();
  context.beginPath();
  context.rect(box.x, box.y, box.width, box.height);
  context.clip();
  drawGrid(line, box, scale, middle, colors.line);
  if (paths) {
    const [behind, ahead, desired] = [[], [], []];
    for (let at = 0; at < paths.length; at += 7) {
      (paths[at] <= time_s ? behind : ahead).push(place(paths.subarray(at + 1, at + 4)));
      desired.push(place(paths.subarray(at + 4, at + 7)));
    }
    line(desired, 1, colors.ink, 0.7);
    line(ahead, 2, colors.arm, 0.3);
    line(behind, 2, colors.arm, 1);
  }
  if (pose) {
    const points = (from) => [0, 1, 2, 3, 4].map((n) => place(pose.subarray(from + 3 * n, from + 3 * n + 3)));
    line(points(15), 14, colors.ink, 0.22);
    line(points(0), 8, colors.arm, 0.85);
    context.globalAlpha = 1;
    context.fillStyle = colors.ink;
    for (const [x, y] of points(0).slice(1)) {
      context.beginPath();
      context.arc(x, y, 4, 0, 2 * Math.PI);
      context.fill();
    }
  }
  Object.assign(context, { globalAlpha: 1, fillStyle: colors.muted, font: FONT, textAlign: "right", textBaseline: "bottom" });
  context.fillText(title, box.x + box.width - margin, box.y + box.height - margin);
  context.restore();
}

function drawGrid(line, box, scale, middle, color) {
  const reach = [box.width / 2 / scale, box.height / 2 / scale];
  for (const axis of [0, 1]) {
    for (let at = Math.ceil((middle[axis] - reach[axis]) / GRID) * GRID; at < middle[axis] + reach[axis]; at += GRID) {
      const [x, y] = [box.x + box.width / 2 + (at - middle[0]) * scale, box.y + box.height / 2 - (at - middle[1]) * scale];
      const ends = axis === 0 ? [[x, box.y], [x, box.y + box.height]] : [[box.x, y], [box.x + box.width, y]];
      line(ends, Math.abs(at) < GRID / 2 ? 2 : 1, color, 1);
    }
  }
}
