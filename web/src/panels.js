// The handles that widen the panels beside the scene, by pointer or arrow keys. Widths are kept.

import { byId } from "./dom.js";
import { keep, recall } from "./settings.js";

const LEAST = 180; // pixels
const LEAST_SCENE = 240;
const STEP = 16;

export class Panels {
  constructor() {
    this.handles = ["left", "right"].map((side) => new Handle(side));
    window.addEventListener("resize", () => this.fit());
    this.fit();
  }

  /** Keep room for the scene. */
  fit() {
    for (const handle of this.handles) handle.set(handle.wanted);
  }
}

class Handle {
  constructor(side) {
    this.side = side;
    this.panel = byId(side);
    this.element = byId(`${side}-handle`);
    this.usual = this.panel.getBoundingClientRect().width;
    this.wanted = Number(recall(`${side}-width`)) || this.usual;
    this.element.onpointerdown = (event) => this.press(event);
    this.element.onkeydown = (event) => this.key(event);
    this.element.ondblclick = () => this.choose(this.usual);
  }

  /** Show the panel in a width, within what leaves room for the scene; the wish is remembered. */
  set(width) {
    const other = byId(this.side === "left" ? "right" : "left").getBoundingClientRect().width;
    const most = Math.max(window.innerWidth - other - LEAST_SCENE, LEAST);
    this.width = Math.round(Math.min(Math.max(width, LEAST), most));
    document.body.style.setProperty(`--${this.side}-width`, `${this.width}px`);
    this.element.setAttribute("aria-valuenow", String(this.width));
    this.element.setAttribute("aria-valuemin", String(LEAST));
    this.element.setAttribute("aria-valuemax", String(Math.round(most)));
  }

  choose(width) {
    this.set(width);
    this.wanted = this.width;
    keep(`${this.side}-width`, String(this.width));
  }

  press(event) {
    const start = event.clientX;
    const width = this.width;
    const sign = this.side === "left" ? 1 : -1;
    event.preventDefault();
    this.element.focus();
    this.element.setPointerCapture(event.pointerId);
    this.element.onpointermove = (move) => this.choose(width + sign * (move.clientX - start));
    this.element.onpointerup = this.element.onpointercancel = () => (this.element.onpointermove = null);
  }

  key(event) {
    const sign = this.side === "left" ? 1 : -1;
    const step = event.shiftKey ? 4 * STEP : STEP;
    const goals = {
      ArrowRight: this.width + sign * step,
      ArrowLeft: this.width - sign * step,
      Home: LEAST,
      End: Infinity,
      Enter: this.usual,
    };
    if (!(event.key in goals)) return;
    event.preventDefault();
    event.stopPropagation();
    this.choose(goals[event.key]);
  }
}
