"""The pages in Debian's chromium, against running desks: what an operator sees and does, by pointer and by keyboard.

With AQUARAMA_SHOTS=FOLDER it writes pictures of the pages there, as docs/draw_pictures.sh has them.
"""

import base64
import io
import os
import re
import shutil
import signal
import socket
import sys
import time
import unittest
from pathlib import Path

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    webdriver = None

from desk import BIN, Desk, aquarama, rig_on_free_ports, wait_until
from show import lacks

DRIVER = Path("/usr/bin/chromedriver")
if webdriver is None or not DRIVER.exists():
    missing = ("chromium-driver and python3-selenium are needed to test the console's pages "
               "(packaging/packages/console-test.txt)")
    if os.environ.get("CI"):
        sys.exit(missing)
    print("SKIPPED:", missing)
    sys.exit(0)

import numpy as np  # with python3-scipy of packaging/packages/test.txt
from PIL import Image
from scipy.ndimage import gaussian_filter

AXE = (Path(__file__).parent / "axe/axe.min.js").read_text()
PAGES = ["wall", "drawings", "nodes", "events", "schedule", "calibration", "doctor", "log", "mind", "tour", "people"]
SHOTS = os.environ.get("AQUARAMA_SHOTS")
# For the picture of the guide.
WEEK = """zone: "Europe/Berlin"
open { days: [TUESDAY, WEDNESDAY, THURSDAY, FRIDAY] from: "10:00" to: "18:00" scene: "reef" }
open { days: [SATURDAY, SUNDAY, MONDAY] from: "10:00" to: "20:00" scene: "reef" quality: "high" }
exceptions { date: "2026-12-24" }
"""


def similarity(a, b):
    """Structural similarity (Wang et al. 2004) of two grey pictures with codes 0 to 255, in the mean: 1 where they are
    equal."""
    mean = lambda picture: gaussian_filter(picture, 1.5)
    ma, mb = mean(a), mean(b)
    va, vb, both = mean(a * a) - ma * ma, mean(b * b) - mb * mb, mean(a * b) - ma * mb
    c1, c2 = (0.01 * 255) ** 2, (0.03 * 255) ** 2
    return float(np.mean((2 * ma * mb + c1) * (2 * both + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2))))


def grey(picture, size=None):
    picture = picture.convert("L")
    return np.asarray(picture if size in (None, picture.size) else picture.resize(size, Image.BOX), float)


