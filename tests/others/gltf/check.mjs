// node check.mjs FOLDER [doubled]: the GLB of a run against the sheet and the BVH beside it.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import * as THREE from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import validator from 'gltf-validator';
import { positions, readBvh } from './bvh.mjs';

const folder = process.argv[2];
const isDoubled = process.argv[3] === 'doubled';
const read = (name) => readFileSync(join(folder, name));
const glb = read('limited.glb');
const sheet = JSON.parse(read('sheet.json'));
const bvh = readBvh(read('limited.bvh').toString());

// The validator: nothing to say. A mesh is what a scene without one is told to want.
const report = await validator.validateBytes(new Uint8Array(glb), { maxIssues: 20 });
const { numErrors, numWarnings, messages } = report.issues;
const asked = messages.filter(({ code }) => code !== 'UNUSED_OBJECT' && code !== 'NODE_EMPTY');
assert.deepEqual([numErrors, numWarnings, asked], [0, 0, []], JSON.stringify(messages, null, 1));
const hasMesh = report.info.totalVertexCount > 0;
assert.ok(!hasMesh || messages.length === 0, JSON.stringify(messages));

// three.js, as a page loads it.
const bytes = glb.buffer.slice(glb.byteOffset, glb.byteOffset + glb.byteLength);
const { scene, animations, parser } = await new GLTFLoader().parseAsync(bytes, '');
assert.deepEqual(animations.map(({ name }) => name), ['koma', 'genga']);
for (const { samplers } of parser.json.animations) {
  for (const { interpolation } of samplers) assert.equal(interpolation, isDoubled ? 'LINEAR' : 'STEP');
}
for (const { tracks } of animations) {
  for (const track of tracks) assert.equal(track.getInterpolation(), isDoubled ? THREE.InterpolateLinear : THREE.InterpolateDiscrete);
}
const bones = await Promise.all(bvh.joints.map((_, joint) => parser.getDependency('node', joint)));
for (const bone of bones) assert.ok(bone.isBone, `${bone.name} is a ${bone.type}`);
bvh.joints.forEach(({ name }, joint) => assert.equal(parser.json.nodes[joint].name, name));

// What stands on each koma by the sheet, and the last key before it.
const [layer] = sheet.layers;
const shown = layer.exposures.flatMap(({ drawing, koma }) => Array(koma).fill(drawing));
const drawings = new Map(layer.drawings.map((entry) => [entry.drawing, entry]));
const isKey = (drawing) => drawings.get(drawing).role !== 'inbetween';
let key = 0;
const keys = shown.map((drawing, koma) => (key = isKey(drawing) ? koma : key));
assert.equal(bvh.rows.length, shown.length);

const everyKoma = bvh.rows.map((row) => positions(bvh, row));
const box = (points) => new THREE.Box3().setFromPoints(points).getSize(new THREE.Vector3());
const size = Math.max(...box(everyKoma[0]).toArray()) || 1;
const scale = metresInOne();
const mixer = new THREE.AnimationMixer(scene);
let furthest = 0;
for (const [clip, koma] of [[animations[0], shown.map((_, at) => at)], [animations[1], keys]]) {
  mixer.stopAllAction();
  mixer.clipAction(clip).play();
  assert.ok(Math.abs(clip.duration - shown.length / sheet.fps) < 1e-6, 'the cut is as long as the sheet');
  // A doubled hold is looked at five times a koma: it must stand to its end though lines are drawn between keys.
  const looks = isDoubled ? [0.1, 0.3, 0.5, 0.7, 0.9] : [0.5];
  shown.flatMap((_, at) => looks.map((part) => [at, part])).forEach(([at, part]) => {
    mixer.setTime((at + part) / sheet.fps);
    scene.updateMatrixWorld(true);
    everyKoma[koma[at]].forEach((expected, joint) => {
      const found = bones[joint].getWorldPosition(new THREE.Vector3()).divideScalar(scale);
      const off = found.distanceTo(expected) / size;
      furthest = Math.max(furthest, off);
      assert.ok(off < 1e-6, `${clip.name}, koma ${at}, ${bones[joint].name}: off by ${off} of the body`);
    });
  });
}

// By the sheet's numbers: which drawing, in which role, from where, on which koma.
const [all, genga] = parser.json.animations.map(({ extras }) => extras);
const listed = all.keys.flatMap(({ drawing, length }) => Array(length).fill(drawing));
assert.deepEqual(listed, shown);
for (const { keys: entries, koma, fps } of [all, genga]) {
  assert.deepEqual([koma, fps], [shown.length, sheet.fps]);
  for (const { drawing, role, frame, between, share } of entries) {
    const { why, ...written } = drawings.get(drawing);
    assert.deepEqual(JSON.parse(JSON.stringify({ drawing, role, frame, between, share })), written);
  }
}
assert.deepEqual(genga.keys.map(({ drawing }) => drawing), [...new Set(keys.map((at) => shown[at]))]);
assert.deepEqual(genga.keys.map(({ genga_no }) => genga_no), genga.keys.map((_, at) => at + 1));

const infos = messages.map(({ code }) => code).join(' ') || 'none';
console.log(
  `${basename(folder)}: 0 errors, 0 warnings, infos: ${infos}; ${shown.length} koma, ` +
    `${layer.exposures.length} drawings, ${bones.length} joints, off by ${furthest.toExponential(1)} of the body`,
);

// From any bone that has a length: how much shorter it is in the GLB.
function metresInOne() {
  const lengths = bvh.joints.map(({ offset }) => offset.length());
  const longest = lengths.indexOf(Math.max(...lengths));
  const written = new THREE.Vector3(...parser.json.nodes[longest].translation).length();
  return lengths[longest] > 0 ? written / lengths[longest] : 0.01;
}
