// SPDX-License-Identifier: Apache-2.0
// Nodes without a key that show a letter on their screens: the crew gives each a channel by the code beside its letter.
import {html, nothing} from '/vendor/lit-html.js';
import {namesOf, t} from '/widgets.js';

let chosen = '';  // the letter whose form is open

const choose = (link, letter) => {
  chosen = chosen === letter ? '' : letter;
  link.dispatchEvent(new Event('change'));
};
const card = link => ({letter, address}) => html`<button class="letter" data-letter=${letter}
  aria-expanded=${String(chosen === letter)} ?disabled=${!link.may('CREW')}
  @click=${() => choose(link, letter)}><strong>${letter}</strong><span class="note">${address}</span></button>`;

// A channel whose node is there is marked: its node would be cut off.
function form(link) {
  const there = new Set((link.status.nodes ?? []).filter(node => node.condition !== 'NODE_ABSENT')
    .map(node => node.name));
  const free = namesOf(link).find(name => !there.has(name));
  const submit = event => {
    event.preventDefault();
    const {channel, code} = Object.fromEntries(new FormData(event.target));
    link.command({assign: {letter: chosen, channel, code}}, t('waiting.giving', {letter: chosen, channel}));
    choose(link, chosen);
  };
  return html`<form class="choosers" @submit=${submit}>
    <label for="waitingChannel">${t('waiting.channel')}</label><select id="waitingChannel" name="channel">
      ${namesOf(link).map(name => html`<option value=${name} ?selected=${name === free}>${name}${there.has(name)
        ? ` (${t('waiting.taken')})` : ''}</option>`)}</select><span></span>
    <label for="waitingCode">${t('waiting.code')}</label><input id="waitingCode" name="code" class="code"
      autocomplete="off" autocapitalize="characters" maxlength="12" required>
    <button class="primary" ?disabled=${!link.may('CREW')}>${t('waiting.give', {letter: chosen})}</button></form>
    <p class="note">${t('waiting.note')}</p>`;
}

// Nothing where the rig has one machine.
export function waitingNodes(link) {
  const {nodes = [], searched} = link.known.waitingNodes ?? {};
  if (!searched) return nothing;
  if (!nodes.some(({letter}) => letter === chosen)) chosen = '';
  return html`<section class="panel wide" aria-labelledby="waiting"><h2 id="waiting">${t('waiting.title')}</h2>
    ${nodes.length ? html`<div class="row">${nodes.map(card(link))}</div>`
      : html`<p class="note">${t('waiting.none')}</p>`}
    ${chosen ? form(link) : nothing}</section>`;
}
