// Which pairs a person sees, in which order and which film first: all by the seed.
class Lots {
  constructor(seed) {
    this.state = seed >>> 0;
  }

  below(end) {
    this.state = (this.state + 0x9e3779b9) >>> 0;
    let lot = this.state;
    lot = Math.imul(lot ^ (lot >>> 16), 0x85ebca6b);
    lot = Math.imul(lot ^ (lot >>> 13), 0xc2b2ae35);
    return Math.floor((((lot ^ (lot >>> 16)) >>> 0) / 0x100000000) * end);
  }

  shuffled(list) {
    const shuffled = list.slice();
    for (let end = shuffled.length - 1; end > 0; end--) {
      const at = this.below(end + 1);
      [shuffled[at], shuffled[end]] = [shuffled[end], shuffled[at]];
    }
    return shuffled;
  }
}

const turned = ({ clip, first, second }) => ({ clip, first: second, second: first });

// Every pair of films once, in a round of which each film comes first as often as second, or once more.
function roundOf(films) {
  const pairs = [];
  for (let a = 0; a < films.length; a++) {
    for (let b = a + 1; b < films.length; b++) {
      const way = 2 * (b - a) - films.length;
      const keeps = way < 0 || (way === 0 && a % 2 === 0);
      pairs.push(keeps ? [films[a], films[b]] : [films[b], films[a]]);
    }
  }
  return pairs;
}

// So many pairs: rounds of all pairs, every other one the other way round, each pair on another motion than before.
function pairsOf(plan, films, lots) {
  const chosen = [];
  const clips = lots.shuffled(plan.clips.map((_, clip) => clip));
  const way = lots.below(2);
  for (let round = 0; chosen.length < plan.pairs; round++) {
    const pairs = roundOf(films).map(([first, second], at) => {
      const pair = { clip: clips[(at + round) % clips.length], first, second };
      return (round + way) % 2 ? turned(pair) : pair;
    });
    chosen.push(...lots.shuffled(pairs).slice(0, plan.pairs - chosen.length));
  }
  return chosen;
}

// Puts catch pairs among the pairs of a question, one in each part of it and none at its beginning.
function withCatches(plan, pairs, films, block, lots) {
  const still = plan.conditions.length;
  const count = plan.catch.per_question;
  const all = [];
  const way = lots.below(2);
  for (let part = 0; part < count; part++) {
    const [from, to] = [part, part + 1].map((edge) => Math.ceil((edge * pairs.length) / count));
    const own = pairs.slice(from, to);
    const other = films[(block * count + part) % films.length];
    const pair = { clip: lots.below(plan.clips.length), first: still, second: other };
    const at = Math.min(own.length, 1 + lots.below(Math.max(own.length, 1)));
    own.splice(at, 0, (part + block + way) % 2 ? turned(pair) : pair);
    all.push(...own);
  }
  return all;
}

// Everything a person sees, one after the other. Films are numbers: those of the conditions, then the one that stands still.
function orderOf(plan, seed) {
  const lots = new Lots(seed);
  const films = lots.shuffled(plan.conditions.map((_, film) => film));
  const pairs = pairsOf(plan, films, lots);
  const questions = plan.questions.map((_, question) => question);
  if (seed % 2) questions.reverse();
  return questions.flatMap((question, block) => {
    const own = lots.shuffled(block % 2 ? pairs.map(turned) : pairs);
    return withCatches(plan, own, films, block, lots).map((pair) => ({ question, ...pair }));
  });
}

