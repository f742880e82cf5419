// The playground: an editor, the robot, and what is written of it.

import { byId, h, show } from "../../src/dom.js";
import { diagnosticText } from "../../src/messages.js";
import { Theme } from "../../src/theme.js";
import { Editor, Output } from "./editor.js";
import { Runner } from "./runner.js";
import { recall, remember } from "./kept.js";
import { fromHash, toHash } from "./share.js";

const PAUSE = 250; // milliseconds without a key after which the robot is built
const FORMATS = { xml: "URDF", mjcf: "MJCF", sdf: "SDF" };

let project = null; // {title, main, files, isTrusted}
let examples = [];
const kept = new Map(); // projects that were changed, or came with a link, and gave way to others
let isChanged = false; // whether the text differs from what was opened
let diagnostics = [];
let pane = "robot";
let hasState = false;
let openings = 0; // how often files were opened: Python counts the robots of each from 1
let built = 0; // how many answers to builds were shown, for tests
const viewer = byId("viewer");
const output = new Output(byId("output"));

// --- the robot --------------------------------------------------------------------------------

/** Wait until the viewer shows a robot that was built before; at most 3 s. */
async function firstRobot() {
  const start = performance.now();
  while (performance.now() - start < 3000) {
    if (project && !project.state) return;
    if (byId("viewer").contentWindow?.yamaro?.robot) return;
    await new Promise((settle) => setTimeout(settle, 30));
  }
}

const runner = new Runner({
  onStart: () => setStatus("ready"),
  onRestart: () => {
    setStatus("starting");
    mustOpen = true; // once the text has changed: this one would hang again
  },
  onFailure: () => {
    setStatus("Python is not running");
    mustOpen = true;
  },
}, firstRobot());
let mustOpen = false;

const opened = () => ({ files: editor.texts(), main: project.main, isTrusted: project.isTrusted });

function setStatus(status) {
  document.body.dataset.status = status;
  byId("status").textContent = { starting: "starting Python …", busy: "building …", ready: "" }[status] ?? status;
}

let isBusy = false;
let next = null; // what is to be asked once the worker is free

/** Have the robot built; of several that wait, only the last one counts. */
async function build(method, content) {
  const isOpening = mustOpen || next?.method === "open" || method === "open";
  next = isOpening ? { method: "open", content: null } : { method, content };
  mustOpen = false;
  if (isBusy) return;
  isBusy = true;
  while (next) {
    const { method: asked, content: given } = next;
    next = null;
    setStatus(runner.isStarted ? "busy" : "starting");
    if (asked === "open") openings += 1;
    if (asked === "open") isRenamed = false;
    take(await runner.ask(asked, asked === "open" ? opened() : given));
  }
  isBusy = false;
  if (runner.isStarted) setStatus("ready");
}

function take(answer) {
  diagnostics = answer.diagnostics ?? [];
  if (answer.state) tellViewer({ ...answer.state, opening: openings });
  editor.mark(diagnostics);
  markFiles();
  byId("printed").textContent = answer.printed ?? "";
  show(byId("printed-part"), Boolean(answer.printed));
  const isRefused = Boolean(answer.isUnsafe) && !project.isTrusted;
  show(byId("trust"), isRefused);
  showProblems(answer.fault && !diagnostics.length ? answer.fault : "");
  if (answer.isStopped) tellViewer(null);
  built += 1;
  void showOutput();
}

function showProblems(fault) {
  const texts = diagnostics.map((one) => {
    const text = diagnosticText(one.text, one.severity);
    text.tabIndex = 0;
    text.onclick = () => goTo(one);
    text.onkeydown = ({ key }) => key === "Enter" && goTo(one);
    return text;
  });
  if (fault) texts.unshift(h("pre.diagnostic", {}, fault));
  byId("problems").replaceChildren(...texts);
  const count = texts.length;
  const hasErrors = Boolean(fault) || diagnostics.some(({ severity }) => severity === "error");
  document.body.classList.toggle("has-errors", hasErrors);
  byId("problem-count").textContent = count ? `${count} ${count === 1 ? "problem" : "problems"}` : "no problems";
  show(byId("problems"), count > 0);
}

function goTo({ file, from }) {
  if (!editor.states.has(file)) return;
  showFile(file);
  const place = editor.view.state.doc.lineAt(Math.min(from, editor.view.state.doc.length));
  editor.goTo(place.number, from - place.from + 1);
  showSide("edit");
}

// --- the editor -------------------------------------------------------------------------------

let pause = 0;
const changed = new Set();
const editor = new Editor(byId("editor"), {
  onChange(name) {
    changed.add(name);
    isChanged = true;
    clearTimeout(pause);
    pause = setTimeout(send, PAUSE);
  },
  onCursor: (file, line) => viewer.contentWindow?.postMessage({ type: "yamaro.line", file, line }, location.origin),
  onFix(edits) {
    editor.apply(edits);
    markFiles();
  },
});

function send() {
  const names = [...changed].map(nameByContent);
  changed.clear();
  const texts = editor.texts();
  remember(opened());
  const [name] = names;
  if (names.length === 1 && !isRenamed) void build("change", { name, text: texts[name] });
  else void build("open", null);
}

