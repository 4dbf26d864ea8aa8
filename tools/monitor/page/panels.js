// The tables beside the picture: values, cues, state of the estimators, mount, processes.

import { CURVES } from './charts.js';
import { byId, duration, h, keyed, number, plusMinus, setAttribute, setChip, setText, tone, words } from './dom.js';

const DEGREES = 180 / Math.PI;

/** The measured values: one line each with name, value and deviation; the charts hang in them. */
export function buildCurves(parent) {
  return CURVES.map((curve) => {
    const value = h('output', { class: 'value', id: `value-${curve.id}` }, '–');
    const deviation = h('span', { class: 'deviation', id: `deviation-${curve.id}` });
    const chart = h('div', { class: 'chart', 'aria-hidden': 'true' });
    parent.append(h('div', { class: 'curve', role: 'group', 'aria-label': curve.name },
      h('div', { class: 'reading' },
        h('span', { class: 'name', title: curve.hint ?? null }, curve.name),
        h('span', { class: 'figures' }, value, h('span', { class: 'unit' }, curve.unit)), deviation), chart));
    return { curve, value, deviation, chart };
  });
}

export function showValues(curves, row, columns) {
  for (const { curve, value, deviation } of curves) {
    const raw = row ? row[columns[curve.id]] : null;
    const std = row ? row[columns[`${curve.id}_std`]] : null;
    setText(value, number(raw === null ? null : raw * curve.factor, curve.digits));
    setAttribute(value, 'data-raw', raw);
    setText(deviation, plusMinus(std === null ? null : std * curve.factor, curve.digits));
  }
}

function bar(share, mark, tip) {
  return h('span', { class: 'bar', title: tip }, h('span', { class: 'fill', style: `width:${(100 * Math.min(Math.max(share, 0), 1)).toFixed(1)}%` }),
    mark ? h('span', { class: 'gate' }) : null);
}

/** The share of each cue in what the used cues know together of one quantity, by 1/variance. */
function shares(cues, field) {
  const info = cues.map((cue) => (cue.status === 0 && cue[field] > 0 ? 1 / cue[field] ** 2 : 0));
  const sum = info.reduce((a, b) => a + b, 0);
  return info.map((value) => (sum > 0 ? value / sum : 0));
}

function cueRow(cue, name, frame, weights, hello) {
  const scale = frame.ego?.log_scale !== null && frame.ego ? Math.exp(frame.ego.log_scale) : null;
  const absent = cue.status === 1;
  const chip = h('span');
  setChip(chip, tone('cue', cue.status), words(hello.words.cue_status[cue.status]));
  const times = (value, factor) => (value === null || factor === null ? null : value * factor);
  const cell = (value, std, digits, share) => h('td', { class: 'num' },
    h('span', { class: 'figure' }, absent ? '–' : number(value, digits)),
    h('small', {}, absent ? '' : plusMinus(std, digits)), absent || std === null ? null : bar(share, false, `weight ${(100 * share).toFixed(0)} %`));
  const ratio = cue.test_ratio;
  return h('tr', {}, h('th', { scope: 'row' }, name, chip),
    cell(cue.n3 === null ? null : Math.asin(cue.n3) * DEGREES, times(cue.n3_std, DEGREES), 2, weights.n3),
    cell(cue.n1 === null ? null : Math.asin(cue.n1) * DEGREES, times(cue.n1_std, DEGREES), 2, weights.n1),
    cell(times(cue.height, scale), times(cue.height_std, scale), 3, weights.height),
    h('td', { class: 'num' }, h('span', { class: `figure ${ratio > 1 ? 'over' : ''}` }, absent ? '–' : number(ratio, 2)),
      h('small', {}, absent || ratio === null ? '' : ratio > 1 ? 'rejected' : 'of 1'),
      absent || ratio === null ? null : bar(ratio / 2, true, `test ratio ${number(ratio, 2)}; above 1 the cue is rejected`)));
}

export function showCues(frame, hello) {
  const body = byId('cues');
  const cues = frame.plane?.cues ?? [];
  const by = { n1: shares(cues, 'n1_std'), n3: shares(cues, 'n3_std'), height: shares(cues, 'height_std') };
  body.replaceChildren(...cues.slice(0, hello.words.cues.length).map((cue, i) => cueRow(cue, hello.words.cues[i], frame,
    { n1: by.n1[i], n3: by.n3[i], height: by.height[i] }, hello)));
  if (!cues.length) body.append(h('tr', {}, h('td', { colspan: 5, class: 'none' }, 'no plane for this image')));
}

function facts(parent, list) {
  const rows = keyed(parent, list.map(([name]) => name), (name) => h('div', {}, h('dt', {}, name), h('dd')));
  rows.forEach((row, i) => setText(row.lastChild, list[i][1]));
}

function status(id, kind, message, statusWords, reasonWords) {
  const chip = byId(id);
  if (!message) return setChip(chip, 'off', 'no message');
  const reason = message.reason ? ` · ${words(reasonWords[message.reason])}` : '';
  setChip(chip, tone(kind, message.status), words(statusWords[message.status]) + reason);
}

