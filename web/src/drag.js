// Drags a link in the scene: the joint that moves it follows the pointer.

import * as THREE from "three";
import { childOf } from "./urdf.js";
import { CLICK_DISTANCE } from "./stage.js";

const DRAGGED = ["revolute", "continuous", "prismatic"];
const LEAST_SINE = 0.25; // of the angle between the ray and the plane in which a link turns
const LEAST_SEEN = 0.5; // of the way of a point: if less is seen, it cannot follow the pointer
const STEPS = 3; // in which a joint approaches the pointer
const STEP = 1e-4; // rad, or part of the robot's size: for the direction in which a point moves

export class JointDrag {
  /**
   * @param {Stage} stage
   * @param {object} told `robot()`; `joints`, which moves a joint by `move(joint, 0, value)`;
   *   `onDrag(joint, event)`, and null for both at the end; `onHold(link)` when one is touched
   */
  constructor(stage, told) {
    this.stage = stage;
    this.told = told;
    this.isOn = true;
    this.held = null;
    const { canvas } = stage;
    // Before the camera's controls take the pointer.
    canvas.addEventListener("pointerdown", (event) => this.press(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => this.follow(event));
    canvas.addEventListener("pointerup", (event) => this.release(event));
    canvas.addEventListener("pointercancel", (event) => this.release(event));
    window.addEventListener("keydown", (event) => this.cancel(event), { capture: true });
  }

  /** Return the joint that a drag of a link moves, or null: the nearest above that can move. */
  jointOf(link) {
    const robot = this.told.robot();
    for (let at = link; at !== undefined; ) {
      const joint = robot.jointAbove.get(at);
      if (!joint) return null;
      const leader = leaderOf(joint, robot);
      if (leader && canMove(leader)) return { joint, leader };
      at = childOf(joint.urdfNode, "parent").getAttribute("link");
    }
    return null;
  }

  press(event) {
    if (this.held) return this.end(); // a second finger
    const isPlain = event.button === 0 && !event.altKey && !event.shiftKey && !event.ctrlKey && !event.metaKey;
    if (!this.isOn || !isPlain || !this.told.robot()) return;
    const hit = this.stage.hitAt(event);
    const link = hit && this.told.robot().shapeOf(hit.object)?.link;
    const found = link && this.jointOf(link);
    if (!found) return;
    this.stage.controls.enabled = false; // the camera stays
    this.stage.canvas.setPointerCapture(event.pointerId);
    const { joint, leader } = found;
    const frame = this.told.robot().links.get(link);
    this.held = {
      link, joint, leader, frame,
      id: event.pointerId,
      start: event,
      isMoving: false,
      before: leader.jointValue[0],
      grip: frame.worldToLocal(hit.point.clone()), // the point that is held, in the link's frame
    };
    this.turn = this.turnOf(hit.point, event);
  }

  /** Return how a joint turns that is seen well enough from above its plane, else null. */
  turnOf(point, event) {
    const { joint, leader } = this.held;
    if (joint !== leader || joint.jointType === "prismatic" || this.isCoupled()) return null;
    joint.updateWorldMatrix(true, false);
    const center = new THREE.Vector3().setFromMatrixPosition(joint.matrixWorld);
    const axis = joint.axis.clone().transformDirection(joint.matrixWorld);
    const { ray } = this.stage.casterAt(event);
    if (Math.abs(ray.direction.dot(axis)) < LEAST_SINE) return null;
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(axis, point);
    const spoke = spokeOf(point, center, axis);
    return spoke.lengthSq() > 0 ? { axis, center, plane, last: spoke, total: 0 } : null;
  }

  /** Tell whether several joints above the link that is held move with the leader. */
  isCoupled() {
    const robot = this.told.robot();
    const { leader } = this.held;
    for (let at = this.held.link, count = 0; at !== undefined; ) {
      const joint = robot.jointAbove.get(at);
      if (!joint) return false;
      if (leaderOf(joint, robot) === leader && ++count > 1) return true;
      at = childOf(joint.urdfNode, "parent").getAttribute("link");
    }
    return false;
  }

  follow(event) {
    const { held } = this;
    if (!held || event.pointerId !== held.id) return;
    if (!held.isMoving) {
      const way = Math.hypot(event.clientX - held.start.clientX, event.clientY - held.start.clientY);
      if (way < CLICK_DISTANCE) return;
      held.isMoving = true;
    }
    if (this.turn) this.followTurn(event);
    else this.approach(event);
    this.told.onDrag(held.leader, event);
  }

  /** Turn the joint by the angle that the pointer has gone around the axis. */
  followTurn(event) {
    const { turn, held } = this;
    const point = this.stage.casterAt(event).ray.intersectPlane(turn.plane, new THREE.Vector3());
    if (!point) return; // beyond the horizon
    const spoke = spokeOf(point, turn.center, turn.axis);
    if (spoke.lengthSq() === 0) return;
    const sine = turn.last.clone().cross(spoke).dot(turn.axis);
    turn.total += Math.atan2(sine, turn.last.dot(spoke));
    turn.last = spoke;
    this.move(held.before + turn.total);
  }

  /** Move the joint so that the point that is held comes to the pointer's ray, as far as that is seen. */
  approach(event) {
    const { ray } = this.stage.casterAt(event);
    for (let step = 0; step < STEPS; step++) {
      const here = this.gripPoint();
      const gap = ray.closestPointToPoint(here, new THREE.Vector3()).sub(here);
      const way = this.wayOfGrip(here);
      const seen = way.clone().projectOnPlane(ray.direction);
      if (way.lengthSq() === 0) return;
      if (seen.length() < LEAST_SEEN * way.length()) {
        this.nudge(gap, way, seen, ray);
        return;
      }
      this.move(this.held.leader.jointValue[0] + gap.dot(seen) / seen.lengthSq());
    }
  }

  /** Return how the point that is held moves, for each rad or m of the joint. */
  wayOfGrip(here) {
    const { leader } = this.held;
    const robot = this.told.robot();
    const value = leader.jointValue[0];
    const step = leader.jointType === "prismatic" ? STEP * this.stage.radius : STEP;
    robot.setJoint(leader.name, [value + step]);
    const way = this.gripPoint().sub(here).divideScalar(step);
    robot.setJoint(leader.name, [value]);
    return way;
  }

  /**
   * Move the joint by a move of the pointer, where the point that is held comes towards the camera or
   * goes away from it: the side of the link that is near follows the pointer.
   */
  nudge(gap, way, seen, ray) {
    const { leader, frame } = this.held;
    let along = seen;
    if (leader.jointType !== "prismatic") {
      const axis = leader.axis.clone().transformDirection(leader.matrixWorld);
      along = axis.cross(ray.direction).negate().setLength(way.length());
    }
    const least = LEAST_SEEN * way.length();
    this.move(leader.jointValue[0] + gap.dot(along) / Math.max(along.lengthSq(), least * least));
    const beside = ray.closestPointToPoint(this.gripPoint(), new THREE.Vector3());
    this.held.grip = frame.worldToLocal(beside); // from where the next move counts
  }

  gripPoint() {
    this.held.frame.updateWorldMatrix(true, false);
    return this.held.frame.localToWorld(this.held.grip.clone());
  }

  move(value) {
    const { leader } = this.held;
    const isWhole = leader.jointType === "continuous";
    this.told.joints.move(leader, 0, isWhole ? wrapped(value) : value);
  }

  release(event) {
    if (this.held && event.pointerId === this.held.id) this.end();
  }

  /** Put the joint back where it was. */
  cancel(event) {
    if (event.key !== "Escape" || !this.held?.isMoving) return;
    event.stopPropagation();
    this.move(this.held.before);
    this.end();
  }

  end() {
    this.held = null;
    this.turn = null;
    this.stage.controls.enabled = true;
    this.told.onDrag(null, null);
  }
}

/** Return the joint that a joint follows in the end, itself if none; null if it does not move. */
export function leaderOf(joint, robot) {
  let at = joint;
  while (at?.mimicJoint) {
    if (at.multiplier === 0) return null;
    at = robot.joints.get(at.mimicJoint);
  }
  return at ?? null;
}

function canMove(joint) {
  if (!DRAGGED.includes(joint.jointType)) return false;
  return joint.jointType === "continuous" || joint.limit.upper > joint.limit.lower;
}

/** Return the part of the way from a centre to a point that is across the axis. */
const spokeOf = (point, center, axis) => point.clone().sub(center).projectOnPlane(axis);

/** Return an angle from -π to π. */
const wrapped = (angle) => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
