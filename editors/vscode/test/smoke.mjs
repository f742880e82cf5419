// Drives VS Code (code-server in Chromium) with the packed extension: what is seen is asserted, and
// kept as screenshots. scripts/editors calls it.
//
//   node smoke.mjs CODE-SERVER-FOLDER EXTENSION.vsix YAMARO SCREENSHOTS
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";

const [modules, vsix, yamaro, screens] = process.argv.slice(2).map((each) => path.resolve(each));
const puppeteer = createRequire(path.join(modules, "package.json"))("puppeteer-core");
const CHROMIUM = process.env.CHROMIUM ?? "/usr/bin/chromium";
const PATIENCE = 120_000;
const ROBOT = `robot: rover
variables:
  length: 0.5
model:
- part:
    name: base
    link: {visual: {geometry: box, size: 1 1 0.2}}
- part:
    name: arm
    joint: {type: fixd, parent: base, xyz: 0 0 $(length)}
    link: {geometry: box, size: 0.2 0.2 $(length), mass: 6}
`;

const home = mkdtempSync(path.join(tmpdir(), "yamaro-code-"));
const work = path.join(home, "work");
const file = path.join(work, "rover.urdf.yaml");
const data = path.join(home, "data");
const extensions = path.join(home, "extensions");
mkdirSync(work);
mkdirSync(screens, { recursive: true });
writeFileSync(file, ROBOT);
const set = (kind, values) => {
  mkdirSync(path.join(data, kind), { recursive: true });
  writeFileSync(path.join(data, kind, "settings.json"), JSON.stringify(values));
};
set("Machine", { "yamaro.path": yamaro, "yamaro.timeout": 60_000 });
set("User", {
  "editor.formatOnSave": true,
  "editor.hover.delay": 100,
  "workbench.startupEditor": "none",
  "security.workspace.trust.enabled": false,
  "telemetry.telemetryLevel": "off",
  "files.autoSave": "off",
});

const server = path.join(modules, "node_modules", "code-server", "out", "node", "entry.js");
const own = ["--user-data-dir", data, "--extensions-dir", extensions];
const installed = spawnSync(process.execPath, [server, ...own, "--install-extension", vsix], { encoding: "utf8" });
assert.match(installed.stdout, /successfully installed/, installed.stdout + installed.stderr);

const port = 20_000 + (process.pid % 20_000);
const running = spawn(
  process.execPath,
  [server, ...own, "--auth", "none", "--bind-addr", `127.0.0.1:${port}`, "--disable-telemetry",
    "--disable-update-check", "--disable-workspace-trust", work],
  { stdio: ["ignore", "pipe", "pipe"] },
);
let log = "";
running.stdout.on("data", (text) => (log += text));
running.stderr.on("data", (text) => (log += text));

async function until(what, look, patience = PATIENCE) {
  const end = Date.now() + patience;
  for (;;) {
    const found = await look().catch(() => null);
    if (found) return found;
    if (Date.now() > end) {
      await page?.screenshot({ path: path.join(screens, "failed.png") });
      throw new Error(`waited in vain for ${what}\n${log.slice(-2000)}`);
    }
    await new Promise((resolve) => setTimeout(resolve, 250));
  }
}

