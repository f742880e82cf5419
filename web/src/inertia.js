// The box with the same mass and inertia as a link.

/**
 * Return the homogeneous box that has a mass and an inertia.
 *
 * A box of mass m with sides a, b, c has, about its centre, Ia = m (b² + c²) / 12 and so on. Adding
 * two of the three and subtracting the third leaves a² = 6 (Ib + Ic − Ia) / m. The box lies along
 * the principal axes, which are the eigenvectors of the matrix.
 *
 * @param {number} mass in kg
 * @param {number[]} tensor ixx, ixy, ixz, iyy, iyz, izz in kg·m², about the centre of mass
 * @returns {{size: number[], axes: number[][]} | null} the sides, and the direction of each as a
 *   unit vector, right-handed; null if no body has that mass and inertia
 */
export function equivalentBox(mass, tensor) {
  if (!(mass > 0) || !tensor.every(Number.isFinite)) return null;
  const { values, vectors } = principalAxes(tensor);
  const [ia, ib, ic] = values;
  const largest = Math.max(ia, ib, ic);
  const squares = [ib + ic - ia, ia + ic - ib, ia + ib - ic].map((sum) => (6 * sum) / mass);
  const isNegligible = (square) => Math.abs(square) < (1e-9 * 6 * largest) / mass;
  if (!(largest > 0) || squares.some((square) => square < 0 && !isNegligible(square))) return null;
  return { size: squares.map((square) => Math.sqrt(Math.max(square, 0))), axes: vectors };
}

/** Return the principal moments and axes of an inertia, by Jacobi's rotations. */
export function principalAxes([ixx, ixy, ixz, iyy, iyz, izz]) {
  const a = [
    [ixx, ixy, ixz],
    [ixy, iyy, iyz],
    [ixz, iyz, izz],
  ];
  const v = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  for (let sweep = 0; sweep < 30; sweep++) {
    const off = Math.hypot(a[0][1], a[0][2], a[1][2]);
    if (off <= 1e-15 * Math.hypot(a[0][0], a[1][1], a[2][2])) break;
    for (const [p, q] of [
      [0, 1],
      [0, 2],
      [1, 2],
    ]) {
      rotate(a, v, p, q);
    }
  }
  const vectors = [0, 1, 2].map((column) => [v[0][column], v[1][column], v[2][column]]);
  const [x, y, z] = vectors;
  const cross = [
    x[1] * y[2] - x[2] * y[1],
    x[2] * y[0] - x[0] * y[2],
    x[0] * y[1] - x[1] * y[0],
  ];
  const isRightHanded = cross[0] * z[0] + cross[1] * z[1] + cross[2] * z[2] > 0;
  if (!isRightHanded) vectors[2] = z.map((entry) => -entry);
  return { values: [a[0][0], a[1][1], a[2][2]], vectors };
}

/** Turn rows and columns p and q of a symmetric matrix so that their common entry becomes 0. */
function rotate(a, v, p, q) {
  if (a[p][q] === 0) return;
  const theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const t = (theta >= 0 ? 1 : -1) / (Math.abs(theta) + Math.hypot(theta, 1));
  const c = 1 / Math.hypot(t, 1);
  const s = t * c;
  for (let k = 0; k < 3; k++) {
    const [akp, akq] = [a[k][p], a[k][q]];
    a[k][p] = c * akp - s * akq;
    a[k][q] = s * akp + c * akq;
  }
  for (let k = 0; k < 3; k++) {
    const [apk, aqk] = [a[p][k], a[q][k]];
    a[p][k] = c * apk - s * aqk;
    a[q][k] = s * apk + c * aqk;
    const [vkp, vkq] = [v[k][p], v[k][q]];
    v[k][p] = c * vkp - s * vkq;
    v[k][q] = s * vkp + c * vkq;
  }
}
