// In place of ../../src/connection.js: the viewer talks with the page around it, not with a server.

let lastId = 0;
const waiting = new Map();

/** Call `onState` with the state, now and whenever it changes. */
export function follow(onState, onConnection) {
  window.addEventListener("message", ({ source, data }) => {
    if (source !== window.parent) return;
    if (data?.type === "yamaro.hello") sayReady(); // the page came later, and did not hear it
    if (data?.type === "yamaro.state") {
      onConnection(true);
      // The page around tells what is wrong, at length.
      document.getElementById("fault").classList.toggle("folded", Boolean(data.state.fault));
      onState(data.state);
    }
    if (data?.type === "yamaro.answer") {
      waiting.get(data.id)?.(data.answer);
      waiting.delete(data.id);
    }
  });
  sayReady();
}

function sayReady() {
  window.parent.postMessage({ type: "yamaro.ready" }, window.location.origin);
}

/** Ask the page around for something; return its answer, in which `fault` is why there is none. */
export function ask(action, content) {
  const id = ++lastId;
  window.parent.postMessage({ type: "yamaro.ask", id, action, content }, window.location.origin);
  return new Promise((settle) => waiting.set(id, settle));
}

/** Ask the page around for something; return why it was refused, or the empty string. */
export async function post(action, content) {
  return (await ask(action, content)).fault ?? "";
}

/** Return a function that posts what it is given. */
export function latestPoster(action, onRefusal) {
  return async (content) => {
    const refusal = await post(action, content);
    if (refusal) onRefusal(refusal);
  };
}
