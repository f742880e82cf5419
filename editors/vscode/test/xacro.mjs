// Drives VS Code on a package of xacro files, as someone who has just installed the extension.
// scripts/editors calls it.
//
//   node xacro.mjs CODE-SERVER-FOLDER EXTENSION.vsix YAMARO SCREENSHOTS
import assert from "node:assert/strict";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { Code, pause } from "./code.mjs";

const HEAD = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"';
const MAIN = "rover_description/urdf/rover.urdf.xacro";
const LEG = "parts/leg_description/urdf/leg.xacro";
const FILES = {
  [MAIN]: `<?xml version="1.0"?>
${HEAD} name="rover">
  <xacro:arg name="mass" default="2"/>
  <xacro:include filename="$(find leg_description)/urdf/leg.xacro"/>

  <!-- how far the legs are apart -->
  <xacro:property name="width" value="0.4"/>
  <link name="base">
    <visual><geometry><box size="0.6 \${width} 0.1"/></geometry></visual>
  </link>
  <xacro:leg prefix="left_" y="\${width / 2}" mass="$(arg mass)"/>
  <xacro:leg prefix="right_" y="\${-widht / 2}"/>
</robot>
`,
  [LEG]: `${HEAD}>
  <!-- a leg with its foot -->
  <xacro:macro name="leg" params="prefix y mass:=3 parent:=base">
    <link name="\${prefix}foot">
      <visual><origin xyz="0 0 -0.2"/><geometry><box size="0.1 0.05 0.4"/></geometry></visual>
      <inertial><mass value="\${mass}"/>
        <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
    </link>
    <joint name="\${prefix}hip" type="revolute">
      <parent link="\${parent}"/><child link="\${prefix}foot"/>
      <origin xyz="0 \${y} 0"/><axis xyz="0 1 0"/>
      <limit lower="-1.5" upper="0.5" effort="10" velocity="3"/>
    </joint>
  </xacro:macro>
</robot>
`,
  "rover_description/package.xml": "<package><name>rover_description</name></package>\n",
  "parts/leg_description/package.xml": "<package><name>leg_description</name></package>\n",
};

const started = Date.now();
const code = await Code.open({ words: process.argv.slice(2), files: FILES });
const { page } = code;
const place = (name, mark, after = 0) => {
  const lines = readFileSync(path.join(code.work, name), "utf8").split("\n");
  const line = lines.findIndex((each) => each.includes(mark));
  return [line + 1, lines[line].indexOf(mark) + 1 + after];
};

try {
  // The error is underlined at its name, from a package found without ROS.
  await code.openFile(MAIN);
  await code.until("the language", async () => (await code.text("[id='status.editor.mode']")).includes("XML"));
  await code.until("a squiggle", () => page.$(".squiggly-error"));
  console.log(`underlined ${Math.round((Date.now() - started) / 1000)} s after the installation began`);
  await code.hover(...place(MAIN, "widht", 2), "'widht' is not defined");
  await code.shot("xacro-1-squiggle");

  // Mended by hand; then values on hover.
  const path_ = path.join(code.work, MAIN);
  await code.go(...place(MAIN, "widht"));
  await code.press("Delete");
  for (let index = 0; index < 4; index += 1) await code.press("Delete");
  await code.type("width");
  await code.until("no squiggle", async () => !(await page.$(".squiggly-error")));
  await code.save();
  assert.match(readFileSync(path_, "utf8"), /y="\$\{-width \/ 2\}"/);
  await code.hover(...place(MAIN, "${width / 2}", 3), "0.2");
  await code.shot("xacro-2-hover");
  await code.hover(...place(MAIN, "xacro:leg prefix", 8), "a leg with its foot");
  await code.shot("xacro-3-macro");

  // F12: from the call to the macro in the other package, from a parent to the link of a macro.
  await code.go(...place(MAIN, "xacro:leg prefix", 8));
  await code.press("F12");
  await code.until("the macro", async () => (await code.text(".tab.active")).includes("leg.xacro"));
  await code.until("its line", async () => (await code.cursor()).includes("Ln 3,"));
  await code.hover(...place(LEG, "${prefix}foot", 11), "mass 2 kg");
  await code.shot("xacro-4-link");

  // Completion of a call, with the parameters of the macro.
  await code.openFile(MAIN);
  await code.go(...place(MAIN, "</robot>"));
  await code.type("<xacro:le", 60);
  await code.until("an offer", async () => {
    if ((await code.text(".suggest-widget.visible")).includes("prefix y mass:=3")) return true;
    await code.press("Control", "Space");
    await pause(1500);
    return false;
  });
  await code.shot("xacro-5-completion");
  await code.press("Escape");
  for (let index = 0; index < "<xacro:le".length; index += 1) await code.press("Backspace");
  await code.save();

  // The outline, and the live view, also from the file of the macro.
  await code.openFile(LEG);
  const view = await code.showView();
  const title = () => view.$eval("#origin-title", (each) => each.textContent);
  await page.mouse.click(500, 120);
  await code.go(...place(LEG, "<mass"));
  await code.until("the foot", async () => (await title()).endsWith("_foot"));
  await pause(1500);
  await code.shot("xacro-6-view");

  // Saved edits reach the view.
  const text = readFileSync(path_, "utf8");
  writeFileSync(path_, text.replace('value="0.4"', 'value="0.9"'));
  await pause(3000);
  await code.shot("xacro-7-saved");

  // To YAML.
  await code.openFile(MAIN);
  await code.command("Yamaro: Convert to YAML");
  await pause(1000);
  await code.press("Enter");
  const made = path.join(code.work, "rover_description", "urdf", "rover_yaml", "rover.yaml");
  await code.until("the YAML", async () => existsSync(made));
  await code.until("its tab", async () => (await code.text(".tab.active")).includes("rover.yaml"));
  await pause(1500);
  await code.shot("xacro-8-yaml");
  console.log(`VS Code: xacro is underlined, hovered, followed, completed, viewed and converted; see ${code.screens}`);
} finally {
  await code.close();
}
