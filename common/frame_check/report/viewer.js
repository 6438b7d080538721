// The stage: two frames and what differs between them, side by side, by a divider, in turn, or as a map; zoomed and
// moved together, with one marked pixel.
"use strict";

const modes = [
  { name: "side", label: "side by side" },
  { name: "swipe", label: "swipe" },
  { name: "blink", label: "blink" },
  { name: "difference", label: "difference" },
  { name: "flip", label: "FLIP" },
];
const zoomSteps = [1 / 8, 1 / 4, 1 / 2, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64];
const valuesFrom = 48; // pixels so large have room for their values

class Viewer {
  constructor(stage, onChange) {
    this.stage = stage;
    this.canvas = stage.querySelector("canvas");
    this.labels = document.getElementById("panes");
    this.onChange = onChange;
    this.mode = "side";
    this.divider = 0.5;
    this.showsNew = true;
    this.listen();
    new ResizeObserver(() => this.isFitted ? this.fit() : this.draw()).observe(stage);
  }

  // frame, reference: Frame or null; difference: canvas or null; flip: {canvas, at} or null.
  show(frame, reference, difference, flip) {
    Object.assign(this, { frame, reference, difference, flip });
    this.any = frame ?? reference;
    if (!this.allows(this.mode)) this.mode = "side";
    this.marked = { x: this.any.width >> 1, y: this.any.height >> 1 };
    this.isMarked = false;
    this.isFitted = true;
    this.setMode(this.mode);
  }

  allows(mode) {
    const both = this.frame && this.reference;
    return { side: true, swipe: both, blink: both, difference: this.difference, flip: this.flip }[mode];
  }

  setMode(mode) {
    if (!this.allows(mode)) return;
    this.mode = mode;
    clearInterval(this.timer);
    this.showsNew = true;
    if (mode === "blink") this.timer = setInterval(() => { this.showsNew = !this.showsNew; this.draw(); }, 500);
    if (this.isFitted) this.fit(); else this.draw();
  }

  // What stands beside each other: a canvas and its name.
  panes() {
    const named = { frame: { canvas: this.frame?.canvas, label: "new" },
      reference: { canvas: this.reference?.canvas, label: "reference" },
      difference: { canvas: this.difference, label: "difference" }, flip: { canvas: this.flip?.canvas, label: "FLIP" } };
    const names = { side: ["frame", "reference", "difference"], swipe: ["frame"], difference: ["difference"], flip: ["flip"],
      blink: [this.showsNew ? "frame" : "reference"] }[this.mode];
    return names.map((name) => named[name]).filter((pane) => pane.canvas);
  }

  // What a pane shows, with its size where the other one has another.
  labelOf(name) {
    const { frame, reference } = this;
    const pane = { new: frame, reference }[name];
    if (!pane || !frame || !reference || (frame.width === reference.width && frame.height === reference.height)) return name;
    return `${name}, ${pane.width}x${pane.height}`;
  }

  paneWidth() { return this.canvas.clientWidth / this.panes().length; }

  fit() {
    // All of the larger one: of two sizes, both stand at one scale from their upper left corners.
    const width = Math.max(this.frame?.width ?? 0, this.reference?.width ?? 0);
    const height = Math.max(this.frame?.height ?? 0, this.reference?.height ?? 0);
    const fitting = Math.min((this.paneWidth() - 8) / width, (this.canvas.clientHeight - 8) / height);
    this.scale = fitting > 1 ? Math.floor(fitting) : fitting;
    this.center = { x: width / 2, y: height / 2 };
    this.isFitted = true;
    this.draw();
  }

  // Keeps the point of the frame at (x, y) of its pane where it is.
  zoom(direction, x = this.paneWidth() / 2, y = this.canvas.clientHeight / 2) {
    const larger = zoomSteps.filter((step) => step > this.scale * 1.001);
    const smaller = zoomSteps.filter((step) => step < this.scale * 0.999);
    const scale = direction > 0 ? larger[0] : smaller[smaller.length - 1];
    if (scale === undefined) return;
    const from = { x: x - this.paneWidth() / 2, y: y - this.canvas.clientHeight / 2 };
    this.center.x += from.x / this.scale - from.x / scale;
    this.center.y += from.y / this.scale - from.y / scale;
    this.scale = scale;
    this.isFitted = false;
    this.draw();
  }

  mark(x, y, isFollowed = false) {
    this.marked = { x: Math.min(Math.max(x, 0), this.any.width - 1), y: Math.min(Math.max(y, 0), this.any.height - 1) };
    this.isMarked = true;
    if (isFollowed) {
      const width = this.paneWidth() / this.scale / 2 - 1;
      const height = this.canvas.clientHeight / this.scale / 2 - 1;
      if (Math.abs(this.marked.x + 0.5 - this.center.x) > width || Math.abs(this.marked.y + 0.5 - this.center.y) > height)
        this.center = { x: this.marked.x + 0.5, y: this.marked.y + 0.5 };
    }
    this.draw();
  }

  // Marks a pixel, near enough that its values stand in it.
  goTo(x, y) {
    this.scale = Math.max(this.scale, 16);
    this.isFitted = false;
    this.center = { x: x + 0.5, y: y + 0.5 };
    this.mark(x, y);
  }

