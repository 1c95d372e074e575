// node beside.cjs make BODY.vmd FILE.vmd: puts keys of the face and of the camera into a motion of bones.
// node beside.cjs check FILE.vmd BODY.vmd CAMERA.vmd: npm's mmd-parser finds the same keys in what genga made of it.
'use strict';
const fs = require('fs');
const assert = require('assert');
const { Parser } = require('mmd-parser');

const faces = [['あ', 0, 0], ['まばたき', 12, 1], ['あ', 30, 1], ['あ', 61, 0.25]];
// CP932 of the names.
const names = { あ: [0x82, 0xa0], まばたき: [0x82, 0xdc, 0x82, 0xce, 0x82, 0xbd, 0x82, 0xab] };
const cameras = [[0, -45, 0, 20], [30, -30, 5, 64], [60, -30, 9, 20], [61, -60, 0, 20], [90, -50, 0, 33]];

function make(body, file) {
  const bytes = fs.readFileSync(body);
  const bones = bytes.readUInt32LE(50);
  const parts = [bytes.subarray(0, 54 + 111 * bones)];
  const word = (number) => { const part = Buffer.alloc(4); part.writeUInt32LE(number); return part; };
  const single = (number) => { const part = Buffer.alloc(4); part.writeFloatLE(number); return part; };
  parts.push(word(faces.length));
  for (const [name, frame, weight] of faces) {
    parts.push(Buffer.concat([Buffer.from(names[name]), Buffer.alloc(15)]).subarray(0, 15), word(frame), single(weight));
  }
  parts.push(word(cameras.length));
  for (const [frame, distance, x, handle] of cameras) {
    parts.push(word(frame), ...[distance, x, 10, 0, 0.1, 0.2, 0].map(single));
    parts.push(Buffer.from(Array(6).fill([handle, 127 - handle, handle, 127 - handle]).flat()), word(30), Buffer.from([0]));
  }
  parts.push(word(0), word(0), word(0));
  fs.writeFileSync(file, Buffer.concat(parts));
}

function read(file) {
  return new Parser().parseVmd(new Uint8Array(fs.readFileSync(file)).buffer);
}

function check(file, body, camera) {
  const [source, made, of_camera] = [file, body, camera].map(read);
  const sorted = (morphs) => morphs.map((key) => JSON.stringify(key)).sort();
  assert.strictEqual(source.morphs.length, faces.length);
  assert.deepStrictEqual(sorted(made.morphs), sorted(source.morphs));
  assert.strictEqual(made.metadata.cameraCount, 0);
  assert.strictEqual(of_camera.metadata.motionCount, 0);
  assert.strictEqual(source.cameras.length, cameras.length);
  assert.deepStrictEqual(of_camera.cameras, source.cameras);
  console.log(`mmd-parser: ${made.morphs.length} keys of the face and ${of_camera.cameras.length} of the camera as they were`);
}

const [what, ...files] = process.argv.slice(2);
({ make, check })[what](...files);
