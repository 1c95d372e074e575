// Goes through whole trials in Chromium, by the keyboard, and keeps what they save.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [made, saved] = process.argv.slice(2);
mkdirSync(saved, { recursive: true });
const text = readFileSync(`${made}/index.html`, "utf8");
const { plan } = JSON.parse(text.match(/<script type="application\/json" id="data">(.*?)<\/script>/s)[1]);
assert.deepEqual(JSON.parse(readFileSync(`${made}/trial.json`, "utf8")), plan, "the plan beside the page is the page's own");
assert.ok(!/https?:\/\//.test(text), "the page names no address");

// Nothing of this may ever be seen or read out.
const secret = new RegExp([...plan.conditions.map(({ name }) => name), plan.catch.film, ...plan.clips.map(({ name }) => name)].join("|"), "i");
const all = 2 * (plan.pairs + plan.catch.per_question);

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu"],
});

// What one person sees. The clock is the test's: the films run as fast as they can be drawn.
class Visit {
  static async open({ seed, locale, init, clock = true }) {
    const visit = new Visit();
    visit.context = await browser.newContext({ viewport: { width: 1200, height: 860 }, locale, acceptDownloads: true });
    visit.page = await visit.context.newPage();
    [visit.said, visit.asked] = [[], []];
    visit.page.on("console", (message) => visit.said.push(`${message.type()}: ${message.text()}`));
    visit.page.on("pageerror", (error) => visit.said.push(`error: ${error.message}`));
    visit.page.on("request", (request) => visit.asked.push(request.url()));
    if (clock) {
      await visit.page.clock.install({ time: 0 });
      // From here on time passes only when it is told to.
      await visit.page.clock.pauseAt(1000);
    }
    if (init) await visit.page.addInitScript(init);
    await visit.page.goto(`${pathToFileURL(made).href}/index.html?seed=${seed}`);
    return visit;
  }

  press(key) {
    return this.page.keyboard.press(key);
  }

  shot(name) {
    return this.page.screenshot({ path: `${saved}/../${name}.png` });
  }

  async at(section) {
    assert.equal(await this.page.$eval("section:not([hidden])", (one) => one.id), section);
    await this.isBlind();
  }

  // What is seen, and what is read to people who do not see it.
  async isBlind() {
    const seen = await this.page.evaluate(() => {
      const of = (name) => [...document.querySelectorAll(`[${name}]`)].map((one) => one.getAttribute(name));
      return [document.title, document.body.innerText, ...["aria-label", "title", "alt", "placeholder"].flatMap(of)].join("\n");
    });
    assert.ok(!secret.test(seen), `the page says ${secret.exec(seen)}`);
  }

  async until(isThere, what) {
    for (let step = 0; step < 400; step++) {
      if (await this.page.evaluate(isThere)) return;
      await this.page.clock.runFor(250);
    }
    assert.fail(`${what} never comes`);
  }

  // From the beginning to the first question.
  async begin() {
    await this.at("start");
    await this.press("Enter");
    await this.until(() => !document.getElementById("block").hidden, "the first question");
    await this.at("block");
  }

  async asked_pair() {
    await this.until(() => !document.getElementById("first").disabled, "the question");
  }

  state() {
    return this.page.evaluate(() => ({ ...answers.state, order, names }));
  }

  async save() {
    const coming = this.page.waitForEvent("download");
    await this.press("Enter");
    const file = await coming;
    const path = `${saved}/${file.suggestedFilename()}`;
    await file.saveAs(path);
    return readFileSync(path, "utf8");
  }

  async close() {
    assert.deepEqual(this.asked.filter((address) => !/^(file|blob):/.test(address)), [], "no request leaves the machine");
    assert.deepEqual(this.said, [], "nothing is said on the console");
    await this.context.close();
  }
}

// How somebody chooses: the number of the film, by the worth of its condition.
const WORTH = ["genga", "tanaka", "source", "uniform", "suzuki", "twos", "threes"];
const worth = (name) => (name === plan.catch.film ? WORTH.length : WORTH.indexOf(name));
const careful = ([first, second]) => (worth(first) <= worth(second) ? 1 : 2);
const careless = ([first, second]) => (worth(first) >= worth(second) ? 1 : 2);

async function answerAll(visit, choose, each = async () => {}) {
  const { order, names } = await visit.state();
  for (let at = (await visit.state()).answers.length; at < order.length; at++) {
    if (await visit.page.isVisible("#block")) await visit.press("Enter");
    await each(at, order[at], names);
    await visit.asked_pair();
    await visit.press(String(choose([names[order[at].first], names[order[at].second]])));
  }
}

