// The tour in the window, under X: `window.mjs GENGA CLIP FOUND`. It finds nothing by name; parts are where the page had them.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { setTimeout as wait } from "node:timers/promises";
import { middle, PATIENCE, way } from "./hand.mjs";
import { tour } from "./tour.mjs";

// Until a frame was drawn by a processor that has other work, too.
const FRAME = 600;
const KEYS = { ArrowDown: "Down", Enter: "Return" };

class Window {
  constructor(clip, found) {
    this.beside = clip.replace(/\.[^.]*$/, "");
    this.found = found;
  }

  place() {
    return this.found.shift();
  }

  named() {
    return this.found.shift();
  }

  async do(...words) {
    execFileSync("xdotool", words.map(String));
    await wait(FRAME);
  }

  async click(name) {
    await this.do("mousemove", ...middle(this.place(name)));
    await this.do("click", 1);
  }

  async drag(from, to) {
    const [first, ...others] = way(from, to);
    await this.do("mousemove", ...first);
    await this.do("mousedown", 1);
    for (const place of others) {
      await this.do("mousemove", ...place);
    }
    await this.do("mouseup", 1);
  }

  press(keys) {
    const named = keys.split("+").map((key) => KEYS[key] ?? key.replace("Control", "ctrl"));
    return this.do("key", named.join("+"));
  }

  async until(what, look) {
    for (const end = Date.now() + PATIENCE; Date.now() < end; await wait(50)) {
      const found = look();
      if (found) return found;
    }
    execFileSync("import", ["-window", "root", "failed.png"]);
    assert.fail(`${what}: not within ${PATIENCE / 1000} s`);
  }

  unsaved(what, isExpected) {
    return this.until(what, () => {
      const file = `${this.beside}.genga-autosave.toml`;
      const text = existsSync(file) ? readFileSync(file, "utf8") : "";
      return isExpected(text) && (text || "nothing");
    });
  }
}

const [genga, clip, found] = process.argv.slice(2);
process.chdir(dirname(found));
const studio = spawn(genga, ["studio", clip], { stdio: "inherit" });
const window = new Window(clip, JSON.parse(readFileSync(found, "utf8")));
try {
  const ids = await window.until("the window is there with its clip", () => {
    assert.equal(studio.exitCode, null, "the window closed");
    try {
      return execFileSync("xdotool", ["search", "--onlyvisible", "--name", `${basename(window.beside)}.*genga`], { encoding: "utf8" });
    } catch {
      return "";
    }
  });
  const id = ids.split("\n")[0];
  // There is no window manager: keys go to what has the focus.
  await window.do("windowmove", id, 0, 0);
  await window.do("windowfocus", id);
  await wait(4 * FRAME);
  await tour(window);
  await window.until("it is exported", () => existsSync(join(`${window.beside}-genga`, "manifest.json")));
  execFileSync("import", ["-window", "root", "window.png"]);
} finally {
  studio.kill();
}
