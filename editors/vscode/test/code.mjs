// VS Code (code-server in Chromium) with the packed extension, as the scripts beside this one drive it.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";

const CHROMIUM = process.env.CHROMIUM ?? "/usr/bin/chromium";
const PATIENCE = Number(process.env.PATIENCE ?? 120_000);
const SETTINGS = {
  "editor.formatOnSave": true,
  "editor.hover.delay": 100,
  "workbench.startupEditor": "none",
  "security.workspace.trust.enabled": false,
  "telemetry.telemetryLevel": "off",
  "files.autoSave": "off",
};

export const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** A window of VS Code on a folder with some files. */
export class Code {
  /**
   * Install the extension, start the server and open the window.
   * @param {object} options
   * @param {string[]} options.words folder of code-server, extension, command yamaro, folder of screenshots
   * @param {Record<string, string>} options.files what is in the folder
   * @param {object} options.settings settings of the user besides SETTINGS
   * @param {object} options.viewport
   */
  static async open({ words, files, settings = {}, viewport = { width: 1500, height: 850 } }) {
    const code = new Code(words, files, settings);
    try {
      await code.start(viewport);
    } catch (error) {
      await code.close();
      throw error;
    }
    return code;
  }

  constructor(words, files, settings) {
    const [modules, vsix, yamaro, screens] = words.map((each) => path.resolve(each));
    this.puppeteer = createRequire(path.join(modules, "package.json"))("puppeteer-core");
    this.home = mkdtempSync(path.join(tmpdir(), "yamaro-code-"));
    this.work = path.join(this.home, "work");
    this.screens = screens;
    this.log = "";
    mkdirSync(this.work);
    mkdirSync(screens, { recursive: true });
    for (const [name, text] of Object.entries(files)) {
      mkdirSync(path.dirname(path.join(this.work, name)), { recursive: true });
      writeFileSync(path.join(this.work, name), text);
    }
    const data = path.join(this.home, "data");
    const set = (kind, values) => {
      mkdirSync(path.join(data, kind), { recursive: true });
      writeFileSync(path.join(data, kind, "settings.json"), JSON.stringify(values));
    };
    set("Machine", { "yamaro.path": yamaro, "yamaro.timeout": 60_000 });
    set("User", { ...SETTINGS, ...settings });
    const server = path.join(modules, "node_modules", "code-server", "out", "node", "entry.js");
    const own = ["--user-data-dir", data, "--extensions-dir", path.join(this.home, "extensions")];
    const installed = spawnSync(process.execPath, [server, ...own, "--install-extension", vsix], { encoding: "utf8" });
    assert.match(installed.stdout, /successfully installed/, installed.stdout + installed.stderr);
    this.port = 20_000 + (process.pid % 20_000);
    this.server = spawn(
      process.execPath,
      [server, ...own, "--auth", "none", "--bind-addr", `127.0.0.1:${this.port}`, "--disable-telemetry",
        "--disable-update-check", "--disable-workspace-trust", this.work],
      { stdio: ["ignore", "pipe", "pipe"], env: { ...process.env, PATH: `${path.dirname(yamaro)}:${process.env.PATH}` } },
    );
    this.server.stdout.on("data", (text) => (this.log += text));
    this.server.stderr.on("data", (text) => (this.log += text));
  }

  async start(viewport) {
    this.browser = await this.puppeteer.launch({
      executablePath: CHROMIUM,
      headless: true,
      args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
    });
    await this.until("code-server", async () => (await fetch(`http://127.0.0.1:${this.port}/healthz`)).ok);
    this.page = await this.browser.newPage();
    await this.page.setViewport(viewport);
    await this.page.goto(`http://127.0.0.1:${this.port}/?folder=${encodeURIComponent(this.work)}`);
    await this.until("the workbench", () => this.page.$(".monaco-workbench .explorer-folders-view"));
  }

  async close() {
    await this.browser?.close();
    this.server.kill();
    rmSync(this.home, { recursive: true, force: true });
  }

  // --- what is seen ---

  async until(what, look, patience = PATIENCE) {
    const end = Date.now() + patience;
    for (;;) {
      const found = await look().catch(() => null);
      if (found) return found;
      if (Date.now() > end) {
        await this.page?.screenshot({ path: path.join(this.screens, "failed.png") });
        throw new Error(`waited in vain for ${what}\n${this.log.slice(-2000)}`);
      }
      await pause(250);
    }
  }

  text(selector) {
    return this.page.$$eval(selector, (found) =>
      found.map((each) => each.textContent.replaceAll("\u00a0", " ")).join("\n"),
    );
  }

  cursor() {
    return this.text(".statusbar-item[id='status.editor.selection']");
  }

  shot(name, options = {}) {
    return this.page.screenshot({ path: path.join(this.screens, `${name}.png`), ...options });
  }

  // --- what is done ---

  async press(...keys) {
    for (const key of keys.slice(0, -1)) await this.page.keyboard.down(key);
    await this.page.keyboard.press(keys.at(-1));
    for (const key of keys.slice(0, -1).reverse()) await this.page.keyboard.up(key);
  }

  type(text, delay = 20) {
    return this.page.keyboard.type(text, { delay });
  }

  /** Choose a row of the list that opens on keys, by its text. */
  async choose(keys, typed, expected = typed) {
    await this.press(...keys);
    await this.until("the field", () => this.page.$(".quick-input-widget:not([style*='display: none']) input"));
    await this.type(typed);
    await this.until(expected, async () => (await this.text(".quick-input-list .monaco-list-row:first-child")).includes(expected));
    await this.press("Enter");
  }

  async openFile(name) {
    await this.choose(["Control", "KeyP"], name, path.basename(name));
    await this.until("the editor", () => this.page.$(".monaco-editor .view-line"));
    await this.until("the tab", async () => (await this.text(".tab.active")).includes(path.basename(name)));
  }

  command(title) {
    return this.choose(["F1"], title);
  }

  /** Put the cursor at a line and column. */
  async go(line, column) {
    await this.press("Escape");
    await this.press("Control", "KeyG");
    await this.until("the field for a line", () => this.page.$(".quick-input-widget:not([style*='display: none']) input"));
    await this.type(`${line}:${column}`, 15);
    await this.press("Enter");
    await this.until(`line ${line}`, async () => (await this.cursor()).includes(`Ln ${line}, Col ${column}`), 20_000);
  }

  async save() {
    await this.press("Control", "KeyS");
    await this.until("the file to be saved", async () => !(await this.page.$(".tab.dirty")));
  }

  /** Show the hover of a place, once it has a text in it. */
  async hover(line, column, expected) {
    await this.until(`a hover with '${expected}'`, async () => {
      await this.go(line, column);
      await this.press("Control", "KeyK");
      await this.press("Control", "KeyI");
      await pause(1500);
      return (await this.text(".monaco-hover")).includes(expected);
    });
  }

  /** Open the live view of the file; return the frame of its page. */
  async showView() {
    await this.command("Yamaro: Show the Robot");
    const find = async () => {
      for (const each of this.page.frames()) {
        if (await each.evaluate("window.yamaro?.version > 0").catch(() => false)) return each;
      }
      return null;
    };
    return this.until("the view", find);
  }
}
