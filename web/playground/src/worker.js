// Runs Yamaro in Pyodide, away from the page. All files come from the folder of the page.
//
// The page asks with {id, method, arguments}; the answer is {id, value}, or {id, fault}.

import { loadPyodide } from "./pyodide/pyodide.mjs";

const here = new URL("./", self.location.href);
let playground = null;
let toPython = null;

/** Return the address of Python's library with Yamaro in it: a ZIP archive, compressed as a whole. */
async function library() {
  const { body } = await fetch(new URL("python.bin", here));
  const archive = await new Response(body.pipeThrough(new DecompressionStream("gzip"))).blob();
  return URL.createObjectURL(archive);
}

async function start() {
  const pyodide = await loadPyodide({
    indexURL: new URL("pyodide/", here).href,
    stdLibURL: await library(),
    checkAPIVersion: true,
  });
  toPython = (value) => pyodide.toPy(value);
  playground = pyodide.runPython('import bridge; bridge.Playground("/robot")');
}

const methods = {
  open({ files, main, isTrusted }) {
    playground.open.callKwargs(toPython(files), main, { is_trusted: isTrusted });
    return this.build();
  },
  change({ name, text }) {
    playground.change(name, text);
    return this.build();
  },
  build: () => JSON.parse(playground.build()),
  write: ({ format }) => JSON.parse(playground.write(format)),
  act({ action, content }) {
    const answer = JSON.parse(playground.act(action, JSON.stringify(content)));
    if (!answer.key) return answer;
    const bytes = playground.fetch(answer.key);
    const data = bytes.toJs();
    bytes.destroy();
    return { ...answer, data };
  },
};

const started = start();
started.then(
  () => self.postMessage({ id: 0, value: "started" }),
  (error) => self.postMessage({ id: 0, fault: String(error) }),
);
self.onmessage = async ({ data: { id, method, content } }) => {
  try {
    await started;
    self.postMessage({ id, value: methods[method](content) });
  } catch (error) {
    self.postMessage({ id, fault: String(error) });
  }
};
