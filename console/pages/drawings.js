// SPDX-License-Identifier: Apache-2.0
// Visitors' drawings: those that wait for the crew, those of the day, ways in, and which fish of the wall wears one.
import {html, nothing} from '/vendor/lit-html.js';
import {SIDES, sheetPanel} from '/sheets.js';
import {button, language, namesOf, speciesName, state, t, wholeWall} from '/widgets.js';

export const hasDrawings = link => link.known.snapshot?.hasDrawings ?? false;
export const waitingCount = link => hasDrawings(link) ? link.wall.drawingsWaiting ?? 0 : 0;
const allOf = link => link.known.drawings?.drawings ?? [];
const nameOf = one => t('drawing.of', {number: one.number, species: speciesName(one.species)});

// "5:55 PM"; of one that is kept from another day, its date.
function since(one) {
  const at = new Date(1000 * Number(one.offeredAt));
  return at.toDateString() === new Date().toDateString()
    ? at.toLocaleTimeString(language(), {hour: 'numeric', minute: '2-digit'}) : at.toLocaleDateString(language());
}

function decide(link, one, verdict, more = {}) {
  link.command({order: {moderation: {number: one.number, verdict, ...more}}},
    `${nameOf(one)}: ${t(`drawing.${verdict}`)}`);
}

// A picture of what it wears: there is none before the console has it.
function picture(link, one) {
  const known = link.known.drawings.pictures?.find(({number}) => number === one.number);
  return known ? html`<img class="skin" src=${`/drawing/${one.number}.png?${known.tag}`} alt=${nameOf(one)} width="1024"
    height="512" loading="lazy">` : html`<div class="skin" role="img" aria-label=${t('drawing.noPicture')}></div>`;
}

// One tap, both ways.
export function drawingsButton(link) {
  const on = link.status.drawings;
  const name = t(on ? 'drawing.off' : 'drawing.on');
  return button(name, () => link.show({drawings: !on}, name), {disabled: !link.may('OPERATOR'), pressed: String(!on)});
}

// --- those that wait

const MOST_SHOWN = 12;
const STAYS_MS = 2000;  // one that is decided, so that the next does not come under the finger
const CALM_MS = 400;    // after the places of the others have changed
const decided = new Map();  // number -> {one, verdict, at}
const sides = new Map();    // number -> where its maker stands, as the crew says
let places = [], movedAt = 0;

// In their order, with those that were decided a moment ago.
function standing(link) {
  const now = performance.now();
  for (const [number, {at}] of decided) if (now - at > STAYS_MS) decided.delete(number);
  for (const number of sides.keys()) if (!allOf(link).some(one => one.number === number)) sides.delete(number);
  const waiting = allOf(link).filter(one => one.condition === 'WAITING' && !decided.has(one.number));
  const all = [...waiting, ...[...decided.values()].map(({one}) => one)].sort((a, b) => a.number - b.number);
  const shown = all.slice(0, MOST_SHOWN).map(one => one.number);
  if (places.some((number, i) => number !== shown[i])) movedAt = now;
  places = shown;
  return all;
}

// Where its maker stands: as it was said with the picture, until the crew knows better.
function sideRow(link, one, disabled) {
  const chosen = sides.get(one.number) ?? one.aside ?? 0;
  const choose = aside => () => { sides.set(one.number, aside); link.dispatchEvent(new Event('change')); };
  return html`<div class="row side" role="group" aria-label=${t('sheet.side')}>${Object.entries(SIDES).map(
    ([name, aside]) => button(t(`sheet.${name}`), choose(aside), {disabled, pressed: String(chosen === aside),
      of: `${name}-${one.number}`}))}</div>`;
}

function waitingCard(link, one) {
  const verdict = decided.get(one.number)?.verdict;
  const say = (name, kind) => {
    const act = () => {
      if (performance.now() - movedAt < CALM_MS) return;
      decided.set(one.number, {one, verdict: name, at: performance.now()});
      decide(link, one, name, sides.has(one.number) ? {aside: sides.get(one.number)} : {});
    };
    return html`<button class=${kind} data-of=${one.number} aria-pressed=${verdict === name ? 'true' : nothing}
      ?disabled=${verdict || !link.may('OPERATOR')} @click=${act}>${t(name === 'LET_IN' ? 'drawing.yes'
      : 'drawing.no')}</button>`;
  };
  return html`<li>${picture(link, one)}<p>${nameOf(one)} <span class="quiet">${since(one)}</span></p>
    ${sideRow(link, one, !!verdict || !link.may('OPERATOR'))}
    <div class="verdict">${say('TAKE_DOWN', 'no')}${say('LET_IN', 'yes')}</div></li>`;
}