export function showEstimators(frame, hello) {
  const w = hello.words;
  status('status-vo', 'vo', frame.vo, w.vo_status, w.vo_reason);
  status('status-plane', 'plane', frame.plane, w.plane_status, w.plane_reason);
  status('status-ego', 'ego', frame.ego, w.ego_status, w.vo_reason);
  const { vo, ego } = frame;
  facts(byId('facts'), [
    ['Features tracked', number(vo?.num_tracked, 0)],
    ['that agree', number(vo?.num_inliers, 0)],
    ['Road points', vo ? String(vo.points.length / 3) : '–'],
    ['Residual', `${number(vo?.rms_residual_px, 2)} px`],
    ['Attached to the camera', `${number(100 * vo?.attached_share, 1)} % of the image`],
    ['Median flow', `${number(vo?.median_flow_px, 1)} px`],
    ['Scale epoch', number(vo?.scale_epoch, 0)],
    ['Yaw rate', `${number(ego ? ego.rate[2] * DEGREES : null, 2)} °/s`],
    ['Acceleration', `${number(ego?.accel, 2)} m/s²`],
    ['Distance', `${number(ego?.distance, 1)} m`],
    ['Resets of the path', number(ego?.reset_counter, 0)],
  ]);
}

const angle = (values, i) => (!values || values[i] === null ? '–' : `${number(values[i] * DEGREES, 2)}°`);

/** The angle of the reference, and what the newest stretches say. */
function angles(mount, i) {
  const now = angle(mount?.recent, i);
  return mount && mount.reference[i] !== null ? `${angle(mount.reference, i)} · now ${now}` : now === '–' ? now : `now ${now}`;
}

export function showMount(frame, hello) {
  const { mount, camera } = frame;
  status('status-mount', 'mount', mount && { ...mount, reason: 0 }, hello.words.mount_status, hello.words.mount_reason);
  const now = mount?.reason ? words(hello.words.mount_reason[mount.reason]) : 'used';
  facts(byId('mount'), [
    ['Reference', mount ? `${(100 * mount.progress).toFixed(0)} % of the stretches` : '–'],
    ['Pitch', angles(mount, 0)],
    ['Roll', angles(mount, 1)],
    ['Yaw', angles(mount, 2)],
    ['This image', mount ? now : '–'],
    ['Calibration', camera ? `${camera.width} × ${camera.height} px` : 'not received'],
    ['Focal length', camera ? `${number(camera.fx, 1)}, ${number(camera.fy, 1)} px` : '–'],
    ['Principal point', camera ? `${number(camera.cx, 1)}, ${number(camera.cy, 1)} px` : '–'],
    ['Height as stated', camera ? (camera.camera_height > 0 ? `${number(camera.camera_height, 3)} m` : 'by the settings') : '–'],
  ]);
}

function losses(report) {
  const counted = ['rejected', 'dropped', 'late', 'skipped', 'unpaired', 'unsent'].filter((name) => report[name] > 0);
  return counted.length ? counted.map((name) => `${report[name]} ${name}`).join(', ') : 'none';
}

function processRow(report, hello, isLog) {
  const silent = !isLog && report.age_ms > 1500;
  const chip = h('span');
  setChip(chip, silent ? 'bad' : tone('health', report.state),
    isLog ? 'in replay' : silent ? `silent ${duration(report.age_ms)}` : hello.words.health_state[report.state]);
  const total = report.stages.find((stage) => stage.name === 'total');
  const stages = report.stages.filter((stage) => stage !== total)
    .map((stage) => `${stage.name} ${number(stage.median_us / 1000, 2)} ms`).join(', ');
  return h('tr', { title: stages || null }, h('th', { scope: 'row' }, report.process, chip),
    h('td', { class: 'num' }, total ? number(total.median_us / 1000, 1) : '–'),
    h('td', { class: 'num' }, total ? number(total.p99_us / 1000, 1) : '–'),
    h('td', { class: 'num' }, report.rss_bytes ? number(report.rss_bytes / 1048576, 0) : '–'),
    h('td', { class: 'small' }, isLog ? '–' : losses(report), report.state_reason ? h('div', { class: 'reason' }, report.state_reason) : null));
}

export function showProcesses(frame, hello) {
  const isLog = hello.mode === 'log' && !hello.recorded;
  const rows = (frame.health ?? []).map((report) => processRow(report, hello, isLog));
  byId('processes').replaceChildren(...(rows.length ? rows
    : [h('tr', {}, h('td', { colspan: 5, class: 'none' }, 'no process has reported its health'))]));
  const own = frame.monitor;
  setText(byId('own'), own ? `This monitor: ${(100 * own.cpu_share).toFixed(1)} % of a core, ${(own.rss_bytes / 1048576).toFixed(0)} MB, `
    + `${own.pages} ${own.pages === 1 ? 'page' : 'pages'}; results are on the screen ${number(own.page_median_ms, 0)} ms after they `
    + `arrived (95 %: ${number(own.page_p95_ms, 0)} ms).` : '');
}

export function showChannels(frame) {
  const channels = frame.monitor?.channels ?? [];
  byId('channels').replaceChildren(...channels.filter((one) => one.age_ms !== null).map((one) => {
    const chip = h('span');
    setChip(chip, one.age_ms > one.stale_ms ? 'warn' : 'good', duration(one.age_ms));
    return h('li', {}, h('code', {}, one.channel), chip);
  }));
}
