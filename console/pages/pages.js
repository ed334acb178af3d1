// SPDX-License-Identifier: Apache-2.0
// The pages: each is {look: what it needs to be told, view: what it shows of the link's knowledge}.
import {html, nothing, svg} from '/vendor/lit-html.js';
import {calibrationPage} from '/calibration.js';
import {drawingsButton, drawingsPage, hasDrawings, touchWall, touchedPanel} from '/drawings.js';
import {nodesPage} from '/nodes.js';
import {schedulePage} from '/schedule.js';
import {tourPage} from '/tour.js';
import {DAYS, QUALITIES, button, channelsOf, chooser, conditionOf, dateTime, dayOf, durationOf, filter, holdButton,
  journalOf, ms, namesOf, patternChooser, patternOf, percentOf, qualityOf, sizeOf, slider, state, t, time, timeOfTick,
  views, wholeWall, word} from '/widgets.js';

// --- the wall

// Black is held; the way back is one tap, in the same place.
function light(link) {
  const disabled = !link.may('OPERATOR');
  const {black, frozen} = link.shown;
  const undo = () => link.show({black: false}, t('wall.light'));
  return html`<section class="panel" aria-labelledby="light"><h2 id="light">${t('wall.lightTitle')}</h2>
    <div class="row">${black
      ? html`<button class="primary" ?disabled=${disabled} @click=${undo}>${t('wall.light')}</button>`
      : holdButton(t('wall.black'), () => link.show({black: true}, t('wall.black')), {disabled})}
    ${button(t(frozen ? 'wall.move' : 'wall.freeze'), () => link.show({freeze: !frozen},
      t(frozen ? 'wall.move' : 'wall.freeze')),
             {disabled, pressed: frozen ? 'true' : 'false'})}</div>
    <p class="note">${t(black ? 'wall.isBlack' : 'wall.isLit',
      {percent: Math.round((link.shown.brightness ?? 0) * 100 / 255)})}</p></section>`;
}

// --- the helm

const helm = {taken: false, held: new Set(), timer: null};
const AXES = {ahead: [['ahead', 127]], back: [['ahead', -127]], left: [['turn', 127]], right: [['turn', -127]],
              rise: [['up', 127]], sink: [['up', -127]]};
const KEYS = {w: 'ahead', s: 'back', a: 'left', d: 'right', r: 'rise', f: 'sink'};
function steer(link) {
  const axes = {ahead: 0, aside: 0, up: 0, turn: 0, tilt: 0};
  for (const name of helm.held) for (const [axis, value] of AXES[name]) axes[axis] += value;
  link.say({helm: axes});
}
function holdHelm(link, name, on) {
  on ? helm.held.add(name) : helm.held.delete(name);
  steer(link);
  clearInterval(helm.timer);
  if (helm.held.size) helm.timer = setInterval(() => link.isStale ? letGo(link) : steer(link), 100);
}
function letGo(link) {
  helm.held.clear();
  clearInterval(helm.timer);
  steer(link);
}
function pad(link) {
  const one = (name, sign) => html`<button aria-label=${t(`helm.${name}`)} title=${t(`helm.${name}`)}
    ?disabled=${!link.may('OPERATOR')}
    @pointerdown=${() => holdHelm(link, name, true)} @pointerup=${() => holdHelm(link, name, false)}
    @pointerleave=${() => holdHelm(link, name, false)} @pointercancel=${() => holdHelm(link, name, false)}
    @keydown=${event => [' ', 'Enter'].includes(event.key) && !event.repeat && holdHelm(link, name, true)}
    @keyup=${() => holdHelm(link, name, false)} @blur=${() => holdHelm(link, name, false)}>${sign}</button>`;
  const key = on => event => { const name = KEYS[event.key.toLowerCase()]; if (name && !event.repeat) holdHelm(link,
    name, on); };
  return html`<div class="pad" @keydown=${key(true)} @keyup=${key(false)}>
    ${one('rise', '⤒')}${one('ahead', '▲')}${one('sink', '⤓')}${one('left', '◀')}${one('back', '▼')}${one('right',
      '▶')}</div>
    <p class="note">${t('helm.keys')}</p>`;
}
// Visitors with phones: one tap, both ways.
function guestsButton(link) {
  const on = link.status.guests;
  const name = t(on ? 'guests.off' : 'guests.on');
  return button(name, () => link.show({guests: !on}, name), {disabled: !link.may('OPERATOR'), pressed: String(!on)});
}
function helmPanel(link) {
  const toggle = () => { helm.taken = !helm.taken; letGo(link); link.dispatchEvent(new Event('change')); };
  return html`<section class="panel" aria-labelledby="helm"><h2 id="helm">${t('helm.title')}</h2>
    <p>${link.shown.pilot ? t('helm.pilot', {pilot: link.shown.pilot}) : t('helm.nobody')} ·
       ${t('helm.place', {depth: (-(link.status.eye?.[1] ?? 0)).toFixed(1),
         speed: (link.status.speedMS ?? 0).toFixed(1)})}</p>
    <div class="row">${button(t(helm.taken ? 'helm.leave' : 'helm.take'), toggle, {disabled: !link.may('OPERATOR'),
      pressed: String(helm.taken)})}${link.known.snapshot?.hasGuests ? guestsButton(link) : nothing}${
      hasDrawings(link) ? drawingsButton(link) : nothing}</div>
    ${helm.taken ? pad(link) : nothing}</section>`;
}

