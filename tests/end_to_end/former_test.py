"""Files of the version before are read, or refused by name with what to do; those of a later one are refused by their
version. And the repertoires and recordings of this version are read from Python (docs/files.md)."""

import csv
import json
import lzma
import math
import re
import shutil
import subprocess
import unittest
import zipfile
from pathlib import Path

from show import ROOT, aquarama, control_address, end, rig_on_free_ports, start, temporary_folder, wait_until

FORMER = ROOT / "tests/former/0.1"
READER = ROOT / "docs/examples/read_files.py"
CLOWNFISH = ROOT / "config/species/clownfish.txtpb"
EARLIER = (r"version 1 of a species is of an earlier release; this one reads version 2: docs/species.md says what has "
           r"changed\n")


def python_with_numpy():
    """The first Python of this machine that has it."""
    for python in ("python3", "/usr/bin/python3"):
        if subprocess.run([python, "-c", "import numpy"], capture_output=True).returncode == 0:
            return python
    raise unittest.SkipTest("no Python with numpy (python3-numpy)")


class Case(unittest.TestCase):
    def setUp(self):
        self.temporary = temporary_folder()
        self.folder = Path(self.temporary.name)
        shutil.copytree(FORMER, self.folder / "files")
        self.files = self.folder / "files"
        self.recording = self.files / "sea.aqrec"
        self.recording.write_bytes(lzma.decompress((FORMER / "sea.aqrec.xz").read_bytes()))
        content = self.recording.read_bytes()
        begin = content.index(b"AQREP")
        self.repertoire = self.files / "clownfish.aqrep"
        self.repertoire.write_bytes(content[begin:begin + int.from_bytes(content[begin + 7:begin + 11], "little")])

    def tearDown(self):
        self.temporary.cleanup()

    def refused(self, said, *arguments, stdout=""):
        """By one line at the end, behind lines on standard output that match."""
        done = aquarama(*arguments)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, rf"\A{stdout}\Z")
        self.assertRegex(done.stderr, said)
        self.assertEqual(done.stderr.count("\n"), 1)


class Former(Case):
    def succeed(self, *checks):
        for said, arguments in checks:
            with self.subTest(arguments[1].name):
                done = aquarama(*arguments)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(said, done.stdout)

    def test_what_the_version_before_has_written_is_read(self):
        self.succeed(("written by   0.1.0", ("inspect", self.recording)),
                     ("middle: 48 x 36 pixels, warp, blend",
                      ("convert", self.files / "desk.mpcdi", self.folder / "again.mpcdi")))

    def test_a_species_is_refused_with_where_its_changes_are_told(self):
        species = self.files / "species/clownfish.txtpb"
        refused = rf"/species/clownfish.txtpb:1:1: {EARLIER}"
        self.refused(refused, "inspect", species)
        self.refused(refused, "inspect", self.files / "scenes/sea.txtpb")
        self.refused(refused, "check", self.files / "desk.txtpb", stdout=r"(\w+: lights .*\n){3}")
        self.refused(refused, "capture", "--species", species, "--out", self.folder)

    def test_a_rig_and_a_scene_are_read_with_a_species_of_this_version(self):
        shutil.copy(CLOWNFISH, self.files / "species")
        self.succeed(("good", ("check", self.files / "desk.txtpb")),
                     ("3 clownfish", ("inspect", self.files / "scenes/sea.txtpb")))

    def test_a_repertoire_is_refused_with_what_to_do(self):
        self.refused(r"clownfish.aqrep: repertoire is of version 5, this program reads version 6; capture the species "
                     r"again", "inspect", self.repertoire)

    def test_a_recording_is_not_replayed(self):
        self.refused(rf"sea.aqrec: its clownfish.txtpb:1:1: {EARLIER}", "replay", self.recording, "--check",
                     stdout=r"(\S+/sea.aqrec: it was written .*\n){2}")

    def test_a_rig_that_counts_monitors_is_refused_with_what_to_write(self):
        self.refused(
            r'theatre.txtpb:62:\d+: monitor: 0 counts monitors.*name the connector, as connector: "HDMI-1"; this '
            r'machine has ',
                     "check", self.files / "theatre.txtpb")

    def test_a_later_version_is_refused_by_its_number(self):
        for kind, name in (("rig", "desk.txtpb"), ("scene", "scenes/sea.txtpb"),
                           ("species", "species/clownfish.txtpb")):
            path = self.files / name
            path.write_text("version: 9\nunheard_of { of: 1 }\n" + path.read_text())
            self.refused(
                rf"{path.name}:1:\d+: version 9 of a {kind} is of a later release; this one reads up to version \d: "
                rf"update", "inspect", path)
        content = bytearray(self.repertoire.read_bytes())
        content[5] = 7
        self.repertoire.write_bytes(content)
        self.refused(r"is of version 7, written by a newer Aquarama; update this one", "inspect", self.repertoire)
        content = self.recording.read_bytes()
        self.recording.write_bytes(content.replace(b"AQREC\x10\x02", b"AQREC\x10\x04", 1))
        self.refused(r"is a recording of version 4, written by 0.1.0; this program reads version 3: use the program",
                     "inspect", self.recording)
        wall, later = self.files / "desk.mpcdi", self.folder / "later.mpcdi"
        with zipfile.ZipFile(wall) as old, zipfile.ZipFile(later, "w") as new:
            for name in old.namelist():
                text = old.read(name)
                new.writestr(name, re.sub(rb'(<MPCDI[^>]*version=")2', rb"\g<1>3", text) if name.endswith(".xml")
                             else text)
        self.refused(r'is of version "3.0", not 1 or 2', "convert", later, self.folder / "again.mpcdi")


