// SPDX-License-Identifier: Apache-2.0
// The page of the schedule: hours as a form. The form is an aquarama.v1.Hours (hours.proto), which the console checks.
// Each mistake is shown beside its field.
import {html, nothing, svg} from '/vendor/lit-html.js';
import {QUALITIES, button, holdButton, language, t, time, word} from '/widgets.js';

const DAYS = ['MONDAY', 'TUESDAY', 'WEDNESDAY', 'THURSDAY', 'FRIDAY', 'SATURDAY', 'SUNDAY'];
const dayName = (number, style) => new Date(Date.UTC(2024, 0, number)).toLocaleDateString(language(),
  {weekday: style, timeZone: 'UTC'});  // 2024 began with a Monday

// --- what is being written

let form = null;       // null: as it is kept
let sent = null;       // the number of the command that saves it
let textDraft = null;  // of the text
const formOf = ({form: kept = {}}) => ({zone: kept.zone || Intl.DateTimeFormat().resolvedOptions().timeZone,
  open: structuredClone(kept.open ?? []), exceptions: structuredClone(kept.exceptions ?? []),
  projectors: structuredClone(kept.projectors ?? [])});
const redraw = link => link.dispatchEvent(new Event('change'));
function edit(link, change) {
  form ??= formOf(link.known.hours ?? {});
  change(form);
  redraw(link);
}
const freshSpan = () => ({from: '10:00', to: '18:00'});
const freshWeekSpan = () => ({days: ['TUESDAY', 'WEDNESDAY', 'THURSDAY', 'FRIDAY'], ...freshSpan()});
function save(link) {
  sent = link.command({hours: form ?? formOf(link.known.hours ?? {})}, t('hours.save'));
}
// What is wrong, by the path of the field; by an empty path what is of no field.
function mistakes(link) {
  const command = link.commands.get(sent);
  if (command?.outcome === 'done') { form = null; sent = null; }
  if (command?.outcome !== 'refused') return new Map();
  const told = link.known.mistakes;
  return new Map(told?.request === sent ? told.mistakes.map(({field, what}) => [field, what])
    : [['', command.reason]]);
}

// --- fields

// What is wrong in a field, taken out of mistakes(): what stays is shown below the form.
function take(wrong, path) {
  const what = wrong.get(path);
  wrong.delete(path);
  return what;
}
// A field with its name above and what is wrong with it below. `wrong`: of mistakes().
function field(name, label, wrong, input) {
  const what = take(wrong, name);
  const isWrong = what !== undefined;
  const id = `h-${name.replaceAll('.', '-')}`;
  return html`<span class="field"><label for=${id}>${label}</label>${input({id, invalid: isWrong ? 'true' : nothing,
    about: isWrong ? `${id}-wrong` : nothing})}
    ${isWrong ? html`<span class="bad" role="alert" id=${`${id}-wrong`}>✖ ${what}</span>` : nothing}</span>`;
}
const OPTIONAL = ['scene', 'quality', 'password', 'input'];  // left out while empty
function put(object, name, value) {
  if (value === '' && OPTIONAL.includes(name)) delete object[name];
  else object[name] = value;
}
// "9:30" and "24:00" as an input of the type `time` takes them.
const clock = text => text === '24:00' ? '00:00' : text.split(':').map(part => part.padStart(2, '0')).join(':');
function write(link, wrong, object, name, path, label, type = 'text') {
  const value = object[name] ?? '';
  return field(path, label, wrong, ({id, invalid, about}) => html`<input id=${id} type=${type}
    .value=${type === 'time' && value ? clock(value) : value} ?disabled=${!link.may('CREW')}
    aria-invalid=${invalid} aria-describedby=${about} autocomplete="off"
    @change=${event => edit(link, now => put(at(now, path), name, event.target.value))}>`);
}
function choose(link, wrong, object, name, path, label, values) {
  const known = values.includes(object[name]) || !object[name] ? values : [...values, object[name]];
  return field(path, label, wrong, ({id, invalid, about}) => html`<select id=${id} ?disabled=${!link.may('CREW')}
    aria-invalid=${invalid} aria-describedby=${about}
    @change=${event => edit(link, now => put(at(now, path), name, event.target.value))}>
    <option value="" ?selected=${!object[name]}>${t('hours.asItWas')}</option>
    ${known.map(value => html`<option value=${value}
      ?selected=${value === object[name]}>${word(value)}</option>`)}</select>`);
}
// The part of a form that a path such as open.0.from is in.
const at = (form, path) => path.split('.').slice(0, -1).reduce((part, name) => part[name], form);

