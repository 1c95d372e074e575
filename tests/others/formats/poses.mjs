// node poses.mjs READ FILE…: what three.js makes of each glTF at 20 instants, beside the motion that genga read of it,
// which is READ/FILE as BVH in parts.
// node poses.mjs spline FILE.glb: writes a chain of nodes with splines, at irregular keys of 30 a second.

import assert from 'node:assert/strict';
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';
import * as THREE from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { readBvh, stands } from './bvh.mjs';

const LOOKS = 20;
// Of the size.
const FAR = 1e-4;
// Radians; samples by others have rotations of three digits.
const TURNED = 1e-3;
// Seconds behind a frame: a step at it has been made.
const BEHIND = 1e-5;

if (process.argv[2] === 'spline') {
  writeFileSync(process.argv[3], glb(spline()));
} else {
  for (const file of process.argv.slice(3)) await check(process.argv[2], file);
}

async function check(read, file) {
  const { scene, animations, parser } = await loaded(file);
  const clip = animations.find(({ tracks }) => tracks.some(moves));
  const folder = join(read, basename(file));
  const parts = readdirSync(folder).filter((name) => name.endsWith('.bvh')).sort();
  const bvhs = parts.map((name) => readFileSync(join(folder, name)).toString());
  // A BVH rounds its frame time.
  const rate = Math.round(100 / Number(/Frame Time: (\S+)/.exec(bvhs[0])[1])) / 100;
  const { joints } = readBvh(bvhs[0]);
  const rows = bvhs.flatMap((text) => readBvh(text).rows);
  const nodes = await Promise.all(
    parser.json.nodes.map((_, at) => parser.getDependency('node', at)),
  );
  scene.updateMatrixWorld(true);
  // A BVH has no rotations at rest.
  const rests = nodes.map((node) => node.getWorldQuaternion(new THREE.Quaternion()).invert());
  const mixer = new THREE.AnimationMixer(scene);
  const action = mixer.clipAction(clip);
  action.setLoop(THREE.LoopOnce);
  action.clampWhenFinished = true;
  action.play();
  const begin = Math.min(...clip.tracks.map(({ times }) => times[0]));
  const steps = clip.tracks.every((track) => track.getInterpolation() === THREE.InterpolateDiscrete);
  const behind = steps ? BEHIND : 0;
  const looks = Array.from({ length: LOOKS }, (_, look) => {
    const frame = Math.round((look * (rows.length - 1)) / (LOOKS - 1));
    mixer.setTime(begin + frame / rate + behind);
    scene.updateMatrixWorld(true);
    const there = nodes.map((node, at) => ({
      position: node.getWorldPosition(new THREE.Vector3()),
      turn: node.getWorldQuaternion(new THREE.Quaternion()).multiply(rests[at]),
    }));
    return { there, found: stands({ joints }, rows[frame]) };
  });
  const furthest = (joint, node, far) =>
    Math.max(...looks.map(({ there, found }) => far(found[joint], there[node])));
  const apart = (found, there) => found.position.distanceTo(there.position);
  const angle = (found, there) => {
    const { x, y, z } = found.turn.clone().invert().multiply(there.turn);
    return 2 * Math.asin(Math.min(1, Math.hypot(x, y, z)));
  };
  // A node without a name, or one of several with one: it goes the way of the joint.
  const nearest = joints.map(({ name }, joint) => {
    const named = nodes.map((_, at) => at).filter((at) => parser.json.nodes[at].name === name);
    const ways = (named.length > 0 ? named : nodes.map((_, at) => at))
      .map((node) => [furthest(joint, node, apart), furthest(joint, node, angle), node]);
    return ways.reduce((least, way) => (way[0] + way[1] < least[0] + least[1] ? way : least));
  });
  const points = looks.flatMap(({ there }) => nearest.map(([, , node]) => there[node].position));
  const size = Math.max(...new THREE.Box3().setFromPoints(points).getSize(new THREE.Vector3()).toArray());
  const off = Math.max(...nearest.map(([way]) => way)) / (size || 1);
  const turned = Math.max(...nearest.map(([, way]) => way));
  console.log(
    `${basename(file)}: ${off.toExponential(1)} of the size and ${turned.toExponential(1)} rad off three.js at ` +
      `${LOOKS} instants (${joints.length} joints, ${rows.length} frames, ${clip.name || 'without a name'})`,
  );
  assert.ok(off <= FAR, `${file}: ${off} of the size off`);
  assert.ok(turned <= TURNED, `${file}: turned by ${turned} rad`);
}

function moves({ values, times }) {
  const width = values.length / times.length;
  return values.some((value, at) => value !== values[at % width]);
}

