"""Three windows side by side on a display, and the keys that steer them."""

import os
import re
import shutil
import signal
import subprocess
import time
import unittest
from pathlib import Path

from show import (BIN, CHANNELS, ROOT, aquarama, control_address, end, rig_on_free_ports, start, temporary_folder,
                  trace, wait_until)


class Display:
    """A display without a screen."""

    def __init__(self):
        read, write = os.pipe()
        # Without -noreset the server starts anew when its last client leaves, and refuses whoever connects meanwhile.
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1600x700x24", "-nolisten",
                                        "tcp",
                                        "-noreset"], pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as number:
            self.name = ":" + number.readline().strip()

    @property
    def environment(self):
        return os.environ | {"DISPLAY": self.name, "LP_NUM_THREADS": "1"}

    def close(self):
        self.server.terminate()
        self.server.wait()

    def windows(self):
        """title -> (x, y, width, height) of every Aquarama window on it."""
        tree = subprocess.run(["xwininfo", "-root", "-tree"], env=self.environment, capture_output=True,
                              text=True).stdout
        found = re.findall(r'(0x[0-9a-f]+) "(.*[Aa]quarama.*)".*?(\d+)x(\d+)\+-?\d+\+-?\d+ +\+(-?\d+)\+(-?\d+)', tree)
        return {title: (int(x), int(y), int(w), int(h), window) for window, title, w, h, x, y in found}

    def press(self, window, key):
        subprocess.run(["xdotool", "windowfocus", "--sync", window, "key", "--window", window, key],
                       env=self.environment, check=True, timeout=20)

    def hold(self, window, *words):
        """xdotool's keydown and keyup, with the keyboard in the window."""
        subprocess.run(["xdotool", "windowfocus", "--sync", window, *words], env=self.environment, check=True,
                       timeout=20)

    def screenshot(self):
        """The root window as rows of (r, g, b)."""
        dump = subprocess.run(["xwd", "-root", "-silent"], env=self.environment, capture_output=True, check=True).stdout
        header = [int.from_bytes(dump[i:i + 4], "big") for i in range(0, 100, 4)]
        width, height, line, colours = header[4], header[5], header[12], header[19]
        start_of_pixels = header[0] + colours * 12
        step = header[11] // 8  # bytes a pixel: 3 or 4
        def pixel(x, y):
            at = start_of_pixels + y * line + step * x
            return dump[at + 2], dump[at + 1], dump[at]
        return width, height, pixel


@unittest.skipUnless(shutil.which("Xvfb") and shutil.which("xdotool") and shutil.which("xwd"),
                     "Xvfb, xdotool and xwd (x11-apps) are needed to test windows")
