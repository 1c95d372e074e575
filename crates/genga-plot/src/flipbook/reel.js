// A sheet as it runs on screen: which drawing stands on which koma, and in which pose.
class Reel {
  // `length` is the number of koma of the film.
  constructor({ name, column, counts, koma, rounds, cells, drawings, sliding }, length) {
    Object.assign(this, { name, column, counts, rounds, cells, drawings, sliding });
    const own = [];
    cells.forEach(([, begin, held], cell) => { for (let at = begin; at < begin + held; at++) own[at] = cell; });
    // After its end it holds what stands there last. Blank koma have no cell.
    this.cellOf = Array.from({ length }, (_, at) => own[Math.min(at, koma - 1)]);
    // For each cell that of the key that stands there or before it.
    this.keyOf = [];
    cells.forEach((_, cell) => this.keyOf.push(this.isKey(cell) || cell === 0 ? cell : this.keyOf[cell - 1]));
  }

  isKey(cell) {
    return this.drawings[this.cells[cell][0]].role !== "inbetween";
  }

  cell(koma, keys = false) {
    const cell = this.cellOf[koma];
    return keys ? this.keyOf[cell] : cell;
  }

  drawing(koma, keys = false) {
    const cell = this.cell(koma, keys);
    return cell === undefined ? undefined : this.drawings[this.cells[cell][0]];
  }

  pose(koma, keys = false) {
    const drawing = this.drawing(koma, keys);
    if (!drawing || !this.sliding || keys) return drawing?.pose;
    return this.sliding[Math.min(koma - this.cells[0][1], this.sliding.length - 1)];
  }

  // The drawings before and after, with the names of their colours.
  skins(koma, keys = false) {
    const here = this.cell(koma, keys);
    if (here === undefined) return [];
    const neighbour = (cell, step) => {
      do cell += step; while (keys && cell >= 0 && cell < this.cells.length && !this.isKey(cell));
      return this.cells[cell];
    };
    const skins = [[neighbour(here, -1), "old"], [neighbour(here, 1), "young"]];
    return skins.filter(([cell]) => cell).map(([[drawing], color]) => [this.drawings[drawing].pose, color]);
  }

  // The koma on which drawings begin; only keys if asked.
  begins(keys = false) {
    return this.cells.filter((_, cell) => !keys || this.isKey(cell)).map(([, begin]) => begin);
  }
}

