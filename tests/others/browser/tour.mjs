// The tour (一巡): what a person does in the studio, the same in its page and in its window.
import assert from "node:assert/strict";

// Rows of the sheet, and where its column is.
const ROW = 17;
const COLUMN = 92;
// Where the play head is.
export const AT = /^koma +(\d+) \/ \d+/;

// Steps of hands that can find, click, drag and press. After each it is looked whether it did what it should.
export async function tour(hands) {
  // A knob among the expert settings: what is not saved is kept.
  await hands.press("7");
  const slider = await hands.place("filter.width", "Slider");
  const middle = slider.y + slider.height / 2;
  await hands.drag([slider.x + 20, middle], [slider.x + 50, middle]);
  const width = (text) => /^width = "?([^"\n]+)"?$/m.exec(text)?.[1];
  const turned = width(await hands.unsaved("the width is turned", width));

  // The first genga after the beginning is dragged on the sheet by two koma, undone, and done again.
  await hands.press("ArrowDown");
  const [, koma] = AT.exec(await hands.named(AT));
  const sheet = await hands.place("Timesheet");
  const row = (koma) => [sheet.x + COLUMN, sheet.y + ROW * (koma - 0.5)];
  const isDragged = (text) => text.includes("[[edits.moves]]");
  await hands.drag(row(Number(koma)), row(Number(koma) + 2));
  await hands.unsaved("the key is dragged", isDragged);
  await hands.press("Control+z");
  await hands.unsaved("the drag is undone, the knob is not", (text) => !isDragged(text) && width(text) === turned);
  await hands.press("Control+y");
  const left = await hands.unsaved("and done again", isDragged);
  assert.equal(width(left), turned);

  // What is exported is asked first.
  await hands.click("Export");
  await hands.click("Write the files");
  return left;
}
