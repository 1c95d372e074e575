// node poses.mjs READ FILE.glb…: what three.js makes of each file at 20 instants, beside the motion that genga read of it,
// which is READ/FILE.glb as BVH in parts.
// node poses.mjs spline FILE.glb: writes a chain of nodes with splines, at irregular keys of 30 a second.

import assert from 'node:assert/strict';
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import * as THREE from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { positions, readBvh } from './bvh.mjs';

const LOOKS = 20;
// Of the height.
const FAR = 1e-4;
// Seconds behind a frame: a step at it has been made.
const BEHIND = 1e-5;

if (process.argv[2] === 'spline') {
  writeFileSync(process.argv[3], glb(spline()));
} else {
  for (const file of process.argv.slice(3)) await check(process.argv[2], file);
}

async function check(read, file) {
  const bytes = readFileSync(file);
  const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
  const { scene, animations, parser } = await new GLTFLoader().parseAsync(buffer, '');
  const [clip] = animations;
  const folder = join(read, basename(file));
  const parts = readdirSync(folder).filter((name) => name.endsWith('.bvh')).sort();
  const bvhs = parts.map((name) => readFileSync(join(folder, name)).toString());
  // A BVH rounds its frame time.
  const rate = Math.round(100 / Number(/Frame Time: (\S+)/.exec(bvhs[0])[1])) / 100;
  const { joints } = readBvh(bvhs[0]);
  const rows = bvhs.flatMap((text) => readBvh(text).rows);
  const nodes = await Promise.all(
    joints.map(({ name }) => {
      const at = parser.json.nodes.findIndex((node) => node.name === name);
      assert.ok(at >= 0, `${file}: no node ${name}`);
      return parser.getDependency('node', at);
    }),
  );
  const mixer = new THREE.AnimationMixer(scene);
  const action = mixer.clipAction(clip);
  action.setLoop(THREE.LoopOnce);
  action.clampWhenFinished = true;
  action.play();
  const begin = Math.min(...clip.tracks.map(({ times }) => times[0]));
  const steps = clip.tracks.every((track) => track.getInterpolation() === THREE.InterpolateDiscrete);
  const behind = steps ? BEHIND : 0;
  let off = 0;
  let height = 0;
  for (let look = 0; look < LOOKS; look += 1) {
    const frame = Math.round((look * (rows.length - 1)) / (LOOKS - 1));
    mixer.setTime(begin + frame / rate + behind);
    scene.updateMatrixWorld(true);
    const places = nodes.map((node) => node.getWorldPosition(new THREE.Vector3()));
    const size = new THREE.Box3().setFromPoints(places).getSize(new THREE.Vector3());
    height = Math.max(height, size.x, size.y, size.z);
    positions({ joints }, rows[frame]).forEach((place, joint) => {
      off = Math.max(off, place.distanceTo(places[joint]));
    });
  }
  console.log(`${basename(file)}: ${(off / height).toExponential(1)} of the height off three.js at ${LOOKS} instants`);
  assert.ok(off <= FAR * height, `${file}: ${off / height} of the height off`);
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
  const text = JSON.stringify(document);
  const json = Buffer.from(text.padEnd(Math.ceil(text.length / 4) * 4));
  const word = (number) => Buffer.from(Uint32Array.of(number).buffer);
  const chunk = (kind, data) => [word(data.length), Buffer.from(kind), data];
  const chunks = Buffer.concat([...chunk('JSON', json), ...chunk('BIN\0', bytes)]);
  return Buffer.concat([Buffer.from('glTF'), word(2), word(12 + chunks.length), chunks]);
}
