// The numbers are the command’s, whatever is asked for and however.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { collision, open, paste, ran, settled } from './browser.mjs';
import { OF_MACHINES, SAME, address, browser, cases, check, difference, native, program, say, scratch, screenshots, shot } from './harness.mjs';

const CASES = ['glass_0.5ms', 'glass_0.5ms_elastic', 'glass_0.5ms_elastic_bulk', 'glass_twins', 'glass_on_wall'];

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

check('uncertain inputs have a column of their own, and adhesion a speed', async () => {
  const { page, complaints } = await open(browser, address);
  await settled(page);
  const column = page.locator('#numbers td:nth-child(7)').first();
  assert.ok(!(await column.isVisible()) && !(await page.locator('#adhesion').isVisible()));
  const glass = readFileSync(join(cases, 'glass_0.5ms.toml'), 'utf8');
  const uncertain = `${glass.replace('"63 GPa"', '"63 ± 2 GPa"')}\n[contact]\nwork_of_adhesion = "0.1 J/m^2"\n[model]\ncondensed = {}\n`;
  const own = await ran(page, () => paste(page, uncertain));
  assert.ok(own.summary.uncertainty.contact_time_s.input > 0 && difference(own.summary, native(uncertain)) < SAME);
  assert.match(await page.locator('#numbers tr:nth-child(2) td:nth-child(7)').innerText(), /\d µs/);
  assert.match(await page.locator('#adhesion').innerText(), /100 mJ.* stick. These are faster/);
  assert.match(await page.locator('#case').textContent(), /63 ± 2 GPa/);
  await ran(page, () => page.click('#sliders-back'));
  await ran(page, () => page.selectOption('select[data-key="adhesion.kind"]', 'work'));
  assert.ok(await page.locator('#adhesion').isVisible() && await page.locator('#slider-adhesion-work').isVisible());
  assert.deepEqual(complaints, []);
  await page.context().close();
});

