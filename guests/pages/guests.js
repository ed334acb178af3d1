// The page of a visitor: what the server says of him is in body.dataset.you; the style sheet shows what belongs to it.

import {drawing} from "./drawing.js";
import {helm} from "./helm.js";
import {Link} from "./link.js";
import {wall} from "./wall.js";

const element = id => document.getElementById(id);
const LANGUAGES = ["en", "de"];

const language = navigator.languages.map(one => one.slice(0, 2)).find(one => LANGUAGES.includes(one)) ?? "en";
const texts = await (await fetch(`/texts/${language}.json`)).json();
document.documentElement.lang = language;
for (const one of document.querySelectorAll("[data-text]")) one.textContent = texts[one.dataset.text];
for (const one of document.querySelectorAll("[data-label]")) one.setAttribute("aria-label", texts[one.dataset.label]);

const text = (key, values = {}) => texts[key].replace(/{(\w+)}/g, (_, name) => values[name]);
let state = {you: "loading"}, endsAt = 0, isStale = false, refusal = "";

const clock = seconds => `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, "0")}`;

// Browsers allow it to a page that was touched.
function vibrate(pattern) {
  if (navigator.userActivation?.hasBeenActive) navigator.vibrate?.(pattern);
}

function set(id, content) {
  if (element(id).textContent !== content) element(id).textContent = content;
}

function draw() {
  const {you} = state;
  document.body.dataset.you = you;
  document.body.classList.toggle("stale", isStale);
  set("status", isStale ? text("lost") : text(`you_${you}`));
  set("more", isStale ? text("lost_more") : refusal ? text(`refused_${refusal}`)
    : you === "guest" && state.line >= state.most ? text("full") : texts[`more_${you}`] ?? "");
  if (you === "waiting") {
    set("wait", clock(state.wait_s));
    set("place", state.place > 1 ? text("place", {n: state.place - 1}) : text("next"));
  }
  if (you === "steering") set("left", text("left", {n: Math.max(0, Math.ceil((endsAt - performance.now()) / 1000))}));
  element("join").disabled = state.line >= state.most;
  element("feed").disabled = !(state.feed_s === 0);
  set("feed", state.feed_s > 0 ? text("fed", {n: state.feed_s}) : text("feed"));
  drawDrawing(state.drawings);
}

const link = new Link({
  heard(message) {
    if (message.you !== state.you) {
      rest();
      refusal = "";
      if (message.you === "steering") vibrate([200, 100, 200]);
      if (state.you === "steering") vibrate(400);
    }
    state = message;
    if (state.left_s !== undefined) endsAt = performance.now() + state.left_s * 1000;
    draw();
  },
  refused(why) {
    refusal = why;
    draw();
  },
  stale(is) {
    if (is && !isStale) rest();
    isStale = is && state.you !== "loading" || is && performance.now() > 3000;
    draw();
  },
});
const drawDrawing = drawing(texts, () => link.secret);
const rest = helm(message => link.say(message), () => state.you === "steering" && !isStale);

wall(element("wall"), message => link.say(message), () => link.secret,
  () => state.wall && state.you !== "steering" && !isStale, () => state.feed_s === 0);

document.querySelector("form").addEventListener("submit", event => {
  event.preventDefault();
  refusal = "";
  link.enter(element("digits").value);
  element("digits").value = "";
});
for (const [id, message] of [["join", {join: true}], ["leave-line", {leave: true}], ["hand-over", {leave: true}],
  ["feed", {feed: true}]])
  element(id).addEventListener("click", () => link.say(message));
document.addEventListener("contextmenu", event => event.preventDefault()); // a long press
