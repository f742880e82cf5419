// A robot as three.js shows it: links and joints by urdf-loader, bodies and marks by us.

import * as THREE from "three";
import URDFLoader from "urdf-loader";
import { outermost } from "./cameras.js";
import { equivalentBox } from "./inertia.js";
import { beginRobot, endRobot } from "./meshes.js";
import { axesMark, centreMark, equivalentBoxMark, jointMark, outlineMark } from "./marks.js";
import { Materials, makeShape } from "./shapes.js";
import { byName, childOf, childrenOf, numbersIn, parseWith, readUrdf } from "./urdf.js";

const MISSING_SHARE = 0.07; // of the robot's size
const USUAL_SIDE = 0.1; // m, where it has none
const HIGHLIGHT = { hovered: [0x3b82f6, 0.16], selected: [0x3b82f6, 0.24] };

/** One robot. Its object is ready at once; meshes appear in it when they are loaded. */
export class Robot {
  /**
   * @param {object} description what the server tells
   * @param {object} told `onChange()`, and `onFault(mesh, reason)`
   */
  constructor(description, told) {
    this.description = description;
    this.linksKnown = new Map(Object.entries(description.links));
    this.jointsKnown = new Map(Object.entries(description.joints));
    const { robot, roots, dropped } = readUrdf(description.urdf);
    this.element = robot;
    this.roots = roots;
    this.dropped = dropped;
    this.name = robot.getAttribute("name") ?? "";
    this.materials = new Materials(robot, description.textures);
    const loader = new URDFLoader();
    loader.parseVisual = loader.parseCollision = false;
    this.object = parseWith(loader, robot);
    this.object.name = this.name;
    this.links = byName(this.object.links);
    this.joints = byName(this.object.joints);
    for (const joint of this.joints.values()) joint.ignoreLimits = true;
    this.jointAbove = new Map();
    this.shapes = []; // {kind, link, index, group}
    this.marks = { inertia: [], frames: [], axes: [] };
    this.masses = new Map();
    this.highlighted = { hovered: null, selected: null };
    this.outlines = [];
    this.corners = new Map(); // geometry → its outermost corners
    this.ready = this.addShapes(told);
  }

  /** Add the bodies of all links. */
  addShapes(told) {
    beginRobot();
    const pending = [];
    const all = { ...told, missingSide: this.missingSide() };
    for (const link of childrenOf(this.element, "link")) {
      const name = link.getAttribute("name");
      const known = this.linksKnown.get(name);
      for (const kind of ["visual", "collision"]) {
        childrenOf(link, kind).forEach((element, index) => {
          const { group, ready } = makeShape(element, known?.[kind]?.[index], this.materials, all);
          group.visible = kind === "visual";
          this.links.get(name).add(group);
          this.shapes.push({ kind, link: name, index, group });
          pending.push(ready);
        });
      }
    }
    for (const joint of this.joints.values()) {
      this.jointAbove.set(childOf(joint.urdfNode, "child").getAttribute("link"), joint);
    }
    return Promise.all(pending).then(endRobot);
  }

  /** Return how large a box is to be that stands for a mesh: small beside the robot. */
  missingSide() {
    const size = this.frameBounds().getSize(new THREE.Vector3()).length();
    return size > 0 ? MISSING_SHARE * size : USUAL_SIDE;
  }

  /** Return the box around the frames of all links. */
  frameBounds() {
    this.object.updateMatrixWorld(true);
    const points = [...this.links.values()].map((link) =>
      new THREE.Vector3().setFromMatrixPosition(link.matrixWorld),
    );
    return new THREE.Box3().setFromPoints(points);
  }

  /** Return the size of the robot as shown: the box around its bodies, in the world. */
  bounds() {
    this.object.updateMatrixWorld(true);
    const box = new THREE.Box3();
    for (const kind of ["visual", "collision"]) {
      for (const shape of this.shapes) if (shape.kind === kind) box.expandByObject(shape.group);
      if (!box.isEmpty()) return box;
    }
    const frames = this.frameBounds();
    return frames.isEmpty() ? box.set(new THREE.Vector3(), new THREE.Vector3()) : frames;
  }

  /** Return points of the robot as it stands, which have to be in a picture of it, in the world. */
  outermostPoints() {
    this.object.updateMatrixWorld(true);
    const found = [];
    let isWhole = true;
    for (const kind of ["visual", "collision"]) {
      for (const { group } of this.shapes.filter((shape) => shape.kind === kind)) {
        group.traverse((node) => {
          if (node.name === "missing") isWhole = false;
          if (!node.isMesh || node.isLineSegments2) return;
          const corners = this.corners.get(node.geometry) ?? outermost(node.geometry);
          this.corners.set(node.geometry, corners);
          for (const corner of corners) found.push(corner.clone().applyMatrix4(node.matrixWorld));
        });
      }
      if (found.length) break;
    }
    if (found.length && isWhole) return found;
    for (const link of this.links.values()) {
      found.push(new THREE.Vector3().setFromMatrixPosition(link.matrixWorld));
    }
    return found.length ? found : [new THREE.Vector3()];
  }

