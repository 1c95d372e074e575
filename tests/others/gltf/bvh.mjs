// A BVH as Blender and assimp read it, as far as genga writes it: where every joint stands in a row.

import { Euler, Quaternion, Vector3 } from 'three';

export function readBvh(text) {
  const lines = text.split('\n').map((line) => line.trim());
  const joints = [];
  const open = [];
  let columns = 0;
  let tip = false;
  let at = 0;
  for (; lines[at] !== 'MOTION'; at += 1) {
    const [word, ...rest] = lines[at].split(/\s+/);
    if (word === 'ROOT' || word === 'JOINT') {
      joints.push({ name: lines[at].slice(word.length + 1), parent: open.at(-1), channels: [] });
    } else if (word === 'End') {
      tip = true;
    } else if (word === '{') {
      open.push(tip ? undefined : joints.length - 1);
    } else if (word === '}') {
      open.pop();
      tip = false;
    } else if (word === 'OFFSET' && !tip) {
      joints.at(-1).offset = new Vector3(...rest.map(Number));
    } else if (word === 'CHANNELS' && !tip) {
      joints.at(-1).channels = rest.slice(1).map((name) => ({ name, column: columns++ }));
    }
  }
  const rows = lines.slice(at + 3).filter(Boolean).map((line) => line.split(/\s+/).map(Number));
  return { joints, rows };
}

export function positions(bvh, row) {
  return stands(bvh, row).map(({ position }) => position);
}

// Positions replace the offset, rotations multiply as listed.
export function stands({ joints }, row) {
  const placed = [];
  for (const { parent, offset, channels } of joints) {
    const position = offset.clone();
    const turn = new Quaternion();
    for (const { name, column } of channels) {
      const axis = name[0].toLowerCase();
      if (name.endsWith('position')) {
        position[axis] = row[column];
      } else {
        const angles = new Euler();
        angles[axis] = (row[column] * Math.PI) / 180;
        turn.multiply(new Quaternion().setFromEuler(angles));
      }
    }
    const carrier = placed[parent];
    if (carrier) {
      position.applyQuaternion(carrier.turn).add(carrier.position);
      turn.premultiply(carrier.turn);
    }
    placed.push({ position, turn });
  }
  return placed;
}
