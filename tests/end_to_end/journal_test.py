"""Real processes: a master that is killed goes on with its world, and its journal plays again.

AQUARAMA_KILLS is how often it is killed; without it once. Prints how long each time no master answered.
"""

import json
import os
import random
import re
import signal
import time
import unittest
from pathlib import Path

from show import ShowCase, aquarama, children_of, end, start, wait_until

KILLS = int(os.environ.get("AQUARAMA_KILLS", "1"))


class Journal(ShowCase):
    def tick(self):
        """Of the world; nothing where no master answers."""
        found = re.search(r"tick (\d+)", aquarama("explain", "--fish", "0", self.rig).stdout)
        return int(found[1]) if found else None

    def recordings(self):
        return sorted(Path(os.environ["XDG_STATE_HOME"]).glob("aquarama/shows/desk.journal/*.aqrec"))

    def journal(self):
        """What `aquarama status` says of it."""
        return re.search(r"^journal +(.*)", aquarama("status", self.rig).stdout, re.M)[1]

    def found(self):
        """What the doctor says of it: (verdict, what, todo)."""
        findings = json.loads(aquarama("doctor", self.rig, "--json").stdout)
        return [(one["verdict"], one["what"], one["todo"]) for one in findings if one["subject"] == "journal"]

    def look_at_damage(self):
        """The doctor on a recording whose last entry is cut off, as by a power cut."""
        newest = self.recordings()[-1]
        whole = newest.read_bytes()
        newest.write_bytes(whole[:-3])
        folder, room, end_of, build = self.found()
        self.assertEqual((folder[0], room[0], end_of[0], build[0]), ("pass", "pass", "warn", "pass"))
        self.assertRegex(room[1], r"^[\d.]+ [GT]B free, three days of the show take 450 MB$")
        self.assertRegex(end_of[1], rf"^{newest.name} reads to 0:\d\d:\d\d; \d+ bytes behind that cannot be read$")
        self.assertIn("the world goes on from there", end_of[2])
        newest.write_bytes(b"nothing")
        self.assertEqual([verdict for verdict, _, _ in self.found()], ["pass", "pass", "warn"])
        newest.write_bytes(whole)

    def test_a_killed_master_goes_on_with_its_world(self):
        show = start("run", self.rig, "--headless", "--live", "--pattern", "grid", log=self.log)
        self.processes = [show]
        wait_until(lambda: (self.tick() or 0) > 400, 120, "seven seconds of the world")
        chance = random.Random(20261127)
        for kill in range(1, KILLS + 1):
            time.sleep(6 * chance.random() if kill > 1 else 0)
            before = self.tick()
            master = next(pid for command, pid in children_of(show).items() if " master " in command)
            killed = time.monotonic()
            os.kill(master, signal.SIGKILL)
            wait_until(lambda: self.log.read_text().count("the world goes on at") == kill, 60, "the world to go on")
            wait_until(self.tick, 60, "the master to answer")
            print(f"kill {kill}: no master answered for {time.monotonic() - killed:.1f} s")
            self.assertGreaterEqual(self.tick(), before, "nothing that was shown is shown again")
            self.assertRegex(self.journal(), r"^written .* the world goes on from 0:\d\d:\d\d, away for \d+ s$")
            self.assertEqual(len(self.recordings()), kill + 1)
            seen = self.tick()
            wait_until(lambda: self.tick() > seen + 300, 60, "five seconds of the world")
        self.assertEqual([verdict for verdict, _, _ in self.found()], ["pass"] * 5, self.found())
        end([show])
        self.look_at_damage()
        for recording in self.recordings():
            checked = aquarama("replay", recording, "--check")
            self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
            self.assertIn("the replay is the same world", checked.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
