// The page of plumb-monitor: takes packets, keeps the history, shows one moment.

import 'uplot/dist/uPlot.min.css';
import './page.css';
import { showCan } from './can.js';
import { CameraView, LAYERS } from './camera.js';
import { Chart, CURVES, WINDOW_S } from './charts.js';
import { byId, clock, duration, h, number, setChip, setText, words } from './dom.js';
import { EventList } from './events.js';
import { LiveHistory, LogHistory } from './history.js';
import { Link } from './link.js';
import { MapView } from './map.js';
import { buildCurves, showChannels, showCues, showEstimators, showMount, showProcesses, showValues } from './panels.js';
import { Player } from './player.js';
import { bindControls, showControls } from './controls.js';

const TABLES_MS = 200;
const CHARTS_MS = 120;

const page = { hello: null, frame: null, player: null, history: null, columns: {}, shown: new Set(LAYERS.map((l) => l.id)),
  drawn: 0, firstDraw_ms: 0 };
let pending = null;
let drawing = false;
let tablesAt_ms = 0;
let chartsAt_ms = 0;
let lastJpeg = null;

const camera = new CameraView(byId('camera'));
const map = new MapView(byId('map'));
const curves = buildCurves(byId('curves'));
const charts = curves.map(({ curve, chart }, i) => new Chart(chart, curve, i === CURVES.length - 1, (time_s) => page.player?.seek(time_s)));
const events = new EventList((event) => {
  const ahead = page.hello?.mode === 'log' ? page.history.rows[event.frame]?.[0] : undefined;
  page.player?.seek(ahead ?? event.time_s);
});
const link = new Link(onPacket, onLink);

function onLink(connected) {
  setChip(byId('link'), connected ? 'good' : 'bad', connected ? 'connected' : 'no connection');
  if (!connected && page.history instanceof LogHistory) page.history.forget();
}

function onPacket(message, jpeg, buffer) {
  if (message.type === 'hello') onHello(message);
  else if (message.type === 'news') onNews(message);
  else if (page.hello?.mode === 'log') page.history.answer(message, jpeg), link.acknowledge(message.id);
  else onLive(message, jpeg, buffer);
}

function onHello(hello) {
  const sameRun = page.hello?.mode === 'live' && hello.mode === 'live' && page.hello.title === hello.title;
  page.hello = hello;
  page.columns = Object.fromEntries(hello.rows.map((name, i) => [name, i]));
  events.clear();
  if (sameRun && page.history) page.history = page.player.history = new LiveHistory();
  const isLog = hello.mode === 'log';
  document.body.dataset.mode = hello.mode;
  setText(byId('title'), hello.title.replace(/\?.*/, ''));
  setText(byId('version'), hello.version);
  document.title = `${isLog ? hello.title : 'live'} · Plumbline`;
  if (!page.player) {
    page.history = isLog ? new LogHistory(link) : new LiveHistory();
    page.player = new Player(isLog, page.history, showIndex, () => showControls(page, events.events));
    page.player.playing = isLog;
    bindControls(page);
  }
}

function onNews(news) {
  events.add(news.events);
  if (!news.rows) return;
  page.history.addRows(news.first_row, news.rows);
  page.history.share = news.share;
  page.history.done = news.done;
  showControls(page, events.events);
}

/** Live: the newest packet is drawn next; those that it replaced have only been kept. */
function onLive(message, jpeg, buffer) {
  if (message.type === 'frame') page.history.add(message, buffer);
  if (pending) link.acknowledge(pending.message.id);
  pending = { message, jpeg };
  if (!drawing) drawPending();
}

async function drawPending() {
  drawing = true;
  while (pending) {
    const { message, jpeg } = pending;
    pending = null;
    if (page.player.following && !document.hidden) {
      // A state without results changes what is beside the picture.
      const frame = message.type === 'frame' || jpeg ? message : { ...page.frame, ...message };
      await show(frame, message.type === 'frame' || jpeg ? jpeg : lastJpeg, message.type !== 'frame' && !jpeg);
      if (message.type === 'frame') ++page.drawn;
    }
    link.acknowledge(message.id);
  }
  drawing = false;
}

