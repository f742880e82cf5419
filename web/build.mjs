// Bundles the page into the Python package: one script, with what it needs of three.js and
// urdf-loader, and no request to any other place.
//
//   node build.mjs FOLDER

import { createHash } from "node:crypto";
import { cpSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
if (!process.argv[2]) throw new Error("usage: node build.mjs FOLDER");
const target = resolve(process.argv[2]);
mkdirSync(target, { recursive: true });

const options = { absWorkingDir: here, bundle: true, minify: true, legalComments: "none", target: "es2022" };
// A bundle tells what it was made from: a test without Node.js sees when it is out of date.
const sources = [
  ...readdirSync(join(here, "src")).map((name) => `src/${name}`),
  ...["build.mjs", "colours.css", "icon.svg", "index.html", "notebook.css", "notebook.html", "package-lock.json", "view.css"],
];
const hash = createHash("sha256");
for (const name of sources.sort()) hash.update(`${name}\0`).update(readFileSync(join(here, name)));
const banner = `/* Made by scripts/web; THIRD-PARTY.txt tells what is in it. Sources: ${hash.digest("hex")} */`;
await build({
  ...options,
  entryPoints: [join(here, "src/entry.js")],
  format: "esm",
  banner: { js: banner },
  outfile: join(target, "view.js"),
});
for (const name of ["view.css", "notebook.css"]) {
  await build({ ...options, entryPoints: [join(here, name)], outfile: join(target, name) });
}
for (const name of ["index.html", "notebook.html", "icon.svg"]) cpSync(join(here, name), join(target, name));

const notices = {
  three: () => readFileSync(join(here, "node_modules/three/LICENSE"), "utf8"),
  // Its package names its licence in the readme, and does not bring the text.
  "urdf-loader": () => {
    const readme = readFileSync(join(here, "node_modules/urdf-loader/README.md"), "utf8");
    const notice = readme.slice(readme.lastIndexOf("\nCopyright"));
    return `${notice.trim()}\n\n${readFileSync(join(here, "licenses/Apache-2.0.txt"), "utf8")}`;
  },
};
const packages = Object.entries(notices).map(([name, notice]) => {
  const text = readFileSync(join(here, "node_modules", name, "package.json"), "utf8");
  const { version, license, homepage } = JSON.parse(text);
  return `${name} ${version} (${license})\n${homepage}\n\n${notice().trim()}\n`;
});
const line = `\n${"-".repeat(78)}\n\n`;
writeFileSync(
  join(target, "THIRD-PARTY.txt"),
  `view.js holds code of these packages, minified.\n${line}${packages.join(line)}`,
);