const ROOT = /^\ufeff?(?:\s|<\?[^]*?\?>|<!--[^]*?-->)*<(robot|mujoco|sdf)[\s>]/;
const ENDINGS = { robot: "urdf", mujoco: "xml", sdf: "sdf" };
const IS_YAML = /^(robot|model)\s*[:/]/m;
let isRenamed = false; // since the last build

/** Give a file that another format was pasted into a name of that format; return its name. */
function nameByContent(name) {
  const text = editor.texts()[name];
  const root = ROOT.exec(text)?.[1];
  const isXml = /\.(urdf|xml|sdf|mjcf)$/.test(name);
  const ending = root && /\.ya?ml$/.test(name) ? ENDINGS[root] : isXml && !root && IS_YAML.test(text) ? "yaml" : "";
  const wanted = name.replace(/\.\w+$/, `.${ending}`);
  if (!ending || editor.states.has(wanted)) return name;
  editor.rename(name, wanted);
  if (project.main === name) project.main = wanted;
  isRenamed = true;
  markFiles();
  return wanted;
}

/** Open files that were dropped: the robot is the first one that holds one and that no other names. */
async function takeFiles(list) {
  const files = {};
  for (const file of list) {
    if (file.size < 2 ** 20 && !IS_BINARY.test(file.name)) files[file.name] = await file.text();
  }
  const isRobot = (name) => ROOT.test(files[name]) || IS_YAML.test(files[name]);
  const isNamed = (name) => Object.entries(files).some(([other, text]) => other !== name && text.includes(name));
  const robots = Object.keys(files).filter(isRobot);
  const main = robots.find((name) => !isNamed(name)) ?? robots[0];
  if (!main) return;
  keepProject();
  byId("examples").value = "link";
  openProject({ files, main, title: "from a link", isTrusted: false });
}
const IS_BINARY = /\.(stl|obj|dae|glb|gltf|bin|png|jpe?g|ply|msh|zip)$/i;
const hasFiles = ({ dataTransfer }) => dataTransfer?.types.includes("Files");
window.addEventListener("dragover", (event) => hasFiles(event) && event.preventDefault(), true);
window.addEventListener("drop", (event) => {
  if (!hasFiles(event)) return;
  event.preventDefault();
  event.stopPropagation();
  void takeFiles([...event.dataTransfer.files]); // the list is empty once the event is over
}, true);

function showFile(name) {
  if (editor.active !== name) editor.show(name);
  editor.mark(diagnostics);
  markFiles();
}

function markFiles() {
  const wrong = new Set(diagnostics.filter(({ severity }) => severity === "error").map(({ file }) => file));
  byId("files").replaceChildren(
    ...[...editor.states.keys()].map((name) =>
      h(
        "button.file-tab",
        {
          type: "button",
          role: "tab",
          aria: { selected: name === editor.active },
          className: wrong.has(name) ? "file-tab wrong" : "file-tab",
          title: name === project.main ? "the robot" : name,
          onclick: () => showFile(name),
        },
        name,
      ),
    ),
  );
}

function addFile() {
  const name = window.prompt("The name of the new file, such as leg.yaml:", "part.yaml")?.trim();
  if (!name || editor.states.has(name) || name.startsWith("/") || name.split("/").includes("..")) return;
  editor.add(name, "");
  showFile(name);
}

function openProject(given) {
  project = given;
  isChanged = false;
  diagnostics = [];
  hasState = Boolean(given.state);
  editor.open(given.files, given.main);
  markFiles();
  if (given.state) tellViewer(given.state);
  void build("open", null);
}

new Theme(() => {}); // which the viewer's button changes

// --- the viewer -------------------------------------------------------------------------------

let isViewerReady = false;
let lastState = null;

function tellViewer(state) {
  const isGone = Boolean(lastState?.robot) && state !== null && !state.robot;
  lastState = state ?? lastState;
  if (isGone && isViewerReady) {
    isViewerReady = false; // until it says so again; so it forgets the robot of other files
    viewer.contentWindow.location.reload();
  }
  if (!isViewerReady || !lastState) return;
  hasState = true;
  viewer.contentWindow.postMessage({ type: "yamaro.state", state: lastState }, location.origin);
}

async function answer(action, content) {
  if (action === "rebuild") {
    void build("build", {});
    return {};
  }
  if (mustOpen) return { fault: "this robot was not built" };
  const found = await runner.ask("act", { action, content });
  if (action === "variables" && !found.fault) void build("build", {});
  if (action === "open" && !found.fault && editor.states.has(found.file)) {
    showFile(found.file);
    editor.goTo(found.line, found.column);
    showSide("edit");
  }
  if (!found.data) return found;
  const { data, ...others } = found;
  return { ...others, href: URL.createObjectURL(new Blob([data])) };
}

