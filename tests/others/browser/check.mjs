// Works with the studio in a browser as a person would, and asks whether it did what it should.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { basename } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { Studio } from "./studio.mjs";

const [address, folder, clip] = process.argv.slice(2);
process.chdir(folder);
const name = basename(clip, ".bvh");
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});

const studio = await Studio.open(browser, address, { locale: "en-GB" });
const { page } = studio;
assert.ok(await page.evaluate(() => !!document.getElementById("studio").getContext("webgl2")), "WebGL draws it");
assert.deepEqual(studio.asked, [address], "the page is one file");
await studio.picture("empty.png");
await studio.drop(clip);

// A knob: what is not saved is kept in the browser.
const slider = await studio.place("filter.width", "Slider");
await studio.drag([slider.x + 20, slider.y + slider.height / 2], [slider.x + 50, slider.y + slider.height / 2]);
const width = (text) => /^width = "?([^"\n]+)"?$/m.exec(text)?.[1];
const turned = width(await studio.unsaved("the width is turned", (text) => width(text)));
assert.ok(await page.title() === `${name} * – genga`, await page.title());

// The first genga after the beginning is dragged on the sheet by two koma.
await studio.press("ArrowDown");
const [, koma] = /^(\d+) \/ \d+/.exec(await studio.named(/^\d+ \/ \d+/));
const sheet = await studio.place("Timesheet");
// Rows of the sheet, and where its column is.
const ROW = 17;
const row = (koma) => [sheet.x + 62, sheet.y + ROW * (koma - 0.5)];
const dragged = (text) => text.includes("[[edits.moves]]");
await studio.drag(row(Number(koma)), row(Number(koma) + 2));
await studio.unsaved("the key is dragged", dragged);
await studio.press("Control+z");
await studio.unsaved("the drag is undone, the knob is not", (text) => !dragged(text) && width(text) === turned);
await studio.press("Control+y");
await studio.unsaved("and done again", dragged);
await studio.picture("studio.png");

const [download] = await Promise.all([page.waitForEvent("download"), studio.click("Export")]);
assert.equal(download.suggestedFilename(), `${name}-genga.zip`);
await download.saveAs("exported.zip");

// Another visit: what was not saved is offered again.
await page.reload();
await studio.until("the studio is back", () => page.evaluate(() => !document.getElementById("word")));
await studio.drop(clip);
await studio.place("Recover");
await studio.picture("offered.png");
await studio.click("Recover");
await studio.until("it is taken", async () => (await page.title()).includes("*"));
const [recipe] = await Promise.all([page.waitForEvent("download"), studio.click("Save")]);
assert.equal(recipe.suggestedFilename(), `${name}.genga.toml`);
await studio.until("it is saved", async () => !(await page.title()).includes("*"));
assert.ok(dragged(await studio.kept(".genga.toml")));
assert.equal(await studio.kept(".genga-autosave.toml"), "");
const elsewhere = (address) => !address.startsWith("blob:");
assert.deepEqual(studio.asked.filter(elsewhere), [address, address], "nothing was asked of any server");
assert.deepEqual(studio.said, [], "nothing went wrong");

// In Japanese, and from a disk instead of a server.
const file = pathToFileURL("page/index.html").href;
const other = await Studio.open(browser, file, { locale: "ja-JP" });
await other.drop(clip);
await other.picture("studio-ja.png");
assert.deepEqual(other.asked, [file]);
assert.deepEqual(other.said, []);

if (process.env.MEASURE !== "no") {
  await measure(browser);
}
await browser.close();
console.log(`the page was opened, turned, corrected, exported and found again; see ${folder}/studio.png`);

// What a turned knob costs in a clip of 5,000 frames: the clip there and back again.
async function measure(browser) {
  const [head, table] = readFileSync(clip, "latin1").split(/(?<=Frame Time:.*\n)/);
  const rows = table.trim().split("\n");
  const there = [...rows, ...rows.toReversed()];
  const long = Array.from({ length: 5000 }, (_, at) => there[at % there.length]);
  writeFileSync("long.bvh", head.replace(/Frames:.*/, "Frames: 5000") + long.join("\n") + "\n", "latin1");
  const studio = await Studio.open(browser, address, { locale: "en-GB" });
  const frames = async (what, act) => {
    await studio.page.evaluate(() => (window.frames_ms.length = 0));
    await act();
    const ms = (await studio.page.evaluate(() => window.frames_ms)).sort((a, b) => a - b);
    const at = (share) => ms[Math.floor(share * (ms.length - 1))].toFixed(1);
    console.log(`${what}: ${ms.length} frames; ms a frame: middle ${at(0.5)}, nine of ten ${at(0.9)}, worst ${at(1)}`);
  };
  await frames("5,000 frames opened", () => studio.drop("long.bvh"));
  for (const knob of ["filter.width", "turns.persistence", "spacing.weight"]) {
    const { x, y, height } = await studio.place(knob, "Slider");
    await frames(`${knob} dragged`, async () => {
      await studio.page.mouse.move(x + 10, y + height / 2);
      await studio.page.mouse.down();
      for (let way = 10; way < 90; way += 2) {
        await studio.page.mouse.move(x + way, y + height / 2);
        await studio.rest();
      }
      await studio.page.mouse.up();
    });
  }
  await frames("exported", async () => {
    await Promise.all([studio.page.waitForEvent("download"), studio.click("Export")]);
  });
}
