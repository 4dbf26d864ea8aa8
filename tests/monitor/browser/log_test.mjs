// The page on a log.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { expectAccessible, expectNoOverflow, openBrowser, openPage, picture } from './support.mjs';

const { PLUMB_LOG: url } = process.env;
const NUM_IMAGES = 100; // of the drive that ships with the project
let browser;
let page;
before(async () => {
  browser = await openBrowser();
  page = await openPage(browser, url);
  await page.waitForFunction(() => window.plumb.history?.done, null, { timeout: 60000 });
});
after(() => browser.close());

const shown = (seq) => page.waitForFunction((wanted) => window.plumb.frame?.seq === wanted && !window.plumb.player.busy, seq);

test('every image has its results', async () => {
  const { count, rising } = await page.evaluate(() => {
    const { rows } = window.plumb.history;
    return { count: rows.length, rising: rows.every((row, i) => i === 0 || row[0] > rows[i - 1][0]) };
  });
  assert.equal(count, NUM_IMAGES);
  assert.ok(rising);
});

test('it plays, and the time line, the keys and the charts seek', { timeout: 60000 }, async () => {
  await page.waitForFunction(() => window.plumb.player.playing || window.plumb.player.time_s > 1);
  const seq = await page.evaluate(() => {
    const { player } = window.plumb;
    player.playing = false;
    player.seek(5);
    return player.rows[player.index][1];
  });
  await shown(seq);
  await page.keyboard.press('ArrowRight');
  await shown(seq + 1);
  await page.keyboard.press('Shift+ArrowLeft');
  await shown(seq - 9);
  await page.locator('#timeline').focus();
  await page.keyboard.press('Home');
  await page.waitForFunction(() => window.plumb.player.index === 0);
  const plot = await page.locator('.u-over').first().boundingBox();
  await page.mouse.click(plot.x + plot.width / 2, plot.y + plot.height / 2);
  await page.waitForFunction(() => Math.abs(window.plumb.player.index - 50) < 5 && !window.plumb.player.busy
    && window.plumb.player.shownIndex === window.plumb.player.index);
  const speed = await page.evaluate(() => document.getElementById('value-speed').textContent);
  assert.match(speed, /^\d+\.\d\d$/);
});

test('a picture is drawn with its overlay', async () => {
  await page.evaluate(() => window.plumb.player.seek(6));
  await page.waitForTimeout(1000);
  const colours = await page.evaluate(() => {
    const canvas = document.getElementById('camera');
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    const count = { grid: 0, horizon: 0, bright: 0 };
    for (let i = 0; i < data.length; i += 4) {
      const [r, g, b] = [data[i], data[i + 1], data[i + 2]];
      if (g > 150 && r < 110 && b < 170 && g - r > 80) ++count.grid;
      if (r > 200 && g > 120 && b < 110) ++count.horizon;
      if (r > 60) ++count.bright;
    }
    return count;
  });
  assert.ok(colours.grid > 300, JSON.stringify(colours));
  assert.ok(colours.horizon > 300, JSON.stringify(colours));
  assert.ok(colours.bright > 20000, JSON.stringify(colours));
});

test('features are drawn by kind, and each kind has a switch', async () => {
  await page.evaluate(() => { window.plumb.player.playing = false; window.plumb.player.seek(6); });
  await page.waitForFunction(() => window.plumb.frame?.vo && !window.plumb.player.busy);
  await page.waitForTimeout(500);
  const counts = await page.evaluate(() => {
    const { features } = window.plumb.frame.vo;
    return window.plumb.hello.words.vo_feature.map((_, kind) => features.filter((value, i) => i % 3 === 2 && value === kind).length);
  });
  assert.ok(counts[1] > 100, `static: ${counts}`);
  const pixels = () => page.evaluate(() => document.getElementById('camera').toDataURL());
  const before = await pixels();
  for (const [kind, key] of [['static', '7'], ['undecided', '0']]) {
    assert.ok(await page.isVisible(`label:has(#layer-${kind}) .mark`));
    await page.keyboard.press(key);
    assert.ok(await pixels() !== before, `${kind} is not drawn`);
    await page.keyboard.press(key);
    assert.ok(await pixels() === before, `${kind} does not come back`);
  }
});

for (const [name, options] of Object.entries({ light: {}, dark: { colorScheme: 'dark' }, phone: { width: 400, height: 860 } })) {
  test(`axe finds nothing serious: ${name}`, { timeout: 60000 }, async () => {
    const other = await openPage(browser, url, options);
    await other.waitForFunction(() => window.plumb.history?.done && window.plumb.frame, null, { timeout: 30000 });
    await other.evaluate(() => { window.plumb.player.playing = false; window.plumb.player.seek(6); });
    await other.waitForTimeout(1000);
    await picture(other, `log_${name}`);
    await expectAccessible(other, name);
    await expectNoOverflow(other, options.width ?? 1440);
    assert.deepEqual(other.complaints, []);
    await other.close();
  });
}

test('the console stayed silent', () => assert.deepEqual(page.complaints, []));
