// The worker and what is asked of it.

// Within which a worker that computes hears that it should end, at most: else another one takes its place.
const PATIENCE_MS = 1500;

export class Runner {
  #worker;
  #open = new Map();
  #last = 0;

  constructor() {
    this.#begin();
  }

  // A worker made of the page's own text, with the module in it.
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

  // The answer, of kind done, fault, failed, dropped or ended; `onway` hears of begun and progress.
  async ask(kind, body = {}, onway = null) {
    if (kind !== 'start') await this.ready;
    this.#last += 1;
    const id = this.#last;
    return new Promise((resolve) => {
      this.#open.set(id, { resolve, onway });
      this.#worker.postMessage({ id, kind, ...body });
    });
  }

  // Nothing is told of a run under way, if there is one.
  drop() {
    this.#worker.postMessage({ kind: 'drop' });
  }

  // What there is so far is told of a run under way. One that does not hear, since it makes meshes or
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

// One asked at a time, and only the last of those that wait; `hear` is told whether any is open.
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
