// The signals on CAN as a receiver decodes them, message by message.

import { byId, duration, h, keyed, number, setAttribute, setChip, setText, words } from './dom.js';

const VALIDITY_TONES = ['bad', 'warn', 'good'];
const E2E = {
  ok: ['good', 'E2E ok'], first: ['good', 'E2E ok'], lost: ['warn', 'E2E: frames lost'],
  repeated: ['warn', 'E2E: repeated'], wrong: ['bad', 'E2E: wrong CRC'],
};

const digitsOf = (factor) => Math.max(0, Math.min(5, Math.ceil(-Math.log10(factor) - 1e-9)));

/** The value of a signal in words. */
export function signalText(signal, value) {
  if (value === null || value === undefined) return 'n/a';
  if (signal.flags) {
    const set = signal.names.filter((_, bit) => (value >> bit) & 1);
    return set.length ? set.map(words).join(', ') : 'none';
  }
  if (signal.names.length) return words(signal.names[value] ?? String(value));
  return number(value, digitsOf(signal.factor));
}

function messageCard(message, index) {
  const title = `${message.name}`;
  const id = `0x${message.id.toString(16).toUpperCase()}`;
  return h('section', { class: 'message', 'aria-label': `CAN message ${title}`, 'data-message': index },
    h('header', {}, h('h3', { title: message.comment }, title), h('code', {}, id),
      h('span', { class: 'age' }), h('span', { class: 'validity' }), h('span', { class: 'e2e' })),
    h('table', {}, h('tbody')));
}

function shownSignals(message) {
  return message.signals.map((signal, i) => ({ signal, i })).filter(({ signal }) => !signal.framing && !signal.validity);
}

/** Names without the part that all signals of a message share. */
function shortName(name) {
  return name.slice(name.indexOf('_') + 1).replace(/([a-z0-9])([A-Z])/g, '$1 $2');
}

function fillMessage(card, message, state) {
  const stale = message.cycle_ms > 0 && state.age_ms > 5 * message.cycle_ms;
  const age = card.querySelector('.age');
  setText(age, duration(state.age_ms));
  age.classList.toggle('over', stale);
  const [e2eTone, e2eText] = E2E[state.e2e];
  const counts = `${state.num_frames} frames, ${state.num_lost} lost, ${state.num_repeated} repeated, ${state.num_wrong} wrong`;
  setChip(card.querySelector('header > span:last-child'), e2eTone, e2eText);
  setAttribute(card.querySelector('header > span:last-child'), 'title', counts);
  const validity = message.signals.findIndex((signal) => signal.validity);
  const chip = card.querySelector('header > span:nth-last-child(2)');
  if (validity >= 0 && state.values) {
    const value = state.values[validity];
    setChip(chip, VALIDITY_TONES[value] ?? 'off', value === null ? 'not available' : signalText(message.signals[validity], value));
  } else {
    chip.hidden = true;
  }
  const lists = state.objects ?? [state.values];
  const body = card.querySelector('tbody');
  const rows = keyed(body, shownSignals(message).map(({ signal }) => signal.name), (name) => {
    const { signal } = shownSignals(message).find((one) => one.signal.name === name);
    return h('tr', { title: signal.comment }, h('th', { scope: 'row' }, shortName(name)), h('td', { class: 'num' }), h('td', { class: 'unit' }, signal.unit));
  });
  shownSignals(message).forEach(({ signal, i }, row) => {
    const cell = rows[row].children[1];
    const values = lists.slice(0, 3).map((list) => signalText(signal, list?.[i] ?? null));
    if (lists.length > 3) values.push('…');
    setText(cell, values.length ? values.join(' · ') : 'n/a');
    setAttribute(cell, 'data-raw', lists[0]?.[i] ?? null);
    setAttribute(cell, 'data-signal', signal.name);
    cell.classList.toggle('none', values.every((value) => value === 'n/a'));
  });
}

export function showCan(frame, hello) {
  const can = frame.can;
  const messages = can?.messages ?? [];
  const note = byId('can-note');
  setText(note, messages.length ? `${can.num_frames.toLocaleString('en')} frames`
    : can?.state ? `No frames: ${can.state}.` : 'No frames yet.');
  const cards = keyed(byId('can'), messages.map((state) => state.message), (index) => messageCard(hello.can[index], index));
  cards.forEach((card, i) => fillMessage(card, hello.can[messages[i].message], messages[i]));
}
