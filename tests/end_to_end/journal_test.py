"""Real processes: a master that is killed goes on with its world, its journal plays again, and the wall goes on alone.

AQUARAMA_KILLS is how often it is killed; without it once. Prints how long each time no master answered.
"""

import json
import os
import random
import re
import signal
import subprocess
import time
import unittest
from pathlib import Path

from show import BIN, ROOT, ShowCase, aquarama, children_of, control_address, end, rig_on_free_ports, start, trace, \
    wait_until

KILLS = int(os.environ.get("AQUARAMA_KILLS", "1"))


class Journal(ShowCase):
    def setUp(self):
        super().setUp()
        # Sixty fish: the default scene lives for ninety seconds first, of which a debug build takes three.
        self.rig = rig_on_free_ports(self.folder.name, replace=[("reef.txtpb", "reef_1998.txtpb")])

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

    def shown(self):
        """How many frames the node has shown."""
        return len(trace(self.folder.name, "left"))

    def test_the_fish_swim_on_while_no_master_is_there(self):
        node_log = Path(self.folder.name) / "node.log"
        master = start("master", "--quality", "low", self.rig, log=self.log)
        with node_log.open("w") as output:
            node = subprocess.Popen([BIN / "aquarama-node", "left", "--master", control_address(self.rig), "--headless",
                                     "--trace", self.folder.name], stdout=output, stderr=subprocess.STDOUT, cwd=ROOT)
        self.processes = [node, master]
        wait_until(lambda: self.shown() > 20, 120, "frames of the reef")
        master.kill()
        master.wait()
        wait_until(lambda: "the fish swim on" in node_log.read_text(), 10, "the node to go on alone")
        time.sleep(3)  # it gives the master up meanwhile, and joins again
        alone = self.shown()
        wait_until(lambda: self.shown() > alone + 10, 60, "frames of its own")
        self.processes.append(start("master", "--quality", "low", self.rig, log=self.log))
        wait_until(lambda: "the master leads again" in node_log.read_text(), 60, "frames of the master")
        led = self.shown()
        wait_until(lambda: self.shown() > led + 10, 60, "more of them")
        said = node_log.read_text()
        self.assertEqual(said.count("building "), 1, "nothing is built again")
        self.assertNotIn("lost the master; joining again", said)
        self.assertIn("the world goes on at", self.log.read_text())


if __name__ == "__main__":
    unittest.main(verbosity=2)
