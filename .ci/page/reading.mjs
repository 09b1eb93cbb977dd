// For every reader: keyboard, phone, paper, dark ground, far and near.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { open, ran, settled } from './browser.mjs';
import { address, browser, check, screenshots, shot } from './harness.mjs';

check('the view goes from the contact to whole spheres', async () => {
  const { page } = await open(browser, address);
  await settled(page);
  await page.locator('#zoom').fill('1000');
  await page.locator('#picture-svg').getByText('r [mm]').waitFor();
  // No two numbers of an axis touch.
  const boxes = await page.$$eval('#picture-svg g.dim text', (all) => all.map((one) => one.getBoundingClientRect()).map(({ left, right, top }) => ({ left, right, top })));
  const rows = boxes.filter((box) => boxes.some((other) => other !== box && Math.abs(other.top - box.top) < 1)).sort((a, b) => a.left - b.left);
  for (let k = 1; k < rows.length; k += 1) {
    if (Math.abs(rows[k].top - rows[k - 1].top) < 1) assert.ok(rows[k].left > rows[k - 1].right, JSON.stringify(rows[k]));
  }
  await page.locator('#picture').screenshot({ path: join(screenshots, 'whole.png') });
  await page.context().close();
});

check('on paper there are the picture, the numbers and the case, and nothing to press', async () => {
  const { page } = await open(browser, address, { colorScheme: 'dark' });
  await settled(page);
  await page.emulateMedia({ media: 'print' });
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  assert.deepEqual(await page.$$eval('button, select, input', (all) => all.filter((one) => one.checkVisibility()).map((one) => one.outerHTML)), []);
  for (const id of ['#picture-svg', '#numbers', '#case', '#effects-off']) assert.ok(await page.locator(id).isVisible(), id);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'light');
  await page.evaluate(() => dispatchEvent(new Event('afterprint')));
  assert.equal(await page.locator('#case-details').getAttribute('open'), null);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
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
  // The picture stays in sight above the slider that is moved, and so does what is wrong with its number.
  const isInSight = (id) => phone.page.locator(id).evaluate((one) => {
    const { top, bottom, height } = one.getBoundingClientRect();
    return height > 0 && top >= 0 && bottom <= innerHeight;
  });
  await phone.page.locator('#slider-speed').evaluate((one) => one.scrollIntoView({ block: 'end' }));
  for (const id of ['#picture-svg', '#status', '#slider-speed']) assert.ok(await isInSight(id), id);
  const number = phone.page.locator('.slider[data-key="speed"] input[type="number"]');
  await number.fill('-3');
  await number.press('Enter');
  for (const id of ['#fault', '.slider[data-key="speed"] .field-fault']) assert.ok(await isInSight(id), id);
  await phone.page.screenshot({ path: join(screenshots, 'phone-fault.png') });
  // For fingers: 44 px.
  const small = await phone.page.$$eval('button, select, input, summary', (all) => all.filter((one) => one.checkVisibility() && one.getBoundingClientRect().height < 44).map((one) => one.outerHTML.slice(0, 80)));
  assert.deepEqual(small, []);
  // Whatever the width, nothing is cut off.
  const any = await open(browser, address);
  await settled(any.page);
  for (const width of [320, 600, 861, 900, 1041, 1600]) {
    await any.page.setViewportSize({ width, height: 900 });
    const cut = await any.page.$$eval('.scroll, html', (all) => all.filter((one) => one.scrollWidth > one.clientWidth).map((one) => one.className || one.tagName));
    assert.deepEqual(cut, [], `${width} px`);
  }
  await any.page.context().close();
  const dark = await open(browser, address, { colorScheme: 'dark' });
  await settled(dark.page);
  assert.equal(await dark.page.evaluate(() => document.documentElement.dataset.theme), 'dark');
  await shot(dark.page, 'dark');
  await dark.page.click('#theme');
  assert.equal(await dark.page.evaluate(() => document.documentElement.dataset.theme), 'light');
  assert.deepEqual([...phone.complaints, ...dark.complaints], []);
  for (const { page } of [phone, dark]) await page.context().close();
});
