// The worker and requests to it.

// Time in which a computing worker must react to a request to end; otherwise it is replaced.
const PATIENCE_MS = 1500;

export class Runner {
  #worker;
  #open = new Map();
  #last = 0;

  constructor() {
    this.#begin();
  }

  // The worker is created from the text of the page, with the module in it.
  #begin() {
    const source = document.getElementById('worker').textContent;
    try {
      this.#worker = new Worker(URL.createObjectURL(new Blob([source], { type: 'text/javascript' })));
    } catch (error) {
      this.ready = Promise.resolve({ kind: 'failed', message: String(error) });
      return;
    }
    this.#worker.onmessage = ({ data }) => this.#hear(data);
    this.#worker.onerror = (event) => this.#fail(event.message || 'the worker did not start');
    this.ready = this.ask('start', { packed: document.getElementById('module').textContent.trim() });
  }

  #hear(data) {
    const asked = this.#open.get(data.id);
    if (!asked) return;
    if (data.kind === 'begun' || data.kind === 'progress') {
      asked.onway?.(data);
      return;
    }
    this.#open.delete(data.id);
    asked.resolve(data);
  }

  #fail(message) {
    for (const { resolve } of this.#open.values()) resolve({ kind: 'failed', message });
    this.#open.clear();
  }

  // Returns the answer, of kind done, fault, failed, dropped or ended; `onway` receives begun and progress.
  async ask(kind, body = {}, onway = null) {
    if (kind !== 'start') await this.ready;
    this.#last += 1;
    const id = this.#last;
    return new Promise((resolve) => {
      this.#open.set(id, { resolve, onway });
      this.#worker.postMessage({ id, kind, ...body });
    });
  }

  // Drops the current run without an answer, if there is one.
  drop() {
    this.#worker.postMessage({ kind: 'drop' });
  }

  // Ends the current run with its results so far. A run that does not react, because it makes meshes or
  // factors, ends with its worker.
  cancel() {
    const asked = [...this.#open.keys()];
    this.#worker.postMessage({ kind: 'cancel' });
    setTimeout(() => {
      if (!asked.some((id) => this.#open.has(id))) return;
      this.#worker.terminate();
      for (const { resolve } of this.#open.values()) resolve({ kind: 'ended' });
      this.#open.clear();
      this.#begin();
    }, PATIENCE_MS);
  }
}

// Handles one request at a time, and only the last of those that wait; `hear` receives whether any is open.
export function lastOnly(act, hear = () => {}) {
  let waiting = null;
  let isBusy = false;
  return async (...values) => {
    waiting = values;
    if (isBusy) return;
    isBusy = true;
    hear(true);
    while (waiting) {
      const now = waiting;
      waiting = null;
      await act(...now);
    }
    isBusy = false;
    hear(false);
  };
}
