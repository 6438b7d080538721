// Pictures of the report: decoding them without changing a value, and the maps that are made of two.
"use strict";

const mostCodes = 255;

function blobOf(id) {
  const element = document.getElementById(id);
  const text = atob(element.textContent);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return new Blob([bytes], { type: element.dataset.type });
}

function urlOf(id) {
  const element = document.getElementById(id);
  return `data:${element.dataset.type};base64,${element.textContent}`;
}

function newCanvas(width, height) {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  return canvas;
}

// The values as they are in the file: no color management, and nothing has alpha in one picture with its colors.
async function rgbaOf(id) {
  const bitmap = await createImageBitmap(blobOf(id), { premultiplyAlpha: "none", colorSpaceConversion: "none" });
  const canvas = newCanvas(bitmap.width, bitmap.height);
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.drawImage(bitmap, 0, 0);
  return context.getImageData(0, 0, bitmap.width, bitmap.height);
}

function fromHalf(bits) {
  const fraction = bits & 1023;
  const exponent = (bits >> 10) & 31;
  const sign = bits & 32768 ? -1 : 1;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15));
}

function srgbEncoded(x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
}

// Codes of linear light, as frame_check counts them: sRGB's up to 1, and a logarithm as steep beyond.
function codeOf(light) {
  const x = Math.abs(light);
  const code = mostCodes * (x <= 1 ? srgbEncoded(x) : 1 + (1.055 / 2.4) * Math.log(x));
  return light < 0 ? -code : code;
}

// One frame: values[4 * (y * width + x) + channel] of red, green, blue and alpha.
class Frame {
  static async load(description) {
    const frame = new Frame();
    const color = await rgbaOf(description.color);
    frame.width = color.width;
    frame.height = color.height;
    frame.isLight = description.low !== undefined;
    frame.hasAlpha = description.alpha !== undefined;
    frame.values = color.data;
    if (frame.isLight) {
      const low = (await rgbaOf(description.low)).data;
      frame.values = Float32Array.from(color.data, (high, i) => fromHalf(high * 256 + low[i]));
    }
    frame.alpha = frame.hasAlpha ? (await rgbaOf(description.alpha)).data : null;
    frame.canvas = newCanvas(frame.width, frame.height);
    frame.context = frame.canvas.getContext("2d", { willReadFrequently: true });
    frame.expose(0);
    return frame;
  }

  // Draws what a display shows of it.
  expose(ev) {
    const shown = new ImageData(this.width, this.height);
    for (let i = 0; i < shown.data.length; ++i)
      shown.data[i] = i % 4 === 3 ? 255
        : this.isLight ? mostCodes * srgbEncoded(Math.min(Math.max(this.values[i] * 2 ** ev, 0), 1)) : this.values[i];
    this.context.putImageData(shown, 0, 0);
  }

  channels(x, y) {
    const at = 4 * (y * this.width + x);
    const values = [this.values[at], this.values[at + 1], this.values[at + 2]];
    if (!this.hasAlpha) return values;
    return [...values, this.isLight ? this.alpha[at] / 255 : this.alpha[at]];
  }

  holds(x, y) { return x >= 0 && y >= 0 && x < this.width && y < this.height; }

  text(x, y) {
    if (!this.holds(x, y)) return "";
    return this.channels(x, y).map((v) => this.isLight ? lightText(v) : String(v).padStart(4)).join(" ");
  }

  // As CSS has it.
  colorAt(x, y) {
    const [r, g, b] = this.context.getImageData(x, y, 1, 1).data;
    return `rgb(${r} ${g} ${b})`;
  }
}

function lightText(value) {
  return (Number.isFinite(value) ? Number(value.toPrecision(4)).toString() : String(value)).padStart(9);
}

// By how many codes a pixel differs: the channel that differs most.
function codesBetween(one, other, x, y) {
  const a = one.channels(x, y);
  const b = other.channels(x, y);
  let largest = 0;
  for (let i = 0; i < a.length; ++i) {
    if (a[i] === b[i] || (Number.isNaN(a[i]) && Number.isNaN(b[i]))) continue;
    if (!one.isLight) largest = Math.max(largest, Math.abs(a[i] - b[i]));
    else if (!Number.isFinite(a[i]) || !Number.isFinite(b[i])) largest = mostCodes;
    else largest = Math.max(largest, Math.abs(codeOf(a[i]) - codeOf(b[i])));
  }
  return Math.min(Math.ceil(largest), mostCodes);
}

// Ramps that get lighter all the way, so that more is always lighter, for whatever eyes.
function rampOf(stops) {
  return (t) => {
    const place = Math.min(Math.max(t, 0), 1) * (stops.length - 1);
    const from = Math.min(Math.floor(place), stops.length - 2);
    return stops[from].map((v, i) => Math.round(v + (stops[from + 1][i] - v) * (place - from)));
  };
}
const differenceRamp = rampOf([[72, 62, 190], [150, 52, 150], [214, 62, 92], [246, 136, 44], [252, 206, 72], [255, 255, 235]]);
const flipRamp = rampOf([[0, 0, 0], [71, 26, 140], [204, 46, 92], [255, 166, 51], [255, 255, 204]]);

// Codes by their logarithm, 1 to 255 from one end of the ramp to the other: nothing saturates.
function differencePlace(codes) { return Math.log(codes) / Math.log(mostCodes); }
function differenceColor(codes) { return codes === 0 ? [0, 0, 0] : differenceRamp(differencePlace(codes)); }

function differenceCanvas(one, other) {
  const canvas = newCanvas(one.width, one.height);
  const map = new ImageData(one.width, one.height);
  for (let y = 0, at = 0; y < one.height; ++y)
    for (let x = 0; x < one.width; ++x, at += 4)
      map.data.set([...differenceColor(codesBetween(one, other, x, y)), 255], at);
  canvas.getContext("2d").putImageData(map, 0, 0);
  return canvas;
}

// From the map's bytes, which are FLIP times 255; `values` are kept to be read.
async function flipMapOf(id) {
  const bytes = await rgbaOf(id);
  const canvas = newCanvas(bytes.width, bytes.height);
  const map = new ImageData(bytes.width, bytes.height);
  for (let at = 0; at < map.data.length; at += 4)
    map.data.set([...flipRamp(bytes.data[at] / 255), 255], at);
  canvas.getContext("2d").putImageData(map, 0, 0);
  return { canvas, at: (x, y) => bytes.data[4 * (y * bytes.width + x)] / 255 };
}

function rampStyle(ramp) {
  const colors = Array.from({ length: 33 }, (_, i) => `rgb(${ramp(i / 32).join(" ")})`);
  return `linear-gradient(to right, ${colors.join(", ")})`;
}