window.addEventListener("message", async ({ source, data, origin }) => {
  if (source !== viewer.contentWindow || origin !== location.origin) return;
  if (data?.type === "yamaro.ready") {
    isViewerReady = true;
    tellViewer(lastState);
  }
  if (data?.type === "yamaro.ask") {
    const told = await answer(data.action, data.content);
    viewer.contentWindow.postMessage({ type: "yamaro.answer", id: data.id, answer: told }, location.origin);
  }
});
viewer.contentWindow.postMessage({ type: "yamaro.hello" }, location.origin); // if it was there first

// --- what is written --------------------------------------------------------------------------

function showPane(name) {
  pane = name;
  for (const tab of document.querySelectorAll("#panes button")) {
    tab.setAttribute("aria-selected", String(tab.dataset.pane === name));
  }
  show(viewer, name === "robot");
  show(byId("written"), name !== "robot");
  showSide("robot");
  void showOutput();
}

let written = 0;
async function showOutput() {
  if (pane === "robot") return;
  const turn = ++written;
  const told = mustOpen ? { fault: "this robot was not built" } : await runner.ask("write", { format: pane });
  if (turn !== written) return;
  const texts = (told.diagnostics ?? []).map((one) => diagnosticText(one.text, one.severity));
  if (told.fault) texts.unshift(h("pre.diagnostic", {}, told.fault));
  const title = `${FORMATS[pane]} of the robot`;
  byId("loss-texts").replaceChildren(...texts);
  byId("loss-count").textContent = told.text ? `What ${FORMATS[pane]} cannot hold` : `There is no ${title}`;
  byId("losses").open = !told.text;
  show(byId("losses"), texts.length > 0);
  output.show(told.text ?? "", title);
  show(byId("output"), Boolean(told.text));
}

/** On a small screen one side is shown at a time. */
function showSide(name) {
  document.body.dataset.side = name;
  for (const button of document.querySelectorAll("#sides button")) {
    button.setAttribute("aria-pressed", String(button.dataset.side === name));
  }
}

// --- examples and links -----------------------------------------------------------------------

function fillExamples() {
  byId("examples").replaceChildren(
    ...examples.map(({ title }, index) => h("option", { value: String(index) }, title)),
    h("option", { value: "link", hidden: true }, "from a link"),
  );
}

byId("add").onclick = addFile;
byId("examples").onchange = ({ target }) => {
  history.replaceState(null, "", location.pathname);
  const chosen = kept.get(target.value) ?? { ...examples[Number(target.value)], isTrusted: true };
  keepProject();
  openProject(chosen);
};

/** Let what the user wrote, or got with a link, be chosen again below the examples. */
function keepProject() {
  if (!project || !(isChanged || project.key || project.title === "from a link")) return;
  const key = project.key ?? `kept-${kept.size}`;
  offer(key, { ...opened(), key });
}
function offer(key, given) {
  if (!kept.has(key)) byId("examples").append(h("option", { value: key }, `Your ${given.main}`));
  kept.set(key, given);
}
byId("trust-run").onclick = () => {
  project.isTrusted = true;
  show(byId("trust"), false);
  void build("open", null);
};
byId("share").onclick = async () => {
  const hash = await toHash({ files: editor.texts(), main: project.main });
  history.replaceState(null, "", hash);
  if (isChanged) remember(opened());
  const isCopied = await navigator.clipboard?.writeText(location.href).then(() => true, () => false);
  byId("share").textContent = isCopied ? "Link copied" : "Link is in the address";
  setTimeout(() => (byId("share").textContent = "Share"), 2500);
};
for (const tab of document.querySelectorAll("#panes button")) tab.onclick = () => showPane(tab.dataset.pane);
for (const button of document.querySelectorAll("#sides button")) {
  button.onclick = () => showSide(button.dataset.side);
}
byId("problem-fold").onclick = () => {
  const isFolded = document.body.classList.toggle("folded");
  byId("problem-fold").setAttribute("aria-expanded", String(!isFolded));
};

async function openFirst() {
  if (!examples.length) {
    examples = await fetch("examples.json").then((response) => response.json());
    fillExamples();
  }
  const recalled = project ? null : recall();
  if (recalled) {
    const key = "kept-0";
    offer(key, { ...recalled, key });
    byId("examples").value = key;
    openProject(kept.get(key));
    return;
  }
  keepProject();
  const shared = await fromHash(location.hash);
  const wanted = new URLSearchParams(location.search).get("example");
  const index = Math.max(examples.findIndex(({ name }) => name === wanted), 0);
  byId("examples").value = shared ? "link" : String(index);
  openProject(
    shared ? { ...shared, title: "from a link", isTrusted: false } : { ...examples[index], isTrusted: true },
  );
}

window.addEventListener("hashchange", () => void openFirst());
setStatus("starting");
showPane("robot"); // on a small screen too: what this is about, with the way to its text above
void openFirst();

// For tests and for the curious.
window.playground = {
  get built() {
    return built;
  },
  get diagnostics() {
    return diagnostics;
  },
  get isReady() {
    return runner.isStarted && !isBusy && !next && !changed.size;
  },
  get hasState() {
    return hasState;
  },
  editor,
  output,
  ask: (method, content) => runner.ask(method, content),
  showPane,
};
