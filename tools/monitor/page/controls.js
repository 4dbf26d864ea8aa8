// The bar at the foot of the page: pause, steps, time line, speed; and the keys.

import { LAYERS } from './camera.js';
import { byId, clock, h, setAttribute, setText } from './dom.js';

const SPEEDS = [0.25, 0.5, 1, 2, 4, 8];

export function bindControls(page) {
  const { player } = page;
  byId('play').addEventListener('click', () => player.toggle());
  byId('back').addEventListener('click', () => player.step(-1));
  byId('forward').addEventListener('click', () => player.step(1));
  byId('follow').addEventListener('click', () => player.follow());
  byId('timeline').addEventListener('input', (event) => player.seek(Number(event.target.value)));
  byId('speed').append(...SPEEDS.map((speed) => h('option', { value: speed, selected: speed === 1 }, `${speed} ×`)));
  byId('speed').addEventListener('change', (event) => { player.speed = Number(event.target.value); });
  byId('help').addEventListener('click', () => byId('keys').showModal());
  byId('keys').addEventListener('click', (event) => { if (event.target === byId('keys')) byId('keys').close(); });
  document.addEventListener('keydown', (event) => onKey(event, player));
}

function onKey(event, player) {
  if (event.ctrlKey || event.metaKey || event.altKey || byId('keys').open) return;
  const { target } = event;
  const isField = target instanceof HTMLSelectElement || target instanceof HTMLInputElement;
  const isButton = target instanceof HTMLButtonElement || (isField && target.type === 'checkbox');
  if (isField && target.type !== 'checkbox' && event.key !== '?') return;
  const layer = LAYERS.find((one) => one.key === event.key);
  const second = event.shiftKey ? 10 : 1;
  const actions = {
    ' ': isButton ? null : () => player.toggle(),
    ArrowLeft: () => player.step(-second),
    ArrowRight: () => player.step(second),
    Home: () => player.seek(player.first_s),
    End: () => player.follow(),
    l: () => player.follow(),
    '?': () => byId('keys').showModal(),
  };
  const action = layer ? () => byId(`layer-${layer.id}`).click() : actions[event.key];
  if (!action) return;
  event.preventDefault();
  action();
}

function showMarks(page, events) {
  const { player } = page;
  const span = Math.max(player.last_s - player.first_s, 1e-3);
  const marks = events.filter((event) => event.level !== 'info' && event.time_s >= player.first_s && event.time_s <= player.last_s);
  const key = `${marks.length} ${marks.at(-1)?.serial} ${player.first_s.toFixed(1)} ${player.last_s.toFixed(1)}`;
  const parent = byId('marks');
  if (parent.dataset.key === key) return;
  parent.dataset.key = key;
  parent.replaceChildren(...marks.slice(-200).map((event) => h('i', { class: event.level,
    style: `left:${((100 * (event.time_s - player.first_s)) / span).toFixed(2)}%` })));
}

export function showControls(page, events) {
  const { player, history, hello } = page;
  if (!player) return;
  const isRunning = player.following || player.playing;
  setText(byId('play-word'), isRunning ? 'Pause' : 'Play');
  setAttribute(byId('play'), 'data-running', isRunning);
  const now = player.following ? player.last_s : player.time_s;
  const line = byId('timeline');
  setAttribute(line, 'min', player.first_s);
  setAttribute(line, 'max', Math.max(player.last_s, player.first_s + 0.1));
  if (line.valueAsNumber !== now) line.value = now;
  setAttribute(line, 'aria-valuetext', `${clock(now)} of ${clock(player.last_s)}`);
  setText(byId('clock'), clock(now));
  const behind = player.last_s - now;
  const isLog = hello.mode === 'log';
  const progress = isLog && !history.done ? ` · ${Math.round(100 * history.share)} % computed` : '';
  setText(byId('range'), isLog ? `of ${clock(player.last_s)}${progress}`
    : player.following ? 'live' : `${behind.toFixed(1)} s ago`);
  byId('follow').hidden = isLog;
  byId('speed').parentElement.hidden = !isLog && player.following;
  setAttribute(byId('follow'), 'aria-pressed', player.following);
  showMarks(page, events);
}