async function showIndex(index) {
  const packet = await page.history.frame(index);
  if (packet) await show(packet.message, packet.jpeg, false, true);
}

/** Shows one moment. Charts and tables, but for CAN, follow a running picture more slowly than the picture does. */
async function show(frame, jpeg, isState, force = false) {
  page.frame = frame;
  lastJpeg = jpeg;
  if (!isState) await camera.draw(frame, jpeg, page.hello, page.shown);
  const now_ms = performance.now();
  const isStill = force && !page.player.playing;
  showHead(frame);
  showValues(curves, frame.row, page.columns);
  if (isStill || now_ms - chartsAt_ms > CHARTS_MS) {
    chartsAt_ms = now_ms;
    showCharts();
  }
  if (isStill || isState || now_ms - tablesAt_ms > TABLES_MS) {
    tablesAt_ms = now_ms;
    showTables(frame);
  }
  showCan(frame, page.hello);
  showControls(page, events.events);
}

function showHead(frame) {
  const { hello } = page;
  const status = frame.ego?.status;
  setChip(byId('state'), status === undefined ? 'off' : ['good', 'warn', 'warn', 'good', 'warn', 'bad'][status] ?? 'off',
    status === undefined ? 'no results' : words(hello.words.ego_status[status]));
  setText(byId('age'), frame.age_ms === undefined ? '' : `${duration(frame.age_ms)} since exposure`);
  setText(byId('seq'), frame.seq === undefined ? '' : `image ${frame.seq}`);
  if (frame.refused) setChip(byId('state'), 'warn', `refused: ${frame.refused}`);
}

function showTables(frame) {
  const { hello } = page;
  showCues(frame, hello);
  showEstimators(frame, hello);
  showMount(frame, hello);
  showProcesses(frame, hello);
  showChannels(frame);
  const row = frame.row ?? [];
  const say = (name, digits, factor = 1) => number(row[page.columns[name]] === null || row[page.columns[name]] === undefined
    ? null : row[page.columns[name]] * factor, digits);
  byId('camera').setAttribute('aria-label', `Camera image ${frame.seq ?? ''}: ${frame.plane ? `plane ${words(hello.words.plane_status[frame.plane.status])}` : 'no plane'}, `
    + `speed ${say('speed', 1)} metres per second, pitch ${say('pitch', 1, 57.2958)} degrees, ${frame.objects?.list.length ?? 0} objects`);
}

function showCharts() {
  const { player, columns } = page;
  const rows = player.rows;
  const now = rows[player.index]?.[0];
  if (now === undefined) return;
  const isWhole = page.hello.mode === 'log' && player.last_s - player.first_s <= WINDOW_S;
  const from = isWhole ? player.first_s : Math.max(now - WINDOW_S, player.first_s);
  const to = isWhole ? player.last_s : Math.max(now, Math.min(from + 10, from + WINDOW_S));
  const seen = rows.filter((row) => row[0] >= from && row[0] <= to);
  for (const chart of charts) chart.update(seen, columns, [from, Math.max(to, from + 1)], now);
  map.draw(rows.slice(0, player.index + 1), page.frame ?? {}, columns);
}

/** After a change of layers, size or theme. */
export function redraw() {
  if (!page.frame) return;
  camera.paint(page.frame, page.hello, page.shown);
  showCharts();
}

function buildLegend() {
  for (const layer of LAYERS) {
    const box = h('input', { type: 'checkbox', id: `layer-${layer.id}`, checked: true });
    box.addEventListener('change', () => {
      box.checked ? page.shown.add(layer.id) : page.shown.delete(layer.id);
      redraw();
    });
    byId('legend').append(h('label', { class: 'layer', title: layer.hint }, box,
      h('span', { class: `mark ${layer.mark}`, style: `--colour:${layer.colour}` }), layer.name, h('kbd', {}, layer.key)));
  }
}

buildLegend();
new ResizeObserver(redraw).observe(byId('camera').parentElement);
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
  charts.forEach((chart) => chart.build());
  redraw();
});
setText(byId('clock'), clock(0));
window.plumb = page; // for whoever wants to look closer, and for the test in the browser
