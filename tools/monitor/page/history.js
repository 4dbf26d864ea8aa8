// What the page can step back through. Live, the page keeps the newest frames itself, in a ring of
// fixed size. Of a log it keeps the rows of all frames, and asks the server for the frame it shows.

import { parsePacket } from './link.js';

const MAX_FRAMES = 3000;
const MAX_BYTES = 192 * 1024 * 1024;

export class LiveHistory {
  constructor() {
    this.entries = [];
    this.rows = [];
    this.bytes = 0;
  }

  add(message, buffer) {
    this.entries.push({ buffer });
    this.rows.push(message.row);
    this.bytes += buffer.byteLength;
    while (this.entries.length > MAX_FRAMES || this.bytes > MAX_BYTES) {
      this.bytes -= this.entries.shift().buffer.byteLength;
      this.rows.shift();
    }
  }

  /** Whether the oldest frames are being forgotten. */
  get isFull() {
    return this.entries.length >= MAX_FRAMES || this.bytes > MAX_BYTES - 1024 * 1024;
  }

  async frame(index) {
    const entry = this.entries[index];
    return entry ? parsePacket(entry.buffer) : null;
  }
}

export class LogHistory {
  constructor(link) {
    this.link = link;
    this.rows = [];
    this.share = 0;
    this.done = false;
    this.waiting = null;
  }

  addRows(first, rows) {
    this.rows.length = Math.min(this.rows.length, first);
    this.rows.push(...rows);
  }

  /** Asks for a frame. A later question replaces an earlier one, which then gives null. */
  frame(index) {
    if (this.waiting) this.waiting.resolve(null);
    return new Promise((resolve) => {
      this.waiting = { index, resolve };
      this.link.requestFrame(index);
    });
  }

  /** Takes the answer of the server. */
  answer(message, jpeg) {
    if (!this.waiting || message.index !== this.waiting.index) return;
    const { resolve } = this.waiting;
    this.waiting = null;
    resolve({ message, jpeg });
  }

  /** After the link was lost: what was asked for never comes. */
  forget() {
    if (this.waiting) this.waiting.resolve(null);
    this.waiting = null;
    this.rows = [];
  }
}

/** Index of the row whose time is nearest to time_s; -1 without rows. */
export function nearestRow(rows, time_s) {
  let low = 0;
  let high = rows.length - 1;
  if (high < 0) return -1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (rows[middle][0] < time_s) low = middle + 1;
    else high = middle;
  }
  return low > 0 && time_s - rows[low - 1][0] < rows[low][0] - time_s ? low - 1 : low;
}
