// SPDX-License-Identifier: Apache-2.0
// The unrolled wall, put together in the browser: each channel's picture lies where its mesh says, and light adds up
// where pictures overlap, as on the wall. What a projector adds by itself (its black) is not in it.
import {t} from '/widgets.js';

const BETWEEN_MS = 200;  // five a second: as many as pictures come
const MOST_WIDTH = 960, MOST_WIDTH_PHONE = 640;
const decode = code => code <= 0.04045 ? code / 12.92 : ((code + 0.055) / 1.055) ** 2.4;
const encode = light => light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055;
const LIGHT = Float32Array.from({length: 256}, (_, code) => decode(code / 255));
const STEPS = 8192;  // of light, so that dark codes are told apart
const CODES = Uint8Array.from({length: STEPS + 1}, (_, step) => Math.round(255 * encode(step / STEPS)));

// The places of a mesh's points in pixels; null: nowhere near.
function pointsOf(mesh, width, height) {
  const bytes = Uint8Array.from(atob(mesh.places), letter => letter.charCodeAt(0));
  const numbers = new DataView(bytes.buffer);
  const share = at => numbers.getUint16(at, true) / 32768 - 0.5;
  return Array.from({length: mesh.columns * mesh.rows}, (_, i) =>
    numbers.getUint16(4 * i, true) === 65535 || numbers.getUint16(4 * i + 2, true) === 65535 ? null
      : [share(4 * i) * width, share(4 * i + 2) * height]);
}

// Calls visit(x, y, weights of the corners) for the pixels whose middles lie in a triangle.
function walkTriangle([a, b, c], width, height, visit) {
  const area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  if (!area) return;
  const from = (i, most) => Math.max(0, Math.min(most, Math.floor(Math.min(a[i], b[i], c[i]) - 0.5)));
  const to = (i, most) => Math.max(0, Math.min(most, Math.ceil(Math.max(a[i], b[i], c[i]) + 0.5)));
  for (let y = from(1, height); y < to(1, height); ++y)
    for (let x = from(0, width); x < to(0, width); ++x) {
      const right = x + 0.5 - a[0], down = y + 0.5 - a[1];
      const second = (right * (c[1] - a[1]) - down * (c[0] - a[0])) / area;
      const third = ((b[0] - a[0]) * down - (b[1] - a[1]) * right) / area;
      if (second > -1e-6 && third > -1e-6 && second + third < 1 + 1e-6) visit(x, y, second, third);
    }
}

// Which pixels of the panorama a channel lights, and from where in its picture (shares of it); each pixel once.
export function samplesOf(mesh, width, height) {
  const points = pointsOf(mesh, width, height);
  const taken = new Uint8Array(width * height);
  const places = [], across = [], down = [];
  const shareOf = i => [mesh.eyeWidth * (i % mesh.columns) / (mesh.columns - 1),
    mesh.eyeHeight * Math.floor(i / mesh.columns) / (mesh.rows - 1)];
  const triangle = corners => {
    const at = corners.map(i => points[i]);
    if (at.includes(null)) return;
    const xs = at.map(([x]) => x);
    if (Math.max(...xs) - Math.min(...xs) > width / 2) return;  // from one edge round to the other
    const [first, second, third] = corners.map(shareOf);
    walkTriangle(at, width, height, (x, y, b, c) => {
      const place = y * width + x;
      if (taken[place]) return;
      taken[place] = 1;
      places.push(place);
      across.push(first[0] + b * (second[0] - first[0]) + c * (third[0] - first[0]));
      down.push(first[1] + b * (second[1] - first[1]) + c * (third[1] - first[1]));
    });
  };
  for (let row = 0; row + 1 < mesh.rows; ++row)
    for (let column = 0; column + 1 < mesh.columns; ++column) {
      const corner = row * mesh.columns + column;
      triangle([corner, corner + 1, corner + mesh.columns]);
      triangle([corner + 1, corner + mesh.columns + 1, corner + mesh.columns]);
    }
  return {places: Uint32Array.from(places), across: Float32Array.from(across), down: Float32Array.from(down)};
}

// What a projector throws for the codes of its picture: of its own red, green and blue, and how much light of the
// wall's colours (linear Rec. 709) each of these is, row by row; without rows the two are the same.
function projectorOf({lightOfCodes, lightOfOwn}) {
  if (!lightOfCodes) return {own: [LIGHT, LIGHT, LIGHT], rows: null};
  const numbers = new DataView(Uint8Array.from(atob(lightOfCodes), letter => letter.charCodeAt(0)).buffer);
  const tableOf = primary => Float32Array.from({length: 256}, (_, code) => numbers.getUint16(2 * (256 * primary + code),
    true) / 65535);
  return {own: [0, 1, 2].map(tableOf), rows: lightOfOwn};
}

