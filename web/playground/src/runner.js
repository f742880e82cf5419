// The worker in which Yamaro runs, seen from the page: ended and begun anew when it hangs.

const LONGEST = 11_500; // milliseconds; Yamaro itself ends what takes longer than 10 s, where it can
const LONGEST_START = 90_000;

export class Runner {
  /**
   * @param {object} told `onStart()`; `onRestart()` and `onFailure()`: the files have to be opened again
   * @param {Promise} quiet when the page has shown a robot, which Python would slow down
   */
  constructor(told, quiet) {
    this.told = told;
    this.waiting = new Map();
    this.lastId = 0;
    const early = [];
    this.isStarted = false;
    this.worker = { postMessage: (message) => early.push(message), terminate() {} };
    quiet.then(() => {
      this.begin();
      for (const message of early) this.worker.postMessage(message);
    });
  }

  begin() {
    this.isStarted = false;
    this.worker = new Worker(new URL("worker.js", document.baseURI), { type: "module" });
    this.worker.onmessage = ({ data }) => this.take(data);
    this.worker.onerror = (event) => this.fail(`Python could not be started${event.message ? `: ${event.message}` : ""}`);
    this.clock = setTimeout(() => this.fail("Python did not start within 90 s"), LONGEST_START);
  }

  /** Give up; what is asked next begins anew. */
  fail(reason) {
    this.end(`${reason}; change the text to try again`);
    this.isStarted = false;
    this.worker = null;
    this.told.onFailure();
  }

  take({ id, value, fault }) {
    if (id === 0) {
      clearTimeout(this.clock);
      if (fault) return this.fail(`Python could not be started: ${fault}`);
      this.isStarted = true;
      for (const one of this.waiting.values()) one.begin();
      return this.told.onStart();
    }
    const asked = this.waiting.get(id);
    this.waiting.delete(id);
    clearTimeout(asked?.clock);
    asked?.settle(fault === undefined ? value : { fault: `internal error: ${fault}` });
  }

  /**
   * Ask the worker.
   * @returns {Promise<object>} its answer; `fault` is why there is none
   */
  ask(method, content) {
    if (!this.worker) this.begin();
    const id = ++this.lastId;
    return new Promise((settle) => {
      const asked = { settle, clock: 0, begin: () => {} };
      asked.begin = () => (asked.clock = setTimeout(() => this.restart(), LONGEST));
      this.waiting.set(id, asked);
      if (this.isStarted) asked.begin();
      this.worker.postMessage({ id, method, content });
    });
  }

  restart() {
    this.end("stopped after 10 s: this does not end, or takes too long");
    this.begin();
    this.told.onRestart();
  }

  end(reason) {
    clearTimeout(this.clock);
    this.worker.terminate();
    const waiting = [...this.waiting.values()];
    this.waiting.clear();
    for (const asked of waiting) {
      clearTimeout(asked.clock);
      asked.settle({ fault: reason, isStopped: true });
    }
  }
}
