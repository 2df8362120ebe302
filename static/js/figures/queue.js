// When cards are drawn: those in view that are stale, the one being used first, in slices short enough to stay responsive.
//
// Asked often, it draws once a frame. Told to hurry (the last result of a change has arrived), it starts in the very task
// instead of waiting for a frame. What does not fit into a slice follows in the next task, not in the next frame: a frame
// may be presented in between, and no time is lost waiting for it.

/** Longest that cards are drawn without letting others have a turn. */
const SLICE_MS = 12;

export class DrawQueue {
  #cards;
  #draw;
  #frame = null;
  #continued = false;
  #after = [];
  #channel = new MessageChannel();

  /** Draws `cards` (a list that may grow) with `draw(card)`. */
  constructor(cards, draw) {
    this.#cards = cards;
    this.#draw = draw;
    this.#channel.port1.onmessage = () => {
      this.#continued = false;
      this.#slice();
    };
  }

  /** Draws what is stale in the next frame, or `atOnce`; calls `after` once every card in view shows the newest. */
  ask(after, atOnce = false) {
    if (after) {
      this.#after.push(after);
    }
    if (atOnce) {
      this.#slice();
    } else if (!this.#continued) {
      this.#frame ??= requestAnimationFrame(() => this.#slice());
    }
  }

  #slice() {
    cancelAnimationFrame(this.#frame);
    this.#frame = null;
    const end = performance.now() + SLICE_MS;
    const due = this.#cards.filter(({ inView, stale }) => inView && stale);
    // A card that is being pointed at comes first; then the one that has waited longest.
    due.sort((a, b) => Number(b.active) - Number(a.active) || a.drawnAt - b.drawnAt);
    for (const card of due) {
      if (performance.now() > end) {
        this.#continue();
        return;
      }
      this.#draw(card);
    }
    // Until the browser has said which cards are in view, nothing can be called drawn.
    if (this.#cards.every(({ placed }) => placed)) {
      for (const after of this.#after.splice(0)) {
        after();
      }
    }
  }

  #continue() {
    if (!this.#continued) {
      this.#continued = true;
      this.#channel.port2.postMessage(null);
    }
  }
}
