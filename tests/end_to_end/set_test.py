"""Real processes: what the wall shows is set from a terminal, and a master that is killed comes back with it."""

import os
import re
import signal
import time
import unittest

from show import ShowCase, aquarama, children_of, start, wait_until


class Set(ShowCase):
    def set(self, what, value):
        return aquarama("set", self.rig, what, value)

    def shown(self):
        """What status says that the wall shows: name -> value."""
        said = re.search(r"show +(.*)", aquarama("status", self.rig).stdout)
        return dict(pair.split(" ", 1) for pair in re.split(r" {3}", said[1])) if said else {}

    def test_a_killed_master_comes_back_black_and_a_scene_comes_on_through_black(self):
        # Patterns need no world to be drawn: software OpenGL takes a second and more for a frame of a reef.
        begun = time.monotonic()
        show = start("run", self.rig, "--headless", "--live", "--pattern", "grid", log=self.log)
        self.processes = [show]
        wait_until(lambda: "showing" in self.log.read_text(), 60, "the first frame")
        for what, value in (("black", "on"), ("freeze", "on"), ("pattern", "grey"), ("colour", "0.4"),
                            ("brightness", "0.3")):
            done = self.set(what, value)
            self.assertEqual((done.returncode, done.stdout), (0, f"{what} {value}\n"), done.stderr)
        before = self.shown()
        self.assertEqual((before["black"], before["freeze"], before["pattern"]), ("on", "on", "grey"))

        time.sleep(max(0, 6 - (time.monotonic() - begun)))  # one that dies at once is not started again
        master = next(pid for command, pid in children_of(show).items() if " master " in command)
        os.kill(master, signal.SIGKILL)
        wait_until(lambda: self.shown().get("black") == "on", 20, "the master to come back, black")
        shown = self.shown()
        self.assertEqual((shown["freeze"], shown["pattern"], shown["colour"]), ("on", "grey", "0.40"))
        self.assertIn("as it was set before: pattern grey, black on, freeze on, colour 0.40, brightness 0.30",
                      self.log.read_text())
        for what in ("black", "freeze"):
            self.assertEqual(self.set(what, "off").returncode, 0)

        done = self.set("scene", "empty_sea")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.shown()["scene"], self.shown()["colour"]), ("empty_sea", "0.90"), "the scene's own")
        wait_until(lambda: "through black in" in self.log.read_text(), 20, "light again")
        self.assertEqual(self.shown()["brightness"], "0.30", "no more than was wanted")

        for what, value, why in (("scene", "lagoon", "bait_ball, empty_sea, reef"),
                                 ("scene", "../desk", "without folder"),
                                 ("scene", "reef.txtpb", "without folder"),
                                 ("quality", "best", "not \"best\""), ("black", "maybe", "on or off"),
                                 ("pattern", "dots", "grid"), ("colour", "1.2", "from 0"), ("colour", "red", "to 1"),
                                 ("brightness", "1.2", "from 0, black, to 1")):
            refused = self.set(what, value)
            self.assertEqual(refused.returncode, 1, what)
            self.assertIn(why, refused.stderr)
        self.assertEqual(self.shown()["scene"], "empty_sea")

        # Tomorrow's show begins with what was set today, but for what its command line says.
        show.send_signal(signal.SIGINT)
        show.wait(20)
        self.log.write_text("")
        self.processes = [start("run", self.rig, "--headless", "--live", "--pattern", "grid", log=self.log)]
        wait_until(lambda: self.shown().get("scene") == "empty_sea", 60, "the show of the next day")
        self.assertEqual(self.shown()["pattern"], "grid")

    def test_a_show_in_lockstep_is_the_same_every_time(self):
        self.processes = [start("master", self.rig, "--lockstep", "--pattern", "grid")]
        wait_until(lambda: "lockstep" in aquarama("status", self.rig).stdout, 60, "the master")
        refused = self.set("black", "on")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("--live", refused.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
