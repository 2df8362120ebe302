// When results are shown: all of a change at once when the last is there, or those there are when it lets wait. To draw each
// as it comes would only keep the processor from the runs that are still under way. While a finger moves, the last of a
// change never comes; then the results of several changes are shown together, once there is one of each scheme that runs.

/** What lets wait this long counts as late: results are shown without the others, and the page says that it computes. */
export const LATE_AFTER_MS = 100;

/** Calls `show(isComplete)` when results of a laboratory are to be shown. */
export function gather(laboratory, show) {
  const unshown = new Set();
  let late = null;
  let shownAt = 0;
  const showAll = () => {
    clearTimeout(late);
    late = null;
    shownAt = performance.now();
    unshown.clear();
    show(laboratory.isReady);
  };
  laboratory.addEventListener("result", ({ detail: { scheme } }) => {
    unshown.add(scheme);
    if (laboratory.pending.every((other) => unshown.has(other))) {
      showAll();
    } else {
      // From the first of them on: a newer change must not put it off again.
      const waited = performance.now() - Math.max(laboratory.askedAt, shownAt);
      late ??= setTimeout(showAll, Math.max(0, LATE_AFTER_MS - waited));
    }
  });
}
