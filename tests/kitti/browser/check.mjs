// Opens a report in headless Chromium and holds it to what a mailed page must do:
//   node check.mjs REPORT.html OUT
// No error on the console, no request outside the file, open within a second, every chart drawn, hover values, in
// light and in dark. Leaves light.png, dark.png and page.pdf in OUT. Exit code 1 when something is wrong.
import fs from 'node:fs';
import path from 'node:path';
import {pathToFileURL} from 'node:url';
import {chromium} from 'playwright-core';

const MOST_BYTES = 8e6;
const MOST_OPEN_MS = 1000;
const [report, out] = process.argv.slice(2);
const problems = [];

function expect(holds, text) {
  if (!holds) problems.push(text);
}

// Charts are drawn when they come into view, so the page is scrolled from top to bottom.
async function scrollThrough(page) {
  const height = await page.evaluate(() => document.body.scrollHeight);
  for (let y = 0; y < height; y += 600) {
    await page.evaluate((top) => window.scrollTo(0, top), y);
    await page.waitForTimeout(40);
  }
  await page.evaluate(() => window.scrollTo(0, 0));
}

// Somewhere on every chart the mouse finds a value.
async function checkHover(page) {
  const charts = page.locator('[data-chart]');
  for (let k = 0; k < await charts.count(); ++k) {
    const drawing = charts.nth(k).locator('svg').last();
    await drawing.scrollIntoViewIfNeeded();
    const box = await drawing.boundingBox();
    let shown = '';
    for (let i = 0; i < 48 && !/\d/.test(shown); ++i) {
      const [right, down] = [(i % 8 + 0.5) / 8, (Math.floor(i / 8) + 0.5) / 6];
      await page.mouse.move(box.x + right * box.width, box.y + down * box.height);
      await page.waitForTimeout(20);
      shown = await drawing.evaluate((svg) => svg.querySelector('g[aria-label=tip]')?.textContent ?? '');
    }
    expect(/\d/.test(shown), `chart ${k} shows no value under the mouse`);
  }
}

// The shortest of three, because other programs may be busy at the same time.
async function openingTime(page) {
  const times = [];
  for (let i = 0; i < 3; ++i) {
    const begin = performance.now();
    await page.goto(pathToFileURL(path.resolve(report)).href);
    times.push(performance.now() - begin);
  }
  return Math.min(...times);
}

async function checkScheme(browser, scheme) {
  const page = await browser.newPage({colorScheme: scheme, viewport: {width: 1120, height: 900}});
  page.on('console', (message) => expect(message.type() !== 'error', `console, ${scheme}: ${message.text()}`));
  page.on('pageerror', (error) => expect(false, `script, ${scheme}: ${error.message}`));
  page.on('request', (request) => expect(/^(file|data):/.test(request.url()), `request for ${request.url()}`));
  const openMs = await openingTime(page);
  expect(openMs < MOST_OPEN_MS, `the page opens in ${openMs.toFixed(0)} ms`);
  await scrollThrough(page);
  const counts = await page.evaluate(() => {
    const places = [...document.querySelectorAll('[data-chart]')];
    return {places: places.length, drawn: places.filter((place) => place.querySelector('svg path, svg rect, svg circle')).length,
      background: getComputedStyle(document.body).backgroundColor};
  });
  expect(counts.places > 0, 'the page has no chart');
  expect(counts.drawn === counts.places, `${counts.drawn} of ${counts.places} charts are drawn`);
  expect(await page.locator('h2').count() >= 10, 'sections are missing');
  if (scheme === 'light') await checkHover(page);
  await page.evaluate(() => window.scrollTo(0, 0));
  await page.screenshot({path: path.join(out, `${scheme}.png`), fullPage: true});
  if (scheme === 'light') await page.pdf({path: path.join(out, 'page.pdf')});
  await page.close();
  return {scheme, openMs: Math.round(openMs), ...counts};
}

const bytes = fs.statSync(report).size;
expect(bytes <= MOST_BYTES, `the page has ${bytes} bytes`);
const browser = await chromium.launch({executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox']});
const seen = [];
for (const scheme of ['light', 'dark']) seen.push(await checkScheme(browser, scheme));
await browser.close();
expect(seen[0].background !== seen[1].background, 'light and dark look the same');
console.log(JSON.stringify({bytes, seen}));
for (const problem of problems) console.error(problem);
process.exit(problems.length ? 1 : 0);
