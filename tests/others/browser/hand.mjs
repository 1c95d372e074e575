// What hands have in common.

// Long, for a machine with other work: milliseconds.
export const PATIENCE = 120_000;

// A way from one place to another, in whole pixels.
export function way(from, to) {
  return [0, 1 / 3, 2 / 3, 1].map((share) => from.map((at, side) => Math.round(at + (to[side] - at) * share)));
}

export function middle({ x, y, width, height }) {
  return [Math.round(x + width / 2), Math.round(y + height / 2)];
}
