// SPDX-License-Identifier: Apache-2.0
// The frame of all pages: pairing, what is on in one line, alerts, navigation.
import {html, nothing, render} from '/vendor/lit-html.js';
import {Link} from '/link.js';
import {hasDrawings, waitingCount} from '/drawings.js';
import {pages, standing} from '/pages.js';
import {button, language, languages, loadTexts, patternOf, showPicture, t, word} from '/widgets.js';

const link = new Link();
const root = document.getElementById('root');
const names = () => Object.keys(pages).filter(name => name !== 'drawings' || hasDrawings(link));
const pageName = () => names().includes(location.hash.slice(1)) ? location.hash.slice(1) : 'wall';
// What a page of the list calls attention to.
function badgeOf(name) {
  const alerts = standing(link).length, waiting = waitingCount(link);
  if (name === 'events' && alerts) return html`&nbsp;<span class="bad">▲ ${alerts}</span>`;
  if (name === 'drawings' && waiting) return html`&nbsp;<span class="badge">${waiting}<span class="hidden"> ${
    t('drawing.wait')}</span></span>`;
  return nothing;
}

// What is on, as a shape and a word.
function headline() {
  const {wall, shown} = link;
  if (link.isStale) return ['◌', t('head.stale'), 'bad'];
  if (!wall.heard && wall.preparing) return ['◔', t('head.preparing'), 'warn'];
  if (!wall.heard) return ['✖', t('head.noMaster'), 'bad'];
  if (wall.onBattery) return ['▲', t('head.battery'), 'warn'];
  if (wall.heldUntilS > 0) return ['▲', t('head.held'), 'warn'];
  if (shown.black && link.known.hours?.present && !link.known.hours.open) return ['○', t('head.closed'), 'quiet'];
  if (shown.black) return ['■', t('head.black'), 'warn'];
  const pattern = patternOf(link);
  if (pattern !== 'world') return ['▦', t('head.pattern', {pattern: word(pattern)}), 'warn'];
  if (shown.frozen) return ['‖', t('head.frozen'), 'warn'];
  return ['●', t('head.on', {scene: word(shown.scene)}), 'good'];
}

// One line that is always there: what is wrong, what is waited for, what was done.
function strip() {
  if (link.isStale) {
    const seconds = Math.round(link.age / 1000);
    return html`<p class="strip lost"
      role="alert">${t('strip.stale', {seconds: Number.isFinite(seconds) ? seconds : '–'})}</p>`;
  }
  const last = [...link.commands.values()].at(-1);
  const shown = last && (last.outcome !== 'done' || performance.now() - last.at < 6000);
  const reason = last?.reason ? ` – ${word(last.reason)}` : '';
  const text = !shown ? '' : `${last.text}: ${t(`done.${last.outcome}`)}${reason}`;
  const change = link.status.change ? t('strip.change', {change: link.status.change}) : link.wall.preparing ?? '';
  const kind = shown && last.outcome === 'refused' ? 'lost' : text || change ? 'wait' : '';
  return html`<p class="strip ${kind}" role="status">${text || change || t('strip.calm')}</p>`;
}

function shell(page, content) {
  const [shape, text, kind] = headline();
  return html`<header><div class="bar"><h1>Aquarama</h1><span class="state ${kind}"><span
    aria-hidden="true">${shape}</span> ${text}</span>
      <span class="where">${link.known.snapshot.rig} · ${t(`role.${link.role}`)}</span></div>
    ${strip()}
    <nav aria-label=${t('nav')}>${names().map(name => html`<a href="#${name}"
      aria-current=${name === page ? 'page' : nothing}>
      ${t(`page.${name}`)}${badgeOf(name)}</a>`)}</nav></header>
    <main>${content}</main>
    <footer><span>${t('foot.build', {build: link.known.snapshot.build})}</span><span>${t('foot.watching',
      {n: link.wall.watching ?? 0})}</span>
      <span>${t('foot.refused', {n: link.wall.refusedRequests ?? 0})}</span>
      <label>${t('foot.language')} <select
        @change=${async event => { localStorage.setItem('language', event.target.value); await loadTexts(); draw(); }}>
        ${Object.entries(languages).map(([code, name]) => html`<option value=${code}
        ?selected=${code === language()}>${name}</option>`)}</select></label></footer>`;
}

let pairingFailed = false;
function pairing() {
  const submit = async event => {
    event.preventDefault();
    pairingFailed = !await link.pair(event.target.code.value, event.target.name.value);
    draw();
  };
  return html`<main class="pairing"><form class="panel" @submit=${submit}><h1>Aquarama</h1><p>${t('pair.explain')}</p>
    <label for="code">${t('pair.code')}</label><input id="code" name="code" class="code" autocomplete="off"
      autocapitalize="characters" maxlength="12" required>
    <label for="name">${t('pair.name')}</label><input id="name" name="name" maxlength="40" autocomplete="off">
    <button class="primary">${t('pair.enter')}</button><p role="alert" class="bad">${pairingFailed ? t('pair.wrong')
      : ''}</p></form></main>`;
}

function draw() {
  document.documentElement.classList.toggle('stale', link.isStale);
  if (link.paired === false) return render(pairing(), root);
  if (!link.known.snapshot) return render(html`<main><p role="status">${t('head.connecting')}</p></main>`, root);
  const page = pageName();
  const waiting = waitingCount(link);
  document.title = `${waiting ? `(${waiting}) ` : ''}Aquarama ${link.known.snapshot.rig} – ${t(`page.${page}`)}`;
  render(shell(page, pages[page].view(link)), root);
}

function lookAgain() {
  if (!link.known.snapshot || document.hidden) return;
  link.look = pages[pageName()].look(link);
  link.sayLook();
}

link.addEventListener('change', draw);
link.addEventListener('picture', event => showPicture(link, event.detail));
addEventListener('hashchange', () => { lookAgain(); draw(); });
addEventListener('visibilitychange', lookAgain);
setInterval(lookAgain, 1000);
setInterval(draw, 250);
await loadTexts();
await link.start();
draw();
