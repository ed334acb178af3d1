// SPDX-License-Identifier: Apache-2.0
// The page of the nodes: how each is, and how they were.
import {html, nothing} from '/vendor/lit-html.js';
import {Plot, button, channelsOf, conditionOf, filter, holdButton, ms, skewBars, state, t, time,
  word} from '/widgets.js';
import {releases} from '/releases.js';
import {waitingNodes} from '/waiting.js';

// --- figures of the last ten minutes and of the last day

const NOTHING = 65535;
// Bytes of u16, hundredths of a ms.
function valuesOf(text) {
  const bytes = Uint8Array.from(atob(text ?? ''), letter => letter.charCodeAt(0));
  const numbers = new DataView(bytes.buffer);
  return Array.from({length: bytes.length / 2}, (_, i) => {
    const value = numbers.getUint16(2 * i, true);
    return value === NOTHING ? null : value / 100;
  });
}

// The last values of each series; each message has their end, and says how many there were in all.
export class Ring {
  series = new Map();  // name -> values, the newest last
  #end = null;
  constructor(most) { this.most = most; }
  take(messages, end) {
    const fresh = this.#end === null ? -1 : end - this.#end;  // below 0: the console was started again
    for (const {name, values} of messages) {
      const own = valuesOf(values);
      const known = this.series.get(name);
      const next = !known || fresh < 0 ? own
        : fresh > own.length ? [...known, ...Array(fresh - own.length).fill(null), ...own]
        : fresh > 0 ? [...known, ...own.slice(-fresh)] : known;
      this.series.set(name, next.slice(-this.most));
    }
    this.#end = end;
  }
  named(wanted) { return [...this.series].filter(([name]) => wanted(name)).map(([name, values]) => ({name, values})); }
}

const tenths = new Ring(6000), minutes = new Ring(1440);
const isSkew = name => name === 'skew', isTime = name => name !== 'skew';
const plots = [[new Plot(0.1), tenths, isTime], [new Plot(0.1), tenths, isSkew], [new Plot(60), minutes, isTime],
  [new Plot(60), minutes, isSkew]];
let taken = null, drawnAt = 0;
function drawPlots(link) {
  const {history} = link.known;
  if (history && history !== taken) {
    taken = history;
    tenths.take(history.tenMinutes ?? [], history.tenths);
    minutes.take(history.day ?? [], history.minutes);
    drawnAt = 0;
  }
  const [{element}] = plots[0];
  if (drawnAt === element.clientWidth || link.isStale) return;
  drawnAt = element.clientWidth;
  for (const [plot, ring, isWanted] of plots) plot.show(ring.named(isWanted));
}

// --- one row a node

function showLog(name) {
  filter.logNode = name;
  location.hash = 'log';
}
// The cells of a row. `node`: a NodeStatus, without a report before the node's first. `cause`: one of Wall.causes.
const columns = {
  condition: (link, node, cause) =>
    html`${state(conditionOf(node))}${cause ? html`<div class="note">${word(cause)}</div>` : nothing}`,
  picture: (link, {report}) =>
    html`${ms(report?.pictureMedianMs)}<div class="note">99 % ${ms(report?.pictureP99Ms)}</div>`,
  late: (link, node) => node.late,
  dropped: (link, node) => node.dropped,
  fish: (link, node) => Number(node.hashMismatches) ? html`<span class="bad">✖ ${t('nodes.differs')}</span>`
    : html`<span class="good">● ${t('nodes.same')}</span>`,
  roundTrip: (link, {report}) => ms(report?.roundTripMedianMs, 2),
  celsius: (link, {report}) => report?.gpuCelsius ? `${report.gpuCelsius.toFixed(0)} °C` : '–',
  monitors: (link, {report}) => report?.monitors?.join(', ') || '–',
  machine: (link, {report}) => html`${report?.host || '–'}<div class="note"
    title=${report?.renderer}>${report?.renderer?.split(' (')[0]}</div>`,
  build: (link, {report}) => report?.build && report.build !== link.known.snapshot.build
    ? html`<span class="warn">▲ ${report.build}</span>` : report?.build || '–',
  act: (link, node) => html`<div class="row">
    ${holdButton(t('nodes.restart'), () => link.command({order: {restart: {channel: node.name}}},
        t('nodes.restarting', {name: node.name})),
      {disabled: !link.may('OPERATOR')})}
    ${button(t('nodes.log'), () => showLog(node.name))}</div>`,
};
const numbers = ['picture', 'late', 'dropped', 'roundTrip', 'celsius'];
const kind = name => numbers.includes(name) ? 'n' : '';
const nodeRow = link => (node, i) => html`<tr><th scope="row">${node.name}</th>
  ${Object.entries(columns).map(([name, cell]) => html`<td class=${kind(name)}
    data-head=${t(`nodes.${name}`)}>${cell(link, node, link.wall.causes?.[i])}</td>`)}</tr>`;

