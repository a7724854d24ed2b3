/** Eigenvalues and eigenvectors of a symmetric 3 x 3 matrix by Jacobi's rotations. */

const SWEEPS = 12; // chosen: four or five reach machine precision
const PAIRS = [[0, 1], [0, 2], [1, 2]];

/**
 * @param {number[]} matrix  nine numbers, row-major
 * @returns {{values: number[], vectors: number[][]}} vectors[i] belongs to values[i], unit length,
 *   right-handed together, so that they are the columns of a rotation
 */
export function eigen(matrix) {
  const a = [matrix.slice(0, 3), matrix.slice(3, 6), matrix.slice(6, 9)];
  const v = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  for (let sweep = 0; sweep < SWEEPS; sweep++) for (const [p, q] of PAIRS) rotate(a, v, p, q);
  return { values: [a[0][0], a[1][1], a[2][2]], vectors: v };
}

/** One rotation in the plane of p and q, a rotation of the rows of v: it keeps their hand. */
function rotate(a, v, p, q) {
  if (a[p][q] === 0) return;
  const theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const t = (theta < 0 ? -1 : 1) / (Math.abs(theta) + Math.hypot(theta, 1));
  const cosine = 1 / Math.hypot(t, 1);
  const sine = t * cosine;
  for (const row of a) turn(row, row, p, q, cosine, sine);
  for (let k = 0; k < 3; k++) {
    turn(a[p], a[q], k, k, cosine, sine);
    turn(v[p], v[q], k, k, cosine, sine);
  }
}

function turn(one, other, i, j, cosine, sine) {
  const [x, y] = [one[i], other[j]];
  one[i] = cosine * x - sine * y;
  other[j] = sine * x + cosine * y;
}
