// Holds every record of a VMD, as npm's mmd-parser reads it, against what was meant by it.
'use strict';
const fs = require('fs');
const assert = require('assert');
const { Parser } = require('mmd-parser');

// What mmd-parser makes of the 64 bytes of a linear key.
const row = [20, 20, 20, 20, 20, 20, 20, 20, 107, 107, 107, 107, 107, 107, 107, 107];
const linear = [0, 1, 2, 3].flatMap((shift) => [...row.slice(shift), ...Array(shift).fill(0)]);

for (const stem of process.argv.slice(2)) {
  const meant = JSON.parse(fs.readFileSync(`${stem}.json`, 'utf8'));
  const bytes = fs.readFileSync(`${stem}.vmd`);
  const read = new Parser().parseVmd(new Uint8Array(bytes).buffer);
  const name = (text) => text.replace(/\0.*$/s, '');
  assert.strictEqual(name(read.metadata.name), meant.model, stem);
  assert.strictEqual(read.metadata.motionCount, meant.keys.length, stem);
  assert.strictEqual(read.metadata.morphCount, 0, stem);
  assert.strictEqual(read.metadata.cameraCount, 0, stem);
  read.motions.forEach((motion, at) => {
    const key = meant.keys[at];
    const single = (numbers) => numbers.map(Math.fround);
    assert.deepStrictEqual(
      [name(motion.boneName), motion.frameNum, motion.position, motion.rotation],
      [key.bone, key.frame, single(key.translation), single(key.rotation)],
      `${stem}, record ${at}`
    );
    assert.deepStrictEqual(motion.interpolation, linear, `${stem}, record ${at}`);
  });
  console.log(`mmd-parser: ${stem.split('/').pop()}: ${read.motions.length} records as meant`);
}
