// The stage on which the robot stands: camera, light, ground. It draws only when something changes.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { FIELD_OF_VIEW, fitted } from "./cameras.js";
import { oncePerFrame } from "./dom.js";

export const CLICK_DISTANCE = 5; // pixels that a click may wander
const GRID_CELLS = 40;
const CELLS_ACROSS = 8; // the robot
const COLORS = {
  light: { grid: 0x9aa4b2, gridOpacity: 0.55, shadow: 0.2, sky: 0xffffff, ground: 0xb9c2cf },
  dark: { grid: 0x8b98a9, gridOpacity: 0.42, shadow: 0.42, sky: 0xe8efff, ground: 0x39414d },
};

export class Stage {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {object} told `onHover(object)`, `onClick(object, event)`; null where nothing is
   */
  constructor(canvas, told) {
    this.canvas = canvas;
    this.told = told;
    this.scene = new THREE.Scene();
    this.renderer = new THREE.WebGLRenderer({
      canvas,
      antialias: true,
      alpha: true,
      preserveDrawingBuffer: false,
    });
    this.renderer.toneMapping = THREE.NeutralToneMapping;
    this.renderer.toneMappingExposure = 1.0;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.camera = new THREE.PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.draw());
    this.controls.addEventListener("start", () => (this.isMoved = true)); // by the user
    this.holder = new THREE.Group();
    this.scene.add(this.holder);
    this.draw = oncePerFrame(() => this.drawNow());
    this.frames = 0;
    this.Box3 = THREE.Box3;
    this.ground = 0;
    this.radius = 1;
    this.addLights();
    this.setTheme("light");
    this.followPointer();
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
    this.look("iso", [new THREE.Vector3(-0.5, -0.5, 0), new THREE.Vector3(0.5, 0.5, 1)]);
  }

  addLights() {
    this.sky = new THREE.HemisphereLight(0xffffff, 0xb9c2cf, 1.9);
    this.sun = new THREE.DirectionalLight(0xfff8ef, 2.5);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 3;
    this.fill = new THREE.DirectionalLight(0xdbe7ff, 0.8);
    this.scene.add(this.sky, this.sun, this.sun.target, this.fill);
  }

  /** Use the colours of "light" or "dark"; what is behind the robot is the page's own colour. */
  setTheme(theme) {
    this.theme = COLORS[theme];
    this.sky.color.setHex(this.theme.sky);
    this.sky.groundColor.setHex(this.theme.ground);
    this.layGround();
  }

  /** Lay a grid and a floor that takes shadows, in a size that suits the robot. */
  layGround() {
    this.floor?.removeFromParent();
    for (const part of this.floor?.children ?? []) {
      part.geometry.dispose();
      part.material.dispose();
    }
    this.floor = new THREE.Group();
    const cell = gridCell(this.radius);
    const grid = gridOf(cell, this.theme);
    const shadow = new THREE.Mesh(
      new THREE.PlaneGeometry(GRID_CELLS * cell, GRID_CELLS * cell),
      new THREE.ShadowMaterial({ opacity: this.theme.shadow, depthWrite: false }),
    );
    shadow.receiveShadow = true;
    shadow.position.z = -1e-3 * this.radius;
    shadow.renderOrder = -1;
    for (const part of [grid, shadow]) part.raycast = () => {};
    this.floor.add(shadow, grid);
    this.floor.position.z = this.ground;
    this.floor.visible = this.holder.children.length > 0;
    this.scene.add(this.floor);
    this.cell = cell;
  }

  /** Put a robot on the stage in place of the one before. */
  setRobot(robot, bounds) {
    this.holder.clear();
    this.holder.add(robot.object);
    this.fit(bounds);
    this.castShadows(robot);
    this.floor.visible = true;
    this.draw();
  }

  /** Fit light and ground to the robot's size. */
  fit(bounds) {
    const sphere = bounds.getBoundingSphere(new THREE.Sphere());
    this.radius = Math.max(sphere.radius, 1e-3);
    this.ground = Math.abs(bounds.min.z) < 0.02 * this.radius ? 0 : bounds.min.z;
    this.layGround();
    const { center } = sphere;
    const reach = 1.35 * this.radius;
    this.sun.position.copy(center).add(new THREE.Vector3(1.5, 1.1, 3.2).setLength(4 * reach));
    this.sun.target.position.copy(center);
    this.fill.position.copy(center).add(new THREE.Vector3(-2, -2.4, 1).setLength(4 * reach));
    const shadow = this.sun.shadow.camera;
    Object.assign(shadow, { left: -reach, right: reach, top: reach, bottom: -reach });
    Object.assign(shadow, { near: 0.5 * reach, far: 8 * reach });
    shadow.updateProjectionMatrix();
    this.sun.shadow.normalBias = 0.004 * this.radius;
    this.sun.shadow.bias = -0.0004;
  }

  /** Let the bodies that are seen as they are cast shadows. */
  castShadows(robot) {
    for (const { kind, group } of robot.shapes) {
      group.traverse((node) => {
        if (!node.isMesh) return;
        const isSolid = [node.material].flat().every((each) => each && !each.transparent);
        node.castShadow = node.receiveShadow = kind === "visual" && isSolid;
      });
    }
  }

  /**
   * Look at points in the world from one of the `VIEWS`, from as far as shows all of them, also
   * when the page gets another size, until the user moves the camera.
   */
  look(view, points) {
    this.view = view;
    this.points = points;
    this.isMoved = false;
    const { position, target } = fitted(view, points, this.camera.aspect);
    this.controls.target.copy(target);
    this.camera.position.copy(position);
    if (view === "top") this.camera.position.x -= 1e-4 * position.distanceTo(target); // x points up
    this.controls.update();
    this.draw();
  }

  /** Return whether points in the world are in the picture. */
  sees(points) {
    this.camera.updateMatrixWorld();
    return points.every((point) => {
      const { x, y } = point.clone().project(this.camera);
      return Math.abs(x) <= 1 && Math.abs(y) <= 1;
    });
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (this.points && !this.isMoved) this.look(this.view, this.points);
    this.drawNow();
  }

  drawNow() {
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = Math.max(distance - 6 * this.radius, 0.002 * distance);
    this.camera.far = distance + 60 * this.radius;
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
    this.frames += 1;
  }

  // --- pointing ---------------------------------------------------------------------------------

  followPointer() {
    let pressed = null;
    let last = null;
    const hover = oncePerFrame(() => {
      if (last && !pressed) this.told.onHover(this.hit(last));
    });
    this.canvas.addEventListener("pointerdown", (event) => (pressed = event));
    this.canvas.addEventListener("pointermove", (event) => {
      last = event;
      if (event.pointerType === "mouse") hover();
    });
    this.canvas.addEventListener("pointerleave", () => {
      last = null;
      this.told.onHover(null);
    });
    window.addEventListener("pointerup", (event) => {
      const start = pressed;
      pressed = null;
      if (!start || event.target !== this.canvas || event.button !== 0) return;
      const way = Math.hypot(event.clientX - start.clientX, event.clientY - start.clientY);
      if (way < CLICK_DISTANCE) this.told.onClick(this.hit(event), event);
    });
  }

  /** Return the body that is seen at a pointer's place, or null. */
  hit(event) {
    return this.hitAt(event)?.object ?? null;
  }

  /** Return the body and the point on it that are seen at a pointer's place, or null. */
  hitAt(event) {
    const hits = this.casterAt(event).intersectObject(this.holder, true);
    return hits.find(({ object }) => isSeen(object) && object.isMesh) ?? null;
  }

  /** Return what casts a ray from the camera through a pointer's place. */
  casterAt({ clientX, clientY }) {
    const frame = this.canvas.getBoundingClientRect();
    const point = new THREE.Vector2(
      (2 * (clientX - frame.left)) / frame.width - 1,
      1 - (2 * (clientY - frame.top)) / frame.height,
    );
    const caster = new THREE.Raycaster();
    caster.setFromCamera(point, this.camera);
    return caster;
  }
}

