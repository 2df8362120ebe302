// <transport-bar>: play, pause, speed, and a slider over the run, all of the timeline's.

import { element } from "../dom.js";
import { strings } from "../strings/index.js";

const SPEEDS = [0.25, 0.5, 1, 2, 4];
/** A press of an arrow key moves by this share of the run, with shift by the finest step. */
const KEY_SHARE = 1 / 120;
const FINEST_S = 0.01;
const PAGE_SHARE = 1 / 12;

export class TransportBar extends HTMLElement {
  #timeline;
  #play;
  #slider;
  #clock;

  /** Shows and moves `timeline`. */
  configure(timeline) {
    this.#timeline = timeline;
    this.#play = element("button", { type: "button", class: "play", disabled: true, onclick: () => this.toggle() }, element("span", { class: "play-icon" }));
    this.#slider = element("input", {
      type: "range",
      min: 0,
      max: 0,
      step: FINEST_S,
      "aria-label": strings.stage.position,
      oninput: () => timeline.seek(this.#slider.valueAsNumber),
      onkeydown: (event) => this.#key(event),
    });
    this.#clock = element("output", { class: "clock", "aria-live": "off" });
    const speed = element(
      "select",
      { class: "speed", "aria-label": strings.stage.speed, onchange: () => (timeline.speed = Number(speed.value)) },
      SPEEDS.map((factor) => element("option", { value: factor }, strings.stage.times(factor))),
    );
    speed.value = timeline.speed;
    this.replaceChildren(this.#play, this.#slider, this.#clock, speed);
    timeline.addEventListener("time", () => this.#showTime());
    timeline.addEventListener("window", () => this.#showWindow());
    timeline.addEventListener("playing", () => this.#showPlaying());
    this.#showWindow();
    this.#showPlaying();
  }

  /** Plays, or pauses. */
  toggle() {
    if (this.#timeline.isPlaying) {
      this.#timeline.pause();
    } else {
      this.#timeline.play();
    }
  }

  #showTime() {
    const { position, time, duration, isPlaying } = this.#timeline;
    if (this.#slider.max !== String(duration)) {
      this.#slider.max = duration;
      this.#play.disabled = duration === 0;
    }
    this.#slider.value = position;
    this.#slider.style.setProperty("--at", duration > 0 ? position / duration : 0);
    const [now, end] = [time.toFixed(2), duration.toFixed(2)];
    this.#clock.textContent = strings.stage.clock(now, end);
    if (!isPlaying) {
      this.#slider.setAttribute("aria-valuetext", strings.stage.ofTime(position.toFixed(2), end));
    }
  }

  /** The stretch that figures are zoomed into. */
  #showWindow() {
    const { window: [from, to], duration, isZoomed } = this.#timeline;
    this.#slider.style.setProperty("--from", isZoomed ? from / duration : 0);
    this.#slider.style.setProperty("--to", isZoomed ? to / duration : 0);
    this.#showTime();
  }

  #showPlaying() {
    const { isPlaying } = this.#timeline;
    this.#play.setAttribute("aria-label", isPlaying ? strings.stage.pause : strings.stage.play);
    this.#play.toggleAttribute("data-playing", isPlaying);
    this.#showTime();
  }

  #key(event) {
    const { duration, position } = this.#timeline;
    const arrow = event.shiftKey ? FINEST_S : Math.max(FINEST_S, duration * KEY_SHARE);
    const steps = {
      ArrowLeft: -arrow,
      ArrowDown: -arrow,
      ArrowRight: arrow,
      ArrowUp: arrow,
      PageDown: -duration * PAGE_SHARE,
      PageUp: duration * PAGE_SHARE,
    };
    if (event.key in steps && !event.ctrlKey && !event.metaKey && !event.altKey) {
      event.preventDefault();
      this.#timeline.seek(position + steps[event.key]);
    }
  }
}

customElements.define("transport-bar", TransportBar);
