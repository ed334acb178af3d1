// SPDX-License-Identifier: Apache-2.0
// The WebSocket to the console: reconnects by itself, knows how old what it shows is, and sends commands.

const STALE_MS = 2000;
const bigRandom = () => {
  const [a, b] = crypto.getRandomValues(new Uint32Array(2));
  return ((BigInt(a) << 32n) | BigInt(b) | 1n).toString();
};

export class Link extends EventTarget {
  known = {};        // the latest of each topic, by its name in console.proto
  heardAt = -Infinity;
  paired = null;     // unknown yet
  commands = new Map();  // id -> {text, outcome, reason, at}
  look = {};
  #socket = null;
  #pause = 250;
  #build = null;

  get age() { return performance.now() - this.heardAt; }
  get isStale() { return this.age > STALE_MS; }
  get wall() { return this.known.wall ?? {}; }
  get status() { return this.wall.status ?? {}; }  // StatusReply of aquarama.proto; its 64-bit integers are strings
  get shown() { return this.status.show ?? {}; }   // Show of aquarama.proto: what the wall shows
  get role() { return this.known.snapshot?.role ?? 'WATCHER'; }
  may(role) {
    const order = ['WATCHER', 'OPERATOR', 'CREW'];
    return !this.isStale && order.indexOf(this.role) >= order.indexOf(role);
  }

  async start() {
    try {
      const me = await fetch('/me');
      this.paired = (await me.json()).role !== '';
    } catch { /* not there: the socket tries on */ }
    if (this.paired === false) return this.#tell();
    this.#connect();
  }

  #connect() {
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    const socket = this.#socket = new WebSocket(`${scheme}://${location.host}/ws`);
    socket.binaryType = 'arraybuffer';
    socket.onmessage = event => this.#hear(event.data);
    socket.onopen = () => { this.#pause = 250; this.sayLook(); };
    socket.onclose = event => {
      if (this.#socket !== socket) return;
      this.#socket = null;
      if (event.code === 4001) { this.paired = false; return this.#tell(); }
      setTimeout(() => this.start(), this.#pause);
      this.#pause = Math.min(this.#pause * 2, 4000);
    };
  }

  #hear(data) {
    this.heardAt = performance.now();
    if (typeof data !== 'string') return this.#picture(data);
    const message = JSON.parse(data);
    const [topic] = Object.keys(message);
    const content = message[topic];
    if (topic === 'snapshot') {
      if (this.#build && this.#build !== content.build) return location.reload();
      this.#build = content.build;
      for (const part of ['wall', 'events', 'alerts', 'hours', 'projectors']) this.known[part] = content[part];
    }
    if (topic === 'done') this.#done(content);
    this.known[topic] = content;
    if (topic === 'wall' || topic === 'snapshot') this.dispatchEvent(new Event('wall'));
    this.#tell();
  }

  #picture(buffer) {
    const view = new DataView(buffer);
    const picture = {channel: view.getUint16(0, true), frame: view.getBigUint64(8, true).toString(),
                     jpeg: new Blob([new Uint8Array(buffer, 16)], {type: 'image/jpeg'})};
    this.dispatchEvent(new CustomEvent('picture', {detail: picture}));
  }

  #done(done) {
    const command = this.commands.get(done.request);
    if (!command) return;
    Object.assign(command, {outcome: done.outcome.toLowerCase(), reason: done.reason, at: performance.now()});
  }

  #tell() { this.dispatchEvent(new Event('change')); }

  say(message) {
    if (this.#socket?.readyState === WebSocket.OPEN) this.#socket.send(JSON.stringify(message));
  }
  sayLook() { this.say({look: this.look}); }
  seen(channel) { this.say({seen: {channel}}); }

  // What the wall shall show, as {black: true}.
  show(wanted, text) { return this.command({order: {show: wanted}}, text); }

  // A command, as {order: {show: {black: true}}}; `text` is shown until it is done. Returns its number in `commands`.
  command(wanted, text) {
    if (this.isStale) return;
    const id = this.begin(text);
    this.say({command: {id, run: this.wall.run ?? '0', ...wanted}});
    this.#tell();
    return id;
  }
  // The number of a command that is sent in another way.
  begin(text) {
    const id = bigRandom();
    this.commands.set(id, {text, outcome: 'sent', reason: '', at: performance.now()});
    while (this.commands.size > 20) this.commands.delete(this.commands.keys().next().value);
    return id;
  }
  // What became of it, where the console has not said so.
  ended(id, outcome, reason) {
    this.#done({request: id, outcome, reason});
    this.#tell();
  }

  async pair(code, name) {
    const reply = await fetch('/pair', {method: 'POST', headers: {'Content-Type': 'application/json'},
                                        body: JSON.stringify({code, name})});
    this.paired = reply.ok;
    if (reply.ok) this.#connect();
    this.#tell();
    return reply.ok;
  }

  async leave() {
    await fetch('/leave', {method: 'POST', headers: {'Content-Type': 'application/json'}, body: '{}'});
    location.reload();
  }
}
