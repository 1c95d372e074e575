// The sheets: as bars under the stage, and as the columns of the paper that follow.
const ROW = 20;

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

// Where the column of a sheet is, as a share of the width.
const columnOf = (reels, at) => (reels.length === 1 ? 0.62 : [0.42, 0.79][at]);

function drawColumn(canvas, take, reels, koma, colors) {
  const [ctx, width, height] = prepared(canvas);
  const first = firstRow(koma, take, height / ROW);
  ctx.textBaseline = "middle";
  for (let at = first; at < take.koma && (at - first) * ROW < height; at++) {
    const y = (at - first) * ROW;
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
    ctx.fillText(at + 1, reels.length === 1 ? 0.25 * width : 30, y + 0.55 * ROW);
    if (isDifferent(take, at)) {
      ctx.fillStyle = colors.ink;
      ctx.textAlign = "center";
      ctx.fillText("≠", 44, y + 0.55 * ROW);
    }
    reels.forEach((reel, of) => drawCell(ctx, reel, at, [columnOf(reels, of) * width, y], colors));
  }
}

function isDifferent(take, koma) {
  return (take.differences ?? []).some(([begin, held]) => begin <= koma && koma < begin + held);
}

// The drawing's mark where it begins, and a line as long as its own sheet holds it.
function drawCell(ctx, reel, koma, [x, y], colors) {
  const cell = reel.cell(koma);
  if (cell === undefined) return;
  const [drawing, begin, held] = reel.cells[cell];
  if (koma === begin) drawMark(ctx, reel.drawings[drawing], [x, y + 0.5 * ROW], colors);
  else if (koma < begin + held) drawHold(ctx, [x, y], koma === begin + held - 1, colors);
}

// As the sheet's CELL column has it: the drawing's number, in a circle if it is a key.
function drawMark(ctx, drawing, [x, y], colors) {
  const color = roleColor(drawing.role, colors);
  ctx.textAlign = "center";
  ctx.font = drawing.role === "inbetween" ? "12px sans-serif" : "bold 11px sans-serif";
  if (drawing.role !== "inbetween") {
    ctx.beginPath();
    ctx.arc(x, y, 0.44 * ROW, 0, 2 * Math.PI);
    ctx.strokeStyle = ctx.fillStyle = color;
    ctx.lineWidth = 1.25;
    ctx.stroke();
    if (drawing.pinned) ctx.fill();
  }
  ctx.fillStyle = drawing.role === "inbetween" ? colors.ink : drawing.pinned ? colors.paper : color;
  ctx.fillText(drawing.number, x, y + 1);
  if (drawing.omitted > 0) {
    ctx.fillStyle = colors.genga;
    ctx.font = "10px sans-serif";
    ctx.fillText(`×${drawing.omitted}`, x + 1.6 * ROW, y + 1);
  }
}

function drawHold(ctx, [x, y], ends, colors) {
  ctx.strokeStyle = colors.faint;
  ctx.lineWidth = 1.25;
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.lineTo(x, y + (ends ? 0.7 : 1) * ROW);
  ctx.stroke();
}

