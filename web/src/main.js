// The page of `yamaro view`: puts the parts together.

import { follow, latestPoster, post } from "./connection.js";
import { Between } from "./between.js";
import { copy } from "./copying.js";
import { followCursor, linkAt } from "./cursor.js";
import { byId, show } from "./dom.js";
import { Downloads } from "./downloads.js";
import { JointDrag } from "./drag.js";
import { Included } from "./included.js";
import { equivalentBox } from "./inertia.js";
import { Joints } from "./joints.js";
import { Fault, Warnings } from "./messages.js";
import { Origin } from "./origin.js";
import { Panels } from "./panels.js";
import { PictureCard } from "./picture.js";
import { Poses } from "./poses.js";
import { Robot } from "./robot.js";
import { keep, recall } from "./settings.js";
import { Stage } from "./stage.js";
import { Theme } from "./theme.js";
import { Tree } from "./tree.js";
import { Variables } from "./variables.js";

const THEME_SIGNS = { auto: "◐", light: "☀", dark: "☾" };
const KINDS = ["visual", "collision", "inertia", "frames", "axes"];
const shown = { visual: true, collision: false, inertia: false, frames: false, axes: false };

let state = null; // what the server told last
let robot = null; // what stands on the stage
let builtVersion = "";
let shownVersion = 0;
let shownFile = null; // the robot's file, which is another one when the playground opens an example
let selection = { link: null, shape: null };

const stage = makeStage({
  onHover(object) {
    const shape = object && robot?.shapeOf(object);
    byId("canvas").classList.toggle("pointing", Boolean(shape));
    byId("canvas").classList.toggle("movable", Boolean(shape && drag.isOn && drag.jointOf(shape.link)));
    hover(shape?.link ?? null);
    showHint(shape);
  },
  onClick(object, event) {
    const shape = object && robot?.shapeOf(object);
    if (event.shiftKey && shape && selection.link) between.toLink(shape.link);
    else select(shape?.link ?? null, shape ?? null);
  },
});

/** Make the stage; where the browser cannot draw, say so. */
function makeStage(told) {
  try {
    return new Stage(byId("canvas"), told);
  } catch (error) {
    byId("empty").textContent = "This browser cannot draw in 3D: WebGL 2 is missing or turned off.";
    throw error;
  }
}

const tree = new Tree({ onSelect: (link) => select(link), onHover: hover });
const joints = new Joints({
  onMove: onPose,
  onChoose: () => poses.interrupt(),
  onHover: hover,
  onSelect: (link) => select(link),
});
const origin = new Origin({ onOpen: openPlace, onClose: () => select(null) });
const fault = new Fault({ onOpen: openPlace });
const warnings = new Warnings({ onSelect: selectOwner, onOpen: openPlace });
const downloads = new Downloads();
const poses = new Poses({ joints, onCopied: onPoseCopied });
const between = new Between({ stage, onCopied: () => notify("copied"), onSwap: swapBetween });
const picture = new PictureCard({ stage, robot: () => robot, onSaved: notify });
const drag = new JointDrag(stage, { robot: () => robot, joints, onDrag });
new Panels();
const sendVariables = latestPoster("variables", (refusal) => notify(refusal));
const variables = new Variables({
  onChange: sendVariables,
  onOpen: (name) => openPlace({ variable: name, text: name }),
  onCopied: () => notify("copied"),
});
const included = new Included({ variables, onOpen: openPlace });

// --- what the server tells ------------------------------------------------------------------------

async function onState(next) {
  state = next;
  document.body.dataset.editor = next.editor ?? "";
  const title = next.file.split(/[\\/]/).pop();
  document.title = `${next.fault ? "✗ " : ""}${title} · yamaro`;
  byId("file").textContent = next.file;
  byId("file").title = next.file;
  byId("time").textContent = next.fault ? "not built" : `built in ${Math.round(next.milliseconds)} ms`;
  variables.set(next.variables, title, next.hasMore);
  included.setBuild(next.hasMore);
  fault.set(next.fault, Boolean(next.robot));
  show(byId("empty"), !next.robot && !next.fault);
  // The playground opens other files in one page, and counts their robots from 1 each time.
  const version = `${next.opening ?? 0}.${next.robotVersion}`;
  if (next.robot && version !== builtVersion) {
    builtVersion = version;
    try {
      await build(next.robot, version);
    } catch (error) {
      fault.set({ fault: `this robot cannot be shown: ${error.message}`, diagnostics: [] }, true);
    }
  }
  shownVersion = Math.max(shownVersion, next.version);
}

