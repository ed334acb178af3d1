// SPDX-License-Identifier: Apache-2.0
// Pictures of coloured sheets: from a file, from a tablet's camera, or framed live.
import {html, nothing} from '/vendor/lit-html.js';
import {button, t, word} from '/widgets.js';

export const SIDES = {left: -1, middle: 0, right: 1};
const READ = ['image/jpeg', 'image/png', 'image/webp'];
const MOST_BYTES = 16 << 20, MOST_PX = 4096;

const sheet = {side: 'middle', sent: []};  // numbers of commands, the newest first

// --- a picture on its way

// As one of the kinds that are read, and not larger.
async function readable(picture) {
  if (READ.includes(picture.type) && picture.size <= MOST_BYTES) return picture;
  const bitmap = await createImageBitmap(picture);
  const scale = Math.min(1, MOST_PX / Math.max(bitmap.width, bitmap.height));
  const canvas = document.createElement('canvas');
  canvas.width = Math.round(scale * bitmap.width);
  canvas.height = Math.round(scale * bitmap.height);
  canvas.getContext('2d').drawImage(bitmap, 0, 0, canvas.width, canvas.height);
  bitmap.close();
  return jpegOf(canvas);
}
const jpegOf = canvas => new Promise(done => canvas.toBlob(done, 'image/jpeg', 0.92));

async function send(link, picture) {
  const id = link.begin(t('sheet.picture'));
  sheet.sent = [id, ...sheet.sent].slice(0, 4);
  try {
    const body = await readable(picture);
    const reply = await fetch(`/api/drawing?aside=${SIDES[sheet.side]}&request=${id}`,
      {method: 'POST', headers: {'Content-Type': body.type}, body});
    const [outcome, reason] = (await reply.text()).trim().split(/: (.*)/);
    if (!reply.ok) link.ended(id, 'refused', reason ?? outcome);
  } catch { link.ended(id, 'refused', 'the picture cannot be read or sent'); }
}

// --- live framing: where the page is a secure context

const camera = {video: null, stream: null, problem: ''};
const canFrame = () => isSecureContext && navigator.mediaDevices?.getUserMedia;
function closeCamera() {
  camera.stream?.getTracks().forEach(track => track.stop());
  Object.assign(camera, {video: null, stream: null});
}
async function openCamera(link) {
  camera.problem = '';
  try {
    camera.stream = await navigator.mediaDevices.getUserMedia({video: {facingMode: 'environment',
      width: {ideal: 3840}, height: {ideal: 2160}}});
    camera.video = Object.assign(document.createElement('video'), {srcObject: camera.stream, muted: true,
      playsInline: true, autoplay: true});
    camera.video.setAttribute('aria-label', t('sheet.live'));
  } catch (problem) { camera.problem = problem.name; }
  link.dispatchEvent(new Event('change'));
}
async function take(link) {
  const canvas = document.createElement('canvas');
  canvas.width = camera.video.videoWidth;
  canvas.height = camera.video.videoHeight;
  if (!canvas.width) return;
  canvas.getContext('2d').drawImage(camera.video, 0, 0);
  send(link, await jpegOf(canvas));
}
addEventListener('hashchange', closeCamera);

// The sheet and its four marks, in millimetres.
const outline = html`<svg viewBox="-30 -20 357 250" aria-hidden="true"><rect class="paper" width="297" height="210"
  rx="2"></rect><rect x="16.5" y="9" width="22" height="22"></rect><rect x="258.5" y="9" width="22" height="22"></rect>
  <rect x="258.5" y="179" width="22" height="22"></rect><rect x="16.5" y="179" width="22" height="22"></rect></svg>`;

const framing = link => html`<div class="framing">${camera.video}${outline}</div>
  <div class="row"><button class="primary" @click=${() => take(link)}>${t('sheet.take')}</button>
  ${button(t('sheet.close'), () => { closeCamera(); link.dispatchEvent(new Event('change')); })}</div>`;

// --- the panel

function outcomeOf(link, id) {
  const command = link.commands.get(id);
  if (!command) return nothing;
  const kind = {done: 'good', refused: 'bad', lost: 'bad'}[command.outcome] ?? 'quiet';
  const reason = command.reason ? ` – ${word(command.reason)}` : '';
  return html`<li class=${kind}>${command.text}: ${t(`done.${command.outcome}`)}${reason}</li>`;
}

function waysIn(link) {
  const choose = event => {
    const [file] = event.target.files;
    if (file) send(link, file);
    event.target.value = '';
  };
  const disabled = !link.may('OPERATOR');
  const side = name => button(t(`sheet.${name}`), () => { sheet.side = name; link.dispatchEvent(new Event('change')); },
    {disabled, pressed: String(sheet.side === name), of: 'side'});
  return html`<div class="row" role="group" aria-labelledby="side"><span id="side" class="above">${
    t('sheet.side')}</span>${Object.keys(SIDES).map(side)}</div>
    <div class="row"><label class="button file ${disabled ? 'off' : ''}">${t('sheet.file')}<input class="hidden"
      type="file" accept="image/*" capture="environment" ?disabled=${disabled} @change=${choose}></label>
      ${canFrame() && !camera.video ? button(t('sheet.camera'), () => openCamera(link), {disabled}) : nothing}</div>
    ${camera.problem ? html`<p class="bad">${t('sheet.noCamera', {why: camera.problem})}</p>` : nothing}
    ${camera.video ? framing(link) : nothing}
    <div role="status"><ul class="sent">${sheet.sent.map(id => outcomeOf(link, id))}</ul></div>`;
}

export const sheetPanel = link => html`<section class="panel" aria-labelledby="sheet"><h2
  id="sheet">${t('sheet.title')}</h2>${link.known.snapshot.readsPictures ? waysIn(link)
  : html`<p class="note">${t('sheet.notInstalled')}</p>`}</section>`;
