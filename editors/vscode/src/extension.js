// The extension: starts the language server, finds robots among YAML files, shows the view.
const { existsSync } = require("node:fs");
const path = require("node:path");
const { execFile } = require("node:child_process");
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");
const { findProgram } = require("./command.js");
const { RobotView } = require("./view.js");

const IS_ROBOT = /^(robot|model)\s*[:/]/m;
const HAS_FUNCTIONS = /^functions:(?=[^]*^[ -]+[A-Z]\w*[(/:])/m; // their names begin with a capital letter
const IS_TEST = /\.test\.ya?ml$/;
const LONGEST_LOOK = 200_000;

let client;
let output;

const settings = () => vscode.workspace.getConfiguration("yamaro");

/** Return the path of yamaro: the setting, the workspace's own if it is trusted, or that on PATH. */
function command() {
  const set = settings().get("path");
  if (set) return found(set);
  if (vscode.workspace.isTrusted) {
    const inside = process.platform === "win32" ? ["Scripts", "yamaro.exe"] : ["bin", "yamaro"];
    for (const folder of vscode.workspace.workspaceFolders ?? []) {
      for (const environment of [".venv", "venv"]) {
        const own = path.join(folder.uri.fsPath, environment, ...inside);
        if (existsSync(own)) return own;
      }
    }
  }
  return found("yamaro");
}

function found(name) {
  const program = findProgram(name);
  if (!program) throw new Error(`'${name}' is not on PATH`);
  return program;
}

function options() {
  const own = settings();
  return {
    trust: own.get("trust"),
    timeout: own.get("timeout"),
    inlayHints: own.get("inlayHints"),
    packages: own.get("packages"),
    arguments: own.get("arguments"),
  };
}

async function start() {
  try {
    client = clientOf(command());
    await client.start();
  } catch (error) {
    output.appendLine(String(error));
    const install = "Install in a Terminal";
    const name = settings().get("path") || "yamaro";
    const answer = await vscode.window.showErrorMessage(`yamaro cannot be started: '${name}'`, install, "Settings");
    if (answer === install) {
      const terminal = vscode.window.createTerminal("yamaro");
      terminal.show();
      terminal.sendText("pip install yamaro", false);
    } else if (answer === "Settings") {
      await vscode.commands.executeCommand("workbench.action.openSettings", "yamaro.path");
    }
  }
}

function clientOf(program) {
  return new LanguageClient(
    "yamaro",
    "Yamaro",
    { command: program, args: ["lsp"], options: {} },
    {
      documentSelector: [
        { scheme: "file", language: "yamaro" },
        { scheme: "untitled", language: "yamaro" },
        { scheme: "file", pattern: "**/*.{xacro,urdf,sdf,world,mjcf,xml}" }, // the server leaves other XML alone
      ],
      initializationOptions: options(),
      outputChannel: output,
      synchronize: {
        fileEvents: vscode.workspace.createFileSystemWatcher("**/*.{yaml,yml,xacro,urdf,sdf,world,mjcf,xml,py,stl,obj,dae}"),
      },
    },
  );
}

async function restart() {
  const old = client;
  client = undefined;
  await old?.stop().catch(() => {});
  await start();
}

/** Give a YAML file that holds a robot, or functions of one, the language id, so that other extensions leave it alone. */
async function detect(document) {
  if (document.languageId !== "yaml" || !settings().get("detectLanguage")) return;
  if (IS_TEST.test(document.fileName)) return; // for `yamaro test`
  const end = document.positionAt(LONGEST_LOOK);
  const text = document.getText(new vscode.Range(new vscode.Position(0, 0), end));
  if (IS_ROBOT.test(text) || HAS_FUNCTIONS.test(text)) {
    await vscode.languages.setTextDocumentLanguage(document, "yamaro");
  }
}

/** Show the URDF of the active file beside it. */
async function showUrdf() {
  const file = vscode.window.activeTextEditor?.document.uri.fsPath;
  if (!file) return;
  const trust = settings().get("trust") === "jail" ? "--jail" : "--safe";
  const text = await new Promise((resolve) => {
    execFile(command(), ["-q", trust, file], { maxBuffer: 256 << 20 }, (error, result, messages) =>
      resolve(error ? `<!-- ${messages.replaceAll("--", "- -")} -->` : result),
    );
  });
  const document = await vscode.workspace.openTextDocument({ language: "xml", content: text });
  await vscode.window.showTextDocument(document, { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true });
}

async function activate(context) {
  output = vscode.window.createOutputChannel("Yamaro");
  const view = new RobotView(context, command, output);
  context.subscriptions.push(
    output,
    view,
    vscode.commands.registerCommand("yamaro.view", () => view.show()),
    vscode.commands.registerCommand("yamaro.showUrdf", showUrdf),
    vscode.commands.registerCommand("yamaro.restart", restart),
    vscode.workspace.onDidOpenTextDocument(detect),
    vscode.workspace.onDidSaveTextDocument(detect),
    vscode.workspace.onDidChangeConfiguration((event) => {
      if (event.affectsConfiguration("yamaro")) restart();
    }),
    vscode.workspace.onDidGrantWorkspaceTrust(restart),
  );
  for (const document of vscode.workspace.textDocuments) await detect(document);
  await start();
}

const deactivate = () => client?.stop();

module.exports = { activate, deactivate };