function spanFields(link, wrong, one, path) {
  return html`${write(link, wrong, one, 'from', `${path}.from`, t('hours.from'), 'time')}${write(link, wrong, one, 'to',
    `${path}.to`, t('hours.to'), 'time')}
    ${choose(link, wrong, one, 'scene', `${path}.scene`, t('wall.scene'), link.known.snapshot.scenes ?? [])}
    ${choose(link, wrong, one, 'quality', `${path}.quality`, t('wall.quality'), QUALITIES)}`;
}
function days(link, wrong, one, path) {
  const toggle = day => edit(link, now => {
    const span = at(now, `${path}.days`);
    span.days = DAYS.filter(other => (other === day) !== span.days.includes(other));
  });
  const what = take(wrong, `${path}.days`);
  return html`<span class="field"><span class="label">${t('hours.days')}</span><span class="days" role="group"
    aria-label=${t('hours.days')}>${DAYS.map((day, i) => html`<button type="button"
    aria-pressed=${String(one.days.includes(day))} aria-label=${dayName(i + 1, 'long')}
    ?disabled=${!link.may('CREW')} @click=${() => toggle(day)}>${dayName(i + 1, 'short')}</button>`)}</span>
    ${what ? html`<span class="bad" role="alert">✖ ${what}</span>` : nothing}</span>`;
}
const remove = (link, path, what) => button(t(what === 'exception' ? 'hours.removeDay' : 'hours.remove'),
  () => edit(link, now => { at(now, path).splice(Number(path.split('.').at(-1)), 1); }),
                                           {disabled: !link.may('CREW'), of: what});
const add = (link, label, change) => button(label, () => edit(link, change), {disabled: !link.may('CREW')});

// A week as bars; hours of the next day are on the next one.
function week(hours) {
  const minute = text => { const [h, m] = (text || '0:0').split(':').map(Number); return 60 * h + m; };
  const bars = [];
  for (const span of hours.open) for (const name of span.days) {
    const day = DAYS.indexOf(name);
    const from = minute(span.from), to = minute(span.to) > from ? minute(span.to) : minute(span.to) + 1440;
    bars.push([day, from, Math.min(to, 1440)]);
    if (to > 1440) bars.push([(day + 1) % 7, 0, to - 1440]);
  }
  const said = hours.open.map(span =>
    `${span.days.map(day => dayName(DAYS.indexOf(day) + 1, 'long')).join(', ')}: ${span.from} – ${span.to}`).join('; ');
  const x = minutes => 40 + minutes / 1440 * 560;
  return html`<svg class="week" viewBox="0 0 610 150" role="img" aria-label=${said || t('hours.alwaysClosed')}>
    ${[0, 6, 12, 18, 24].map(hour => svg`<line x1=${x(60 * hour)} x2=${x(60 * hour)} y1="4" y2="132"></line><text
      x=${x(60 * hour)} y="146" text-anchor="middle">${hour}</text>`)}
    ${DAYS.map((_, i) => svg`<text x="32" y=${17 + 18 * i} text-anchor="end">${dayName(i + 1, 'short')}</text>`)}
    ${bars.map(([day, from, to]) => svg`<rect x=${x(from)} width=${x(to) - x(from)} y=${6 + 18 * day} height="13"
      rx="2"></rect>`)}</svg>`;
}