// Of a JournalStatus (aquarama.proto), which a show without a journal has as well.
function journal({status}) {
  const told = status.journal;
  if (!told) return '–';
  const sizes = Number(told.folderBytes) ? t('wall.journalSizes', {age: durationOf(told.saveAgeS ?? 0),
    file: sizeOf(told.fileBytes), folder: sizeOf(told.folderBytes), free: sizeOf(told.freeDiskBytes)}) : '';
  const wentOn = Number(told.wentOnTick) ? t('wall.wentOn', {time: timeOfTick(told.wentOnTick),
    away: durationOf(told.awayS ?? 0)}) : '';
  const late = Number(told.lateInputs) ? t('wall.lateInputs', {n: told.lateInputs}) : '';
  return html`${state(journalOf(told))} ${told.reason || nothing}
    ${[sizes, wentOn, late].filter(Boolean).map(text => html`<div class="note">${text}</div>`)}`;
}

// Of a StandbyStatus, which only a rig with a standby has.
function standby({master, machine, masterS}) {
  return html`${state(machine ? 'simulates along' : 'nobody')} ${machine || nothing}
    <div class="note">${t('wall.master', {master, time: durationOf(masterS ?? 0)})}</div>`;
}

function figures(link) {
  const {status, shown} = link;
  return html`<section class="panel figures" aria-labelledby="figures"><h2 id="figures">${t('wall.now')}</h2><dl>
    <dt>${t('wall.scene')}</dt><dd>${word(shown.scene)}</dd>
    <dt>${t('wall.day')}</dt><dd>${word(dayOf(link))}</dd>
    <dt>${t('wall.quality')}</dt><dd>${word(qualityOf(link))}</dd>
    <dt>${t('wall.pattern')}</dt><dd>${word(patternOf(link))}</dd>
    <dt>${t('wall.frame')}</dt><dd>${status.frame} · ${t('wall.tick')} ${status.tick}</dd>
    <dt>${t('wall.frameTime')}</dt><dd>${ms(status.frameMedianMs)} · 99 % ${ms(status.frameP99Ms)}</dd>
    <dt>${t('wall.skew')}</dt><dd>${ms(status.skewMedianMs, 2)} · 99 % ${ms(status.skewP99Ms, 2)}</dd>
    <dt>${t('wall.journal')}</dt><dd>${journal(link)}</dd>
    ${status.standby ? html`<dt>${t('wall.standby')}</dt><dd>${standby(status.standby)}</dd>` : nothing}
    <dt>${t('wall.nodes')}</dt><dd>${(status.nodes ?? []).map(node => html`<span
      class="whole-word">${node.name} ${state(conditionOf(node))}</span> `)}</dd></dl></section>`;
}