  /** Add frames, joint axes and inertias in a size that suits the robot. */
  addMarks(size) {
    const scale = Math.max(size, 1e-3);
    for (const [name, link] of this.links) {
      if (link.urdfNode.getAttribute("name") !== name) continue; // a second root
      this.addMark("frames", link, axesMark(0.075 * scale));
      this.addInertia(name, link, scale);
    }
    for (const joint of this.joints.values()) {
      if (joint.jointType === "fixed" || joint.jointType === "floating") continue;
      const child = this.links.get(childOf(joint.urdfNode, "child").getAttribute("link"));
      this.addMark("axes", child, jointMark(joint.axis, joint.jointType, 0.13 * scale));
    }
  }

  addMark(kind, parent, mark) {
    mark.visible = false;
    parent.add(mark);
    this.marks[kind].push(mark);
  }

  addInertia(name, link, scale) {
    const inertial = childOf(link.urdfNode, "inertial");
    if (!inertial) return;
    const mass = numbersIn(childOf(inertial, "mass"), "value", [NaN])[0];
    this.masses.set(name, mass);
    const tensor = childOf(inertial, "inertia");
    const entries = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
    const box = equivalentBox(
      mass,
      entries.map((entry) => numbersIn(tensor, entry, [0])[0]),
    );
    const origin = childOf(inertial, "origin");
    const frame = new THREE.Group();
    frame.position.fromArray(numbersIn(origin, "xyz", [0, 0, 0]));
    const [roll, pitch, yaw] = numbersIn(origin, "rpy", [0, 0, 0]);
    frame.quaternion.setFromEuler(new THREE.Euler(roll, pitch, yaw, "ZYX"));
    frame.add(centreMark(0.011 * scale));
    if (box) frame.add(equivalentBoxMark(box, 0.002 * scale));
    this.addMark("inertia", link, frame);
  }

  /** Show or hide "visual", "collision", "inertia", "frames" or "axes". */
  setShown(kind, isShown) {
    if (kind in this.marks) for (const mark of this.marks[kind]) mark.visible = isShown;
    for (const shape of this.shapes) if (shape.kind === kind) shape.group.visible = isShown;
  }

  /** Set the position of a joint: rad or m; of a planar one x, y, angle; of a floating one six. */
  setJoint(name, values) {
    const joint = this.joints.get(name);
    if (!joint || joint.jointType === "fixed") return;
    joint.setJointValue(...values);
    if (joint.jointType === "planar" || joint.jointType === "floating") place(joint, values);
  }

  /** Return what a body of the robot belongs to. */
  shapeOf(object) {
    for (let node = object; node; node = node.parent) {
      const shape = this.shapes.find((each) => each.group === node);
      if (shape) return shape;
    }
    return null;
  }

  /** Mark a link as "hovered" or "selected"; null marks none. */
  highlight(how, link) {
    if (this.highlighted[how] === link) return;
    this.highlighted[how] = link;
    if (how === "selected") this.outline(link);
    for (const shape of this.shapes) {
      const { hovered, selected } = this.highlighted;
      const state = shape.link === selected ? "selected" : shape.link === hovered ? "hovered" : "";
      shape.group.traverse((node) => node.isMesh && node.material && tint(node.material, state));
    }
  }

  /** Draw the edges of a link's bodies. */
  outline(link) {
    for (const mark of this.outlines) {
      mark.removeFromParent();
      mark.geometry.dispose();
    }
    this.outlines = [];
    for (const { group } of this.shapes.filter((shape) => shape.link === link)) {
      const bodies = [];
      group.traverse((node) => node.isMesh && bodies.push(node));
      for (const body of bodies) {
        const mark = outlineMark(body.geometry);
        if (!mark) continue;
        body.add(mark);
        this.outlines.push(mark);
      }
    }
  }

  /** Free what the graphics card holds. */
  dispose() {
    this.object.removeFromParent();
    this.object.traverse((node) => {
      node.geometry?.dispose();
      for (const material of [node.material].flat()) material?.dispose();
    });
  }
}

/** Move a joint of several degrees of freedom: its value comes after its origin. */
function place(joint, values) {
  joint.position.copy(joint.origPosition);
  joint.quaternion.copy(joint.origQuaternion);
  const offset = new THREE.Vector3();
  const turn = new THREE.Quaternion();
  if (joint.jointType === "planar") {
    const plane = new THREE.Quaternion().setFromUnitVectors(
      new THREE.Vector3(0, 0, 1),
      joint.axis,
    );
    offset.set(values[0], values[1], 0).applyQuaternion(plane);
    turn.setFromAxisAngle(joint.axis, values[2]);
  } else {
    offset.fromArray(values);
    turn.setFromEuler(new THREE.Euler(values[3], values[4], values[5], "ZYX"));
  }
  joint.position.add(offset.applyQuaternion(joint.origQuaternion));
  joint.quaternion.multiply(turn);
}

function tint(materials, state) {
  for (const material of [materials].flat()) {
    if (!material.emissive) continue;
    material.userData.ownEmissive ??= [material.emissive.getHex(), material.emissiveIntensity];
    const [color, intensity] = HIGHLIGHT[state] ?? material.userData.ownEmissive;
    material.emissive.setHex(color);
    material.emissiveIntensity = intensity;
  }
}
