// What all checks of the page share: the browser, the command, what differs between them.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch } from './browser.mjs';

export const [pageFile, program, cases, screenshots] = process.argv.slice(2).map((path) => resolve(path));
export const address = pathToFileURL(pageFile).href;
export const scratch = mkdtempSync(join(tmpdir(), 'check-page-'));
mkdirSync(screenshots, { recursive: true });

// Functions of libm differ in the last digit between a browser and a machine, and contact on and off
// passes that on: up to 3e-14 has been seen. Ting's model, whose steps would multiply a last digit, has its own.
export const SAME = 1e-9;
// What programs write and people do not: 2.8647e-4 m, 1000 mN.
export const OF_MACHINES = /\de[-+]?\d|\b1000 [a-zµ]|NaN|undefined|null/;
const NUMBERS = ['restitution', 'contact_time_s', 'peak_force_n', 'max_approach_m', 'max_contact_radius_m', 'peak_pressure_pa'];

export const say = (text) => console.log(text);

export function native(text) {
  const folder = mkdtempSync(join(scratch, 'run-'));
  const out = join(folder, 'out');
  writeFileSync(join(folder, 'case.toml'), text);
  execFileSync(program, ['case.toml', '--out', out, '--quiet'], { cwd: folder, stdio: ['ignore', 'ignore', 'pipe'] });
  return JSON.parse(readFileSync(join(out, 'summary.json'), 'utf8'));
}

// Largest relative difference of what a collision is known by, and of what is in each account.
export function difference(own, other) {
  const pairs = NUMBERS.map((key) => [own[key], other[key]]);
  for (const [key, value] of Object.entries(other.energy)) {
    // A residual is what rounding leaves; it counts next to the whole.
    const scale = key.startsWith('residual') ? 1 : null;
    if (value !== null && key.endsWith('_j')) pairs.push([own.energy[key], value, scale ?? other.energy.initial_j]);
  }
  return Math.max(...pairs.map(([a, b, scale]) => {
    assert.equal(a === null, b === null);
    return a === null ? 0 : Math.abs(a - b) / (scale ?? Math.abs(b));
  }));
}

export const shot = (page, name) => page.screenshot({ path: join(screenshots, `${name}.png`), fullPage: true });
export const browser = await launch();
const checks = [];
export const check = (name, act) => checks.push([name, act]);

// All that were asked for; those whose name has the text in ONLY, if it is set.
export async function runChecks() {
  let failures = 0;
  const only = process.env.ONLY;
  for (const [name, act] of checks) {
    if (only && !name.includes(only)) continue;
    try {
      console.log(name);
      await act();
    } catch (error) {
      failures += 1;
      console.error(`FAILED ${name}\n${error.stack}`);
    }
  }
  await browser.close();
  rmSync(scratch, { recursive: true });
  console.log(failures === 0 ? 'all checks passed' : `${failures} checks failed`);
  process.exit(failures === 0 ? 0 : 1);
}
