// Draws the charts of the report from the JSON in the page: each when it comes into view, all before printing.
import * as Plot from '@observablehq/plot';

// The same name has the same colour in every chart; the colours themselves are in style.css, light and dark.
const COLOURS = {
  truth: 'var(--truth)', constant: 'var(--constant)', default: 'var(--c1)', adaptive: 'var(--c2)',
  'paper, adaptive': 'var(--c2)', fixed: 'var(--c3)', 'paper, fixed': 'var(--c3)', 'dense alone': 'var(--c4)',
  'paper, dense alone': 'var(--c4)', 'points alone': 'var(--c5)', 'paper, points alone': 'var(--c5)',
  calibrated: 'var(--constant)', cost: 'var(--c4)', candidates: 'var(--c4)', bins: 'var(--c4)', line: 'var(--c1)',
};
const SPARE = ['var(--c6)', 'var(--c7)', 'var(--c8)'];

function scaleOf(names) {
  let next = 0;
  return {domain: names, range: names.map((name) => COLOURS[name] ?? SPARE[next++ % SPARE.length]), legend: true};
}

function rowsOf(curve) {
  return curve.x.map((x, i) => ({x, y: curve.y[i], low: curve.low?.[i], high: curve.high?.[i], name: curve.name}))
    .filter((row) => row.x !== null && row.y !== null);
}

// The x and y that are shown, and the size of the drawing. On a map both axes have one scale, and a straight road keeps
// some room to its sides.
function frameOf(chart, rows, width) {
  if (!chart.equal) return {width, height: 300, x: {}, y: {}};
  const ends = ['x', 'y'].map((key) => [Math.min(...rows.map((row) => row[key])), Math.max(...rows.map((row) => row[key]))]);
  const longest = Math.max(1, ...ends.map(([low, high]) => high - low));
  const [x, y] = ends.map(([low, high]) => {
    const room = Math.max(0.04 * longest, (0.3 * longest - (high - low)) / 2);
    return {domain: [low - room, high + room]};
  });
  const [wide, tall] = [x, y].map((axis) => axis.domain[1] - axis.domain[0]);
  const scale = Math.min((width - 80) / wide, 420 / tall);
  return {width: wide * scale + 80, height: tall * scale + 60, x, y};
}

function drawLines(chart, width) {
  const marks = [Plot.gridX({strokeOpacity: 0.08}), Plot.gridY({strokeOpacity: 0.08})];
  const all = chart.curves.flatMap(rowsOf);
  for (const curve of chart.curves) {
    const rows = rowsOf(curve);
    if (curve.low) marks.push(Plot.areaY(rows, {x: 'x', y1: 'low', y2: 'high', fill: 'name', fillOpacity: 0.2}));
    if (curve.dots) marks.push(Plot.dot(rows, {x: 'x', y: 'y', fill: 'name', r: 1.8, fillOpacity: 0.7}));
    else if (curve.name !== 'truth') marks.push(Plot.line(rows, {x: 'x', y: 'y', stroke: 'name', strokeWidth: 1.6}));
  }
  // Truth lies over the estimates, dashed so that they can be seen through it.
  const truth = chart.curves.filter((curve) => curve.name === 'truth').flatMap(rowsOf);
  if (truth.length) marks.push(Plot.line(truth, {x: 'x', y: 'y', stroke: 'name', strokeWidth: 1.6, strokeDasharray: '5,3'}));
  marks.push(Plot.tip(all, Plot.pointer({x: 'x', y: 'y', stroke: 'name', maxRadius: 80})));
  const frame = frameOf(chart, all, width);
  return Plot.plot({
    width: frame.width, height: frame.height, marginLeft: 60, x: {label: chart.x, ...frame.x}, y: {label: chart.y, ...frame.y},
    color: scaleOf(chart.curves.map((curve) => curve.name)), marks,
  });
}

function drawBars(chart, width) {
  const names = [...new Set(chart.rows.map((row) => row.name))];
  const groups = [...new Set(chart.rows.map((row) => row.group))];
  return Plot.plot({
    width, height: 300, marginLeft: 60, marginBottom: 40, fx: {domain: groups, label: null}, x: {domain: names, axis: null}, y: {label: chart.y, grid: true},
    color: scaleOf(names),
    marks: [
      Plot.barY(chart.rows, {fx: 'group', x: 'name', y: 'value', fill: 'name'}),
      Plot.ruleY([0]),
      Plot.tip(chart.rows, Plot.pointerX({fx: 'group', x: 'name', y: 'value', fill: 'var(--page)'})),
    ],
  });
}

// How full a cell is shows as the strength of one colour, which works on light and dark.
function drawHeat(chart, width) {
  const most = Math.max(...chart.rows.map((row) => row.n));
  const box = {x1: 'x1', x2: 'x2', y1: 'y1', y2: 'y2'};
  return Plot.plot({
    width, height: 300, marginLeft: 60, x: {label: chart.x}, y: {label: chart.y},
    marks: [
      Plot.rect(chart.rows, {...box, fill: 'var(--c1)', fillOpacity: (row) => 0.08 + 0.92 * row.n / most, inset: 0}),
      Plot.tip(chart.rows, Plot.pointer({...box, channels: {[chart.what]: 'n'}, maxRadius: 80})),
    ],
  });
}

const DRAW = {lines: drawLines, bars: drawBars, heat: drawHeat};

const charts = JSON.parse(document.getElementById('charts').textContent);

function draw(place) {
  if (place.firstChild) return;
  const chart = charts[Number(place.dataset.chart)];
  // Maps stand side by side and are as wide as their roads.
  const width = Math.max(320, (chart.equal ? document.querySelector('main') : place).clientWidth);
  place.append(DRAW[chart.type](chart, width));
}

const places = [...document.querySelectorAll('[data-chart]')];
const watcher = new IntersectionObserver((entries) => {
  for (const entry of entries) {
    if (!entry.isIntersecting) continue;
    watcher.unobserve(entry.target);
    draw(entry.target);
  }
}, {rootMargin: '600px'});
for (const place of places) watcher.observe(place);
window.addEventListener('beforeprint', () => places.forEach(draw));
