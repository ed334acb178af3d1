// The way to aquarama-guests: a WebSocket that is opened again and again, and the secret by which a visitor is known.

const ELSEWHERE = 4001; // guests.h
const STALE_MS = 2000;

function kept() {
  try { return localStorage.getItem("session"); } catch { return null; }
}

function keep(secret) {
  try { secret ? localStorage.setItem("session", secret) : localStorage.removeItem("session"); } catch { /* private */ }
}

/** Calls heard(message) for each message of state, refused(why), and stale(whether nothing was heard for 2 s). */
export class Link {
  #socket = null;
  #code = ""; // of the address that was scanned, until it was said
  #secret = kept(); // beside the storage, which a private window may not have
  #heardAt = 0;
  #pause = 500;
  #ended = false;

  constructor({heard, refused, stale}) {
    Object.assign(this, {heard, refused, stale});
    const scanned = location.pathname.match(/^\/p\/([0-9a-z]+)$/i);
    if (scanned) {
      this.#code = scanned[1];
      history.replaceState(null, "", "/");
    }
    this.#open();
    setInterval(() => this.stale(performance.now() - this.#heardAt > STALE_MS), 250);
    document.addEventListener("visibilitychange", () => {
      if (!document.hidden && this.#socket?.readyState === WebSocket.CLOSED) this.#open();
    });
  }

  say(message) {
    if (this.#socket?.readyState === WebSocket.OPEN) this.#socket.send(JSON.stringify(message));
  }

  /** By which the visitor is known; null: not yet. */
  get secret() { return this.#secret; }

  enter(code) {
    this.#code = code;
    this.say({enter: code});
  }

  #open() {
    if (this.#ended || this.#socket?.readyState <= WebSocket.OPEN) return;
    const socket = this.#socket = new WebSocket(`ws://${location.host}/g`);
    socket.onopen = () => {
      this.#pause = 500;
      if (this.#secret) this.say({resume: this.#secret});
      else if (this.#code) this.enter(this.#code);
    };
    socket.onmessage = event => this.#take(JSON.parse(event.data));
    socket.onclose = event => {
      if (socket !== this.#socket) return;
      if (event.code === ELSEWHERE) {
        this.#ended = true;
        return this.refused("elsewhere");
      }
      setTimeout(() => this.#open(), this.#pause * (1 + Math.random()));
      this.#pause = Math.min(this.#pause * 2, 8000);
    };
  }

  #take(message) {
    this.#heardAt = performance.now();
    if (message.session) {
      this.#secret = message.session;
      keep(message.session);
      this.#code = "";
    } else if (message.refused === "session") { // of an earlier day
      this.#secret = null;
      keep(null);
      if (this.#code) this.enter(this.#code);
    } else if (message.refused === "busy" && this.#code) { // hundreds scan at once
      setTimeout(() => this.enter(this.#code), 1000 * (1 + 2 * Math.random()));
      this.refused("busy");
    } else if (message.refused) {
      this.#code = "";
      this.refused(message.refused);
    } else {
      if (message.you === "guest" && this.#code) this.say({join: true}); // scanned again
      if (!["stranger", "closed"].includes(message.you)) this.#code = "";
      this.heard(message);
    }
  }
}
