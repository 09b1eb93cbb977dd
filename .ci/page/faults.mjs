// What is wrong, missing or too much is said.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { open, paste, ran, settled } from './browser.mjs';
import { address, browser, cases, check, say, shot } from './harness.mjs';

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
  // Each once, with its line of the case; and above, where a reader may be.
  assert.equal(negative.match(/diameter is/g).length, 1);
  assert.match(negative, /20 \| sphere = .*\n\s+\| +\^/);
  assert.match(await page.locator('#fault').innerText(), /Line \d+/);
  assert.match(await page.locator('#pasted').innerText(), /could not be computed/);
  assert.equal(await page.locator('#slider-speed').isDisabled(), true);
  await shot(page, 'fault');
  await paste(page, `${glass}\n[[body]]\nname = "third"\nsphere = { diameter = "1 cm" }\nmaterial = "glass"\n`);
  await page.waitForFunction(() => /3/.test(document.querySelector('#paste-fault strong')?.textContent));
  assert.match(await page.locator('#paste-fault').innerText(), /bod/);
  assert.ok(await page.locator('main.stale').count());
  // A text with tags in it stays a text.
  await ran(page, () => paste(page, glass.replace(/title = .*/, 'title = "<img src=x onerror=alert(1)>"').replaceAll('"striker"', '"s"')));
  assert.equal(await page.locator('main.stale').count(), 0);
  assert.equal(await page.locator('img').count(), 0);
  // A number that a slider does not have.
  await page.click('#reset');
  await settled(page);
  const number = page.locator('.slider[data-key="speed"] input[type="number"]');
  await number.fill('-3');
  await number.press('Enter');
  await page.locator('#fault').waitFor();
  assert.match(await page.locator('#fault').innerText(), /Approach speed: -3/);
  assert.match(await page.locator('.slider[data-key="speed"] .field-fault').innerText(), /Between 0.001 and 10/);
  assert.match(await page.locator('#status').innerText(), /Not computed/);
  assert.equal(await page.locator('main.stale').count(), 1);
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
  // A limit that is raised beyond what a browser has: said by the run, and by a module that trapped.
  await paste(page, fine(0.8, '[limits]\nelements = 1e8\nmemory = 1e12'));
  await page.waitForFunction(() => /not enough memory[^]*4 GB at most/.test(document.getElementById('paste-fault').textContent), null, { timeout: 120_000 });
  await page.evaluate(() => {
    const post = Worker.prototype.postMessage;
    Worker.prototype.postMessage = function trapped(data) {
      if (data.kind !== 'begin') {
        post.call(this, data);
        return;
      }
      Worker.prototype.postMessage = post;
      this.onmessage({ data: { id: data.id, kind: 'failed', message: 'panicked: AllocError { size: 312532992 } (RuntimeError: unreachable)' } });
    };
  });
  await paste(page, glass);
  await page.waitForFunction(() => /not enough memory for this case[^]*4 GB at most/.test(document.getElementById('paste-fault').textContent));
  assert.doesNotMatch(await page.locator('#paste-fault').innerText(), /panicked|AllocError/);
  // It fits in a browser and takes several seconds before its first step: a finer mesh is at fault for want
  // of memory, and that as early as a busy machine clicks.
  await paste(page, fine(1.5, '[limits]\nelements = 1e8\nmemory = 1e12'));
  await page.locator('#progress').waitFor();
  await page.click('#cancel');
  await page.waitForFunction(() => /^Ended/.test(document.getElementById('status').textContent), null, { timeout: 30_000 });
  const again = await ran(page, () => page.click('#reset'));
  assert.ok(again.summary.complete);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