  draw() {
    if (!this.any) return;
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    const context = this.canvas.getContext("2d");
    context.scale(ratio, ratio);
    const panes = this.panes();
    panes.forEach((pane, i) => this.drawPane(context, pane, i * width / panes.length, width / panes.length, height));
    context.fillStyle = "#000";
    for (let i = 1; i < panes.length; ++i) context.fillRect(Math.round(i * width / panes.length) - 2, 0, 4, height);
    if (this.mode === "swipe") this.drawSwipe(context, width, height);
    const labels = this.mode === "swipe" ? [[this.labelOf("new"), "left:.5em"], [this.labelOf("reference"), "right:.5em"]]
      : panes.map((pane, i) => [this.labelOf(pane.label), `left:calc(${100 * i / panes.length}% + .5em)`]);
    this.labels.replaceChildren(...labels.map(([text, style]) => {
      const label = document.createElement("span");
      label.textContent = text;
      label.style.cssText = style;
      return label;
    }));
    this.onChange();
  }

  drawPane(context, pane, left, width, height) {
    context.save();
    context.beginPath();
    context.rect(left, 0, width, height);
    context.clip();
    context.translate(left + width / 2 - this.center.x * this.scale, height / 2 - this.center.y * this.scale);
    // Smaller than it is, a frame is averaged: single pixels that differ must not fall between the screen's.
    context.imageSmoothingEnabled = this.scale < 1;
    context.drawImage(pane.canvas, 0, 0, pane.canvas.width * this.scale, pane.canvas.height * this.scale);
    if (this.scale >= valuesFrom) this.drawValues(context, pane, left, width, height);
    if (this.isMarked) this.drawMark(context);
    context.restore();
  }

  drawMark(context) {
    const size = Math.max(this.scale, 7);
    const [x, y] = [(this.marked.x + 0.5) * this.scale - size / 2, (this.marked.y + 0.5) * this.scale - size / 2];
    for (const [color, by] of [["#000", 1.5], ["#fff", 0.5]]) {
      context.strokeStyle = color;
      context.strokeRect(x - by, y - by, size + 2 * by, size + 2 * by);
    }
  }

  drawValues(context, pane, left, width, height) {
    const frame = { new: this.frame, reference: this.reference }[pane.label];
    if (!frame) return;
    context.font = "11px monospace";
    context.textAlign = "center";
    const half = { x: width / this.scale / 2 + 1, y: height / this.scale / 2 + 1 };
    for (let y = Math.floor(this.center.y - half.y); y <= this.center.y + half.y; ++y)
      for (let x = Math.floor(this.center.x - half.x); x <= this.center.x + half.x; ++x) {
        if (!frame.holds(x, y)) continue;
        const values = frame.channels(x, y);
        const sum = values[0] + values[1] + values[2];
        context.fillStyle = (frame.isLight ? sum * 255 : sum) > 380 ? "#000" : "#fff";
        values.forEach((value, i) => context.fillText(frame.isLight ? lightText(value).trim() : value,
          (x + 0.5) * this.scale, y * this.scale + 14 + 12 * i));
      }
  }

  drawSwipe(context, width, height) {
    const at = Math.round(this.divider * width);
    context.save();
    context.beginPath();
    context.rect(at, 0, width - at, height);
    context.clip();
    context.fillStyle = "#111";
    context.fillRect(at, 0, width - at, height);
    this.drawPane(context, { canvas: this.reference.canvas, label: "reference" }, 0, width, height);
    context.restore();
    context.fillStyle = "#fff";
    context.fillRect(at - 1, 0, 2, height);
    context.fillStyle = "#0009";
    context.fillRect(at - 3, 0, 2, height);
    context.fillRect(at + 1, 0, 2, height);
  }

  // Where in its pane an event is, and over which pixel.
  placeOf(event) {
    const box = this.canvas.getBoundingClientRect();
    const width = this.paneWidth();
    const place = { x: (event.clientX - box.left) % width, y: event.clientY - box.top, across: event.clientX - box.left };
    place.pixel = { x: Math.floor((place.x - width / 2) / this.scale + this.center.x),
      y: Math.floor((place.y - this.canvas.clientHeight / 2) / this.scale + this.center.y) };
    return place;
  }

  listen() {
    let held = null;
    this.canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      const place = this.placeOf(event);
      this.zoom(-event.deltaY, place.x, place.y);
    }, { passive: false });
    this.canvas.addEventListener("pointerdown", (event) => {
      const place = this.placeOf(event);
      const near = Math.abs(place.across - this.divider * this.canvas.clientWidth) < 10;
      held = { x: event.clientX, y: event.clientY, moved: false, divider: this.mode === "swipe" && near };
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      const place = this.placeOf(event);
      if (!held) {
        this.hovered = this.any?.holds(place.pixel.x, place.pixel.y) ? place.pixel : null;
        this.onChange();
        return;
      }
      const by = { x: event.clientX - held.x, y: event.clientY - held.y };
      if (!held.moved && Math.hypot(by.x, by.y) < 4) return;
      held.moved = true;
      if (held.divider) {
        this.moveDivider(place.across / this.canvas.clientWidth - this.divider);
        return;
      }
      this.center.x -= by.x / this.scale;
      this.center.y -= by.y / this.scale;
      Object.assign(held, { x: event.clientX, y: event.clientY });
      this.isFitted = false;
      this.draw();
    });
    this.canvas.addEventListener("pointerup", (event) => {
      const { pixel } = this.placeOf(event);
      if (held && !held.moved && this.any.holds(pixel.x, pixel.y)) this.mark(pixel.x, pixel.y);
      held = null;
    });
    this.canvas.addEventListener("pointerleave", () => { this.hovered = null; this.onChange(); });
  }

  moveDivider(by) {
    this.divider = Math.min(Math.max(this.divider + by, 0), 1);
    this.draw();
  }

  // In blink: the other picture, and it stays.
  turn() {
    clearInterval(this.timer);
    this.showsNew = !this.showsNew;
    this.draw();
  }
}
