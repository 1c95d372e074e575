// What stands side by side, and its places on the page: the source and a sheet, or two sheets.
const take = JSON.parse(document.getElementById("take").textContent);
const reels = take.sheets.map((sheet) => new Reel(sheet, take.koma));
const areTwo = reels.length === 2;
const by = (id) => document.getElementById(id);

// The source, its own koma before and after as skins.
const source = {
  id: "source",
  pose: (koma) => take.source[koma],
  skins: (koma) => {
    const near = [[-2, "old"], [2, "young"], [-1, "old"], [1, "young"]];
    return near.map(([step, color]) => [take.source[koma + step], color]).filter(([pose]) => pose);
  },
};
const sheets = reels.map((reel, at) => ({
  id: areTwo ? ["first", "second"][at] : "result",
  name: reel.name,
  pose: (koma, keys) => reel.pose(koma, keys),
  skins: (koma, keys) => reel.skins(koma, keys),
}));
const panels = areTwo ? sheets : [source, ...sheets];

function made(tag, into, className = "") {
  const element = document.createElement(tag);
  element.className = className;
  into.append(element);
  return element;
}

for (const panel of panels) {
  panel.figure = made("figure", by("stages"));
  panel.figure.id = panel.id;
  panel.caption = made("figcaption", panel.figure);
  panel.canvas = made("canvas", panel.figure);
  panel.canvas.setAttribute("role", "img");
  panel.option = made("option", by("shown"));
  panel.option.value = panel.id;
}

// Where the drawing of each sheet is told: its number in the figure if there are two, else in the margin.
const told = reels.map((reel, at) => {
  const number = made("div", areTwo ? sheets[at].figure : by("number"), "number");
  const [held, frame] = ["held", "frame"].map((row) => {
    const cell = made("dd", by(row));
    cell.title = reel.name ?? "";
    return cell;
  });
  const why = made("p", by("why"));
  return { number, drawing: made("b", number), role: made("span", number), held, frame, why };
});
if (areTwo) {
  document.body.classList.add("two");
  for (const reel of reels) {
    for (const place of ["names", "heads", "bar-names"]) {
      const name = made(place === "names" ? "dd" : "span", by(place));
      name.textContent = name.title = reel.name;
    }
  }
}

