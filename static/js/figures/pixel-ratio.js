// Tells when a layout pixel becomes another number of device pixels: the page was zoomed or moved to another screen.

const listeners = [];
let last = devicePixelRatio;

/** Calls `listener` after each change. */
export function onPixelRatio(listener) {
  listeners.push(listener);
}

function check() {
  if (devicePixelRatio !== last) {
    last = devicePixelRatio;
    watch();
    for (const listener of listeners) {
      listener();
    }
  }
}

/** The query speaks once: of leaving this ratio. Zooming resizes the window, too, and some browsers say only that. */
function watch() {
  matchMedia(`(resolution: ${devicePixelRatio}dppx)`).addEventListener("change", check, { once: true });
}

watch();
addEventListener("resize", check);
