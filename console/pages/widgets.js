// SPDX-License-Identifier: Apache-2.0
// Parts of pages: texts, buttons that are held, previews, plots.
import {html, svg, nothing} from '/vendor/lit-html.js';
import {Panorama} from '/panorama.js';

// --- texts, one file a language

let texts = {};
export const languages = {en: 'English', de: 'Deutsch'};
export const language = () => {
  const wanted = localStorage.getItem('language') ?? navigator.language.slice(0, 2);
  return wanted in languages ? wanted : 'en';
};
export async function loadTexts() {
  texts = await (await fetch(`/texts/${language()}.json`)).json();
  document.documentElement.lang = language();
}
// t('nodes.late', {n: 3}); a text that is missing shows its name. Where n is one, the text NAME.one goes before.
export const t = (name, values = {}) =>
  ((Number(values.n) === 1 && texts[`${name}.one`]) || (texts[name] ?? name)).replace(/\{(\w+)\}/g,
    (_, key) => values[key] ?? '');
// Words that the console says in English, such as "in step".
export const word = text => texts[`word.${text}`] ?? text;
// Of a species, as people say it.
export const speciesName = name => texts[`word.${name}`] ?? name.replaceAll('_', ' ');

// --- buttons

// Acts only after it was held for a second, by pointer, Enter or space. `of` tells buttons of one label apart.
export function holdButton(label, act, {disabled = false, primary = false, of = nothing} = {}) {
  const begin = event => {
    const button = event.currentTarget;
    if (event.type === 'keydown' && (event.repeat || !['Enter', ' '].includes(event.key))) return;
    if (event.type === 'keydown') event.preventDefault();
    if (button.timer || button.disabled) return;
    button.classList.add('holding');
    button.timer = setTimeout(() => { stop(button); act(); }, 1000);
  };
  const stop = button => {
    clearTimeout(button.timer);
    button.timer = null;
    button.classList.remove('holding');
  };
  const end = event => stop(event.currentTarget);
  return html`<button class="hold ${primary ? 'primary' : ''}" data-of=${of} ?disabled=${disabled}
    title=${t('hold.hint')} aria-description=${t('hold.hint')}
    @pointerdown=${begin} @pointerup=${end} @pointerleave=${end} @pointercancel=${end} @blur=${end}
    @keydown=${begin} @keyup=${end} @contextmenu=${event => event.preventDefault()}><span>${label}</span></button>`;
}

export const button = (label, act, {disabled = false, pressed, of = nothing} = {}) =>
  html`<button data-of=${of} ?disabled=${disabled} aria-pressed=${pressed ?? nothing} @click=${act}>${label}</button>`;

// --- what is chosen from a list

export const QUALITIES = ['low', 'medium', 'high', 'ultra', 'auto'];
export const PATTERNS = ['world', 'grid', 'grey'];
export const DAYS = ['clock', 'dawn', 'morning', 'noon', 'afternoon', 'sunset', 'dusk', 'night', 'first light'];
// The quality and the pattern that the wall shows, as in the lists above; undefined before a master was heard.
export const qualityOf = link => QUALITIES[link.shown.quality];
export const patternOf = link => link.shown.pattern?.replace('PATTERN_', '').toLowerCase();
// The time of day that is wanted: FIRST_LIGHT is "first light".
export const dayOf = link => (link.status.day ?? 'CLOCK').toLowerCase().replace('_', ' ');
// The condition of a NodeStatus, as in SHAPES: NODE_IN_STEP is "in step".
export const conditionOf = node => node.condition.replace('NODE_', '').toLowerCase().replace('_', ' ');
// That of a JournalStatus: NOT_KEPT is "not kept".
export const journalOf = journal => journal.condition.toLowerCase().replace('_', ' ');
export const channelsOf = link => link.known.snapshot?.channels ?? [];
export const namesOf = link => channelsOf(link).map(channel => channel.name);
// What the page of the log shows; the nodes' page sets it too.
export const filter = {logNode: '', logText: '', logProblemsOnly: false};

const wish = {};  // what was chosen in a list and not yet shown
export function chooser(link, what, values, shown, act) {
  const chosen = wish[what] ?? shown;
  const choose = event => { wish[what] = event.target.value; link.dispatchEvent(new Event('change')); };
  const done = () => { act(chosen); delete wish[what]; };
  return html`<label for=${what}>${t(`wall.${what}`)}</label>
    <select id=${what} ?disabled=${!link.may('OPERATOR')} @change=${choose}>
      ${values.map(value => html`<option value=${value}
        .selected=${value === chosen}>${word(value)}</option>`)}</select>
    ${holdButton(t('wall.apply'), done, {disabled: !link.may('OPERATOR') || chosen === shown, of: what})}`;
}
export const patternChooser = link =>
  chooser(link, 'pattern', PATTERNS, patternOf(link), value => link.show({pattern: value.toUpperCase()},
    `${t('wall.pattern')}: ${word(value)}`));

