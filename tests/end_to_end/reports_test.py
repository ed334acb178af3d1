"""Figures and pages of the reports: what each command writes, alike each time, and what it says without Matplotlib."""

import os
import subprocess
import sys
import unittest
import xml.etree.ElementTree
from pathlib import Path

from show import ROOT, aquarama, temporary_folder

SEGMENTS = ["forward_slow", "forward_medium", "forward_fast",
            *(f"curve_{side}_{width}_{gait}" for side in ["left", "right"] for width in ["wide", "tight"]
              for gait in ["slow", "medium", "fast"]),
            "turn_left_gradual", "turn_left_sharp", "turn_right_gradual", "turn_right_sharp"]
PICTURES = ["body", "speed", "strouhal", "turns", "headings", *SEGMENTS, *(f"midlines_{gait}" for gait in SEGMENTS[:3])]
REEF = ROOT / "config/scenes/reef.txtpb"
THEATRE = ROOT / "config/theatre.txtpb"


def drawn(script, *arguments):
    """What a script prints."""
    for python in [sys.executable, "/usr/bin/python3"]:
        if subprocess.run([python, "-c", "import matplotlib, scipy"], capture_output=True).returncode == 0:
            run = subprocess.run([python, ROOT / script, *arguments], check=True, capture_output=True, text=True)
            return run.stdout
    raise unittest.SkipTest("no Python with Matplotlib and SciPy")


