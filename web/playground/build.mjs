// Builds the playground into a folder that any web server can serve as it is.
//
//   node build.mjs FOLDER     with yamaro.zip and examples.json in it, which pack.py makes

import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { loadPyodide } from "pyodide";

const here = dirname(fileURLToPath(import.meta.url));
const web = dirname(here);
if (!process.argv[2]) throw new Error("usage: node build.mjs FOLDER");
const target = resolve(process.argv[2]);
const options = { absWorkingDir: here, bundle: true, minify: true, legalComments: "none", target: "es2022" };
const pyodide = join(here, "node_modules/pyodide");

await build({ ...options, entryPoints: ["src/page.js"], format: "esm", outfile: join(target, "playground.js") });
await build({ ...options, entryPoints: ["playground.css"], outfile: join(target, "playground.css") });
await build({
  ...options,
  entryPoints: ["src/worker.js"],
  format: "esm",
  external: ["./pyodide/pyodide.mjs"],
  outfile: join(target, "worker.js"),
});
cpSync(join(here, "index.html"), join(target, "index.html"));

// The viewer is the page of `yamaro view`, which talks with the playground in place of a server.
const viewer = join(target, "viewer");
mkdirSync(viewer, { recursive: true });
const connection = {
  name: "connection",
  setup: (setup) =>
    setup.onResolve({ filter: /^\.\/connection\.js$/ }, () => ({ path: join(here, "src/viewer-connection.js") })),
};
await build({
  ...options,
  absWorkingDir: web,
  entryPoints: ["src/main.js"],
  format: "esm",
  plugins: [connection],
  outfile: join(viewer, "view.js"),
});
await build({ ...options, absWorkingDir: web, entryPoints: ["view.css"], outfile: join(viewer, "view.css") });
for (const name of ["index.html", "icon.svg"]) cpSync(join(web, name), join(viewer, name));

mkdirSync(join(target, "pyodide"), { recursive: true });
for (const name of ["pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm"]) {
  cpSync(join(pyodide, name), join(target, "pyodide", name));
}

// Python with its library and Yamaro, made by that Python.
const python = await loadPyodide();
const own = join(target, "yamaro.zip");
python.FS.writeFile("/own.zip", readFileSync(own));
python.FS.writeFile("/standard.zip", readFileSync(join(pyodide, "python_stdlib.zip")));
python.globals.set("examples", readFileSync(join(target, "examples.json"), "utf8"));
python.runPython(readFileSync(join(here, "archive.py"), "utf8"));
const archive = python.runPython(`
import json
sys.path.insert(0, "/own.zip")
import bridge
playground = bridge.Playground("/robot")
for example in json.loads(examples):
    playground.open(example["files"], example["main"], is_trusted=True)
    playground.build()
    for format in "xml", "mjcf", "sdf":
        written = json.loads(playground.write(format))
        if example["name"] == "pan_tilt":  # so that the readers of these formats are byte code too
            playground.open({f"robot.{format}": written["text"]}, f"robot.{format}", is_trusted=True)
            playground.build()
            playground.open(example["files"], example["main"], is_trusted=True)
combined("/standard.zip", "/own.zip")
`);
writeFileSync(join(target, "python.bin"), archive.toJs());
archive.destroy();
rmSync(own);

// No package is loaded from anywhere, so none is named.
const lock = JSON.parse(readFileSync(join(pyodide, "pyodide-lock.json"), "utf8"));
writeFileSync(join(target, "pyodide", "pyodide-lock.json"), JSON.stringify({ ...lock, packages: {} }));

const notices = [
  ["Pyodide", pyodide, "https://github.com/pyodide/pyodide", "its sources are there"],
  ...["codemirror", "@codemirror/state", "@codemirror/view", "@codemirror/language", "@lezer/lr"].map((name) => [
    name,
    join(here, "node_modules", name),
  ]),
  ["three", join(web, "node_modules/three")],
  ["urdf-loader", join(web, "node_modules/urdf-loader")],
].map(([name, folder, home, more]) => {
  const { version, license, homepage, repository } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  const url = home ?? homepage ?? repository?.url ?? "";
  return `${name} ${version} (${license}) ${url}${more ? `; ${more}` : ""}`;
});
writeFileSync(
  join(target, "THIRD-PARTY.txt"),
  `The playground holds these packages. Python's standard library is part of Pyodide (PSF-2.0),
PyYAML of python.bin (MIT). Texts of the licences: licenses/.\n\n${notices.join("\n")}\n`,
);
cpSync(join(web, "licenses"), join(target, "licenses"), { recursive: true });
cpSync(join(here, "node_modules/codemirror/LICENSE"), join(target, "licenses", "codemirror.txt"));
cpSync(join(web, "node_modules/three/LICENSE"), join(target, "licenses", "three.txt"));
