"""A new hall with a real show, step by step: what each step finds, how it is left, and how it is taken up again."""

import json
import os
import pty
import re
import shutil
import signal
import subprocess
import tempfile
import termios
import unittest
from pathlib import Path

from show import BIN, EMPTY_SEA, ROOT, ShowCase, aquarama, control_address, rig_on_free_ports, start, wait_until

HOURS = 'zone: "UTC"\nopen { days: [SUNDAY] from: "10:00" to: "18:00" }\n'


def other_disk():
    """A folder of another file system than that of temporary files, as a stick is; None where there is none."""
    shared = Path("/dev/shm")
    is_other = shared.is_dir() and shared.stat().st_dev != Path(tempfile.gettempdir()).stat().st_dev
    return tempfile.mkdtemp(prefix="aquarama-stick-", dir=shared) if is_other else None


class Tour(ShowCase):
    def setUp(self):
        super().setUp()
        self.rig = rig_on_free_ports(self.folder.name, replace=EMPTY_SEA)
        self.record = Path(os.environ["XDG_STATE_HOME"]) / "aquarama/shows/desk.tour.json"

    def tour(self, *arguments, keys=""):
        done = aquarama("tour", self.rig, *arguments, input=keys)
        self.assertNotIn("aquarama tour:", done.stderr)
        return done

    def ticks(self, text):
        """The steps of the last list of an output that are done, in their order."""
        rows = re.findall(r"^\[([x ])\] (\d) (\w+)", text, re.MULTILINE)[-8:]
        self.assertEqual([number for _, number, _ in rows], list("12345678"), text)
        return [name for tick, _, name in rows if tick == "x"]

    def shown(self):
        return re.search(r"pattern (\w+)", aquarama("status", self.rig).stdout)

    def shows(self, pattern):
        found = self.shown()
        return found is not None and found[1] == pattern

    def nodes(self, *names):
        for name in names:
            self.processes.append(start("node", name, "--master", control_address(self.rig), "--headless",
                                        log=self.log))

    def report_of_all(self):
        return all(f"node {name}" in self.doctor() for name in ("left", "middle", "right"))

    def doctor(self):
        """The subjects of which the doctor knows a build: nodes that have reported."""
        findings = json.loads(aquarama("doctor", self.rig, "--json").stdout)
        return {one["subject"] for one in findings if one["what"].startswith("build ")}

    def test_before_a_show_it_confirms_the_screen_and_stops_at_the_machines(self):
        listed = self.tour("--list")
        self.assertEqual((listed.returncode, self.ticks(listed.stdout)), (1, []))
        self.assertIn("as in desk.txtpb of the programs", listed.stdout)
        self.assertFalse(self.record.exists(), "a list keeps nothing")
        done = self.tour(keys="\n")
        self.assertEqual((done.returncode, self.ticks(done.stdout)), (1, ["screen"]))
        self.assertRegex(done.stdout, r"machines: .*\n  found  no show runs\n  to do  start it: aquarama run ")
        self.assertNotIn("channels: ", done.stdout, "the next step waits")
        again = self.tour()
        self.assertNotIn("screen: ", again.stdout, "what is done is not asked again")
        self.rig.write_text(self.rig.read_text().replace("arc_deg: 120", "arc_deg: 1200"))
        broken = self.tour()
        self.assertEqual((broken.returncode, self.ticks(broken.stdout)), (1, []))
        self.assertRegex(broken.stdout, r"screen: .*\n  found  \S+desk\.txtpb:\d+:\d+: ")

    def begin_show(self):
        self.processes = [start("master", self.rig, log=self.log)]
        self.nodes("left", "middle")
        wait_until(lambda: len(self.doctor()) == 2, 120, "the reports of two nodes")

    def test_with_a_real_show_from_the_first_step_to_the_last(self):
        self.begin_show()
        done = self.tour(keys="\n")
        self.assertEqual(self.ticks(done.stdout), ["screen"])
        self.assertRegex(done.stdout, r"  found  2 of 3 nodes; absent: right\n  to do  start each on its machine")
        self.nodes("right")
        wait_until(self.report_of_all, 120, "the reports of three nodes")
        self.killed_while_the_grid_is_shown(signal.SIGTERM)
        done = self.tour(keys="\n")
        self.assertEqual(self.ticks(done.stdout), ["screen", "machines", "channels", "doctor", "focus"])
        self.assertTrue(self.shows("world"))
        self.assertRegex(done.stdout, r"calibration: .*\n  found  the rig names no calibration\n"
                                      r"  to do  aquarama calibrate --rig \S+desk\.txtpb ")
        self.calibrate()
        hours = Path(os.environ["XDG_STATE_HOME"]) / "aquarama/console/desk/hours.txtpb"
        hours.parent.mkdir(parents=True)
        hours.write_text(HOURS)
        done = self.tour(keys="\n")
        self.assertEqual(self.ticks(done.stdout)[5:], ["calibration", "hours"])
        self.assertRegex(done.stdout, r"hours +\S+ \S+ +now (open|closed); 20\d\d-\S+ 1[08]:00")
        self.back_up()

    def killed_while_the_grid_is_shown(self, by):
        tour = subprocess.Popen([BIN / "aquarama", "tour", self.rig], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                text=True)
        wait_until(lambda: self.shows("grid"), 60, "the grid on the wall")
        tour.send_signal(by)
        out, _ = tour.communicate(timeout=60)
        self.assertEqual(tour.returncode, 1)
        self.assertTrue(self.shows("world"), "the wall shows the world again")
        self.assertNotIn("focus", self.ticks(out), "nobody has confirmed it")

    def calibrate(self):
        wall = self.rig.with_suffix(".mpcdi")
        self.assertEqual(aquarama("convert", self.rig, wall).returncode, 0)
        self.rig.write_text(self.rig.read_text() + 'calibration: "desk.mpcdi"\n')

    def back_up(self):
        """On another disk, where this machine has one: as on a stick."""
        stick = other_disk() or self.folder.name + "/stick"
        self.addCleanup(shutil.rmtree, stick, ignore_errors=True)
        done = self.tour("--backup", stick)
        self.assertEqual(done.returncode, 1)
        command = re.search(r"backup: .*\n  found  .*\n  to do  aquarama (.*)\n", done.stdout)[1].split()
        made = aquarama(*command, "--passphrase", "-", input="a fish in a hall\n")
        self.assertEqual(made.returncode, 0, made.stderr)
        done = self.tour(keys="\n")
        self.assertEqual((done.returncode, len(self.ticks(done.stdout))), (0, 8), done.stdout)
        self.assertRegex(done.stdout, r"8 of 8 steps done, \d+ s so far\n\Z")
        self.assertEqual(self.tour("--list").returncode, 0)
        os.utime(self.rig, (4e9, 4e9))
        done = self.tour("--list")
        self.assertEqual((done.returncode, "backup" in self.ticks(done.stdout)), (1, False))
        self.assertIn("and the hall has changed since", done.stdout)

    def test_at_a_terminal_keys_answer_and_the_terminal_is_as_before(self):
        for keys, last in ((b"nq", "machines"), (b"\r\x03", "machines"), (b"nnq", "channels")):
            self.record.unlink(missing_ok=True)
            process, terminal = pty.fork()
            if process == 0:
                os.execv(BIN / "aquarama", ["aquarama", "tour", str(self.rig)])
            before = termios.tcgetattr(terminal)[3]
            said = b""
            try:
                while part := os.read(terminal, 4096):
                    said += part
                    if keys and said.endswith(b"another time\r\n"):
                        os.write(terminal, keys[:1])
                        keys = keys[1:]
            except OSError:  # it has ended
                pass
            self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]), 1)
            self.assertEqual(termios.tcgetattr(terminal)[3], before)
            os.close(terminal)
            self.assertEqual(re.findall(r"^(\w+): ", said.decode().replace("\r", ""), re.MULTILINE)[-1], last)

    def test_a_program_is_told_the_steps_and_confirms_what_was_found(self):
        listed = self.tour("--json")
        told = json.loads(listed.stdout)
        self.assertEqual(listed.returncode, 1)
        self.assertEqual([step["name"] for step in told["steps"]],
                         ["screen", "machines", "channels", "doctor", "focus", "calibration", "hours", "backup"])
        screen = told["steps"][0]
        self.assertEqual(screen["state"], "confirm")
        refused = aquarama("tour", self.rig, "--confirm", "screen", "--found", "flat")
        self.assertEqual(refused.returncode, 1)
        self.assertRegex(refused.stderr, r"\Aaquarama tour: screen: has found by now: cylinder, .*; look again\n\Z")
        self.assertEqual(self.tour("--confirm", "screen", "--found", screen["found"]).returncode, 0)
        states = [step["state"] for step in json.loads(self.tour("--json").stdout)["steps"]]
        self.assertEqual(states[:2], ["done", "todo"])
        for wrong in (("--confirm", "screen"), ("--found", "flat"), ("--confirm", "lunch", "--found", "flat")):
            self.assertNotEqual(aquarama("tour", self.rig, *wrong).returncode, 0)

    def test_one_step_alone_is_begun_anew(self):
        self.tour(keys="\n")
        done = self.tour("--step", "screen")
        self.assertEqual(done.returncode, 1, "is to be confirmed again")
        self.assertEqual(self.tour("--step", "screen", keys="\n").returncode, 0)
        self.assertNotEqual(aquarama("tour", self.rig, "--step", "lunch").returncode, 0)

    def test_a_record_that_cannot_be_read_is_one_line(self):
        self.record.parent.mkdir(parents=True)
        self.record.write_text('{"steps": {')
        done = aquarama("tour", self.rig, input="")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"\Aaquarama tour: \S+desk\.tour\.json: cannot be read .*; remove it, .*\n\Z")


if __name__ == "__main__":
    unittest.main(verbosity=2)
