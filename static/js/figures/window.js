// Moves in the stretch of time that the figures share: zoom about an instant, pan, follow the cursor.

/** A few samples of a default run: closer in there is nothing more to see. */
const LEAST_S = 0.02;

/** Shows `from` to `to`, moved where it would leave the run, but no less than a few samples. */
export function zoomTo(timeline, from, to) {
  const span = Math.max(to - from, LEAST_S);
  panTo(timeline, (from + to - span) / 2, span);
}

/** Shows a stretch `factor` times as long; `time` stays where it is on the screen. */
export function zoomAbout(timeline, time, factor) {
  const [from, to] = timeline.window;
  const scale = Math.max(factor, LEAST_S / (to - from));
  const about = Math.min(Math.max(time, from), to);
  zoomTo(timeline, about - (about - from) * scale, about + (to - about) * scale);
}

/** Moves a stretch to start at `from`, as far as there is something. */
export function panTo(timeline, from, span) {
  const low = Math.min(Math.max(from, 0), Math.max(0, timeline.duration - span));
  timeline.zoom(low, low + span);
}

/** Moves the stretch by as little as it takes to contain an instant. */
export function follow(timeline, time) {
  const [from, to] = timeline.window;
  if (timeline.isZoomed && (time < from || time > to)) {
    panTo(timeline, time < from ? time : from + time - to, to - from);
  }
}
