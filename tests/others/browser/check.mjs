// Works with the studio in a browser as a person would, and asks whether it did what it should:
// `check.mjs ADDRESS FOLDER CLIP OTHERS`, where OTHERS has the same clip in other formats.
import assert from "node:assert/strict";
import { readdirSync, writeFileSync } from "node:fs";
import { join, parse } from "node:path";
import { pathToFileURL } from "node:url";
import { browser } from "./browser.mjs";
import { PATIENCE } from "./hand.mjs";
import { Studio } from "./studio.mjs";
import { AT, tour } from "./tour.mjs";

// To a genga amid the movement, where there is more to see.
async function toTheMiddle(studio) {
  for (let genga = 0; genga < 5; genga += 1) await studio.press("ArrowDown");
}

const [address, folder, clip, others] = process.argv.slice(2);
process.chdir(folder);
const name = parse(clip).name;

const studio = await Studio.open(browser, address, { locale: "en-GB" });
const { page } = studio;
assert.ok(await page.evaluate(() => !!document.getElementById("studio").getContext("webgl2")), "WebGL draws it");
assert.deepEqual(studio.asked, [address], "the page is one file");
await studio.picture("empty.png");
await studio.drop(clip);

// The window then does the same.
const [archive, left] = await Promise.all([page.waitForEvent("download", { timeout: 10 * PATIENCE }), tour(studio)]);
writeFileSync("found.json", JSON.stringify(studio.found));
assert.equal(archive.suggestedFilename(), `${name}-genga.zip`);
await archive.saveAs("exported.zip");
assert.equal(await page.title(), `${name} * – genga`);
await studio.named(/sheet\.json/);
await studio.press("Escape");
await toTheMiddle(studio);
await studio.picture("studio.png");

// Another visit: what was not saved is offered again.
await page.reload();
await studio.ready();
await studio.drop(clip);
await studio.place("Recover");
await studio.picture("offered.png");
await studio.click("Recover");
await studio.until("it is taken", async () => (await page.title()).includes("*"));
const [recipe] = await Promise.all([page.waitForEvent("download"), studio.click("Save")]);
assert.equal(recipe.suggestedFilename(), `${name}.genga.toml`);
await recipe.saveAs("saved.toml");
await studio.until("it is saved", async () => !(await page.title()).includes("*"));
assert.equal(await studio.kept(".genga.toml"), left, "what is saved is what was left");
assert.equal(await studio.kept(".genga-autosave.toml"), "");

// Other formats; of FBX it says that the page has none.
for (const file of readdirSync(others)) {
  await studio.drop(join(others, file));
  await studio.named(AT);
}
writeFileSync("none.fbx", "Kaydara FBX Binary  \0\x1a\0");
await studio.give("none.fbx");
await studio.named(/none\.fbx.*FBX/);
const elsewhere = (address) => !address.startsWith("blob:");
assert.deepEqual(studio.asked.filter(elsewhere), [address, address], "nothing was asked of any server");
assert.deepEqual(studio.said, [], "nothing went wrong");

// In Japanese, from a disk instead of a server, with the recipe that was saved: the same once more.
const file = pathToFileURL("page/index.html").href;
const other = await Studio.open(browser, file, { locale: "ja-JP" });
await other.drop(clip);
await other.give("saved.toml");
// A knob that is not as it comes has a button back. It is among the expert settings.
await other.press("7");
await other.named(/: filter\.width \(/);
await other.press("7");
await toTheMiddle(other);
await other.picture("studio-ja.png");
await other.click("書き出し");
await other.picture("order-ja.png");
const [again] = await Promise.all([other.page.waitForEvent("download"), other.click("書き出す")]);
await again.saveAs("again.zip");

// For a program of drawings it gets numbered pictures too.
await other.press("Escape");
await other.click("書き出し");
await other.click("クリスタ");
const [pictured] = await Promise.all([other.page.waitForEvent("download", { timeout: PATIENCE }), other.click("書き出す")]);
await pictured.saveAs("pictured.zip");
assert.deepEqual(other.asked.filter(elsewhere), [file]);
assert.deepEqual(other.said, []);
await browser.close();
