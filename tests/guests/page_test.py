"""The page of a visitor in Debian's chromium, 390 pixels wide, before a running wall.

With AQUARAMA_SHOTS=FOLDER it writes pictures of the page there, as docs/draw_pictures.sh has them.
"""

import math
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

from hall import BIN, Hall, Phone, aquarama, wait_until

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "console"))

from pages_test import AXE, browser  # noqa: E402: ends where the browser is missing

if not shutil.which("zbarimg"):
    print("SKIPPED: zbar-tools is needed to read the code on the wall (packaging/packages/guests-test.txt)")
    sys.exit(0)
SHOTS = os.environ.get("AQUARAMA_SHOTS")


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.hall = Hall(drawings="AT_ONCE")
        cls.addClassCleanup(cls.hall.close)
        wait_until(cls.hall.token, 20, "the code on the wall")
        cls.driver = browser(390, 844)
        cls.addClassCleanup(cls.driver.quit)

    def you(self):
        return self.js("return document.body.dataset.you")

    def js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def text(self):
        return self.js("return document.body.innerText")

    def click(self, selector):
        self.js("document.querySelector(arguments[0]).click()", selector)

    def becomes(self, you, seconds=5):
        wait_until(lambda: self.you() == you, seconds, f"the page says {you}, not {self.you()}")

    def shot(self, name):
        if SHOTS:
            self.driver.save_screenshot(f"{SHOTS}/guests_{name}.png")

    def looks_right(self, name):
        """axe finds nothing, nothing is wider than the phone, and what is touched is large enough."""
        self.shot(name)
        if not self.js("return 'axe' in window"):
            self.driver.execute_cdp_cmd("Runtime.evaluate", {"expression": AXE})
        found = self.driver.execute_async_script("axe.run().then(result => arguments[0](result.violations))")
        self.assertEqual([(one["id"], [node["html"] for node in one["nodes"]]) for one in found], [], name)
        self.assertLessEqual(self.js("return document.documentElement.scrollWidth"), 390)
        small = self.js("""return [...document.querySelectorAll('button, input')]
            .map(one => one.getBoundingClientRect())
            .filter(box => box.width > 0 && (box.width < 44 || box.height < 44)).length""")
        self.assertEqual(small, 0, "targets of 44 pixels")

    def touch(self, kind, *points):
        """Points: a selector, and shares of its radius to the right and up."""
        touched = []
        for number, (selector, right, up) in enumerate(points):
            box = self.js("const b = document.querySelector(arguments[0]).getBoundingClientRect();"
                          "return [b.x + b.width / 2, b.y + b.height / 2, b.width / 2]", selector)
            touched.append({"id": number, "x": box[0] + right * box[2], "y": box[1] - up * box[2]})
        self.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": touched})

    def test_a_visit(self):
        self.driver.get_log("browser")  # of other tests
        hall = self.hall
        first = Phone(hall, enter=hall.token())
        self.addCleanup(first.close)
        first.state("steering")
        self.driver.get(f"http://{hall.guests}/P/{hall.token()}")
        self.becomes("waiting")
        self.assertIn("You are next", self.text())
        self.assertEqual(self.js("return location.pathname"), "/", "no code is left in the history")
        self.looks_right("waiting")
        self.driver.refresh()
        self.becomes("waiting")

        first.say({"leave": True})
        self.becomes("steering")
        before, _ = hall.submarine()
        self.touch("touchStart", ("#way", 0, 0), ("#look", 0, 0))
        self.touch("touchMove", ("#way", 0.1, 0.9), ("#look", 0.5, 0.3))
        time.sleep(2)
        self.looks_right("steering")
        wait_until(lambda: hall.submarine()[1] != "nobody", 5, "the hand after the look")
        self.assertGreater(math.dist(before, hall.submarine()[0]), 0.3)
        self.touch("touchEnd")
        wait_until(lambda: hall.submarine()[1] == "nobody", 2, "the helm at rest")
        self.touch("touchStart", ("#rise", 0, 0))
        wait_until(lambda: hall.submarine()[1] != "nobody", 2, "a hand at the lever")
        self.touch("touchEnd")

        self.click("#feed")
        wait_until(lambda: "Feed again in" in self.text(), 2, "the pause after feeding")
        self.click("#hand-over")
        self.becomes("guest")
        self.looks_right("guest")
        self.click("#join")
        self.becomes("steering")
        said = [entry for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(said, [], "errors, or violations of the policy")

        # Nothing is heard for two seconds; then again.
        os.kill(hall.guests_process(), signal.SIGSTOP)
        try:
            wait_until(lambda: "Connection lost" in self.text(), 3, "the page says that it is lost")
            self.shot("lost")
        finally:
            os.kill(hall.guests_process(), signal.SIGCONT)
        wait_until(lambda: "Connection lost" not in self.text(), 5, "the page is back")

        aquarama("set", hall.rig, "guests", "off")
        self.becomes("closed")
        self.looks_right("closed")
        aquarama("set", hall.rig, "guests", "on")
        self.becomes("steering")

        # Without the secret of the visit, and in German, in the dark.
        self.click("#hand-over")
        self.js("localStorage.clear()")
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                    {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
        self.driver.execute_cdp_cmd("Emulation.setUserAgentOverride",
                                    {"userAgent": "test", "acceptLanguage": "de-DE,de"})
        self.driver.refresh()
        self.becomes("stranger")
        self.assertIn("Ziffern auf der Wand", self.text())
        self.looks_right("stranger")
        self.js("document.querySelector('#digits').value = 'abc'; document.querySelector('form').requestSubmit()")
        self.js("document.querySelector('#digits').pattern = '.*'; document.querySelector('form').requestSubmit()")
        wait_until(lambda: "gilt nicht mehr" in self.text(), 3, "digits that are wrong are refused")

    def enter(self):
        """As a visitor who was never here."""
        self.driver.get(f"http://{self.hall.guests}/icon.svg")
        self.js("localStorage.clear()")
        self.driver.get(f"http://{self.hall.guests}/P/{self.hall.token()}")
        wait_until(lambda: self.you() in ("steering", "waiting"), 5, "a seat")
        if self.you() == "steering":
            self.click("#hand-over")
            self.becomes("guest")
        wait_until(lambda: self.js("return !document.querySelector('#draw').disabled"), 5, "drawings are on")

    def send(self, name, content):
        path = Path(self.hall.folder.name) / name
        path.write_bytes(content)
        field = self.js("const one = document.querySelector('#choose-file'); one.hidden = false; return one")
        field.send_keys(str(path))
        self.js("arguments[0].hidden = true", field)

    def says(self, text, seconds=30):
        shown = lambda: self.js("return document.querySelector('.of-drawing').innerText")
        wait_until(lambda: text in shown(), seconds, f"the page says {text}, not {shown()}")

    def sheet(self):
        """A photograph of one: its own page."""
        folder = Path(self.hall.folder.name)
        subprocess.run([BIN / "aquarama-drawings", "sheets", "--species", "clownfish", "--out", folder], check=True,
                       stdout=subprocess.DEVNULL)
        subprocess.run(["pdftoppm", "-r", "100", "-jpeg", "-singlefile", folder / "clownfish.pdf", folder / "sheet"],
                       check=True)
        return (folder / "sheet.jpg").read_bytes()

    def test_a_drawing(self):
        hall = self.hall
        self.enter()
        self.looks_right("drawing")
        self.click("#draw")
        self.click("[data-side=left]")
        self.looks_right("drawing_sides")
        self.assertEqual(self.js("return document.querySelector('[aria-pressed=true]').dataset.side"), "left")
        self.send("IMG_1.HEIC", b"\0\0\0\x24ftypheic" + bytes(1000))
        self.says("HEIC")
        self.send("large.jpg", b"\xff\xd8\xff" + bytes(16 << 20))
        self.says("too large")
        self.send("noise.jpg", b"\xff\xd8\xff" + os.urandom(100_000))
        self.says("no picture that can be read")
        self.says("Another picture in")
        self.looks_right("drawing_refused")
        guests = hall.guests_process()
        self.enter()
        self.send("sheet.jpg", self.sheet())
        self.says("Your fish is number 1. It waits until there is room on the wall.")
        self.looks_right("drawing_waits")
        aquarama("set", hall.rig, "drawings", "off")
        wait_until(lambda: not self.js("return document.body.classList.contains('drawings')"), 5, "drawings are off")
        aquarama("set", hall.rig, "drawings", "on")
        self.says("Your fish is number 1.")
        self.assertEqual(hall.guests_process(), guests)
        self.assertEqual(hall.status()["late"], 0)

    def test_a_sentence_for_all_that_fish_do(self):
        """By the page's own words: none lacks one, in either language."""
        self.driver.get(f"http://{self.hall.guests}/")
        said = self.driver.execute_async_script("""(async done => {
            const said = [];
            const {deedIn} = await import('/drawing.js');
            for (const language of ['en', 'de']) {
              const texts = await (await fetch(`/texts/${language}.json`)).json();
              for (const does of ['wander', 'hover', 'graze', 'clean', 'visit', 'leave', 'school', 'eat', 'mate',
                                  'charge', 'rest', 'hide', 'escape', 'avoid_fish', 'avoid_obstacle', ''])
                for (const whom of ['', 'blue_tang', 'newt'])
                  for (const saw of ['', 'blacktip_reef_shark', 'newt']) said.push(deedIn(texts, {does, whom, saw}));
            }
            done(said);
            })(arguments[0])""")
        self.assertEqual(len(said), 2 * 16 * 9)
        self.assertTrue(all(re.fullmatch(r"[A-Z][^{}_]*\.", sentence) and "undefined" not in sentence
                            for sentence in said), said)
        self.assertIn("It saw the shark and hides in the coral.", said)
        self.assertIn("Er hat den Hai gesehen und versteckt sich in den Korallen.", said)


if __name__ == "__main__":
    unittest.main()
