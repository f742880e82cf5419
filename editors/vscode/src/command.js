// Finds the yamaro command by its full path. A name alone would be searched for in the working
// directory as well: by Windows always, by others for an empty entry of PATH.
const { accessSync, constants, statSync } = require("node:fs");
const path = require("node:path");

/** Return the path of a program on PATH, or "" if there is none; one with a folder is as it is. */
function findProgram(name, { environment = process.env, platform = process.platform } = {}) {
  const { delimiter, isAbsolute, join, extname } = platform === "win32" ? path.win32 : path.posix;
  if (/[\\/]/.test(name)) return name;
  const key = Object.keys(environment).find((each) => each.toUpperCase() === "PATH");
  const file = platform === "win32" && !extname(name) ? `${name}.exe` : name;
  for (const folder of (environment[key] ?? "").split(delimiter)) {
    if (!isAbsolute(folder)) continue;
    const found = join(folder, file);
    try {
      accessSync(found, constants.X_OK);
      if (statSync(found).isFile()) return found;
    } catch {
      continue;
    }
  }
  return "";
}

module.exports = { findProgram };
