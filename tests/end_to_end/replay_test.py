"""Real processes: a show is recorded, replayed and explained, live and from its recording."""

import re
import unittest
import zlib
from pathlib import Path

from show import aquarama, control_address, end, rig_on_free_ports, start, temporary_folder, wait_until


class Replay(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder()
        self.rig = rig_on_free_ports(self.folder.name)
        self.recording = Path(self.folder.name) / "show.aqrec"

    def tearDown(self):
        self.folder.cleanup()

    def record(self, frames):
        run = aquarama("run", self.rig, "--headless", "--pattern", "grey", "--frames", frames, "--record",
                       self.recording)
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_a_recorded_show_replays_without_a_wall_and_on_it(self):
        self.record(120)
        check = aquarama("replay", self.recording, "--check")
        self.assertEqual(check.returncode, 0, check.stdout + check.stderr)
        self.assertIn("119 ticks", check.stdout)
        self.assertIn("the same world", check.stdout)
        again = aquarama("replay", self.recording, "--rig", self.rig, "--headless", "--pattern", "grey")
        self.assertEqual(again.returncode, 0, again.stderr)
        inspected = aquarama("inspect", self.recording)
        self.assertEqual(inspected.returncode, 0, inspected.stderr)
        self.assertRegex(inspected.stdout, r"species +\d+ of bigeye_scad\.txtpb")
        self.assertNotIn(self.folder.name + "/species", inspected.stdout)

    def test_a_damaged_or_overwritten_recording_is_refused(self):
        self.record(2)
        self.assertNotEqual(
            aquarama("run", self.rig, "--headless", "--frames", 1, "--record", self.recording).returncode, 0)
        content = bytearray(self.recording.read_bytes())
        length = next(n for n in range(6, 60) if content[-n - 1] == n
                      and content[-4:] == zlib.crc32(content[-n:-5]).to_bytes(4, "little"))  # of the last entry
        content[-6] ^= 1  # of the last hash
        self.recording.write_bytes(content)
        check = aquarama("replay", self.recording, "--check")
        self.assertIn(f"{length + 1} bytes of an unfinished or damaged entry are left out", check.stdout + check.stderr)
        content[-4:] = zlib.crc32(content[-length:-5]).to_bytes(4, "little")
        self.recording.write_bytes(content)
        check = aquarama("replay", self.recording, "--check")
        self.assertEqual(check.returncode, 1, check.stdout)
        self.assertIn("differs at tick", check.stdout)
        content[len(content) // 2] ^= 1  # in a repertoire
        self.recording.write_bytes(content)
        self.assertNotEqual(aquarama("replay", self.recording, "--check").returncode, 0)

    def test_a_killed_show_leaves_what_it_had_recorded(self):
        master = start("master", self.rig, "--record", self.recording)
        try:
            wait_until(lambda: self.recording.exists(), 60, "the recording")
            wait_until(lambda: self.explained(5), 60, "an answer")
        finally:
            master.kill()
            master.wait()
        check = aquarama("replay", self.recording, "--check")
        self.assertEqual(check.returncode, 0, check.stdout + check.stderr)
        self.assertIn("cut short", check.stdout)

    def explained(self, fish):
        asked = aquarama("explain", "--fish", fish, "--master", control_address(self.rig))
        return asked.stdout if asked.returncode == 0 else ""

    def test_a_mind_is_explained_alike_live_and_from_the_recording(self):
        master = start("master", self.rig, "--record", self.recording)
        try:
            wait_until(lambda: self.explained(5), 60, "an answer")
            live = self.explained(5)
            beyond = aquarama("explain", "--fish", 5000, "--master", control_address(self.rig))
            self.assertNotEqual(beyond.returncode, 0)
            self.assertRegex(beyond.stderr, r"no fish 5000: the world has \d+, 0 to \d+")
        finally:
            end([master])
        tick = re.search(r"tick (\d+)", live).group(1)
        for head in ["FISH", "SEES", "FEELS", "INTENDS", "DOES", "WHY"]:
            self.assertIn(head, live)
        replayed = aquarama("explain", "--fish", 5, "--replay", self.recording, "--tick", tick)
        self.assertEqual(replayed.stdout, live, replayed.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
