// The page that a notebook shows: one robot, which stays as it is. All that it needs is in the page.

import { Cache } from "three";
import { byId, h, show } from "./dom.js";
import { holdFiles } from "./files.js";
import { Joints, inState } from "./joints.js";
import { Robot } from "./robot.js";
import { Stage } from "./stage.js";

const KINDS = ["visual", "collision", "frames", "axes"];
const shown = { visual: true, collision: false, frames: false, axes: false };

let robot = null;

const say = (text) => {
  byId("empty").textContent = text;
  show(byId("empty"), Boolean(text));
};

/** Return the bytes in base64, which are compressed. */
async function unpacked(text) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

/** Return the address of some bytes. A frame may be allowed images of such addresses, and no others. */
function dataAddress(bytes, type) {
  return new Promise((settle) => {
    const reader = new FileReader();
    reader.onload = () => settle(reader.result);
    reader.readAsDataURL(new Blob([bytes], { type }));
  });
}

/** Take the files in the page: images by their addresses, all others without being fetched. */
async function readFiles(files) {
  Cache.enabled = true;
  const held = new Map();
  for (const [key, { type, data }] of Object.entries(files)) {
    const bytes = await unpacked(data);
    const isImage = type.startsWith("image/");
    const address = isImage ? await dataAddress(bytes, type) : `held:${key}`;
    if (!isImage) Cache.add(`file:${address}`, bytes);
    held.set(key, { bytes, address });
  }
  holdFiles(held);
}

// --- what the user does ---------------------------------------------------------------------------

function hover(link) {
  if (!robot || robot.highlighted.hovered === link) return;
  robot.highlight("hovered", link);
  stage.draw();
}

function select(link) {
  robot.highlight("selected", link);
  joints.mark(link);
  stage.draw();
}

function showHint(shape) {
  const joint = shape && robot.jointAbove.get(shape.link);
  byId("hint").textContent = shape ? [shape.link, joint?.name].filter(Boolean).join("  ·  ") : "";
  show(byId("hint"), Boolean(shape));
}

function toggle(kind) {
  shown[kind] = !shown[kind];
  byId(`show-${kind}`).setAttribute("aria-pressed", String(shown[kind]));
  robot?.setShown(kind, shown[kind]);
  stage.draw();
}

/** Move the joints to a named state; those that it does not name are at 0. */
function takeState(positions) {
  joints.reset();
  joints.place(inState(joints.simple(), positions), { isKept: true });
}

function showStates(states) {
  const names = Object.keys(states);
  const options = names.map((name) => h("option", { value: name }, name));
  byId("states").append(h("option", { value: "" }, "State …"), ...options);
  if (states.home) byId("states").value = "home"; // in which the robot is shown at first
  byId("states").onchange = (event) => event.target.value && takeState(states[event.target.value]);
  show(byId("states"), names.length > 0);
}

/** List what is not drawn as it is, each once. */
function showFaults(faults) {
  const lines = new Set(faults.map(([mesh, reason]) => `${mesh}: ${reason}`));
  const count = lines.size === 1 ? "1 mesh is shown as a box" : `${lines.size} meshes are shown as boxes`;
  byId("fault-count").textContent = count;
  byId("fault-list").replaceChildren(...[...lines].map((line) => h("li", {}, line)));
  show(byId("faults"), lines.size > 0);
}

/** Zoom with the wheel only after a click: otherwise it scrolls the notebook. */
function keepWheelForNotebook(canvas) {
  stage.controls.enableZoom = false;
  canvas.addEventListener("pointerdown", () => (stage.controls.enableZoom = true));
  canvas.addEventListener("pointerleave", () => (stage.controls.enableZoom = false));
}

// --- the page -------------------------------------------------------------------------------------

let stage;
let joints;

async function start() {
  const text = new TextDecoder().decode(await unpacked(byId("robot-data").textContent));
  const { states, summary, ...description } = JSON.parse(text);
  stage = new Stage(byId("canvas"), {
    onHover(object) {
      const shape = object && robot?.shapeOf(object);
      hover(shape?.link ?? null);
      showHint(shape);
    },
    onClick: (object) => robot && select((object && robot.shapeOf(object)?.link) ?? null),
  });
  joints = new Joints({ onMove: stage.draw, onHover: hover, onSelect: select });
  await readFiles(JSON.parse(byId("robot-files").textContent));
  const faults = [];
  const next = new Robot({ ...description, joints: {} }, {
    onChange: stage.draw,
    onFault: (mesh, reason) => faults.push([mesh, reason]),
  });
  await next.ready;
  robot = next;
  const sizeOf = () => robot.bounds().getSize(stage.camera.position.clone()).length() / 2;
  joints.setRobot(robot, sizeOf(), states.home);
  robot.addMarks(sizeOf());
  stage.setRobot(robot, robot.bounds());
  for (const kind of KINDS) robot.setShown(kind, shown[kind]);
  byId("name").textContent = robot.name || "robot";
  byId("summary").textContent = summary;
  showStates(states);
  showFaults(faults);
  for (const kind of KINDS) byId(`show-${kind}`).onclick = () => toggle(kind);
  for (const button of document.querySelectorAll("[data-view]")) {
    button.onclick = () => stage.look(button.dataset.view, robot.outermostPoints());
  }
  keepWheelForNotebook(byId("canvas"));
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const followTheme = () => {
    stage.setTheme(dark.matches ? "dark" : "light");
    stage.draw();
  };
  dark.addEventListener("change", followTheme);
  followTheme();
  stage.look("iso", robot.outermostPoints());
  say("");
  stage.drawNow();
}

byId("canvas").addEventListener("webglcontextlost", () => {
  say("The browser has freed this picture, as the page has many. Run the cell again to see it.");
});

start().catch((error) => {
  const isMissing = !document.createElement("canvas").getContext("webgl2");
  say(isMissing ? "This browser cannot draw in 3D: WebGL 2 is missing or turned off." : `This robot cannot be shown: ${error.message}`);
});

// For tests and for the curious: what is shown.
window.yamaro = {
  get robot() {
    return robot;
  },
  get stage() {
    return stage;
  },
};
