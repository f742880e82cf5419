// The extension: starts the language server, finds robots among YAML and XML files, shows the view.
const { existsSync, statSync } = require("node:fs");
const path = require("node:path");
const { execFile } = require("node:child_process");
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");
const { findProgram } = require("./command.js");
const { RobotView } = require("./view.js");

const IS_ROBOT = /^(robot|model)\s*[:/]/m;
const HAS_FUNCTIONS = /^functions:(?=[^]*^[ -]+[A-Z]\w*[(/:])/m; // their names begin with a capital letter
const IS_TEST = /\.test\.ya?ml$/;
const IS_XML_ROBOT = /\.(xacro|urdf|sdf|world|mjcf)$/i;
const BEGINS_ROBOT = /^\s*(<\?[^]*?\?>\s*|<!--[^]*?-->\s*|<!(?!--)[^>]*>\s*)*<(robot|mujoco|mujocoinclude|sdf)[\s>]/;
const LONGEST_LOOK = 200_000;

let client;
let starting;
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
  starting = start();
  await starting;
}

/** Return the first characters of a file. */
function beginOf(document) {
  const end = document.positionAt(LONGEST_LOOK);
  return document.getText(new vscode.Range(new vscode.Position(0, 0), end));
}

/** Return whether a file is a robot in XML: by its ending, or a .xml file by its first element. */
function isXmlRobot(document) {
  if (document.uri.scheme !== "file") return false;
  if (IS_XML_ROBOT.test(document.fileName)) return true;
  return document.fileName.toLowerCase().endsWith(".xml") && BEGINS_ROBOT.test(beginOf(document));
}

/** Start the server at the first robot, so that it does not run for XML of other kinds. */
async function startFor(document) {
  await detect(document);
  if (!starting && (document.languageId === "yamaro" || isXmlRobot(document))) starting = start();
  await starting;
}

/** Give a YAML file that holds a robot, or functions of one, the language id, so that other extensions leave it alone. */
async function detect(document) {
  if (document.languageId !== "yaml" || !settings().get("detectLanguage")) return;
  if (IS_TEST.test(document.fileName)) return; // for `yamaro test`
  const text = beginOf(document);
  if (IS_ROBOT.test(text) || HAS_FUNCTIONS.test(text)) {
    await vscode.languages.setTextDocumentLanguage(document, "yamaro");
  }
}

/** Return the main file of the program that the active file is in, and more words for commands. */
async function mainOfActive() {
  const document = vscode.window.activeTextEditor?.document;
  if (document?.uri.scheme !== "file") return undefined;
  const file = document.uri.fsPath;
  const asked = { textDocument: { uri: document.uri.toString() } };
  const found = await client?.sendRequest("yamaro/main", asked).catch(() => undefined);
  return found ? { file: found.main, words: found.words } : { file, words: [] };
}

const trust = () => (settings().get("trust") === "jail" ? "--jail" : "--safe");

/** Run yamaro; return the error or undefined, what it writes, and its messages. */
function run(words) {
  return new Promise((resolve) => {
    execFile(command(), words, { maxBuffer: 256 << 20 }, (error, result, messages) =>
      resolve({ error, result, messages }),
    );
  });
}

/** Convert the active robot to YAML, a xacro robot to a folder, and open the result. */
async function migrate() {
  const main = await mainOfActive();
  if (!main) return;
  const isXacro = main.file.toLowerCase().endsWith(".xacro");
  const stem = path.basename(main.file).split(".")[0];
  const proposed = path.join(path.dirname(main.file), isXacro ? `${stem}_yaml` : `${stem}.urdf.yaml`);
  const prompt = isXacro ? "Folder for the YAML files" : "YAML file to write";
  const target = await vscode.window.showInputBox({ prompt, value: proposed });
  if (!target) return;
  const task = () => run(["migrate", trust(), main.file, ...main.words, "-o", target]);
  const where = { location: vscode.ProgressLocation.Notification, title: "Converting to YAML …" };
  const { error, messages } = await vscode.window.withProgress(where, task);
  output.appendLine(messages);
  if (error) {
    output.show(true);
    await vscode.window.showErrorMessage(`not converted: ${messages.split("\n")[0]}`);
    return;
  }
  const inner = isXacro ? [path.join(target, `${stem}.yaml`), target] : [target];
  const file = inner.find((each) => existsSync(each) && statSync(each).isFile());
  if (file) await vscode.window.showTextDocument(vscode.Uri.file(file), { viewColumn: vscode.ViewColumn.Beside });
  vscode.window.showInformationMessage(messages.trim().split("\n")[0].replace(`${main.file}: `, ""));
}

/** Show the URDF of the active file beside it. */
async function showUrdf() {
  const main = await mainOfActive();
  if (!main) return;
  const { error, result, messages } = await run(["-q", trust(), main.file, ...main.words]);
  const text = error ? `<!-- ${messages.replaceAll("--", "- -")} -->` : result;
  const document = await vscode.workspace.openTextDocument({ language: "xml", content: text });
  await vscode.window.showTextDocument(document, { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true });
}

async function activate(context) {
  output = vscode.window.createOutputChannel("Yamaro");
  const view = new RobotView(context, command, output, mainOfActive);
  context.subscriptions.push(
    output,
    view,
    vscode.commands.registerCommand("yamaro.view", () => view.show()),
    vscode.commands.registerCommand("yamaro.showUrdf", showUrdf),
    vscode.commands.registerCommand("yamaro.migrate", migrate),
    vscode.commands.registerCommand("yamaro.restart", restart),
    vscode.workspace.onDidOpenTextDocument(startFor),
    vscode.window.onDidChangeActiveTextEditor(noteActive),
    vscode.workspace.onDidSaveTextDocument(detect),
    vscode.workspace.onDidChangeConfiguration((event) => {
      if (event.affectsConfiguration("yamaro") && starting) restart();
    }),
    vscode.workspace.onDidGrantWorkspaceTrust(() => starting && restart()),
  );
  noteActive(vscode.window.activeTextEditor);
  for (const document of vscode.workspace.textDocuments) await startFor(document);
}

/** Note whether the active file is a robot in XML, on which menus depend. */
function noteActive(editor) {
  const isRobot = editor !== undefined && isXmlRobot(editor.document);
  vscode.commands.executeCommand("setContext", "yamaro.isRobot", isRobot);
}

const deactivate = () => client?.stop();

module.exports = { activate, deactivate };