/** Put a robot on the stage once its meshes are there, unless a newer one has come meanwhile. */
async function build(description, version) {
  const faults = [];
  const next = new Robot(description, {
    onChange: stage.draw,
    onFault: (mesh, reason) => faults.push([mesh, reason]),
  });
  await next.ready;
  if (version !== builtVersion) {
    next.dispose();
    return;
  }
  const isOther = robot === null || state.file !== shownFile || isUnlike(robot, next);
  shownFile = state.file;
  robot?.dispose();
  robot = next;
  tree.setRobot(robot);
  joints.setRobot(robot, sizeOf(robot), description.states?.home);
  const bounds = robot.bounds();
  robot.addMarks(sizeOf(robot));
  stage.setRobot(robot, bounds);
  for (const kind of KINDS) robot.setShown(kind, shown[kind]);
  const points = robot.outermostPoints();
  if (isOther) stage.look("iso", points);
  else if (!stage.isMoved && !stage.sees(points)) stage.look(stage.view, points);
  joints.restore();
  poses.setRobot(robot);
  between.setRobot(robot);
  warnings.set(description.diagnostics, description.places);
  for (const [mesh, reason] of faults) warnings.addMeshFault(mesh, reason);
  byId("name").textContent = robot.name || "robot";
  byId("cell").textContent = `grid ${cellText(stage.cell)}`;
  select(!isOther && robot.links.has(selection.link) ? selection.link : null, selection.shape);
  stage.drawNow();
}

/** Return whether less than half of the links of two robots have the same names: it is another one. */
function isUnlike({ links }, { links: others }) {
  const common = [...links.keys()].filter((name) => others.has(name)).length;
  return 2 * common < Math.max(links.size, others.size);
}

/** Return half of the diagonal of the box around a robot, in m. */
const sizeOf = (shown) => shown.bounds().getSize(stage.camera.position.clone()).length() / 2;

const cellText = (meters) =>
  meters >= 1 ? `${meters} m` : meters >= 0.01 ? `${Math.round(100 * meters)} cm` : `${Number((1000 * meters).toPrecision(2))} mm`;

function onConnection(isConnected) {
  byId("status").classList.toggle("lost", !isConnected);
  byId("status").title = isConnected ? "shows each save" : "yamaro view has ended";
  show(byId("lost"), !isConnected);
}

// --- what the user does ---------------------------------------------------------------------------

function hover(link) {
  if (!robot || robot.highlighted.hovered === link) return;
  robot.highlight("hovered", link);
  tree.mark("hovered", link);
  stage.draw();
}

function select(link, shape = null) {
  const body = shape && robot?.shapes.find(
    (each) => each.link === shape.link && each.kind === shape.kind && each.index === shape.index,
  );
  selection = { link, shape: body ?? null };
  robot?.highlight("selected", link);
  tree.mark("selected", link);
  joints.mark(link);
  origin.set(robot, link, body);
  byId("between-from").textContent = link ?? "";
  between.fromLink(link);
  stage.draw();
}

function swapBetween(from, to) {
  select(from);
  between.toLink(to);
}

/** The joints have moved. */
function onPose() {
  poses.showChosen();
  between.update();
  stage.draw();
}

function onPoseCopied(format, left) {
  const missing = left ? `, without ${left} whose names have commas` : "";
  notify(`copied as ${{ state: "YAML", picture: "--joints", json: "JSON" }[format]}${missing}`);
}

