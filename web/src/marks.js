// Draws what no body shows: frames, joint axes, centres of mass and boxes of equal inertia.

import * as THREE from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

const AXIS_COLORS = [0xdb2930, 0x2e9e3d, 0x295cdb];
const JOINT_COLOR = 0x12a594;
const INERTIA_COLOR = 0x8057cc;
const ABOVE_BODIES = 10;
const OUTLINE = new LineMaterial({ color: 0x2563eb, linewidth: 2.2 }); // pixels
const MEASURE = new LineMaterial({ color: 0xd9480f, linewidth: 2.2, depthTest: false, transparent: true });
const MOST_OUTLINED = 60_000; // corners of a body
const SHARP = 25; // degrees between two faces that make an edge

const X = new THREE.Vector3(1, 0, 0);
const Y = new THREE.Vector3(0, 1, 0);

/** Return a frame: x red, y green, z blue, as everywhere. */
export function axesMark(length) {
  const radius = 0.022 * length;
  const parts = AXIS_COLORS.map((color, axis) => {
    const rod = new THREE.CylinderGeometry(radius, radius, length, 8).translate(0, length / 2, 0);
    const tip = new THREE.ConeGeometry(3 * radius, 0.2 * length, 10).translate(0, length, 0);
    const direction = new THREE.Vector3().setComponent(axis, 1);
    return colored(pointed(mergeGeometries([rod, tip]), direction), color);
  });
  return markOf(mergeGeometries(parts));
}

/** Return the axis of a joint: an arrow, with a ring around it if the joint turns. */
export function jointMark(axis, type, length) {
  const radius = 0.02 * length;
  const rod = new THREE.CylinderGeometry(radius, radius, 1.1 * length, 10);
  const parts = [rod, cone(radius, length, 1)];
  if (type === "prismatic") parts.push(cone(radius, length, -1));
  else parts.push(ring(length, radius));
  return markOf(colored(pointed(mergeGeometries(parts), axis), JOINT_COLOR));
}

function cone(radius, length, side) {
  const tip = new THREE.ConeGeometry(3.4 * radius, 0.24 * length, 14);
  if (side < 0) tip.rotateX(Math.PI);
  return tip.translate(0, side * 0.62 * length, 0);
}

/** Return three quarters of a ring around y, which end in a tip: the direction of positive turns. */
function ring(length, radius) {
  const around = 0.3 * length;
  const arc = 1.5 * Math.PI;
  const band = new THREE.TorusGeometry(around, 0.7 * radius, 8, 40, arc);
  const tip = new THREE.ConeGeometry(2.6 * radius, 0.17 * length, 12);
  tip.translate(around, 0, 0).rotateZ(arc);
  // A torus turns about z and starts at x; turned so, about y, from z towards x.
  return mergeGeometries([band, tip]).rotateX(-Math.PI / 2);
}

/** Return a ball at a centre of mass. */
export function centreMark(radius) {
  return markOf(colored(new THREE.SphereGeometry(radius, 20, 14), INERTIA_COLOR));
}

/** Return a box of equal inertia, as `equivalentBox` gives it; a flat one is given some height. */
export function equivalentBoxMark({ size, axes }, least) {
  const geometry = new THREE.BoxGeometry(...size.map((side) => Math.max(side, least)));
  const basis = new THREE.Matrix4().makeBasis(...axes.map((axis) => new THREE.Vector3(...axis)));
  const fill = new THREE.MeshBasicMaterial({
    color: INERTIA_COLOR,
    transparent: true,
    opacity: 0.18,
    depthWrite: false,
    depthTest: false,
  });
  const box = new THREE.Mesh(geometry, fill);
  const line = new THREE.LineBasicMaterial({
    color: INERTIA_COLOR,
    depthTest: false,
    transparent: true,
  });
  box.add(new THREE.LineSegments(new THREE.EdgesGeometry(geometry), line));
  box.quaternion.setFromRotationMatrix(basis);
  box.traverse(drawAbove);
  return box;
}

/** Return the edges of a body, or null if it has very many. */
export function outlineMark(geometry) {
  if (geometry.attributes.position.count > MOST_OUTLINED) return null;
  const edges = new THREE.EdgesGeometry(geometry, SHARP);
  const mark = new LineSegments2(new LineSegmentsGeometry().fromEdgesGeometry(edges), OUTLINE);
  mark.raycast = () => {};
  return mark;
}

/** Return a line through points that is seen through bodies. */
export function lineMark(points) {
  const geometry = new LineSegmentsGeometry().setPositions(points.flatMap((point) => point.toArray()));
  const mark = new LineSegments2(geometry, MEASURE);
  drawAbove(mark);
  return mark;
}

/** Turn a geometry that points along y to another direction. */
function pointed(geometry, direction) {
  const turn = new THREE.Quaternion();
  if (direction.dot(Y) < -0.999999) turn.setFromAxisAngle(X, Math.PI);
  else turn.setFromUnitVectors(Y, direction.clone().normalize());
  return geometry.applyQuaternion(turn);
}

function colored(geometry, hex) {
  const { r, g, b } = new THREE.Color(hex);
  const count = geometry.attributes.position.count;
  const colors = new Float32Array(3 * count);
  for (let i = 0; i < count; i++) colors.set([r, g, b], 3 * i);
  geometry.setAttribute("color", new THREE.BufferAttribute(colors, 3));
  return geometry;
}

/** Return a mesh that is seen through bodies and is no target of clicks. */
function markOf(geometry) {
  const material = new THREE.MeshBasicMaterial({
    vertexColors: true,
    depthTest: false,
    transparent: true,
    toneMapped: false,
  });
  const mark = new THREE.Mesh(geometry, material);
  drawAbove(mark);
  return mark;
}

function drawAbove(object) {
  object.renderOrder = ABOVE_BODIES;
  object.raycast = () => {};
}
