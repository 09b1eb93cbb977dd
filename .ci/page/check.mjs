// The page in a real browser: node check.mjs PAGE FEM_RUN CASES SCREENSHOTS
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { collision, launch, open, paste, ran, settled } from './browser.mjs';

const [pageFile, program, cases, screenshots] = process.argv.slice(2).map((path) => resolve(path));
const address = pathToFileURL(pageFile).href;
const scratch = mkdtempSync(join(tmpdir(), 'check-page-'));
mkdirSync(screenshots, { recursive: true });

// Functions of libm differ in the last digit between a browser and a machine, and contact on and off
// passes that on: up to 3e-14 has been seen.
const SAME = 1e-9;
const NUMBERS = ['restitution', 'contact_time_s', 'peak_force_n', 'max_approach_m', 'max_contact_radius_m', 'peak_pressure_pa'];
const CASES = ['glass_0.5ms', 'glass_0.5ms_elastic', 'glass_0.5ms_elastic_bulk', 'glass_twins', 'glass_on_wall'];

const said = [];
function say(text) {
  said.push(text);
  console.log(text);
}

function native(text) {
  const folder = mkdtempSync(join(scratch, 'run-'));
  const out = join(folder, 'out');
  writeFileSync(join(folder, 'case.toml'), text);
  execFileSync(program, ['case.toml', '--out', out, '--quiet'], { cwd: folder, stdio: ['ignore', 'ignore', 'pipe'] });
  return JSON.parse(readFileSync(join(out, 'summary.json'), 'utf8'));
}