const wallPage = {
  look: link => ({topics: ['panorama', 'drawings'], channels: namesOf(link), widthPx: 480}),
  view: link => html`<h2 class="hidden">${t('page.wall')}</h2><div class="wall"><div class="pictures">${
    hasDrawings(link) ? html`<div class="touchable">${wholeWall(link, touchWall(link))}</div>${touchedPanel(link)}`
      : wholeWall(link)}${views(channelsOf(link))}
      <p class="note">${t('preview.note')}${hasDrawings(link) ? ` ${t('drawing.touchNote')}` : ''}</p></div>
    <div class="controls">${light(link)}
      <section class="panel" aria-labelledby="shown"><h2 id="shown">${t('wall.shown')}</h2><div class="choosers">
        ${chooser(link, 'scene', link.known.snapshot.scenes, link.shown.scene, value => link.show({scene: value},
          `${t('wall.scene')}: ${word(value)}`))}
        ${chooser(link, 'day', DAYS, dayOf(link), value => link.show({day: value.toUpperCase().replace(' ', '_')},
          `${t('wall.day')}: ${word(value)}`))}
        ${chooser(link, 'quality', QUALITIES, qualityOf(link), value => link.show({quality: value.toUpperCase()},
        `${t('wall.quality')}: ${word(value)}`))}
        ${patternChooser(link)}
        ${slider(link, 'colour', (link.shown.colourReturned ?? 0) / 255, value => link.show({colourReturned: value},
          `${t('wall.colour')}: ${percentOf(value)}`))}
        </div><p class="note">${t('wall.patternNote')}</p></section>
      ${helmPanel(link)}</div>${figures(link)}</div>`,
};

// --- doctor

const doctorPage = {
  look: () => ({topics: ['doctor']}),
  view: link => {
    const report = link.known.doctor ?? {};
    const findings = report.findings ?? [];
    const count = verdict => findings.filter(finding => finding.verdict === verdict).length;
    return html`<section class="panel"><h2>${t('page.doctor')}</h2>
      <div class="row">${button(t('doctor.run'), () => link.command({runDoctor: true}, t('doctor.run')),
        {disabled: !link.may('WATCHER') || report.running})}
      <span role="status">${report.running ? t('doctor.running') : report.atS ? t('doctor.result',
      {time: time(report.atS), pass: count('pass'), warn: count('warn'), fail: count('fail')})
        : t('doctor.never')}</span></div>
      ${report.problem ? html`<p class="bad">${report.problem}</p>` : nothing}
      <div class="scroll" tabindex="0" role="region" aria-label=${t('page.doctor')}><table><thead><tr>${['verdict',
        'subject', 'what', 'todo'].map(head => html`<th scope="col">${t(`doctor.${head}`)}</th>`)}</tr></thead>
      <tbody>${[...findings].sort((a, b) => 'fwp'.indexOf(a.verdict[0]) - 'fwp'.indexOf(b.verdict[0])).map(finding =>
      html`<tr>
        <td>${state(finding.verdict)}</td><td>${finding.subject}</td><td>${finding.what}</td><td>${
        finding.todo}</td></tr>`)}</tbody></table></div></section>`;
  },
};

// --- events and alerts

export const standing = link => (link.known.alerts?.alerts ?? []).filter(alert => alert.state !== 'acknowledged');
const alertItem = link => alert => html`<li>${state(alert.state)}<span>${word(alert.text)}</span><span
  class="quiet">${t('alert.since', {time: dateTime(alert.sinceS)})}</span>
  ${alert.state === 'acknowledged' ? nothing : button(t('alert.acknowledge'),
  () => link.command({acknowledge: alert.key}, t('alert.acknowledge')), {disabled: !link.may('OPERATOR')})}</li>`;

