// Copies of link, case, command and numbers, and printing.
import { at, element } from './results.js';
import { commandOf } from './scene.js';

async function copy(text, what) {
  try {
    await navigator.clipboard.writeText(text);
    at('copied').textContent = `${what} copied.`;
  } catch {
    at('copied').textContent = `The browser does not allow copying; find the ${what.toLowerCase()} below or in the address bar.`;
  }
}

// `textNow` returns the case, `summaryNow` the numbers; `runOwn` runs a case of the reader.
export function buildTaking({ textNow, summaryNow, runOwn }) {
  at('copy-link').addEventListener('click', () => copy(location.href, 'Link'));
  at('copy-case').addEventListener('click', () => copy(textNow(), 'Case'));
  at('copy-command').addEventListener('click', () => copy(commandOf(textNow()), 'Command'));
  at('save-summary').addEventListener('click', () => {
    const address = URL.createObjectURL(new Blob([JSON.stringify(summaryNow(), null, 2)], { type: 'application/json' }));
    element('a', '', { href: address, download: 'summary.json' }).click();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
  });
  at('paste-fill').addEventListener('click', () => {
    at('paste').value = textNow();
  });
  at('paste-run').addEventListener('click', () => runOwn(at('paste').value));
  openForPrint();
}

// Opens details for printing, on a light background.
function openForPrint() {
  let opened = [];
  let theme = null;
  addEventListener('beforeprint', () => {
    theme = document.documentElement.dataset.theme;
    document.documentElement.dataset.theme = 'light';
    opened = ['off-details', 'means-details', 'case-details'].map(at).filter((details) => !details.open);
    for (const details of opened) details.open = true;
  });
  addEventListener('afterprint', () => {
    document.documentElement.dataset.theme = theme;
    for (const details of opened) details.open = false;
    opened = [];
  });
}