function hoursForm(link) {
  const wrong = mistakes(link);
  const now = form ?? formOf(link.known.hours ?? {});
  const isCrew = link.may('CREW');
  const hasComments = /^\s*#|[^"]#/m.test(link.known.hours?.text ?? '');
  return html`<section class="panel hours" aria-labelledby="week"><h2 id="week">${t('hours.week')}</h2>${week(now)}
    <ol class="spans">${now.open.map((one, i) => html`<li>${days(link, wrong, one, `open.${i}`)}${spanFields(link,
      wrong, one, `open.${i}`)}${remove(link, `open.${i}`, 'span')}</li>`)}</ol>
    <div class="row">${add(link, t('hours.addSpan'), form => form.open.push(freshWeekSpan()))}</div>
    <h2>${t('hours.exceptions')}</h2>
    <ol class="spans">${now.exceptions.map((day, i) =>
      html`<li>${write(link, wrong, day, 'date', `exceptions.${i}.date`, t('hours.date'), 'date')}
      ${day.open.length ? nothing : html`<span class="note">${t('hours.closedAllDay')}</span>`}
      ${day.open.map((one, j) => html`<span class="inner">${spanFields(link, wrong, one,
        `exceptions.${i}.open.${j}`)}${remove(link, `exceptions.${i}.open.${j}`, 'span of a day')}</span>`)}
      ${add(link, t('hours.addSpanOfDay'), form => form.exceptions[i].open.push(freshSpan()))}${remove(link,
      `exceptions.${i}`, 'exception')}</li>`)}</ol>
    <div class="row">${add(link, t('hours.addException'), form => form.exceptions.push({date: '', open: []}))}</div>
    <h2>${t('projector.title')}</h2><p class="note">${t('hours.projectorNote')}</p>
    <ol class="spans">${now.projectors.map((one, i) =>
      html`<li>${write(link, wrong, one, 'name', `projectors.${i}.name`, t('projector.name'))}
      ${write(link, wrong, one, 'address', `projectors.${i}.address`, t('projector.address'))}
      ${write(link, wrong, one, 'input', `projectors.${i}.input`, t('projector.inputCode'))}
      ${isCrew ? write(link, wrong, one, 'password', `projectors.${i}.password`, t('projector.password'))
        : nothing}${remove(link, `projectors.${i}`, 'projector')}</li>`)}</ol>
    <div class="row">${add(link, t('hours.addProjector'),
    form => form.projectors.push({name: '', address: ''}))}</div>
    <h2>${t('hours.clock')}</h2>${write(link, wrong, now, 'zone', 'zone', t('hours.zone'))}
    ${[...wrong.values()].map(what => html`<p class="bad" role="alert">✖ ${what}</p>`)}
    <div class="row save"><button class="primary" ?disabled=${!isCrew || (form === null && link.known.hours?.present)}
      @click=${() => save(link)}>${t('hours.save')}</button>
      ${button(t('hours.discard'), () => { form = null; sent = null; redraw(link); }, {disabled: form === null})}
      ${form !== null ? html`<span class="warn">▲ ${t('hours.notSaved')}</span>` : nothing}
      ${form !== null && hasComments ? html`<span class="note">${t('hours.losesComments')}</span>`
        : nothing}</div></section>`;
}

// The same as text: for who copies it from one hall to another.
function asText(link) {
  const kept = link.known.hours?.text ?? '';
  if (textDraft === kept) textDraft = null;  // saved
  const write = event => { textDraft = event.target.value; redraw(link); };
  return html`<section class="panel"><details
    ?open=${Boolean(link.known.hours?.problem)}><summary>${t('hours.text')}</summary>
    <textarea id="hours" rows="10" spellcheck="false" aria-label=${t('hours.text')} ?readonly=${!link.may('CREW')}
    .value=${textDraft ?? kept} @input=${write}></textarea>
    <div class="row">${button(t('hours.saveText'), () => link.command({hoursText: textDraft}, t('hours.saveText')),
    {disabled: !link.may('CREW') || textDraft === null})}</div>
    <p class="note">${t('hours.textNote')}</p></details></section>`;
}

// --- now, and projectors