// Somebody who looks, in English: tries to answer too early, sees a pair again, goes away and comes back.
{
  const visit = await Visit.open({ seed: 2, locale: "en-GB" });
  await visit.shot("start");
  for (const control of await visit.page.$$("button, select, canvas[role=img]")) {
    const name = await control.evaluate((node) => node.getAttribute("aria-label") || node.labels?.[0]?.textContent || node.textContent);
    assert.ok(name?.trim(), `a control without a name: ${await control.evaluate((node) => node.outerHTML)}`);
  }
  await visit.page.selectOption("#eye", "draws");
  await visit.page.focus("#begin");
  await visit.begin();
  await visit.shot("block");
  const picture = () => visit.page.$eval("#stage", (canvas) => canvas.toDataURL());
  await answerAll(visit, careful, async (at, pair, names) => {
    if (at > 8) return;
    // The first film: it moves, but for the one that stands still.
    await visit.page.clock.runFor(900);
    await visit.press("1");
    assert.equal((await visit.state()).answers.length, at, "nothing is answered while a film runs");
    await visit.isBlind();
    const seen = new Set();
    for (let look = 0; look < 5; look++) {
      seen.add(await picture());
      if (at === 0 && look === 2) await visit.shot("film");
      await visit.page.clock.runFor(330);
    }
    const isStill = names[pair.first] === plan.catch.film;
    assert.equal(seen.size === 1, isStill, `${names[pair.first]} shows ${seen.size} pictures`);
    await visit.asked_pair();
    if (at === 0) {
      await visit.shot("question");
      await visit.press("r");
    }
    if (at === 5) {
      await visit.page.reload();
      await visit.at("resume");
      await visit.shot("resume");
      await visit.press("Enter");
      await visit.until(() => !document.getElementById("pair").hidden, "the pair that was due");
    }
  });
  await visit.at("end");
  const csv = await visit.save();
  await visit.shot("end");
  const [header, ...rows] = csv.trim().split("\n").map((line) => line.split(","));
  assert.deepEqual(header, plan.columns);
  assert.equal(rows.length, all);
  const { order, names } = await visit.state();
  rows.forEach((row, at) => {
    const of = Object.fromEntries(header.map((name, field) => [name, row[field]]));
    const { question, clip, first, second } = order[at];
    const meant = [plan.schema, plan.trial, "2", "draws", String(at + 1), plan.questions[question].id, plan.clips[clip].name, names[first], names[second]];
    const columns = ["schema", "trial", "seed", "eye", "number", "question", "clip", "first", "second"];
    assert.deepEqual(columns.map((name) => of[name]), meant);
    assert.equal(of.chosen, careful([names[first], names[second]]) === 1 ? "first" : "second");
    assert.equal(of.replays, at === 0 ? "1" : "0");
    assert.equal(Number(of.koma), 2 * plan.clips[clip].koma * (at === 0 ? 2 : 1));
    assert.equal(of.dropped, "0", `pair ${at + 1}`);
    assert.ok(Number(of.hz) >= plan.screen.least_hz, of.hz);
  });
  // Another person begins with nothing.
  await visit.press("Tab");
  await visit.press("Enter");
  assert.ok(await visit.page.isVisible("#sure"));
  await visit.press("Tab");
  await visit.press("Enter");
  // A dialog tells of its end a moment later.
  await visit.page.waitForSelector("#start:not([hidden])");
  await visit.at("start");
  const next = await visit.state();
  assert.deepEqual(next.answers, []);
  assert.ok(!csv.includes(next.person), "it is another person");
  await visit.close();
}

// Somebody who looks, in Japanese, on a machine that stumbles for a moment: koma are dropped, and counted.
{
  const visit = await Visit.open({ seed: 3, locale: "ja-JP" });
  assert.equal(await visit.page.getAttribute("html", "lang"), "ja");
  await visit.shot("start-ja");
  await visit.begin();
  await visit.shot("block-ja");
  let stumbled = 0;
  await answerAll(visit, careful, async (at) => {
    if (at === 1) await visit.shot("film-ja");
    if (at !== 4) return;
    await visit.page.clock.runFor(1500);
    await visit.page.clock.fastForward(500);
    await visit.asked_pair();
    await visit.shot("question-ja");
    stumbled = at;
  });
  await visit.at("end");
  await visit.shot("end-ja");
  const dropped = (await visit.state()).answers.map((answer) => answer.dropped);
  assert.ok(dropped[stumbled] >= 10 && dropped[stumbled] <= 13, `${dropped[stumbled]} koma of half a second were dropped`);
  assert.ok(dropped.every((count, at) => at === stumbled || count === 0), `${dropped}`);
  await visit.save();
  await visit.close();
}

// Somebody who does not look, on a narrow screen.
{
  const visit = await Visit.open({ seed: 4, locale: "en-GB" });
  await visit.page.setViewportSize({ width: 420, height: 780 });
  await visit.shot("start-narrow");
  await visit.begin();
  await answerAll(visit, careless, async (at) => {
    if (at !== 1) return;
    await visit.asked_pair();
    await visit.shot("question-narrow");
  });
  await visit.save();
  await visit.close();
}

// A screen of 12 pictures a second is told so, and may go on.
{
  const slow = () => {
    const own = window.setTimeout.bind(window);
    window.requestAnimationFrame = (act) => own(() => act(performance.now()), 83);
  };
  const visit = await Visit.open({ seed: 5, locale: "ja-JP", init: slow });
  await visit.at("start");
  await visit.press("Enter");
  await visit.until(() => !document.getElementById("screen-buttons").hidden, "the measure");
  await visit.at("screen");
  await visit.shot("screen-ja");
  await visit.page.click("#language");
  await visit.shot("screen");
  await visit.page.focus("#anyway");
  await visit.press("Enter");
  await visit.at("block");
  await answerAll(visit, careful);
  await visit.save();
  await visit.close();
}

// By the clock of the room: a pair lasts as long as its films and the rests between them.
{
  const visit = await Visit.open({ seed: 6, locale: "en-GB", clock: false });
  await visit.press("Enter");
  await visit.page.waitForSelector("#block:visible, #screen-buttons:visible", { timeout: 20000 });
  if (await visit.page.isVisible("#screen-buttons")) await visit.page.click("#anyway");
  const { order } = await visit.state();
  const began = Date.now();
  await visit.press("Enter");
  await visit.page.waitForSelector("#first:enabled", { timeout: 60000 });
  const lasted = (Date.now() - began) / 1000;
  const meant = 2 * (plan.clips[order[0].clip].koma / plan.koma_rate + 1.1);
  assert.ok(lasted > meant - 0.1 && lasted < meant + 3, `a pair of ${meant} s lasted ${lasted} s`);
  await visit.close();
}

await browser.close();
console.log(`trial: ${all} pairs by the keyboard, four persons saved`);
