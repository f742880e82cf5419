// Bundles the page into the Python package: one script, with what it needs of three.js and
// urdf-loader, and no request to any other place.
//
//   node build.mjs FOLDER

import { cpSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const target = process.argv[2];
if (!target) throw new Error("usage: node build.mjs FOLDER");
mkdirSync(target, { recursive: true });

const options = { bundle: true, minify: true, legalComments: "none", target: "es2022" };
const banner = "/* Made by scripts/web from web/; see THIRD-PARTY.txt for what is in it. */";
await build({
  ...options,
  entryPoints: [join(here, "src/main.js")],
  format: "esm",
  banner: { js: banner },
  outfile: join(target, "view.js"),
  absWorkingDir: here,
});
await build({ ...options, entryPoints: [join(here, "view.css")], outfile: join(target, "view.css") });
for (const name of ["index.html", "icon.svg"]) cpSync(join(here, name), join(target, name));

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
