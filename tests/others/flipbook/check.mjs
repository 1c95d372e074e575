// Opens a flip-book in Chromium and asks it whether it does what it says.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [page_path, folder] = process.argv.slice(2);
const text = readFileSync(page_path, "utf8");
const take = JSON.parse(text.match(/<script type="application\/json" id="take">(.*?)<\/script>/s)[1]);
assert.ok(!/https?:\/\//.test(text), "the page names no address");

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu"],
});
const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, locale: "en-GB", colorScheme: "light" });
const page = await context.newPage();
const said = [];
const asked = [];
page.on("console", (message) => said.push(`${message.type()}: ${message.text()}`));
page.on("pageerror", (error) => said.push(`error: ${error.message}`));
page.on("request", (request) => asked.push(request.url()));
await page.goto(pathToFileURL(page_path).href);

// The drawing on a koma, by the sheet and not by the player.
const cellOf = (koma) => take.cells.find(([, begin, held]) => begin <= koma && koma < begin + held);
const isKey = ([drawing]) => take.drawings[drawing].role !== "inbetween";
const last = take.koma - 1;

async function shows(koma, what, drawing = cellOf(koma)[0]) {
  assert.equal(await page.textContent("#koma"), `${koma + 1} / ${take.koma}`, `${what}: the koma`);
  assert.equal(await page.textContent("#drawing"), `${take.column}${take.drawings[drawing].number}`, `${what}: the drawing`);
  assert.equal(await page.inputValue("#scrub"), String(koma + 1), `${what}: the slider`);
  const pressed = take.drawings[drawing].genga;
  const role = await page.textContent("#role");
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
for (const cell of take.cells.slice(1)) {
  await press("ArrowDown");
  await shows(cell[1], "↓");
}
await press("ArrowUp");
await shows(take.cells.at(-2)?.[1] ?? 0, "↑");
await press("Home");
for (const cell of take.cells.slice(1).filter(isKey)) {
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
await shows(middle, "genga only", take.cells.filter((cell) => cell[1] <= middle && isKey(cell)).at(-1)[0]);
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
for (const [koma, [drawing]] of take.cells.map((cell) => [cell[1], cell])) {
  await page.fill("#scrub", String(koma + 1));
  assert.equal(await page.textContent("#why"), take.drawings[drawing].why_japanese, "the reason in Japanese");
}
const genga = take.drawings.filter((drawing) => drawing.role === "genga");
assert.ok(genga.some((drawing) => drawing.why_japanese), "a genga has a reason");

// In small windows everything is seen, nothing lies on anything else, and the figures have the room.
for (const [width, height] of [[640, 400], [390, 844], [844, 390], [700, 900], [1280, 800]]) {
  await page.setViewportSize({ width, height });
  for (const key of ["j", "j"]) {
    await press(key);
    const language = await page.getAttribute("html", "lang");
    const where = `${width} × ${height}, ${language}`;
    const seen = await page.evaluate(() => {
      const all = [...document.querySelectorAll("header > *, footer button, footer select, #bars, #scrub, aside > *, figure")];
      const boxes = all.map((node) => [node.id || node.className || node.textContent, node.getBoundingClientRect()]);
      return boxes.filter(([, box]) => box.width > 1).map(([name, box]) => [name, box.left, box.top, box.right, box.bottom]);
    });
    for (const [name, left, top, right, bottom] of seen) {
      const inside = left >= 0 && top >= 0 && right <= width + 0.5 && bottom <= height + 0.5;
      assert.ok(inside, `${where}: ${name} is inside: ${[left, top, right, bottom]}`);
    }
    for (const [at, [name, left, top, right, bottom]] of seen.entries()) {
      const on = seen.slice(at + 1).find((other) =>
        left < other[3] - 0.5 && other[1] < right - 0.5 && top < other[4] - 0.5 && other[2] < bottom - 0.5);
      assert.ok(!on, `${where}: ${name} lies on ${on?.[0]}`);
    }
    for (const id of ["source", "result"]) {
      const high = await page.$eval(`#${id} canvas`, (canvas) => {
        const { width, height } = canvas;
        const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
        const inked = [...Array(height).keys()].filter((row) => {
          let count = 0;
          for (let x = 0; x < width; x++) count += data[4 * (row * width + x) + 3] > 128 ? 1 : 0;
          // A floor goes all the way.
          return count > 0 && count < 0.8 * width;
        });
        return (inked.at(-1) - inked[0]) / devicePixelRatio;
      });
      assert.ok(high >= 100, `${where}: the figure of ${id} is ${high} px high`);
    }
    await page.screenshot({ path: `${folder}/flipbook-${width}x${height}-${language}.png` });
  }
}

const files = asked.filter((address) => !address.startsWith("file:"));
assert.deepEqual(files, [], "no request leaves the machine");
assert.deepEqual(said, [], "nothing is said on the console");
await browser.close();
console.log(`flip-book: ${take.koma} koma, ${take.drawings.length} drawings, keys and pictures as they should be; ${asked.length} file read`);
