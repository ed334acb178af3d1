// SPDX-License-Identifier: Apache-2.0
// A new hall, step by step: what each has found, what to do, and where. The crew says what only they can see.
import {html, nothing} from '/vendor/lit-html.js';
import {button, durationOf, patternChooser, t} from '/widgets.js';

const MARKS = {done: ['●', 'good'], confirm: ['▲', 'warn'], todo: ['○', 'quiet']};
// The page on which a step is worked at.
const PAGES = {machines: 'nodes', channels: 'nodes', doctor: 'doctor', calibration: 'calibration', hours: 'schedule'};

const confirm = (link, {name, found}) => button(t('tour.confirm'),
  () => link.command({confirmStep: {name, found}}, `${t(`tour.${name}`)}: ${t('tour.confirm')}`),
  {disabled: !link.may('CREW')});
// `isNext`: the first that is to be done.
const row = (link, step, isNext) => {
  const {name, state, found, todo, seconds} = step;
  const [shape, kind] = MARKS[state] ?? ['?', 'quiet'];
  return html`<li aria-current=${isNext ? 'step' : nothing}><h3><span class=${kind}
    aria-hidden="true">${shape}</span> ${t(`tour.${name}`)} <span class="note">${t(`tour.is.${state}`)}${seconds > 0
    ? `, ${durationOf(seconds)}` : ''}</span></h3>
    <p>${found}</p>${todo ? html`<p class="note">${todo}</p>` : nothing}
    ${state === 'done' ? nothing : html`<div class="row">${state === 'confirm' ? confirm(link, step) : nothing}
      ${PAGES[name] ? html`<a class="button" href="#${PAGES[name]}">${t(`page.${PAGES[name]}`)}</a>` : nothing}</div>
    ${name === 'focus' ? html`<div class="choosers">${patternChooser(link)}</div>` : nothing}`}</li>`;
};

export const tourPage = {
  look: () => ({topics: ['tour']}),
  view: link => {
    if (!link.may('CREW')) return html`<section class="panel"><h2>${t('page.tour')}</h2><p
      class="note">${t('people.crewOnly')}</p></section>`;
    const {steps = [], seconds = 0, problem} = link.known.tour ?? {};
    const next = steps.findIndex(({state}) => state !== 'done');
    const doneCount = steps.filter(({state}) => state === 'done').length;
    return html`<section class="panel"><h2>${t('page.tour')}</h2><p role="status">${!link.known.tour ? t('tour.asking')
      : problem ? html`<span class="warn">▲ ${problem}</span>`
      : t('tour.sum', {done: doneCount, all: steps.length, time: durationOf(seconds)})}</p>
      <p class="note">${t('tour.note')}</p>
      <ol class="steps">${steps.map((step, i) => row(link, step, i === next))}</ol></section>`;
  },
};
