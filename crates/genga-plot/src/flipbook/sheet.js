// The sheet: as bars under the stage, and as the columns of the paper that follow: genga in circles, drawings plain.
const ROW = 20;
const NAMES = 18;

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

// The koma at a height of the column.
function komaAt(y, koma, take, height) {
  return firstRow(koma, take, (height - NAMES) / ROW) + Math.floor((y - NAMES) / ROW);
}

function drawColumn(canvas, take, cellOf, koma, colors, names) {
  const [ctx, width, height] = prepared(canvas);
  const first = firstRow(koma, take, (height - NAMES) / ROW);
  const [action, cell] = [0.4 * width, 0.72 * width];
  ctx.textBaseline = "middle";
  ctx.textAlign = "center";
  ctx.font = "11px sans-serif";
  ctx.fillStyle = colors.faint;
  ctx.fillText(names[0], action, 0.45 * NAMES);
  ctx.fillText(names[1], cell, 0.45 * NAMES);
  for (let at = first; at < take.koma && NAMES + (at - first) * ROW < height; at++) {
    const y = NAMES + (at - first) * ROW;
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
    ctx.fillText(at + 1, 0.22 * width, y + 0.55 * ROW);
    if (at === begin) {
      drawGenga(ctx, take.drawings[drawing], [action, y + 0.5 * ROW], colors);
      drawNumber(ctx, take.drawings[drawing], [cell, y + 0.5 * ROW], colors);
    } else {
      for (const x of [action, cell]) drawHold(ctx, [x, y], at === begin + held - 1, colors);
    }
  }
}

// As the sheet's ACTION column has it: the genga's number in a circle, or the dot of an inbetween.
function drawGenga(ctx, drawing, [x, y], colors) {
  const color = roleColor(drawing.role, colors);
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

function drawHold(ctx, [x, y], ends, colors) {
  ctx.strokeStyle = colors.faint;
  ctx.lineWidth = 1.25;
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.lineTo(x, y + (ends ? 0.7 : 1) * ROW);
  ctx.stroke();
}