// Adds the light of a picture (codes of RGBA) where its samples lie.
function addLight(light, {places, across, down, projector: {own, rows}}, {data, width, height}) {
  const seen = [0, 0, 0];
  for (let i = 0; i < places.length; ++i) {
    const x = Math.min(Math.max(across[i] * width - 0.5, 0), width - 1.001);
    const y = Math.min(Math.max(down[i] * height - 0.5, 0), height - 1.001);
    const left = x | 0, top = y | 0, right = x - left, below = y - top;
    const a = 4 * (top * width + left), c = a + 4 * width;
    const out = 3 * places[i];
    for (let colour = 0; colour < 3; ++colour) {
      const table = own[colour];
      seen[colour] = (1 - below) * ((1 - right) * table[data[a + colour]] + right * table[data[a + 4 + colour]]) +
                     below * ((1 - right) * table[data[c + colour]] + right * table[data[c + 4 + colour]]);
    }
    for (let colour = 0; colour < 3; ++colour)
      light[out + colour] += rows ? rows[3 * colour] * seen[0] + rows[3 * colour + 1] * seen[1]
        + rows[3 * colour + 2] * seen[2] : seen[colour];
  }
}

export class Panorama {
  canvas = document.createElement('canvas');
  #message = null;
  #samples = [];
  #pictures = new Map();  // channel number -> {frame, at, image}
  #isDue = false;
  #drawnAt = -Infinity;

  // Of the console; made use of once.
  place(message) {
    if (message === this.#message || !message) return;
    this.#message = message;
    const width = Math.min(message.widthPx, innerWidth < 700 ? MOST_WIDTH_PHONE : MOST_WIDTH);
    const height = Math.max(1, Math.round(width * message.heightPx / message.widthPx));
    Object.assign(this.canvas, {width, height});
    this.#samples = message.meshes.map(mesh => ({...samplesOf(mesh, width, height), projector: projectorOf(mesh)}));
    this.#draw();
  }
  get isPlaced() { return this.#message !== null; }

  // The newest picture of a channel. Those that come together are drawn together, and no oftener than pictures come.
  take(channel, frame, image) {
    this.#pictures.set(channel, {frame, image, at: performance.now()});
    if (this.#isDue || !this.canvas.isConnected) return;
    this.#isDue = true;
    setTimeout(() => { this.#isDue = false; this.#draw(); },
      Math.max(60, this.#drawnAt + BETWEEN_MS - performance.now()));
  }

  #draw() {
    this.#drawnAt = performance.now();
    const {width, height} = this.canvas;
    const light = new Float32Array(3 * width * height);
    this.#samples.forEach((samples, channel) => {
      const picture = this.#pictures.get(channel);
      if (picture) addLight(light, samples, picture.image);
    });
    const drawn = new ImageData(width, height);
    for (let i = 0, to = 0; i < light.length; to += 4) {
      for (let colour = 0; colour < 3; ++colour) drawn.data[to + colour] = CODES[Math.max(0,
        Math.min(STEPS, light[i++] * STEPS + 0.5 | 0))];
      drawn.data[to + 3] = 255;
    }
    this.canvas.getContext('2d').putImageData(drawn, 0, 0);
  }

  // Which frames it shows, in words.
  get caption() {
    const shown = this.#samples.map((_, channel) => this.#pictures.get(channel));
    const frames = shown.filter(one => one && performance.now() - one.at < 5000).map(one => Number(one.frame));
    if (!frames.length) return shown.some(one => one) ? t('preview.noneNew') : t('preview.none');
    const first = Math.min(...frames), last = Math.max(...frames);
    const text = first === last ? t('preview.frame', {frame: first}) : t('preview.frames', {first, last});
    return frames.length < shown.length ? `${text} · ${t('preview.missing', {n: shown.length - frames.length})}` : text;
  }

  // The channel that shows most of a place (shares of the panorama), and where in its picture; null: none does.
  channelAt(x, y) {
    const {width, height} = this.canvas;
    const place = Math.min(height - 1, Math.floor(y * height)) * width + Math.min(width - 1, Math.floor(x * width));
    let best = null;
    this.#samples.forEach(({places, across, down}, channel) => {
      const i = places.indexOf(place);
      if (i < 0) return;
      const pull = across[i] * (1 - across[i]) * down[i] * (1 - down[i]);
      if (!best || pull > best.pull) best = {channel, pull, x: across[i], y: down[i],
        frame: this.#pictures.get(channel)?.frame};
    });
    return best;
  }
}
