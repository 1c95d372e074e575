// The player: what is shown, and what keys, buttons and the mouse do to it.
const take = JSON.parse(document.getElementById("take").textContent);
const by = (id) => document.getElementById(id);
const views = new Map(take.views);
const last = take.koma - 1;

// For each koma its cell, and the cell of the key that stands before it.
const cellOf = [];
take.cells.forEach(([, , held], cell) => { for (let at = 0; at < held; at++) cellOf.push(cell); });
const isKey = (cell) => take.drawings[take.cells[cell][0]].role !== "inbetween";
const keyOf = [];
take.cells.forEach((_, cell) => keyOf.push(isKey(cell) || cell === 0 ? cell : keyOf[cell - 1]));

const state = {
  koma: 0, playing: false, loop: true, onion: false, keys: false, speed: 1,
  shown: "both", camera: take.camera, angle: 0,
  dark: matchMedia("(prefers-color-scheme: dark)").matches,
  language: navigator.language.startsWith("ja") ? "ja" : "en",
};
const poses = take.source.concat(take.drawings.map((drawing) => drawing.pose));
const stage = new Stage(take, poses, views.get(state.camera));
stage.goAlong(stage.isFar());
let colors = {};
let started = { time: 0, koma: 0 };

const word = (name) => WORDS[state.language][name];
const drawingOf = (koma) => take.cells[state.keys ? keyOf[cellOf[koma]] : cellOf[koma]][0];

function readColors() {
  document.documentElement.dataset.theme = state.dark ? "dark" : "light";
  const style = getComputedStyle(document.documentElement);
  const names = ["paper", "ink", "faint", "edge", "left", "right", "genga", "between", "end", "here", "old", "young"];
  colors = Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}

// Drawing.

function drawStage(id, pose, skins) {
  const canvas = document.querySelector(`#${id} canvas`);
  if (by(id).hidden) return;
  const [ctx, width, height] = prepared(canvas);
  stage.fit(width, height);
  stage.drawFloor(ctx, width, pose, colors.edge);
  // The skins stand where they are in the world, seen from where the figure is.
  const middle = stage.middle(pose);
  for (const [skin, color] of skins) stage.draw(ctx, skin, [color, color, color, colors.paper, color], middle);
  stage.draw(ctx, pose, [colors.ink, colors.left, colors.right, colors.paper, colors.between]);
}

function sourceSkins() {
  const near = [[-2, "old"], [2, "young"], [-1, "old"], [1, "young"]];
  const skins = near.map(([step, color]) => [take.source[state.koma + step], colors[color]]);
  return skins.filter(([pose]) => pose);
}

function resultSkins() {
  const cell = cellOf[state.koma];
  const neighbour = (from, step) => {
    do from += step; while (state.keys && from >= 0 && from < take.cells.length && !isKey(from));
    return take.cells[from];
  };
  const from = state.keys ? keyOf[cell] : cell;
  const skins = [[neighbour(from, -1), "old"], [neighbour(from, 1), "young"]];
  return skins.filter(([cell]) => cell).map(([cell, color]) => [take.drawings[cell[0]].pose, colors[color]]);
}

function draw() {
  const drawing = drawingOf(state.koma);
  drawStage("source", take.source[state.koma], state.onion ? sourceSkins() : []);
  const slides = take.sliding && !state.keys;
  drawStage("result", slides ? take.sliding[state.koma] : take.drawings[drawing].pose, state.onion ? resultSkins() : []);
  drawBars(by("bars"), take, state.koma, colors);
  drawColumn(by("column"), take, cellOf, state.koma, colors);
  say(drawing);
}

