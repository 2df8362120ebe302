// A picture from the server: a plain address where that does, else fetched and shown from memory.

import { address, send, token } from "../api.js";
import { element } from "../dom.js";

export class ServerPicture {
  node;
  #url = null;
  #failed;

  /** `failed` is called where it cannot be had; `attributes` are the image's. */
  constructor(attributes, failed) {
    this.node = element("img", attributes);
    this.#failed = () => {
      delete this.node.dataset.key;
      failed();
    };
    this.node.addEventListener("error", this.#failed);
  }

  /** Shows what is at `path`, unless that is shown already under this `key`. */
  async load(path, key, alt) {
    if (this.node.dataset.key === key) {
      return;
    }
    this.node.dataset.key = key;
    this.node.alt = alt;
    this.stop();
    const again = this.node.dataset.path === path;
    this.node.dataset.path = path;
    if (token() === null && !again) {
      this.node.src = address(path);
      return;
    }
    // An image cannot carry a token, and does not ask again for the same address.
    try {
      const blob = await (await send(path)).blob();
      if (this.node.dataset.key === key) {
        this.#url = URL.createObjectURL(blob);
        this.node.src = this.#url;
      }
    } catch {
      this.#failed();
    }
  }

  /** Lets go of what it holds. */
  stop() {
    URL.revokeObjectURL(this.#url);
    this.#url = null;
  }
}
