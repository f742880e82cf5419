// The sliders of the joints. Positions are kept by name while the robot is built again.

import { byId, h, show } from "./dom.js";
import { childOf } from "./urdf.js";

const FEW = 7;
const STEPS = 500;
const PART_NAMES = new Map([
  ["planar", ["x", "y", "turn"]],
  ["floating", ["x", "y", "z", "roll", "pitch", "yaw"]],
]);
const DEGREES = 180 / Math.PI;

export class Joints {
  /** @param {object} told `onMove()`, before it perhaps `onChoose()` if one is moved by hand, `onHover(link)`, `onSelect(link)` */
  constructor(told) {
    this.told = told;
    this.positions = new Map(); // name → values that the user has set
    this.rows = new Map();
    this.search = byId("joint-search");
    this.search.oninput = () => this.filter();
    byId("joint-reset").onclick = () => this.reset();
  }

  /**
   * Show the joints of a robot at rest; `restore` moves those that the user has moved.
   * @param {object} home the positions of joints by name in the state `home`, if there is one
   */
  setRobot(robot, size, home = {}) {
    this.robot = robot;
    this.home = home;
    this.rows.clear();
    for (const joint of robot.joints.values()) {
      if (joint.jointType !== "fixed") this.rows.set(joint.name, this.rowOf(joint, size));
    }
    byId("joints").replaceChildren(...[...this.rows.values()].map(({ element }) => element));
    byId("joint-count").textContent = String(this.rows.size);
    show(byId("joints-empty"), this.rows.size === 0);
    show(this.search, this.rows.size > FEW);
    show(byId("joint-reset"), this.rows.size > 0);
    this.filter();
    this.rest();
  }

  /** Put all joints to rest; what the user has set is not forgotten. */
  rest() {
    for (const { joint, parts } of this.rows.values()) {
      if (!joint.mimicJoint) this.robot.setJoint(joint.name, parts.map(({ rest }) => rest));
    }
    this.showValues();
  }

  /** Put the joints where the user has set them, within their limits. */
  restore() {
    for (const { joint, parts } of this.rows.values()) {
      const wanted = this.positions.get(joint.name);
      if (!wanted || joint.mimicJoint) continue;
      const values = parts.map((part, index) => clamp(wanted[index] ?? part.rest, part));
      this.robot.setJoint(joint.name, values);
    }
    this.showValues();
  }

  rowOf(joint, size) {
    const child = childOf(joint.urdfNode, "child").getAttribute("link");
    const parts = partsOf(joint, size, homeOf(this.home, joint.name)).map((part) => ({
      ...part,
      ...this.inputsOf(joint, part),
    }));
    const isFollower = Boolean(joint.mimicJoint);
    const element = h(
      "div.joint-row",
      {
        data: { joint: joint.name },
        onmouseenter: () => this.told.onHover(child),
        onmouseleave: () => this.told.onHover(null),
      },
      h(
        "button.name",
        { type: "button", title: `${joint.name}: ${joint.jointType}`, onclick: () => this.told.onSelect(child) },
        joint.name,
      ),
      isFollower && h("span.mimic", { title: `mimics ${joint.mimicJoint}` }, `↳ ${joint.mimicJoint}`),
      ...parts.map((part) =>
        h(
          "div.part",
          {},
          h("span.label", {}, part.label),
          h("span.value", {}, part.field, h("span.unit", {}, part.unit)),
          h("span.limit", {}, part.isFree ? "" : shown(part.lower, part.isAngle)),
          part.slider,
          h("span.limit", {}, part.isFree ? "" : shown(part.upper, part.isAngle)),
        ),
      ),
    );
    element.classList.toggle("follower", isFollower);
    return { element, joint, child, parts };
  }

  inputsOf(joint, part) {
    const factor = part.isAngle ? DEGREES : 1;
    const isFixed = Boolean(joint.mimicJoint) || !(part.upper > part.lower);
    const common = { disabled: isFixed, title: joint.name };
    const slider = h("input", {
      ...common,
      type: "range",
      min: String(part.lower),
      max: String(part.upper),
      step: String((part.upper - part.lower) / STEPS || 1),
      oninput: () => this.move(joint, part.index, Number(slider.value)),
      ondblclick: () => this.move(joint, part.index, part.rest),
    });
    slider.setAttribute("aria-label", `${joint.name} ${part.label}`.trim());
    const field = h("input.number", {
      ...common,
      type: "number",
      step: part.isAngle ? "1" : "0.001",
      onchange: () => this.move(joint, part.index, Number(field.value) / factor),
    });
    field.setAttribute("aria-label", `${joint.name} ${part.label} in ${part.unit}`);
    return { slider, field, factor };
  }

