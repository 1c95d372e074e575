// node keys.mjs FOLDER CLIP: the keys and curves of a run, as three.js plays them, against the take.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import * as THREE from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import validator from 'gltf-validator';
import { positions, readBvh } from './bvh.mjs';

const [, , folder, clip] = process.argv;
const glb = readFileSync(join(folder, 'keys.glb'));
const take = readBvh(readFileSync(clip).toString());

const report = await validator.validateBytes(new Uint8Array(glb), { maxIssues: 20 });
const { numErrors, numWarnings, messages } = report.issues;
assert.deepEqual([numErrors, numWarnings, messages], [0, 0, []], JSON.stringify(messages, null, 1));

const bytes = glb.buffer.slice(glb.byteOffset, glb.byteOffset + glb.byteLength);
const { scene, animations, parser } = await new GLTFLoader().parseAsync(bytes, '');
assert.deepEqual(animations.map(({ name }) => name), ['keys']);
const [{ extras, samplers }] = parser.json.animations;
const [{ keys }] = extras.layers;
const curved = samplers.filter(({ interpolation }) => interpolation === 'CUBICSPLINE').length;

// The genga of the sheet are all keys, and numbered as on the sheet.
const sheet = JSON.parse(readFileSync(join(folder, 'sheet.json')));
const genga = sheet.layers[0].drawings.filter(({ role }) => role !== 'inbetween').map(({ frame }) => frame);
assert.deepEqual(keys.filter(({ role }) => role !== 'added').map(({ frame }) => frame), genga);

const bones = await Promise.all(take.joints.map((_, joint) => parser.getDependency('node', joint)));
const scale = metresInOne();
const mixer = new THREE.AnimationMixer(scene);
// An action that ends on its last key shows it.
const action = mixer.clipAction(animations[0]);
action.setLoop(THREE.LoopOnce);
action.clampWhenFinished = true;
action.play();
const [first, last] = [keys[0].frame, keys.at(-1).frame];
let furthest = 0;
for (let frame = Math.ceil(first); frame <= last; frame += 1) {
  mixer.setTime((frame - first) / extras.fps);
  scene.updateMatrixWorld(true);
  positions(take, take.rows[frame]).forEach((expected, joint) => {
    const found = bones[joint].getWorldPosition(new THREE.Vector3()).divideScalar(scale);
    furthest = Math.max(furthest, (found.distanceTo(expected) * scale) / extras.height);
  });
}
assert.ok(furthest <= extras.error.asked + 1e-5, `off by ${furthest}, asked ${extras.error.asked}`);

const added = keys.length - genga.length;
console.log(
  `${basename(folder)}: ${keys.length} keys, ${added} of them added, ${curved} of ${samplers.length} channels curved, ` +
    `joints off by ${(100 * furthest).toFixed(2)} % of the body`,
);

// From any bone that has a length: how much shorter it is in the GLB.
function metresInOne() {
  const lengths = take.joints.map(({ offset }) => offset.length());
  const longest = lengths.indexOf(Math.max(...lengths));
  return new THREE.Vector3(...parser.json.nodes[longest].translation).length() / lengths[longest];
}
