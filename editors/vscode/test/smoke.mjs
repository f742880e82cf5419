// Drives VS Code with the packed extension: what is seen is asserted, and kept as screenshots.
// scripts/editors calls it.
//
//   node smoke.mjs CODE-SERVER-FOLDER EXTENSION.vsix YAMARO SCREENSHOTS
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import path from "node:path";
import { Code, pause } from "./code.mjs";

const NAME = "rover.urdf.yaml";
const ROBOT = `robot: rover
variables:
  length: 0.5
model:
- part:
    name: base
    link:
      visual:
        # a plate for the arm
        geometry: box
        size: 1 1 0.2
- part:  # on it
    name: arm
    joint: {type: fixd, parent: base, xyz: 0 0 $(length)}
    link: {geometry: box, size: 0.2 0.2 $(length), mass: 6, visual: {color: 0.9 0.4 0.1 1}}
`;

const code = await Code.open({ words: process.argv.slice(2), files: { [NAME]: ROBOT } });
const { page } = code;
const saved = () => readFileSync(path.join(code.work, NAME), "utf8");
const lineOf = (mark) => saved().split("\n").findIndex((each) => each.includes(mark)) + 1;
const place = (mark, after = 0) => {
  const line = lineOf(mark);
  return [line, saved().split("\n")[line - 1].indexOf(mark) + 1 + after];
};

try {
  await code.openFile(NAME);

  // Squiggle: the server has started, and its build has said what is wrong.
  await code.until("the language", async () => (await code.text("[id='status.editor.mode']")).includes("Yamaro"));
  await code.until("a squiggle", () => page.$(".squiggly-error"));
  await code.shot("1-squiggle");

  // The grammar: comments have one colour wherever they are, and nothing in them has another.
  const styles = await page.$$eval(".view-line > span", (lines) =>
    lines
      .map((line) => [...line.children].map((each) => [each.textContent.trim(), each.className]))
      .map((words) => words.slice(words.findIndex(([text]) => text.startsWith("#"))))
      .filter(([[text]]) => text.startsWith("#")),
  );
  assert.equal(styles.length, 2, JSON.stringify(styles));
  assert.equal(new Set(styles.flat().map(([, style]) => style)).size, 1, JSON.stringify(styles));

  // Quick fix: fixd becomes fixed.
  await code.go(...place("fixd", 1));
  await code.press("Control", "Period");
  await code.until("the menu", async () => (await code.text(".action-widget")).includes("change 'fixd' to 'fixed'"));
  await code.shot("2-quick-fix");
  await code.press("Enter");
  await code.until("no squiggle", async () => !(await page.$(".squiggly-error")));
  await code.save();
  assert.match(saved(), /type: fixed,/);

  // Hover: the mass of the part, once it is built.
  await code.hover(...place("name: arm", 7), "mass 6 kg");
  await code.shot("3-hover");

  // F12: from $(length) to its variable.
  await code.go(...place("$(length)", 3));
  await code.press("F12");
  await code.until("the definition", async () => (await code.cursor()).includes("Ln 3, Col 3"));

  // F2: the variable gets another name wherever it is meant.
  await code.press("F2");
  await code.until("the field for a name", () => page.evaluate('!!document.activeElement?.closest(".rename-box")'));
  await code.type("reach");
  await code.shot("4-rename");
  await code.press("Enter");
  await code.until("the new name", async () => (await code.text(".view-lines")).includes("reach: 0.5"));
  await code.save();
  assert.equal(saved().match(/reach/g).length, 3);

  // Completion: a key of the joint.
  await code.go(...place("type: fixed"));
  await code.type("ax", 60);
  await code.until("an offer", async () => {
    if ((await code.text(".suggest-widget.visible")).includes("axis")) return true;
    await code.press("Control", "Space");
    await pause(1500);
    return false;
  });
  await code.shot("5-completion");
  await code.press("Escape");
  await code.press("Backspace");
  await code.press("Backspace");

  // Format on save.
  await code.go(1, 7);
  await code.type("     ");
  await code.save();
  assert.match(saved(), /^robot: rover\n/);

  // The live view beside the text: the line of the cursor selects a part.
  const view = await code.showView();
  const title = () => view.$eval("#origin-title", (each) => each.textContent);
  await page.mouse.click(500, 120);
  await code.go(...place("name: base"));
  await code.until("the base", async () => (await title()) === "base_link");
  await code.go(...place("name: arm"));
  await code.until("the arm", async () => (await title()) === "arm_link");
  await pause(1500);
  await code.shot("6-view");

  // A click on the robot selects the part there, and a click on a line in its card leads to it.
  await code.go(1, 1);
  const box = await (await view.$("canvas")).boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height * 0.8);
  await code.until("what was clicked", async () => (await title()) === "base_link");
  await pause(500);
  await code.shot("7-click");
  await (await view.$("#origin-rows .place")).click();
  await code.until("its line", async () => (await code.cursor()).includes(`Ln ${lineOf("visual:")},`));
  await code.shot("8-click-to-line");
  console.log(`VS Code: squiggle, quick fix, hover, F12, F2, completion, format on save, view; see ${code.screens}`);
} finally {
  await code.close();
}
