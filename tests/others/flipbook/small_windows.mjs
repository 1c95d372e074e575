// In small windows everything of a flip-book is seen, nothing lies on anything else, and the figures have the room.
import assert from "node:assert/strict";

const SIZES = [[640, 400], [390, 844], [844, 390], [700, 900], [740, 600], [1280, 800]];
const APART = "header > *, footer button, footer select, #bars, #scrub, aside > *, figure";
// What is written in the figures and in the margin: on the paper, but not on other words.
const WORDS = "figcaption, figure .number > *, #different, aside dt, aside dd, #heads span";

function boxes(page, selector) {
  return page.evaluate((selector) => {
    const all = [...document.querySelectorAll(selector)];
    const boxes = all.map((node) => [node.id || node.className || node.textContent, node.getBoundingClientRect()]);
    return boxes.filter(([, box]) => box.width > 1).map(([name, box]) => [name, box.left, box.top, box.right, box.bottom]);
  }, selector);
}

function areApart(seen, where) {
  for (const [at, [name, left, top, right, bottom]] of seen.entries()) {
    const on = seen.slice(at + 1).find((other) =>
      left < other[3] - 0.5 && other[1] < right - 0.5 && top < other[4] - 0.5 && other[2] < bottom - 0.5);
    assert.ok(!on, `${where}: ${name} lies on ${on?.[0]}`);
  }
}

// The height of the ink in a panel, without the floor, in px.
function figureHeight(page, id) {
  return page.$eval(`#${id} canvas`, (canvas) => {
    const { width, height } = canvas;
    // A browser warns of a canvas on a page that is read again and again.
    const copy = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
    copy.drawImage(canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, width, height);
    const inked = [...Array(height).keys()].filter((row) => {
      let count = 0;
      for (let x = 0; x < width; x++) count += data[4 * (row * width + x) + 3] > 128 ? 1 : 0;
      // A floor goes all the way.
      return count > 0 && count < 0.8 * width;
    });
    return (inked.at(-1) - inked[0]) / devicePixelRatio;
  });
}

// Tries a page with its panels in all sizes and both languages; screenshots begin with `path`.
export async function fitsSmallWindows(page, panels, path) {
  for (const [width, height] of SIZES) {
    await page.setViewportSize({ width, height });
    for (const key of ["j", "j"]) {
      await page.keyboard.press(key);
      const language = await page.getAttribute("html", "lang");
      const where = `${width} × ${height}, ${language}`;
      await page.screenshot({ path: `${path}-${width}x${height}-${language}.png` });
      const seen = await boxes(page, APART);
      for (const [name, left, top, right, bottom] of seen) {
        const inside = left >= 0 && top >= 0 && right <= width + 0.5 && bottom <= height + 0.5;
        assert.ok(inside, `${where}: ${name} is inside: ${[left, top, right, bottom]}`);
      }
      areApart(seen, where);
      areApart(await boxes(page, WORDS), where);
      for (const id of panels) {
        const high = await figureHeight(page, id);
        assert.ok(high >= 100, `${where}: the figure of ${id} is ${high} px high`);
      }
    }
  }
}
