// Bundles the extension into dist/extension.js, with the licenses of what is in the bundle.
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { build } from "esbuild";

const options = { platform: "node", format: "cjs", target: "node18", bundle: true, minify: true, logLevel: "warning" };
await build({ ...options, entryPoints: ["src/goto.js"], outfile: "dist/goto.js" });
const { metafile } = await build({
  ...options,
  entryPoints: ["src/extension.js"],
  outfile: "dist/extension.js",
  external: ["vscode"],
  metafile: true,
});

const packages = new Set();
for (const file of Object.keys(metafile.inputs)) {
  const found = /^(.*node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(file);
  if (found) packages.add(found[1]);
}
const notices = [...packages].sort().map((folder) => {
  const { name, version, license } = JSON.parse(readFileSync(path.join(folder, "package.json"), "utf8"));
  const file = readdirSync(folder).find((each) => /^licen[cs]e/i.test(each));
  const text = file ? readFileSync(path.join(folder, file), "utf8").trim() : license;
  return `${name} ${version} (${license})\n\n${text}\n`;
});
writeFileSync("dist/THIRD-PARTY.txt", notices.join(`\n${"-".repeat(80)}\n\n`));