const power = (link, word) => holdButton(t(`nodes.${word}`), () => link.command({power: word}, t(`nodes.${word}`)),
                                         {disabled: !link.may('CREW') || !link.known.snapshot.hasPower, of: word});
// Machines beside the master's, as the rig has them: name -> the channels on it.
function machinesOf(link) {
  const machines = new Map();
  for (const {machine, name} of channelsOf(link)) if (machine) machines.set(machine, [...machines.get(machine) ?? [],
    name]);
  return machines;
}
// Told through any of its nodes that is there.
function machine(link, [name, channels]) {
  const told = (link.status.nodes ?? []).find(node => channels.includes(node.name) && node.report?.takesPowerWord
    && node.condition !== 'NODE_ABSENT');
  const act = word => {
    const label = t(`nodes.${word}Of`, {name});
    return holdButton(label, () => link.command({order: {power: {channel: told.name,
      word: word.toUpperCase()}}}, label),
      {disabled: !link.may('CREW') || !told, of: `${word} ${name}`});
  };
  return html`<div class="row">${act('reboot')}${act('poweroff')}</div>
    <p class="note">${t(told ? 'nodes.machineNote' : 'nodes.noMachine', {name, channels: channels.join(', ')})}</p>`;
}
function service(link) {
  const held = link.wall.heldUntilS > 0;
  return html`<section class="panel"><h2>${t('nodes.service')}</h2>
    <p role="status">${held ? html`<strong
      class="warn">▲ ${t('hours.held', {time: time(link.wall.heldUntilS)})}</strong>` : t('nodes.noService')}</p>
    <div class="row">${held ? button(t('hours.goOn'), () => link.command({holdHours: 0}, t('hours.goOn')),
    {disabled: !link.may('OPERATOR')})
      : button(t('hours.hold'), () => link.command({holdHours: 2}, t('hours.hold')), {disabled: !link.may('OPERATOR')})}
      <a class="button" href="/bundle.zip" download>${t('log.bundle')}</a></div>
    <p class="note">${t('nodes.serviceNote')}</p>
    <div class="row">${power(link, 'reboot')}${power(link, 'poweroff')}</div>
    <p class="note">${t(link.known.snapshot.hasPower ? 'nodes.powerNote' : 'nodes.noPower')}</p>
    ${[...machinesOf(link)].map(one => machine(link, one))}</section>`;
}

export const nodesPage = {
  look: () => ({topics: ['history', 'machines']}),
  view: link => {
    drawPlots(link);
    return html`<section class="panel wide"><div class="scroll" tabindex="0" role="region"
      aria-label=${t('page.nodes')}><table class="cards"><caption>${t('page.nodes')}</caption>
      <thead><tr><th scope="col">${t('nodes.node')}</th>${Object.keys(columns).map(name => html`<th scope="col"
      class=${kind(name)}>${t(`nodes.${name}`)}</th>`)}</tr></thead>
      <tbody>${(link.status.nodes ?? []).map(nodeRow(link))}</tbody></table></div></section>
      ${waitingNodes(link)}
      <div class="panels"><section
        class="panel"><h2>${t('skew.title')}</h2>${skewBars(link.status.skewCounts)}</section>
        ${service(link)}${releases(link)}</div>
      <div class="panels plots">${plots.map(([plot], i) => html`<section class="panel"><h2>${t(['nodes.tenMinutes',
      'nodes.tenMinutesSkew', 'nodes.day', 'nodes.daySkew'][i])}</h2>${plot.element}
        ${plot.isEmpty ? html`<p class="note">${t('nodes.noFigures')}</p>` : nothing}</section>`)}</div>`;
  },
};
