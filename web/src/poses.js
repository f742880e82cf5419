// The pose of all joints: the robot's named states, and copies of the pose as text.

import { copy } from "./copying.js";
import { byId, h, show } from "./dom.js";
import { inState } from "./joints.js";

const DURATION = 300; // milliseconds in which a state is taken
const DIGITS = 6;
const INITIAL = "";
const HOME = "=home"; // the state that is the initial pose of a robot that has it
const ZERO = "zero";
const CHANGED = "changed";

export class Poses {
  /** @param {object} told `joints`, `onCopied(what, left)` */
  constructor(told) {
    this.told = told;
    this.turn = 0;
    this.menu = byId("states");
    this.button = byId("pose-copy");
    this.card = byId("pose-formats");
    this.menu.onchange = () => this.take(this.menu.value);
    this.button.onclick = () => this.toggle(this.card.hidden);
    for (const choice of this.card.querySelectorAll("button")) {
      choice.onclick = () => this.copy(choice.dataset.format);
    }
    document.addEventListener("pointerdown", ({ target }) => {
      if (!this.card.contains(target) && !this.button.contains(target)) this.toggle(false);
    });
    this.card.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      event.stopPropagation();
      this.toggle(false);
      this.button.focus();
    });
  }

  toggle(isOpen) {
    show(this.card, isOpen);
    this.button.setAttribute("aria-expanded", String(isOpen));
    if (isOpen) this.card.querySelector("button").focus();
  }

  /** Show the states of a robot. */
  setRobot(robot) {
    this.states = new Map(Object.entries(robot.description.states ?? {}));
    const options = [...this.states.keys()].map((name) => h("option", { value: `=${name}` }, name));
    this.initial = this.states.has("home") ? HOME : INITIAL;
    this.menu.replaceChildren(
      ...(this.initial === INITIAL ? [h("option", { value: INITIAL }, "initial pose")] : []),
      ...options,
      ...(this.initial === HOME ? [h("option", { value: ZERO }, "all joints at 0")] : []),
      h("option", { value: CHANGED, hidden: true, disabled: true }, "changed"),
    );
    this.showChosen();
    show(byId("pose"), this.freeJoints().length > 0);
  }

  freeJoints() {
    return this.told.joints.simple();
  }

  /** Return the position of each joint in a state; those that it does not name are at 0. */
  positionsIn(chosen) {
    return inState(this.freeJoints(), this.states.get(chosen.slice(1)));
  }

  /** Move all joints to a state, unless another is chosen meanwhile. */
  take(chosen) {
    const goals = this.positionsIn(chosen);
    const starts = new Map(this.freeJoints().map(({ name, value }) => [name, value]));
    const isStill = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    const turn = ++this.turn;
    const begin = performance.now();
    const step = () => {
      if (turn !== this.turn) return;
      const time = isStill ? 1 : Math.min((performance.now() - begin) / DURATION, 1);
      const share = time * time * (3 - 2 * time);
      const isThere = time === 1;
      this.told.joints.place(
        new Map([...goals].map(([name, goal]) => [name, isThere ? goal : starts.get(name) + share * (goal - starts.get(name))])),
        { isKept: isThere && chosen !== this.initial },
      );
      if (!isThere) requestAnimationFrame(step);
      else if (chosen === this.initial) this.told.joints.reset(); // those of several positions too
    };
    step();
  }

  /** Show in the menu which state the robot is in, after it has moved. */
  showChosen() {
    const joints = this.freeJoints();
    const isIn = (chosen) => {
      const goals = this.positionsIn(chosen);
      return joints.every(({ name, value }) => Math.abs(goals.get(name) - value) < 1e-9);
    };
    const all = [this.initial, ...[...this.states.keys()].map((name) => `=${name}`), ZERO];
    if (all.includes(this.menu.value) && isIn(this.menu.value)) return;
    this.menu.value = all.find(isIn) ?? CHANGED;
  }

  /** The user moves a joint: a state that is being taken is left. */
  interrupt() {
    this.turn += 1;
  }

  async copy(format) {
    this.toggle(false);
    this.button.focus();
    const all = this.freeJoints();
    const joints = format === "picture" ? all.filter(({ name }) => !name.includes(",")) : all;
    const left = all.length - joints.length;
    if (await copy(FORMATS[format](joints))) this.told.onCopied(format, left);
  }
}

const numberOf = (value) => String(Number(value.toPrecision(DIGITS)) + 0);

/** Return a name as a key of YAML that is not taken for anything else. */
const keyOf = (name) => (/^[A-Za-z_][\w-]*$/.test(name) && !/^(true|false|null|yes|no|on|off)$/i.test(name) ? name : JSON.stringify(name));

const FORMATS = {
  state(joints) {
    const pairs = joints.map(({ name, value }) => `${keyOf(name)}: ${numberOf(value)}`);
    return `states:\n  pose: {${pairs.join(", ")}}\n`;
  },
  picture(joints) {
    const word = joints.map(({ name, value }) => `${name}=${numberOf(value)}`).join(",");
    const isPlain = /^[\w.=,+/-]*$/.test(word);
    return `--joints ${isPlain ? word : `'${word.replaceAll("'", `'\\''`)}'`}`;
  },
  json(joints) {
    return JSON.stringify(Object.fromEntries(joints.map(({ name, value }) => [name, Number(numberOf(value))])), null, 2);
  },
};