// Largest relative difference of what a collision is known by, and of what is in each account.
function difference(own, other) {
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

const shot = (page, name) => page.screenshot({ path: join(screenshots, `${name}.png`), fullPage: true });
const browser = await launch();
const checks = [];
const check = (name, act) => checks.push([name, act]);

check('it loads without a complaint, and shows a collision', async () => {
  const { page, complaints, began } = await open(browser, address);
  const first = await ran(page, async () => {});
  say(`  first picture after ${Date.now() - began} ms, ${first.summary.bodies.map((body) => body.elements)} elements`);
  assert.equal(await page.locator('#picture-svg > svg').count(), 1);
  assert.equal(await page.locator('#chart-force > svg, #chart-approach > svg, #chart-energy > svg').count(), 3);
  // The bodies end at the frame of their picture.
  const overflow = await page.locator('#picture-svg svg svg').evaluate((inner) => getComputedStyle(inner).overflow);
  assert.equal(overflow, 'hidden');
  assert.ok((await page.locator('#effects-on li').count()) > 0);
  await shot(page, 'desktop');
  assert.deepEqual(complaints, []);
  await page.context().close();
});

check('the numbers of five shipped cases are the command’s to 1e-9', async () => {
  const { page, complaints } = await open(browser, address);
  await settled(page);
  for (const name of CASES) {
    const text = readFileSync(join(cases, `${name}.toml`), 'utf8');
    for (const model of ['fem', 'condensed']) {
      const full = `${text}\n[model]\n${model} = {}\n`;
      const own = await ran(page, () => paste(page, full));
      const off = difference(own.summary, native(full));
      say(`  ${name}, ${model}: ${off.toExponential(1)}, ${Math.round(own.milliseconds)} ms`);
      assert.ok(off < SAME, `${name}, ${model}: ${off}`);
    }
  }
  assert.deepEqual(complaints, []);
  await page.context().close();
});

check('a slider can be dragged, and the numbers are the command’s', async () => {
  const { page, complaints } = await open(browser, address);
  const before = await settled(page);
  const box = await page.locator('#slider-speed').boundingBox();
  const y = box.y + box.height / 2;
  const took = [];
  await page.mouse.move(box.x + 0.566 * box.width, y);
  await page.mouse.down();
  for (let k = 1; k <= 20; k += 1) {
    const moved = await ran(page, () => page.mouse.move(box.x + (0.566 + 0.01 * k) * box.width, y));
    took.push(moved.milliseconds);
  }
  await page.mouse.up();
  const after = await settled(page);
  took.sort((a, b) => a - b);
  say(`  a drag takes ${Math.round(took[10])} ms, at most ${Math.round(took[19])} ms`);
  assert.ok(after.summary.bodies[0].velocity_before_m_s > 1.5 * before.summary.bodies[0].velocity_before_m_s);
  assert.ok(difference(after.summary, native(after.text)) < SAME);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

check('every model can be chosen, and says what it has', async () => {
  const { page, complaints } = await open(browser, address);
  await settled(page);
  for (const model of ['hertz', 'law', 'ting', 'auto', 'condensed', 'fem']) {
    const own = await ran(page, () => page.selectOption('[data-key="model"]', model));
    assert.ok(difference(own.summary, native(own.text)) < SAME, model);
    assert.equal(await page.locator('#picture-svg > svg').count(), ['condensed', 'fem'].includes(model) ? 1 : 0, model);
  }
  for (const shape of ['wall', 'half_space']) {
    await page.selectOption('[data-key="model"]', 'condensed');
    const own = await ran(page, () => page.selectOption('[data-key="partner.shape"]', shape));
    await settled(page);
    assert.ok(difference((await collision(page)).summary, native((await collision(page)).text)) < SAME, own.text);
  }
  assert.deepEqual(complaints, []);
  await page.context().close();
});

check('what is wrong is said at its place, and the numbers stand back', async () => {
  const { page, complaints } = await open(browser, address);
  await settled(page);
  const glass = readFileSync(join(cases, 'glass_0.5ms.toml'), 'utf8');
  await paste(page, glass.replace('"22.2 mm"', '"-22.2 mm"').replace('0.244', '0.9'));
  await page.locator('#paste-fault').waitFor();
  const negative = await page.locator('#paste-fault').innerText();
  assert.match(negative, /Line 20, column 23/);
  assert.match(negative, /greater than 0/);
  assert.match(negative, /poissons_ratio/);
  await shot(page, 'fault');
  await paste(page, `${glass}\n[[body]]\nname = "third"\nsphere = { diameter = "1 cm" }\nmaterial = "glass"\n`);
  await page.waitForFunction(() => /3/.test(document.querySelector('#paste-fault strong')?.textContent));
  assert.match(await page.locator('#paste-fault').innerText(), /bod/);
  assert.ok(await page.locator('#results.stale').count());
  // A text with tags in it stays a text.
  await ran(page, () => paste(page, glass.replace(/title = .*/, 'title = "<img src=x onerror=alert(1)>"').replaceAll('"striker"', '"s"')));
  assert.equal(await page.locator('#results.stale').count(), 0);
  assert.equal(await page.locator('img').count(), 0);
  // A number that a slider does not have.
  await page.click('#reset');
  await settled(page);
  const number = page.locator('.slider[data-key="speed"] input[type="number"]');
  await number.fill('-3');
  await number.press('Enter');
  await page.locator('#fault').waitFor();
  assert.match(await page.locator('#fault').innerText(), /Approach speed: -3/);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

check('a slow model shows how far it is, and can be ended', async () => {
  const { page, complaints } = await open(browser, address);
  await settled(page);
  // Elements a tenth as long as the plan's: a minute of computing.
  const glass = readFileSync(join(cases, 'glass_0.5ms.toml'), 'utf8');
  await paste(page, `${glass}\n[mesh]\ncontact_element_size = "6 um"\n[model]\nfem = {}\n`);
  await page.locator('#progress').waitFor();
  await page.waitForFunction(() => document.getElementById('progress-bar').value > 0.02, null, { timeout: 60_000 });
  assert.match(await page.locator('#progress-text').innerText(), /steps of [\d,]+ elements/);
  await shot(page, 'progress');
  const ended = await ran(page, () => page.click('#cancel'));
  assert.equal(ended.summary.complete, false);
  assert.match(await page.locator('#warnings').innerText(), /Not complete/);
  // Another slider takes the place of a run that goes on.
  await page.click('#paste-run');
  await page.waitForFunction(() => document.getElementById('progress-bar').value > 0.002, null, { timeout: 60_000 });
  const whole = await ran(page, () => page.selectOption('[data-key="model"]', 'ting'));
  assert.equal(whole.summary.complete, true);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

check('what is too large is refused, and a worker that does not hear is replaced', async () => {
  const { page, complaints } = await open(browser, address);
  await settled(page);
  const glass = readFileSync(join(cases, 'glass_0.5ms.toml'), 'utf8');
  const fine = (size, limits) => `${glass}\n[mesh]\ncontact_element_size = "${size} um"\n${limits}\n[model]\ncondensed = {}\n`;
  await paste(page, fine(2, ''));
  await page.locator('#paste-fault').waitFor();
  assert.match(await page.locator('#paste-fault').innerText(), /limits.memory/);
  await paste(page, fine(0.8, '[limits]\nelements = 1e8\nmemory = 1e12'));
  await page.locator('#progress').waitFor();
  await page.click('#cancel');
  await page.waitForFunction(() => /^Ended/.test(document.getElementById('status').textContent), null, { timeout: 30_000 });
  const again = await ran(page, () => page.click('#reset'));
  assert.ok(again.summary.complete);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

check('a link and a command carry the case', async () => {
  const { page } = await open(browser, `${address}#speed=1.25&partner.shape=wall&striker.material=steel`);
  const own = await settled(page);
  assert.match(own.text, /approach_speed = "1.25 m\/s"/);
  const { page: again } = await open(browser, page.url());
  assert.equal((await settled(again)).text, own.text);
  await paste(again, own.text.replace('1.25 m/s', '1.5 m/s'));
  const pasted = await settled(again);
  const { page: third } = await open(browser, again.url());
  assert.equal((await settled(third)).text, pasted.text);
  assert.deepEqual((await collision(third)).summary.restitution, pasted.summary.restitution);
  const command = await third.locator('#command').textContent();
  const folder = mkdtempSync(join(scratch, 'command-'));
  execFileSync('bash', ['-c', command.replace(/^fem-run /m, `'${program}' --quiet `)], { cwd: folder, stdio: 'ignore' });
  const summary = JSON.parse(readFileSync(join(folder, 'runs', 'case', 'summary.json'), 'utf8'));
  assert.ok(difference(pasted.summary, summary) < SAME);
  for (const each of [page, again, third]) await each.context().close();
});

check('stories tell numbers of their own runs, and draw them', async () => {
  const { page, complaints } = await open(browser, address);
  await settled(page);
  const names = await page.locator('#stories button').allInnerTexts();
  assert.equal(names.length, 4);
  for (const [k, name] of names.entries()) {
    await page.getByRole('button', { name }).click();
    let steps = 1;
    for (;;) {
      await page.waitForFunction(() => document.getElementById('story-text').textContent.length > 80);
      if (await page.locator('#story-next').isDisabled()) break;
      await page.click('#story-next');
      steps += 1;
    }
    await page.locator('#story-chart svg').waitFor({ timeout: 60_000 });
    await settled(page);
    const text = await page.locator('#story-text').innerText();
    assert.doesNotMatch(text, /NaN|undefined|null/);
    say(`  ${name} ${steps} steps: ${text.slice(0, 90)}…`);
    await page.locator('#story').screenshot({ path: join(screenshots, `story-${k + 1}.png`) });
  }
  assert.deepEqual(complaints, []);
  await page.context().close();
});

check('the keyboard alone leads everywhere', async () => {
  const { page, complaints } = await open(browser, address);
  await settled(page);
  const focused = () => page.evaluate(() => document.activeElement.id || document.activeElement.dataset.key || document.activeElement.textContent.trim().slice(0, 20));
  const reached = new Set();
  for (let k = 0; k < 60; k += 1) {
    await page.keyboard.press('Tab');
    reached.add(await focused());
  }
  for (const id of ['theme', 'slider-striker-diameter', 'partner.shape', 'slider-speed', 'model', 'reset', 'instant', 'zoom', 'play', 'copy-link']) {
    assert.ok(reached.has(id), `${id} is not reached: ${[...reached]}`);
  }
  const before = await settled(page);
  await page.locator('#slider-speed').focus();
  const after = await ran(page, () => page.keyboard.press('ArrowRight'));
  assert.notEqual(after.text, before.text);
  const caption = await page.locator('#picture-caption').innerText();
  await page.locator('#instant').focus();
  await page.keyboard.press('Home');
  await page.waitForFunction((old) => document.getElementById('picture-caption').textContent !== old, caption);
  await page.locator('#stories button').nth(1).focus();
  await page.keyboard.press('Enter');
  assert.equal(await focused(), 'story-title');
  await settled(page);
  await page.locator('#story-close').focus();
  await page.keyboard.press('Enter');
  assert.match(await focused(), /^Why does the contact/);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

check('whatever can be used has a name for who cannot see it', async () => {
  const { page } = await open(browser, address);
  await settled(page);
  await page.$$eval('details', (all) => all.forEach((details) => { details.open = true; }));
  const nameless = await page.$$eval('input, select, textarea, button, progress, [role="img"]', (all) => all
    .filter((one) => !one.getAttribute('aria-label') && !one.labels?.length && !(one.tagName === 'BUTTON' && one.textContent.trim()))
    .map((one) => one.outerHTML.slice(0, 80)));
  assert.deepEqual(nameless, []);
  await page.context().close();
});

check('a phone and a dark ground', async () => {
  const phone = await open(browser, address, { viewport: { width: 400, height: 800 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
  await settled(phone.page);
  const wide = await phone.page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 400, `${wide} px`);
  await shot(phone.page, 'phone');
  const dark = await open(browser, address, { colorScheme: 'dark' });
  await settled(dark.page);
  assert.equal(await dark.page.evaluate(() => document.documentElement.dataset.theme), 'dark');
  await shot(dark.page, 'dark');
  await dark.page.click('#theme');
  assert.equal(await dark.page.evaluate(() => document.documentElement.dataset.theme), 'light');
  assert.deepEqual([...phone.complaints, ...dark.complaints], []);
  for (const { page } of [phone, dark]) await page.context().close();
});

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
