// Draws the camera's image with what the chain found in it.

import { CUBOID_EDGES, cuboid, cueRegion, horizon, onRoad, project, roadLine } from './geometry.js';

/** The layers of the picture: key, colour and words of the legend. The colours are those of the
 * picture alone, which is dark in every theme. */
export const LAYERS = [
  { id: 'grid', key: '1', name: 'Road grid', colour: '#3ddc84', mark: 'line',
    hint: 'The estimated plane of the road: lines at 5, 10, 15, 20, 30 and 40 m, 1.8 m apart.' },
  { id: 'horizon', key: '2', name: 'Horizon', colour: '#ffb02e', mark: 'line',
    hint: 'The vanishing line of the plane.' },
  { id: 'region', key: '3', name: 'Cue region', colour: '#4cc9f0', mark: 'dash',
    hint: 'The road that the dense cue looks at, bent along the path.' },
  { id: 'points', key: '4', name: 'Road points', colour: '#f8f32b', mark: 'dot',
    hint: 'Triangulated points below the horizon: the fainter, the less sure of their depth.' },
  { id: 'boxes', key: '5', name: 'Detections', colour: '#ffffff', mark: 'box',
    hint: 'Boxes of the detector.' },
  { id: 'objects', key: '6', name: 'Objects', colour: '#ff6b81', mark: 'line',
    hint: 'Objects on the road; dashed while they are predicted.' },
  { id: 'static', key: '7', name: 'Static features', colour: '#a8b8ff', mark: 'dot',
    hint: 'Features of known depth that stand still in the world.' },
  { id: 'moving', key: '8', name: 'Moving features', colour: '#ff4dff', mark: 'cross',
    hint: 'Features that no point of the world explains: they move, or were mistaken for others.' },
  { id: 'attached', key: '9', name: 'Attached features', colour: '#ff5c00', mark: 'square',
    hint: 'Features that stay in their place in the image while the camera turns.' },
  { id: 'undecided', key: '0', name: 'Undecided features', colour: '#9aa5b1', mark: 'speck',
    hint: 'Features that are new or of unknown depth, and all of them while the motion is not known.' },
];
const COLOUR = Object.fromEntries(LAYERS.map((layer) => [layer.id, layer.colour]));
const GRID_AHEAD_M = [5, 10, 15, 20, 30, 40];
const LABELLED_M = [10, 20, 40];
const HALF_WIDTH_M = 3.6;
const PREDICTED = 1;
const NOT_LOCALISED = 2;

/** Draws a line of pixels; null breaks it. A dark casing keeps it readable on bright road. */
function stroke(context, pixels, colour, width, dash = []) {
  for (const [style, extra] of [['rgba(0,0,0,0.45)', 1.6], [colour, 0]]) {
    context.beginPath();
    let pen = false;
    for (const pixel of pixels) {
      if (!pixel) { pen = false; continue; }
      pen ? context.lineTo(pixel[0], pixel[1]) : context.moveTo(pixel[0], pixel[1]);
      pen = true;
    }
    context.strokeStyle = style;
    context.lineWidth = width + extra * width;
    context.setLineDash(extra ? [] : dash);
    if (!(extra && dash.length)) context.stroke();
  }
  context.setLineDash([]);
}

/** Places labels so that none covers another, most important first. */
class Labels {
  constructor(context, unit) {
    this.context = context;
    this.unit = unit;
    this.taken = [];
  }

  add(text, x, y, colour) {
    const { context, unit } = this;
    context.font = `600 ${11 * unit}px system-ui, sans-serif`;
    const width = context.measureText(text).width + 8 * unit;
    const height = 16 * unit;
    const limit = context.canvas;
    const scaleX = limit.width / context.getTransform().a;
    const left = Math.min(Math.max(x, 0), scaleX - width);
    for (const top of [y, y - height, y + height]) {
      const box = [left, top, left + width, top + height];
      if (top < 0 || this.taken.some((o) => box[0] < o[2] && o[0] < box[2] && box[1] < o[3] && o[1] < box[3])) continue;
      this.taken.push(box);
      context.fillStyle = 'rgba(10,14,18,0.78)';
      context.beginPath();
      context.roundRect(left, top, width, height, 3 * unit);
      context.fill();
      context.fillStyle = colour;
      context.textBaseline = 'middle';
      context.fillText(text, left + 4 * unit, top + height / 2 + 0.5 * unit);
      return;
    }
  }
}

function drawRoad(context, camera, plane, unit, labels) {
  for (let right = -HALF_WIDTH_M; right <= HALF_WIDTH_M + 0.1; right += 1.8)
    stroke(context, roadLine(camera, plane, [right, 4], [right, 40]), COLOUR.grid, unit);
  for (const ahead of GRID_AHEAD_M) {
    stroke(context, roadLine(camera, plane, [-HALF_WIDTH_M, ahead], [HALF_WIDTH_M, ahead]), COLOUR.grid, unit);
    const end = project(camera, onRoad(plane, HALF_WIDTH_M, ahead));
    if (LABELLED_M.includes(ahead) && end && end[0] < camera.width - 30 * unit)
      labels.add(`${ahead} m`, end[0] + 4 * unit, end[1] - 8 * unit, COLOUR.grid);
  }
}

function drawPoints(context, points, unit) {
  context.fillStyle = COLOUR.points;
  for (let i = 0; i + 2 < points.length; i += 3) {
    context.globalAlpha = Math.max(0.25, 1 - 4 * (points[i + 2] ?? 1));
    context.beginPath();
    context.arc(points[i], points[i + 1], 1.7 * unit, 0, 7);
    context.fill();
  }
  context.globalAlpha = 1;
}