function say(index) {
  const drawing = take.drawings[index];
  const [, begin, held] = take.cells[cellOf[state.koma]];
  const second = Math.round(take.koma_rate);
  const role = drawing.genga ? `${word(drawing.role)} ${drawing.genga}` : word(drawing.role);
  by("drawing").textContent = `${take.column}${drawing.number ?? index + 1}`;
  by("role").textContent = role;
  document.querySelector("aside").className = drawing.role;
  by("koma").textContent = `${state.koma + 1} / ${take.koma}`;
  by("time").textContent = `${Math.floor(state.koma / second)}+${state.koma % second}`;
  by("held").textContent = `${state.koma - begin + 1} / ${held}`;
  by("frame").textContent = drawing.frame;
  const omitted = drawing.omitted ? word("omitted")(drawing.omitted) : "";
  by("why").textContent = state.language === "en" ? drawing.why : omitted;
  by("scrub").value = state.koma + 1;
  const text = `${word("koma")} ${state.koma + 1}, ${word("drawing")} ${drawing.number ?? index + 1}, ${role}`;
  by("scrub").setAttribute("aria-valuetext", text);
  // While it plays nobody could follow.
  if (!state.playing) by("status").textContent = text;
}

function label() {
  document.documentElement.lang = state.language;
  for (const element of document.querySelectorAll("[data-word]")) element.textContent = word(element.dataset.word);
  for (const button of document.querySelectorAll("[data-do]")) {
    const name = button.dataset.do;
    const title = name === "play" && state.playing ? word("stop") : word(name);
    button.title = title;
    button.setAttribute("aria-label", title);
    if (name in state && name !== "play") button.setAttribute("aria-pressed", state[name]);
    if (name === "follow") button.setAttribute("aria-pressed", stage.follow);
    if (name === "play") button.textContent = state.playing ? "❚❚" : "▶";
  }
  by("language").textContent = word("language");
  const shown = [...new Set(take.cells.map(([drawing]) => take.drawings[drawing]))];
  by("facts").textContent = word("facts")(take, shown.filter((drawing) => drawing.genga).length, shown.length);
  by("scrub").setAttribute("aria-label", word("scrub"));
  by("column").setAttribute("aria-label", word("column"));
  for (const id of ["source", "result"]) {
    document.querySelector(`#${id} canvas`).setAttribute("aria-label", `${word(id)}: ${word("stage")}`);
    by(id).hidden = state.shown !== "both" && state.shown !== id;
  }
  const cameras = [...views.keys()].concat(state.angle ? ["turned"] : []);
  by("camera").replaceChildren(...cameras.map((name) => new Option(word(name), name)));
  by("camera").value = state.angle ? "turned" : state.camera;
  by("shown").value = state.shown;
  by("speed").value = state.speed;
  const row = ([key, what]) => {
    const line = document.createElement("tr");
    const cap = document.createElement("kbd");
    cap.textContent = key;
    line.insertCell().append(cap);
    line.insertCell().textContent = what;
    return line;
  };
  by("key-table").replaceChildren(...word("key_help").map(row));
}

// Doing.

function goTo(koma) {
  state.koma = Math.max(0, Math.min(last, koma));
  started = { time: performance.now(), koma: state.koma };
  draw();
}

function stepDrawing(step, wanted = () => true) {
  let cell = cellOf[state.koma] + step;
  while (cell >= 0 && cell < take.cells.length && !wanted(cell)) cell += step;
  if (cell >= 0 && cell < take.cells.length) goTo(take.cells[cell][1]);
}

function play(playing) {
  if (playing && state.koma === last && !state.loop) state.koma = 0;
  state.playing = playing;
  started = { time: performance.now(), koma: state.koma };
  refresh();
  if (playing) requestAnimationFrame(tick);
}

// The koma follows the clock, so that a slow machine leaves koma out and keeps the time.
function tick(now) {
  if (!state.playing) return;
  const passed = Math.floor(Math.max(0, now - started.time) / 1000 * take.koma_rate * state.speed);
  let koma = started.koma + passed;
  if (koma > last && !state.loop) {
    state.koma = last;
    play(false);
    return;
  }
  koma %= take.koma;
  if (koma !== state.koma) {
    state.koma = koma;
    draw();
  }
  requestAnimationFrame(tick);
}

function look(camera, angle = 0) {
  [state.camera, state.angle] = [camera, angle];
  stage.look(views.get(camera), angle);
  refresh();
}

