// The time that everything on the page shares: the instant that is shown, the stretch that is zoomed into, and playing.
//
// Emits "time" (the instant moved), "window" (the stretch changed) and "playing" (play, pause, speed). Figures, arm and
// transport all listen here and know nothing of one another.

export class Timeline extends EventTarget {
  #duration = 0;
  #time = 0;
  #hovered = null;
  #window = null;
  #frame = null;
  #last = 0;
  /** Simulated seconds per second. */
  speed = 1;

  /** Length of the longest run, s. */
  get duration() {
    return this.#duration;
  }

  set duration(seconds) {
    if (seconds !== this.#duration) {
      this.#duration = seconds;
      this.#time = Math.min(this.#time, seconds);
      this.#window = null;
      this.#emit("window");
      this.#emit("time");
    }
  }

  /** The instant to show, s: where a pointer hovers, else where playing stands. */
  get time() {
    return this.#hovered ?? this.#time;
  }

  /** Where playing stands, s. */
  get position() {
    return this.#time;
  }

  /** Moves to an instant. */
  seek(seconds) {
    this.#time = Math.min(Math.max(seconds, 0), this.#duration);
    this.#emit("time");
  }

  /** Shows another instant for as long as a pointer is there; null when it leaves. */
  hover(seconds) {
    if (seconds !== this.#hovered) {
      this.#hovered = seconds;
      this.#emit("time");
    }
  }

  /** `[from, to]` in s: what is zoomed into, or everything. */
  get window() {
    return this.#window ?? [0, this.#duration];
  }

  /** Whether less than everything is shown. */
  get isZoomed() {
    return this.#window !== null;
  }

  /** Shows `from` to `to`, kept inside the runs; null for everything. */
  zoom(from, to) {
    const low = Math.max(0, from ?? 0);
    const high = Math.min(this.#duration, to ?? this.#duration);
    const whole = from === null || (low <= 0 && high >= this.#duration) || !(high > low);
    this.#window = whole ? null : [low, high];
    this.#emit("window");
  }

  get isPlaying() {
    return this.#frame !== null;
  }

  /** Starts where it stands; at the end, from the beginning. */
  play() {
    if (this.#frame === null && this.#duration > 0) {
      if (this.#time >= this.#duration) {
        this.#time = 0;
      }
      this.#last = performance.now();
      this.#frame = requestAnimationFrame((now) => this.#step(now));
      this.#emit("playing");
    }
  }

  pause() {
    if (this.#frame !== null) {
      cancelAnimationFrame(this.#frame);
      this.#frame = null;
      this.#emit("playing");
    }
  }

  #step(now) {
    // A tab that was in the background goes on where it was.
    const elapsed = Math.min(now - this.#last, 100);
    this.#last = now;
    this.#time = Math.min(this.#time + (elapsed / 1000) * this.speed, this.#duration);
    this.#frame = requestAnimationFrame((next) => this.#step(next));
    this.#emit("time");
    if (this.#time >= this.#duration) {
      this.pause();
    }
  }

  #emit(type) {
    this.dispatchEvent(new Event(type));
  }
}
