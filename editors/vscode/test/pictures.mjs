// Makes the pictures of the editor for the docs, in VS Code with the packed extension. The files in it
// are those of the docs and examples. scripts/editors --pictures calls it.
//
//   node pictures.mjs CODE-SERVER-FOLDER EXTENSION.vsix YAMARO SCREENSHOTS
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { Code, pause } from "./code.mjs";

const repository = path.join(path.dirname(fileURLToPath(import.meta.url)), "..", "..", "..");
const read = (...names) => readFileSync(path.join(repository, ...names), "utf8");
const SETTINGS = {
  "breadcrumbs.enabled": false,
  "editor.fontSize": 14,
  "editor.minimap.enabled": false,
  "editor.renderLineHighlight": "none",
  "editor.scrollbar.horizontal": "hidden",
  "editor.stickyScroll.enabled": false,
  "terminal.integrated.gpuAcceleration": "off", // so that its text can be read in the page
  "terminal.integrated.defaultProfile.linux": "plain",
  "terminal.integrated.profiles.linux": { plain: { path: "/bin/sh", args: ["-i"] } },
  "terminal.integrated.env.linux": {
    PS1: "$ ", ENV: "", GIT_PAGER: "cat", GIT_CONFIG_GLOBAL: "/dev/null",
    PATH: `${path.dirname(path.resolve(process.argv[4]))}:${process.env.PATH}`,
  },
  "terminal.integrated.fontSize": 13,
  "window.commandCenter": false,
  "workbench.activityBar.location": "hidden",
  "workbench.layoutControl.enabled": false,
  "workbench.panel.defaultLocation": "bottom",
  "workbench.tips.enabled": false,
};

/** Return the files of a document: its fenced blocks with `file=NAME`. */
function filesOf(document) {
  const blocks = read("docs", document).matchAll(/^```yaml file=(\S+).*\n([^]*?)^```$/gm);
  return Object.fromEntries([...blocks].map(([, name, text]) => [name, text]));
}

const files = {};
const put = (folder, given) => {
  for (const [name, text] of Object.entries(given)) files[`${folder}/${name}`] = text;
};
put("format", filesOf("format.md"));
put("check", filesOf("check-in-ci.md"));
put("diff", filesOf("diff.md"));
put("test", filesOf("test-a-robot.md"));
for (const name of readdirSync(path.join(repository, "examples", "hexapod"))) {
  if (name.endsWith(".yaml")) files[`hexapod/${name}`] = read("examples", "hexapod", name);
}

files["xacro/rover.urdf.xacro"] = `<robot name="rover" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="width" value="0.4"/>
  <xacro:macro name="wheel" params="side y mass:=2">
    <link name="\${side}_wheel">
      <inertial>
        <mass value="\${mass}"/>
        <inertia ixx="0.01" iyy="0.02" izz="0.01" ixy="0" ixz="0" iyz="0"/>
      </inertial>
    </link>
    <joint name="\${side}_axle" type="continuous">
      <parent link="base"/>
      <child link="\${side}_wheel"/>
      <origin xyz="0 \${y} 0"/>
      <axis xyz="0 1 0"/>
    </joint>
  </xacro:macro>
  <link name="base"/>
  <xacro:wheel side="left" y="\${width / 2}"/>
  <xacro:wheel side="right" y="\${-widht / 2}"/>
</robot>
`;

const code = await Code.open({ words: process.argv.slice(2), files, settings: SETTINGS });
const { page } = code;
const lineOf = (name, mark) => {
  const lines = readFileSync(path.join(code.work, name), "utf8").split("\n");
  const line = lines.findIndex((each) => each.includes(mark));
  return [line + 1, lines[line].indexOf(mark) + 1];
};

async function resize(width, height) {
  await page.setViewport({ width, height });
  await pause(800);
}

/** Show a file alone. */
async function show(name, language = "Yamaro") {
  await code.command("View: Close All Editor Groups");
  await code.openFile(name);
  await code.until("the language", async () => (await code.text("[id='status.editor.mode']")).includes(language));
  await pause(2000); // for its colours
}

