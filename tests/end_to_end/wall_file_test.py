"""Real processes: a rig whose channels have a wall file shows what the projectors did, and takes another file while it
runs."""

import math
import os
import re
import shutil
import sys
import time
import unittest
from array import array
from pathlib import Path

from show import (CHANNELS, EMPTY_SEA, ROOT, aquarama, end, give_colours, rig_on_free_ports, start, temporary_folder,
                  trace, wait_until)

sys.path.insert(0, str(ROOT / "packaging"))
from check_pictures import read_png  # noqa: E402


def displacement(one, other):
    """By how many pixels one picture must be moved, right and down, to lie on the other: a step of least squares each
    way."""
    (size, before), (same, after) = read_png(one), read_png(other)
    assert size == same
    (width, height), ways = size, []
    light = [code ** 2.2 for code in range(256)]  # that of codes, nearly
    before, after = ([light[code] for code in picture[1::3]] for picture in (before, after))
    for step in (1, width):
        products = squares = 0
        for i in range(width, width * (height - 1)):
            slope = (before[i + step] - before[i - step]) / 2
            products, squares = products + slope * (before[i] - after[i]), squares + slope * slope
        ways.append(products / squares)
    return ways


def write_map_of_4k(path, turned_degrees):
    """A raw float map: of each pixel of a 4K projector its point on the desk's screen, from left of its edge to beyond
    its middle."""
    width, height, radius = 3840, 2160, 2.62
    row = array("f", bytes(12 * width))
    azimuths = [math.radians(-61 + 56 * column / width + turned_degrees) for column in range(width)]
    row[0::3] = array("f", [radius * math.sin(azimuth) for azimuth in azimuths])
    row[2::3] = array("f", [-radius * math.cos(azimuth) for azimuth in azimuths])
    with open(path, "wb") as file:
        file.write(b"PF\n%d %d\n-1.000000\n" % (width, height))
        for line in range(height):
            row[1::3] = array("f", [2.4 * (line / height - 0.5)]) * width
            file.write(row.tobytes())