// The scene without what no motion needs: pictures need a page.
async function loaded(file) {
  const { document, chunk } = opened(readFileSync(file));
  const bytes = [];
  const begins = (document.buffers ?? []).map(({ uri }) => {
    const begin = bytes.reduce((sum, { length }) => sum + length, 0);
    const own = uri === undefined ? chunk : outside(uri, dirname(file));
    bytes.push(own, Buffer.alloc(-own.length & 3));
    return begin;
  });
  for (const view of document.bufferViews ?? []) {
    view.byteOffset = begins[view.buffer] + (view.byteOffset ?? 0);
    view.buffer = 0;
  }
  const all = Buffer.concat(bytes);
  document.buffers = [{ byteLength: all.length }];
  for (const node of document.nodes) {
    for (const word of ['mesh', 'skin', 'camera', 'extensions']) delete node[word];
  }
  const seen = ['meshes', 'skins', 'materials', 'textures', 'images', 'samplers', 'cameras'];
  for (const word of [...seen, 'extensions', 'extensionsUsed', 'extensionsRequired']) delete document[word];
  const whole = glb({ document, bytes: all });
  const buffer = whole.buffer.slice(whole.byteOffset, whole.byteOffset + whole.byteLength);
  return new GLTFLoader().parseAsync(buffer, '');
}

function opened(bytes) {
  if (bytes.toString('latin1', 0, 4) !== 'glTF') return { document: JSON.parse(bytes) };
  const length = bytes.readUInt32LE(12);
  return { document: JSON.parse(bytes.subarray(20, 20 + length)), chunk: bytes.subarray(28 + length) };
}

// A buffer in `data:` or in a file beside the document.
function outside(uri, folder) {
  const [, base64] = /^data:[^,]*;base64,(.*)$/s.exec(uri) ?? [];
  return base64 === undefined ? readFileSync(join(folder, decodeURIComponent(uri))) : Buffer.from(base64, 'base64');
}

function spline() {
  // Numbers that look like chance and are the same each time.
  let seed = 1;
  const chance = () => ((seed = (seed * 16807) % 2147483647) / 2147483647) * 2 - 1;
  const times = [0, 4, 5, 11, 20, 21, 33, 45].map((frame) => frame / 30);
  const rows = (count, value, tangent) =>
    times.flatMap(() => [tangent(), value(), tangent()]).flatMap((row) => row.slice(0, count));
  const turn = () => new THREE.Quaternion(chance(), chance(), chance(), chance()).normalize().toArray();
  const three = (size) => () => [chance() * size, chance() * size, chance() * size];
  const four = () => [chance(), chance(), chance(), chance()];
  const numbers = [times, rows(3, three(1), three(3)), rows(4, turn, four), rows(4, turn, four)];
  const bytes = Buffer.concat(numbers.map((row) => Buffer.from(Float32Array.from(row).buffer)));
  let at = 0;
  const bufferViews = numbers.map((row) => {
    const view = { buffer: 0, byteOffset: at, byteLength: 4 * row.length };
    at += view.byteLength;
    return view;
  });
  const accessor = (bufferView, type, width) => ({
    bufferView, type, componentType: 5126, count: numbers[bufferView].length / width,
  });
  const sampler = (output) => ({ input: 0, output, interpolation: 'CUBICSPLINE' });
  const channel = (number, node, path) => ({ sampler: number, target: { node, path } });
  const document = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [
      { name: 'root', children: [1] },
      { name: 'middle', translation: [0, 1, 0], children: [2] },
      { name: 'top', translation: [0, 1, 0.5] },
    ],
    animations: [{
      channels: [channel(0, 0, 'translation'), channel(1, 0, 'rotation'), channel(2, 1, 'rotation')],
      samplers: [sampler(1), sampler(2), sampler(3)],
    }],
    accessors: [
      { ...accessor(0, 'SCALAR', 1), min: [times[0]], max: [times.at(-1)] },
      accessor(1, 'VEC3', 3), accessor(2, 'VEC4', 4), accessor(3, 'VEC4', 4),
    ],
    bufferViews,
    buffers: [{ byteLength: bytes.length }],
  };
  return { document, bytes };
}

function glb({ document, bytes }) {
  const text = Buffer.from(JSON.stringify(document));
  const json = Buffer.concat([text, Buffer.alloc(-text.length & 3, ' ')]);
  const word = (number) => Buffer.from(Uint32Array.of(number).buffer);
  const chunk = (kind, data) => [word(data.length), Buffer.from(kind), data];
  const chunks = Buffer.concat([...chunk('JSON', json), ...chunk('BIN\0', bytes)]);
  return Buffer.concat([Buffer.from('glTF'), word(2), word(12 + chunks.length), chunks]);
}
