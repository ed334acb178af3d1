"""A rig for the machine at hand: asked for on a terminal, or by options; what is written is good, or nothing is."""

import os
import pty
import re
import select
import subprocess
import time
import unittest
from pathlib import Path

from show import BIN, ROOT, aquarama, temporary_folder


class NewRig(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder()
        self.rig = Path(self.folder.name, "school.txtpb")

    def tearDown(self):
        self.folder.cleanup()

    def write(self, *options):
        return aquarama("new-rig", self.rig, *options)

    def refuses(self, said, *options, status=1):
        done = self.write(*options)
        self.assertEqual((done.returncode, done.stdout), (status, ""))
        self.assertRegex(done.stderr, said)
        self.assertEqual(done.stderr.count("\n"), 1)

    def is_good(self):
        checked = aquarama("check", self.rig)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertIn("good", checked.stdout)

    def talk(self, answers):
        """On a terminal: [(what is asked, the answer)], then everything that was said."""
        process, terminal = pty.fork()
        if process == 0:
            os.execv(BIN / "aquarama", ["aquarama", "new-rig", str(self.rig)])
        said = ""
        answers = list(answers)
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and select.select([terminal], [], [], 1) is not None:
            try:
                said += os.read(terminal, 4096).decode()
            except OSError:  # it has ended
                break
            if answers and re.search(answers[0][0] + r"[^\n]*\]: $", said):
                os.write(terminal, (answers.pop(0)[1] + "\n").encode())
        status = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
        os.close(terminal)
        self.assertEqual(answers, [], said)
        return status, said

    def test_options_alone_write_a_commented_rig_that_is_good(self):
        done = self.write("--screen", "televisions", "--monitors", "HDMI-1,HDMI-A-2,DP-1", "--diagonal", 55, "--angle",
                          50, "--distance", 1.2)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"left +HDMI-1 .*\n +middle +HDMI-2 .*\n +right +DP-1 .*\nnext: aquarama run")
        self.is_good()
        text = self.rig.read_text()
        self.assertTrue(text.startswith("# 3 televisions"))
        self.assertIn('connector: "HDMI-2"', text)
        # The scene that comes with the programs, as there is none beside the rig.
        self.assertIn(f'scene: "{ROOT}/config/scenes/reef.txtpb"', text)

    def test_it_never_writes_over_a_rig(self):
        self.rig.write_text("mine")
        self.refuses(r"school.txtpb is there already; choose another name", "--screen", "flat", "--windows")
        self.assertEqual(self.rig.read_text(), "mine")

    def test_what_makes_no_wall_is_refused_and_not_written(self):
        for said, options in ((r"these measures make no wall, and nothing is written: \S+:\d+:\d+: ",
                               ("--screen", "cylinder", "--count", 1, "--arc", 200, "--windows")),
                              (r"monitors are needed, this machine has .*--windows",
                               ("--screen", "flat", "--count", 3, "--monitors", "HDMI-1")),
                              (r"choose the kind of display", ())):
            self.refuses(said, *options)
        for said, options in ((r"--size.*12 is no size, as 1920x1080", ("--screen", "flat", "--size", "12")),
                              (r"--count", ("--screen", "flat", "--count", 17)),
                              (r"--arc", ("--screen", "cylinder", "--arc", "round")),
                              (r"--screen.*not in \{televisions,cylinder,flat\}", ("--screen", "sphere"))):
            self.refuses(said, *options, status=2)
        self.assertFalse(self.rig.exists())

    def test_it_asks_on_a_terminal_and_asks_again_after_a_bad_answer(self):
        status, said = self.talk([("appears on", "balloon"), ("appears on", "televisions"),
                                  ("left to right", "windows"), ("How many", "many"),
                                  ("How many", "3"), ("Diagonal", "55"), ("frame", ""), ("Angle", "95"),
                                  ("Angle", "50"), ("eye", "1.2")])
        self.assertEqual(status, 0, said)
        for fault in ("one of televisions, cylinder, flat, please", "a number from 1 to 16, please",
                      "a number from 0 to 90, please"):
            self.assertIn(fault, said)
        self.is_good()
        # As config/televisions_3.txtpb was measured.
        places = [float(x) for x in re.findall(r"position { x_m: (\S+)", self.rig.read_text())]
        self.assertEqual(len(places), 3)
        self.assertAlmostEqual(places[2], 1.0103, delta=0.01)

    def test_a_wall_of_projectors_is_asked_for_as_well(self):
        for kind, answers in (("cylinder", [("Radius", "2.62"), ("round", "120"), ("Height", "2.4384"), ("Throw", "2"),
                                            ("hang", "1.55")]),
                              ("flat",
                               [("Width", "9"), ("eye", "3.6"), ("Height", "2"), ("Throw", "1.2"), ("hang", "")])):
            status, said = self.talk([("appears on", kind), ("left to right", "DP-1 DP-2 DP-3"), *answers])
            self.assertEqual(status, 0, said)
            self.is_good()
            self.rig.unlink()


if __name__ == "__main__":
    unittest.main(verbosity=2)
