"""What the hours of a rig say, asked at a terminal: by a file of hours, or by the rig whose hours the console keeps."""

import os
import unittest
from pathlib import Path

from show import FAKE_TIME, aquarama, at_time, lacks, rig_on_free_ports, temporary_folder

HOURS = """zone: "Europe/Berlin"
open { days: [SATURDAY, SUNDAY] from: "10:00" to: "18:00" scene: "bait_ball" quality: "high" }
exceptions { date: "2026-03-28" }
"""


class Schedule(unittest.TestCase):
    def setUp(self):
        temporary = temporary_folder()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.file = self.folder / "hours.txtpb"
        self.file.write_text(HOURS)
        self.rig = rig_on_free_ports(self.folder)
        self.kept = Path(os.environ["XDG_STATE_HOME"]) / "aquarama/console/desk/hours.txtpb"

    def says(self, said, *arguments, **options):
        done = aquarama("schedule", *arguments, **options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, said)

    def refuses(self, said, *arguments, **options):
        done = aquarama("schedule", *arguments, **options)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, rf"\Aaquarama schedule \w+: {said}\n\Z")

    def test_what_is_wanted_at_a_moment(self):
        for at, said in (("2026-03-29 09:59", "+02:00 Sunday     closed"),
                         ("2026-03-29 10:00", "+02:00 Sunday     open, scene bait_ball, quality high"),
                         ("2026-03-28 12:00", "+01:00 Saturday   closed")):
            self.says(f"{at} {said}\n", "now", self.file, "--at", at)

    def test_what_comes_next_over_a_change_of_summer_time(self):
        done = aquarama("schedule", "next", self.file, "--at", "2026-03-22 12:00")
        lines = done.stdout.splitlines()
        self.assertEqual(lines[:3], ["2026-03-22 18:00 +01:00 Sunday     closed",
                                     "2026-03-29 10:00 +02:00 Sunday     open, scene bait_ball, quality high",
                                     "2026-03-29 18:00 +02:00 Sunday     closed"])
        self.assertEqual(len(lines), 10)
        self.file.write_text('zone: "UTC"')
        self.says("no change within a year from then on\n", "next", self.file)

    @unittest.skipIf(*lacks(FAKE_TIME, "libfaketime"))
    def test_now_is_what_the_clock_of_the_machine_says(self):
        self.says("2038-01-02 10:30 +01:00 Saturday   open, scene bait_ball, quality high\n", "now", self.file,
                  environment=at_time("2038-01-02 09:30:00"))
        self.refuses("the clock of this machine says 2001-01-02, before this program was built .*; set it .*", "now",
                     self.file, environment=at_time("2001-01-02 09:30:00"))

    def test_the_hours_of_a_rig_are_those_that_its_console_keeps(self):
        self.refuses(r"\S+/console/desk/hours\.txtpb: is not there, so \S+desk\.txtpb has no hours; enter them in the "
                     r"console \(Schedule\)", "check", self.rig)
        self.kept.parent.mkdir(parents=True)
        self.kept.write_text(HOURS)
        self.says(f"{self.kept}: good; 1 span a week, 1 day of its own, 0 projectors, by the clock of Europe/Berlin\n",
                  "check", self.rig)
        self.says("2026-03-29 09:59 +02:00 Sunday     closed\n", "now", self.rig, "--at", "2026-03-29 09:59")

    def test_mistakes_are_one_line(self):
        self.file.write_text(HOURS.replace("10:00", "25:00"))
        for command in ("check", "now", "next"):
            self.refuses(r'\S+hours\.txtpb:2:33: from "25:00" is no time: write 09:30', command, self.file)
        self.kept.parent.mkdir(parents=True)
        self.kept.write_text(HOURS.replace("bait_ball", "whales"))
        self.refuses(r"\S+/scenes/whales\.txtpb: is not there, and the hours of \S+desk\.txtpb name this scene; put it "
                     "there, or correct the hours", "check", self.rig)
        self.file.write_text(HOURS)
        self.refuses('"24.12." is no day and time: write "2026-12-24 18:00"', "now", self.file, "--at", "24.12.")


if __name__ == "__main__":
    unittest.main(verbosity=2)
