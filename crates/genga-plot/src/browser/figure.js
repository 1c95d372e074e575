// A canvas of the size it has on the page, sharp on every screen, empty.
function prepared(canvas) {
  const box = canvas.getBoundingClientRect();
  const sharp = window.devicePixelRatio || 1;
  const [width, height] = [Math.max(1, Math.round(box.width * sharp)), Math.max(1, Math.round(box.height * sharp))];
  if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
  const ctx = canvas.getContext("2d");
  ctx.setTransform(sharp, 0, 0, sharp, 0, 0);
  ctx.clearRect(0, 0, box.width, box.height);
  return [ctx, box.width, box.height];
}

// Figures on a canvas, drawn as the pictures draw them: from the far to the near.
class Stage {
  // A figure with its height and points, all poses that it takes on, and from where it is seen.
  constructor(take, poses, view) {
    this.take = take;
    this.poses = poses;
    this.follow = false;
    this.look(view);
  }

  // Right, up and near; turned by an angle about up.
  look([right, up, near], angle = 0) {
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    this.right = right.map((r, i) => c * r + s * near[i]);
    this.near = near.map((n, i) => c * n - s * right[i]);
    this.up = up;
    this.box = null;
  }

  goAlong(follow) {
    this.follow = follow;
    this.box = null;
  }

  along(axis, pose, point) {
    const at = 3 * point;
    return axis[0] * pose[at] + axis[1] * pose[at + 1] + axis[2] * pose[at + 2];
  }

  middle(pose) {
    return this.follow ? this.along(this.right, pose, 0) : 0;
  }

  // The box round all poses, so that nothing moves but the figure.
  bounds() {
    if (this.box) return this.box;
    const box = { left: Infinity, right: -Infinity, low: Infinity, high: -Infinity };
    for (const pose of this.poses) {
      const middle = this.middle(pose);
      for (let point = 0; point < this.take.points; point++) {
        const x = this.along(this.right, pose, point) - middle;
        const y = this.along(this.up, pose, point);
        box.left = Math.min(box.left, x); box.right = Math.max(box.right, x);
        box.low = Math.min(box.low, y); box.high = Math.max(box.high, y);
      }
    }
    const head = 0.09 * this.take.height;
    box.left -= head; box.right += head; box.high += head;
    return (this.box = box);
  }

  isFar() {
    const box = this.bounds();
    return box.right - box.left > 1.8 * (box.high - box.low);
  }

  // Puts the box into a picture of a size, below a caption.
  fit(width, height) {
    const box = this.bounds();
    const [pad, top] = height < 300 ? [8, 26] : [18, 44];
    const scale = Math.min((width - 2 * pad) / (box.right - box.left), (height - top - 2 * pad) / (box.high - box.low || 1));
    this.scale = Math.min(scale, 1e6);
    this.x = width / 2 - 0.5 * (box.left + box.right) * this.scale;
    // What room is left over goes above and below.
    const left = height - top - 2 * pad - (box.high - box.low) * this.scale;
    this.floor = height - 1.5 * pad - 0.4 * Math.max(0, left);
    this.low = box.low;
  }

  place(pose, point, middle) {
    return [
      this.x + (this.along(this.right, pose, point) - middle) * this.scale,
      this.floor - (this.along(this.up, pose, point) - this.low) * this.scale,
    ];
  }

  drawFloor(ctx, width, pose, color) {
    ctx.strokeStyle = color;
    ctx.lineWidth = 1.25;
    ctx.beginPath();
    ctx.moveTo(12, this.floor);
    ctx.lineTo(width - 12, this.floor);
    if (this.follow) {
      // Marks half a body's height apart: without them nobody would see that it goes.
      const step = 0.5 * this.take.height;
      const middle = this.middle(pose);
      const from = Math.ceil((middle - this.x / this.scale) / step);
      for (let tick = from; tick < from + 100; tick++) {
        const x = this.x + (tick * step - middle) * this.scale;
        if (x > width - 12) break;
        if (x < 12) continue;
        ctx.moveTo(x, this.floor);
        ctx.lineTo(x - 6, this.floor + 8);
      }
    }
    ctx.stroke();
  }

