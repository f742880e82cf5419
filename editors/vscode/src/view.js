// The robot beside the text: `yamaro view` in a frame. A click on a part shows its line, and the
// line of the cursor selects the part.
const { spawn } = require("node:child_process");
const { createServer } = require("node:net");
const { tmpdir } = require("node:os");
const { randomBytes } = require("node:crypto");
const path = require("node:path");
const vscode = require("vscode");

const START = 30_000; // milliseconds

class RobotView {
  constructor(context, command, output, mainOfActive) {
    this.mainOfActive = mainOfActive;
    this.context = context;
    this.command = command;
    this.output = output;
    this.panels = new Map(); // by file
    this.listener = vscode.window.onDidChangeTextEditorSelection((event) => this.select(event));
  }

  async show() {
    const main = await this.mainOfActive();
    if (!main) return;
    const { file, words } = main;
    const known = this.panels.get(file);
    if (known) {
      known.panel.reveal(vscode.ViewColumn.Beside, true);
      return;
    }
    const panel = vscode.window.createWebviewPanel(
      "yamaro.view",
      path.basename(file),
      { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true },
      { enableScripts: true, retainContextWhenHidden: true },
    );
    const entry = { panel, process: undefined, places: undefined };
    this.panels.set(file, entry);
    panel.onDidDispose(() => this.end(file));
    panel.webview.html = note("The robot is being built …");
    try {
      const url = await this.start(file, words, entry);
      const { origin, pathname } = new URL(url);
      const outside = await vscode.env.asExternalUri(vscode.Uri.parse(`${origin}/`)); // some lose a path
      panel.webview.html = frame(outside.toString(true).replace(/\/*$/, pathname));
    } catch (error) {
      panel.webview.html = note(String(error.message ?? error));
    }
  }

  /** Start `yamaro view`; return the address of its page. */
  async start(file, more, entry) {
    const socket = await this.listen(entry);
    const words = [process.execPath, path.join(this.context.extensionPath, "dist", "goto.js"), socket];
    const editor = [...words, "{file}", "{line}", "{column}"].map((word) => `'${word}'`).join(" ");
    const own = ["view", "--no-browser", "--embed", "--editor", editor, file, ...more];
    entry.process = spawn(this.command(), own, {
      cwd: path.dirname(file),
      env: { ...process.env, ELECTRON_RUN_AS_NODE: "1" },
    });
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => reject(new Error("yamaro view does not answer")), START);
      let text = "";
      let messages = "";
      entry.process.stdout.on("data", (data) => {
        text += data;
        const found = /http:\S+/.exec(text);
        if (found) {
          clearTimeout(timer);
          resolve(found[0]);
        }
      });
      entry.process.stderr.on("data", (data) => {
        messages += data;
        this.output.append(String(data));
      });
      entry.process.on("error", reject);
      entry.process.on("exit", () => reject(new Error(messages || "yamaro view has ended")));
    });
  }

  /** Listen for the places that are clicked in the view; return where. */
  async listen(entry) {
    const name = `yamaro-${randomBytes(8).toString("hex")}`;
    const socket = process.platform === "win32" ? `\\\\.\\pipe\\${name}` : path.join(tmpdir(), `${name}.sock`);
    entry.places = createServer({ allowHalfOpen: false }, (connection) => {
      let text = "";
      connection.on("data", (data) => (text += data));
      connection.on("end", () => this.goTo(text));
    });
    await new Promise((resolve, reject) => entry.places.once("error", reject).listen(socket, resolve));
    return socket;
  }

  async goTo(text) {
    let place;
    try {
      place = JSON.parse(text);
    } catch {
      return;
    }
    const document = await vscode.workspace.openTextDocument(place.file);
    const column = vscode.window.visibleTextEditors.find((each) => each.document === document)?.viewColumn;
    const editor = await vscode.window.showTextDocument(document, column ?? vscode.ViewColumn.One);
    const at = new vscode.Position(place.line - 1, place.column - 1);
    editor.selection = new vscode.Selection(at, at);
    editor.revealRange(new vscode.Range(at, at), vscode.TextEditorRevealType.InCenterIfOutsideViewport);
  }

  /** Tell the views which part the cursor is in: the last line of it, at or before which it is made. */
  async select(event) {
    const { document, selection } = event.textEditor;
    if (document.uri.scheme !== "file" || this.panels.size === 0) return;
    const symbols = await vscode.commands.executeCommand("vscode.executeDocumentSymbolProvider", document.uri);
    const part = innermost(symbols ?? [], selection.active);
    if (!part) return;
    const message = { type: "yamaro.line", file: document.uri.fsPath, line: part.range.end.line + 1 };
    for (const { panel } of this.panels.values()) panel.webview.postMessage(message);
  }

  end(file) {
    const entry = this.panels.get(file);
    this.panels.delete(file);
    entry?.process?.kill("SIGINT");
    entry?.places?.close();
  }

  dispose() {
    this.listener.dispose();
    for (const file of [...this.panels.keys()]) {
      this.panels.get(file).panel.dispose();
      this.end(file);
    }
  }
}

/** Return the innermost part around a position, which is a class among the symbols. */
function innermost(symbols, position) {
  let found;
  for (const symbol of symbols) {
    if (!symbol.range?.contains(position)) continue;
    if (symbol.kind === vscode.SymbolKind.Class) found = symbol;
    found = innermost(symbol.children ?? [], position) ?? found;
  }
  return found;
}

function page(policy, head, body) {
  const style = "html,body,iframe{margin:0;padding:0;border:0;width:100%;height:100%}p{padding:1em}";
  return `<!DOCTYPE html><html><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; ${policy}">
<style>${style}</style></head><body>${body}${head}</body></html>`;
}

const escaped = (text) => text.replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`);
const note = (text) => page("", "", `<p>${escaped(text)}</p>`);

/** Return a page that holds the view, and hands the lines of the cursor and the colours on to it. */
function frame(url) {
  const { origin } = new URL(url);
  const nonce = randomBytes(16).toString("hex");
  const script = `<script nonce="${nonce}">
const frame = document.querySelector("iframe");
addEventListener("message", (event) => {
  if (event.data?.type === "yamaro.line") frame.contentWindow.postMessage(event.data, ${JSON.stringify(origin)});
});
const tellTheme = () => {
  const { classList } = document.body; // VS Code keeps its kind of theme there
  const isDark = classList.contains("vscode-dark") || classList.contains("vscode-high-contrast") && !classList.contains("vscode-high-contrast-light");
  frame.contentWindow.postMessage({ type: "yamaro.theme", theme: isDark ? "dark" : "light" }, ${JSON.stringify(origin)});
};
frame.addEventListener("load", tellTheme);
new MutationObserver(tellTheme).observe(document.body, { attributeFilter: ["class"] });
</script>`;
  return page(
    `frame-src ${origin}; script-src 'nonce-${nonce}'`,
    script,
    `<iframe src="${escaped(url)}" allow="clipboard-write"></iframe>`,
  );
}

module.exports = { RobotView };
