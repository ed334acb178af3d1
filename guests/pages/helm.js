// What a pilot does: two sticks and two levers, said 30 times a second at most and 10 times while something is held.

const MOST = 127;
const IDLE = 0.08; // of a stick's radius: a thumb that rests

/** A round field: the place of a thumb in it, [right, up] from -1 to 1. Calls moved() with it. */
function stick(field, moved) {
  const knob = field.querySelector("i");
  const set = (x, y) => {
    knob.style.transform = `translate(${x * 75}%, ${-y * 75}%)`;
    moved(Math.hypot(x, y) < IDLE ? [0, 0] : [x, y]);
  };
  const follow = event => {
    const box = field.getBoundingClientRect();
    const x = (event.clientX - box.left) / box.width * 2 - 1;
    const y = 1 - (event.clientY - box.top) / box.height * 2;
    const far = Math.max(1, Math.hypot(x, y));
    set(x / far, y / far);
  };
  field.addEventListener("pointerdown", event => { field.setPointerCapture(event.pointerId); follow(event); });
  field.addEventListener("pointermove", event => field.hasPointerCapture(event.pointerId) && follow(event));
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"])
    field.addEventListener(end, () => set(0, 0));
  return () => set(0, 0);
}

function lever(button, moved) {
  const set = held => { button.classList.toggle("held", held); moved(held); };
  button.addEventListener("pointerdown", event => { button.setPointerCapture(event.pointerId); set(true); });
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"])
    button.addEventListener(end, () => set(false));
  return () => set(false);
}

/** Says {helm: [ahead, aside, up, turn, tilt]} by say() while isPilot() holds. Returns what lets go of everything. */
export function helm(say, isPilot) {
  const hand = {way: [0, 0], look: [0, 0], rise: false, sink: false};
  const element = id => document.getElementById(id);
  const rests = [
    stick(element("way"), place => { hand.way = place; }), stick(element("look"), place => { hand.look = place; }),
    lever(element("rise"), held => { hand.rise = held; }), lever(element("sink"), held => { hand.sink = held; }),
  ];
  let said = "0,0,0,0,0", saidAt = 0;
  setInterval(() => {
    if (!isPilot()) return;
    const [aside, ahead] = hand.way, [right, up] = hand.look;
    const levers = [ahead, aside, hand.rise - hand.sink, -right, up].map(share => Math.round(share * MOST) + 0);
    const now = performance.now(), text = levers.join(), isHeld = levers.some(value => value !== 0);
    if (text === said && !(isHeld && now - saidAt >= 100)) return;
    say({helm: levers});
    said = text;
    saidAt = now;
  }, 34);
  return () => { rests.forEach(rest => rest()); said = "0,0,0,0,0"; };
}
