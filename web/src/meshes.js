// Loads meshes and textures, each once for as long as its file stays as it is.

import * as THREE from "three";
import { ColladaLoader } from "three/addons/loaders/ColladaLoader.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { MTLLoader } from "three/addons/loaders/MTLLoader.js";
import { OBJLoader } from "three/addons/loaders/OBJLoader.js";
import { STLLoader } from "three/addons/loaders/STLLoader.js";
import { TGALoader } from "three/addons/loaders/TGALoader.js";
import { toCreasedNormals } from "three/addons/utils/BufferGeometryUtils.js";
import { addressOf, bytesOf } from "./files.js";

const CREASE = Math.PI / 6;
const MOST_CREASED = 300_000; // corners; larger meshes are shown as they are

const MOST_METALNESS = 0.3;
const DARKEST = 0.05; // how bright black is drawn, so that its form is seen: as in `yamaro picture`

const loaded = new Map();
const textures = new Map();
let wanted = new Set();

/** Begin a robot: what it does not ask for until `endRobot` is forgotten. */
export function beginRobot() {
  wanted = new Set();
}

/** Forget the meshes that the robot does not have any more. */
export function endRobot() {
  for (const cache of [loaded, textures]) {
    for (const key of cache.keys()) if (!wanted.has(key)) cache.delete(key);
  }
}

/**
 * Load a mesh.
 * @param {{key: string, ending: string, companions: object}} file what the server tells of it
 * @returns {Promise<THREE.Object3D>} an object of its own; materials that the mesh does not bring
 *   itself are null
 */
export async function loadMesh(file) {
  wanted.add(file.key);
  if (!loaded.has(file.key)) loaded.set(file.key, parse(file));
  return cloned(await loaded.get(file.key));
}

/** Return a texture, which appears once it is loaded. */
export function loadTexture(file, onLoad) {
  wanted.add(file.key);
  if (!textures.has(file.key)) {
    const loader = file.ending === ".tga" ? new TGALoader() : new THREE.TextureLoader();
    const texture = loader.load(addressOf(file.key), onLoad, undefined, () => {});
    texture.colorSpace = THREE.SRGBColorSpace;
    textures.set(file.key, texture);
  }
  return textures.get(file.key);
}

/** Return a manager that gives a mesh the files that its names stand for, and no others. */
function managerOf(file) {
  const manager = new THREE.LoadingManager();
  const companions = new Map(Object.entries(file.companions));
  manager.addHandler(/\.tga$/i, new TGALoader(manager));
  manager.setURLModifier((url) => {
    if (/^(blob|data):/.test(url)) return url;
    const name = decodeURI(url).replace(/^(\.\/)+/, "");
    const key = companions.get(name) ?? companions.get(url);
    return key ? addressOf(key) : "data:,";
  });
  return manager;
}

async function parse(file) {
  const data = await bytesOf(file.key);
  const text = () => new TextDecoder().decode(data);
  const manager = managerOf(file);
  switch (file.ending) {
    case ".stl":
      return meshOf(new STLLoader(manager).parse(data));
    case ".dae":
      return ofCollada(new ColladaLoader(manager).parse(text(), ""));
    case ".obj":
      return ofObj(text(), file, manager);
    case ".gltf":
    case ".glb": {
      const { scene } = await new GLTFLoader(manager).parseAsync(data, "");
      return scene;
    }
    default:
      throw new Error(`a file ending in ${file.ending || "nothing"} is no mesh that can be shown`);
  }
}

/** Return the mesh of an STL; it has a normal for each face, which rounds nothing. */
function meshOf(geometry) {
  if (!geometry.attributes.position?.count) throw new Error("it holds no triangles");
  const isSmall = geometry.attributes.position.count < MOST_CREASED;
  const smooth = isSmall && !geometry.hasColors ? toCreasedNormals(geometry, CREASE) : geometry;
  return new THREE.Mesh(smooth, null);
}

/**
 * Return the scene of a COLLADA file as RViz shows it: scaled by its unit, and not turned, whichever
 * axis it says is up.
 */
function ofCollada(collada) {
  if (!collada) throw new Error("it is no COLLADA");
  collada.scene.quaternion.identity();
  return collada.scene;
}

async function ofObj(text, file, manager) {
  const loader = new OBJLoader(manager);
  const names = Object.keys(file.companions).filter((name) => /\.mtl$/i.test(name));
  if (names.length) {
    const text = new TextDecoder().decode(await bytesOf(file.companions[names[0]]));
    const materials = new MTLLoader(manager).parse(text, "");
    materials.preload();
    loader.setMaterials(materials);
  }
  const group = loader.parse(text);
  if (!names.length) {
    group.traverse((node) => {
      if (node.isMesh && !node.geometry.hasAttribute("color")) node.material = null;
    });
  }
  return group;
}

/** Make the colour of a material a little lighter if it is dark. */
export function lighten({ color }) {
  const parts = color.getRGB({}, THREE.SRGBColorSpace);
  const [r, g, b] = [parts.r, parts.g, parts.b].map((part) => DARKEST + (1 - DARKEST) * part);
  color.setRGB(r, g, b, THREE.SRGBColorSpace);
}

/** Return a copy with materials of its own, since what is selected is shown in another colour. */
function cloned(original) {
  const copy = original.clone(true);
  copy.traverse((node) => {
    if (!node.isMesh || !node.material) return;
    const isList = Array.isArray(node.material);
    node.material = isList ? node.material.map(ownMaterial) : ownMaterial(node.material);
  });
  return copy;
}

/** Return a copy of a material; metal is made duller, since there is nothing here to mirror. */
function ownMaterial(material) {
  const own = material.clone();
  if (own.color && !own.map) lighten(own);
  if ("metalness" in own) own.metalness = Math.min(own.metalness, MOST_METALNESS);
  return own;
}
