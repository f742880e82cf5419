// The pose of one link in the frame of another, and a line between the two.

import * as THREE from "three";
import { copy } from "./copying.js";
import { byId, h, show } from "./dom.js";
import { axesMark, lineMark } from "./marks.js";

const DIGITS = 6;
const FRAME_SHARE = 0.15; // of the robot's radius

export class Between {
  /** @param {object} told `stage`, `onCopied()` */
  constructor(told) {
    this.told = told;
    this.from = this.to = null;
    this.menu = byId("between-to");
    this.menu.onchange = () => this.toLink(this.menu.value || null);
    byId("between-swap").onclick = () => told.onSwap(this.to, this.from);
    byId("between-copy").onclick = () => this.copy(this.text());
    byId("between-close").onclick = () => this.toLink(null);
  }

  /** Show the links of a robot to choose from. */
  setRobot(robot) {
    this.clearMarks();
    this.robot = robot;
    const options = [...robot.links.keys()].map((link) => h("option", { value: link }, link));
    this.menu.replaceChildren(h("option", { value: "" }, "choose a link …"), ...options);
    if (!robot.links.has(this.to)) this.to = null;
    this.menu.value = this.to ?? "";
  }

  /** Measure from another link; null measures nothing. */
  fromLink(link) {
    this.from = link;
    this.update();
  }

  /** Measure to another link; null measures nothing. */
  toLink(link) {
    this.to = link;
    this.menu.value = link ?? "";
    this.update();
  }

  /** Return the pose of the second link in the frame of the first, or null. */
  pose() {
    const [from, to] = [this.from, this.to].map((link) => this.robot?.links.get(link));
    if (!from || !to || from === to) return null;
    this.robot.object.updateMatrixWorld(true);
    const matrix = from.matrixWorld.clone().invert().multiply(to.matrixWorld);
    const position = new THREE.Vector3().setFromMatrixPosition(matrix);
    const turn = new THREE.Quaternion().setFromRotationMatrix(matrix);
    if (turn.w < 0) turn.set(-turn.x, -turn.y, -turn.z, -turn.w);
    const { x: roll, y: pitch, z: yaw } = new THREE.Euler().setFromRotationMatrix(matrix, "ZYX");
    return {
      xyz: position.toArray(),
      rpy: [roll, pitch, yaw],
      quaternion: turn.toArray(),
      distance: position.length(),
    };
  }

  /** Show the pose as the joints are now. */
  update() {
    const pose = this.pose();
    show(byId("between-result"), Boolean(pose));
    this.clearMarks();
    if (!pose) return;
    const rows = [
      ["xyz", textOf(pose.xyz), "m"],
      ["rpy", textOf(pose.rpy), "rad"],
      ["", textOf(pose.rpy.map(THREE.MathUtils.radToDeg), 4), "°"],
      ["quaternion", textOf(pose.quaternion), "x y z w"],
      ["distance", textOf([pose.distance]), "m"],
    ];
    byId("between-rows").replaceChildren(...rows.map((row) => this.row(...row)));
    this.addMarks();
  }

  row(name, text, unit) {
    return h(
      "button.between-row",
      { type: "button", title: "Copy", data: { name: name || "degrees" }, onclick: () => this.copy(text) },
      h("span.kind", {}, name),
      h("span.numbers", {}, text),
      h("span.unit", {}, unit),
    );
  }

  addMarks() {
    const { stage } = this.told;
    const ends = [this.from, this.to].map((link) => this.robot.links.get(link));
    const points = ends.map((end) => new THREE.Vector3().setFromMatrixPosition(end.matrixWorld));
    this.marks = [lineMark(points)];
    stage.scene.add(this.marks[0]);
    for (const end of ends) {
      const mark = axesMark(FRAME_SHARE * stage.radius);
      end.add(mark);
      this.marks.push(mark);
    }
    stage.draw();
  }

  clearMarks() {
    for (const mark of this.marks ?? []) {
      mark.removeFromParent();
      mark.geometry.dispose();
      if (!mark.isLineSegments2) mark.material.dispose();
    }
    this.marks = [];
    this.told.stage.draw();
  }

  text() {
    const { xyz, rpy, quaternion, distance } = this.pose();
    const lines = [
      `# ${this.to} in the frame of ${this.from}`,
      `xyz: ${textOf(xyz)}`,
      `rpy: ${textOf(rpy)}`,
      `quaternion: ${textOf(quaternion)}  # x y z w`,
      `distance: ${textOf([distance])}`,
    ];
    return `${lines.join("\n")}\n`;
  }

  async copy(text) {
    if (await copy(text)) this.told.onCopied();
  }
}

/** Return numbers with as many digits as count; what is 0 but for rounding is 0. */
function textOf(numbers, digits = DIGITS) {
  return numbers.map((each) => String(Number((Math.abs(each) < 1e-9 ? 0 : each).toPrecision(digits)))).join(" ");
}