  /** Move a part of a joint, and remember it. */
  move(joint, index, value) {
    const { parts } = this.rows.get(joint.name);
    const values = [...joint.jointValue];
    values[index] = clamp(Number.isFinite(value) ? value : 0, parts[index]);
    this.positions.set(joint.name, values);
    this.robot.setJoint(joint.name, values);
    this.showValues();
    this.told.onChoose?.();
    this.told.onMove();
  }

  /** Put all joints to rest. */
  reset() {
    this.positions.clear();
    this.rest();
    this.told.onChoose?.();
    this.told.onMove();
  }

  /** Return the joints with one position that follow no other: name, position, rest, zero. */
  simple() {
    return [...this.rows.values()]
      .filter(({ joint, parts }) => !joint.mimicJoint && parts.length === 1)
      .map(({ joint, parts: [{ rest, zero }] }) => ({ name: joint.name, value: joint.jointValue[0], rest, zero }));
  }

  /** Move several joints; `isKept` also for robots that are built later. */
  place(positions, { isKept }) {
    for (const [name, position] of positions) {
      const values = [clamp(position, this.rows.get(name).parts[0])];
      if (isKept) this.positions.set(name, values);
      this.robot.setJoint(name, values);
    }
    this.showValues();
    this.told.onMove();
  }

  /** Return the position of a joint as it is shown, and whether it is at a limit. */
  shownValue(joint) {
    const [part] = this.rows.get(joint.name).parts;
    const value = joint.jointValue[0];
    const isAtLimit = !part.isFree && (value <= part.lower || value >= part.upper);
    return `${shown(value, part.isAngle)}${isAtLimit ? " (limit)" : ""}`;
  }

  showValues() {
    for (const { joint, parts } of this.rows.values()) {
      for (const { index, slider, field, factor } of parts) {
        const value = joint.jointValue[index] ?? 0;
        slider.value = String(value);
        const share = (value - Number(slider.min)) / (Number(slider.max) - Number(slider.min));
        slider.style.setProperty("--share", `${100 * Math.min(Math.max(share || 0, 0), 1)}%`);
        if (document.activeElement !== field) {
          field.value = String(rounded(value * factor, factor === 1 ? 4 : 1));
        }
      }
    }
  }

  filter() {
    const wanted = this.search.value.trim().toLowerCase();
    for (const { element, joint, child } of this.rows.values()) {
      element.hidden = !`${joint.name} ${child}`.toLowerCase().includes(wanted);
    }
  }

  /** Mark the joint that holds a link; null marks none. */
  mark(link) {
    for (const { element, child } of this.rows.values()) {
      element.classList.toggle("selected", child === link);
      if (child === link) element.scrollIntoView({ block: "nearest" });
    }
  }
}

/**
 * Return what of a joint can be moved: label, range and unit of each degree of freedom, and where it
 * stands without a state (`zero`) and at first (`rest`): in the state `home`, if that names it.
 */
function partsOf(joint, size, home) {
  const turn = { lower: -Math.PI, upper: Math.PI, isAngle: true, unit: "°", isFree: true };
  const slide = { lower: -2 * size, upper: 2 * size, isAngle: false, unit: "m", isFree: true };
  const { lower, upper } = joint.limit;
  const names = PART_NAMES.get(joint.jointType) ?? [""];
  return names.map((label, index) => {
    let range = slide;
    if (joint.jointType === "continuous" || ["turn", "roll", "pitch", "yaw"].includes(label)) {
      range = turn;
    } else if (joint.jointType === "revolute") range = { ...turn, lower, upper, isFree: false };
    else if (joint.jointType === "prismatic") range = { ...slide, lower, upper, isFree: false };
    const zero = zeroOf(range);
    return { label, index, ...range, zero, rest: names.length === 1 ? (home ?? zero) : zero };
  });
}

/**
 * Return where a part stands by itself: at 0, or in the middle of limits that exclude 0, as in
 * `yamaro picture` and ROS's joint_state_publisher.
 */
const zeroOf = ({ lower, upper }) =>
  upper >= lower && (lower > 0 || upper < 0) ? (lower + upper) / 2 : 0;

/** Return the positions of joints by name in a state; those that it does not name are at 0. */
export function inState(joints, state = {}) {
  return new Map(joints.map(({ name, zero }) => [name, Object.hasOwn(state, name) ? state[name] : zero]));
}

/** Return a position of a state, or undefined; names may be those of an object's own, too. */
const homeOf = (home, name) => (Object.hasOwn(home, name) ? home[name] : undefined);

const clamp = (value, { lower, upper }) =>
  upper >= lower ? Math.min(Math.max(value, lower), upper) : value;

const rounded = (value, digits) => Number(value.toFixed(digits)) + 0;

const shown = (value, isAngle) =>
  isAngle ? `${rounded(value * DEGREES, 1)}°` : `${rounded(value, 3)} m`;
