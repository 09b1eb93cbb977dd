// The worker and what is asked of it.

export class Runner {
  #worker;
  #open = new Map();
  #last = 0;

  // A worker made of the page's own text, with the module in it.
  constructor() {
    const source = document.getElementById('worker').textContent;
    const address = URL.createObjectURL(new Blob([source], { type: 'text/javascript' }));
    this.#worker = new Worker(address);
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

  // The answer, of kind done, fault, failed or dropped; `onway` hears of begun and progress.
  ask(kind, body = {}, onway = null) {
    this.#last += 1;
    const id = this.#last;
    return new Promise((resolve) => {
      this.#open.set(id, { resolve, onway });
      this.#worker.postMessage({ id, kind, ...body });
    });
  }

  // What has no answer: cancel (what there is so far is told), drop (nothing is).
  tell(kind) {
    this.#worker.postMessage({ kind });
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