class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = temporary_folder()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)

    def written(self, folder, *arguments):
        """The files that a command writes into a new folder and what it prints."""
        run = aquarama(*arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        return {path.name: path for path in (self.folder / folder).iterdir()}, run.stdout

    def assert_picture(self, path):
        """A whole file of SVG, some centimetres wide and with something drawn in it."""
        root = xml.etree.ElementTree.parse(path).getroot()
        self.assertEqual(root.tag, "{http://www.w3.org/2000/svg}svg")
        for side in ["width", "height"]:
            self.assertGreater(float(root.get(side).removesuffix("pt")), 90, path)
        self.assertGreater(sum(1 for _ in root.iter("{http://www.w3.org/2000/svg}path")), 20, path)
        self.assertGreater(path.stat().st_size, 10_000, path)
        self.assertNotIn("nan", path.read_text())

    def assert_page(self, path, pictures):
        """One page with all its pictures inside."""
        page = path.read_text()
        for picture in pictures:
            self.assertIn(f'<figure id="{picture}">', page)
        self.assertEqual(page.count("src="), page.count('src="data:image/svg+xml;base64,'))
        self.assertEqual(page.count("src="), len(pictures))
        self.assertNotIn(">nan<", page)


class Reports(Case):
    def test_a_repertoire(self):
        files, said = self.written("a", "capture", "--species", "bigeye_scad", "--out", self.folder,
                                   "--report", self.folder / "a")
        pictures = [f"bigeye_scad_{name}" for name in PICTURES]
        self.assertEqual(set(files), {"bigeye_scad.json", "bigeye_scad.html", *(f"{name}.svg" for name in pictures)})
        for name in pictures:
            self.assert_picture(files[f"{name}.svg"])
        self.assert_page(files["bigeye_scad.html"], pictures)
        self.assertIn(str(files["bigeye_scad.html"]), said)
        # From the file alone, which is told by its first bytes, the same bytes.
        alone = self.folder / "elsewhere.file"
        (self.folder / "bigeye_scad.aqrep").rename(alone)
        again, said = self.written("b", "inspect", "--report", self.folder / "b", alone)
        self.assertIn(str(again["bigeye_scad.html"]), said)
        for segment in SEGMENTS:
            self.assertIn(segment, said)
        for name, path in files.items():
            self.assertEqual(again[name].read_bytes(), path.read_bytes(), name)

    def test_the_controllers(self):
        files, said = self.written("controllers", "controllers", "--out", self.folder / "controllers")
        self.assertEqual(set(files), {"controllers.json", "controllers.svg"})
        self.assert_picture(files["controllers.svg"])
        self.assertIn(str(files["controllers.svg"]), said)

    def test_the_forms(self):
        files, said = self.written("forms", "forms", "--species", "bigeye_scad", "--out", self.folder / "forms")
        self.assertEqual(set(files), {"forms.json", "forms.svg"})
        self.assert_picture(files["forms.svg"])
        self.assertEqual(said.count("| **bigeye scad** | carangiform, slow | tail 2.00 |"), 1)
        self.assertEqual(said.count("| *saithe, mackerel* | living |"), 1)
        self.assertIn(str(files["forms.svg"]), said)

    def test_the_fidelity(self):
        folder = self.folder / "fidelity"
        files, said = self.written("fidelity", "fidelity", "--species", "bigeye_scad", "--seconds", 5, "--out", folder)
        pictures = [f"fidelity_{name}" for name in ["segments", "ways_bigeye_scad", "times_bigeye_scad"]]
        self.assertEqual(set(files), {
            "fidelity.html", "fidelity.csv", "fidelity_summaries.csv", "fidelity_ticks.csv",
            "fidelity_vocabularies.csv", "fidelity_ways.svg", *(f"{name}.svg" for name in pictures)})
        for name in ["fidelity_ways", *pictures]:
            self.assert_picture(files[f"{name}.svg"])
        self.assert_page(files["fidelity.html"], pictures)
        self.assertIn("<h2>bigeye_scad</h2>", files["fidelity.html"].read_text())
        self.assertEqual(said.count("| bigeye_scad |"), 1)
        self.assertEqual(said.count("| forward_medium |"), 1)

    def test_the_study(self):
        files, said = self.written("study", "study", "--minutes", 0.1, "--seeds", 2, "--out", self.folder / "study")
        self.assertEqual(set(files), {"adaptation.csv", "adaptation.svg"})
        self.assert_picture(files["adaptation.svg"])
        for scenario in ["reef_1998", "school", "crowded tank", "feeding"]:
            self.assertEqual(said.count(f"### {scenario}\n"), 1)
        self.assertEqual(said.count("| overlaps that begin, a fish and minute |"), 4)
        self.assertRegex(said, r"\n### alone: pursuit for each particle eaten, s\n\n.*\n.*\n\| bigeye_scad \|")
        self.assertRegex(said, r"\nmotor \d+, minds \d+\n")

    def test_the_chronicle(self):
        (self.folder / "temporary").mkdir()
        run = aquarama("study", "chronicle", REEF, "--hours", 0.01,
                       environment={"TMPDIR": str(self.folder / "temporary")})
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stdout.count("\n|---|"), 3, "overlaps by species and by routine, motion; no hour is over")
        self.assertRegex(run.stdout, r"\nlowest captured: heading \d+\.\d %, pitch \d+\.\d %, way \d+\.\d %\n")
        self.assertIn("\nhash of the world: ", run.stdout)
        self.assertEqual(list((self.folder / "temporary").iterdir()), [], "nobody asked for the data")
        files, said = self.written("c", "study", "chronicle", REEF, "--hours", 0.01, "--out", self.folder / "c")
        self.assertEqual(set(files), {"hours.csv", "overlaps.csv"})
        self.assertEqual(said, run.stdout)
        self.assertRegex(said, r"\n\| bigeye_scad, bigeye_scad \| [\d.]+ \|")
        # An hour takes minutes: one that is made up.
        with open(files["hours.csv"], "a", encoding="utf-8") as hours:
            hours.write(",".join(str(i) for i in range(31)) + "\n")
        tables = drawn("master/study/draw_study.py", "chronicle", self.folder / "c", "1")
        self.assertEqual(tables.count("\n|---|"), 3)
        self.assertIn("| 0 | 1 | 2 | 3 | 4 | 5 | " + " / ".join(f"{100 * i}.0" for i in range(6, 21)) +
                      " | 21.0 | 22.000 | 23.00 | 24 | 25 | 26 (27) | 28.00 | 29.00 | 30 |", tables)


    def test_what_a_visitor_sees(self):
        files, said = self.written("wall", "study", "wall", THEATRE, "--hours", 0.02, "--out", self.folder / "wall")
        self.assertEqual(set(files), {"seconds.csv", "measures.csv", "events.csv", "species.csv", "wall.svg"})
        self.assert_picture(files["wall.svg"])
        self.assertRegex(said, r"\Awall: cells \d+ %, thirds \d+ \d+ \d+ %, all \d+ %, gap \d+ s, "
                               r"largest school \d+ %, species \d+, events \d+\.\d a minute\n"
                               r"seen from the eye at rest\n"
                               r"path of the school: highest peak \d\.\d\d after \d+ s, the first nearly as high "
                               r"after \d+ s\n\n\| ")
        self.assertIn("| time, s | 72 | – | – | – |", said)
        self.assertRegex(said, r"\n\| bigeye_scad \| 51 \| day \| \d\.\d / \d\.\d \| \d\.\d\d / \d\.\d\d \| 0\.0 / ")
        self.assertRegex(said, r"\n\| blacktip_reef_shark \| swimming \| swims \| \d+ \| 100 \|\n")
        self.assertRegex(said, r"\nmotor \d+, minds \d+\n")
        # Without a folder the same is printed; with the tour the submarine, and so the view, moves.
        again = aquarama("study", "wall", THEATRE, "--hours", 0.02)
        self.assertEqual(again.stdout, said)
        toured = aquarama("study", "wall", THEATRE, "--hours", 0.02, "--tour").stdout
        self.assertIn("\nseen from the submarine on its tour\n", toured)
        self.assertNotEqual(toured.replace("submarine on its tour", "eye at rest"), said)
        empty = aquarama("study", "wall", THEATRE, "--scene", ROOT / "config/scenes/empty_sea.txtpb")
        self.assertEqual(empty.returncode, 1)
        self.assertRegex(empty.stderr, r"\Aaquarama study wall: .*empty_sea.*has no fish to see.*\n\Z")


