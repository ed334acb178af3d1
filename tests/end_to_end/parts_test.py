"""Real processes: works that are done in parts (--part) and merged are what one machine makes, byte for byte."""

import shutil
import unittest
from pathlib import Path

from show import ROOT, aquarama, rig_on_free_ports, temporary_folder

TANK = """name: "{name}"
place: OPEN_SEA
eye {{ x_m: 0 y_m: -6 z_m: 0 }}
water {{ centre {{ x_m: 0 y_m: -5.8 z_m: -5.5 }} half_extent {{ x_m: 3 y_m: 1.5 z_m: 2.5 }} clarity_m: 12 surface_c: 28
  celsius_per_metre: -0.15 }}
gathering: NONE
plankton: 5
cast {{ species: "{species}/bigeye_scad.txtpb" fish: {fish}
  start {{ centre {{ x_m: 0 y_m: -5.8 z_m: -5.5 }} radius_m: 1 }} }}
"""

SCENES = ["reef_1998", "study/school", "study/crowded_tank", "study/feeding", "study/alone"]
# The middle of the desk's wall, in a fifth of its size.
SMALL = [("width_px: 1350 height_px: 600", "width_px: 90 height_px: 120"), ("width_px: 480", "width_px: 96"),
         ("height_px: 360", "height_px: 72"), ("focal_x_px: 1113.6", "focal_x_px: 222.72"),
         ("focal_y_px: 652.1", "focal_y_px: 130.42"), ("principal_y_px: -12.34", "principal_y_px: -2.468"),
         (r"(?ms)^channels \{\n  id: [02].*?^\}\n", ""), ("arc_deg: 120", "arc_deg: 30")]


class Parts(unittest.TestCase):
    def setUp(self):
        self.temporary = temporary_folder()
        self.folder = Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def ran(self, *arguments, **options):
        run = aquarama(*arguments, **options)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return run.stdout

    def parts_of(self, out, count, *command, **options):
        """The files of all parts, the last first."""
        for number in range(count, 0, -1):
            self.ran(*command, "--part", f"{number}/{count}", **options)
        return [f"{out}.{number}-of-{count}.aqpart" for number in range(count, 0, -1)]

    def assert_refused(self, why, *arguments):
        run = aquarama(*arguments)
        self.assertEqual(run.returncode, 1, run.stdout)
        self.assertRegex(run.stderr, why)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)

    def test_capture(self):
        fresh = {"environment": {"XDG_CACHE_HOME": str(self.folder / "cache")}}
        command = ["capture", "--species", "bigeye_scad", "clownfish", "--out"]
        whole, made = self.folder / "whole", self.folder / "made"
        self.ran(*command, whole)
        for count in (1, 2, 3):
            files = self.parts_of(made, count, *command, made, **fresh)
            shutil.rmtree(made, ignore_errors=True)
            self.ran("merge", made, *files)
            names = sorted(path.name for path in whole.iterdir())
            self.assertEqual(names, ["bigeye_scad.aqrep", "clownfish.aqrep"])
            self.assertEqual(names, sorted(path.name for path in made.iterdir()))
            for name in names:
                self.assertEqual((whole / name).read_bytes(), (made / name).read_bytes())

    def test_study(self):
        config, whole, made = self.folder / "config", self.folder / "whole", self.folder / "made"
        (config / "scenes/study").mkdir(parents=True)
        (config / "species").symlink_to(ROOT / "config/species")
        for fish, name in enumerate(SCENES):
            (config / f"scenes/{name}.txtpb").write_text(
                TANK.format(name=name.split("/")[-1], species=ROOT / "config/species", fish=max(4 - fish, 1)))
        command = ["study", "--config", config, "--minutes", "0.1", "--seeds", "1", "--out"]
        tables = self.ran(*command, whole)
        for count in (1, 2, 3):
            files = self.parts_of(made, count, *command, made)
            self.assertEqual(self.ran("merge", made, *files), tables)
            self.assertEqual((whole / "adaptation.csv").read_bytes(), (made / "adaptation.csv").read_bytes())
        self.ran("study", "--config", config, "--minutes", "0.2", "--seeds", "1", "--out", self.folder / "other",
                 "--part", "3/3")
        others = [self.folder / "other.3-of-3.aqpart"]
        self.assert_refused("other.3-of-3.aqpart: was made of other inputs", "merge", made, *files[1:], *others)

    def test_search_and_what_is_no_whole(self):
        species = self.folder / "scad.txtpb"
        species.write_text((ROOT / "config/species/bigeye_scad.txtpb").read_text())
        command = ["search", species, "--trials", "1", "--starts", "3", "--out"]
        whole, made = self.folder / "whole.txtpb", self.folder / "made.txtpb"
        self.ran(*command, whole)
        for count in (1, 2, 3):
            for journal in self.folder.glob("made*journal"):
                journal.unlink()
            files = self.parts_of(made, count, *command, made)
            self.ran("merge", made, *files)
            self.assertEqual(whole.read_bytes(), made.read_bytes())
        self.assert_refused("part 1 of 3 is missing", "merge", made, *files[:2])
        self.assert_refused("is the same part as", "merge", made, *files, files[0])
        self.assert_refused("scad.txtpb: is no part of a work", "merge", made, *files, species)
        Path(files[1]).write_bytes(Path(files[1]).read_bytes()[:-1])
        self.assert_refused("2-of-3.aqpart: is damaged or cut off", "merge", made, *files)
        empty = self.folder / "empty"
        self.ran("capture", "--species", "bigeye_scad", "--out", empty, "--part", "2/2")
        self.assert_refused("empty.2-of-2.aqpart: is part 2 of 2 of a capture", "merge", made, files[0],
                            f"{empty}.2-of-2.aqpart")
        wrong = aquarama(*command, made, "--part", "4/3")
        self.assertEqual(wrong.returncode, 2)
        self.assertRegex(wrong.stderr, 'K/N, such as 2/5')

    def test_clip(self):
        scene = self.folder / "tank.txtpb"
        scene.write_text(TANK.format(name="tank", species=ROOT / "config/species", fish=3))
        rig = rig_on_free_ports(self.folder, replace=[*SMALL, ('scene: ".*"', f'scene: "{scene}"')])
        recording, whole, made = (self.folder / name for name in ("show.aqrec", "whole.mp4", "made.mp4"))
        self.ran("run", rig, "--headless", "--pattern", "grey", "--frames", 61, "--record", recording)
        command = ["replay", recording, "--rig", rig, "--headless", "--quality", "low", "--clip"]
        self.assert_refused("choose one by --quality", *(word for word in command if word not in ("--quality", "low")),
                            made, "--part", "1/2")
        self.ran(*command, whole)
        for count in (1, 2, 3):
            files = self.parts_of(made, count, *command, made)
            self.ran("merge", made, *files)
            self.assertEqual(whole.read_bytes(), made.read_bytes(), f"{count} parts")
        self.assertFalse(Path(f"{made}.3-of-3.mp4").exists())  # the film has two pieces
        clip = Path(f"{made}.2-of-3.mp4")
        clip.write_bytes(clip.read_bytes()[:-1])
        self.assert_refused("made.mp4.2-of-3.mp4: is not the clip", "merge", made, *files)
        rig.write_text(rig.read_text() + "# another\n")
        self.ran(*command, made, "--part", "2/3")
        self.assert_refused("was made of other inputs", "merge", made, *files)


if __name__ == "__main__":
    unittest.main(verbosity=2)
