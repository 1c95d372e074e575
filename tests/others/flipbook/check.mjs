// Opens a flip-book in Chromium and asks it whether it does what it says.
import assert from "node:assert/strict";
import { open } from "./open.mjs";
import { fitsSmallWindows } from "./small_windows.mjs";

const [page_path, folder] = process.argv.slice(2);
const { text, take, browser, page, said, asked } = await open(page_path);
const [sheet] = take.sheets;
assert.ok(!/https?:\/\//.test(text), "the page names no address");

// The drawing on a koma, by the sheet and not by the player.
const cellOf = (koma) => sheet.cells.find(([, begin, held]) => begin <= koma && koma < begin + held);
const isKey = ([drawing]) => sheet.drawings[drawing].role !== "inbetween";
const last = take.koma - 1;

async function shows(koma, what, drawing = cellOf(koma)[0]) {
  assert.equal(await page.textContent("#koma"), `${koma + 1} / ${take.koma}`, `${what}: the koma`);
  assert.equal(await page.textContent("#number b"), `${sheet.column}${sheet.drawings[drawing].number}`, `${what}: the drawing`);
  assert.equal(await page.inputValue("#scrub"), String(koma + 1), `${what}: the slider`);
  const pressed = sheet.drawings[drawing].genga;
  const role = await page.textContent("#number span");
  assert.equal(/\d+$/.exec(role)?.[0] ?? null, pressed === null ? null : String(pressed), `${what}: ${role}`);
}
const press = (key) => page.keyboard.press(key);
const within = (koma) => Math.min(Math.max(koma, 0), last);
// What a canvas shows, as a text that changes with it.
const ink = (canvas) => page.$eval(canvas, (canvas) => canvas.toDataURL());

await shows(0, "at first");
for (let koma = 1; koma <= last; koma++) {
  await press("ArrowRight");
  await shows(koma, `→ to koma ${koma + 1}`);
}
await press("ArrowRight");
await shows(last, "→ at the end stays");
await press("ArrowLeft");
await shows(within(last - 1), "←");
await press("Home");
await shows(0, "Home");
for (const cell of sheet.cells.slice(1)) {
  await press("ArrowDown");
  await shows(cell[1], "↓");
}
await press("ArrowUp");
await shows(sheet.cells.at(-2)?.[1] ?? 0, "↑");
await press("Home");
for (const cell of sheet.cells.slice(1).filter(isKey)) {
  await press("Shift+ArrowRight");
  await shows(cell[1], "shift →");
}
await press("End");
await shows(last, "End");

// The slider and the keys-only toggle.
const middle = Math.floor(take.koma / 2);
await page.fill("#scrub", String(middle + 1));
await shows(middle, "the slider");
await press("k");
await shows(middle, "genga only", sheet.cells.filter((cell) => cell[1] <= middle && isKey(cell)).at(-1)[0]);
await press("k");

// Pictures change with what is asked for, and come back.
const plain = await ink("#result canvas");
for (const key of ["o", "t", "1"]) {
  await press(key);
  assert.notEqual(await ink("#result canvas"), plain, `${key} changes the picture`);
  await press(key === "1" ? "4" : key);
  assert.equal(await ink("#result canvas"), plain, `${key} comes back`);
}
const box = await (await page.$("#result canvas")).boundingBox();
await page.mouse.move(box.x + 100, box.y + 100);
await page.mouse.down();
await page.mouse.move(box.x + 180, box.y + 100);
await page.mouse.up();
assert.notEqual(await ink("#result canvas"), plain, "a figure is turned by hand");
assert.equal(await page.inputValue("#camera"), "turned");
await page.selectOption("#camera", "auto");
assert.equal(await ink("#result canvas"), plain, "and turned back");
await page.click("#bars", { position: { x: 1, y: 8 } });
await shows(0, "a click on the bars");
const column = await (await page.$("#column")).boundingBox();
// Below the names of the columns, rows are 20 px high.
await page.click("#column", { position: { x: 40, y: 18 + 30 } });
await shows(Math.min(1, last), `a click on the second row of ${column.height} px`);
await page.fill("#scrub", String(middle + 1));
await press("s");
assert.ok(!(await page.isVisible("#result")) && (await page.isVisible("#source")), "source alone");
await press("s");
assert.ok((await page.isVisible("#result")) && !(await page.isVisible("#source")), "result alone");
await press("s");
await press("?");
assert.ok(await page.isVisible("dialog#keys"), "? opens the list of keys");
await page.screenshot({ path: `${folder}/keys.png` });
await press("Escape");
assert.ok(!(await page.isVisible("dialog#keys")), "Escape closes it");

// It plays in time: half a second of 24 koma a second, slow machines allowed for.
await press("Home");
const begin = Date.now();
await press(" ");
await page.waitForTimeout(500);
await press(" ");
const played = (parseInt(await page.textContent("#koma"), 10) - 1 + take.koma) % take.koma;
const most = Math.ceil(((Date.now() - begin) / 1000) * 24);
assert.ok(take.koma < 24 || (played >= 6 && played <= most), `${played} koma were played, at most ${most}`);

// Everything that can be pressed has a name.
for (const control of await page.$$("button, select, input, canvas[role=img]")) {
  const name = await control.evaluate((node) => node.getAttribute("aria-label") || node.labels?.[0]?.innerText || node.innerText);
  assert.ok(name?.trim(), `a control without a name: ${await control.evaluate((node) => node.outerHTML)}`);
}

await page.fill("#scrub", String(middle + 1));
await press("o");
await page.screenshot({ path: `${folder}/flipbook.png` });
await press("j");
await press("t");
assert.equal(await page.getAttribute("html", "lang"), "ja");
await page.screenshot({ path: `${folder}/flipbook-ja-dark.png` });
for (const [koma, [drawing]] of sheet.cells.map((cell) => [cell[1], cell])) {
  await page.fill("#scrub", String(koma + 1));
  assert.equal(await page.textContent("#why"), sheet.drawings[drawing].why_japanese, "the reason in Japanese");
}
const genga = sheet.drawings.filter((drawing) => drawing.role === "genga");
assert.ok(genga.some((drawing) => drawing.why_japanese), "a genga has a reason");

await fitsSmallWindows(page, ["source", "result"], `${folder}/flipbook`);

const files = asked.filter((address) => !address.startsWith("file:"));
assert.deepEqual(files, [], "no request leaves the machine");
assert.deepEqual(said, [], "nothing is said on the console");
await browser.close();
console.log(`flip-book: ${take.koma} koma, ${sheet.drawings.length} drawings, keys and pictures as they should be; ${asked.length} file read`);