// --- a share that is set while one looks

export const percentOf = share => `${Math.round(100 * share)} %`;
// Told when the hand lets go. `shown` is followed while nobody moves it, and three seconds at most after that: so long
// the wall may take to show what was set.
export function slider(link, what, shown, act) {
  const wished = wish[what];
  const value = wished && wished.instead === shown && Date.now() < wished.until ? wished.value : shown;
  const move = (event, seconds) => {
    wish[what] = {value: Number(event.target.value), instead: shown, until: Date.now() + 1000 * seconds};
    link.dispatchEvent(new Event('change'));
  };
  const set = event => { move(event, 3); act(Number(event.target.value)); };
  return html`<label for=${what}>${t(`wall.${what}`)}</label>
    <input id=${what} type="range" min="0" max="1" step="0.05" .value=${String(value)}
      ?disabled=${!link.may('OPERATOR')} @input=${event => move(event, 60)} @change=${set}>
    <output for=${what}>${percentOf(value)}</output>`;
}

// --- what is said in words

export const time = seconds => new Date(seconds * 1000).toLocaleTimeString(language());
export const dateTime = seconds => new Date(seconds * 1000).toLocaleString(language());
export const ms = (value, digits = 1) => `${(value ?? 0).toFixed(digits)} ms`;

// Amounts as `aquarama status` has them: "3 min", "1.4 GB"; a tick as a time of the world: "1:02:03".
export const durationOf = seconds => seconds < 120 ? `${seconds.toFixed(0)} s`
  : seconds < 7200 ? `${(seconds / 60).toFixed(0)} min` : `${(seconds / 3600).toFixed(0)} h`;
export const sizeOf = bytes => {
  const unit = Math.min(4, Math.max(1, Math.floor(Math.log10(Math.max(1, bytes)) / 3)));
  const amount = bytes / 1000 ** unit;
  return `${amount.toFixed(unit > 2 && amount < 10 ? 1 : 0)} ${['', 'kB', 'MB', 'GB', 'TB'][unit]}`;
};
export const timeOfTick = tick => {
  const seconds = Math.floor(tick / 60), two = number => String(number % 60).padStart(2, '0');
  return `${Math.floor(seconds / 3600)}:${two(Math.floor(seconds / 60))}:${two(seconds)}`;
};

// A state as shape and word: [shape, class].
const SHAPES = {'in step': ['●', 'good'], late: ['▲', 'warn'], preparing: ['◐', 'warn'], absent: ['✖', 'bad'],
                pass: ['●', 'good'], warn: ['▲', 'warn'], fail: ['✖', 'bad'],
                firing: ['✖', 'bad'], over: ['◌', 'warn'], acknowledged: ['✓', 'quiet'],
                'in place': ['●', 'good'], moved: ['✖', 'bad'], 'not seen': ['▲', 'warn'], refuse: ['✖', 'bad'],
                WAITING: ['◐', 'warn'], SWIMMING: ['●', 'good'], HOMELESS: ['▲', 'warn'], LEAVING: ['◌', 'quiet'],
                written: ['●', 'good'], waiting: ['▲', 'warn'], paused: ['✖', 'bad'], 'not kept': ['·', 'quiet'],
                refused: ['✖', 'bad'], 'simulates along': ['●', 'good'], nobody: ['✖', 'bad'],
                info: ['·', 'quiet'], warning: ['▲', 'warn'], error: ['✖', 'bad']};
export const state = name => {
  const [shape, kind] = SHAPES[name] ?? ['?', 'quiet'];
  return html`<span class=${kind}><span aria-hidden="true">${shape}</span> ${word(name)}</span>`;
};

// --- previews: the latest picture of each channel, kept outside of what is rendered

