// Makes the bodies of links: geometry, material, and a mark of where each was written.

import * as THREE from "three";
import { lighten, loadMesh, loadTexture } from "./meshes.js";
import { childOf, childrenOf, numbersIn } from "./urdf.js";

// The colours of `yamaro picture`, in which a robot looks the same.
const DEFAULT_COLOR = [0.74, 0.76, 0.79, 1];
const COLLISION_COLOR = 0xed9938;
const COLLISION_EDGE = 0xd9480f;
const MOST_OUTLINED = 60_000; // corners of a mesh whose edges are drawn
const MISSING_COLOR = 0xe64d40;

/** The materials of a robot by name: those under the root, and those that links define. */
export class Materials {
  constructor(robot, textures) {
    this.byName = new Map();
    this.textures = new Map(Object.entries(textures));
    const inLinks = [...robot.querySelectorAll("link > visual > material")];
    for (const material of [...childrenOf(robot, "material"), ...inLinks]) {
      const name = material.getAttribute("name");
      const isDefined = childOf(material, "color") || childOf(material, "texture");
      if (name && isDefined && !this.byName.has(name)) this.byName.set(name, material);
    }
    // urdf-loader would load their textures by names that only the server can read.
    for (const material of childrenOf(robot, "material")) material.remove();
  }

  /** Return a new material for a visual. */
  of(visual, shape, onLoad) {
    const own = childOf(visual, "material");
    const isDefined = own && (childOf(own, "color") || childOf(own, "texture"));
    const name = own?.getAttribute("name");
    const definition = isDefined ? own : this.byName.get(name);
    const [r, g, b, a] = numbersIn(
      definition && childOf(definition, "color"),
      "rgba",
      definition && childOf(definition, "texture") ? [1, 1, 1, 1] : DEFAULT_COLOR,
    );
    const material = new THREE.MeshStandardMaterial({ roughness: 0.62, metalness: 0.05 });
    setColor(material, [r, g, b]);
    setOpacity(material, a);
    const texture = isDefined ? shape?.texture : this.textures.get(name);
    if (texture) material.map = loadTexture(texture, onLoad);
    return material;
  }
}

/**
 * Make a visual or collision.
 * @param {Element} element `<visual>` or `<collision>`
 * @param {object} shape what the server tells of it
 * @param {Materials} materials those of the robot
 * @param {object} told `onChange()` when something has appeared, `onFault(mesh, reason)`, and as
 *   `missingSide` how large a box stands for a mesh that is not there, in m
 * @returns {{group: THREE.Group, ready: Promise}} `ready` when its mesh has been loaded
 */
export function makeShape(element, shape, materials, told) {
  const group = new THREE.Group();
  const origin = childOf(element, "origin");
  group.position.fromArray(numbersIn(origin, "xyz", [0, 0, 0]));
  const [roll, pitch, yaw] = numbersIn(origin, "rpy", [0, 0, 0]);
  group.quaternion.setFromEuler(new THREE.Euler(roll, pitch, yaw, "ZYX"));

  const isCollision = element.nodeName === "collision";
  const material = isCollision
    ? collisionMaterial()
    : materials.of(element, shape, told.onChange);
  const geometry = childOf(element, "geometry")?.firstElementChild;
  const body = geometry && BODIES[geometry.nodeName];
  let ready = Promise.resolve();
  if (geometry?.nodeName === "mesh") {
    ready = addMesh(group, geometry, shape?.mesh, material, { ...told, isCollision });
  } else if (body) {
    const mesh = body(geometry);
    mesh.material = material;
    group.add(mesh);
  }
  if (isCollision) ready = ready.then(() => outline(group));
  return { group, ready };
}

/** Draw the edges of a collision's bodies, which show their form where colours mix. */
function outline(group) {
  const bodies = [];
  group.traverse((node) => node.isMesh && node.name !== "missing" && bodies.push(node));
  for (const body of bodies) {
    if (body.geometry.attributes.position.count > MOST_OUTLINED) continue;
    const line = new THREE.LineBasicMaterial({ color: COLLISION_EDGE, transparent: true, opacity: 0.9 });
    body.add(new THREE.LineSegments(new THREE.EdgesGeometry(body.geometry, 25), line));
  }
}

const number = (element, name) => numbersIn(element, name, [0])[0];

/** The simple bodies: unit bodies of three.js are turned so that their axis is z, as in URDF. */
const BODIES = {
  box: (element) => new THREE.Mesh(new THREE.BoxGeometry(...numbersIn(element, "size", [0, 0, 0]))),
  sphere: (element) =>
    new THREE.Mesh(new THREE.SphereGeometry(number(element, "radius"), 40, 28).rotateX(Math.PI / 2)),
  cylinder(element) {
    const radius = number(element, "radius");
    const geometry = new THREE.CylinderGeometry(radius, radius, number(element, "length"), 48);
    return new THREE.Mesh(geometry.rotateX(Math.PI / 2));
  },
  capsule(element) {
    const geometry = new THREE.CapsuleGeometry(
      number(element, "radius"),
      number(element, "length"),
      14,
      40,
    );
    return new THREE.Mesh(geometry.rotateX(Math.PI / 2));
  },
};

async function addMesh(group, element, file, material, told) {
  const { onChange, onFault, isCollision, missingSide } = told;
  const scale = numbersIn(element, "scale", [1, 1, 1]);
  try {
    if (!file) throw new Error("");
    if (file.fault) throw new Error(file.fault);
    const object = await loadMesh(file);
    object.traverse((node) => {
      if (node.isMesh && (isCollision || !node.material)) node.material = material;
      if (node.isLight || node.isCamera) node.visible = false;
    });
    const holder = new THREE.Group();
    holder.scale.fromArray(scale);
    holder.add(object);
    group.add(holder);
  } catch (error) {
    group.add(missingBox(missingSide));
    if (error.message) onFault(element.getAttribute("filename"), error.message);
  }
  onChange();
}

/** Return the box that stands for a mesh that is not there. */
function missingBox(side) {
  const geometry = new THREE.BoxGeometry(side, side, side);
  const fill = new THREE.MeshBasicMaterial({ color: MISSING_COLOR });
  setOpacity(fill, 0.25);
  const box = new THREE.Mesh(geometry, fill);
  const edges = new THREE.EdgesGeometry(geometry);
  box.add(new THREE.LineSegments(edges, new THREE.LineBasicMaterial({ color: MISSING_COLOR })));
  box.name = "missing";
  return box;
}

function collisionMaterial() {
  const material = new THREE.MeshStandardMaterial({ color: COLLISION_COLOR, roughness: 0.8 });
  setOpacity(material, 0.26);
  // In front of the visual of the same size, rather than flickering through it.
  material.polygonOffset = true;
  material.polygonOffsetFactor = -1;
  material.polygonOffsetUnits = -1;
  return material;
}

function setColor(material, color) {
  material.color.setRGB(...color, THREE.SRGBColorSpace);
  lighten(material);
}

function setOpacity(material, opacity) {
  material.opacity = opacity;
  material.transparent = opacity < 1;
  material.depthWrite = opacity >= 1;
}
