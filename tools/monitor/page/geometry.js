// Projection of the road and of what stands on it, as core/camera_model.hpp and the messages define
// it. cam: x right, y down, z forward. Plane: normal . X = height, the normal points down.

const NEAREST_M = 0.5;
const WIDEST = 1.5; // farther off the axis, the radial terms fold the image over

/** Pixel [u, v] of a point in cam, or null behind the camera or far beside it. */
export function project(camera, p) {
  if (p[2] < NEAREST_M) return null;
  const x = p[0] / p[2];
  const y = p[1] / p[2];
  if (Math.abs(x) > WIDEST || Math.abs(y) > WIDEST) return null;
  const r2 = x * x + y * y;
  const s = 1 + r2 * (camera.k1 + r2 * camera.k2);
  return [camera.fx * x * s + camera.cx, camera.fy * y * s + camera.cy];
}

/** Point in cam of the road `right` m to the right of and `ahead` m ahead of the camera. */
export function onRoad(plane, right, ahead) {
  const n = plane.normal;
  return [right, (plane.height - n[0] * right - n[2] * ahead) / n[1], ahead];
}

/** The road from (right, ahead) to (right, ahead) as pixels, in pieces. */
export function roadLine(camera, plane, from, to, pieces = 24) {
  const pixels = [];
  for (let i = 0; i <= pieces; ++i) {
    const share = i / pieces;
    const at = [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
    pixels.push(project(camera, onRoad(plane, at[0], at[1])));
  }
  return pixels;
}

/** The plane's vanishing line at the left and the right edge of the image. */
export function horizon(camera, plane) {
  const n = plane.normal;
  const row = camera.cy - (camera.fy * n[2]) / n[1];
  const slope = -n[0] / n[1];
  return [[0, row - slope * camera.cx], [camera.width, row + slope * (camera.width - camera.cx)]];
}

const cross = (a, b) =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** The eight corners in cam of a box on the road: the underside, then the top. */
export function cuboid(plane, object) {
  const down = plane.normal;
  const along = [-down[2] * down[0], -down[2] * down[1], 1 - down[2] * down[2]];
  const length = Math.hypot(...along);
  const ahead = along.map((value) => value / length);
  const left = cross(ahead, down);
  const [cos, sin] = [Math.cos(object.yaw), Math.sin(object.yaw)];
  const around = [[0.5, 0.5], [0.5, -0.5], [-0.5, -0.5], [-0.5, 0.5]];
  return [0, object.size[2]].flatMap((up) => around.map(([l, w]) => {
    const dx = l * object.size[0];
    const dy = w * object.size[1];
    const x = object.position[0] + cos * dx - sin * dy;
    const y = object.position[1] + sin * dx + cos * dy;
    return [0, 1, 2].map((i) => (plane.height - up) * down[i] + x * ahead[i] + y * left[i]);
  }));
}

export const CUBOID_EDGES = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4],
  [1, 5], [2, 6], [3, 7]];

/** The outline of the road that the cues look at, bent along the path, as pixels. */
export function cueRegion(camera, plane, road, curvature) {
  const h = plane.height;
  const pieces = 16;
  const side = (sign) => {
    const pixels = [];
    for (let i = 0; i <= pieces; ++i) {
      const ahead = (road.near + (i / pieces) * (road.far - road.near)) * h;
      const right = 0.5 * curvature * ahead * ahead + sign * road.half_width * h;
      pixels.push(project(camera, onRoad(plane, right, ahead)));
    }
    return pixels;
  };
  return [...side(-1), ...side(1).reverse()].filter((pixel) => pixel !== null);
}
