"""Nodes without a key, given their channels in Debian's chromium by letter and code. Every machine is a network
namespace on one switch; the browser runs on the master's. Needs no root: user namespaces do.

With AQUARAMA_SHOTS=FOLDER it writes a picture of the page there, as docs/draw_pictures.sh has it.
"""

import os
import re
import shutil
import subprocess
import sys
import time
import unittest
from pathlib import Path

INSIDE = "AQUARAMA_INSIDE_HALL"
if INSIDE not in os.environ and shutil.which("unshare") and shutil.which("ip"):
    os.environ[INSIDE] = "yes"
    os.execvp("unshare", ["unshare", "--user", "--map-root-user", "--net", "--mount", "--fork", "--kill-child",
                          sys.executable, __file__, *sys.argv[1:]])

import pages_test  # noqa: E402
from pages_test import AXE, BIN, SHOTS, By, Keys, aquarama, browser, wait_until  # noqa: E402
from show import CHANNELS, ROOT, end, start, temporary_folder  # noqa: E402

find = pages_test.Pages.find

MASTER = "10.77.0.1"
MACHINES = {"left": "10.77.0.11", "middle": "10.77.0.12", "right": "10.77.0.13", "spare": "10.77.0.14"}


def sh(command):
    subprocess.run(command, shell=True, check=True, capture_output=True, text=True)


def build_network():
    """A switch, which is the master's machine too, and the other machines on it."""
    sh("mount -t tmpfs none /run && ip link set lo up && ip link add switch type bridge && "
       f"ip addr add {MASTER}/24 dev switch && ip link set switch up")
    for name, address in MACHINES.items():
        sh(f"ip netns add {name} && ip link add {name} type veth peer name eth0 netns {name} && "
           f"ip link set {name} master switch up && ip -n {name} link set lo up && "
           f"ip -n {name} addr add {address}/24 dev eth0 && ip -n {name} link set eth0 up")