class FromPython(Case):
    @classmethod
    def setUpClass(cls):
        cls.captures = temporary_folder()
        cls.captured = Path(cls.captures.name) / "clownfish.aqrep"
        done = aquarama("capture", "--species", CLOWNFISH, "--out", cls.captures.name)
        assert done.returncode == 0, done.stderr
        cls.version = aquarama("--version").stdout.split()[1]
        cls.record()

    @classmethod
    def record(cls):
        """Recorded by this version: a master that shows the scene to no node, until it is ended."""
        folder = Path(cls.captures.name)
        shutil.copytree(FORMER / "scenes", folder / "scenes")
        (folder / "species").mkdir()
        shutil.copy(CLOWNFISH, folder / "species")
        rig, cls.show = rig_on_free_ports(folder), folder / "show.aqrec"
        master = start("master", rig, "--scene", folder / "scenes/sea.txtpb", "--record", cls.show)
        try:
            wait_until(lambda: aquarama("explain", "--fish", 0, "--master", control_address(rig)).returncode == 0, 60,
                       "an answer")
        finally:
            end([master])
        assert master.returncode == 0, master.returncode

    @classmethod
    def tearDownClass(cls):
        cls.captures.cleanup()

    def read(self, script):
        """What a script that has the reader prints, as JSON."""
        head = f"import sys, json\nsys.path.insert(0, {str(READER.parent)!r})\nfrom read_files import *\n"
        done = subprocess.run([python_with_numpy(), "-B", "-c", head + script], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_a_repertoire_is_what_the_programs_say_it_is(self):
        inspected = aquarama("inspect", self.captured).stdout
        said = {row[0]: [float(number) for number in row[1:4]]
                for row in re.findall(r"^ +(forward_\w+) +(\S+) +(\S+) +(\S+)", inspected, re.MULTILINE)}
        found = self.read(f"""
repertoire = read_repertoire({str(self.captured)!r})
def figures(segment):
    stride = float(np.linalg.norm(path_of(segment["increments"])[-1]))
    return [segment["period_s"], stride / segment["period_s"], stride]
segments = repertoire["segments"]
print(json.dumps({{"species": repertoire["species"], "length": repertoire["length_m"], "names": list(segments),
                  "figures": {{name: figures(segments[name]) for name in segments if name.startswith("forward")}},
                  "nodes": (repertoire["length_m"] * segments["forward_slow"]["nodes"][0]).tolist(),
                  "fins": [np.degrees(segments[name]["fins"]).tolist() for name in ("forward_slow", "forward_fast")],
                  "entries": [segments[name]["entered"].shape for name in ("turn_left_sharp", "start_left_large")]}}))
""")
        self.assertEqual(found["species"], "clownfish")
        self.assertEqual(found["names"], re.findall(r"^  (\w+) +0\.", inspected, re.MULTILINE))
        self.assertEqual(set(said), set(found["figures"]))
        for name, figures in said.items():
            for one, other in zip(figures, found["figures"][name]):
                self.assertAlmostEqual(one, other, delta=6e-4)
        self.assertEqual(found["entries"], [[40, 64, 7], [17, 64, 7]])
        self.assert_row(*found["fins"])
        table = self.folder / "slow.csv"
        self.assertEqual(aquarama("export", self.captured, "--segment", "forward_slow", "--csv", table).returncode, 0)
        with open(table) as rows:
            first = list(csv.reader(rows))[1][1:]
        exported = [tuple(map(float, first[i:i + 3])) for i in range(0, len(first), 3)]
        self.assertEqual(len(exported), 23)
        # The export turns the fish to swim along x: what lies between its points stays.
        for one, other in zip(exported, found["nodes"]):
            for one_more, another in zip(exported, found["nodes"]):
                self.assertAlmostEqual(math.dist(one, one_more), math.dist(other, another), delta=1e-6)

    def assert_row(self, slow, fast):
        """Both fins row as the species file says, from their rest; at the fast gait they lie still on the flank."""
        text = CLOWNFISH.read_text()
        stroke, feather, opened, rest = (float(re.search(pattern, text)[1]) for pattern in (
            r"stroke_deg: (\S+)", r"feather_deg: (\S+)", r"open_deg: (\S+)", r"(?s)pectoral \{.*?angle_deg: (\S+)"))
        for side in (0, 1):
            opening, carried, twisted = ([pose[side][angle] for pose in slow] for angle in range(3))
            for angles, least, most in (opening, opened - rest, opened - rest), (carried, -stroke, stroke):
                self.assertAlmostEqual(min(angles), least, delta=0.5)
                self.assertAlmostEqual(max(angles), most, delta=0.5)
            # Its middle and its drive are trimmed so that the fish rows level.
            self.assertAlmostEqual(max(twisted) - min(twisted), 2 * feather, delta=0.1 * 2 * feather)
        folded = fast[0][0]
        self.assertTrue(folded[0] < 0 and folded[1:] == [0, 0], folded)
        self.assertTrue(all(fin == folded for pose in fast for fin in pose))

    def test_a_recording_is_what_the_programs_say_it_is(self):
        found = self.read(f"""
recording = read_recording({str(self.show)!r})
repertoire = recording["species"][0]["repertoire"]
print(json.dumps({{"build": recording["build"], "whole": recording["is_whole"], "hashes": recording["hashes"],
                  "species": [(one["fish"], read_repertoire(one["repertoire"])["species"])
                              for one in recording["species"]],
                  "same": repertoire == open({str(self.captured)!r}, "rb").read()}}))
""")
        self.assertEqual((found["build"], found["whole"], found["same"]), (self.version, True, True))
        self.assertEqual(found["species"], [[3, "clownfish"]])
        replayed = aquarama("replay", self.show, "--check").stdout
        self.assertIn(f"{found['hashes'][-1][1]:016x}", replayed)

    def test_a_recording_of_the_version_before_is_read_but_for_its_repertoire(self):
        found = self.read(f"""
recording = read_recording({str(self.recording)!r})
cut = read_recording(open({str(self.recording)!r}, "rb").read()[:-5])
species = [one["fish"] for one in recording["species"]]
try:
    refused = read_repertoire(recording["species"][0]["repertoire"])
except ValueError as problem:
    refused = str(problem)
print(json.dumps({{"build": recording["build"], "whole": recording["is_whole"], "species": species,
                  "refused": refused, "inputs": [input[:2] for input in recording["inputs"]],
                  "steering": recording["inputs"][9][2], "hashes": recording["hashes"],
                  "cut": [cut[name] for name in ("is_whole", "seed")]}}))
""")
        self.assertEqual((found["build"], found["whole"], len(found["inputs"])), ("0.1.0", True, 99))
        self.assertEqual(found["species"], [3])
        self.assertEqual(found["refused"], "a repertoire of version 5; this reader knows version 6")
        self.assertEqual(found["inputs"][9], [223, "steering"])
        self.assertEqual(found["steering"], {"ahead": 31, "aside": 31, "up": 0, "turn": 0, "tilt": -31})
        self.assertEqual([tick for tick, _ in found["hashes"]], [0, 600, 763])
        self.assertEqual(found["cut"], [False, 1])

    def test_the_script_says_what_a_file_holds_and_refuses_what_it_cannot_read(self):
        python = python_with_numpy()
        for path, said in ((self.captured, "repertoire of clownfish, recorded at 0.085 m"),
                           (self.show, f"recording by {self.version}, seed 1, whole")):
            done = subprocess.run([python, "-B", READER, path], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout.splitlines()[0]), (0, said))
        spoilt = self.folder / "spoilt.aqrep"
        content = self.captured.read_bytes()
        for bad, said in ((content[:-1], "altered or cut off"), (content[:5] + b"\x07" + content[6:], "of version 7"),
                          (self.repertoire.read_bytes(), "of version 5"), (b"", "no recording")):
            spoilt.write_bytes(bad)
            done = subprocess.run([python, "-B", READER, spoilt], capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertIn(said, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
