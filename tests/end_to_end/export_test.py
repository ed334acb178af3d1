"""What `aquarama export` and `aquarama inspect` write, read by programs of others, and what they refuse."""

import csv
import json
import struct
import sys
import unittest
from pathlib import Path

from show import ROOT, aquarama, temporary_folder

sys.path.insert(0, str(ROOT / "build/tools"))  # see tests/support/get_tools.sh
try:
    import ezc3d
except ImportError:
    ezc3d = None
try:
    import c3d
except ImportError:
    c3d = None

NO_READER = "is not here: tests/support/get_tools.sh gets it, with pip and a network"
SEGMENTS = ["forward_slow", "forward_medium", "forward_fast", "turn_left_gradual", "turn_left_sharp",
            "turn_right_gradual", "turn_right_sharp"]


class Export(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = temporary_folder()
        cls.folder = Path(cls.temporary.name)
        captured = aquarama("capture", "--species", "bigeye_scad", "--out", cls.folder)
        assert captured.returncode == 0, captured.stderr
        cls.repertoire = cls.folder / "bigeye_scad.aqrep"

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def export(self, kind, name, segment, cycles=1, *more):
        path = self.folder / name
        run = aquarama("export", self.repertoire, "--segment", segment, "--cycles", cycles, f"--{kind}", path, *more)
        self.assertEqual(run.returncode, 0, run.stderr)
        return path

    def table(self, segment, cycles):
        """Frames of nodes of (x, y, z), from the CSV."""
        rows = list(csv.reader(self.export("csv", "table.csv", segment, cycles).read_text().splitlines()))
        numbers = [[float(cell) for cell in row[1:]] for row in rows[1:]]
        return [[row[i:i + 3] for i in range(0, len(row), 3)] for row in numbers]

    def assert_same(self, table, point):
        for frame, nodes in enumerate(table):
            for node, xyz in enumerate(nodes):
                for axis in range(3):
                    self.assertAlmostEqual(point(frame, node, axis), xyz[axis], delta=1e-6)

    @unittest.skipUnless(ezc3d, f"ezc3d {NO_READER}")
    def test_ezc3d_reads_the_markers(self):
        for segment in SEGMENTS:
            file = ezc3d.c3d(str(self.export("c3d", "take.c3d", segment, 3)))
            table = self.table(segment, 3)
            points = file["data"]["points"]
            self.assertEqual(points.shape, (4, 23, len(table)))
            self.assert_same(table, lambda frame, node, axis: points[axis, node, frame])
            parameters = file["parameters"]["POINT"]
            self.assertEqual(parameters["UNITS"]["value"], ["m"])
            self.assertEqual(parameters["RATE"]["value"][0], 60)
            self.assertEqual(parameters["LABELS"]["value"][::22], ["NOSE", "TAIL_V"])

    @unittest.skipUnless(c3d, f"c3d {NO_READER}")
    def test_c3d_reads_the_markers(self):
        for segment in SEGMENTS:
            with self.export("c3d", "take.c3d", segment, 3).open("rb") as stream:
                reader = c3d.Reader(stream)
                frames = [points for _, points, _ in reader.read_frames()]
                self.assertEqual(reader.point_rate, 60)
            table = self.table(segment, 3)
            self.assertEqual(len(frames), len(table))
            self.assert_same(table, lambda frame, node, axis: frames[frame][node][axis])

    def test_a_report_that_cannot_be_written_is_an_error(self):
        blocked = self.folder / "not-a-folder"
        blocked.write_text("")
        run = aquarama("inspect", self.repertoire, "--report", blocked)
        self.assertEqual(run.returncode, 1)
        self.assertIn(str(blocked), run.stderr)
        self.assertEqual(aquarama("inspect", self.repertoire, "--reprot", blocked).returncode, 2)

    def test_a_glb_is_as_long_as_it_says_and_holds_json(self):
        content = self.export("gltf", "fish.glb", "forward_medium", 2).read_bytes()
        magic, version, length = struct.unpack_from("<4sII", content)
        self.assertEqual((magic, version, length), (b"glTF", 2, len(content)))
        size, kind = struct.unpack_from("<I4s", content, 12)
        self.assertEqual(kind, b"JSON")
        model = json.loads(content[20:20 + size])
        self.assertEqual(model, model | {"asset": {"version": "2.0", "generator": "Aquarama"}})

    def test_what_is_asked_wrongly_is_refused_with_2_and_the_choices(self):
        wrong = {("--segment", "fly", "--csv", "a"): "forward_slow.*turn_right_sharp",
                 ("--csv", "a"): "--segment is required",
                 ("--segment", "forward_slow"): "--c3d.*--gltf|--c3d.*--csv",
                 ("--segment", "forward_slow", "--csv", "a", "--c3d", "b"): "xactly 1",
                 ("--segment", "forward_slow", "--csv", "a", "--cycles", "0"): "1 to 1000",
                 ("--segment", "forward_slow", "--csv", "a", "--cycles", "-3"): "1 to 1000",
                 ("--segment", "forward_slow", "--csv", "a", "--cycles", "1000000000000"): "--cycles",
                 ("--segment", "forward_slow", "--csv", "a", "--cycles", "many"): "--cycles"}
        for arguments, expected in wrong.items():
            run = aquarama("export", self.repertoire, *arguments)
            self.assertEqual(run.returncode, 2, arguments)
            self.assertRegex(run.stderr, expected)

    def test_what_fails_ends_with_1_and_names_the_file(self):
        blocked = self.folder / "file"
        blocked.write_text("")
        fails = {(self.folder / "none.aqrep", "--csv", self.folder / "a"): r"none\.aqrep",
                 (blocked, "--csv", self.folder / "a"): "file",
                 (self.repertoire, "--csv", blocked / "a.csv"): r"a\.csv",
                 (self.repertoire, "--c3d", self.folder): str(self.folder),
                 (self.repertoire, "--gltf", self.folder / "a.obj"): r"a\.obj.*\.glb",
                 (self.repertoire, "--gltf", self.folder / "a.glb", "--config", self.folder): "bigeye_scad"}
        for (file, *arguments), expected in fails.items():
            run = aquarama("export", file, "--segment", "forward_slow", *arguments)
            self.assertEqual(run.returncode, 1, arguments)
            self.assertRegex(run.stderr, expected)
        self.assertEqual(list(self.folder.glob("*.part")), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