check('what of a link cannot be used is said, with the setting', async () => {
  for (const [words, expected] of [
    ['striker.diameter=-1', /Diameter of the striker.*“-1”.*0.01 to 200 mm.*22.2 mm/],
    ['speed=-5', /Approach speed.*“-5”/],
    ['speed=1e99', /Approach speed.*0.001 to 10/],
    ['speed=', /Approach speed.*nothing is given/],
    ['speed=0x10', /Approach speed.*no number/],
    ['speed=NaN', /Approach speed.*no number/],
    ['speed=%zz', /Approach speed.*“%zz” is no number/],
    ['speed=%E0%A4', /Approach speed.*no number/],
    ['speed=1&speed=2', /Approach speed.*twice.*1 m\/s/],
    ['material=rubber', /“material” is no setting/],
    ['striker.material=rubber', /Material of the striker.*“rubber”.*glass/],
    ['partner.shape=cube', /Shape of the partner.*“cube”.*half_space/],
    ['model=', /Model.*nothing is given/],
    ['__proto__=1', /“__proto__” is no setting/],
    ['toString', /“toString” is no setting/],
    ['case=!!!', /cannot be read/],
    ['case=', /cannot be read/],
    ['case=%FF%FE', /cannot be read/],
    [`case=${Buffer.from('title = "x"').toString('base64')}&speed=3`, /nothing else counts.*“speed”/],
    [Array.from({ length: 2000 }, (_, k) => `k${k}=${'x'.repeat(50)}`).join('&'), /“k0”.*and 1996 more are no settings/],
  ]) {
    const { page, complaints } = await open(browser, `${address}#${words}`);
    await page.waitForFunction(() => window.collision || !document.getElementById('fault').hidden);
    assert.match(await page.locator('#link-fault').innerText(), expected, words.slice(0, 80));
    assert.deepEqual(complaints, []);
    await page.context().close();
  }
  // A case that is at fault leaves no empty tables.
  const { page: faulty } = await open(browser, `${address}#case=${Buffer.from('title = "x"').toString('base64')}`);
  await faulty.locator('#fault').waitFor();
  assert.match(await faulty.locator('#head').innerText(), /no \[\[body\]\][^]*no numbers yet/);
  assert.equal(await faulty.locator('#numbers').isVisible(), false);
  await faulty.context().close();
  // What can be used is, and the next change takes the note away.
  const { page } = await open(browser, `${address}#speed=2&law.e=x`);
  assert.match((await settled(page)).text, /approach_speed = "2 m\/s"/);
  await shot(page, 'link');
  await ran(page, () => page.click('#reset'));
  assert.equal(await page.locator('#link-fault').isVisible(), false);
  await page.context().close();
});

check('what fails in the page, or is missing in a browser, is said', async () => {
  const { page } = await open(browser, address);
  await settled(page);
  await page.evaluate(() => { Promise.reject(new Error('a promise')); });
  await page.waitForFunction(() => /a promise/.test(document.getElementById('fault').textContent));
  await page.evaluate(() => setTimeout(() => { throw new Error('out of the blue'); }));
  await page.waitForFunction(() => /out of the blue/.test(document.getElementById('fault').textContent));
  await page.context().close();
  for (const name of ['Worker', 'WebAssembly', 'DecompressionStream']) {
    const context = await browser.newContext();
    const bare = await context.newPage();
    await bare.addInitScript((word) => { delete window[word]; }, name);
    await bare.goto(address);
    assert.match(await bare.locator('#fault').innerText(), /cannot compute here[^]*It lacks/, name);
    assert.equal(await bare.locator('#controls').isVisible(), false, name);
    await context.close();
  }
  const context = await browser.newContext({ javaScriptEnabled: false });
  const silent = await context.newPage();
  await silent.goto(address);
  assert.match(await silent.locator('noscript p').innerText(), /JavaScript is off here/);
  assert.equal(await silent.locator('noscript p').isVisible(), true);
  assert.equal(await silent.locator('main').isVisible(), false);
  await context.close();
});

check('bodies that stay together say so, and show the largest force', async () => {
  const { page, complaints } = await open(browser, `${address}#relaxation.kind=term&relaxation.time=1&relaxation.weight=1`);
  const { summary, frames, sharing } = await settled(page);
  assert.equal(summary.restitution, 0);
  assert.match(await page.locator('#status').innerText(), /stay together/);
  // What is left of the motion is at most the square of the least restitution, 1e-6 of the energy.
  assert.match(await page.locator('#energy-shares').innerText(), /^ *0(\.0001)? % motion away/);
  assert.ok(sharing.parts[0][1] < 1e-6 * sharing.relative_j);
  const largest = Math.max(...frames.map((frame) => frame.contact_force_n));
  const place = Number(await page.locator('#instant').inputValue()) / 1000;
  assert.equal(frames[Math.round(place * (frames.length - 1))].contact_force_n, largest);
  assert.ok((await page.locator('#picture-svg path[class*="n"]').count()) > 3);
  assert.doesNotMatch(await page.locator('#warnings').innerText(), /contact time/);
  await shot(page, 'together');
  assert.deepEqual(complaints, []);
  await page.context().close();
});