def browser(width=1280, height=900, language="en"):
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-background-networking",
                     f"--window-size={width},{height}"):
        options.add_argument(argument)
    options.add_experimental_option("prefs", {"intl.accept_languages": language})
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(service=Service(str(DRIVER)), options=options)
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                           {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 700})
    return driver


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # Four frames a second of a pattern: the nodes leave the processor to the browser.
        cls.desk = Desk(*(() if SHOTS else ("--pattern", "grid")), refresh_hz=15 if SHOTS else 4, calibrated=True,
                        more='drawings { species: ["clownfish", "blue_tang"] }', machines={"left": "pit"})
        cls.addClassCleanup(cls.desk.close)
        cls.pit = Path(cls.desk.folder.name) / "pit"
        cls.pit.mkdir()
        cls.desk.start_node("left", AQUARAMA_POWER_FOLDER=str(cls.pit))
        cls.driver = browser()
        cls.addClassCleanup(cls.driver.quit)
        cls.pair(cls.driver, cls.desk.code(), "Anna")

    @classmethod
    def pair(cls, driver, code, name):
        driver.get(f"http://{cls.desk.address}/")
        cls.find(driver, "#code").send_keys(code)
        cls.find(driver, "#name").send_keys(name)
        cls.find(driver, "form button").click()
        cls.find(driver, "header h1")

    @staticmethod
    def find(driver, selector, seconds=10):
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            found = driver.find_elements(By.CSS_SELECTOR, selector)
            if found:
                return found[0]
            time.sleep(0.02)
        raise AssertionError(f"{selector} is not on the page")

    def setUp(self):
        self.open("wall")

    def tearDown(self):
        said = [entry for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"
                and "WebSocket" not in entry["message"]]
        self.assertEqual(said, [], "errors, or violations of the policy")

    def open(self, page, driver=None):
        driver = driver or self.driver
        driver.get(f"http://{self.desk.address}/#{page}")
        wait_until(lambda: driver.execute_script(
            "return document.querySelector('nav a[aria-current]')?.hash") == f"#{page}", 10, page)

    def text(self, selector="body", driver=None):
        return (driver or self.driver).execute_script("return document.querySelector(arguments[0])?.innerText ?? ''",
                                                      selector)

    def button(self, label, driver=None):
        """Found and brought to the middle at once: pages are drawn again all the time, and their head stays."""
        found = (driver or self.driver).execute_script("""
            const found = [...document.querySelectorAll('button')].find(one => one.innerText.trim() === arguments[0]);
            found?.scrollIntoView({block: 'center'});
            return found ?? null;""", label)
        self.assertIsNotNone(found, f"no button {label}")
        return found

    def hold(self, label, seconds=1.3):
        ActionChains(self.driver).click_and_hold(self.button(label)).pause(seconds).release().perform()

    def shot(self, name, driver=None):
        if SHOTS:
            (driver or self.driver).save_screenshot(f"{SHOTS}/console_{name}.png")

    def is_drawn_black(self, channel):
        """Whether the preview of a channel is black; None before there is a picture."""
        return self.driver.execute_script("""
            const canvas = document.querySelectorAll('.views canvas')[arguments[0]];
            const codes = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
            let most = 0, drawn = false;
            for (let i = 0; i < codes.length; i += 4) {
                most = Math.max(most, codes[i], codes[i+1], codes[i+2]);
                drawn ||= codes[i+3] > 0;
            }
            return drawn ? most < 12 : null;""", channel)

    def test_the_page_shows_what_status_says(self):
        self.open("nodes")
        wait_until(lambda: self.text("tbody").count("in step") == 3, 10, "three nodes in step")
        rows = [row.split()[0] for row in self.text("tbody").splitlines() if row.split()
                and row.split()[0] in ("left", "middle", "right")]
        self.assertEqual(rows, ["left", "middle", "right"])
        column = lambda head: self.driver.execute_script(
            "return [...document.querySelectorAll(arguments[0])].map(cell => cell.innerText)", f"td[data-head={head}]")
        wait_until(lambda: [cell.split("\n")[0] for cell in column("Machine")] == 3 * [socket.gethostname()], 15,
                   "a report of each node")
        console_build = self.text("footer").splitlines()[0].removeprefix("console ")
        for build in column("Build"):
            self.assertRegex(build, r"\d+\.\d+\.\d+ \w+")
            self.assertEqual(build.startswith("▲"), build != console_build, "another build is marked")
        self.assertRegex(self.find(self.driver, "svg.bars").get_attribute("aria-label"),
                         r"≤ 0.05 ms: \d+, .*≤ ∞ ms: \d+")
        self.open("wall")
        self.assertIn("100 % of the light", self.text("section[aria-labelledby=light]"))
        self.assertRegex(self.text("section[aria-labelledby=helm]"), r"depth [1-9]\d*\.\d m, \d+\.\d m/s")
        shown = self.desk.status()
        figures = self.text("section[aria-labelledby=figures]")
        for value in (shown["scene"], shown["quality"], shown["pattern"]):
            self.assertIn(value, figures)
        self.assertRegex(figures, r"Journal\s+● written\s+newest save \d+ s old · [\d.]+ [kM]B in its file · "
                                  r"[\d.]+ [kMG]B in all · [\d.]+ [MGT]B free")
        frame = lambda: int(re.search(r"Frame\s+(\d+)", self.text("section[aria-labelledby=figures]"))[1])
        before = self.desk.status()["frame"]
        time.sleep(0.5)
        self.assertGreaterEqual(frame(), before)
        self.assertLessEqual(frame(), self.desk.status()["frame"])
        wait_until(lambda: re.search(r"\b1 browser\b", self.text("footer")), 10, "the only browser, in the singular")

    def test_black_is_held_shown_in_the_preview_and_undone_by_one_tap(self):
        wait_until(lambda: self.is_drawn_black(0) is False, 15, "a picture with light in it")
        wait_until(lambda: re.search(r"^frames? \d+( to \d+)?$", self.text("figure.whole figcaption")), 15,
                   "pictures of all channels")
        self.shot("wall")
        self.hold("Black", 0.4)
        time.sleep(0.5)
        self.assertEqual(self.desk.status()["black"], "off", "held for too short a time")
        place = self.button("Black").location
        self.hold("Black")
        wait_until(lambda: "the wall is black" in self.text("header"), 5, "the page to say so")
        self.assertEqual(self.desk.status()["black"], "on")
        wait_until(lambda: all(self.is_drawn_black(channel) for channel in range(3)), 15, "black previews")
        self.shot("black")
        undo = self.button("Light again")
        self.assertEqual(undo.location, place, "the way back is where black was")
        undo.click()
        wait_until(lambda: self.desk.status()["black"] == "off", 5, "light again")
        self.open("events")
        self.assertRegex(self.text("ol.events"), r"Anna\s+black off[^$]*Anna\s+black on")
        self.shot("events")

    def drawn(self, selector):
        """A canvas of the page as a picture."""
        url = self.driver.execute_script("return document.querySelector(arguments[0]).toDataURL('image/png')", selector)
        return Image.open(io.BytesIO(base64.b64decode(url.split(",")[1])))

    @unittest.skipIf(SHOTS, "pictures for the guide are of the reef")
    def test_the_previews_and_the_panorama_are_the_wall(self):
        """Against the pictures that a show of its own leaves with --snapshot: of the grid, which is the same in each
        frame."""
        folder = Path(self.desk.folder.name) / "still"
        folder.mkdir()
        rig = rig_on_free_ports(folder)
        rig.write_text(rig.read_text() + 'calibration: "hall.mpcdi"\n')
        shutil.copy(Path(self.desk.folder.name) / "hall.mpcdi", folder)
        still = aquarama("run", rig, "--headless", "--pattern", "grid", "--frames", "2", "--snapshot", folder)
        self.assertEqual(still.returncode, 0, still.stderr)
        wait_until(lambda: re.search(r"^frames? \d+( to \d+)?$", self.text("figure.whole figcaption")), 15,
                   "a panorama of all channels")
        time.sleep(0.3)
        for number, name in enumerate(("left", "middle", "right"), 1):
            preview = grey(self.drawn(f".views figure:nth-child({number}) canvas"))
            self.assertGreater(similarity(preview, grey(Image.open(folder / f"channel-{name}.png"),
                                                        preview.shape[::-1])), 0.95, name)
        drawn, wall = self.drawn("figure.whole canvas"), Image.open(folder / "panorama.png")
        of_wall = grey(wall, drawn.size)
        self.assertGreater(similarity(grey(drawn), of_wall), 0.97)
        self.assertLess(similarity(np.roll(grey(drawn), 2, axis=1), of_wall), 0.8,
                        "two pixels beside it is another wall")
        # Its colours too: those of the projectors, which the previews have, are undone.
        parts = lambda picture: np.asarray(picture.convert("RGB").resize(drawn.size, Image.BOX), float).reshape(-1, 3)
        apart = parts(drawn) - parts(wall)
        self.assertLess(np.abs(apart.mean(axis=0)).max(), 1.5, "codes of red, green and blue, in the mean")
        for colour, (one, other) in enumerate(zip(drawn.convert("RGB").split(), wall.convert("RGB").split())):
            self.assertGreater(similarity(grey(one), grey(other, drawn.size)), 0.97, "red green blue".split()[colour])

    def test_keyboard_alone_reaches_and_fires_everything(self):
        reached = set()
        for _ in range(60):
            ActionChains(self.driver).send_keys(Keys.TAB).perform()
            reached.add(self.driver.execute_script(
                "return document.activeElement.id || document.activeElement.innerText.split('\\u00a0')[0]"))
        self.assertLessEqual({"Wall", "Nodes", "Events", "Schedule", "Calibration", "Doctor", "Log", "Mind", "People",
                              "Black", "Freeze", "scene", "day", "quality", "pattern", "colour",
                              "Take the helm"}, reached)
        self.driver.execute_script(
            "[...document.querySelectorAll('button')].find(b => b.innerText === 'Black').focus()")
        ActionChains(self.driver).key_down(Keys.ENTER).pause(1.3).key_up(Keys.ENTER).perform()
        wait_until(lambda: self.desk.status()["black"] == "on", 5, "black by keyboard")
        self.driver.execute_script(
            "[...document.querySelectorAll('button')].find(b => b.innerText === 'Light again').focus()")
        ActionChains(self.driver).send_keys(Keys.ENTER).perform()
        wait_until(lambda: self.desk.status()["black"] == "off", 5, "light by keyboard")
        slider = self.driver.find_element(By.ID, "colour")
        before = self.desk.status()["colour"]
        slider.send_keys(Keys.HOME)
        wait_until(lambda: self.desk.status()["colour"] == "0.00", 5, "the water's own colour by keyboard")
        slider.send_keys(Keys.ARROW_RIGHT)
        wait_until(lambda: self.desk.status()["colour"] == "0.05", 5, "a step of the slider")
        self.driver.execute_script("arguments[0].value = arguments[1];"
                                   "arguments[0].dispatchEvent(new Event('change'))", slider, before)
        wait_until(lambda: self.desk.status()["colour"] == before, 5, "the colour as it was")
        self.driver.execute_script(
            "[...document.querySelectorAll('button')].find(b => b.innerText === 'Freeze').focus()")
        ActionChains(self.driver).send_keys(" ").perform()
        wait_until(lambda: self.desk.status()["freeze"] == "on", 5, "frozen by keyboard")
        wait_until(lambda: "Let it move" in self.text(), 5, "the page to show it")
        self.button("Let it move").click()
        wait_until(lambda: self.desk.status()["freeze"] == "off", 5, "moving")

    def test_hours_are_written_by_keyboard_alone(self):
        self.open("schedule")
        focused = lambda: self.driver.execute_script(
            "return document.activeElement.id || document.activeElement.innerText.trim()")
        def go_to(name):
            for _ in range(80):
                if focused() == name:
                    return
                ActionChains(self.driver).send_keys(Keys.TAB).perform()
            raise AssertionError(f"{name} is not reached")
        go_to("Hold for two hours")
        ActionChains(self.driver).send_keys(Keys.ENTER).perform()
        wait_until(lambda: "service" in self.text("header"), 5, "a hold")
        go_to("Add hours")
        ActionChains(self.driver).send_keys(Keys.ENTER).perform()
        self.driver.execute_script("document.activeElement.blur(); scrollTo(0, 0)")
        go_to("Sat")
        ActionChains(self.driver).send_keys(" ").perform()
        go_to("h-zone")
        ActionChains(self.driver).key_down(Keys.CONTROL).send_keys("a").key_up(Keys.CONTROL).send_keys(
            "UTC" + Keys.TAB).perform()
        go_to("Save")
        ActionChains(self.driver).send_keys(Keys.ENTER).perform()
        wait_until(lambda: "not saved yet" not in self.text("main"), 5, "saved hours")
        self.assertIn("Saturday", self.find(self.driver, "svg.week").get_attribute("aria-label"))
        self.save_text("")
        wait_until(lambda: self.find(self.driver, "svg.week").get_attribute("aria-label") == "never open", 5,
                   "no hours")
        self.button("Let the schedule go on").click()
        wait_until(lambda: "No hours are set" in self.text("main"), 5, "no hold")

    def test_the_helm_is_taken_by_one_tap(self):
        self.button("Take the helm").click()
        forward = self.find(self.driver, "button[aria-label=ahead]")
        ActionChains(self.driver).click_and_hold(forward).perform()
        wait_until(lambda: "pilot steers" in self.text("section[aria-labelledby=helm]"), 5, "the operator to steer")
        ActionChains(self.driver).release().perform()
        wait_until(lambda: "nobody steers" in self.text("section[aria-labelledby=helm]"), 5, "hands off")
        self.button("Give the helm back").click()

    def choose(self, what, value):
        """From a list of the wall's page, and shows it."""
        self.driver.execute_script("""const list = document.getElementById(arguments[0]); list.value = arguments[1];
                                      list.dispatchEvent(new Event('change'));""", what, value)
        show = self.find(self.driver, f"button[data-of={what}]")
        wait_until(show.is_enabled, 3, "the button")
        ActionChains(self.driver).click_and_hold(show).pause(1.3).release().perform()
        wait_until(lambda: self.desk.status()[what] == value, 60, f"{what} {value}")
        wait_until(lambda: value in self.text("section[aria-labelledby=figures]"), 5, "the page to say so")

    @unittest.skipIf(SHOTS, "the reef takes a minute to build without a graphics card")
    def test_a_pattern_a_scene_and_a_quality_are_chosen_and_shown(self):
        before = self.desk.status()
        for what, other in (("pattern", "grey" if not SHOTS else "grid"), ("scene", "empty_sea"),
                            ("quality", "medium")):
            self.choose(what, other)
            self.choose(what, before[what])
        self.driver.refresh()
        wait_until(lambda: re.search(r"^frames? \d+( to \d+)?$", self.text("figure.whole figcaption")), 15,
                   "pictures of all channels")

    def test_a_time_of_day_is_chosen_and_given_back_to_the_clock(self):
        for day in ("dusk", "first light", "clock"):
            self.choose("day", day)
            chosen = "return document.querySelector('#day').value"
            wait_until(lambda: self.driver.execute_script(chosen) == day, 5, f"the list says {day}")

    def test_a_stale_page_dims_and_holds_commands_back_until_it_hears_again(self):
        console = self.desk.console_process()
        places = lambda: [(e.location, e.size)
                          for e in self.driver.find_elements(By.CSS_SELECTOR, "nav a, main button")]
        before = places()
        os.kill(console, signal.SIGSTOP)
        try:
            begun = time.monotonic()
            wait_until(lambda: "stale" in self.driver.find_element(By.TAG_NAME, "html").get_attribute("class"), 5,
                       "a stale page")
            self.assertLessEqual(time.monotonic() - begun, 2.6)
            self.assertFalse(any(b.is_enabled() for b in self.driver.find_elements(By.CSS_SELECTOR, "main button")))
            self.assertIn("Nothing heard from the console", self.text("header"))
            self.assertEqual(places(), before, "nothing moves")
            self.shot("stale")
        finally:
            os.kill(console, signal.SIGCONT)
        begun = time.monotonic()
        wait_until(lambda: self.driver.find_element(By.TAG_NAME, "html").get_attribute("class") == "", 5, "a live page")
        self.assertLessEqual(time.monotonic() - begun, 3)
        self.assertEqual(places(), before, "nothing moves")

    def test_a_watcher_sees_and_changes_nothing(self):
        driver = browser()
        try:
            self.pair(driver, self.desk.code("watcher"), "Wim")
            wait_until(lambda: "watcher" in self.text("header", driver), 5, "a watcher")
            self.assertFalse(any(b.is_enabled() for b in driver.find_elements(By.CSS_SELECTOR, "main button")))
            # Hiding is not security: the same said past the page is refused.
            driver.execute_async_script("""
                const done = arguments[0], socket = new WebSocket(`ws://${location.host}/ws`);
                socket.onmessage = event => {
                  const message = JSON.parse(event.data);
                  const run = message.snapshot?.wall.run;
                  if (run) socket.send(JSON.stringify({command: {id: '99', run, order: {show: {black: true}}}}));
                  if (message.done) { window.refusal = message.done.reason; socket.close(); done(); }
                };""")
            self.assertEqual(driver.execute_script("return window.refusal"), "only operator may do this")
            self.assertEqual(self.desk.status()["black"], "off")
        finally:
            driver.quit()

    def test_a_node_is_restarted_and_comes_back(self):
        self.open("nodes")
        time.sleep(5)  # a process that ends sooner than that after its start is taken for broken
        before = self.desk.said().count("showing")
        row = self.driver.find_element(By.XPATH, "//tr[th='right']")
        ActionChains(self.driver).click_and_hold(row.find_element(By.CSS_SELECTOR,
                                                                  "button")).pause(1.3).release().perform()
        wait_until(lambda: self.desk.said().count("showing") > before, 60, "the node to show again")
        wait_until(lambda: self.text("tbody").count("in step") == 3, 30, "all in step")
        self.open("events")
        self.assertIn("restart node right", self.text("ol.events"))
        self.open("nodes")
        time.sleep(5 if SHOTS else 0)
        self.shot("nodes")

    def test_the_machine_of_a_node_is_powered_off(self):
        self.open("nodes")
        wait_until(lambda: "The machine of left" in self.text("main"), 20, "a report of the node")
        self.assertIn("takes no word to power off: its service", self.text("main"), "of the master's machine")
        self.assertFalse(self.button("Power this machine off").is_enabled())
        self.hold("Power pit off", 0.4)
        self.hold("Restart pit")
        wait_until(lambda: (self.pit / "word").exists(), 10, "the word")
        self.assertEqual((self.pit / "word").read_text(), "reboot\n")
        (self.pit / "word").unlink()
        self.open("events")
        wait_until(lambda: re.search(r"Anna\s+reboot of the machine of left", self.text("ol.events")), 5, "the event")
        self.assertNotIn("poweroff", self.text("ol.events"), "held for too short a time")

    def test_the_doctor_is_asked_from_the_page(self):
        self.open("doctor")
        self.button("Ask the doctor").click()
        wait_until(lambda: re.search(r"\d+ pass, \d+ warn, 0 fail", self.text("main")), 30, "its findings")
        self.assertIn("node middle", self.text("tbody"))
        self.shot("doctor")

    def save_text(self, text):
        self.driver.execute_script(
            """document.querySelector('details').open = true;
               const text = document.querySelector('#hours');
               text.value = arguments[0];
               text.dispatchEvent(new Event('input'));""", text)
        self.button("Save the text").click()
        self.driver.execute_script("document.querySelector('details').open = false; scrollTo(0, 0);")

    def set_field(self, name, value):
        """Of the form of hours, as typing or choosing does."""
        self.driver.execute_script("""const field = document.getElementById(arguments[0]); field.value = arguments[1];
                                      field.dispatchEvent(new Event('change'));""", "h-" + name, value)

    def test_the_schedule_is_a_form_whose_mistakes_stand_beside_their_fields(self):
        self.open("schedule")
        self.assertIn("No hours are set", self.text("main"))
        self.button("Hold for two hours").click()
        wait_until(lambda: "service" in self.text("header"), 5, "a hold that is seen")
        self.button("Add hours").click()
        self.button("Sun").click()
        for field, value in (("open-0-from", ""), ("open-0-to", "01:30"), ("open-0-scene", "reef"),
                             ("open-0-quality", "low"), ("zone", "Europe/Berlin")):
            self.set_field(field, value)
        for _ in range(2):
            self.button("Add a day").click()
        self.button("Add a projector").click()
        for field, value in (("exceptions-0-date", "2026-12-24"), ("exceptions-1-date", "2026-12-24"),
                             ("projectors-0-name", "left"), ("projectors-0-address", "beamer")):
            self.set_field(field, value)
        # Each mistake where it is: those that the schema knows first, then those in values, all at once.
        for mistakes in ((("open-0-from", "is empty", "19:00"),),
                         (("exceptions-1-date", "is there already", "2026-12-31"),
                          ("projectors-0-address", "is a number", "127.0.0.1:1"))):
            self.button("Save").click()
            for field, words, _ in mistakes:
                wait_until(lambda: words in self.text(f"#h-{field}-wrong"), 5, f"what is wrong, at {field}")
            self.assertEqual([one.get_attribute("id")
                              for one in self.driver.find_elements(By.CSS_SELECTOR, "[aria-invalid=true]")],
                             [f"h-{field}" for field, *_ in mistakes])
            for field, _, value in mistakes:
                self.set_field(field, value)
        self.assertIn("not saved yet", self.text("main"))
        self.button("Save").click()
        wait_until(lambda: "not saved yet" not in self.text("main"), 5, "saved hours")
        self.assertIn("Sunday: 19:00", self.find(self.driver, "svg.week").get_attribute("aria-label"))
        self.find(self.driver, "summary").click()
        text = self.find(self.driver, "#hours")
        self.assertEqual(text.get_property("value").split(), (
            'zone: "Europe/Berlin" '
            'open { days: [TUESDAY, WEDNESDAY, THURSDAY, FRIDAY, SUNDAY] from: "19:00" to: "01:30" scene: "reef" '
            'quality: "low" } '
            'exceptions { date: "2026-12-24" } exceptions { date: "2026-12-31" } '
            'projectors { name: "left" address: "127.0.0.1:1" }').split())
        wait_until(lambda: "no answer" in self.text("main"), 10, "a projector that does not answer")
        self.assertRegex(self.text("table.cards tbody"), r"(?s)no answer.*unknown", "its shutter and its lamp")
        # The same as text, with its mistakes by line and column.
        text.clear()
        text.send_keys('zone: "UTC" nonsense')
        self.button("Save the text").click()
        wait_until(lambda: "hours.txtpb:1:" in self.text("header"), 5, "the mistake with its place")
        text.clear()
        text.send_keys('zone: "UTC"')
        self.button("Save the text").click()
        wait_until(lambda: not self.button("Save the text").is_enabled(), 5, "saved text")
        self.assertIn("held until", self.text("main"))
        time.sleep(1.5)
        self.assertEqual(self.desk.status()["black"], "off", "held")

        self.button("Let the schedule go on").click()
        wait_until(lambda: self.desk.status()["black"] == "on", 10, "closed: hours without a span")
        wait_until(lambda: "closed" in self.text("header"), 5, "closed, not broken")
        # By hand again, until the hours want something else.
        self.driver.execute_script("location.hash = 'wall'")
        wait_until(lambda: "Light again" in self.text(), 5, "the way back")
        self.button("Light again").click()
        wait_until(lambda: self.desk.status()["black"] == "off", 5, "light by hand")
        time.sleep(1.5)
        self.assertEqual(self.desk.status()["black"], "off")
        self.open("schedule")
        if SHOTS:
            self.save_text(WEEK)
            time.sleep(2)
        self.shot("schedule")
        self.save_text("")
        wait_until(lambda: "No hours are set" in self.text("main"), 5, "no hours")

    def row_of(self, date):
        return self.find(self.driver, "tbody").find_element(By.XPATH, f"//tr[th[contains(., '{date}')]]")

    def test_an_earlier_calibration_is_used_and_the_panorama_follows(self):
        self.open("calibration")
        wait_until(lambda: self.text("tbody").count("\n") > 3, 10, "what was kept")
        file = Path(self.desk.folder.name) / "hall.mpcdi"
        history = Path(self.desk.folder.name) / "hall.history"
        self.assertRegex(self.row_of("2/24/2026").text, r"(?s)pass.*0.03 px.*0.52 px.*in use")
        self.assertIn("a bright window", self.row_of("1/24/2026").text)
        self.assertRegex(self.text("section[aria-labelledby=drift]"), r"(?s)right\s+✖ moved · 1.81 px.*calibrate again")
        self.shot("calibration")
        use = lambda date: ActionChains(self.driver).click_and_hold(
            self.row_of(date).find_element(By.CSS_SELECTOR, "button")).pause(1.3).release().perform()
        # What no wall can be shown by is refused, and says why.
        use("1/20/2026")
        wait_until(lambda: "refused" in self.text("header"), 20, "a refusal")
        self.assertIn("hall.mpcdi", self.text("header"))
        for date, name in (("1/24/2026", "2026-01-24T210301"), ("2/24/2026", "2026-02-24T210301")):
            use(date)
            wait_until(lambda: file.read_bytes() == (history / f"{name}.mpcdi").read_bytes(), 20,
                       "the file in its place")
            wait_until(lambda: "in use" in self.row_of(date).text, 10, "the list to say so")
        self.open("events")
        self.assertRegex(self.text("ol.events"), r"Anna\s+calibration 2026-01-24T210301")

    def test_the_tour_of_a_new_hall_is_shown_and_the_crew_confirms_what_it_sees(self):
        self.open("tour")
        steps = lambda: [step.text for step in self.driver.find_elements(By.CSS_SELECTOR, "ol.steps > li")]
        wait_until(lambda: len(steps()) == 8, 40, "the steps")
        self.assertRegex(steps()[0], r"(?s)Screen please look.*as in desk.txtpb of the programs.*measure the screen")
        self.assertRegex(steps()[1], r"(?s)Machines done.*all of 3 nodes")
        self.assertRegex(steps()[5], r"(?s)Calibration done.*each channel has its wall file")
        self.assertEqual(self.find(self.driver, "[aria-current=step] h3").text.split("\n")[0][2:8], "Screen")
        self.shot("tour")
        self.button("It is right").click()
        wait_until(lambda: "Screen done" in steps()[0], 40, "the confirmed step")
        self.assertRegex(self.text("main"), r"\d of 8 steps done, \d+ s so far")
        self.open("events")
        self.assertRegex(self.text("ol.events"), r"Anna\s+tour: screen is right")

    def test_a_pattern_of_a_scan_is_held_while_the_page_is_open(self):
        before = self.desk.status()["pattern"]
        self.open("calibration")
        wait_until(lambda: "in use" in self.text("main"), 10, "what was kept: from then on nothing moves")
        show = self.find(self.driver, "button[data-of=scan]")
        wait_until(show.is_enabled, 5, "the button")
        ActionChains(self.driver).click_and_hold(show).pause(1.3).release().perform()
        wait_until(lambda: self.desk.status()["pattern"] == "scan", 10, "the pattern")
        wait_until(lambda: "is held for the pattern" in self.text("section[aria-labelledby=scan]"), 5,
                   "the page to say so")
        self.button("End it").click()
        wait_until(lambda: self.desk.status()["pattern"] == before, 10, "what was shown before")
        ActionChains(self.driver).click_and_hold(show).pause(1.3).release().perform()
        wait_until(lambda: self.desk.status()["pattern"] == "scan", 10, "the pattern")
        time.sleep(3.5)  # longer than the master's patience
        self.assertEqual(self.desk.status()["pattern"], "scan")
        self.open("wall")
        wait_until(lambda: self.desk.status()["pattern"] == before, 10, "the page was left")

    def offer(self, count, species="clownfish"):
        token = self.desk.token("operator")
        return [self.desk.offer(token, 40 * i, 120, 250 - 40 * i, species) for i in range(count)]

    def cards(self, of):
        """What the cards of a list say, as soon as their pictures are there."""
        self.driver.execute_script("scrollTo(0, 0)")
        return self.driver.execute_script("""return [...document.querySelectorAll(arguments[0] + ' > li')].map(card =>
            [card.querySelector('p').innerText, card.querySelector('img')?.naturalWidth ?? 0]);""", of)

    def test_a_tap_lets_a_drawing_in_or_refuses_it(self):
        badge = lambda: self.text("nav a[href='#drawings']").split()
        self.assertEqual(badge(), ["Drawings"])
        first, second, third = self.offer(3)
        wait_until(lambda: badge()[1:2] == ["3"], 10, "the badge on the wall's page")
        self.assertIn("(3)", self.driver.title)
        self.open("drawings")
        wait_until(lambda: [width for _, width in self.cards(".waiting")] == 3 * [1024], 10, "three pictures")
        self.assertTrue(self.cards(".waiting")[0][0].startswith(f"clownfish {first} "))
        self.shot("drawings")
        verdict = lambda number, label: next(
            one for one in self.driver.find_elements(By.CSS_SELECTOR, f".verdict button[data-of='{number}']")
            if one.text == label)
        verdict(first, "No").click()
        self.assertFalse(verdict(first, "Yes, let it in").is_enabled(), "its card stays, and takes no other tap")
        side = lambda name: self.find(self.driver, f"button[data-of='{name}-{second}']")
        self.assertEqual(side("middle").get_attribute("aria-pressed"), "true", "as it was offered")
        side("right").click()
        wait_until(lambda: side("right").get_attribute("aria-pressed") == "true", 5, "the other side")
        verdict(second, "Yes, let it in").click()
        numbers = lambda of: [text.split()[1] for text, _ in self.cards(of)]
        wait_until(lambda: numbers(".waiting") == [str(third)], 5, "the third alone")
        wait_until(lambda: numbers(".day") == [str(second)], 10, "who swims")
        self.assertIn("swims", self.cards(".day")[0][0])
        self.button("Keep").click()
        wait_until(lambda: self.button("Keep").get_attribute("aria-pressed") == "true", 5, "kept")
        self.button("Take down").click()
        wait_until(lambda: not self.cards(".day") or "leaves" in self.cards(".day")[0][0], 10, "it leaves")
        # All of them, by one tap, here and on the wall's page.
        self.button("All drawings off").click()
        wait_until(lambda: "No new one is taken" in self.text("main"), 5, "none swims")
        self.open("wall")
        wait_until(lambda: "Drawings on" in self.text("main"), 5, "the way back")
        self.button("Drawings on").click()
        wait_until(lambda: "All drawings off" in self.text("main"), 5, "they swim")
        self.open("events")
        self.assertRegex(self.text("ol.events"), rf"Anna\s+drawing {second} let in")
        self.open("drawings")
        wait_until(lambda: self.cards(".waiting"), 5, "the third")
        verdict(third, "No").click()
        wait_until(lambda: badge() == ["Drawings"], 5, "nothing waits")

    def test_a_watcher_sees_drawings_and_decides_nothing(self):
        number, = self.offer(1)
        driver = browser()
        try:
            self.pair(driver, self.desk.code("watcher"), "Wim")
            self.open("drawings", driver)
            button = self.find(driver, f".verdict button[data-of='{number}']")
            self.assertFalse(button.is_enabled())
            self.assertNotIn(True, [one.is_enabled() for one in driver.find_elements(By.CSS_SELECTOR, "main button")])
        finally:
            driver.quit()
        self.open("drawings")
        self.find(self.driver, f".verdict button[data-of='{number}'].no").click()

    def test_a_fish_that_is_touched_is_taken_down(self):
        # The page's own module, told of a fish that wears a drawing: where one swims is chance.
        said = self.driver.execute_async_script("""const [done] = arguments;
            Promise.all([import('/drawings.js'), import('/vendor/lit-html.js')]).then(([page, {render}]) => {
                const said = [], place = document.createElement('div');
                const link = Object.assign(new EventTarget(), {may: () => true, command: wanted => said.push(wanted),
                    known: {drawings: {drawings: [{number: 7, species: 'clownfish', condition: 'SWIMMING', fish: 31},
                                                  {number: 8, species: 'clownfish', condition: 'WAITING'}],
                                       pictures: []}}});
                const shown = fish => {
                    page.touchWall(link)({name: 'left'}, {frame: '9', x: 0.25, y: 0.5});
                    link.known.mind = {fish};
                    render(page.touchedPanel(link), place);
                    return place.innerText.replace(/\\s+/g, ' ').trim();
                };
                const texts = [shown(31), shown(0), shown(-1)];
                shown(31);
                place.querySelector('button.no').click();
                done([texts, said[0], said.at(-1)]);
            });""")
        texts, asked, ordered = said
        self.assertRegex(texts[0], r"clownfish 7 ● swims ?Take down Close")
        self.assertRegex(texts[1], "This fish wears no drawing")
        self.assertRegex(texts[2], "There is no fish")
        self.assertEqual(asked, {"pointAt": {"channel": "left", "frame": "9", "x": 0.25, "y": 0.5}})
        self.assertEqual(ordered, {"order": {"moderation": {"number": 7, "verdict": "TAKE_DOWN"}}})

    @unittest.skipIf(*lacks((BIN / "aquarama-drawings").exists(), "aquarama-drawings"))
    def test_a_picture_of_a_sheet_is_sent_from_the_page(self):
        self.open("drawings")
        self.button("left").click()
        photo = Path(self.desk.folder.name) / "photo.bmp"
        Image.new("RGB", (800, 600), "white").save(photo)
        self.find(self.driver, "input[type=file]").send_keys(str(photo))
        wait_until(lambda: "refused" in self.text(".sent"), 20, "what became of it")
        self.assertEqual(self.text(".sent").strip(), "picture of a sheet: refused – no sheet is in the picture")

    def test_the_log_is_filtered(self):
        self.open("log")
        wait_until(lambda: "showing" in self.text("tbody"), 10, "the log")
        self.find(self.driver, "#logText").send_keys("takes part")
        wait_until(lambda: self.text("tbody") and "showing" not in self.text("tbody"), 5, "filtered lines")
        self.assertIn("takes part", self.text("tbody"))
        self.shot("log")

    def test_a_fish_is_asked_what_it_has_in_mind(self):
        self.open("mind")
        number = self.find(self.driver, "#fish")
        number.clear()
        number.send_keys("7" + Keys.ENTER)
        wait_until(lambda: "mind of fish 7" in self.text("main"), 10, "the fish")
        wait_until(lambda: re.search(r"\b7\b", self.text("pre")), 10, "what it has in mind")
        self.assertEqual(len(self.driver.find_elements(By.CSS_SELECTOR, "meter")), 3)
        intended = self.text(".intends").split(", its aim")[0]
        self.assertIn(f"INTENDS  {intended}, its aim", self.text("pre"), "drawn from fields, as the lines have it")
        # The fish at a place of a picture: the node says which, of the frame that is shown.
        wait_until(lambda: "frame" in self.text("figcaption"), 15, "a picture")
        self.find(self.driver, "figure.whole canvas").click()
        wait_until(lambda: re.search(r"mind of fish \d+|no fish", self.text("main")), 10, "an answer")
        time.sleep(1)
        self.shot("mind")

    def test_axe_finds_nothing_on_any_page_on_desk_tablet_and_phone_light_and_dark(self):
        self.addCleanup(self.driver.execute_cdp_cmd, "Emulation.setDeviceMetricsOverride",
                        {"width": 1280, "height": 900, "deviceScaleFactor": 1, "mobile": False})
        self.addCleanup(self.driver.execute_cdp_cmd, "Emulation.setEmulatedMedia", {"features": []})
        first, *_ = self.offer(2)
        self.open("drawings")
        self.find(self.driver, f".verdict button[data-of='{first}'].yes").click()
        self.driver.execute_script(AXE)  # the pages are one document
        for width, height in ((1280, 900), (820, 1180), (390, 844)):
            self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                        {"width": width, "height": height, "deviceScaleFactor": 1,
                                         "mobile": width < 700})
            for page in PAGES:
                self.driver.execute_script("location.hash = arguments[0]", page)
                wait_until(lambda: self.driver.execute_script(
                    "return document.querySelector('nav a[aria-current]').hash") == f"#{page}", 5, page)
                for scheme in ("dark", "light"):
                    self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                                {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
                    found = self.driver.execute_async_script("""const [done] = arguments;
                        axe.run(document, {resultTypes: ['violations']}).then(result => done(result.violations.map(
                            v => [v.id, v.nodes[0].html, v.nodes[0].failureSummary])));""")
                    self.assertEqual(found, [], (page, width, scheme))
                self.assertLessEqual(self.driver.execute_script("return document.documentElement.scrollWidth"), width,
                                     f"{page} at {width} px")
                if page == "drawings":
                    small = self.driver.execute_script("""return [...document.querySelectorAll(
                        'main button, main .button')].filter(one => Math.min(one.offsetWidth, one.offsetHeight) < 44)
                        .map(one => one.innerText);""")
                    self.assertEqual(small, [], f"too small for a finger at {width} px")
                if page == "wall" and width < 700:
                    time.sleep(3 if SHOTS else 0)
                    self.shot("phone")

    def test_another_language_is_chosen_and_kept(self):
        self.driver.execute_script("localStorage.setItem('language', 'de')")
        self.driver.refresh()
        wait_until(lambda: "Wieder hell" in self.text() or "Schwarz" in self.text(), 5, "German")
        self.assertEqual(self.driver.execute_script("return document.documentElement.lang"), "de")
        self.driver.execute_script("localStorage.removeItem('language')")
        self.driver.refresh()
        wait_until(lambda: "Black" in self.text(), 5, "English")

    def test_the_first_picture_of_the_page_is_there_within_a_second(self):
        paints = []
        for _ in range(3):
            self.driver.refresh()
            self.find(self.driver, "header h1")
            painted = lambda: self.driver.execute_script(
                "return performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? null")
            wait_until(lambda: painted() is not None, 10, "what is there to be painted")
            paints.append(painted())
            asked = self.driver.execute_script(
                "return performance.getEntriesByType('resource').map(entry => new URL(entry.name).host)")
            self.assertEqual(set(asked), {self.desk.address})
        self.assertLess(min(paints), 1000)


if __name__ == "__main__":
    unittest.main(verbosity=2)
