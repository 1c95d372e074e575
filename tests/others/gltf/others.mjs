// node others.mjs FOLDER STAGE.gltf [step]: what stands beside the body is in the GLB of a run as it is in its source.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import * as THREE from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import validator from 'gltf-validator';

// Node has no such event, of which three.js tells while it loads the data of a .gltf.
globalThis.ProgressEvent ??= class extends Event {};

const [folder, source, mode] = process.argv.slice(2);
const glb = readFileSync(join(folder, 'limited.glb'));
const sheet = JSON.parse(readFileSync(join(folder, 'sheet.json')));
const report = await validator.validateBytes(new Uint8Array(glb), { maxIssues: 20 });
const { numErrors, numWarnings, messages } = report.issues;
const asked = messages.filter(({ code }) => code !== 'UNUSED_OBJECT' && code !== 'NODE_EMPTY');
assert.deepEqual([numErrors, numWarnings, asked], [0, 0, []], JSON.stringify(messages, null, 1));

async function open(bytes) {
  const whole = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
  const { scene, animations, cameras } = await new GLTFLoader().parseAsync(whole, '');
  const mixer = new THREE.AnimationMixer(scene);
  mixer.clipAction(animations[0]).play();
  const at = (time) => {
    mixer.setTime(time);
    scene.updateMatrixWorld(true);
    return (name) => scene.getObjectByName(name);
  };
  return { at, cameras };
}
const [old, made] = [await open(readFileSync(source)), await open(glb)];
assert.deepEqual([old.cameras.length, made.cameras.length], [1, 1]);
assert.equal(made.cameras[0].fov, old.cameras[0].fov);

// Which place of the source each koma shows, of the drawings.
const [layer] = sheet.layers;
const places = new Map(layer.drawings.map(({ drawing, frame }) => [drawing, frame]));
const shown = layer.exposures.flatMap(({ drawing, koma }) => Array(koma).fill(places.get(drawing)));
const rate = sheet.clip.frame_rate;
let looked = 0;
shown.forEach((place, koma) => {
  const time = mode === 'step' ? place / rate : (koma + 0.5) / sheet.fps;
  if (time >= 2) return;
  const [before, now] = [old.at(time), made.at((koma + 0.5) / sheet.fps)];
  for (const name of ['eye', 'balloon']) {
    const [a, b] = [before(name), now(name)].map(({ matrixWorld }) => matrixWorld.toArray());
    a.forEach((part, at) => assert.ok(Math.abs(part - b[at]) < 1e-5, `${name}, koma ${koma}: ${a} and ${b}`));
  }
  const [a, b] = [before('balloon'), now('balloon')].map((prop) => prop.morphTargetInfluences);
  a.forEach((weight, at) => assert.ok(Math.abs(weight - b[at]) < 1e-5, `weights, koma ${koma}: ${a} and ${b}`));
  const turned = before('sword').quaternion.angleTo(now('sword').quaternion);
  assert.ok(turned < 1e-3, `sword, koma ${koma}: ${turned}`);
  looked += 1;
});
assert.ok(looked > 40);

// On a drawing's own instant the body is where it was, and so is what it carries.
const first = [old.at(0), made.at(0.5 / sheet.fps)].map((find) => find('sword').matrixWorld.toArray());
first[0].forEach((part, at) => assert.ok(Math.abs(part - first[1][at]) < 1e-5, `sword: ${first}`));
console.log(`${basename(folder)}: 0 errors, camera, props and morphs as in the source on ${looked} koma`);
