// A page with the studio on it, and hands for it. What they found is written down for hands that find nothing by name.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { basename, parse } from "node:path";
import { middle, PATIENCE, way } from "./hand.mjs";

export class Studio {
  // Opens the page, and writes down what it asks the network for and what it says.
  static async open(browser, address, options = {}) {
    const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, colorScheme: "light", ...options });
    context.setDefaultTimeout(PATIENCE);
    const page = await context.newPage();
    const studio = new Studio(page);
    // How long each frame keeps the page busy, and what the browser itself calls a long task: 50 ms and more.
    await page.addInitScript(() => {
      window.long_ms = [];
      const seen = (tasks) => window.long_ms.push(...tasks.getEntries().map((task) => task.duration));
      new PerformanceObserver(seen).observe({ entryTypes: ["longtask"] });
      const frame = window.requestAnimationFrame.bind(window);
      window.frames_ms = [];
      window.requestAnimationFrame = (draw) => frame((now) => {
        const begin = performance.now();
        draw(now);
        window.frames_ms.push(performance.now() - begin);
      });
    });
    await page.goto(address);
    await studio.ready();
    return studio;
  }

  ready() {
    return this.until("the studio is there", () => this.page.evaluate(() => !document.getElementById("word")));
  }

  constructor(page) {
    this.page = page;
    this.asked = [];
    this.said = [];
    this.found = [];
    page.on("request", (request) => this.asked.push(request.url()));
    page.on("websocket", (socket) => this.asked.push(socket.url()));
    page.on("console", (message) => {
      if (message.type() === "error") this.said.push(message.text());
    });
    page.on("pageerror", (error) => this.said.push(error.message));
  }

  // What `look` gives as soon as it gives something.
  async until(what, look) {
    for (const end = Date.now() + PATIENCE; Date.now() < end; ) {
      const found = await look();
      if (found) return found;
      await this.page.waitForTimeout(50);
    }
    await this.page.screenshot({ path: "failed.png" });
    assert.fail(`${what}: not within ${PATIENCE / 1000} s; title ${await this.page.title()}`);
  }

  // What is on screen, as soon as `look` finds something in it.
  async find(what, look) {
    const found = await this.until(`there is ${what}`, async () => look(await this.page.evaluate(() => wasm_bindgen.places())));
    this.found.push(found);
    return found;
  }

  // The place of a part of the window, by its name.
  place(name, role) {
    return this.find(name, (places) => {
      const found = places.find((place) => place[0] === name && (!role || place[1] === role));
      return found && { x: found[2], y: found[3], width: found[4], height: found[5] };
    });
  }

  // The first name on screen that is as expected.
  named(expected) {
    return this.find(expected, (places) => places.map((place) => place[0]).find((name) => expected.test(name)));
  }

  async click(name) {
    await this.page.mouse.click(...middle(await this.place(name, "Button")));
    await this.rest();
  }

  async drag(from, to) {
    const [first, ...others] = way(from, to);
    const { mouse } = this.page;
    await mouse.move(...first);
    await this.rest();
    await mouse.down();
    await this.rest();
    for (const place of others) {
      await mouse.move(...place);
      await this.rest();
    }
    await mouse.up();
    await this.rest();
  }

  // Until two frames were drawn.
  rest() {
    return this.page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  }

  async press(keys) {
    await this.rest();
    await this.page.keyboard.press(keys);
    await this.rest();
  }

  async drop(file, name = basename(file)) {
    await this.give(file, name);
    await this.until(`${name} is on the table`, async () => (await this.page.title()).startsWith(parse(name).name));
    await this.rest();
  }

  // Lets go of a file over the page.
  async give(file, name = basename(file)) {
    const given = await this.page.evaluateHandle(([name, text]) => {
      const given = new DataTransfer();
      given.items.add(new File([Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0))], name));
      return given;
    }, [name, readFileSync(file, "base64")]);
    await this.page.dispatchEvent("#studio", "drop", { dataTransfer: given });
  }

  // What the browser's storage has of files that end so.
  kept(ending) {
    return this.page.evaluate((ending) => {
      const key = Object.keys(localStorage).find((key) => key.startsWith("genga/") && key.endsWith(ending));
      return key ? localStorage.getItem(key) : "";
    }, ending);
  }

  // What is not saved, as soon as it is as expected.
  unsaved(what, isExpected) {
    return this.until(what, async () => {
      const text = await this.kept(".genga-autosave.toml");
      return isExpected(text) && (text || "nothing");
    });
  }

  picture(path) {
    return this.page.screenshot({ path });
  }
}