async function picture(name) {
  for (const each of await page.$$(".notification-toast .codicon-notifications-clear")) await each.click();
  await pause(700);
  await code.shot(name);
}

/** Run a command in a new terminal below the file, until a text is shown. */
async function inTerminal(folder, command, expected) {
  await code.command("Terminal: Create New Terminal");
  await code.until("a prompt", async () => /\$/.test(await code.text(".xterm-rows")));
  await code.type(`cd ${folder}; clear`, 5);
  await code.press("Enter");
  await pause(500);
  await code.type(command, 5);
  await code.press("Enter");
  await code.until(expected, async () => (await code.text(".xterm-rows")).includes(expected));
}

try {
  await code.press("Control", "KeyB"); // without the folder

  await resize(760, 330);
  await show("check/lamp.urdf.yaml");
  await code.until("a squiggle", () => page.$(".squiggly-error"));
  await code.go(...lineOf("check/lamp.urdf.yaml", "varaibles"));
  await code.press("Control", "Period");
  await code.until("the menu", async () => (await code.text(".action-widget")).includes("'variables'"));
  await picture("quick-fix");
  await code.press("Escape");
  await resize(760, 440);
  await code.command("Problems: Focus on Problems View");
  await code.until("the problem", async () => (await code.text(".markers-panel")).includes("varaibles"));
  await picture("problems");
  await code.command("View: Hide Panel");

  await resize(760, 400);
  await show("format/lamp.yaml");
  await picture("before-format");
  await code.command("Format Document");
  await code.until("the style", async () => (await code.text(".view-lines")).includes("robot: lamp"));
  await picture("after-format");
  await code.save();

  await resize(760, 400);
  await show("hexapod/leg.yaml");
  await code.hover(...lineOf("hexapod/leg.yaml", "tibia_length)"), "tibia_length");
  await picture("hover");

  await resize(760, 460);
  const rover = "xacro/rover.urdf.xacro";
  await show(rover, "XML");
  await code.until("a squiggle", () => page.$(".squiggly-error"));
  await code.hover(...lineOf(rover, "widht"), "did you mean");
  await picture("xacro-fault");
  writeFileSync(path.join(code.work, rover), files[rover].replace("widht", "width"));
  await code.until("no squiggle", async () => !(await page.$(".squiggly-error")));
  await code.hover(...lineOf(rover, `_wheel">`), "right_wheel");
  await picture("xacro-values");

  await resize(760, 520);
  await show("hexapod/hexapod.yaml");
  await code.go(...lineOf("hexapod/hexapod.yaml", "geometry: box"));
  await code.press("Control", "Space");
  await code.until("an offer", () => page.$(".suggest-widget.visible .monaco-list-row"));
  await picture("completion");
  await code.press("Escape");

  await resize(1180, 640);
  await show("hexapod/hexapod.yaml");
  const view = await code.showView();
  await view.evaluate("document.querySelector('#file').style.visibility = 'hidden'"); // a temporary folder
  await page.mouse.click(300, 120);
  await code.go(...lineOf("hexapod/hexapod.yaml", "name: base"));
  await pause(3000);
  await picture("view");

  await resize(860, 560);
  const folder = path.join(code.work, "diff");
  const git = (...words) => execFileSync("git", ["-c", "user.name=me", "-c", "user.email=me@example.org", ...words], { cwd: folder });
  git("init", "-q");
  writeFileSync(path.join(folder, ".gitattributes"), "*.yaml diff=yamaro\n");
  git("config", "diff.yamaro.command", "yamaro diff --git");
  git("add", ".");
  git("commit", "-q", "-m", "arm");
  const arm = path.join(folder, "arm.yaml");
  writeFileSync(arm, readFileSync(arm, "utf8").replace("default: 0.4", "default: 0.5"));
  await show("diff/arm.yaml");
  await inTerminal("diff", "git diff", "moves the same");
  await picture("git-diff");
  await code.command("View: Hide Panel");

  await show("test/arm.test.yaml", "YAML");
  await inTerminal("test", "yamaro test arm.test.yaml", "1 failed");
  await picture("test");
  console.log(`pictures in ${code.screens}`);
} finally {
  await code.close();
}
