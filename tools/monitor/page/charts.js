// The curves over the last minute, each with a band of one standard deviation.

import uPlot from 'uplot';

export const WINDOW_S = 60;
const GAP_S = 1;
const DEGREES = 180 / Math.PI;

/** name, unit, columns of the row, factor of the shown value, digits, least height of the axis. */
export const CURVES = [
  { id: 'speed', name: 'Speed', unit: 'm/s', factor: 1, digits: 2, span: 2 },
  { id: 'pitch', name: 'Pitch', unit: '°', factor: DEGREES, digits: 2, span: 1, hint: 'nose down positive' },
  { id: 'roll', name: 'Roll', unit: '°', factor: DEGREES, digits: 2, span: 1, hint: 'right side down positive' },
  { id: 'height', name: 'Camera height', unit: 'm', factor: 1, digits: 3, span: 0.2 },
  { id: 'scale', name: 'Scale', unit: 'm/vo', factor: 1, digits: 3, span: 0, hint: 'metres per unit of length of visual odometry' },
];

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** Range of the axis: what is seen, and never so little that noise looks like motion. */
function range(curve, low, high) {
  if (!Number.isFinite(low) || !Number.isFinite(high)) return [0, 1];
  const least = curve.span || 0.1 * Math.max(Math.abs(low), Math.abs(high), 1e-6);
  const middle = (low + high) / 2;
  const half = Math.max(high - low, least) * 0.56;
  return [middle - half, middle + half];
}

function extent(lists) {
  let low = Infinity;
  let high = -Infinity;
  for (const list of lists) {
    for (const value of list) {
      if (value === null) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return [low, high];
}

/** A row without values wherever rows are missing, so that no line leads across. */
function withGaps(rows, run) {
  const list = [];
  for (const row of rows) {
    const last = list.at(-1);
    if (last && (row[0] - last[0] > GAP_S || row[run] !== last[run])) list.push([(row[0] + last[0]) / 2]);
    list.push(row);
  }
  return list;
}

export class Chart {
  constructor(parent, curve, isLast, onSeek) {
    this.parent = parent;
    this.curve = curve;
    this.isLast = isLast;
    this.onSeek = onSeek;
    this.window = [0, 1];
    this.now = 0;
    this.build();
    new ResizeObserver(() => this.resize()).observe(parent);
  }

  height() { return this.parent.clientHeight || (this.isLast ? 92 : 70); }

  resize() {
    if (this.parent.clientWidth) this.plot.setSize({ width: this.parent.clientWidth, height: this.height() });
  }

  build() {
    const { curve } = this;
    const axis = { stroke: css('--muted'), grid: { stroke: css('--line'), width: 1 }, ticks: { show: false },
      font: '11px system-ui, sans-serif' };
    const data = this.plot?.data ?? [[], [], [], []];
    this.plot?.destroy();
    this.plot = new uPlot({
      width: this.parent.clientWidth || 300,
      height: this.height(),
      padding: [6, 8, this.isLast ? 0 : 4, 0],
      legend: { show: false },
      cursor: { y: false, drag: { x: false, y: false }, sync: { key: 'curves' }, points: { show: false } },
      scales: { x: { time: false, range: () => this.window }, y: { range: (_, low, high) => range(curve, low, high) } },
      axes: [
        { ...axis, size: this.isLast ? 22 : 0, show: true, values: (_, ticks) => (this.isLast ? ticks.map((t) => `${t} s`) : ticks.map(() => '')) },
        { ...axis, size: 52, space: 22, values: (_, ticks) => ticks.map((tick) => +tick.toFixed(6)) },
      ],
      series: [{},
        { width: 0, points: { show: false }, stroke: 'transparent' },
        { width: 0, points: { show: false }, stroke: 'transparent' },
        { width: 1.6, points: { show: false }, stroke: css('--curve') }],
      bands: [{ series: [1, 2], fill: css('--band') }],
      hooks: { draw: [(plot) => this.drawNow(plot)], ready: [(plot) => this.listen(plot)] },
    }, data, this.parent);
  }

  listen(plot) {
    plot.over.addEventListener('click', () => {
      if (plot.cursor.left >= 0) this.onSeek(plot.posToVal(plot.cursor.left, 'x'));
    });
  }

  /** The moment that the rest of the page shows. */
  drawNow(plot) {
    const x = Math.round(plot.valToPos(this.now, 'x', true)) + 0.5;
    const { ctx, bbox } = plot;
    if (x < bbox.left || x > bbox.left + bbox.width) return;
    ctx.save();
    ctx.strokeStyle = css('--accent');
    ctx.lineWidth = devicePixelRatio;
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.restore();
  }

  /** The rows `shown` lie inside `window` = [from, to] in seconds. */
  update(shown, columns, window, now) {
    const { curve } = this;
    const rows = withGaps(shown, columns.run);
    const value = columns[curve.id];
    const deviation = columns[`${curve.id}_std`];
    const at = (row, sign) => ((row[value] ?? null) === null ? null
      : curve.factor * (row[value] + sign * (row[deviation] ?? 0)));
    const low = rows.map((row) => at(row, -1));
    const high = rows.map((row) => at(row, 1));
    this.window = window;
    this.now = now;
    const [least, most] = extent([low, high]);
    this.plot.setData([rows.map((row) => row[0]), high, low, rows.map((row) => at(row, 0))], false);
    this.plot.batch(() => {
      this.plot.setScale('x', { min: window[0], max: window[1] });
      const [from, to] = range(curve, least, most);
      this.plot.setScale('y', { min: from, max: to });
    });
  }
}
