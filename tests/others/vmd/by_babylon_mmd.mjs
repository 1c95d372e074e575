// by_babylon_mmd.mjs STEM…: babylon-mmd's IK solver, which goes step by step as MMD's does, brings legs to the keys of
// STEM.keys.vmd. They are held against STEM.take.vmd, where they turn by their own keys on every frame.
import fs from 'node:fs';
import assert from 'node:assert';
import { Matrix, Quaternion, Vector3 } from '@babylonjs/core/Maths/math.vector.pure';
import { IkSolver } from 'babylon-mmd/esm/Runtime/ikSolver';
import { Parser } from 'mmd-parser';

// Bones of a figure whose legs are 9.7 units long: name, parent, place in MMD's axes.
const middle = [['センター', null, [0, 8, 0]], ['下半身', 'センター', [0, 12.3, 0]]];
const sided = [['足', '=下半身', [0.8, 11.2, 0]], ['ひざ', '足', [0.8, 6.3, 0]], ['足首', 'ひざ', [0.8, 1.5, 0]],
  ['つま先', '足首', [0.8, 0.2, -1.4]], ['足ＩＫ', null, [0.8, 1.5, 0]], ['つま先ＩＫ', '足ＩＫ', [0.8, 0.2, -1.4]]];

// Of the figure, in MMD units.
const HEIGHT = 19.75;

class Bone {
  ikChainInfo = null;
  children = [];
  world = Matrix.Identity();
  turn = Quaternion.Identity();
  moved = Vector3.Zero();

  constructor(parent, place) {
    this.parentBone = parent;
    this.place = place;
    this.way = Vector3.FromArray(place.map((value, axis) => value - (parent ? parent.place[axis] : 0)));
    parent?.children.push(this);
  }

  put(rotation, moved) {
    Matrix.FromQuaternionToRef(rotation, this.world);
    this.world.setTranslation(this.way.add(moved));
    if (this.parentBone) this.world.multiplyToRef(this.parentBone.world, this.world);
  }

  updateWorldMatrix() {
    let rotation = this.turn.clone();
    if (this.ikChainInfo) {
      this.ikChainInfo.localRotation.copyFrom(rotation);
      this.ikChainInfo.localPosition.copyFrom(this.moved);
      rotation = this.ikChainInfo.ikRotation.multiply(rotation);
    }
    this.put(rotation, this.moved);
  }

  updateBelow() {
    this.updateWorldMatrix();
    this.children.forEach((bone) => bone.updateBelow());
  }

  updateIkChainWorldMatrix() {
    const { ikRotation, localRotation, localPosition } = this.ikChainInfo;
    this.put(ikRotation.multiply(localRotation), localPosition);
    this.children.forEach((bone) => bone.updateBelow());
  }

  getWorldMatrixToRef(target) { return target.copyFrom(this.world); }
  getWorldTranslationToRef(target) { return this.world.getTranslationToRef(target); }
  at() { return this.world.getTranslation(); }
}

function figure() {
  const bones = {};
  const add = ([name, parent, place], side, sign) => {
    const above = parent && (parent.startsWith('=') ? parent.slice(1) : side + parent);
    bones[side + name] = new Bone(above ? bones[above] : null, [sign * place[0], place[1], place[2]]);
  };
  middle.forEach((bone) => add(bone, '', 1));
  for (const [side, sign] of [['左', 1], ['右', -1]]) sided.forEach((bone) => add(bone, side, sign));
  return bones;
}

// The IK of a side, with the angles and steps that models have.
function solvers(bones, side) {
  const foot = new IkSolver(0, bones[`${side}足ＩＫ`], bones[`${side}足首`]);
  [foot.iteration, foot.limitAngle] = [40, 2];
  const knee = { minimumAngle: [-Math.PI, 0, 0], maximumAngle: [-0.5 * Math.PI / 180, 0, 0] };
  foot.addIkChain(bones[`${side}ひざ`], false, knee);
  foot.addIkChain(bones[`${side}足`], false);
  const toes = new IkSolver(1, bones[`${side}つま先ＩＫ`], bones[`${side}つま先`]);
  [toes.iteration, toes.limitAngle] = [3, 4];
  toes.addIkChain(bones[`${side}足首`], false);
  return [foot, toes];
}

function read(file) {
  const { motions } = new Parser().parseVmd(new Uint8Array(fs.readFileSync(file)).buffer);
  const keys = {};
  for (const key of motions) (keys[key.boneName.replace(/\0.*$/s, '')] ??= []).push(key);
  Object.values(keys).forEach((of) => of.sort((a, b) => a.frameNum - b.frameNum));
  return keys;
}

function eased([x1, y1, x2, y2], time) {
  const at = (t, one, two) => 3 * (1 - t) ** 2 * t * one / 127 + 3 * (1 - t) * t * t * two / 127 + t ** 3;
  let [low, high] = [0, 1];
  for (let step = 0; step < 40; step++) {
    const half = (low + high) / 2;
    if (at(half, x1, x2) < time) low = half; else high = half;
  }
  return at(low, y1, y2);
}

function pose(bones, keys, frame) {
  for (const [name, bone] of Object.entries(bones)) {
    const own = keys[name];
    if (!own) continue;
    const next = own.findIndex((key) => key.frameNum > frame);
    const before = own[next < 0 ? own.length - 1 : Math.max(next - 1, 0)];
    const to = next > 0 ? own[next] : before;
    const time = to === before ? 0 : (frame - before.frameNum) / (to.frameNum - before.frameNum);
    // Each coordinate of the four curves stands behind that of the one before.
    const eases = [0, 1, 2, 3].map((curve) => eased([0, 4, 8, 12].map((at) => to.interpolation[at + curve]), time));
    bone.moved = Vector3.FromArray(before.position.map((value, axis) => value + eases[axis] * (to.position[axis] - value)));
    bone.turn = Quaternion.Slerp(Quaternion.FromArray(before.rotation), Quaternion.FromArray(to.rotation), eases[3]);
  }
  Object.values(bones).filter((bone) => !bone.parentBone).forEach((bone) => bone.updateBelow());
}

for (const stem of process.argv.slice(2)) {
  const [keyed, taken] = ['keys', 'take'].map((kind) => read(`${stem}.${kind}.vmd`));
  const [made, take] = [figure(), figure()];
  const ik = ['左', '右'].map((side) => solvers(made, side));
  const most = { ひざ: 0, 足首: 0, つま先: 0 };
  const last = keyed['センター'].at(-1).frameNum;
  for (let frame = 0; frame <= last; frame++) {
    pose(made, keyed, frame);
    ik.flat().forEach((solver) => solver.solve(false));
    pose(take, taken, frame);
    for (const side of ['左', '右']) {
      for (const bone of Object.keys(most)) {
        const off = Vector3.Distance(made[side + bone].at(), take[side + bone].at()) / HEIGHT;
        most[bone] = Math.max(most[bone], off);
      }
    }
  }
  const [knees, ...feet] = Object.values(most);
  // Some captures bend knees a little to the front, which MMD does not.
  assert(knees < 0.04 && feet.every((off) => off <= 0.01), `${stem}: ${JSON.stringify(most)}`);
  const percent = Object.entries(most).map(([bone, off]) => `${bone} ${(100 * off).toFixed(2)} %`);
  console.log(`babylon-mmd: ${stem.split('/').pop()}: ${percent.join(', ')} of body height off at most`);
}
