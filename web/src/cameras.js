// Where the camera is so that all of a robot is seen, as large as possible: as in `yamaro picture`.

import * as THREE from "three";

export const FIELD_OF_VIEW = 24; // degrees between the upper and the lower border
const MARGIN = 1.12; // the width of what is seen, in widths of the robot
const LEAST = 1e-6; // m

/** Azimuth and elevation of the camera in degrees, by name. */
export const VIEWS = {
  iso: [35, 22],
  front: [0, 0],
  left: [90, 0],
  back: [180, 0],
  right: [-90, 0],
  top: [180, 90],
};

/** Return right, up, and the direction to the camera. */
function axesOf(view) {
  const [azimuth, elevation] = VIEWS[view].map(THREE.MathUtils.degToRad);
  const right = new THREE.Vector3(-Math.sin(azimuth), Math.cos(azimuth), 0);
  const back = new THREE.Vector3(
    Math.cos(elevation) * Math.cos(azimuth),
    Math.cos(elevation) * Math.sin(azimuth),
    Math.sin(elevation),
  );
  return [right, back.clone().cross(right), back];
}

/**
 * Return where the camera is that has all points in its picture.
 * @param {string} view one of `VIEWS`
 * @param {THREE.Vector3[]} points in the world, at least one
 * @param {number} aspect width by height of the picture
 * @returns {{position: THREE.Vector3, target: THREE.Vector3}}
 */
export function fitted(view, points, aspect) {
  const [right, up, back] = axesOf(view);
  const center = new THREE.Box3().setFromPoints(points).getCenter(new THREE.Vector3());
  const slope = Math.tan(THREE.MathUtils.degToRad(FIELD_OF_VIEW / 2));
  const target = center.clone();
  let distance = LEAST;
  for (const [axis, each] of [[right, (slope * aspect) / MARGIN], [up, slope / MARGIN]]) {
    // A point is in if its place across is at most `each` times its distance from the camera.
    let [high, low] = [-Infinity, -Infinity];
    for (const point of points) {
      const offset = point.clone().sub(center);
      const [across, depth] = [offset.dot(axis), offset.dot(back)];
      high = Math.max(high, across + each * depth);
      low = Math.max(low, each * depth - across);
    }
    distance = Math.max(distance, (high + low) / (2 * each));
    target.addScaledVector(axis, (high - low) / 2);
  }
  if (distance <= LEAST) distance = 1; // a robot without extent
  return { position: target.clone().addScaledVector(back, distance), target };
}

const DIRECTIONS = [-1, 0, 1].flatMap((x) =>
  [-1, 0, 1].flatMap((y) => [-1, 0, 1].map((z) => [x, y, z])),
);

/** Return the corners of a body that are outermost in directions all around, in its own frame. */
export function outermost(geometry) {
  const { position } = geometry.attributes;
  const best = DIRECTIONS.map(() => [-Infinity, 0]);
  for (let index = 0; index < (position?.count ?? 0); index++) {
    const [px, py, pz] = [position.getX(index), position.getY(index), position.getZ(index)];
    for (let each = 0; each < DIRECTIONS.length; each++) {
      const [x, y, z] = DIRECTIONS[each];
      const reach = x * px + y * py + z * pz;
      if (reach > best[each][0]) best[each] = [reach, index];
    }
  }
  const found = new Set(best.filter(([reach]) => reach > -Infinity).map(([, index]) => index));
  return [...found].map((index) => new THREE.Vector3().fromBufferAttribute(position, index));
}
