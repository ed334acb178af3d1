"""Real processes: a terminal steers a live show, and the recording of it replays as the same world."""

import re
import signal
import subprocess
import unittest
from pathlib import Path

from show import BIN, ROOT, aquarama, control_address, end, rig_on_free_ports, start, temporary_folder, wait_until


class Pilot(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder()
        self.rig = rig_on_free_ports(self.folder.name)
        self.recording = Path(self.folder.name) / "show.aqrec"
        self.processes = []

    def tearDown(self):
        end(self.processes)
        self.folder.cleanup()

    def submarine(self):
        """What status says of it: (x, z, metres a second, who steers); nothing while no frame was shown."""
        said = re.search(r"submarine +at (\S+) \S+ (\S+) m .* (\S+) m/s +(.*)", aquarama("status", self.rig).stdout)
        return said and (float(said[1]), float(said[2]), float(said[3]), said[4])

    def test_a_terminal_steers_and_the_recording_replays(self):
        master = start("master", self.rig, "--pattern", "grey", "--record", self.recording)
        node = start("node", "middle", "--master", control_address(self.rig), "--headless")
        self.processes = [master, node]
        wait_until(lambda: (self.submarine() or [0, 0, 0, ""])[1:] == (0.0, 0.0, "nobody steers"), 60,
                   "the eye at its place")
        pilot = subprocess.Popen([BIN / "aquarama", "pilot", self.rig], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                 text=True, cwd=ROOT)
        self.processes.append(pilot)
        pilot.stdin.write("wwwd")
        pilot.stdin.flush()
        wait_until(lambda: self.submarine()[3] == "pilot steers" and self.submarine()[2] > 0.3, 30,
                   "the submarine to move")
        wait_until(lambda: self.submarine()[0] > 0.05 and self.submarine()[1] < -0.2, 30,
                   "the submarine to get ahead and to the right")
        pilot.stdin.write(" ")
        pilot.stdin.flush()
        wait_until(lambda: self.submarine()[3] == "nobody steers", 30, "the hand to let go")
        said, _ = pilot.communicate("q", timeout=20)
        self.assertEqual(pilot.returncode, 0)
        self.assertIn("ahead 3/4, to the right 1/4", said)
        master.send_signal(signal.SIGTERM)
        self.assertEqual(master.wait(20), 0)
        check = aquarama("replay", self.recording, "--check")
        self.assertEqual(check.returncode, 0, check.stdout + check.stderr)
        self.assertIn("the same world", check.stdout)
        self.assertIn("steering ahead", aquarama("inspect", self.recording).stdout)

    def test_a_pilot_without_a_show_says_so(self):
        pilot = aquarama("pilot", self.rig, input="w")
        self.assertEqual(pilot.returncode, 1)
        self.assertIn("no master answers", pilot.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