function waitingPanel(link) {
  const all = standing(link);
  const more = all.length - MOST_SHOWN;
  return html`<section class="panel wait" aria-labelledby="waiting"><div class="row"><h2
    id="waiting">${t('drawing.waiting', {n: waitingCount(link)})}</h2>
    <span class="push">${drawingsButton(link)}</span></div>
    ${link.status.drawings === false ? html`<p class="warn">▲ ${t('drawing.areOff')}</p>` : nothing}
    ${all.length ? html`<ul class="waiting">${all.slice(0, MOST_SHOWN).map(one => waitingCard(link, one))}</ul>`
      : html`<p class="note">${t('drawing.noneWaits')}</p>`}
    ${more > 0 ? html`<p class="note">${t('drawing.more', {n: more})}</p>` : nothing}</section>`;
}

// --- which fish of the wall wears one

const touch = {at: null};  // the place where the wall was touched
export function touchWall(link) {
  return (channel, {frame, x, y}) => {
    touch.at = {x, y};
    delete link.known.mind;
    link.command({pointAt: {channel: channel.name, frame, x, y}}, t('drawing.asking'));
  };
}

// What was found at the place that was touched last; nothing where none was.
export function touchedPanel(link) {
  if (!touch.at) return nothing;
  const mind = link.known.mind;
  const one = mind && allOf(link).find(({fish, condition}) => fish === mind.fish && condition !== 'WAITING');
  const close = () => { touch.at = null; link.dispatchEvent(new Event('change')); };
  const take = () => decide(link, one, 'TAKE_DOWN');
  const found = !mind ? t('drawing.looking') : mind.fish < 0 ? t('mind.noFish') : t('drawing.fishWithout');
  return html`<section class="panel touched" role="status">${one ? html`${picture(link, one)}<div><p><strong>${
    nameOf(one)}</strong> ${state(one.condition)}</p><div class="row"><button class="no" data-of="touched"
    ?disabled=${!link.may('OPERATOR') || one.condition === 'LEAVING'} @click=${take}>${t('drawing.take')}</button>
    ${button(t('drawing.close'), close)}</div></div>`
    : html`<p class="row">${found} ${mind ? button(t('drawing.close'), close) : nothing}</p>`}</section>`;
}

// --- all of the day

function dayRow(link, one) {
  const disabled = !link.may('OPERATOR') || one.condition === 'LEAVING';
  const keep = one.kept ? 'KEEP_NO_MORE' : 'KEEP';
  return html`<li>${picture(link, one)}<p>${nameOf(one)} <span
    class="quiet">${since(one)}</span><br>${state(one.condition)}</p>
    <div class="row">${button(t('drawing.kept'), () => decide(link, one, keep),
      {disabled, pressed: String(one.kept), of: one.number})}
    ${button(t('drawing.take'), () => decide(link, one, 'TAKE_DOWN'), {disabled, of: one.number})}</div></li>`;
}

function dayPanel(link) {
  const all = allOf(link).filter(one => one.condition !== 'WAITING').reverse();
  const homeless = all.some(one => one.condition === 'HOMELESS');
  return html`<section class="panel today" aria-labelledby="day"><h2 id="day">${t('drawing.day',
    {n: link.wall.drawingsSwimming ?? 0})}</h2>
    ${all.length ? html`<ul class="day">${all.map(one => dayRow(link, one))}</ul>`
      : html`<p class="note">${t('drawing.none')}</p>`}
    ${homeless ? html`<p class="note">${t('drawing.homeless')}</p>` : nothing}
    <p class="note">${t('drawing.keptNote')}</p></section>`;
}

const wallPanel = link => html`<section class="panel" aria-labelledby="touch"><h2 id="touch">${t('drawing.touch')}</h2>
  <div class="touchable">${wholeWall(link, touchWall(link))}</div>${touchedPanel(link)}<p
  class="note">${t('drawing.touchNote')}</p></section>`;

export const drawingsPage = {
  look: link => ({topics: ['drawings', 'panorama'], channels: namesOf(link), widthPx: 480}),
  view: link => html`<h2 class="hidden">${t('page.drawings')}</h2><div class="drawings">${
    waitingPanel(link)}<div class="ways">${sheetPanel(link)}${wallPanel(link)}</div>${dayPanel(link)}</div>`,
};
