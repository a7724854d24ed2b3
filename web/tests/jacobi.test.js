import assert from "node:assert/strict";
import { test } from "node:test";
import { eigen } from "../../src/equipoise/app/dashboard/static/jacobi.js";

const near = (a, b, tolerance) => assert.ok(Math.abs(a - b) <= tolerance, `${a} is not ${b}`);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [0, 1, 2].map((i) => {
  const [j, k] = [(i + 1) % 3, (i + 2) % 3];
  return a[j] * b[k] - a[k] * b[j];
});
const times = (m, v) => [0, 3, 6].map((row) => dot(m.slice(row, row + 3), v));

const MATRICES = {
  "a diagonal": [3, 0, 0, 0, 1, 0, 0, 0, 2],
  "one worked by hand, 2 1 1 on a corner": [2, 1, 0, 1, 2, 0, 0, 0, 5],
  "a full one": [4, 1, -2, 1, 3, 0.5, -2, 0.5, 6],
  "a covariance in m2": [4e-12, 1.5e-12, 2e-13, 1.5e-12, 9e-12, -3e-12, 2e-13, -3e-12, 2.5e-11],
  "one of a line only": [1, 2, 3, 2, 4, 6, 3, 6, 9],
  "nothing": Array(9).fill(0),
};

for (const [name, matrix] of Object.entries(MATRICES)) {
  test(`eigenvectors of ${name} are a rotation that makes it diagonal`, () => {
    const size = Math.max(...matrix.map(Math.abs), Number.MIN_VALUE);
    const { values, vectors } = eigen(matrix);
    vectors.forEach((vector, i) => {
      near(dot(vector, vector), 1, 1e-12);
      times(matrix, vector).forEach((x, k) => near(x, values[i] * vector[k], 1e-12 * size));
    });
    near(dot(cross(vectors[0], vectors[1]), vectors[2]), 1, 1e-12); // right-handed
  });
}

test("eigenvalues of the corner worked by hand are 1, 3 and 5", () => {
  const { values } = eigen(MATRICES["one worked by hand, 2 1 1 on a corner"]);
  [1, 3, 5].forEach((value, i) => near(values.toSorted((a, b) => a - b)[i], value, 1e-12));
});
