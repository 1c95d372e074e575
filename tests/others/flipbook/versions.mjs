// Opens a flip-book of two versions in Chromium: both run in step, and where they differ it is seen.
import assert from "node:assert/strict";
import { open } from "./open.mjs";
import { fitsSmallWindows } from "./small_windows.mjs";

const [page_path, folder] = process.argv.slice(2);
const { take, browser, page, said } = await open(page_path);
const last = take.koma - 1;
const ids = ["first", "second"];

// What stands on a koma, by the sheet and not by the player: its cell, and after its end the last one.
const cellOn = (sheet, koma) =>
  sheet.cells.find(([, begin, held]) => begin <= koma && koma < begin + held) ?? (koma >= sheet.koma ? sheet.cells.at(-1) : undefined);
const isDifferent = (koma) => (take.differences ?? []).some(([begin, held]) => begin <= koma && koma < begin + held);
const press = (key) => page.keyboard.press(key);
const read = (selector) => page.textContent(selector);
const ink = (id) => page.$eval(`#${id} canvas`, (canvas) => canvas.toDataURL());

async function shows(koma, what) {
  assert.equal(await read("#koma"), `${koma + 1} / ${take.koma}`, `${what}: the koma`);
  for (const [at, sheet] of take.sheets.entries()) {
    const cell = cellOn(sheet, koma);
    const drawing = cell && sheet.drawings[cell[0]];
    const where = `${what}: ${sheet.name}, koma ${koma + 1}`;
    assert.equal(await read(`#${ids[at]} .number b`), drawing ? `${sheet.column}${drawing.number}` : "", where);
    assert.equal(await read(`#held dd:nth-of-type(${at + 1})`), cell ? `${Math.min(koma - cell[1] + 1, cell[2])} / ${cell[2]}` : "", where);
    const genga = /\d+$/.exec(await read(`#${ids[at]} .number span`))?.[0];
    assert.equal(genga, drawing?.genga?.toString(), `${where}: the number of the genga`);
  }
  assert.equal(await page.isVisible("#different"), isDifferent(koma), `${what}: ≠ on koma ${koma + 1}`);
}

await shows(0, "at first");
const pictures = { first: [], second: [] };
for (let koma = 0; koma <= last; koma++) {
  if (koma > 0) await press("ArrowRight");
  await shows(koma, "→");
  for (const id of ids) pictures[id].push(await ink(id));
}
// Each figure changes with its own sheet, and both are alike where nothing differs.
for (const [at, sheet] of take.sheets.entries()) {
  for (let koma = 1; koma <= last; koma++) {
    const [before, now] = [koma - 1, koma].map((koma) => cellOn(sheet, koma)?.[0]);
    if (before === now) assert.equal(pictures[ids[at]][koma], pictures[ids[at]][koma - 1], `${sheet.name} holds on koma ${koma + 1}`);
  }
}
for (let koma = 0; koma <= last; koma++) {
  if (!isDifferent(koma)) continue;
  assert.notEqual(pictures.first[koma], pictures.second[koma], `koma ${koma + 1} differs, and looks the same`);
}

// Down goes to the next drawing of either, up back.
const begins = [...new Set(take.sheets.flatMap((sheet) => sheet.cells.map(([, begin]) => begin)))].sort((a, b) => a - b);
await press("Home");
for (const begin of begins.filter((begin) => begin > 0)) {
  await press("ArrowDown");
  await shows(begin, "↓");
}
await press("ArrowUp");
await shows(begins.at(-2), "↑");
const keys = new Set(take.sheets.flatMap((sheet) => sheet.cells.filter(([drawing]) => sheet.drawings[drawing].role !== "inbetween").map(([, begin]) => begin)));
await press("Home");
for (const begin of [...keys].sort((a, b) => a - b).filter((begin) => begin > 0)) {
  await press("Shift+ArrowRight");
  await shows(begin, "shift →");
}

// One of both, each alone, and both names wherever something is told of one.
for (const shown of [["first"], ["second"], ids]) {
  await press("s");
  for (const id of ids) assert.equal(await page.isVisible(`#${id}`), shown.includes(id), `S shows ${shown}`);
}
const names = take.sheets.map(({ name }) => name);
for (const place of ["#names dd", "#heads span", "#bar-names span", "figcaption"]) {
  assert.deepEqual(await page.$$eval(place, (all) => all.map((one) => one.textContent)), names, place);
}
const facts = await read("#facts");
assert.ok(names.every((name) => facts.includes(name)), facts);
const differ = (take.differences ?? []).reduce((sum, [, koma]) => sum + koma, 0);
assert.ok(differ > 0 && facts.includes(`different drawings on ${differ} koma`), facts);

for (const control of await page.$$("button, select, input, canvas[role=img]")) {
  const name = await control.evaluate((node) => node.getAttribute("aria-label") || node.labels?.[0]?.innerText || node.innerText);
  assert.ok(name?.trim(), `a control without a name: ${await control.evaluate((node) => node.outerHTML)}`);
}
const [[begin, held]] = take.differences.slice(-2);
await page.fill("#scrub", String(begin + Math.floor(held / 2) + 1));
await page.screenshot({ path: `${folder}/two.png` });
await press("j");
await page.screenshot({ path: `${folder}/two-ja.png` });
await press("t");
await press("o");
await page.screenshot({ path: `${folder}/two-ja-dark.png` });
await fitsSmallWindows(page, ids, `${folder}/two`);
assert.deepEqual(said, [], "nothing is said on the console");
await browser.close();
console.log(`two versions: ${take.koma} koma in step, different on ${differ}`);
