// The list of events: resets, faults and alarms. A click goes to the moment of the event.

import { byId, clock, h, setText } from './dom.js';

const MAX_SHOWN = 200;
const TONES = { info: 'off', warning: 'warn', alarm: 'bad' };

export class EventList {
  constructor(onSeek) {
    this.onSeek = onSeek;
    this.events = [];
    this.levels = new Set(['info', 'warning', 'alarm']);
    for (const box of document.querySelectorAll('[data-level]')) {
      box.addEventListener('change', () => {
        box.checked ? this.levels.add(box.dataset.level) : this.levels.delete(box.dataset.level);
        this.render();
      });
    }
  }

  clear() {
    this.events = [];
    this.render();
  }

  add(events) {
    const known = this.events.at(-1)?.serial ?? -1;
    const fresh = events.filter((event) => event.serial > known);
    if (!fresh.length) return;
    this.events.push(...fresh);
    this.events.splice(0, this.events.length - 500);
    const alarm = fresh.filter((event) => event.level === 'alarm').at(-1);
    if (alarm) setText(byId('announce'), `Alarm: ${alarm.source}, ${alarm.text}`);
    this.render();
  }

  render() {
    const shown = this.events.filter((event) => this.levels.has(event.level)).slice(-MAX_SHOWN).reverse();
    byId('events').replaceChildren(...shown.map((event) => {
      const button = h('button', { type: 'button', class: 'event', title: 'Go to this moment' },
        h('time', {}, clock(event.time_s)), h('span', { class: `chip ${TONES[event.level]}` }, event.level),
        h('b', {}, event.source), h('span', {}, event.text.replaceAll('_', ' ').replace('->', '→')));
      button.addEventListener('click', () => this.onSeek(event));
      return h('li', {}, button);
    }));
    setText(byId('events-note'), this.events.length ? `${this.events.length}` : 'none yet');
  }
}
