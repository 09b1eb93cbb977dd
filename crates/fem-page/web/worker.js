// Runs the module: one case at a time, in slices, between which it receives messages from the page.
'use strict';

const SLICE_MS = 40;
const encoder = new TextEncoder();
const decoder = new TextDecoder();
let compiled = null;
let page = null;
let job = null;

function write(text) {
  const bytes = encoder.encode(text);
  const place = page.page_reserve(bytes.length);
  new Uint8Array(page.memory.buffer, place, bytes.length).set(bytes);
}

function answerText() {
  return decoder.decode(new Uint8Array(page.memory.buffer, page.page_answer(), page.page_answer_length()));
}

function answer() {
  return JSON.parse(answerText());
}

async function instantiate() {
  page = (await WebAssembly.instantiate(compiled, {})).exports;
}

// The module is compressed to about a third of its size.
async function start({ id, packed }) {
  const bytes = Uint8Array.from(atob(packed), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  compiled = await WebAssembly.compile(await new Response(stream).arrayBuffer());
  await instantiate();
  page.page_materials();
  postMessage({ id, kind: 'done', materials: answer() });
}

// A trap leaves the module in an undefined state, so it is replaced by a new one.
async function failed(id, error) {
  const said = answerText();
  const reason = `${said || 'It gave no message: most likely it had no memory left; a browser gives it 4 GB at most.'} (${error})`;
  job = null;
  await instantiate();
  postMessage({ id, kind: 'failed', message: reason });
}

function guarded(id, act) {
  try {
    act();
  } catch (error) {
    failed(id, error);
  }
}

function begin({ id, text, rows, frames, share, halfWidth }) {
  if (job) postMessage({ id: job.id, kind: 'dropped' });
  job = { id, share, halfWidth, started: performance.now(), isOver: false };
  write(text);
  const isFaulty = page.page_begin(rows, frames);
  if (isFaulty) {
    job = null;
    postMessage({ id, kind: 'fault', fault: answer() });
    return;
  }
  postMessage({ id, kind: 'begun', begun: answer() });
  slice(job);
}

function slice(own) {
  if (job !== own) return;
  const until = performance.now() + SLICE_MS;
  let done = own.isOver ? 1 : 0;
  while (done < 1 && performance.now() < until) done = page.page_advance(1);
  if (done < 1) {
    postMessage({ id: own.id, kind: 'progress', done });
    setTimeout(() => guarded(own.id, () => slice(own)), 0);
    return;
  }
  job = null;
  page.page_finish((performance.now() - own.started) / 1000);
  const outcome = answer();
  const index = own.share === null ? strongest(outcome.frames) : Math.round(own.share * (outcome.frames.length - 1));
  const seconds = (performance.now() - own.started) / 1000;
  postMessage({ id: own.id, kind: 'done', outcome, picture: drawn(index, own.halfWidth), index, seconds });
}

// Returns the index of the frame with the largest force; −1 without frames.
function strongest(frames) {
  return frames.reduce((best, frame, k) => (best < 0 || frame.contact_force_n > frames[best].contact_force_n ? k : best), -1);
}

function drawn(index, halfWidth) {
  if (index < 0) return null;
  page.page_picture(index, halfWidth);
  return answer();
}

const handlers = {
  start,
  begin,
  cancel() {
    if (job) job.isOver = true;
  },
  drop() {
    if (!job) return;
    postMessage({ id: job.id, kind: 'dropped' });
    job = null;
  },
  picture({ id, index, halfWidth }) {
    postMessage({ id, kind: 'done', picture: drawn(index, halfWidth), index });
  },
  chart({ id, spec }) {
    write(JSON.stringify(spec));
    page.page_chart();
    postMessage({ id, kind: 'done', svg: answer() });
  },
};

onmessage = ({ data }) => {
  if (data.kind === 'start') start(data).catch((error) => postMessage({ id: data.id, kind: 'failed', message: String(error) }));
  else guarded(data.id, () => handlers[data.kind](data));
};