class Windows(unittest.TestCase):
    def setUp(self):
        self.display = Display()
        self.folder = temporary_folder()
        self.rig = rig_on_free_ports(self.folder.name)
        self.show = None

    def tearDown(self):
        if self.show:
            end([self.show])
        self.display.close()
        self.folder.cleanup()

    def run_show(self, *arguments):
        self.log = Path(self.folder.name, "log")
        with open(self.log, "w") as log:
            self.show = subprocess.Popen([BIN / "aquarama", "run", self.rig, "--trace", self.folder.name,
                                          *map(str, arguments)],
                                         env=self.display.environment, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=log)
        wait_until(lambda: len(self.display.windows()) == 3 or self.show.poll() is not None, 60, "three windows")
        self.assertIsNone(self.show.poll(), self.log.read_text())

    def frames_shown(self):
        return max((max(trace(self.folder.name, name), default=-1) for name in CHANNELS), default=-1)

    def test_three_windows_side_by_side_show_the_world(self):
        self.run_show("--frames", 60)
        wait_until(lambda: self.frames_shown() >= 10, 60, "ten frames")
        windows = sorted(self.display.windows().values())
        for (x, _, width, _, _), (next_x, *_) in zip(windows, windows[1:]):
            self.assertLessEqual(x + width, next_x, "windows overlap")
        _, _, pixel = self.display.screenshot()
        for x, y, width, height, _ in windows:
            colours = {pixel(x + i * width // 24, y + j * height // 18) for i in range(2, 23) for j in range(2, 17)}
            self.assertGreater(len(colours), 50, "a window shows a flat picture")
        self.assertEqual(self.show.wait(90), 0)

    def test_a_key_that_is_held_steers_until_it_is_let_go(self):
        self.run_show()
        wait_until(lambda: self.frames_shown() >= 3, 60, "the first frames")
        window = sorted(self.display.windows().values())[1][4]

        def steered():
            return re.search(r"m/s +(.*)", aquarama("status", self.rig).stdout)[1]

        self.assertEqual(steered(), "nobody steers")
        self.display.hold(window, "keydown", "w")
        wait_until(lambda: steered() == "middle steers", 30, "the window has control")
        self.display.hold(window, "keyup", "w")
        wait_until(lambda: steered() == "nobody steers", 30, "the hand to let go")
        self.display.press(window, "q")
        self.assertEqual(self.show.wait(30), 0)

    def test_another_scene_comes_on_in_the_same_windows(self):
        self.run_show("--pattern", "grid")
        wait_until(lambda: self.frames_shown() >= 3, 60, "the first frames")
        before = self.display.windows()
        done = aquarama("set", self.rig, "scene", "empty_sea")
        self.assertEqual(done.returncode, 0, done.stderr)
        at = self.frames_shown()
        wait_until(lambda: self.frames_shown() > at + 60, 60, "light again")
        self.assertEqual(self.display.windows(), before)
        _, _, pixel = self.display.screenshot()
        for x, y, width, height, _ in before.values():
            colours = {pixel(x + i * width // 24, y + j * height // 18) for i in range(2, 23) for j in range(2, 17)}
            self.assertGreater(len(colours), 20, "the grid is drawn by the new look")

    def test_a_node_without_a_key_fills_the_screen_with_its_letter(self):
        waiting = temporary_folder()
        self.addCleanup(waiting.cleanup)
        key = Path(waiting.name) / "node.key"
        node = subprocess.Popen([BIN / "aquarama-node", "--key", key, "--wait-for-key"],
                                env=self.display.environment, stdout=subprocess.DEVNULL)
        self.addCleanup(end, [node])

        def lit():
            """Shares of the left, middle and right third of the screen's upper half that are bright."""
            width, height, pixel = self.display.screenshot()
            rows, thirds = range(0, height // 2, 4), [range(i * width // 3, (i + 1) * width // 3, 4) for i in range(3)]
            return [sum(min(pixel(x, y)) > 200 for y in rows for x in third) / len(rows) / len(third)
                    for third in thirds]

        # A letter of five by seven dots, half as high as the screen, stands in the middle.
        wait_until(lambda: lit()[1] > 0.1, 30, "a letter")
        self.assertEqual([lit()[0], lit()[2]], [0, 0])
        (_, _, width, height, window), = self.display.windows().values()
        self.assertEqual((width, height), (1600, 700))
        self.display.press(window, "q")
        self.assertEqual(node.wait(20), 0)
        self.assertFalse(key.exists())
        log = Path(waiting.name) / "log"
        with log.open("w") as output:
            unseen = subprocess.Popen([BIN / "aquarama-node", "--key", key, "--wait-for-key", "--connector",
                                       "HDMI-A-9"], env=self.display.environment, stdout=output, stderr=output)
        self.addCleanup(end, [unseen])
        wait_until(lambda: "there is no monitor HDMI-9; the letter is on it once it is there" in log.read_text(), 30,
                   "a line of the log")
        self.assertEqual(self.display.windows(), {})
        self.assertIsNone(unseen.poll(), "it waits")

    def test_keys(self):
        self.run_show()
        wait_until(lambda: self.frames_shown() >= 3, 60, "the first frames")
        window = sorted(self.display.windows().values())[1][4]
        before = self.display.screenshot()
        x, y, width, height, _ = sorted(self.display.windows().values())[1]

        def changed():
            after = self.display.screenshot()
            places = ((i, j) for i in range(x, x + width, 7) for j in range(y, y + height, 7))
            return sum(before[2](*place) != after[2](*place) for place in places)

        self.display.press(window, "space")  # the world stands still: what changes from now on is what the keys show
        time.sleep(1)
        before = self.display.screenshot()
        for key in ("g", "b", "i", "e", "h"):
            self.display.press(window, key)
            wait_until(lambda: changed() > 20, 30, f"the key {key} to change the picture")
            before = self.display.screenshot()
        self.display.press(window, "q")
        self.assertEqual(self.show.wait(30), 0, "q ends the whole show cleanly")


if __name__ == "__main__":
    unittest.main(verbosity=2)
