// SPDX-License-Identifier: Apache-2.0
// Which release the machines run, which one waits, and the crew's word: go, or back.
import {html, nothing} from '/vendor/lit-html.js';
import {holdButton, t, word} from '/widgets.js';

// What holds now, in a sentence.
const head = ({phase, stable, candidate}) => !stable ? t('releases.unknown')
  : candidate ? t(`releases.${phase}`, {candidate, stable}) : t('releases.settled', {stable});

const SILENT_S = 10;
const row = ({name, runs, silentS, problem}) => html`<tr><th scope="row">${name}</th><td>${runs || '–'}</td>
  <td>${problem ? html`<span class="bad">✖ ${problem}</span>` : !runs || silentS > SILENT_S
    ? html`<span class="warn">▲ ${t('releases.silent')}</span>`
    : html`<span class="good">● ${t('releases.heard')}</span>`}
  </td></tr>`;

const say = (link, what, disabled, values) => {
  const label = t(`releases.${what}`, values);
  return holdButton(label, () => link.command({release: what}, label), {disabled: disabled || !link.may('CREW'),
    of: what});
};

// Nothing where the rig has no depot.
export function releases(link) {
  const {hasDepot} = link.known.snapshot;
  const known = link.known.releases;
  if (!hasDepot) return nothing;
  return html`<section class="panel" aria-labelledby="releases"><h2 id="releases">${t('releases.title')}</h2>
    ${!known ? html`<p class="note">${t('releases.asking')}</p>` : known.problem
      ? html`<p class="warn">▲ ${word(known.problem)}</p>` : html`<p role="status">${head(known)}</p>
    <table><tbody>${(known.machines ?? []).map(row)}</tbody></table>
    ${known.waitingFor ? html`<p class="note">${known.waitingFor}</p>` : nothing}
    ${known.reason ? html`<p class="warn">▲ ${known.reason}</p>` : nothing}
    <div class="row">${say(link, 'go', !known.ready, {candidate: known.candidate})}
    ${say(link, 'back', !known.candidate && !known.before)}</div><p class="note">${t('releases.note')}</p>`}</section>`;
}