let page;
const browser = await puppeteer.launch({
  executablePath: CHROMIUM,
  headless: true,
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const shot = (name) => page.screenshot({ path: path.join(screens, `${name}.png`) });
const press = async (...keys) => {
  for (const key of keys.slice(0, -1)) await page.keyboard.down(key);
  await page.keyboard.press(keys.at(-1));
  for (const key of keys.slice(0, -1).reverse()) await page.keyboard.up(key);
};
const text = (selector) => page.$$eval(selector, (found) => found.map((each) => each.textContent).join("\n"));
const cursor = () => text(".statusbar-item[id='status.editor.selection']");

/** Put the cursor at a line and column. */
async function go(line, column) {
  await press("Escape");
  await press("Control", "KeyG");
  await until("the field for a line", () => page.$(".quick-input-widget:not([style*='display: none']) input"));
  await page.keyboard.type(`${line}:${column}`, { delay: 15 });
  await press("Enter");
  await until(`line ${line}`, async () => (await cursor()).includes(`Ln ${line}, Col ${column}`), 20_000);
}

const column = (line, mark) => readFileSync(file, "utf8").split("\n")[line - 1].indexOf(mark) + 1;

async function save() {
  await press("Control", "KeyS");
  await until("the file to be saved", async () => !(await page.$(".tab.dirty")));
  return readFileSync(file, "utf8");
}

try {
  await until("code-server", async () => (await fetch(`http://127.0.0.1:${port}/healthz`)).ok);
  page = await browser.newPage();
  await page.setViewport({ width: 1500, height: 850 });
  await page.goto(`http://127.0.0.1:${port}/?folder=${encodeURIComponent(work)}`);
  await until("the workbench", () => page.$(".monaco-workbench .explorer-folders-view"));
  await press("Control", "KeyP");
  await until("the field for files", () => page.$(".quick-input-widget input"));
  await page.keyboard.type("rover.urdf.yaml", { delay: 20 });
  await until("the file", async () => (await text(".quick-input-list")).includes("rover.urdf.yaml"));
  await press("Enter");

  // Squiggle: the server has started, and its build has said what is wrong.
  await until("the editor", () => page.$(".monaco-editor .view-line"));
  await until("the language", async () => (await text("[id='status.editor.mode']")).includes("Yamaro"));
  await until("a squiggle", () => page.$(".squiggly-error"));
  await shot("1-squiggle");

  // Quick fix: fixd becomes fixed.
  await go(10, column(10, "fixd") + 1);
  await press("Control", "Period");
  await until("the menu", async () => (await text(".action-widget")).includes("change 'fixd' to 'fixed'"));
  await shot("2-quick-fix");
  await press("Enter");
  await until("no squiggle", async () => !(await page.$(".squiggly-error")));
  assert.match(await save(), /type: fixed,/);

  // Hover: the mass of the part, once it is built.
  await until("a hover", async () => {
    await go(9, column(9, "arm") + 1);
    await press("Control", "KeyK");
    await press("Control", "KeyI");
    await new Promise((resolve) => setTimeout(resolve, 1500));
    return (await text(".monaco-hover")).includes("mass 6 kg");
  });
  await shot("3-hover");

  // F12: from $(length) to its variable.
  await go(10, column(10, "length") + 1);
  await press("F12");
  await until("the definition", async () => (await cursor()).includes("Ln 3, Col 3"));

  // F2: the variable gets another name wherever it is meant.
  await press("F2");
  await until("the field for a name", () => page.evaluate('!!document.activeElement?.closest(".rename-box")'));
  await page.keyboard.type("reach", { delay: 20 });
  await shot("4-rename");
  await press("Enter");
  await until("the new name", async () => (await text(".view-lines")).replaceAll("\u00a0", " ").includes("reach: 0.5"));
  assert.equal((await save()).match(/reach/g).length, 3);

  // Completion: a key of the joint.
  await go(10, column(10, "type: fixed"));
  await page.keyboard.type("ax", { delay: 60 });
  await until("an offer", async () => {
    if ((await text(".suggest-widget.visible")).includes("axis")) return true;
    await press("Control", "Space");
    await new Promise((resolve) => setTimeout(resolve, 1500));
    return false;
  });
  await shot("5-completion");
  await press("Escape");
  await press("Backspace");
  await press("Backspace");

  // Format on save.
  await go(1, 7);
  await page.keyboard.type("     ", { delay: 20 });
  assert.match(await save(), /^robot: rover\n/);

  // The live view beside the text; the line of the cursor selects a part, a click leads to its line.
  await press("F1");
  await until("the palette", () => page.$(".quick-input-widget input"));
  await page.keyboard.type("Yamaro: Show the Robot", { delay: 20 });
  await until("the command", async () => (await text(".quick-input-list")).includes("Show the Robot"));
  await press("Enter");
  const find = async () => {
    for (const each of page.frames()) {
      if (await each.evaluate("window.yamaro?.version > 0").catch(() => false)) return each;
    }
    return null;
  };
  const view = await until("the view", find);
  await page.mouse.click(500, 120);
  await go(9, 6);
  await until("the part", async () => (await view.$eval("#origin-title", (each) => each.textContent)) === "arm_link");
  await new Promise((resolve) => setTimeout(resolve, 1500));
  await shot("6-view");
  await go(1, 1);
  await view.evaluate("document.querySelector('#origin-open').click()");
  await until("the line of the part", async () => /Ln (8|9|10|11), /.test(await cursor()));
  await shot("7-click-to-line");
  console.log(`VS Code: squiggle, quick fix, hover, F12, F2, completion, format on save, view; see ${screens}`);
} finally {
  await browser.close();
  running.kill();
}
