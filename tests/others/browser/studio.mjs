// A page with the studio on it, and hands for it.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { basename } from "node:path";

// Long, for a machine with other work.
const PATIENCE = 120_000;

export class Studio {
  // Opens the page, and writes down what it asks the network for and what it says.
  static async open(browser, address, options = {}) {
    const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, colorScheme: "light", ...options });
    const page = await context.newPage();
    const studio = new Studio(page);
    // How long each frame keeps the page busy.
    await page.addInitScript(() => {
      const frame = window.requestAnimationFrame.bind(window);
      window.frames_ms = [];
      window.requestAnimationFrame = (draw) => frame((now) => {
        const begin = performance.now();
        draw(now);
        window.frames_ms.push(performance.now() - begin);
      });
    });
    await page.goto(address);
    await studio.until("the studio is there", () => page.evaluate(() => !document.getElementById("word")));
    return studio;
  }

  constructor(page) {
    this.page = page;
    this.asked = [];
    this.said = [];
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

  // The place of a part of the window, by its name.
  place(name, role) {
    return this.until(`there is ${name}`, async () => {
      const places = await this.page.evaluate(() => wasm_bindgen.places());
      const found = places.find((place) => place[0] === name && (!role || place[1] === role));
      return found && { x: found[2], y: found[3], width: found[4], height: found[5] };
    });
  }

  // The first name on screen that is as expected.
  named(expected) {
    return this.until(`there is ${expected}`, async () => {
      const places = await this.page.evaluate(() => wasm_bindgen.places());
      return places.map((place) => place[0]).find((name) => expected.test(name));
    });
  }

  async click(name) {
    const { x, y, width, height } = await this.place(name, "Button");
    await this.page.mouse.click(x + width / 2, y + height / 2);
  }

  async drag(from, to) {
    const { mouse } = this.page;
    await mouse.move(...from);
    await this.rest();
    await mouse.down();
    await this.rest();
    for (const step of [1, 2, 3, 4, 5, 6]) {
      await mouse.move(from[0] + ((to[0] - from[0]) * step) / 6, from[1] + ((to[1] - from[1]) * step) / 6);
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
    await this.page.keyboard.press(keys);
    await this.rest();
  }

  async drop(file, name = basename(file)) {
    const given = await this.page.evaluateHandle(([name, text]) => {
      const given = new DataTransfer();
      given.items.add(new File([text], name));
      return given;
    }, [name, readFileSync(file, "latin1")]);
    await this.page.dispatchEvent("#studio", "drop", { dataTransfer: given });
    await this.until(`${name} is on the table`, async () => (await this.page.title()).startsWith(name.replace(/\.bvh$/, "")));
    await this.rest();
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