const canvases = new Map();  // channel number -> {canvas, frame, at}
const panorama = new Panorama();
export function previewOf(number, width, height) {
  let preview = canvases.get(number);
  if (!preview) {
    const canvas = document.createElement('canvas');
    canvas.width = width;
    canvas.height = height;
    preview = {canvas, frame: null, at: -Infinity};
    canvases.set(number, preview);
  }
  return preview;
}
export async function showPicture(link, {channel, frame, jpeg}) {
  const preview = canvases.get(channel);
  if (preview?.canvas.isConnected || panorama.canvas.isConnected) {
    try {
      const picture = await createImageBitmap(jpeg);
      if (preview.canvas.width !== picture.width) {
        preview.canvas.width = picture.width;
        preview.canvas.height = picture.height;
      }
      const context = preview.canvas.getContext('2d', {willReadFrequently: true});
      context.drawImage(picture, 0, 0);
      panorama.take(channel, frame, context.getImageData(0, 0, picture.width, picture.height));
      picture.close();
      Object.assign(preview, {frame, at: performance.now()});
    } catch { /* cut off: the next one comes */ }
  }
  link.seen(channel);
}
// The unrolled wall. onPoint is told the channel's number, its frame, and the place in its picture that was clicked.
export function wholeWall(link, onPoint) {
  const {channels} = link.known.snapshot;
  channels.forEach((channel, number) => previewOf(number, channel.widthPx, channel.heightPx));
  panorama.place(link.known.panorama);
  const {canvas} = panorama;
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', t('preview.wall'));
  canvas.onclick = onPoint ? event => {
    const place = canvas.getBoundingClientRect();
    const found = panorama.channelAt((event.clientX - place.left) / place.width,
      (event.clientY - place.top) / place.height);
    if (found?.frame) onPoint(channels[found.channel], found);
  } : null;
  return html`<figure class="whole">${canvas}<figcaption>${panorama.isPlaced ? panorama.caption
    : t('preview.none')}</figcaption></figure>`;
}
export const views = channels => html`<div class="views">${channels.map((channel, number) => {
  const preview = previewOf(number, channel.widthPx, channel.heightPx);
  preview.canvas.setAttribute('role', 'img');
  preview.canvas.setAttribute('aria-label', t('preview.of', {name: channel.name}));
  const old = performance.now() - preview.at;
  const caption = preview.frame === null ? t('preview.none') : t(old > 5000 ? 'preview.old' : 'preview.frame',
    {frame: preview.frame});
  return html`<figure>${preview.canvas}<figcaption>${channel.name} · ${caption}</figcaption></figure>`;
})}</div>`;

// --- plots

const EDGES = ['0.05', '0.1', '0.2', '0.5', '1', '2', '5', '10', '∞'];
export function skewBars(counts = []) {
  const most = Math.max(1, ...counts);
  const total = counts.reduce((sum, count) => sum + count, 0);
  const label = t('skew.label', {list: counts.map((count, i) => `≤ ${EDGES[i]} ms: ${count}`).join(', ')});
  const bar = (count, i) => svg`<g><rect x=${i * 50 + 8} width="34" y=${110 - 90 * count / most}
    height=${90 * count / most}></rect>
    <text x=${i * 50 + 25} y=${104 - 90 * count / most} text-anchor="middle">${count || ''}</text>
    <text x=${i * 50 + 25} y="124" text-anchor="middle">${EDGES[i]}</text></g>`;
  return html`<svg class="bars" viewBox="0 0 450 130" role="img" aria-label=${label}>${counts.map(bar)}</svg>
    <p class="note">${t('skew.note', {n: total})}</p>`;
}

// One plot, made once and fed again. Axes have the page's own colours.
const COLOURS = ['#2f7fb5', '#c2571a', '#3d8f4f', '#8b5fbf', '#b04a6c', '#7a7a1f', '#2a8c8c', '#666f7a'];
export class Plot {
  element = Object.assign(document.createElement('div'), {className: 'plot'});
  #plot = null;
  #names = '';
  isEmpty = true;
  constructor(stepSeconds) { this.step = stepSeconds; }
  // series: [{name, values in ms, null where there are none}], all of one length at their newest end.
  show(series) {
    const wide = this.element.clientWidth;
    this.isEmpty = !series.some(one => one.values.some(value => value !== null));
    if (!wide || this.isEmpty) return;
    const names = series.map(one => one.name).join();
    const colour = getComputedStyle(document.body).color;
    if (names !== this.#names || this.colour !== colour) {
      this.#plot?.destroy();
      this.#names = names;
      this.colour = colour;
      const axis = {stroke: colour, grid: {stroke: '#8884', width: 1}, ticks: {stroke: '#8888'}};
      this.#plot = new uPlot({
        width: wide, height: 200,
          scales: {x: {time: true}, y: {range: (_, low, high) => [0, Math.max(0.01, high * 1.1)]}},
        axes: [axis, {...axis, values: (_, ticks) => ticks.map(tick => `${tick} ms`), size: 74}],
        series: [{}, ...series.map((one, i) => ({label: one.name, stroke: COLOURS[i % COLOURS.length], width: 1.5,
          points: {show: false}}))],
      }, [[], ...series.map(() => [])], this.element);
    }
    const count = Math.max(0, ...series.map(one => one.values.length));
    const now = Date.now() / 1000;
    const times = Array.from({length: count}, (_, i) => now - (count - 1 - i) * this.step);
    if (Math.abs(wide - this.#plot.width) > 2) this.#plot.setSize({width: wide, height: 200});
    this.#plot.setData([times, ...series.map(({values}) => Array(count - values.length).fill(null).concat(values))]);
  }
}