const eventsPage = {
  look: () => ({}),
  view: link => {
    const alerts = link.known.alerts?.alerts ?? [];
    return html`<section class="panel"><h2>${t('alert.title')}</h2>
      ${alerts.length ? html`<ul class="alerts">${alerts.map(alertItem(link))}</ul>`
        : html`<p class="good">● ${t('alert.none')}</p>`}</section>
      <section class="panel wide"><h2>${t('page.events')}</h2><ol
      class="events">${(link.known.events?.events ?? []).map(event => html`
        <li><span class="quiet">${dateTime(event.atS)}</span><strong>${word(event.who)}</strong><span>${
        word(event.what)}</span></li>`)}</ol></section>`;
  },
};

// --- log

const logPage = {
  look: () => ({topics: ['log'], ...filter}),
  view: link => {
    const change = (name, value) => { filter[name] = value; link.look = logPage.look(link); link.sayLook(); };
    const log = link.known.log ?? {};
    return html`<section class="panel wide"><h2>${t('page.log')}</h2>
      <div class="row"><label for="logNode">${t('log.node')}</label><select id="logNode"
        @change=${event => change('logNode', event.target.value)}>
        <option value="">${t('log.all')}</option>${['master', ...namesOf(link)].map(name => html`<option
        ?selected=${name === filter.logNode}>${name}</option>`)}</select>
      <label for="logText">${t('log.text')}</label><input id="logText" type="search" maxlength="100"
      .value=${filter.logText} @input=${event => change('logText', event.target.value)}>
      ${button(t('log.problems'), () => change('logProblemsOnly', !filter.logProblemsOnly),
      {pressed: String(filter.logProblemsOnly)})}
      <a class="button" href="/bundle.zip" download>${t('log.bundle')}</a></div>
      ${log.problem ? html`<p class="warn">${log.problem}</p>` : nothing}
      <div class="scroll" tabindex="0" role="region" aria-label=${t('page.log')}><table
        class="log"><thead><tr>${['time', 'node', 'severity', 'frame',
          'line'].map(head => html`<th scope="col">${t(`log.${head}`)}</th>`)}</tr></thead>
      <tbody>${[...(log.rows ?? [])].reverse().map(row => html`<tr><td
      title=${row.time}>${new Date(row.time).toLocaleTimeString(document.documentElement.lang,
        {hour12: false})}</td><td>${row.node}</td><td>${state(row.severity)}</td><td
        class="n">${row.frame}</td><td>${row.text}</td></tr>`)}</tbody></table></div></section>`;
  },
};

// --- mind: the values of an Explanation (aquarama.proto) are drawn, its lines are shown below

const SEEN = {PREDATOR: '▲', FOOD: '•', MATE: '♥', PREY: '◆'};
// What the fish sees and where, its nose up.
function compass(seen) {
  const place = one => {
    const reach = 90 * Math.min(1, Math.log1p(one.distanceLengths) / Math.log1p(60));
    const turn = one.degreesRight * Math.PI / 180;
    return [100 + reach * Math.sin(turn), 100 - reach * Math.cos(turn)];
  };
  const text = seen.map(one => `${t(`mind.sees.${one.kind}`)}: ${one.name}, ${one.distanceLengths.toFixed(1)} L`)
    .join('; ') || t('mind.seesNothing');
  const mark = one => { const [x, y] = place(one);
    return svg`<text x=${x} y=${y + 5} text-anchor="middle">${SEEN[one.kind]}</text><text class="small" x=${x}
      y=${y + 18} text-anchor="middle">${t(`mind.sees.${one.kind}`)}</text>`; };
  return html`<svg class="compass" viewBox="-30 0 260 205" role="img" aria-label=${text}><circle cx="100" cy="100"
  r="90"></circle><circle cx="100" cy="100" r="45"></circle>
    <path d="M100 84 L106 112 L100 107 L94 112 Z"></path>${seen.map(mark)}</svg>`;
}
function drawnMind(mind) {
  const intends = mind.intention && t('mind.aim', {what: `${t(`mind.intends.${mind.intention}`)} ${mind.target}`.trim(),
    seconds: mind.pursuedS.toFixed(1)});
  return html`<div class="drawn"><div>${compass(mind.seen ?? [])}<p class="note">${t('mind.compass')}</p></div>
    <div><p class="intends">${intends || t('mind.away')}</p>${['hunger', 'libido',
      'fear'].map(name => html`<p class="row"><span class="name" id=${`feels-${name}`}>${t(`mind.${name}`)}</span>
      <meter aria-labelledby=${`feels-${name}`} min="0" max="1"
      value=${mind[name] ?? 0}></meter> ${Math.round(100 * (mind[name] ?? 0))} %</p>`)}</div></div>`;
}