check('a slider can be dragged, and the numbers are the command’s', async () => {
  const { page, complaints } = await open(browser, address);
  const before = await settled(page);
  const box = await page.locator('#slider-speed').boundingBox();
  const y = box.y + box.height / 2;
  const took = [];
  // Safari bears a hundred changes of the address in half a minute.
  await page.evaluate(() => {
    const replace = history.replaceState.bind(history);
    window.addresses = 0;
    history.replaceState = (...values) => { window.addresses += 1; replace(...values); };
  });
  await page.mouse.move(box.x + 0.675 * box.width, y);
  await page.mouse.down();
  for (let k = 1; k <= 20; k += 1) {
    const moved = await ran(page, () => page.mouse.move(box.x + (0.675 + 0.01 * k) * box.width, y));
    took.push(moved.milliseconds);
  }
  await page.mouse.up();
  const after = await settled(page);
  assert.equal(await page.evaluate(() => window.addresses), 1);
  took.sort((a, b) => a - b);
  say(`  a drag takes ${Math.round(took[10])} ms, at most ${Math.round(took[19])} ms`);
  assert.ok(after.summary.bodies[0].velocity_before_m_s > 1.5 * before.summary.bodies[0].velocity_before_m_s);
  assert.ok(difference(after.summary, native(after.text)) < SAME);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

check('Ting’s model has the command’s numbers at any speed and on any partner', async () => {
  const { page } = await open(browser, address);
  await settled(page);
  let worst = 0;
  for (const shape of ['sphere', 'wall', 'half_space', 'plate']) {
    for (const speed of [0.05, 0.61, 1.9]) {
      const own = await ran(page, () => page.evaluate((words) => { location.hash = words; }, `model=ting&partner.shape=${shape}&speed=${speed}&relaxation.kind=term&relaxation.time=30&relaxation.weight=0.6`));
      worst = Math.max(worst, difference(own.summary, native(own.text)));
    }
  }
  say(`  ting, twelve scenes: ${worst.toExponential(1)}`);
  // A chain of arithmetic and of functions with the same bits: what is left is Hertz' powers.
  assert.ok(worst < 1e-13, worst);
  await page.context().close();
});

check('every model can be chosen, and says what it has', async () => {
  const { page, complaints } = await open(browser, address);
  await settled(page);
  for (const model of ['hertz', 'law', 'ting', 'auto', 'condensed', 'fem']) {
    const own = await ran(page, () => page.selectOption('[data-key="model"]', model));
    assert.ok(difference(own.summary, native(own.text)) < SAME, model);
    const hasElements = ['condensed', 'fem'].includes(model);
    assert.equal(await page.locator('#picture').isVisible(), hasElements, model);
    assert.equal(await page.locator('#take-elements').isVisible(), !hasElements, model);
    assert.ok(await page.locator('#chart-force > svg').isVisible() && await page.locator('#chart-energy > svg').isVisible(), model);
    // What is there at first is somewhere in the end, and the rebound is the square of the restitution.
    const { relative_j: whole, parts } = own.sharing;
    assert.ok(Math.abs(parts.reduce((sum, [, energy]) => sum + energy, 0) / whole - 1) < 1e-3, model);
    assert.ok(Math.abs(parts[0][1] / whole - own.summary.restitution ** 2) < 1e-9, model);
    await page.$$eval('#results details', (all) => all.forEach((details) => { details.open = details.id !== 'materials-details'; }));
    for (const place of ['#head', '#numbers-section', '#energy-section', '#effects-section']) {
      assert.doesNotMatch(await page.locator(place).innerText(), OF_MACHINES, `${model}, ${place}`);
    }
    const made = await page.locator('#made').innerText();
    assert.equal(/Auto has chosen ting/.test(made), model === 'auto', made);
    assert.doesNotMatch(await page.locator('#effects-on').innerText(), /contact search/);
  }
  for (const shape of ['wall', 'half_space', 'plate']) {
    await page.selectOption('[data-key="model"]', 'condensed');
    const own = await ran(page, () => page.selectOption('[data-key="partner.shape"]', shape));
    await settled(page);
    const { summary, text } = await collision(page);
    // The command refines a mesh that misses the tolerance; the page shows its error.
    const unrefined = shape === 'plate' ? `${text}\n[accuracy]\ntolerance = 0.5\n` : text;
    assert.ok(difference(summary, native(unrefined)) < SAME, `${shape}: ${own.text}`);
  }
  assert.deepEqual(complaints, []);
  await page.context().close();
});

check('a plate has its thickness, edge and support, and its energy in the ledger', async () => {
  const { page, complaints } = await open(browser, `${address}#partner.shape=plate&striker.diameter=10&striker.material=alumina&partner.material=alumina&speed=1`);
  const free = await settled(page);
  assert.match(free.text, /plate = \{ thickness = "5 mm" \}/);
  assert.ok(await page.locator('#slider-plate-thickness').isVisible() && !await page.locator('#slider-plate-diameter').isVisible());
  assert.ok(difference(free.summary, native(free.text)) < SAME);
  const [, taken] = free.sharing.parts.find(([name]) => name === 'plate');
  assert.ok(Math.abs(taken / free.sharing.relative_j - (1 - free.summary.restitution ** 2)) < 1e-3);
  const wide = await ran(page, () => page.selectOption('[data-key="plate.edge"]', 'diameter'));
  assert.match(wide.text, /diameter = "200 mm"/);
  assert.equal(wide.summary.restitution, free.summary.restitution);
  await ran(page, () => page.selectOption('[data-key="model"]', 'fem'));
  const bonded = await ran(page, () => page.selectOption('[data-key="plate.support"]', 'bonded'));
  assert.match(bonded.text, /support = "bonded"/);
  // The command refines the mesh to the tolerance, the page says what to refine.
  assert.ok(Math.abs(bonded.summary.restitution - native(bonded.text).restitution) < 1e-4 && bonded.summary.restitution > 0.999);
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
  const whole = await ran(page, () => page.click('#sliders-back'));
  assert.equal(whole.summary.complete, true);
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
