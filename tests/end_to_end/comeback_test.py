"""After a power cut the wall is as the hours want it: master and console, killed and started again at other times."""

import json
import os
import subprocess
import time
import unittest
from pathlib import Path

from show import (BIN, EMPTY_SEA, FAKE_TIME, ROOT, ShowCase, aquarama, at_time, lacks, rig_on_free_ports, start,
                  wait_until)

DAYS = "MONDAY, TUESDAY, WEDNESDAY, THURSDAY, FRIDAY, SATURDAY, SUNDAY"
HOURS = f'zone: "UTC"\nopen {{ days: [{DAYS}] from: "10:00" to: "18:00" }}\n'


@unittest.skipIf(*lacks(FAKE_TIME, "libfaketime"))
class Comeback(ShowCase):
    def setUp(self):
        super().setUp()
        self.rig = rig_on_free_ports(self.folder.name, replace=EMPTY_SEA)
        self.state = Path(os.environ["XDG_STATE_HOME"]) / "aquarama"
        self.console = self.state / "console/desk"
        self.console.mkdir(parents=True)
        (self.console / "hours.txtpb").write_text(HOURS)

    def power_on(self, clock):
        """As the services start both; the clock of the hall says this time."""
        with open(self.log, "a") as log:
            self.processes = [
                start("master", self.rig, "--resume", log=self.log),
                subprocess.Popen([BIN / "aquarama-console", self.rig], stdout=log, stderr=log, cwd=ROOT,
                                 env=os.environ | at_time(clock))]

    def cut_power(self):
        for process in self.processes:
            process.kill()
        for process in self.processes:
            process.wait()

    def is_black(self):
        done = aquarama("status", self.rig)
        return ("black on" in done.stdout) if done.returncode == 0 else None

    def comes_back(self, clock, is_open):
        self.power_on(clock)
        wait_until(lambda: self.is_black() == (not is_open), 90,
                   f"a wall that is {'open' if is_open else 'black'} at {clock}")

    def test_at_any_time_as_the_hours_want_it(self):
        for clock, is_open in (("2030-01-06 12:00:00", True), ("2030-01-06 18:30:00", False),
                               ("2030-01-06 23:00:00", False), ("2030-01-07 12:00:00", True),
                               ("2030-01-07 17:59:57", False), ("2030-01-08 09:59:57", True)):
            with self.subTest(clock):
                self.comes_back(clock, is_open)
                self.cut_power()

    def test_a_start_that_is_cut_off_changes_nothing(self):
        self.comes_back("2030-01-06 12:00:00", True)
        self.cut_power()
        for seconds in (0.05, 0.2, 0.5, 1, 2):
            self.power_on("2030-01-06 13:00:00")
            time.sleep(seconds)
            self.cut_power()
        self.comes_back("2030-01-06 18:00:10", False)

    def test_what_an_operator_set_holds_over_a_cut_until_the_hours_want_another_state(self):
        self.comes_back("2030-01-06 12:00:00", True)
        done = self.console / "opening.json"
        wait_until(lambda: done.exists() and json.loads(done.read_text()).get("open"), 30, "the console to have opened")
        self.assertEqual(aquarama("set", self.rig, "black", "on").returncode, 0)
        self.cut_power()
        self.power_on("2030-01-06 13:00:00")
        wait_until(self.is_black, 60, "the wall as it was")
        time.sleep(3)  # as many looks at the hours
        self.assertTrue(self.is_black())
        self.cut_power()
        self.comes_back("2030-01-06 18:30:00", False)
        self.cut_power()
        self.comes_back("2030-01-07 10:30:00", True)


if __name__ == "__main__":
    unittest.main(verbosity=2)