const mindPage = {
  look: link => ({topics: ['mind', 'panorama'], channels: namesOf(link), widthPx: 480}),
  view: link => {
    const mind = link.known.mind, explained = mind?.explanation;
    const point = (channel, {frame, x, y}) => link.command({pointAt: {channel: channel.name, frame, x, y}},
      t('mind.asking'));
    const ask = event => { event.preventDefault(); link.command({mind: Number(event.target.fish.value)},
    t('mind.asking')); };
    return html`<div class="mind"><div>${wholeWall(link, point)}<p class="note">${t('mind.hint')}</p></div>
      <section class="panel"><h2>${mind && mind.fish >= 0 ? t('mind.of', {fish: mind.fish}) : t('page.mind')}</h2>
      <form class="row" @submit=${ask}><label for="fish">${t('mind.number')}</label><input id="fish" name="fish"
        type="number" min="0" max="99999" value="0">
        <button ?disabled=${!link.may('WATCHER')}>${t('mind.ask')}</button></form>
      <div role="status">${!mind ? t('mind.none') : mind.fish < 0 ? t('mind.noFish') : html`${explained?.lines?.length
        ? drawnMind(explained) : nothing}<pre>${(explained?.lines ?? []).join('\n')}</pre>`}</div></section></div>`;
  },
};

// --- who may use the console

const ROLES = ['WATCHER', 'OPERATOR', 'CREW'];
const peoplePage = {
  look: () => ({topics: ['people']}),
  view: link => {
    const people = link.known.people ?? {};
    const isCrew = link.role === 'CREW';
    return html`<section class="panel"><h2>${t('page.people')}</h2><p>${t('people.you', {name: link.known.snapshot.name,
      role: t(`role.${link.role}`)})}
      ${button(t('people.leave'), () => link.leave())}</p>
      ${!isCrew ? html`<p class="note">${t('people.crewOnly')}</p>` : html`
      <table><tbody>${(people.people ?? []).map(person => html`<tr><th scope="row">${person.name}${person.self
        ? ` (${t('people.self')})` : ''}</th>
        <td>${t(`role.${person.role}`)}</td><td class="quiet">${dateTime(person.sinceS)}</td>
        <td>${holdButton(t('people.revoke'), () => link.command({revoke: person.id}, t('people.revoke')),
          {disabled: !link.may('CREW') || person.self})}</td></tr>`)}</tbody></table>
      <h3>${t('people.letIn')}</h3><div class="row">${ROLES.map(role => button(t(`role.${role}`),
      () => link.command({newCode: role}, t('people.letIn')), {disabled: !link.may('CREW')}))}</div>
      <p role="status">${people.code ? html`<span class="code">${people.code}</span><br>${t('people.codeNote')}`
      : nothing}</p>`}</section>`;
  },
};

export const pages = {wall: wallPage, drawings: drawingsPage, nodes: nodesPage, events: eventsPage,
                      schedule: schedulePage, calibration: calibrationPage, doctor: doctorPage, log: logPage,
                      mind: mindPage, tour: tourPage, people: peoplePage};