function standing(link) {
  const hours = link.known.hours ?? {};
  const held = link.wall.heldUntilS > 0;
  const next = t(`hours.${hours.next ?? 'stays'}`, {at: hours.nextAt, scene: hours.nextScene ? word(hours.nextScene)
    : t('hours.sceneAsItWas')});
  return html`<section class="panel"><h2>${t('page.schedule')}</h2>
    <p role="status">${link.wall.onBattery
      ? html`<strong class="warn">▲ ${t('hours.onBattery')}</strong>` : held
      ? html`<strong class="warn">▲ ${t('hours.held', {time: time(link.wall.heldUntilS)})}</strong>`
      : hours.problem ? html`<strong class="bad">✖ ${t('hours.unreadable')}</strong> ${hours.problem}`
      : hours.present ? html`<strong class=${hours.open ? 'good' : 'quiet'}>${hours.open ? '●'
        : '○'} ${t(hours.open ? 'hours.isOpen' : link.shown.black ? 'hours.isClosed' : 'hours.isLitByHand')}</strong> ${
          next}` : t('hours.none')}</p>
    <div class="row">${held ? button(t('hours.goOn'), () => link.command({holdHours: 0}, t('hours.goOn')),
    {disabled: !link.may('OPERATOR')})
      : button(t('hours.hold'), () => link.command({holdHours: 2}, t('hours.hold')),
      {disabled: !link.may('OPERATOR')})}<span class="note">${t('hours.holdNote')}</span></div></section>`;
}
const SHAPES = {on: ['●', 'good'], off: ['○', 'quiet']};
// What is unknown stands there as such, and both ways are offered.
const unknown = () => html`<span class="quiet">${word('unknown')}</span>`;
const inputOf = one => {
  if (!one.wantedInput) return '–';
  return one.input === 'unknown' ? unknown() : one.input === one.wantedInput ? one.input
    : html`<span class="warn">▲ ${t('projector.otherInput', {is: one.input, wanted: one.wantedInput})}</span>`;
};
const projectorRow = link => one => {
  const state = one.reach === 'answers' ? one.power : one.reach;
  const [shape, kind] = SHAPES[state] ?? ['▲', 'warn'];
  const shutter = one.shut === undefined ? unknown() : t(one.shut ? 'projector.isShut' : 'projector.isOpen');
  const lamp = one.lampHours === undefined ? unknown() : t('projector.hours', {n: one.lampHours});
  const problems = one.problems?.length ? one.problems.join(', ') : one.tellsProblems ? '–' : unknown();
  const command = (label, wanted) => holdButton(t(label), () => link.command({projector: {name: one.name, ...wanted}},
    one.name), {disabled: !link.may('CREW')});
  return html`<tr><th scope="row">${one.name}</th><td data-head=${t('projector.power')}><span
  class=${kind}>${shape} ${word(state)}</span></td>
  <td data-head=${t('projector.shutter')}>${shutter}</td><td data-head=${t('projector.input')}>${inputOf(one)}</td><td
  class="n" data-head=${t('projector.lamp')}>${lamp}</td>
  <td data-head=${t('projector.problems')} class=${one.problems?.length ? 'bad' : ''}>${problems}</td>
  <td data-head=""><div class="row">${one.shut !== false ? command('projector.open', {shut: false})
    : nothing}${one.shut !== true ? command('projector.shut', {shut: true}) : nothing}
    ${one.power !== 'on' ? command('projector.on', {power: true}) : nothing}${!['off', 'cooling'].includes(one.power)
    ? command('projector.off', {power: false}) : nothing}</div></td></tr>`;
};
function projectors(link) {
  const list = link.known.projectors?.projectors ?? [];
  if (!list.length) return nothing;
  const all = (label, wanted) => holdButton(label, () => link.command({projector: wanted}, label),
    {disabled: !link.may('CREW'), of: 'all'});
  return html`<section class="panel"><div class="scroll" tabindex="0" role="region"
  aria-label=${t('projector.title')}><table class="cards"><caption>${t('projector.title')}</caption>
    <thead><tr><th scope="col">${t('projector.name')}</th>${['power', 'shutter', 'input', 'lamp',
    'problems'].map(name => html`<th scope="col"
      class=${name === 'lamp' ? 'n' : ''}>${t(`projector.${name}`)}</th>`)}<td></td></tr></thead>
    <tbody>${list.map(projectorRow(link))}</tbody></table></div>
    <div class="row">${all(t('projector.allOn'), {power: true})}${all(t('projector.allOff'), {power: false})}${
      all(t('projector.allShut'), {shut: true})}${all(t('projector.allOpen'), {shut: false})}</div></section>`;
}

export const schedulePage = {
  look: () => ({topics: ['hours']}),
  view: link => html`${standing(link)}${projectors(link)}${link.known.hours?.problem ? nothing
    : hoursForm(link)}${link.role === 'CREW' ? asText(link) : nothing}`,
};
