// SPDX-License-Identifier: Apache-2.0
// The page of the calibration: what was measured, the way back to an earlier one, drift, and patterns for the eye.
import {html, nothing} from '/vendor/lit-html.js';
import {button, channelsOf, holdButton, language, namesOf, patternChooser, patternOf, state, t, views,
  word} from '/widgets.js';

// "2026-11-24T210301" as people write it, in their own time.
function dateOf(name) {
  const found = name.match(/^(\d{4})-(\d\d)-(\d\d)T(\d\d):?(\d\d):?(\d\d)/);
  if (!found) return name;
  const [year, month, day, hour, minute, second] = found.slice(1).map(Number);
  return new Date(Date.UTC(year, month - 1, day, hour, minute, second)).toLocaleString(language());
}
const px = value => `${(value ?? 0).toFixed(2)} px`;

const keptRow = link => one => html`<tr><th scope="row">${dateOf(one.name)}</th>
  <td data-head=${t('calibration.verdict')}>${one.verdict ? state(one.verdict)
    : html`<span class="quiet">${t('calibration.noFigures')}</span>`}${one.cause
      ? html`<div class="note">${one.cause}</div>` : nothing}</td>
  <td class="n" data-head=${t('calibration.part')}>${one.verdict && one.overlapMaxPx > 0
  ? html`${px(one.overlapRmsPx)}<div class="note">${t('calibration.most', {px: px(one.overlapMaxPx)})}</div>`
    : '–'}</td>
  <td class="n" data-head=${t('calibration.place')}>${one.verdict ? px(one.absoluteRmsPx) : '–'}</td>
  <td data-head="">${one.inUse ? html`<strong class="good">✓ ${t('calibration.inUse')}</strong>`
    : holdButton(t('calibration.use'), () => link.command({useCalibration: one.name},
      t('calibration.using', {date: dateOf(one.name)})), {disabled: !link.may('CREW')})}</td></tr>`;

function keptList(link, list) {
  if (!list) return html`<p role="status">${t('calibration.reading')}</p>`;
  if (list.problem) return html`<p class="bad">✖ ${list.problem}</p>`;
  if (!list.file) return html`<p>${
    t('calibration.none')}</p><pre>aquarama calibrate --rig RIG --camera /dev/video0 --out hall.mpcdi</pre>`;
  if (!list.kept?.length) return html`<p>${t('calibration.noneKept', {file: list.file})}</p>`;
  return html`<div class="scroll" tabindex="0" role="region" aria-label=${t('calibration.kept')}><table class="cards">
    <thead><tr><th scope="col">${t('calibration.when')}</th><th scope="col">${t('calibration.verdict')}</th><th
      scope="col" class="n">${t('calibration.part')}</th>
      <th scope="col" class="n">${t('calibration.place')}</th><td></td></tr></thead><tbody>${
      list.kept.map(keptRow(link))}</tbody></table></div>
    <p class="note">${t('calibration.note', {file: list.file})}</p>`;
}

function drift(one) {
  if (!one) return html`<p>${t('drift.never')}</p><pre>aquarama drift --rig RIG --camera /dev/video0</pre>`;
  return html`<p>${t('drift.looked', {at: dateOf(one.looked), learned: dateOf(one.learned)})}</p>
    ${one.cameraLost ? html`<p class="bad">✖ ${t('drift.cameraLost')}</p>`
      : html`<dl>${(one.channels ?? []).map(channel => html`
      <dt>${channel.name}</dt><dd>${state(channel.verdict)} · ${px(channel.shiftPx)}</dd>`)}</dl>
      <p class="note">${t((one.channels ?? []).some(channel => channel.verdict === 'moved') ? 'drift.again'
        : 'drift.camera', {px: px(one.cameraMovedPx)})}</p>`}`;
}

// --- patterns of a scan

const KINDS = ['white', 'columns', 'rows', 'dots', 'room'];
const scan = {kind: 'columns', step: 4, channel: ''};
function scanPanel(link, isHeld) {
  const disabled = !link.may('OPERATOR');
  const set = (name, value) => { scan[name] = value; link.dispatchEvent(new Event('change')); };
  const isCode = ['columns', 'rows'].includes(scan.kind);
  const show = () => link.command({scan: {kind: scan.kind, step: isCode ? scan.step : 0, channel: scan.channel}},
    t('scan.title'));
  return html`<section class="panel" aria-labelledby="scan"><h2 id="scan">${t('scan.title')}</h2><div class="choosers">
    <label for="scanKind">${t('scan.kind')}</label><select id="scanKind" ?disabled=${disabled}
      @change=${event => set('kind', event.target.value)}>
      ${KINDS.map(kind => html`<option value=${kind}
      ?selected=${kind === scan.kind}>${t(`scan.${kind}`)}</option>`)}</select><span></span>
    <label for="scanStep">${t('scan.step')}</label><input id="scanStep" type="number" min="0" max="15"
    .value=${String(scan.step)} ?disabled=${disabled || !isCode}
      @change=${event => set('step',
      Math.min(15, Math.max(0, Math.round(Number(event.target.value) || 0))))}><span></span>
    <label for="scanChannel">${t('scan.channel')}</label><select id="scanChannel" ?disabled=${disabled}
    @change=${event => set('channel', event.target.value)}>
      <option value="" ?selected=${!scan.channel}>${t('scan.all')}</option>${namesOf(link).map(name => html`<option
      ?selected=${name === scan.channel}>${name}</option>`)}</select><span></span></div>
    <div class="row">${holdButton(t('wall.apply'), show, {disabled, of: 'scan'})}${button(t('scan.end'),
    () => link.command({scan: {}}, t('scan.end')), {disabled: disabled || !isHeld})}</div>
    <p class="note" role="status">${t(isHeld ? 'scan.isHeld' : 'scan.note')}</p></section>`;
}

export const calibrationPage = {
  look: link => ({topics: ['calibrations'], channels: namesOf(link), widthPx: 480}),
  view: link => {
    const list = link.known.calibrations;
    return html`<section class="panel wide"><h2>${t('calibration.kept')}</h2>${keptList(link, list)}</section>
      <div class="panels"><section class="panel" aria-labelledby="drift"><h2 id="drift">${t('drift.title')}</h2>${list
        ? drift(list.drift) : t('calibration.reading')}</section>
      <section class="panel"><h2>${t('calibration.patterns')}</h2><div class="choosers">${patternChooser(link)}</div><p
      class="note">${t('wall.patternNote')}</p></section>
      ${scanPanel(link, list?.heldScan)}</div>
      <section class="panel seen"><h2>${t('calibration.seen')}</h2>${views(channelsOf(link))}<p
        class="note">${t('calibration.now', {pattern: word(patternOf(link))})}</p></section>`;
  },
};