class Statistics(Case):
    def test_differences_are_taken_seed_by_seed(self):
        """What seeds have in common falls out; bold is what differs beyond chance."""
        quantities = {"polarisation": ([0, 100, 200], [1, 101.1, 201.2]),  # 1.1 ± 0.06 less without
                      "rotation": ([0, 100, 200], [2, 99, 201]),
                      "meals_per_try": (["", "", ""], ["", "", 7]),
                      "catches_per_rush": (["", "", ""], ["", "", ""])}
        names = (ROOT / "master/study/quantities.cpp").read_text().split("kKeys{")[1].split("}")[0].replace('"', "")
        keys = [key.strip() for key in names.split(",") if key.strip()]
        self.assertEqual(len(keys), 16)
        lines = ["scenario,condition,seed," + ",".join(keys)]
        for place, condition in [(1, "all"), (0, "late pursuit")]:
            for seed in range(3):
                values = [str(quantities[key][place][seed]) if key in quantities else "0" for key in keys]
                lines.append(f"reef,{condition},{seed + 1}," + ",".join(values))
        (self.folder / "adaptation.csv").write_text("\n".join(lines) + "\n")
        tables = drawn("master/study/draw_study.py", "adaptation", self.folder, "")
        self.assertIn("| polarisation | 101.10 ± 57.79 | **100.00 ± 57.74** |", tables)
        self.assertIn("| rotation | 100.67 ± 57.45 | 100.00 ± 57.74 |", tables)
        self.assertIn("| particles eaten a target gone for | 7.000 ± 0.000 | – |", tables)
        self.assertNotIn("prey caught a rush", tables)


class WithoutMatplotlib(Case):
    def fake_python(self):
        fake = self.folder / "bin/python3"
        fake.parent.mkdir(exist_ok=True)
        fake.write_text("#!/bin/sh\necho ModuleNotFoundError >&2\nexit 1\n")
        fake.chmod(0o755)
        return fake

    def test_every_report_is_refused_in_one_line_before_anything_is_simulated(self):
        out = self.folder / "out"
        for command, arguments in [("capture", ["--out", out, "--report", out]),
                                   ("inspect", ["a.aqrep", "--report", out]),
                                   ("controllers", ["--out", out]), ("fidelity", ["--out", out]),
                                   ("forms", ["--out", out]),
                                   ("study", ["--out", out]), ("study", []), ("study chronicle", [REEF]),
                                   ("study wall", [THEATRE])]:
            for python in [self.fake_python(), self.folder / "none"]:
                with self.subTest(command, python=python):
                    run = aquarama(*command.split(), *arguments, environment={"AQUARAMA_PYTHON": str(python)},
                                   timeout=10)
                    self.assertEqual(run.returncode, 1)
                    self.assertRegex(run.stderr, rf"\Aaquarama {command}: .*install .*python3-matplotlib.*\n\Z")
                    self.assertEqual(run.stdout, "")
                    self.assertEqual(list(out.glob("*")), [])

    def test_the_python_of_the_system_serves_where_the_first_of_the_path_has_none(self):
        path = f"{self.fake_python().parent}:{os.environ['PATH']}"
        run = aquarama("study", "chronicle", REEF, "--hours", 0.01, environment={"PATH": path})
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_what_draws_nothing_does_without(self):
        run = aquarama("capture", "--species", "bigeye_scad", "--out", self.folder,
                       environment={"AQUARAMA_PYTHON": str(self.fake_python())})
        self.assertEqual(run.returncode, 0, run.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
