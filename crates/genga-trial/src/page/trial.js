// The trial: what is shown when, and what keys and buttons do.
const { plan, clips } = JSON.parse(document.getElementById("data").textContent);
const by = (id) => document.getElementById(id);
const answers = new Answers(plan);
const names = [...plan.conditions.map(({ name }) => name), plan.catch.film];

let language = answers.state.language || (navigator.language.startsWith("ja") ? "ja" : "en");
let order = orderOf(plan, answers.state.seed);
// The pair on screen: how often it was seen, its koma, when the question came. None while nothing can be answered.
let asked = null;
let here = "start";
let screenSaid = null;

const word = (name) => WORDS[language][name];
const now = () => answers.state.answers.length;
const blockLength = () => order.length / plan.questions.length;

// Words.

function label() {
  document.documentElement.lang = language;
  document.title = word("title");
  for (const element of document.querySelectorAll("[data-word]")) element.textContent = word(element.dataset.word);
  by("language").textContent = word("language");
  by("language").lang = language === "en" ? "ja" : "en";
  const film = plan.clips.reduce((sum, clip) => sum + clip.koma, 0) / plan.clips.length / plan.koma_rate;
  const minutes = Math.max(1, Math.round((order.length * (2 * film + 4)) / 60));
  by("intro").replaceChildren(...word("intro")(order.length, minutes).map((text) => {
    const line = document.createElement("li");
    line.textContent = text;
    return line;
  }));
  by("resume-text").textContent = word("resume_text")(now(), order.length);
  by("screen-text").textContent = screenSaid ? word("screen_bad")(screenSaid.hz, plan.koma_rate) : word("measuring");
  by("unkept").hidden = answers.isKept;
  by("stage").setAttribute("aria-label", word("stage"));
  const pair = order[now()];
  const isAsking = here === "block" || here === "pair";
  by("progress").textContent = isAsking ? word("pair_of")(now() + 1, order.length) : "";
  if (!pair) return;
  const question = plan.questions[pair.question][language];
  by("block-number").textContent = word("block_of")(Math.floor(now() / blockLength()) + 1, plan.questions.length);
  by("block-question").textContent = question;
  by("question").textContent = question;
}

function go(section) {
  here = section;
  for (const one of document.querySelectorAll("section")) one.hidden = one.id !== section;
  label();
  (by(section).querySelector("button.main") ?? by(section).querySelector("[tabindex]")).focus();
}

// The stage. Films of a motion share it, so that nothing moves but the figure.

function stageOf(clip) {
  const reel = clips[clip];
  const stage = new Stage(reel, reel.poses, reel.view);
  stage.goAlong(stage.isFar());
  return stage;
}

function show(stage, pose) {
  const style = getComputedStyle(document.documentElement);
  const [ink, left, right, paper, between, edge] =
    ["ink", "left", "right", "paper", "between", "edge"].map((name) => style.getPropertyValue(`--${name}`).trim());
  const [ctx, width, height] = prepared(by("stage"));
  stage.fit(width, height);
  if (pose === null) return;
  stage.drawFloor(ctx, width, pose, edge);
  stage.draw(ctx, pose, [ink, left, right, paper, between]);
}

function enable(isOn) {
  for (const id of ["first", "second", "again"]) by(id).disabled = !isOn;
}

// Both films of the pair that is due, then the question.
async function showPair() {
  const before = asked ?? { shown: 0, koma: 0, dropped: 0 };
  asked = null;
  enable(false);
  by("question").focus();
  const pair = order[now()];
  const [stage, reel] = [stageOf(pair.clip), clips[pair.clip]];
  let [koma, dropped] = [before.koma, before.dropped];
  for (const [film, name] of [[pair.first, "film_1"], [pair.second, "film_2"]]) {
    by("which").textContent = word(name);
    by("which").dataset.word = name;
    show(stage, null);
    await rest(700);
    const shown = reel.films[film];
    dropped += await play(shown, plan.koma_rate, (pose) => show(stage, reel.poses[pose]));
    koma += shown.length;
    await rest(400);
  }
  show(stage, null);
  by("which").textContent = "";
  delete by("which").dataset.word;
  asked = { shown: before.shown + 1, koma, dropped, since: performance.now() };
  enable(true);
}

// Doing.

async function check() {
  screenSaid = null;
  by("screen-buttons").hidden = true;
  go("screen");
  answers.state.screen = await measure(plan.koma_rate, (share) => {
    document.querySelector(".sweep i").style.width = `${100 * share}%`;
  });
  if (isGood(answers.state.screen, plan)) return due();
  screenSaid = answers.state.screen;
  by("screen-buttons").hidden = false;
  go("screen");
}

// What comes next: a question before its first pair, a pair, or the end.
function due() {
  answers.keep();
  if (now() >= order.length) return go("end");
  if (now() % blockLength() === 0 && here !== "block") return go("block");
  go("pair");
  showPair();
}

function choose(chosen) {
  if (here !== "pair" || !asked) return;
  const { question, clip, first, second } = order[now()];
  const seconds = Math.round((performance.now() - asked.since) / 10) / 100;
  const { shown, koma, dropped } = asked;
  asked = null;
  answers.add({
    number: now() + 1, question: plan.questions[question].id, clip: plan.clips[clip].name,
    first: names[first], second: names[second], chosen, replays: shown - 1, seconds, koma, dropped,
    ...answers.state.screen,
  });
  due();
}

function begin() {
  [answers.state.language, answers.state.eye] = [language, by("eye").value];
  check();
}

function anew() {
  answers.forget();
  order = orderOf(plan, answers.state.seed);
  by("saved").hidden = true;
  go("start");
}

function save() {
  answers.save(order.length);
  by("saved").hidden = false;
}

function speak() {
  language = language === "en" ? "ja" : "en";
  // What stands in the file is the language in which the person answered last.
  if (here !== "start") answers.state.language = language;
  label();
}

const sure = () => by("sure").showModal();
const DO = {
  begin, measure: check, anyway: due, ready: due, first: () => choose("first"), second: () => choose("second"),
  again: () => { if (asked) showPair(); }, save, "save-part": save, "go-on": check, forget: sure, another: sure, language: speak,
};
for (const [id, act] of Object.entries(DO)) by(id).addEventListener("click", act);
by("sure").addEventListener("close", () => { if (by("sure").returnValue === "yes") anew(); });

const KEYS = { 1: "first", 2: "second", ArrowLeft: "first", ArrowRight: "second", r: "again", R: "again" };
addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey || event.repeat || here !== "pair") return;
  const id = KEYS[event.key];
  if (!id || by(id).disabled) return;
  event.preventDefault();
  DO[id]();
});

new ResizeObserver(() => { if (here === "pair" && asked) show(stageOf(order[now()].clip), null); }).observe(by("stage"));
answers.keep();
go(answers.state.answers.length === 0 ? "start" : now() < order.length ? "resume" : "end");