class WallFile(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder()
        self.desk = rig_on_free_ports(self.folder.name, replace=EMPTY_SEA)
        self.file = Path(self.folder.name) / "hall.mpcdi"
        made = aquarama("convert", self.desk, self.file)
        self.assertEqual(made.returncode, 0, made.stderr)
        text = re.sub(r"  projector \{.*?\n  \}\n", '  wall_file { file: "hall.mpcdi" }\n', self.desk.read_text(),
                      flags=re.S)
        self.rig = Path(self.folder.name) / "hall.txtpb"
        self.rig.write_text(text)
        self.log = Path(self.folder.name) / "log"
        self.processes = []

    def tearDown(self):
        end(self.processes)
        self.folder.cleanup()

    def snapshot(self, rig, name):
        folder = Path(self.folder.name) / name
        done = aquarama("run", rig, "--headless", "--frames", 2, "--pattern", "grid", "--snapshot", folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return folder

    def test_the_file_of_a_rig_shows_what_the_rig_shows(self):
        self.assertIn("good", aquarama("check", self.rig).stdout)
        before, after = self.snapshot(self.desk, "before"), self.snapshot(self.rig, "after")
        for name in [*(f"channel-{channel}" for channel in CHANNELS), "panorama"]:
            right, down = displacement(before / f"{name}.png", after / f"{name}.png")
            self.assertLess(max(abs(right), abs(down)), 0.05, name)

    def test_colours_change_the_codes_and_not_the_wall(self):
        before = self.snapshot(self.rig, "before")
        give_colours(self.file)
        after = self.snapshot(self.rig, "after")
        for name, least, most in (("channel-middle", 3, 100), ("panorama", 0, 0.7)):
            one, other = (read_png(folder / f"{name}.png")[1] for folder in (before, after))
            mean = sum(abs(a - b) for a, b in zip(one, other)) / len(one)
            self.assertTrue(least <= mean <= most, f"{name}: {mean} codes")

    def calibration(self):
        said = re.search(r"calibration (\w+)", aquarama("status", self.rig).stdout)
        return said and said[1]

    def start_show(self):
        """Returns the digest of its calibration."""
        show = start("run", self.rig, "--headless", "--live", "--pattern", "grid", "--trace", self.folder.name,
                     log=self.log)
        self.processes = [show]
        wait_until(lambda: self.log.read_text().count("showing") >= 3, 60, "the first frame of every node")
        first = self.calibration()
        self.assertTrue(first)
        return first

    def test_another_file_comes_on_between_two_frames(self):
        first = self.start_show()

        self.file.write_bytes(self.file.read_bytes()[:1000])
        wait_until(lambda: "the wall stays as it is" in self.log.read_text(), 20, "the refusal of half a file")
        self.assertEqual(self.calibration(), first)

        moved = re.sub(r"yaw_deg: 39.2", "yaw_deg: 39.5", self.desk.read_text())
        other = Path(self.folder.name) / "moved.txtpb"
        other.write_text(moved)
        made = aquarama("convert", other, Path(self.folder.name) / "moved.mpcdi")
        self.assertEqual(made.returncode, 0, made.stderr)
        shutil.move(Path(self.folder.name) / "moved.mpcdi", self.file)
        wait_until(lambda: "showing look 2" in self.log.read_text(), 60, "the new file on the wall")
        wait_until(lambda: self.calibration() not in (None, first), 10, "its digest")
        time.sleep(4)  # it looks at the files once a second
        log = self.log.read_text()
        self.assertNotIn("showing look 3", log)
        self.assertEqual(log.count("the wall stays as it is"), 1)
        self.assertNotIn("joining again", log)
        self.assertNotIn("through black", log)
        frames = [set(frame for frame, row in trace(self.folder.name, name).items() if row[2]) for name in CHANNELS]
        self.assertGreater(len(set.intersection(*frames)), 20)

    def test_what_is_set_by_hand_comes_on_and_goes_again(self):
        by_hand = Path(self.folder.name) / "by_hand.txtpb"
        by_hand.write_text("# the door\n")
        self.rig.write_text(self.rig.read_text() + 'adjustments: "by_hand.txtpb"\n')
        before = self.snapshot(self.rig, "before")
        refused = aquarama("adjust", "move", self.rig, "middle", 600, 200, 60, 0, "--radius", 80)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("folds the picture", refused.stderr)
        self.assertEqual(by_hand.read_text(), "# the door\n")

        done = aquarama("adjust", "move", self.rig, "middle", 675, 300, -0.8, 0.6, "--radius", 2000)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("1 control points", aquarama("check", self.rig).stdout)
        after = self.snapshot(self.rig, "after")
        right, down = displacement(before / "channel-middle.png", after / "channel-middle.png")
        self.assertTrue(-0.85 < right < -0.45 and 0.35 < down < 0.65, (right, down))

        first = self.start_show()
        done = aquarama("adjust", "remove", self.rig, 1)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(by_hand.read_text(), "# the door\n")
        wait_until(lambda: "showing look 2" in self.log.read_text(), 60, "the wall without the point")
        wait_until(lambda: self.calibration() not in (None, first), 10, "its digest")

    def test_an_earlier_calibration_comes_back(self):
        self.rig.write_text(self.desk.read_text() + 'calibration: "hall.mpcdi"\n')
        first = self.start_show()
        earlier = self.file.read_bytes()
        (Path(self.folder.name) / "hall.history").mkdir()
        shutil.copy(self.file, Path(self.folder.name) / "hall.history" / "2026-01-24T210301.mpcdi")
        moved = Path(self.folder.name) / "moved.txtpb"
        moved.write_text(re.sub(r"yaw_deg: 39.2", "yaw_deg: 39.5", self.desk.read_text()))
        self.assertEqual(aquarama("convert", moved, self.file).returncode, 0)
        wait_until(lambda: self.calibration() not in (None, first), 60, "the new one")

        self.assertNotEqual(aquarama("calibrations", self.rig, "--use", "7").returncode, 0)
        done = aquarama("calibrations", self.rig, "--use", "2026-01-24T2103")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"2  2026-01-24 21:03:01 UTC .*in use")
        self.assertIn("2 kept", done.stdout)
        self.assertEqual(self.file.read_bytes(), earlier)
        wait_until(lambda: self.calibration() == first, 60, "the earlier one")

    def test_a_raw_map_of_4k_and_another_of_its_size_and_time_come_on(self):
        file, other = Path(self.folder.name) / "left.pfm", Path(self.folder.name) / "other.pfm"
        write_map_of_4k(file, 0)
        self.rig.write_text(self.rig.read_text().replace("hall.mpcdi", "left.pfm", 1))
        self.assertIn("good", aquarama("check", self.rig).stdout)
        first = self.start_show()

        write_map_of_4k(other, 0.3)
        self.assertEqual(other.stat().st_size, file.stat().st_size)
        os.utime(other, ns=(file.stat().st_atime_ns, file.stat().st_mtime_ns))
        other.replace(file)
        wait_until(lambda: "showing look 2" in self.log.read_text(), 90, "the new map on the wall")
        wait_until(lambda: self.calibration() not in (None, first), 10, "its digest")
        file.touch()  # the same map
        time.sleep(4)  # it looks at the files once a second
        log = self.log.read_text()
        self.assertEqual(log.count("files of the wall have changed"), 1)
        self.assertNotIn("joining again", log)
        self.assertNotIn("is not counted any more", log)


if __name__ == "__main__":
    unittest.main(verbosity=2)
