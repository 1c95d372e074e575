// Opens an HTML file from the disk, fails at any error or request, and prints it: print.mjs FILE FOLDER
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [file, folder] = process.argv.slice(2);
const page_url = pathToFileURL(file).href;
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--headless", "--no-sandbox", "--disable-gpu"],
});
const wrong = [];
try {
  const context = await browser.newContext({ offline: true, viewport: { width: 1100, height: 1500 } });
  const page = await context.newPage();
  page.on("console", (message) => wrong.push(`console ${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => wrong.push(`error: ${error.message}`));
  page.on("request", (request) => {
    if (request.url() !== page_url) wrong.push(`request: ${request.url()}`);
  });
  await page.goto(page_url, { waitUntil: "load" });
  const seen = await page.evaluate(() => {
    const pages = [...document.querySelectorAll("section > svg")];
    const inside = pages.every((svg) =>
      [...svg.querySelectorAll("text")].every((text) => {
        const [box, paper] = [text.getBoundingClientRect(), svg.getBoundingClientRect()];
        return box.left >= paper.left - 1 && box.right <= paper.right + 1
          && box.top >= paper.top - 1 && box.bottom <= paper.bottom + 1;
      }));
    return { pages: pages.length, inside, wide: document.documentElement.scrollWidth > innerWidth };
  });
  if (seen.pages === 0) wrong.push("there is no page");
  if (!seen.inside) wrong.push("a word lies outside its page");
  if (seen.wide) wrong.push("the screen has to be scrolled sideways");
  await page.screenshot({ path: `${folder}/screen.png` });
  await page.pdf({ path: `${folder}/a4.pdf`, format: "A4" });
  await page.pdf({ path: `${folder}/letter.pdf`, format: "Letter" });
  // JIS B4, the paper of the trade.
  await page.pdf({ path: `${folder}/b4.pdf`, width: "257mm", height: "364mm" });
} finally {
  await browser.close();
}
if (wrong.length > 0) {
  console.error(`${file}:\n  ${wrong.join("\n  ")}`);
  process.exit(1);
}
