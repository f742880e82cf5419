// Talks with the server, which is found relative to the page: the token is in its address.

/**
 * Call `onState` with the state, now and whenever it changes.
 * @param {(state: object) => void} onState
 * @param {(isConnected: boolean) => void} onConnection
 */
export function follow(onState, onConnection) {
  let isFetching = false;
  let isStale = false;

  async function fetchState() {
    if (isFetching) {
      isStale = true;
      return;
    }
    isFetching = true;
    try {
      const response = await fetch("state");
      if (response.ok) onState(await response.json());
    } catch {
      onConnection(false);
    }
    isFetching = false;
    if (isStale) {
      isStale = false;
      fetchState();
    }
  }

  const events = new EventSource("events");
  events.onopen = () => onConnection(true);
  events.onmessage = fetchState;
  events.onerror = () => onConnection(false);
}

/**
 * Ask the server for something.
 * @returns {Promise<string>} why it was refused, or the empty string
 */
export async function post(action, content) {
  return (await ask(action, content)).fault ?? "";
}

/**
 * Ask the server for something.
 * @returns {Promise<object>} its answer; `fault` is why there is none
 */
export async function ask(action, content) {
  try {
    const response = await fetch(action, {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify(content),
    });
    return response.ok ? await response.json() : { fault: await response.text() };
  } catch {
    return { fault: "yamaro view has ended" };
  }
}

/** Return a function that posts what it is given, one at a time; of those that wait, the last. */
export function latestPoster(action, onRefusal) {
  let isBusy = false;
  let waiting = null;

  return async function send(content) {
    waiting = { ...waiting, ...content };
    if (isBusy) return;
    isBusy = true;
    while (waiting) {
      const next = waiting;
      waiting = null;
      const refusal = await post(action, next);
      if (refusal) onRefusal(refusal);
    }
    isBusy = false;
  };
}