class Waiting(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        build_network()
        cls.folder = temporary_folder()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.at = Path(cls.folder.name)
        os.environ["XDG_CONFIG_HOME"] = str(cls.at)
        cls.rig, cls.keys, cls.processes = cls.at / "hall.txtpb", cls.at / "aquarama/keys/hall", []
        text = (ROOT / "config/desk.txtpb").read_text().replace("127.0.0.1", MASTER)
        text = text.replace("scenes/", f"{ROOT}/config/scenes/")
        text = re.sub(r"timing \{.*?\}", "timing { refresh_hz: 4 }", text, flags=re.S)
        for side in CHANNELS:
            text = text.replace(f'name: "{side}"', f'name: "{side}"\n  machine: "{side}-pc"')
        text = re.sub(r"( +)(watch: \S+)", rf'\1\2\n\1depot: "tcp://{MASTER}:7403"', text, count=1)
        cls.rig.write_text(text)
        made = aquarama("keys", "new", cls.rig)
        assert made.returncode == 0, made.stderr
        cls.processes.append(start("run", cls.rig, "--headless", "--live", "--pattern", "grid",
                                   log=cls.at / "log"))
        cls.addClassCleanup(lambda: end(cls.processes[::-1]))
        wait_until(lambda: "pairing code" in cls.said("log"), 90, "the console")
        cls.driver = browser()
        cls.addClassCleanup(cls.driver.quit)
        cls.driver.get("http://" + re.search(r"console at http://(\S+)", cls.said("log"))[1])
        for field, text in (("#code", re.search(r"pairing code (\S+)", cls.said("log"))[1]), ("#name", "Anna")):
            find(cls.driver, field).send_keys(text)
        find(cls.driver, "form button").click()
        find(cls.driver, "header h1")
        cls.driver.execute_script("location.hash = 'nodes'")

    @classmethod
    def said(cls, name):
        return (cls.at / name).read_text() if (cls.at / name).exists() else ""

    def wait(self, machine):
        """Starts a node without a key on this machine; its letter and its code."""
        with open(self.at / f"{machine}.log", "a") as log:
            command = ["ip", "netns", "exec", machine, BIN / "aquarama-node", "--key",
                       self.at / f"{machine}.machine.key", "--wait-for-key", "--headless"]
            self.processes.append(subprocess.Popen(command, stdout=log, stderr=log,
                                                   env=os.environ | {"LP_NUM_THREADS": "1"}))
        wait_until(lambda: "waits for a channel" in self.said(f"{machine}.log"), 30, f"a letter of {machine}")
        return re.search(r"as ([A-Z]+), code (\S+)", self.said(f"{machine}.log")).groups()

    def letters(self):
        return [card.get_attribute("data-letter") for card in self.driver.find_elements(By.CSS_SELECTOR, ".letter")]

    def give(self, letter, channel, code):
        find(self.driver, f'[data-letter="{letter}"]').click()
        find(self.driver, f'#waitingChannel option[value="{channel}"]').click()
        find(self.driver, "#waitingCode").send_keys(code, Keys.ENTER)

    def assign(self, letter, channel, code):
        return aquarama("nodes", "assign", self.rig, letter, channel, code, "--keys", self.keys)

    def is_in_step(self, channel):
        text = aquarama("status", self.rig, "--key", self.keys / "operator.key").stdout
        return re.search(rf"^{channel} +in step", text, re.M) is not None

    def await_in_step(self, channel):
        """A node compiles what it draws first: with software OpenGL, beside other tests, that takes a minute."""
        wait_until(lambda: self.is_in_step(channel), 180, f"{channel} in step")

    def test_channels_are_given_by_letter_and_a_stranger_gets_nothing(self):
        signs = {machine: self.wait(machine) for machine in CHANNELS}
        self.assertEqual(len({letter for letter, _ in signs.values()}), 3)
        wait_until(lambda: len(self.letters()) == 3, 20, "three letters on the page")
        self.assertEqual(sorted(self.letters()), sorted(letter for letter, _ in signs.values()))
        if SHOTS:
            find(self.driver, f'[data-letter="{signs["left"][0]}"]').click()
            find(self.driver, "#waitingCode")
            (Path(SHOTS) / "console_waiting.png").write_bytes(self.driver.get_screenshot_as_png())
            find(self.driver, f'[data-letter="{signs["left"][0]}"]').click()
        # Somebody on the network who does not stand before the screen.
        self.give(signs["left"][0], "left", "0000-0000")
        wait_until(lambda: "this is not the code on its screen" in self.driver.page_source, 20, "a refusal")
        self.assertFalse((self.at / "left.machine.key").exists())
        before = (self.keys / "left.key").read_text()
        self.driver.execute_script(AXE)
        faults = self.driver.execute_async_script("axe.run(document.querySelector('main')).then(arguments[0])")
        self.assertEqual([fault["id"] for fault in faults["violations"]], [])
        for machine, (letter, code) in signs.items():
            self.give(letter, machine, code)
            self.await_in_step(machine)
        self.assertNotEqual((self.keys / "left.key").read_text(), before)
        self.assertIn('name: "left"', (self.at / "left.machine.key").read_text())
        self.assertEqual((self.at / "left.machine.key").stat().st_mode & 0o777, 0o600)
        wait_until(lambda: not self.letters(), 20, "no letter on the page")
        # The machine of the left channel is dead, or is thought to be: another one takes its place, without a browser.
        letter, code = self.wait("spare")
        self.assertRegex(aquarama("nodes", "waiting").stdout, rf"^{letter} +tcp://{MACHINES['spare']}:\d+$")
        for wrong, why in (((letter, "top", code), "has no channel"), ((letter, "left", "0000"), "not the code")):
            refused = self.assign(*wrong)
            self.assertEqual((refused.returncode, refused.stderr.count("\n")), (1, 1), refused.stderr)
            self.assertIn(why, refused.stderr)
        time.sleep(1)  # the node takes one guess a second
        given = self.assign(letter.lower(), "left", code.lower())
        self.assertEqual(given.returncode, 0, given.stderr)
        wait_until(lambda: "is given the channel left" in self.said("spare.log"), 20, "the key of the spare machine")
        self.await_in_step("left")
        end([self.processes[1]])  # the node that had the channel: nobody misses it
        self.await_in_step("left")  # still

    def test_the_release_of_all_machines_is_shown_and_the_crew_has_a_word(self):
        wait_until(lambda: "no depot answers" in find(self.driver, "[aria-labelledby=releases]").text, 20,
                   "what is said without a depot")
        depot, key = self.at / "depot", self.at / "show.key"
        depot.mkdir()
        self.assertEqual(aquarama("release", "key", "new", key).returncode, 0)
        self.processes.append(start("release", "serve", self.rig, "--depot", depot, "--signed-by",
                                    key.with_suffix(".key.pub"), log=self.at / "depot.log"))
        shown = lambda: find(self.driver, "[aria-labelledby=releases]").text
        wait_until(lambda: "Not all machines have said yet" in shown(), 30, "what the depot says")
        rows = [row.text for row in self.driver.find_elements(By.CSS_SELECTOR, "[aria-labelledby=releases] tr")]
        self.assertEqual([row.split()[0] for row in rows], ["main", "left-pc", "middle-pc", "right-pc"])
        # Nothing waits: neither word can be said.
        for word in ("go", "back"):
            self.assertFalse(find(self.driver, f'[data-of="{word}"]').is_enabled())


if __name__ == "__main__":
    unittest.main()
