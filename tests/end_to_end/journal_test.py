"""Real processes: a master that is killed goes on with its world, and its journal plays again.

AQUARAMA_KILLS is how often it is killed; without it once. Prints how long each time no master answered.
"""

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
            self.assertEqual(len(self.recordings()), kill + 1)
            seen = self.tick()
            wait_until(lambda: self.tick() > seen + 300, 60, "five seconds of the world")
        end([show])
        for recording in self.recordings():
            checked = aquarama("replay", recording, "--check")
            self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
            self.assertIn("the replay is the same world", checked.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
