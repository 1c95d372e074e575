// The player: what is shown, and what keys, buttons and the mouse do to it.
const views = new Map(take.views);
const last = take.koma - 1;

const state = {
  koma: 0, playing: false, loop: true, onion: false, keys: false, speed: 1,
  shown: "both", camera: take.camera, angle: 0,
  dark: matchMedia("(prefers-color-scheme: dark)").matches,
  language: navigator.language.startsWith("ja") ? "ja" : "en",
};
const drawn = reels.flatMap((reel) => reel.drawings.map((drawing) => drawing.pose));
const stage = new Stage(take, (take.source ?? []).concat(drawn), views.get(state.camera));
stage.goAlong(stage.isFar());
let colors = {};
let started = { time: 0, koma: 0 };

const word = (name) => WORDS[state.language][name];

function readColors() {
  document.documentElement.dataset.theme = state.dark ? "dark" : "light";
  const style = getComputedStyle(document.documentElement);
  const names = ["paper", "ink", "faint", "edge", "left", "right", "genga", "between", "end", "here", "old", "young"];
  colors = Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}

// Drawing.

function drawStage(panel) {
  if (panel.figure.hidden) return;
  const [ctx, width, height] = prepared(panel.canvas);
  stage.fit(width, height);
  const pose = panel.pose(state.koma, state.keys);
  if (!pose) return;
  stage.drawFloor(ctx, width, pose, colors.edge);
  // The skins stand where they are in the world, seen from where the figure is.
  const middle = stage.middle(pose);
  const skins = state.onion ? panel.skins(state.koma, state.keys) : [];
  for (const [skin, name] of skins) {
    const color = colors[name];
    stage.draw(ctx, skin, [color, color, color, colors.paper, color], middle);
  }
  stage.draw(ctx, pose, [colors.ink, colors.left, colors.right, colors.paper, colors.between]);
}

function draw() {
  panels.forEach(drawStage);
  drawBars(by("bars"), take, reels, state.koma, colors);
  drawColumns(by("column"), take, reels, state.koma, colors, [word("genga"), word("drawing")]);
  say();
}

function say() {
  const second = Math.round(take.koma_rate);
  by("koma").textContent = `${state.koma + 1} / ${take.koma}`;
  by("time").textContent = `${Math.floor(state.koma / second)}+${state.koma % second}`;
  by("scrub").value = state.koma + 1;
  const drawings = reels.map((reel, at) => sayDrawing(reel, told[at]));
  // Keys alone are other drawings than those that the sheets have here.
  const different = !state.keys && isDifferent(take, state.koma);
  by("different").hidden = !different;
  const text = [`${word("koma")} ${state.koma + 1}`, ...drawings, ...(different ? [word("different")] : [])].join(", ");
  by("scrub").setAttribute("aria-valuetext", text);
  // While it plays nobody could follow.
  if (!state.playing) by("status").textContent = text;
}

// Tells which drawing of a sheet is shown, and returns it in words.
function sayDrawing(reel, place) {
  const drawing = reel.drawing(state.koma, state.keys);
  if (!drawing) {
    place.number.className = "number";
    for (const text of ["drawing", "role", "held", "frame", "why"]) place[text].textContent = "";
    return word("blank");
  }
  const [, begin, held] = reel.cells[reel.cell(state.koma)];
  const role = drawing.genga && reel.column ? `${word(drawing.role)} ${drawing.genga}` : word(drawing.role);
  place.drawing.textContent = `${reel.column}${drawing.number}`;
  place.role.textContent = role;
  place.number.className = `number ${drawing.role} ${reel.column ? "" : "sign"}`;
  place.held.textContent = `${Math.min(state.koma - begin + 1, held)} / ${held}`;
  place.frame.textContent = drawing.frame;
  place.why.textContent = place.why.title = state.language === "en" ? drawing.why : drawing.why_japanese;
  return [reel.name, word("drawing"), drawing.number, role].filter((part) => part).join(" ");
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
  for (const id of ["theme", "help"]) {
    by(id).title = word(id);
    by(id).setAttribute("aria-label", word(id));
  }
  by("facts").textContent = facts();
  by("scrub").setAttribute("aria-label", word("scrub"));
  by("column").setAttribute("aria-label", word("column"));
  by("different").title = word("different");
  for (const { id, name = word(id), figure, caption, canvas, option } of panels) {
    caption.textContent = option.textContent = name;
    canvas.setAttribute("aria-label", `${name}: ${word("stage")}`);
    figure.hidden = state.shown !== "both" && state.shown !== id;
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

// The length, the rounds, genga and drawings of each sheet, and on how many koma two sheets differ.
function facts() {
  const of = (reel) => {
    return [reel.name, word("counts")(reel.rounds, ...reel.counts)].filter((part) => part).join(": ");
  };
  const differ = (take.differences ?? []).reduce((sum, [, koma]) => sum + koma, 0);
  const more = areTwo ? [word("differ")(differ)] : [];
  return [word("length")(take), ...reels.map(of), ...more].join(word("between"));
}

// Doing.

function goTo(koma) {
  state.koma = Math.max(0, Math.min(last, koma));
  started = { time: performance.now(), koma: state.koma };
  draw();
}

function stepDrawing(step, keys = false) {
  const begins = (only) => reels.flatMap((reel) => reel.begins(only)).sort((a, b) => a - b);
  // From within a drawing, back is to the one before it.
  const here = begins(false).findLast((begin) => begin <= state.koma) ?? state.koma;
  const there = step > 0 ? begins(keys).find((begin) => begin > state.koma) : begins(keys).findLast((begin) => begin < here);
  if (there !== undefined && there <= last) goTo(there);
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
  "genga-back": () => stepDrawing(-1, true),
  "genga-on": () => stepDrawing(1, true),
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
  goTo(komaAt(event.clientY - box.top, state.koma, take, box.height));
});
by("bars").addEventListener("click", (event) => {
  const box = by("bars").getBoundingClientRect();
  goTo(Math.floor(((event.clientX - box.left) / box.width) * take.koma));
});
for (const canvas of document.querySelectorAll("figure canvas")) {
  // Not every browser says how far a finger moved.
  let from = 0;
  canvas.addEventListener("pointerdown", (event) => {
    from = event.clientX;
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!event.buttons) return;
    look(state.camera, state.angle + (event.clientX - from) * 0.01);
    from = event.clientX;
  });
}
new ResizeObserver(draw).observe(by("stages"));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (event) => { state.dark = event.matches; refresh(); });
refresh();
