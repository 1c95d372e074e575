// The sheets: as bars under the stage, and as the columns of the paper that follow: genga in circles, drawings plain.
const ROW = 20;
const NAMES = 18;

function roleColor(role, colors) {
  return { genga: colors.genga, end: colors.end, inbetween: colors.between }[role];
}

// A row of bars a sheet; between two of them a line where they differ.
function drawBars(canvas, take, reels, koma, colors) {
  const [ctx, width, height] = prepared(canvas);
  const one = width / take.koma;
  const high = reels.length === 1 ? height - 8 : 9;
  reels.forEach((reel, at) => {
    const top = reels.length === 1 ? 4 : at * (height - high - 4) + 2;
    for (const [drawing, begin, held] of reel.cells) {
      const role = reel.drawings[drawing].role;
      ctx.globalAlpha = role === "inbetween" ? 0.55 : 1;
      ctx.fillStyle = roleColor(role, colors);
      ctx.fillRect(begin * one, top, Math.max(held * one - (one >= 3 ? 1 : 0), 0.5), high);
    }
  });
  ctx.globalAlpha = 1;
  ctx.fillStyle = colors.ink;
  for (const [begin, held] of take.differences ?? []) ctx.fillRect(begin * one, height / 2 - 2, held * one, 4);
  ctx.fillRect((koma + 0.5) * one - 1, 0, 2, height);
}

// The koma in the middle of the column, as far as the sheet's ends allow.
function firstRow(koma, take, rows) {
  return Math.max(0, Math.min(koma - Math.floor(rows / 2), take.koma - Math.floor(rows)));
}

// The koma at a height of the columns.
function komaAt(y, koma, take, height) {
  return firstRow(koma, take, (height - NAMES) / ROW) + Math.floor((y - NAMES) / ROW);
}

// Where the koma ends and where ACTION and CELL of each sheet are, as shares of the width.
const COLUMNS = {
  1: { koma: 0.22, sheets: [[0.4, 0.72]] },
  2: { koma: 0.13, unlike: 0.18, sheets: [[0.27, 0.45], [0.65, 0.83]] },
};

function drawColumns(canvas, take, reels, koma, colors, names) {
  const [ctx, width, height] = prepared(canvas);
  const first = firstRow(koma, take, (height - NAMES) / ROW);
  const columns = COLUMNS[reels.length];
  ctx.textBaseline = "middle";
  ctx.textAlign = "center";
  ctx.font = "11px sans-serif";
  ctx.fillStyle = colors.faint;
  const places = reels.map((reel, of) => placesOf(reel, of, columns).map((x) => x * width));
  for (const sheet of places) sheet.forEach((x, at) => ctx.fillText(names[at], x, 0.45 * NAMES));
  for (let at = first; at < take.koma && NAMES + (at - first) * ROW < height; at++) {
    const y = NAMES + (at - first) * ROW;
    if (at === koma) {
      ctx.fillStyle = colors.here;
      ctx.fillRect(0, y, width, ROW);
    }
    ctx.strokeStyle = (at + 1) % 6 === 0 ? colors.faint : colors.edge;
    ctx.lineWidth = (at + 1) % Math.round(take.koma_rate) === 0 ? 1.5 : 0.5;
    ctx.beginPath();
    ctx.moveTo(0, y + ROW);
    ctx.lineTo(width, y + ROW);
    ctx.stroke();
    ctx.font = "11px sans-serif";
    ctx.textAlign = "right";
    ctx.fillStyle = colors.faint;
    ctx.fillText(at + 1, columns.koma * width, y + 0.55 * ROW);
    if (isDifferent(take, at)) {
      ctx.fillStyle = colors.ink;
      ctx.textAlign = "center";
      ctx.fillText("≠", columns.unlike * width, y + 0.55 * ROW);
    }
    reels.forEach((reel, of) => drawCells(ctx, reel, at, [places[of], y], colors));
  }
}

// Signs are wider than numbers.
function placesOf(reel, of, columns) {
  return !reel.column && columns.sheets.length === 1 ? [0.44, 0.81] : columns.sheets[of];
}

function isDifferent(take, koma) {
  return (take.differences ?? []).some(([begin, held]) => begin <= koma && koma < begin + held);
}

// The drawing's marks where it begins, and lines as long as its own sheet holds it.
function drawCells(ctx, reel, koma, [[action, cell], y], colors) {
  const at = reel.cell(koma);
  if (at === undefined) return;
  const [drawing, begin, held] = reel.cells[at];
  if (koma === begin) {
    drawGenga(ctx, reel.drawings[drawing], [action, y + 0.5 * ROW], colors);
    drawNumber(ctx, reel.drawings[drawing], [cell, y + 0.5 * ROW], colors);
  } else if (koma < begin + held) {
    for (const x of [action, cell]) drawHold(ctx, [x, y], koma === begin + held - 1, colors);
  }
}

// As the sheet's ACTION column has it: the genga's number in a circle, or the dot of an inbetween.
function drawGenga(ctx, drawing, [x, y], colors) {
  const color = roleColor(drawing.role, colors);
  if (isSign(drawing.genga)) {
    drawSign(ctx, drawing.genga, [x, y], color);
    return;
  }
  ctx.beginPath();
  ctx.arc(x, y, drawing.genga ? 0.46 * ROW : 2, 0, 2 * Math.PI);
  ctx.strokeStyle = ctx.fillStyle = drawing.genga ? color : colors.ink;
  ctx.lineWidth = 1.25;
  if (!drawing.genga || drawing.pinned) ctx.fill();
  if (!drawing.genga) return;
  ctx.stroke();
  ctx.textAlign = "center";
  ctx.font = `bold ${String(drawing.genga).length > 2 ? 9 : 11}px sans-serif`;
  ctx.fillStyle = drawing.pinned ? colors.paper : color;
  ctx.fillText(drawing.genga, x, y + 1);
}

// As the sheet's CELL column has it: the drawing's number, and how many were left out before it.
function drawNumber(ctx, drawing, [x, y], colors) {
  if (isSign(drawing.number)) {
    drawSign(ctx, drawing.number, [x, y], colors.ink);
    return;
  }
  ctx.textAlign = "center";
  ctx.font = drawing.genga ? "bold 12px sans-serif" : "12px sans-serif";
  ctx.fillStyle = colors.ink;
  ctx.fillText(drawing.number, x, y + 1);
  if (drawing.omitted > 0) {
    ctx.fillStyle = colors.genga;
    ctx.font = "11px sans-serif";
    ctx.fillText(`×${drawing.omitted}`, x + 1.4 * ROW, y + 1);
  }
}

// Whether a drawing of several columns is called by theirs, as "A2 C5", for which a circle has no room.
function isSign(called) {
  return called !== null && !/^\d+[a-z]*$/.test(called);
}

function drawSign(ctx, sign, [x, y], color) {
  ctx.textAlign = "center";
  ctx.font = "bold 9px sans-serif";
  ctx.fillStyle = color;
  ctx.fillText(sign, x, y + 1);
}

function drawHold(ctx, [x, y], ends, colors) {
  ctx.strokeStyle = colors.faint;
  ctx.lineWidth = 1.25;
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.lineTo(x, y + (ends ? 0.7 : 1) * ROW);
  ctx.stroke();
}