  // Colours: trunk, left, right, paper, guide.
  draw(ctx, pose, colors, middle = this.middle(pose)) {
    const { bones, head, guides, parts } = this.take.figure;
    const size = Math.min(Math.max((this.scale * this.take.height) / 170, 0.4), 3);
    ctx.lineCap = ctx.lineJoin = "round";
    for (const [from, to] of guides) this.drawLine(ctx, pose, from, to, colors[4], Math.max(0.6, size), middle);
    if (parts.length) return this.drawParts(ctx, pose, colors, size, middle);
    const depth = ([from, to]) => this.along(this.near, pose, from) + this.along(this.near, pose, to);
    for (const [from, to, side] of bones.slice().sort((a, b) => depth(a) - depth(b))) {
      const long = Math.hypot(...[0, 1, 2].map((i) => pose[3 * to + i] - pose[3 * from + i]));
      const width = side === 0 ? 5 : long < 0.035 * this.take.height ? 1.5 : 3.25;
      this.drawLine(ctx, pose, from, to, colors[side], Math.max(1, width * size), middle);
    }
    if (head) this.drawHead(ctx, pose, head, colors, middle);
    if (bones.length === 0) this.drawDot(ctx, this.place(pose, 0, middle), 4, colors[0]);
  }

  drawLine(ctx, pose, from, to, color, width, middle) {
    ctx.strokeStyle = color;
    ctx.lineWidth = width;
    ctx.beginPath();
    ctx.moveTo(...this.place(pose, from, middle));
    ctx.lineTo(...this.place(pose, to, middle));
    ctx.stroke();
  }

  // A lay figure: the furthest part first, each with the lines on it that look this way.
  drawParts(ctx, pose, colors, size, middle) {
    const { parts, balls, lines } = this.take.figure;
    const depth = ([first, count, , nearer]) => {
      let sum = nearer * count;
      for (let ball = first; ball < first + count; ball++) sum += this.along(this.near, pose, balls + ball);
      return sum / count;
    };
    const order = parts.map((part, at) => [depth(part), at]).sort((a, b) => a[0] - b[0] || a[1] - b[1]);
    for (const [, at] of order) {
      const side = parts[at][2];
      ctx.beginPath();
      for (const point of this.outline(pose, parts[at], middle)) ctx.lineTo(...point);
      ctx.closePath();
      ctx.fillStyle = colors[3];
      ctx.fill();
      if (side !== 0) {
        ctx.globalAlpha = 0.14;
        ctx.fillStyle = colors[side];
        ctx.fill();
        ctx.globalAlpha = 1;
      }
      ctx.strokeStyle = colors[side];
      ctx.lineWidth = Math.max(0.7, 1.35 * size);
      ctx.stroke();
      for (const [from, to, part, front, least] of lines) {
        const looks = this.along(this.near, pose, this.take.points + front);
        if (part === at && looks >= least) this.drawLine(ctx, pose, from, to, colors[side], Math.max(0.6, 1.1 * size), middle);
      }
    }
  }

  // The band round the balls of a part.
  outline(pose, [first, count], middle) {
    const { balls, radii } = this.take.figure;
    const circles = [];
    for (let ball = first; ball < first + count; ball++) {
      circles.push([...this.place(pose, balls + ball, middle), radii[ball] * this.scale]);
    }
    const directions = 20;
    return Array.from({ length: directions }, (_, step) => {
      const angle = ((step + 0.5) * 2 * Math.PI) / directions;
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      const reach = ([x, y, radius]) => x * c + y * s + radius;
      const [x, y, radius] = circles.reduce((far, circle) => (reach(circle) > reach(far) ? circle : far));
      return [x + radius * c, y + radius * s];
    });
  }

  drawHead(ctx, pose, [joint, end], colors, middle) {
    const long = Math.hypot(...[0, 1, 2].map((i) => pose[3 * end + i] - pose[3 * joint + i]));
    const { height } = this.take;
    const radius = Math.min(Math.max(0.55 * long, 0.045 * height), 0.085 * height) * this.scale;
    const [a, b] = [this.place(pose, joint, middle), this.place(pose, end, middle)];
    ctx.beginPath();
    ctx.arc(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), radius, 0, 2 * Math.PI);
    ctx.fillStyle = colors[3];
    ctx.fill();
    ctx.strokeStyle = colors[0];
    ctx.lineWidth = Math.min(Math.max(0.24 * radius, 0.8), 4);
    ctx.stroke();
  }

  drawDot(ctx, [x, y], radius, color) {
    ctx.beginPath();
    ctx.arc(x, y, radius, 0, 2 * Math.PI);
    ctx.fillStyle = color;
    ctx.fill();
  }
}

