// What the program makes of the four files: two persons count, the other two are left out for their reasons.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";

const [path, saved, pairs] = process.argv.slice(2);
const verdict = JSON.parse(readFileSync(path, "utf8"));
assert.equal(readdirSync(saved).filter((name) => name.endsWith(".csv")).length, 4);
assert.deepEqual([verdict.persons, verdict.counted], [4, 2]);
assert.deepEqual(verdict.eyes, { "": 1, draws: 1 });
const reasons = verdict.excluded.map(({ reason }) => Object.keys(reason)[0]).sort();
assert.deepEqual(reasons, ["caught", "screen"]);
assert.deepEqual(verdict.excluded.find(({ reason }) => reason.caught).reason.caught, { wrong: 6, of: 6 });
for (const { question, answers, scores } of verdict.questions) {
  assert.equal(answers, 2 * Number(pairs), question);
  const own = scores.map(({ condition }) => condition).filter((name) => ["tanaka", "suzuki"].includes(name));
  assert.equal(own.length, 2, `a person's own sheets are in the outcome of ${question}`);
  assert.equal(scores[0].condition, "genga", question);
  assert.equal(scores[0].taken, scores[0].shown, "both always took it");
}
console.log("verdict: two of four persons count, and are understood");
