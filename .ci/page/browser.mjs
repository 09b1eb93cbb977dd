// A page in headless Chromium, and what it does beside showing itself.
import { chromium } from 'playwright-core';

const FLAGS = [
  '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync',
];

export async function launch() {
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: FLAGS });
}

// The page, and a list of all that it complains of or asks the network for.
export async function open(browser, address, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 1000 }, ...options });
  const page = await context.newPage();
  const complaints = [];
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('request', (request) => {
    if (!/^(file|blob|data):/.test(request.url())) complaints.push(`asks for ${request.url()}`);
  });
  const began = Date.now();
  await page.goto(address);
  return { page, complaints, began };
}

// Runs that have been shown so far.
export function runs(page) {
  return page.evaluate(() => Number(document.documentElement.dataset.runs ?? 0));
}

// Does something and waits for the collision that it leads to.
export async function ran(page, act) {
  const before = await runs(page);
  await act();
  await page.waitForFunction((n) => Number(document.documentElement.dataset.runs ?? 0) > n, before, { timeout: 120_000 });
  return collision(page);
}

// Until nothing more is under way.
export async function settled(page) {
  await page.waitForFunction(() => document.documentElement.dataset.runs > 0 && document.getElementById('results').getAttribute('aria-busy') === 'false', null, { timeout: 120_000 });
  return collision(page);
}

export function collision(page) {
  return page.evaluate(() => window.collision);
}

// Runs a text as a reader would paste it.
export async function paste(page, text) {
  await page.locator('#paste-details').evaluate((details) => { details.open = true; });
  await page.fill('#paste', text);
  await page.click('#paste-run');
}
