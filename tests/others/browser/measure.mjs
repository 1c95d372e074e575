// What the page costs with a clip of 5,000 frames, the clip there and back again: `measure.mjs ADDRESS FOLDER CLIP`.
import { readFileSync, writeFileSync } from "node:fs";
import { browser } from "./browser.mjs";
import { Studio } from "./studio.mjs";

const [address, folder, clip] = process.argv.slice(2);
process.chdir(folder);
const [head, table] = readFileSync(clip, "latin1").split(/(?<=Frame Time:[^\n]*\n)/);
const rows = table.trim().split("\n");
const there = [...rows, ...rows.toReversed()];
const long = Array.from({ length: 5000 }, (_, at) => there[at % there.length]);
writeFileSync("long.bvh", head.replace(/Frames:[^\r\n]*/, "Frames: 5000") + long.join("\n") + "\n", "latin1");
const opened = performance.now();
const studio = await Studio.open(browser, address, { locale: "en-GB" });
console.log(`page ready: ${((performance.now() - opened) / 1000).toFixed(2)} s`);

// How long the page was busy at a time while something was done.
async function busy(what, act) {
  await studio.page.evaluate(() => (window.frames_ms.length = window.long_ms.length = 0));
  const begin = performance.now();
  await act();
  await studio.rest();
  const seconds = ((performance.now() - begin) / 1000).toFixed(2);
  const [frames, long] = await studio.page.evaluate(() => [window.frames_ms, window.long_ms]);
  const ms = frames.sort((a, b) => a - b);
  const at = (share) => ms[Math.floor(share * (ms.length - 1))].toFixed(1);
  console.log(`${what}: ${seconds} s, ${ms.length} frames; ms a frame: middle ${at(0.5)}, nine of ten ${at(0.9)}, worst ${at(1)}; ` +
    `${long.length} tasks of 50 ms and more${long.length ? `: ${long.map(Math.round).join(" ")}` : ""}`);
}

// From the drop until two frames with the clip were drawn, without the way of the file to the browser.
await studio.page.evaluate(() => {
  window.shown_ms = new Promise((done) => {
    let begin;
    addEventListener("drop", () => (begin = performance.now()), true);
    const after = (act) => requestAnimationFrame(() => requestAnimationFrame(act));
    const look = () => (document.title.startsWith("long") ? after(() => done(performance.now() - begin)) : requestAnimationFrame(look));
    look();
  });
});
await busy("5,000 frames opened", () => studio.drop("long.bvh"));
console.log(`5,000 frames shown: ${((await studio.page.evaluate(() => window.shown_ms)) / 1000).toFixed(2)} s`);
// The knobs are among the expert settings.
await studio.press("7");
for (const knob of ["filter.width", "keys.min_price", "spacing.weight"]) {
  const { x, y, height } = await studio.place(knob, "Slider");
  await busy(`${knob} dragged`, async () => {
    await studio.page.mouse.move(x + 10, y + height / 2);
    await studio.page.mouse.down();
    for (let way = 10; way < 90; way += 4) {
      await studio.page.mouse.move(x + way, y + height / 2);
      await studio.rest();
    }
    await studio.page.mouse.up();
  });
}
await busy("played", async () => {
  await studio.press("Space");
  await studio.page.waitForTimeout(3000);
  await studio.press("Space");
});
await busy("exported", async () => {
  await studio.click("Export");
  await Promise.all([studio.page.waitForEvent("download"), studio.click("Write the files")]);
});
await browser.close();