function isSeen(object) {
  for (let node = object; node; node = node.parent) if (!node.visible) return false;
  return true;
}

/** Return the lines of a grid, which fade away with the distance from the middle. */
function gridOf(cell, theme) {
  const half = GRID_CELLS / 2;
  const { r, g, b } = new THREE.Color(theme.grid);
  const points = [];
  const colors = [];
  const add = (x, y) => {
    points.push(x * cell, y * cell, 0);
    const distance = Math.hypot(x, y) / half;
    colors.push(r, g, b, theme.gridOpacity * Math.max(0, 1 - distance ** 2));
  };
  for (let line = -half; line <= half; line++) {
    for (let start = -half; start < half; start++) {
      add(line, start);
      add(line, start + 1);
      add(start, line);
      add(start + 1, line);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(colors, 4));
  const material = new THREE.LineBasicMaterial({
    vertexColors: true,
    transparent: true,
    depthWrite: false,
  });
  return new THREE.LineSegments(geometry, material);
}

/** Return 1, 2 or 5 times a power of ten, in m: the side of a cell for a robot of that radius. */
function gridCell(radius) {
  const wanted = (2 * radius) / CELLS_ACROSS;
  const power = 10 ** Math.floor(Math.log10(wanted));
  return power * ([1, 2, 5].find((step) => step * power >= wanted) ?? 10);
}
