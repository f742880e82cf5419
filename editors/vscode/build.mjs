// Bundles the extension into dist/extension.js.
import { build } from "esbuild";

await build({
  entryPoints: ["src/extension.js"],
  outfile: "dist/extension.js",
  bundle: true,
  platform: "node",
  format: "cjs",
  target: "node18",
  external: ["vscode"],
  minify: true,
  legalComments: "linked",
  logLevel: "warning",
});
await build({
  entryPoints: ["src/goto.js"],
  outfile: "dist/goto.js",
  platform: "node",
  format: "cjs",
  minify: true,
});
