// node unpacked.mjs PAGE.html CLIP.bvh OUT.zip: the page is opened from a disk, a clip dropped and exported.
import assert from "node:assert/strict";
import { pathToFileURL } from "node:url";
import { browser } from "./browser.mjs";
import { Studio } from "./studio.mjs";

const [page, clip, out] = process.argv.slice(2);
const studio = await Studio.open(browser, pathToFileURL(page).href);
await studio.drop(clip);
await studio.click("Export");
const [made] = await Promise.all([studio.page.waitForEvent("download"), studio.click("Write the files")]);
await made.saveAs(out);
assert.deepEqual(studio.said, [], "nothing went wrong");
await browser.close();
