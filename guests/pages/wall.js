// The small picture of the wall: pulled once a second while it is seen. Where a finger points, food goes.

const EVERY_MS = 1000;

// `say` tells the server; secret() is the visitor's; `mayLook` and `mayFeed` say whether that makes sense now.
export function wall(image, say, secret, mayLook, mayFeed) {
  let asked = 0, isAsked = false;

  image.addEventListener("load", () => {
    isAsked = false;
    image.classList.add("seen");
  });
  image.addEventListener("error", () => isAsked = false); // the connection says what is wrong
  setInterval(() => {
    if (isAsked || document.hidden || !mayLook()) return;
    isAsked = true;
    image.src = `/wall.jpg?${secret()}.${++asked}`;
  }, EVERY_MS);

  image.addEventListener("pointerdown", event => {
    if (!mayFeed()) return;
    const box = image.getBoundingClientRect();
    say({feed: [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height]});
  });
}