/** Show the position of the joint that is dragged beside the pointer. */
function onDrag(joint, event) {
  const value = byId("drag-value");
  show(value, Boolean(joint));
  byId("canvas").classList.toggle("dragging", Boolean(joint));
  if (!joint) return;
  value.textContent = `${joint.name} ${joints.shownValue(joint)}`;
  const frame = byId("canvas").getBoundingClientRect();
  value.style.left = `${Math.min(event.clientX - frame.left + 14, frame.width - value.offsetWidth - 8)}px`;
  value.style.top = `${Math.max(event.clientY - frame.top - 34, 8)}px`;
}

function setDrag(isOn) {
  drag.isOn = isOn;
  byId("drag").setAttribute("aria-pressed", String(isOn));
  keep("drag", isOn ? "on" : "off");
}

/** Select the link that a warning is about; of a joint, the link that it moves. */
function selectOwner({ link, joint }) {
  const below = [...(robot?.jointAbove ?? [])].find(([, each]) => each.name === joint);
  select(link ?? below?.[0] ?? null);
}

async function openPlace({ place, variable, text, version: given, isFault = false }) {
  if (!state.editor) {
    const plain = variable ? `${state.file} ${variable}` : text;
    if (await copy(plain)) notify(`copied ${plain}`);
    return;
  }
  const version = given ?? (isFault ? state.version : state.robotVersion);
  const refusal = await post("open", variable ? { variable } : { place, version, isFault });
  if (refusal) notify(refusal);
}

let noteTimer = 0;
function notify(text) {
  byId("note").textContent = text;
  show(byId("note"), true);
  clearTimeout(noteTimer);
  noteTimer = setTimeout(() => show(byId("note"), false), 2500);
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

function showPane(name) {
  document.body.dataset.pane = name;
  for (const tab of document.querySelectorAll("#tabs button")) {
    tab.setAttribute("aria-selected", String(tab.dataset.pane === name));
  }
}

function onKey(event) {
  if (event.target.closest("input, textarea, select, dialog") || event.ctrlKey || event.metaKey || event.altKey) return;
  const leave = () => {
    if (!picture.card.hidden) picture.close();
    else if (!downloads.card.hidden) downloads.toggle(false);
    else select(null);
  };
  const actions = { f: () => look("iso"), r: () => joints.reset(), t: () => theme.next(), Escape: leave };
  Object.assign(actions, { d: () => setDrag(!drag.isOn), p: () => picture.take() });
  KINDS.forEach((kind, index) => (actions[String(index + 1)] = () => toggle(kind)));
  if (event.key === "/") {
    event.preventDefault();
    byId("tree-search").focus();
  }
  actions[event.key]?.();
}

const look = (view) => robot && stage.look(view, robot.outermostPoints());

byId("drag").onclick = () => setDrag(!drag.isOn);
setDrag(recall("drag") !== "off");
byId("time").onclick = () => post("rebuild", {});
for (const kind of KINDS) byId(`show-${kind}`).onclick = () => toggle(kind);
for (const button of document.querySelectorAll("[data-view]")) {
  button.onclick = () => look(button.dataset.view);
}
for (const tab of document.querySelectorAll("#tabs button")) {
  tab.onclick = () => showPane(tab.dataset.pane);
}
document.addEventListener("keydown", onKey);
showPane("joints");

const theme = new Theme((colors, chosen) => {
  stage.setTheme(colors);
  stage.draw();
  byId("theme").textContent = THEME_SIGNS[chosen];
  byId("theme").title = `Colours: ${chosen} (t)`;
  byId("theme").setAttribute("aria-label", `Colours: ${chosen}`);
});
byId("theme").onclick = () => theme.next();
follow(onState, onConnection);
followCursor((file, line) => {
  const link = robot && linkAt(robot, file, line);
  if (link && link !== selection.link) select(link);
});

// For tests and for the curious: what is shown, in numbers.
window.yamaro = {
  get version() {
    return shownVersion;
  },
  get robot() {
    return robot;
  },
  get stage() {
    return stage;
  },
  /** Return the pose of a link in the root's frame, row by row. */
  pose(link) {
    robot.object.updateMatrixWorld(true);
    return robot.links.get(link).matrixWorld.clone().transpose().toArray();
  },
  setJoint: (name, ...values) => values.forEach((value, index) => joints.move(robot.joints.get(name), index, value)),
  equivalentBox,
};
