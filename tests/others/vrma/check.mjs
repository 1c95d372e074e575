// node check.mjs FOLDER [as-steps]: the VRMA of a run, played on an avatar, against the BVH beside it.

import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { basename, join } from 'node:path';
import * as THREE from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { VRMAnimationLoaderPlugin, createVRMAnimationClip } from '@pixiv/three-vrm-animation';
import { VRMHumanoid } from '@pixiv/three-vrm-core';
import { positions, readBvh } from './bvh.mjs';

const [folder, asSteps] = process.argv.slice(2);
const named = (ending) => readFileSync(join(folder, readdirSync(folder).find((name) => name.endsWith(ending))));
const vrma = named('.vrma');
const bvh = readBvh(readFileSync(join(folder, 'limited.bvh')).toString());

// An avatar in its T-pose, of other proportions than any capture: name, what it hangs on, where.
const avatar = { hips: [null, 0, 0.8, 0], spine: ['hips', 0, 0.1, 0], chest: ['spine', 0, 0.12, 0], neck: ['chest', 0, 0.25, 0], head: ['neck', 0, 0.08, 0] };
for (const [side, x] of [['left', 1], ['right', -1]]) {
  avatar[`${side}Shoulder`] = ['chest', 0.03 * x, 0.2, 0];
  avatar[`${side}UpperArm`] = [`${side}Shoulder`, 0.08 * x, 0, 0];
  avatar[`${side}LowerArm`] = [`${side}UpperArm`, 0.2 * x, 0, 0];
  avatar[`${side}Hand`] = [`${side}LowerArm`, 0.19 * x, 0, 0];
  avatar[`${side}UpperLeg`] = ['hips', 0.07 * x, -0.04, 0];
  avatar[`${side}LowerLeg`] = [`${side}UpperLeg`, 0, -0.35, 0];
  avatar[`${side}Foot`] = [`${side}LowerLeg`, 0, -0.36, 0];
}
const scene = new THREE.Group();
const bones = {};
const humanBones = {};
for (const [name, [parent, ...place]] of Object.entries(avatar)) {
  const bone = new THREE.Object3D();
  bone.name = name;
  bone.position.set(...place);
  (parent ? bones[parent] : scene).add(bone);
  bones[name] = bone;
  humanBones[name] = { node: bone };
}
scene.updateMatrixWorld(true);
const humanoid = new VRMHumanoid(humanBones);
scene.add(humanoid.normalizedHumanBonesRoot);
const vrm = { scene, humanoid, meta: { metaVersion: '1' } };

const loader = new GLTFLoader();
loader.register((parser) => new VRMAnimationLoaderPlugin(parser));
const bytes = vrma.buffer.slice(vrma.byteOffset, vrma.byteOffset + vrma.byteLength);
const gltf = await loader.parseAsync(bytes, '');
const { json } = gltf.parser;
assert.equal(json.extensions.VRMC_vrm_animation.specVersion, '1.0');
for (const { target } of json.animations[0].channels) {
  assert.ok(target.path === 'rotation' || target.node === json.extensions.VRMC_vrm_animation.humanoid.humanBones.hips.node);
}
const [animation] = gltf.userData.vrmAnimations;
if (asSteps) {
  // Every second key away: what is left of a file that had steps, in a player that draws lines.
  const thin = (track) => {
    const size = track.getValueSize();
    track.values = track.values.filter((_, at) => Math.floor(at / size) % 2 === 0);
    track.times = track.times.filter((_, at) => at % 2 === 0);
  };
  animation.humanoidTracks.rotation.forEach(thin);
}
const clip = createVRMAnimationClip(animation, vrm);
for (const track of clip.tracks) assert.equal(track.getInterpolation(), THREE.InterpolateLinear);
assert.ok(Math.abs(clip.duration - bvh.rows.length / 24) < 1e-5, 'it is as long as the sheet');
const mixer = new THREE.AnimationMixer(scene);
mixer.clipAction(clip).play();

// Which joint is which bone, as the run's table says.
const names = { 足: 'UpperLeg', ひざ: 'LowerLeg', 足首: 'Foot', 腕: 'UpperArm', ひじ: 'LowerArm', 手首: 'Hand' };
const joints = {};
for (const line of named('-bones.csv').toString().split('\n')) {
  const [joint, bone, what] = line.split(',');
  if (what?.trim() !== 'drives') continue;
  const at = bvh.joints.findIndex(({ name }) => name === joint);
  const side = { 左: 'left', 右: 'right' }[bone[0]];
  // Of several joints a bone begins with the first.
  if (side && names[bone.slice(1)]) joints[side + names[bone.slice(1)]] ??= at;
  if (bone === '下半身') joints.hips ??= at;
}
const spans = ['left', 'right'].flatMap((side) => [
  [`${side}UpperArm`, `${side}LowerArm`], [`${side}LowerArm`, `${side}Hand`],
  [`${side}UpperLeg`, `${side}LowerLeg`], [`${side}LowerLeg`, `${side}Foot`],
]);
for (const name of spans.flat()) assert.ok(joints[name] >= 0, `${name} has no joint`);

const everyKoma = bvh.rows.map((row) => positions(bvh, row));
const isZUp = (() => {
  const size = new THREE.Box3().setFromPoints(everyKoma[0]).getSize(new THREE.Vector3());
  return size.z > 1.25 * size.y;
})();
const up = (vector) => (isZUp ? new THREE.Vector3(vector.x, vector.z, -vector.y) : vector.clone());
let furthest = 0;
const ways = [];
everyKoma.forEach((places, koma) => {
  for (const part of [0.1, 0.5, 0.9]) {
    mixer.setTime((koma + part) / 24);
    humanoid.update();
    scene.updateMatrixWorld(true);
    const at = (name) => bones[name].getWorldPosition(new THREE.Vector3());
    for (const [from, to] of spans) {
      const found = at(to).sub(at(from));
      const should = up(places[joints[to]].clone().sub(places[joints[from]]));
      const off = (found.angleTo(should) * 180) / Math.PI;
      furthest = Math.max(furthest, off);
      assert.ok(off < 1, `koma ${koma} + ${part}: ${from} to ${to} is off by ${off}°`);
    }
    if (part === 0.5) ways.push([at('hips'), up(places[joints.hips])]);
  }
});
// The hips go where the capture's go, in one scale.
const [begin, own] = ways[0];
const lengths = ways.map(([way, is]) => [way.clone().sub(begin), is.clone().sub(own)]);
const dot = lengths.reduce((sum, [a, b]) => sum + a.dot(b), 0);
const scale = dot / lengths.reduce((sum, [, b]) => sum + b.lengthSq(), 0);
const astray = Math.max(...lengths.map(([a, b]) => a.distanceTo(b.clone().multiplyScalar(scale))));
assert.ok(scale > 0 && astray < 1e-4, `the hips are astray by ${astray} m`);
console.log(`${basename(folder)}: ${bvh.rows.length} koma, limbs off by ${furthest.toFixed(3)}° at most, hips by ${astray.toExponential(1)} m`);
