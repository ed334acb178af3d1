// A visitor's drawing: how its photograph is sent, and what its fish does then.

const MOST_BYTES = 16 * 1024 * 1024; // drawing_reader.h
const SHOWN_MS = 3000; // a sentence stays so long, so that it can be read

const element = id => document.getElementById(id);

const filled = (text, values = {}) => text.replace(/{(\w+)}/g, (_, name) => values[name]);

/** The sentence for what a fish does, with whomever it is about where there is one. */
export function deedIn(texts, {does, whom, saw}) {
  const named = species => texts[`fish_${species}`] ?? texts.fish_other;
  const keys = [saw && `does_${does}_saw`, whom && `does_${does}_whom`, `does_${does}`, "does"];
  return filled(texts[keys.find(key => key in texts)], {saw: named(saw), whom: named(whom)});
}

/** Pictures of an iPhone, which only Apple's programs read. */
async function isHeic(file) {
  const start = new TextDecoder("latin1").decode(await file.slice(0, 12).arrayBuffer());
  return start.slice(4, 8) === "ftyp";
}

/** The server's word for what it says to a picture; empty: it takes it. progressed() hears the share that is sent. */
function send(file, side, secret, progressed) {
  return new Promise(resolve => {
    const request = new XMLHttpRequest();
    request.open("POST", `/drawing/${side}`);
    request.setRequestHeader("Authorization", `Bearer ${secret}`);
    request.upload.onprogress = event => progressed(event.loaded / event.total);
    request.onload = () => resolve(request.status === 202 ? "" : request.responseText);
    request.onerror = request.ontimeout = () => resolve("lost");
    request.timeout = 40000;
    request.send(file);
  });
}

/** Returns a function that draws what the server says of drawings (state.drawings). secret(): of the visitor. */
export function drawing(texts, secret) {
  const text = (key, values) => filled(texts[key], values);
  const shown = new Map(); // number -> {words, since}
  let side = "middle", refused = "", share = null, told = null;

  function words(fish) {
    const before = shown.get(fish.number), now = performance.now();
    const next = text(`is_${fish.is}`, {n: fish.number}) + (fish.is === "swimming" ? ` ${deedIn(texts, fish)}` : "");
    const stays = before && before.is === fish.is && now - before.since < SHOWN_MS;
    if (!stays && before?.words !== next) shown.set(fish.number, {words: next, is: fish.is, since: now});
    return shown.get(fish.number).words;
  }

  function draw() {
    const isOn = Boolean(told);
    document.body.classList.toggle("drawings", isOn);
    if (!isOn) return;
    const list = element("fish");
    while (list.children.length > told.fish.length) list.lastChild.remove();
    while (list.children.length < told.fish.length) list.append(document.createElement("li"));
    told.fish.forEach((fish, index) => {
      const line = words(fish);
      if (list.children[index].textContent !== line) list.children[index].textContent = line;
    });
    const isBusy = told.reading || share !== null;
    const why = isBusy ? "" : refused || told.refused;
    const state = share !== null ? text("sending") : told.reading ? text("reading")
      : why ? texts[`picture_${why}`] ?? texts.picture_unreadable : "";
    if (element("drawing-state").textContent !== state) element("drawing-state").textContent = state;
    element("sent").hidden = share === null;
    element("sent").value = share ?? 0;
    element("draw").disabled = isBusy || told.wait_s > 0;
    element("draw").textContent = told.wait_s > 0 && !isBusy ? text("draw_wait", {n: told.wait_s})
      : text(told.fish.length ? "draw_again" : "draw");
    if (isBusy) open(false);
  }

  function open(is) {
    element("sending").hidden = !is;
    element("draw").setAttribute("aria-expanded", is);
  }

  async function take(input) {
    const [file] = input.files;
    input.value = "";
    if (!file) return;
    open(false);
    if (file.size > MOST_BYTES) refused = "too_large";
    else if (await isHeic(file)) refused = "heic";
    else {
      const progressed = now => { share = now; draw(); };
      progressed(0);
      refused = await send(file, side, secret(), progressed);
      share = null;
      if (!refused && told) told.reading = true;
    }
    draw();
  }

  element("draw").addEventListener("click", () => {
    refused = "";
    open(element("sending").hidden);
  });
  for (const button of document.querySelectorAll("[data-side]"))
    button.addEventListener("click", () => {
      side = button.dataset.side;
      for (const one of document.querySelectorAll("[data-side]")) one.setAttribute("aria-pressed", one === button);
    });
  for (const id of ["camera", "choose"]) {
    element(id).addEventListener("click", () => element(`${id}-file`).click());
    element(`${id}-file`).addEventListener("change", event => take(event.target));
  }
  return now => { told = now; draw(); };
}
