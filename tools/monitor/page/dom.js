// Small helpers to build and to change the document, which touch it only where something changed.

/** h('td', { class: 'num' }, 'text', child, ...) */
export function h(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === true) node.setAttribute(name, '');
    else if (value !== null && value !== undefined && value !== false) node.setAttribute(name, value);
  }
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

export function setText(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

export function setAttribute(node, name, value) {
  if (node.getAttribute(name) !== String(value)) node.setAttribute(name, value);
}

export const byId = (id) => document.getElementById(id);

/** A number with `digits` after the point; a dash when it is not valid. */
export function number(value, digits = 2) {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const text = value.toFixed(digits);
  return (/^-0(\.0*)?$/.test(text) ? text.slice(1) : text).replace('-', '\u2212');
}

export function plusMinus(value, digits = 2) {
  return value === null || value === undefined || !Number.isFinite(value) ? '' : `± ${value.toFixed(digits)}`;
}

/** "4.2 s", "38 ms", "3 min". */
export function duration(ms) {
  if (ms === null || ms === undefined || !Number.isFinite(ms)) return '–';
  if (ms < 1000) return `${Math.round(ms)} ms`;
  if (ms < 60000) return `${(ms / 1000).toFixed(1)} s`;
  return `${Math.floor(ms / 60000)} min ${Math.round((ms % 60000) / 1000)} s`;
}

/** A time on the time line: "1:02.3". */
export function clock(seconds) {
  const s = Math.max(seconds, 0);
  return `${Math.floor(s / 60)}:${(s % 60).toFixed(1).padStart(4, '0')}`;
}

export const words = (text) => (text ?? '?').replaceAll('_', ' ');

/** A small coloured word. `tone` is good, warn, bad or off. */
export function setChip(node, tone, text) {
  setAttribute(node, 'class', `chip ${tone}`);
  setText(node, text);
}

const TONES = {
  vo: ['good', 'warn', 'good', 'good', 'warn', 'bad'],
  plane: ['good', 'warn', 'warn', 'bad'],
  ego: ['good', 'warn', 'warn', 'good', 'warn', 'bad'],
  cue: ['good', 'off', 'warn', 'bad'],
  mount: ['off', 'warn', 'good', 'bad', 'bad'],
  health: ['good', 'off', 'warn', 'off'],
};
export const tone = (kind, status) => TONES[kind][status] ?? 'off';

/** Keeps the children of `parent` in step with `keys`; `build(key)` makes a new one. */
export function keyed(parent, keys, build) {
  const wanted = new Set(keys.map(String));
  for (const child of [...parent.children]) if (!wanted.has(child.dataset.key)) child.remove();
  return keys.map((key, i) => {
    let node = [...parent.children].find((child) => child.dataset.key === String(key));
    if (!node) {
      node = build(key);
      node.dataset.key = key;
    }
    if (parent.children[i] !== node) parent.insertBefore(node, parent.children[i] ?? null);
    return node;
  });
}
