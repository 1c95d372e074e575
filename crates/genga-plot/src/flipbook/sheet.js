// The sheet: as bars under the stage, and as the column of the paper that follows.
const ROW = 20;

function roleColor(role, colors) {
  return { genga: colors.genga, end: colors.end, inbetween: colors.between }[role];
}

function drawBars(canvas, take, koma, colors) {
  const [ctx, width, height] = prepared(canvas);
  const one = width / take.koma;
  for (const [drawing, begin, held] of take.cells) {
    const role = take.drawings[drawing].role;
    ctx.globalAlpha = role === "inbetween" ? 0.55 : 1;
    ctx.fillStyle = roleColor(role, colors);
    ctx.fillRect(begin * one, 4, Math.max(held * one - (one >= 3 ? 1 : 0), 0.5), height - 8);
  }
  ctx.globalAlpha = 1;
  ctx.fillStyle = colors.ink;
  ctx.fillRect((koma + 0.5) * one - 1, 0, 2, height);
}

// The koma in the middle of the column, as far as the sheet's ends allow.
function firstRow(koma, take, rows) {
  return Math.max(0, Math.min(koma - Math.floor(rows / 2), take.koma - Math.floor(rows)));
}

function drawColumn(canvas, take, cellOf, koma, colors) {
  const [ctx, width, height] = prepared(canvas);
  const first = firstRow(koma, take, height / ROW);
  const middle = 0.62 * width;
  ctx.textBaseline = "middle";
  for (let at = first; at < take.koma && (at - first) * ROW < height; at++) {
    const y = (at - first) * ROW;
    const [drawing, begin, held] = take.cells[cellOf[at]];
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
    ctx.fillText(at + 1, 0.25 * width, y + 0.55 * ROW);
    if (at === begin) drawMark(ctx, take.drawings[drawing], take.drawings[drawing].number ?? drawing + 1, [middle, y + 0.5 * ROW], colors);
    else drawHold(ctx, [middle, y], at === begin + held - 1, colors);
  }
}

// As the sheet's CELL column has it: the drawing's number, in a circle if it is a key.
function drawMark(ctx, drawing, number, [x, y], colors) {
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
  ctx.fillText(number, x, y + 1);
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

