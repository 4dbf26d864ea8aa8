// The way from above, with the first image's direction up, and the objects around the camera now.

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

const LEAST_SPAN_M = 40;
const LOOK_AHEAD_M = 30;  // room for the objects before the camera, which do not make the map jump

/** A round length for the scale bar, at most `limit`. */
function roundLength(limit) {
  const power = 10 ** Math.floor(Math.log10(limit));
  return [5, 2, 1].map((step) => step * power).find((length) => length <= limit) ?? power;
}

function bounds(points) {
  let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const [x, z] of points) {
    left = Math.min(left, x);
    right = Math.max(right, x);
    low = Math.min(low, z);
    high = Math.max(high, z);
  }
  return { left, right, low, high };
}

export class MapView {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
  }

  resize() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.round(this.canvas.clientWidth * ratio);
    const height = Math.round(this.canvas.clientHeight * ratio);
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    return [width / ratio, height / ratio];
  }

  /** `rows` up to the shown one, `frame` the shown one, `columns` the places in a row. */
  draw(rows, frame, columns) {
    const { context } = this;
    const [width, height] = this.resize();
    context.clearRect(0, 0, width, height);
    // A restarted chain begins a new world: only the way since then fits together.
    const run = rows.at(-1)?.[columns.run];
    const path = rows.filter((row) => row[columns.x] !== null && row[columns.run] === run)
      .map((row) => [row[columns.x], row[columns.z], row[columns.reset]]);
    if (path.length === 0) {
      context.fillStyle = css('--muted');
      context.font = '13px system-ui, sans-serif';
      context.fillText('no metric motion yet', 12, 22);
      return;
    }
    const heading = this.heading(frame) ?? 0;
    const [x, z] = path.at(-1);
    const box = bounds([...path, [x + LOOK_AHEAD_M * Math.sin(heading), z + LOOK_AHEAD_M * Math.cos(heading)]]);
    const fit = Math.min((width - 48) / Math.max(box.right - box.left, LEAST_SPAN_M),
      (height - 56) / Math.max(box.high - box.low, LEAST_SPAN_M));
    const middle = [(box.left + box.right) / 2, (box.low + box.high) / 2];
    const place = ([x, z]) => [width / 2 + fit * (x - middle[0]), height / 2 - fit * (z - middle[1])];
    this.drawPath(path, place);
    this.drawObjects(frame, place, fit);
    this.drawCamera(path.at(-1), frame, place);
    this.drawBar(width, height, fit);
  }

  drawPath(path, place) {
    const { context } = this;
    context.lineWidth = 2;
    context.lineJoin = 'round';
    context.strokeStyle = css('--curve');
    context.beginPath();
    path.forEach((point, i) => {
      const [x, y] = place(point);
      const breaks = i === 0 || point[2] !== path[i - 1][2];
      breaks ? context.moveTo(x, y) : context.lineTo(x, y);
    });
    context.stroke();
    context.fillStyle = css('--muted');
    const [x, y] = place(path[0]);
    context.beginPath();
    context.arc(x, y, 3.5, 0, 7);
    context.fill();
  }

  heading(frame) {
    const q = frame.ego?.q_world_cam;
    if (!q) return null;
    return Math.atan2(2 * (q[1] * q[3] + q[0] * q[2]), 1 - 2 * (q[1] * q[1] + q[2] * q[2]));
  }

  drawCamera(point, frame, place) {
    const { context } = this;
    const [x, y] = place(point);
    const heading = this.heading(frame) ?? 0;
    context.save();
    context.translate(x, y);
    context.rotate(heading);
    context.fillStyle = css('--accent');
    context.strokeStyle = css('--panel');
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(0, -9);
    context.lineTo(6, 7);
    context.lineTo(0, 4);
    context.lineTo(-6, 7);
    context.closePath();
    context.fill();
    context.stroke();
    context.restore();
  }

  drawObjects(frame, place, fit) {
    const heading = this.heading(frame);
    const origin = frame.ego?.t_world_cam;
    if (heading === null || !frame.objects || !origin || origin[0] === null) return;
    const { context } = this;
    context.strokeStyle = css('--object');
    context.lineWidth = 1.5;
    for (const object of frame.objects.list) {
      if (object.position[0] === null) continue;
      const [ahead, left] = object.position;
      const x = origin[0] + Math.sin(heading) * ahead - Math.cos(heading) * left;
      const z = origin[2] + Math.cos(heading) * ahead + Math.sin(heading) * left;
      const [u, v] = place([x, z]);
      context.save();
      context.translate(u, v);
      context.rotate(heading - object.yaw);
      const width = Math.max(object.size[1] * fit, 4);
      const length = Math.max(object.size[0] * fit, 6);
      context.strokeRect(-width / 2, -length / 2, width, length);
      context.restore();
    }
  }

  drawBar(width, height, fit) {
    const { context } = this;
    const length = roundLength((0.35 * width) / fit);
    const pixels = length * fit;
    context.strokeStyle = css('--text');
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(12.5, height - 18);
    context.lineTo(12.5, height - 12.5);
    context.lineTo(12.5 + pixels, height - 12.5);
    context.lineTo(12.5 + pixels, height - 18);
    context.stroke();
    context.fillStyle = css('--text');
    context.font = '12px system-ui, sans-serif';
    context.textBaseline = 'bottom';
    context.fillText(`${length} m`, 17, height - 15);
  }
}
