// What keys on a focused figure do: arrows move the cursor, + and - zoom about it, 0 shows everything.

import { follow, zoomAbout } from "./window.js";

/** Part of what is shown that an arrow moves; ten times as far with Shift. */
const STEP = 0.01;
const FACTOR = 1.5;

/** Reacts to keys on a card's layer; `moved` is called when the cursor was moved. */
export function bindKeys(card, timeline, moved) {
  const by = (steps) => {
    const [from, to] = timeline.window;
    return timeline.position + steps * STEP * (to - from);
  };
  const seek = (time) => {
    timeline.pause();
    // A mouse that happens to rest on a figure must not hold the cursor.
    timeline.hover(null);
    timeline.seek(time);
    follow(timeline, timeline.position);
    moved();
  };
  const zoom = (factor) => zoomAbout(timeline, timeline.position, factor);
  const actions = {
    ArrowLeft: ({ shiftKey }) => seek(by(shiftKey ? -10 : -1)),
    ArrowRight: ({ shiftKey }) => seek(by(shiftKey ? 10 : 1)),
    Home: () => seek(timeline.window[0]),
    End: () => seek(timeline.window[1]),
    "+": () => zoom(1 / FACTOR),
    "=": () => zoom(1 / FACTOR),
    "-": () => zoom(FACTOR),
    "−": () => zoom(FACTOR),
    0: () => timeline.zoom(null),
  };
  card.overlay.addEventListener("keydown", (event) => {
    // Ctrl and + is the browser's zoom, Alt and an arrow its history.
    if (event.key in actions && !event.ctrlKey && !event.metaKey && !event.altKey) {
      event.preventDefault();
      actions[event.key](event);
    }
  });
}
