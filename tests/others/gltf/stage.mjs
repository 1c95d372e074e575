// node stage.mjs FILE.gltf: a body of two bones, a camera that pans, a sword in its hand and a prop with morphs.

import { writeFileSync } from 'node:fs';

const half = Math.SQRT1_2;
const bytes = [];
const accessors = [];
const bufferViews = [];
let length = 0;
function add(type, numbers, target) {
  const width = { SCALAR: 1, VEC3: 3, VEC4: 4, MAT4: 16 }[type];
  const part = Buffer.from(Float32Array.from(numbers).buffer);
  bufferViews.push({ buffer: 0, byteOffset: length, byteLength: part.length, target });
  bytes.push(part);
  length += part.length;
  const along = (axis) => Array.from(Float32Array.from(numbers)).filter((_, at) => at % width === axis);
  const bound = (of) => [...Array(width).keys()].map((axis) => of(...along(axis)));
  const bounds = width > 3 ? {} : { min: bound(Math.min), max: bound(Math.max) };
  accessors.push({ bufferView: bufferViews.length - 1, componentType: 5126, count: numbers.length / width, type, ...bounds });
  return accessors.length - 1;
}

const channels = [];
const samplers = [];
const input = add('SCALAR', [0, 1, 2]);
function play(node, path, type, numbers, interpolation = 'LINEAR') {
  samplers.push({ input, output: add(type, numbers), interpolation });
  channels.push({ sampler: samplers.length - 1, target: { node, path } });
}
play(1, 'translation', 'VEC3', [0, 1, 0, 0.5, 1, 0, 1, 1, 0]);
play(1, 'rotation', 'VEC4', [0, 0, 0, 1, 0, half, 0, half, 0, 1, 0, 0]);
play(4, 'translation', 'VEC3', [0, 1, 5, 0, 1, 5, 2, 1, 5]);
play(4, 'rotation', 'VEC4', [0, 0, 0, 1, 0, 0, 0, 1, 0, 0.1, 0, Math.sqrt(0.99)]);
play(5, 'weights', 'SCALAR', [0, 0, 1, 0.5, 0, 0]);
play(5, 'scale', 'VEC3', [0, 0, 0, 1, 1, 1, 0, 1, 0, 0, 1, 0, 1, 2, 1, 0, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0], 'CUBICSPLINE');
play(3, 'rotation', 'VEC4', [0, 0, 0, 1, half, 0, 0, half, 1, 0, 0, 0], 'STEP');

const vertices = 34962;
const corners = add('VEC3', [0, 0, 0, 0.1, 0, 0, 0, 0.5, 0], vertices);
const [wide, high] = [[0.2, 0, 0], [0, 0.2, 0]].map((way) => add('VEC3', [...way, ...way, ...way], vertices));
const attributes = { POSITION: corners };
const targets = [{ POSITION: wide }, { POSITION: high }];
writeFileSync(process.argv[2], JSON.stringify({
  asset: { version: '2.0' },
  scene: 0,
  scenes: [{ nodes: [0] }],
  nodes: [
    { name: 'room', children: [1, 4, 5] },
    { name: 'hip', translation: [0, 1, 0], children: [2] },
    { name: 'knee', translation: [0, -0.5, 0], rotation: [half, 0, 0, half], scale: [2, 2, 2], children: [3] },
    { name: 'sword', translation: [0, 0.25, 0], mesh: 0 },
    { name: 'eye', camera: 0, translation: [0, 1, 5] },
    { name: 'balloon', translation: [1, 0, 0], mesh: 1 },
  ],
  cameras: [{ type: 'perspective', perspective: { yfov: 0.6, znear: 0.1 } }],
  materials: [{ name: 'steel', pbrMetallicRoughness: { roughnessFactor: 0.2 } }],
  meshes: [
    { primitives: [{ attributes, material: 0 }] },
    { primitives: [{ attributes, targets, material: 0 }], weights: [0, 0] },
  ],
  skins: [{ joints: [1, 2] }],
  animations: [{ name: 'act', channels, samplers }],
  accessors,
  bufferViews,
  buffers: [{ byteLength: length, uri: `data:application/octet-stream;base64,${Buffer.concat(bytes).toString('base64')}` }],
}));
