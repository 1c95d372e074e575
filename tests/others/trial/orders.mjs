// Orders of many seeds: what each person sees is whole, and balanced within a person and over all of them.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import vm from "node:vm";

const [page, script] = process.argv.slice(2);
const text = readFileSync(page, "utf8");
const { plan } = JSON.parse(text.match(/<script type="application\/json" id="data">(.*?)<\/script>/s)[1]);
const code = readFileSync(script, "utf8");
assert.ok(text.includes(code), "the page has the script that is tried here");
const orderOf = vm.runInThisContext(`${code};orderOf`);

const films = plan.conditions.length;
const round = (films * (films - 1)) / 2;
const seeds = 2000;

function check(plan) {
  const firsts = Array(films).fill(0);
  const shown = Array(films).fill(0);
  const clips = Array(plan.clips.length).fill(0);
  let [stillFirst, stills, animeFirst] = [0, 0, 0];
  for (let seed = 0; seed < seeds; seed++) {
    const order = orderOf(plan, seed);
    assert.deepEqual(orderOf(plan, seed), order, "the same seed, the same order");
    const length = plan.pairs + plan.catch.per_question;
    assert.equal(order.length, 2 * length);
    const blocks = [order.slice(0, length), order.slice(length)];
    animeFirst += blocks[0][0].question === 0;
    const own = blocks.map((block) => block.filter(({ first, second }) => first < films && second < films));
    for (const [at, block] of blocks.entries()) {
      assert.ok(block.every(({ question }) => question === block[0].question), "one question after the other");
      assert.notEqual(blocks[1 - at][0].question, block[0].question);
      assert.equal(own[at].length, plan.pairs);
      assert.ok(Math.max(block[0].first, block[0].second) < films, "no catch pair at the beginning");
      for (const { first, second } of block.filter((pair) => !own[at].includes(pair))) {
        assert.notEqual(first, second);
        stills += 1;
        stillFirst += first === films;
      }
    }
    const key = ({ clip, first, second }) => [clip, first, second].join();
    const back = ({ clip, first, second }) => [clip, second, first].join();
    assert.deepEqual(own[0].map(key).sort(), own[1].map(back).sort(), "the second question turns every pair round");
    const pairs = new Map();
    const balance = Array(films).fill(0);
    for (const { clip, first, second } of own[0]) {
      const pair = [first, second].sort().join();
      pairs.set(pair, (pairs.get(pair) ?? 0) + 1);
      [balance[first], balance[second]] = [balance[first] + 1, balance[second] - 1];
      firsts[first] += 1;
      shown[first] += 1;
      shown[second] += 1;
      clips[clip] += 1;
    }
    const counts = [...pairs.values()];
    const rounds = plan.pairs / round;
    assert.ok(Math.min(...counts, pairs.size < round ? 0 : Infinity) >= Math.floor(rounds) && Math.max(...counts) <= Math.ceil(rounds), "each pair as often");
    if (plan.pairs % (2 * round) === 0) {
      assert.ok(balance.every((film) => film === 0), "in two rounds first as often as second");
      const ways = own[0].map(({ first, second }) => `${first},${second}`).sort();
      const others = own[0].map(({ first, second }) => `${second},${first}`).sort();
      assert.deepEqual(ways, others, "in two rounds every pair both ways round");
    }
    if (plan.pairs === 2 * round) {
      const seen = new Set(own[0].map(({ clip, first, second }) => [clip, ...[first, second].sort()].join()));
      assert.equal(seen.size, plan.pairs, "each pair on another motion than before");
    }
    if (plan.pairs === round) assert.ok(balance.every((film) => Math.abs(film) <= 1), `${balance} in one round`);
  }
  assert.equal(animeFirst, seeds / 2, "each question is the first of half of the seeds");
  // Five standard deviations of a fair coin.
  const isFair = (count, of) => Math.abs(count - of / 2) < 2.5 * Math.sqrt(of);
  assert.ok(isFair(stillFirst, stills), `${stillFirst} of ${stills} still films came first`);
  firsts.forEach((count, film) => assert.ok(isFair(count, shown[film]), `film ${film} came first ${count} of ${shown[film]}`));
  const even = clips.reduce((a, b) => a + b) / clips.length;
  clips.forEach((count) => assert.ok(Math.abs(count - even) < 0.1 * even, `motions came ${clips} times`));
}

for (const pairs of [plan.pairs, 1, round, 2 * round, 2 * round + 3]) check({ ...plan, pairs });
console.log(`orders: ${seeds} seeds of ${films} films, balanced`);
