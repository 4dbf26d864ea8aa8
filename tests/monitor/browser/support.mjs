// What the tests of the page share: the browser, axe, and readers of what the bus and CAN carried, which know
// nothing of the monitor's own decoding.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { chromium } from 'playwright-core';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

export async function openBrowser() {
  return chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox'] });
}

/** Opens the page and collects whatever the console says. */
export async function openPage(browser, url, { width = 1440, height = 1000, colorScheme = 'light' } = {}) {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme });
  page.complaints = [];
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) page.complaints.push(message.text());
  });
  page.on('pageerror', (error) => page.complaints.push(error.message));
  await page.goto(url);
  return page;
}

export async function picture(page, name) {
  if (process.env.PLUMB_PICTURES) await page.screenshot({ path: `${process.env.PLUMB_PICTURES}/${name}.png`, fullPage: true });
}

/** axe-core finds nothing serious or critical. */
export async function expectAccessible(page, what) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => window.axe.run());
  const serious = violations.filter((one) => ['serious', 'critical'].includes(one.impact));
  assert.deepEqual(serious.map((one) => `${one.id}: ${one.nodes.map((node) => node.html).slice(0, 3).join(' ')}`), [], what);
}

export async function expectNoOverflow(page, width) {
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= width, `wider than ${width} pixels`);
}

/** The events of an LCM log as { channel, data }; an incomplete one at the end is left out. */
export function* readLog(path) {
  const bytes = readFileSync(path);
  for (let at = 0; at + 28 <= bytes.length;) {
    assert.equal(bytes.readUInt32BE(at), 0xeda1da01, 'not an LCM log');
    const [channelBytes, dataBytes] = [bytes.readInt32BE(at + 20), bytes.readInt32BE(at + 24)];
    const data = at + 28 + channelBytes;
    if (data + dataBytes > bytes.length) return;
    yield { channel: bytes.toString('latin1', at + 28, data), data: bytes.subarray(data, data + dataBytes) };
    at = data + dataBytes;
  }
}

/** By sequence number: forward speed of EGO_MOTION; pitch, roll and height of GROUND_PLANE. */
export function busValues(path) {
  const speeds = new Map();
  const planes = new Map();
  for (const { channel, data } of readLog(path)) {
    // Both begin with fingerprint, utime, seq, session, capture_mono_us (8 bytes each), status, reason.
    const seq = Number(channel.endsWith('N') || channel.endsWith('E') ? data.readBigInt64BE(16) : 0n);
    if (channel === 'EGO_MOTION') speeds.set(seq, data.readDoubleBE(40 + 2 + 4 + 32 + 24 + 288));
    if (channel !== 'GROUND_PLANE') continue;
    const at = 40 + 2 + 24;
    planes.set(seq, { height: data.readDoubleBE(at), pitch: data.readDoubleBE(at + 8), roll: data.readDoubleBE(at + 16) });
  }
  return { speeds, planes };
}

/** Every speed that PLB_EgoMotion carried and when, as the DBC defines it: 24|16@1+ (0.005,-100). */
export function canSpeeds(path) {
  return readFileSync(path, 'latin1').split('\n').map((line) => /^\((.*)\) \w+ 3A0#(\w{16})$/.exec(line)).filter(Boolean)
    .map(([, time_s, hex]) => ({ time_ms: 1000 * Number(time_s), speed: Buffer.from(hex, 'hex').readUInt16LE(3) * 0.005 - 100 }));
}

/** Notes when the speed on CAN changes on the page, in window.canNotes. */
export async function watchCanSpeed(page) {
  await page.evaluate(() => {
    window.canNotes = [];
    const cell = document.querySelector('[data-signal=EgoMotion_Speed]');
    window.canObserver?.disconnect();
    window.canObserver = new MutationObserver(() => window.canNotes.push({ time_ms: Date.now(), speed: Number(cell.dataset.raw) }));
    window.canObserver.observe(cell, { attributes: true, attributeFilter: ['data-raw'] });
  });
}

/** How long after its first frame on CAN each of the noted speeds was on the page, sorted [ms]. */
export function canDelays_ms(sent, notes) {
  const first = sent.filter(({ speed }, i) => i === 0 || Math.abs(speed - sent[i - 1].speed) > 1e-9);
  const delays = notes.filter((note) => note.time_ms > sent[0]?.time_ms).map((note) => {
    const source = first.findLast(({ time_ms, speed }) => time_ms <= note.time_ms && Math.abs(speed - note.speed) < 1e-9);
    return source ? note.time_ms - source.time_ms : NaN;
  });
  return delays.filter((delay) => !Number.isNaN(delay)).sort((a, b) => a - b);
}