function faster(step) {
  const speeds = optionsOf("speed");
  const at = speeds.indexOf(String(state.speed)) + step;
  if (speeds[at]) state.speed = Number(speeds[at]);
  started = { time: performance.now(), koma: state.koma };
}

const optionsOf = (id) => [...by(id).options].map((option) => option.value);
const next = (list, value) => list[(list.indexOf(value) + 1) % list.length];
const toggle = (name) => { state[name] = !state[name]; };

const actions = {
  play: () => play(!state.playing),
  "koma-back": () => goTo(state.koma - 1),
  "koma-on": () => goTo(state.koma + 1),
  "drawing-back": () => stepDrawing(-1),
  "drawing-on": () => stepDrawing(1),
  "genga-back": () => stepDrawing(-1, isKey),
  "genga-on": () => stepDrawing(1, isKey),
  first: () => goTo(0),
  last: () => goTo(last),
  loop: () => toggle("loop"),
  onion: () => toggle("onion"),
  keys: () => toggle("keys"),
  follow: () => stage.goAlong(!stage.follow),
  shown: () => { state.shown = next(optionsOf("shown"), state.shown); },
  slower: () => faster(-1),
  faster: () => faster(1),
  theme: () => toggle("dark"),
  language: () => { state.language = next(["en", "ja"], state.language); },
  help: () => by("keys").showModal(),
  front: () => look("front"),
  side: () => look("side"),
  "three-quarter": () => look("three-quarter"),
  auto: () => look("auto"),
};

const KEYS = {
  " ": "play", ArrowLeft: "koma-back", ArrowRight: "koma-on", ArrowUp: "drawing-back", ArrowDown: "drawing-on",
  "shift ArrowLeft": "genga-back", "shift ArrowRight": "genga-on", Home: "first", End: "last",
  s: "shown", o: "onion", k: "keys", f: "follow", l: "loop", t: "theme", j: "language", "?": "help",
  "-": "slower", "+": "faster", "=": "faster", 1: "front", 2: "side", 3: "three-quarter", 4: "auto",
};

function perform(name) {
  actions[name]();
  refresh();
}

function refresh() {
  readColors();
  label();
  draw();
}

// Being asked.

addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey || by("keys").open) return;
  // A list keeps its own keys, a button its own space bar.
  if (event.target instanceof HTMLSelectElement) return;
  if (event.key === " " && event.target instanceof HTMLButtonElement) return;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const name = KEYS[event.shiftKey && key.startsWith("Arrow") ? `shift ${key}` : key];
  if (!name) return;
  event.preventDefault();
  perform(name);
});

for (const button of document.querySelectorAll("[data-do]")) {
  button.addEventListener("click", () => perform(button.dataset.do));
}
for (const id of ["theme", "language", "help"]) by(id).addEventListener("click", () => perform(id));
by("scrub").max = take.koma;
by("scrub").addEventListener("input", () => goTo(Number(by("scrub").value) - 1));
by("shown").addEventListener("change", () => { state.shown = by("shown").value; refresh(); });
by("speed").addEventListener("change", () => { state.speed = Number(by("speed").value); started = { time: performance.now(), koma: state.koma }; });
by("camera").addEventListener("change", () => { if (views.has(by("camera").value)) look(by("camera").value); });
by("column").addEventListener("click", (event) => {
  const box = by("column").getBoundingClientRect();
  goTo(firstRow(state.koma, take, box.height / ROW) + Math.floor((event.clientY - box.top) / ROW));
});
by("bars").addEventListener("click", (event) => {
  const box = by("bars").getBoundingClientRect();
  goTo(Math.floor(((event.clientX - box.left) / box.width) * take.koma));
});
for (const canvas of document.querySelectorAll("figure canvas")) {
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    if (event.buttons) look(state.camera, state.angle + event.movementX * 0.01);
  });
}
new ResizeObserver(draw).observe(by("stages"));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (event) => { state.dark = event.matches; refresh(); });
refresh();
