// The editor around the page, if there is one, tells in which line the cursor is.

/** @param {(file: string, line: number) => void} onLine */
export function followCursor(onLine) {
  if (window.parent === window) return;
  window.addEventListener("message", ({ source, data }) => {
    if (source !== window.parent || data?.type !== "yamaro.line") return;
    onLine(String(data.file), Number(data.line));
  });
}

/** Return the link that is written last at or before a line of a file, as a part is, or null. */
export function linkAt(robot, file, line) {
  let found = null;
  let last = 0;
  const look = (link, place) => {
    const [, name, at] = /^(.*):(\d+):\d+$/.exec(robot.description.places[place] ?? "") ?? [];
    if (name === file && Number(at) <= line && Number(at) > last) {
      found = link;
      last = Number(at);
    }
  };
  for (const [link, known] of robot.linksKnown) look(link, known.place);
  for (const [link, joint] of robot.jointAbove) {
    const known = robot.jointsKnown.get(joint.name);
    if (known) look(link, known.place);
  }
  return found;
}
