// What moment the page shows, and how it moves on: following the bus, paused, stepping, playing.

import { nearestRow } from './history.js';

export class Player {
  /** show(index) draws a frame and resolves when that is done; changed() redraws the controls. */
  constructor(isLog, history, show, changed) {
    Object.assign(this, { isLog, history, show, changed });
    this.following = !isLog;
    this.playing = false;
    this.speed = 1;
    this.time_s = 0;
    this.shownIndex = -1;
    this.busy = false;
    this.last_ms = null;
    const step = (now_ms) => {
      this.advance(now_ms);
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  get rows() { return this.history.rows; }
  get first_s() { return this.rows[0]?.[0] ?? 0; }
  get last_s() { return this.rows.at(-1)?.[0] ?? 0; }
  /** Of the shown moment; -1 while there is nothing to show. */
  get index() { return this.following ? this.rows.length - 1 : nearestRow(this.rows, this.time_s); }

  advance(now_ms) {
    const elapsed_s = this.last_ms === null ? 0 : Math.min((now_ms - this.last_ms) / 1000, 0.5);
    this.last_ms = now_ms;
    if (this.following || !this.rows.length) return;
    if (this.playing) {
      this.time_s = Math.min(this.time_s + elapsed_s * this.speed, this.last_s);
      const isAtEnd = this.time_s >= this.last_s && (!this.isLog || this.history.done);
      if (isAtEnd) {
        this.playing = false;
        this.following = !this.isLog;
        this.changed();
      }
    }
    this.refresh();
  }

  /** Shows the moment, unless it is shown already or the one before is still being drawn. */
  async refresh(force = false) {
    const index = this.index;
    if (index < 0 || this.busy || (index === this.shownIndex && !force)) return;
    this.busy = true;
    this.shownIndex = index;
    try {
      await this.show(index);
    } finally {
      this.busy = false;
    }
    this.changed();
  }

  seek(time_s) {
    this.following = false;
    this.time_s = Math.min(Math.max(time_s, this.first_s), this.last_s);
    this.shownIndex = -1;
    this.refresh();
    this.changed();
  }

  step(frames) {
    const index = Math.min(Math.max(this.index + frames, 0), this.rows.length - 1);
    if (index < 0) return;
    this.playing = false;
    this.seek(this.rows[index][0]);
  }

  toggle() {
    if (this.following) {
      this.following = false;
      this.time_s = this.last_s;
    } else {
      if (!this.playing && this.time_s >= this.last_s) this.isLog ? this.seek(this.first_s) : this.follow();
      if (!this.following) this.playing = !this.playing;
    }
    this.changed();
  }

  follow() {
    if (this.isLog) return this.seek(this.last_s);
    this.following = true;
    this.playing = false;
    this.changed();
  }
}