/** One path for all features of a kind. */
const FEATURE_SHAPES = {
  dot: (context, x, y, unit) => context.rect(x - unit, y - unit, 2 * unit, 2 * unit),
  speck: (context, x, y, unit) => context.rect(x - 0.75 * unit, y - 0.75 * unit, 1.5 * unit, 1.5 * unit),
  square: (context, x, y, unit) => context.rect(x - 2.5 * unit, y - 2.5 * unit, 5 * unit, 5 * unit),
  cross: (context, x, y, unit) => {
    const arm = 3 * unit;
    context.moveTo(x - arm, y - arm);
    context.lineTo(x + arm, y + arm);
    context.moveTo(x + arm, y - arm);
    context.lineTo(x - arm, y + arm);
  },
};

/** `features`: x, y and the number of the kind, again and again. */
function drawFeatures(context, features, kinds, shown, unit) {
  for (const layer of LAYERS) {
    const kind = kinds.indexOf(layer.id);
    if (kind < 0 || !shown.has(layer.id)) continue;
    context.beginPath();
    for (let i = 0; i + 2 < features.length; i += 3)
      if (features[i + 2] === kind) FEATURE_SHAPES[layer.mark](context, features[i], features[i + 1], unit);
    context.fillStyle = context.strokeStyle = layer.colour;
    context.lineWidth = 1.5 * unit;
    ['dot', 'speck'].includes(layer.mark) ? context.fill() : context.stroke();
  }
}

function drawBoxes(context, boxes, unit) {
  context.strokeStyle = COLOUR.boxes;
  context.lineWidth = unit;
  context.setLineDash([4 * unit, 3 * unit]);
  for (const { box } of boxes.list) context.strokeRect(box[0], box[1], box[2] - box[0], box[3] - box[1]);
  context.setLineDash([]);
}

function drawObjects(context, camera, plane, objects, words, unit, labels) {
  const placed = objects.list.filter((object) => object.status !== NOT_LOCALISED);
  placed.sort((a, b) => a.position[0] - b.position[0]);
  const mostLabels = camera.width / unit < 520 ? 3 : placed.length;
  for (const [nearness, object] of placed.entries()) {
    const corners = cuboid(plane, object).map((corner) => project(camera, corner));
    const dash = object.status === PREDICTED ? [5 * unit, 4 * unit] : [];
    for (const [from, to] of CUBOID_EDGES)
      stroke(context, [corners[from], corners[to]], COLOUR.objects, unit, dash);
    const top = corners.slice(4).filter(Boolean);
    if (!top.length || nearness >= mostLabels) continue;
    const x = Math.min(...top.map((corner) => corner[0]));
    const y = Math.min(...top.map((corner) => corner[1]));
    const range = Math.hypot(...object.position);
    labels.add(`${words.object_class[object.class]} ${range.toFixed(0)} m`, x, y - 18 * unit, COLOUR.objects);
  }
}

export class CameraView {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.bitmap = null;
  }

  /** Draws a frame. `shown` holds the ids of the layers to draw. */
  async draw(frame, jpeg, hello, shown) {
    if (jpeg) {
      const bitmap = await createImageBitmap(new Blob([jpeg], { type: 'image/jpeg' })).catch(() => null);
      if (bitmap) {
        this.bitmap?.close();
        this.bitmap = bitmap;
      }
    }
    this.paint(frame, hello, shown);
  }

  paint(frame, hello, shown) {
    const camera = frame.camera;
    const size = frame.image ?? camera;
    const { canvas, context } = this;
    if (!size) return;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.round(canvas.clientWidth * ratio);
    const height = Math.round((width * size.height) / size.width);
    canvas.style.aspectRatio = `${size.width} / ${size.height}`;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const scale = width / size.width;
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.fillStyle = '#15191e';
    context.fillRect(0, 0, size.width, size.height);
    if (this.bitmap && (frame.image || !camera)) context.drawImage(this.bitmap, 0, 0, size.width, size.height);
    const unit = ratio / scale; // one CSS pixel in pixels of the image
    const labels = new Labels(context, unit);
    if (camera) this.overlay(frame, hello, shown, camera, unit, labels);
    if (!frame.image) labels.add('no image', 8 * unit, 8 * unit, '#ffd166');
  }

  overlay(frame, hello, shown, camera, unit, labels) {
    const { context } = this;
    const plane = frame.plane?.height ? frame.plane : null;
    if (shown.has('boxes') && frame.boxes) drawBoxes(context, frame.boxes, unit);
    if (frame.vo) drawFeatures(context, frame.vo.features, hello.words.vo_feature, shown, unit);
    if (shown.has('points') && frame.vo) drawPoints(context, frame.vo.points, unit);
    if (!plane) return;
    if (shown.has('region')) {
      const [speed, yawRate] = [frame.ego?.velocity[0], frame.ego?.rate[2]];
      const curvature = Math.abs(speed) > 1 && yawRate !== null ? -yawRate / speed : 0;
      const region = cueRegion(camera, plane, hello.road, curvature);
      if (region.length) stroke(context, [...region, region[0]], COLOUR.region, 1.5 * unit, [7 * unit, 4 * unit]);
    }
    if (shown.has('objects') && frame.objects)
      drawObjects(context, camera, plane, frame.objects, hello.words, unit, labels);
    if (shown.has('grid')) drawRoad(context, camera, plane, unit, labels);
    if (shown.has('horizon')) stroke(context, horizon(camera, plane), COLOUR.horizon, 1.5 * unit);
  }
}
