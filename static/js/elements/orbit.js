// The eye that looks at the arm: drag, one finger, pinch, ctrl and wheel, arrow keys; within limits, so that nobody gets lost.
//
// One finger that goes up or down scrolls the page, and a wheel without ctrl too. Emits "change".

const HOME = { yaw_rad: -0.9, pitch_rad: 0.3, zoom: 1 };
const PITCH_RAD = [0.04, 1.5];
const ZOOM = [0.6, 3];
/** Radians per layout pixel dragged, and per press of an arrow key. */
const PER_PIXEL = 0.008;
const PER_KEY = 0.12;
const ZOOM_STEP = 1.2;
const WHEEL = 0.004;

const KEYS = {
  ArrowLeft: (orbit) => orbit.turn(-PER_KEY, 0),
  ArrowRight: (orbit) => orbit.turn(PER_KEY, 0),
  ArrowUp: (orbit) => orbit.turn(0, PER_KEY),
  ArrowDown: (orbit) => orbit.turn(0, -PER_KEY),
  "+": (orbit) => orbit.nearer(),
  "=": (orbit) => orbit.nearer(),
  "-": (orbit) => orbit.farther(),
  0: (orbit) => orbit.reset(),
  Home: (orbit) => orbit.reset(),
};

export class Orbit extends EventTarget {
  #pointers = new Map();
  /** What the module draws with. */
  camera = { ...HOME };

  /** Follows what happens on `surface`. */
  attach(surface) {
    surface.addEventListener("pointerdown", (event) => this.#down(surface, event));
    surface.addEventListener("pointermove", (event) => this.#move(event));
    for (const type of ["pointerup", "pointercancel"]) {
      surface.addEventListener(type, (event) => this.#pointers.delete(event.pointerId));
    }
    surface.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    surface.addEventListener("keydown", (event) => this.#key(event));
  }

  /** Turns the eye round the arm and up, rad. */
  turn(yaw, pitch) {
    const { camera } = this;
    camera.yaw_rad = (camera.yaw_rad + yaw) % (2 * Math.PI);
    camera.pitch_rad = clamp(camera.pitch_rad + pitch, PITCH_RAD);
    this.#changed();
  }

  zoomBy(factor) {
    this.camera.zoom = clamp(this.camera.zoom * factor, ZOOM);
    this.#changed();
  }

  nearer() {
    this.zoomBy(ZOOM_STEP);
  }

  farther() {
    this.zoomBy(1 / ZOOM_STEP);
  }

  reset() {
    Object.assign(this.camera, HOME);
    this.#changed();
  }

  #down(surface, event) {
    if (event.button === 0) {
      this.#pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      surface.setPointerCapture(event.pointerId);
    }
  }

  #move(event) {
    const before = this.#pointers.get(event.pointerId);
    if (!before) {
      return;
    }
    const now = { x: event.clientX, y: event.clientY };
    this.#pointers.set(event.pointerId, now);
    const others = [...this.#pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    if (others.length === 0) {
      this.turn(-PER_PIXEL * (now.x - before.x), PER_PIXEL * (now.y - before.y));
    } else {
      const [fixed] = others;
      const spread = (at) => Math.max(Math.hypot(at.x - fixed.x, at.y - fixed.y), 1);
      this.zoomBy(spread(now) / spread(before));
    }
  }

  #wheel(event) {
    // A pinch on a touchpad arrives as a wheel with ctrl, too.
    if (event.ctrlKey) {
      event.preventDefault();
      this.zoomBy(Math.exp(-WHEEL * event.deltaY));
    }
  }

  #key(event) {
    const act = KEYS[event.key];
    if (act && !event.ctrlKey && !event.metaKey && !event.altKey) {
      event.preventDefault();
      act(this);
    }
  }

  #changed() {
    this.dispatchEvent(new Event("change"));
  }
}

function clamp(value, [low, high]) {
  return Math.min(Math.max(value, low), high);
}
