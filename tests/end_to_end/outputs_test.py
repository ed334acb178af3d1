"""What the programs write, at each kind of place: one rule for all, and one line and status 1 where it cannot be."""

import os
import resource
import shutil
import signal
import stat
import struct
import subprocess
import threading
import unittest
import unittest.mock
from pathlib import Path

from show import BIN, EMPTY_SEA, ROOT, aquarama, children_of, rig_on_free_ports, start, temporary_folder, wait_until

NOBODY = 65534
FULL_AFTER = 300  # bytes: less than any file of these


def as_nobody():
    """Root may write anywhere."""
    if os.geteuid() == 0:
        os.setgroups([])
        os.setgid(NOBODY)
        os.setuid(NOBODY)


def require_nobody(test):
    """Skips where only root may read the programs, but not where the whole set of tests is expected to run."""
    try:
        subprocess.run([BIN / "aquarama", "--version"], stdout=subprocess.DEVNULL, preexec_fn=as_nobody, check=True)
    except PermissionError:
        if "CI" in os.environ:
            raise
        test.skipTest("the programs lie where only root may read them")


def on_a_full_disk():
    resource.setrlimit(resource.RLIMIT_FSIZE, (FULL_AFTER, FULL_AFTER))


class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = temporary_folder()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        cls.folder.chmod(0o777)

    def fresh(self, name):
        """An empty folder that everybody may write."""
        folder = self.folder / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        folder.chmod(0o777)
        return folder

    def said_in_one_line(self, run, *words):
        """Nothing but what, where, why and what to do."""
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertRegex(run.stderr, r"\Aaquarama[\w -]*: .*cannot be written \(.*\); \w+")
        for word in words:
            self.assertIn(str(word), run.stderr)


class Files(Case):
    """Each command that writes a file, at each kind of place."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        captured = aquarama("capture", "--species", "bigeye_scad", "--out", cls.folder)
        assert captured.returncode == 0, captured.stderr
        cls.rig = rig_on_free_ports(cls.folder)
        cls.keyed = cls.folder / "keyed.txtpb"
        cls.keyed.write_text(cls.rig.read_text().replace("tcp://127.0.0.1", "tcp://10.0.0.1"))
        assert aquarama("keys", "new", cls.keyed, "--keys", cls.folder / "keys").returncode == 0
        for path in [cls.folder / "keys", *(cls.folder / "keys").iterdir()]:
            if os.geteuid() == 0:
                os.chown(path, NOBODY, NOBODY)
        export = ["export", cls.folder / "bigeye_scad.aqrep", "--segment", "forward_slow"]
        # By the name of the file: the command but for its last argument, and whether it replaces a file.
        cls.commands = {
            "a.csv": ([*export, "--csv"], True),
            "a.c3d": ([*export, "--c3d"], True),
            "a.glb": ([*export, "--gltf"], True),
            "a.mpcdi": (["convert", cls.rig], True),
            "a.key": (["keys", "bundle", cls.keyed, "left", "--keys", cls.folder / "keys", "--out"], False),
            "a.txtpb": (["new-rig", "--screen", "flat", "--count", "2", "--windows"], False),
        }

    def each(self, kind, only_replacing=False):
        for name, (command, replaces) in self.commands.items():
            if only_replacing and not replaces:
                continue
            yield self.fresh(kind) / name, command

    def written(self, *command, **options):
        run = aquarama(*command, **options)
        self.assertEqual(run.returncode, 0, run.stderr)

    def assert_whole(self, path):
        self.assertGreater(path.stat().st_size, FULL_AFTER)
        self.assertEqual([*path.parent.glob("*.part")], [])

    def test_a_link_is_followed(self):
        for path, command in self.each("link", only_replacing=True):
            (path.parent / "real").write_text("old")
            path.symlink_to("real")
            self.written(*command, path)
            self.assertTrue(path.is_symlink())
            self.assert_whole(path)

    def test_where_a_dangling_link_leads_the_file_is_made(self):
        for path, command in self.each("dangling"):
            path.symlink_to("real")
            self.written(*command, path)
            self.assertTrue(path.is_symlink())
            self.assert_whole(path.parent / "real")

    def test_a_pipe_is_written_into(self):
        for path, command in self.each("pipe"):
            os.mkfifo(path)
            read = []
            reader = threading.Thread(target=lambda: read.append(path.read_bytes()), daemon=True)
            reader.start()
            self.written(*command, path)
            reader.join(20)
            self.assertTrue(stat.S_ISFIFO(path.stat().st_mode))
            self.assertGreater(len(read[0]), FULL_AFTER)

    def test_standard_output_through_a_pipe_ends_with_it(self):
        command, _ = self.commands["a.csv"]
        run = subprocess.Popen([BIN / "aquarama", *map(str, command), "/dev/fd/1"], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=False, cwd=ROOT)
        run.stdout.close()
        said = run.stderr.read().decode()
        run.stderr.close()
        self.said_in_one_line(subprocess.CompletedProcess([], run.wait(), stderr=said), "its reader has ended")

    def test_the_mode_of_a_file_stays(self):
        for path, command in self.each("mode", only_replacing=True):
            path.write_text("old")
            path.chmod(0o600)
            self.written(*command, path)
            self.assertEqual(stat.S_IMODE(path.stat().st_mode), 0o600)
            self.assert_whole(path)

    def test_a_disk_that_is_full_at_the_start(self):
        for path, command in self.each("full"):
            path.symlink_to("/dev/full")
            self.said_in_one_line(aquarama(*command, path), path, "No space left on device")
            self.assertTrue(path.is_symlink())
            self.assertTrue(stat.S_ISCHR(os.stat("/dev/full").st_mode))

    def test_a_disk_that_fills_in_the_middle(self):
        for path, command in self.each("middle"):
            with self.subTest("a new file"):
                self.said_in_one_line(aquarama(*command, path, preexec_fn=on_a_full_disk), path, "File too large")
                self.assertEqual([*path.parent.iterdir()], [])
        for path, command in self.each("middle", only_replacing=True):
            path.write_text("old")
            self.said_in_one_line(aquarama(*command, path, preexec_fn=on_a_full_disk), path)
            self.assertEqual(path.read_text(), "old")
            self.assertEqual([*path.parent.iterdir()], [path])

    def test_a_folder_that_is_read_only(self):
        require_nobody(self)
        home = {"environment": {"HOME": "/nonexistent"}, "preexec_fn": as_nobody}
        for path, command in self.each("closed"):
            path.parent.chmod(0o555)
            self.said_in_one_line(aquarama(*command, path, **home), path, "Permission denied")
        for path, command in self.each("closed", only_replacing=True):
            path.write_text("old")
            path.chmod(0o666)
            path.parent.chmod(0o555)
            self.written(*command, path, **home)
            self.assert_whole(path)


class Adjustments(Case):
    def test_the_file_is_written_where_its_link_leads(self):
        rig = rig_on_free_ports(self.folder)
        rig.write_text(rig.read_text() + '\nadjustments: "by_hand.txtpb"\n')
        by_hand, real = self.folder / "by_hand.txtpb", self.folder / "real"
        by_hand.symlink_to("real")
        mask = ["adjust", "mask", rig, "10,10", "60,10", "60,60"]
        self.assertEqual(aquarama(*mask).returncode, 0)
        self.assertTrue(by_hand.is_symlink())
        real.chmod(0o640)
        before = real.read_text()
        self.said_in_one_line(aquarama(*mask, preexec_fn=lambda: resource.setrlimit(
            resource.RLIMIT_FSIZE, (len(before), len(before)))), by_hand)
        self.assertEqual(real.read_text(), before)
        self.assertEqual(aquarama(*mask).returncode, 0)
        self.assertGreater(len(real.read_text()), len(before))
        self.assertEqual(stat.S_IMODE(real.stat().st_mode), 0o640)


class Reports(Case):
    """Figures that Python draws."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        assert aquarama("capture", "--species", "bigeye_scad", "--out", cls.folder).returncode == 0

    def test_a_page_goes_where_its_link_leads_and_keeps_its_mode(self):
        require_nobody(self)
        folder = self.fresh("report")
        (folder / "bigeye_scad.html").symlink_to("real.html")
        (folder / "bigeye_scad_body.svg").write_text("old")
        (folder / "bigeye_scad_body.svg").chmod(0o660)
        if os.geteuid() == 0:
            os.chown(folder / "bigeye_scad_body.svg", NOBODY, NOBODY)
        run = aquarama("inspect", self.folder / "bigeye_scad.aqrep", "--report", folder,
                       preexec_fn=as_nobody, environment={"HOME": "/nonexistent", "XDG_CACHE_HOME": "/nonexistent"})
        if "no Python 3 with its modules" in run.stderr:
            self.skipTest("no Python with Matplotlib")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual(stat.S_IMODE((folder / "bigeye_scad_body.svg").stat().st_mode), 0o660)
        self.assertIn("<html", (folder / "real.html").read_text())
        self.assertTrue((folder / "bigeye_scad.html").is_symlink())
        self.assertGreater((folder / "bigeye_scad_turns.svg").stat().st_size, 1000)

    def test_a_full_disk_is_one_line_also_of_python(self):
        def few_bytes():
            resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, 200_000))
        folder = self.fresh("full")
        run = aquarama("inspect", self.folder / "bigeye_scad.aqrep", "--report", folder, preexec_fn=few_bytes)
        if "no Python 3 with its modules" in run.stderr:
            self.skipTest("no Python with Matplotlib")
        self.said_in_one_line(run, "File too large")
        self.assertEqual([*folder.glob("*.part")], [])


class Shows(Case):
    """What a show writes: recording, trace, pictures, clip."""

    def rig(self):
        return rig_on_free_ports(self.folder, replace=EMPTY_SEA)

    def test_all_at_once_at_places_of_all_kinds(self):
        folder = self.fresh("show")
        (folder / "frames").mkdir()
        (folder / "frames/channel-left.png").symlink_to("../left.png")
        (folder / "frames/panorama.png").write_text("old")
        (folder / "frames/panorama.png").chmod(0o600)
        (folder / "master.csv").write_text("old")
        (folder / "master.csv").chmod(0o600)
        (folder / "left.csv").symlink_to("left_real.csv")
        for pipe in ["show.aqrec", "show.webp", "right.csv"]:
            os.mkfifo(folder / pipe)
        read = {}
        readers = [threading.Thread(target=lambda pipe=pipe: read.update({pipe: (folder / pipe).read_bytes()}),
                                    daemon=True)
                   for pipe in ["show.aqrec", "show.webp", "right.csv"]]
        for reader in readers:
            reader.start()
        run = aquarama("run", self.rig(), "--headless", "--frames", 2, "--pattern", "grid", "--record",
                       folder / "show.aqrec",
                       "--clip", folder / "show.webp", "--snapshot", folder / "frames", "--trace", folder)
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        for reader in readers:
            reader.join(20)
        self.assertIn(b"AQREC", read["show.aqrec"][:64])
        self.assertEqual(read["show.webp"][8:12], b"WEBP")
        self.assertEqual(read["right.csv"].count(b"\n"), 3)
        self.assertEqual((folder / "left_real.csv").read_text().count("\n"), 3)
        self.assertEqual(stat.S_IMODE((folder / "master.csv").stat().st_mode), 0o600)
        self.assertEqual((folder / "left.png").read_bytes()[1:4], b"PNG")
        self.assertEqual(stat.S_IMODE((folder / "frames/panorama.png").stat().st_mode), 0o600)

    def test_a_poster_has_so_many_times_the_pixels(self):
        folder = self.fresh("poster")
        smaller = ("width_px: 1350 height_px: 600", "width_px: 450 height_px: 200")
        rig = rig_on_free_ports(self.folder, replace=[smaller])
        run = aquarama("run", rig, "--headless", "--frames", 2, "--quality", "low", "--snapshot", folder, "--scale", 3,
                       "--scene", ROOT / "config/scenes/empty_sea.txtpb")
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        header = (folder / "panorama.png").read_bytes()[:24]
        self.assertEqual(struct.unpack(">II", header[16:]), (1350, 600))
        self.assertEqual([*folder.glob("*.part")], [])

    def test_a_disk_that_fills_ends_what_is_written_and_not_the_show(self):
        for option, name in [("--record", "show.aqrec"), ("--trace", "")]:
            with self.subTest(option):
                folder = self.fresh("full")
                run = aquarama("run", self.rig(), "--headless", "--frames", 12, "--pattern", "grid", option,
                               folder / name,
                               preexec_fn=on_a_full_disk)
                self.said_in_one_line(run, "File too large", folder)
                self.assertEqual([*folder.glob("*.part")], [])
                for trace in folder.glob("*.csv"):
                    self.assertTrue(trace.read_text().endswith("\n"), "whole lines")


class Conveniences(Case):
    """A cache, a log and what is kept only save time: a show goes on without them."""

    def test_without_a_home(self):
        require_nobody(self)
        run = aquarama("run", rig_on_free_ports(self.folder), "--headless", "--live", "--frames", 2, "--pattern",
                       "grid",
                       "--scene", ROOT / "config/scenes/empty_sea.txtpb", preexec_fn=as_nobody,
                       environment={"HOME": "/nonexistent", "XDG_CACHE_HOME": "", "XDG_STATE_HOME": "",
                                    "XDG_CONFIG_HOME": ""})
        said = run.stdout + run.stderr
        self.assertEqual(run.returncode, 0, said)
        self.assertRegex(said,
                         r"/nonexistent/\S+: cannot be written \(Permission denied\); .*\(the fish are captured anew")
        self.assertRegex(said, r"the log of the show cannot be written")
        self.assertEqual(said.count("captured anew"), 1, said)


class LeftByKilledPrograms(Case):
    def test_nothing_stays_after_the_next_start(self):
        place = self.fresh("tmp")
        environment = {"TMPDIR": str(place)}
        with unittest.mock.patch.dict(os.environ, environment):
            run = start("run", rig_on_free_ports(self.folder, replace=EMPTY_SEA), "--headless", "--frames", 100000,
                        "--pattern", "grid", "--clip", self.folder / "a.webp", "--record", self.folder / "a.aqrec")
        try:
            wait_until(lambda: len([*place.glob("aquarama.clip.*/*")]) == 3, 60, "the sockets of the clip")
            children = children_of(run).values()
        finally:
            run.kill()
            run.wait()
        for child in children:
            try:
                os.kill(child, signal.SIGKILL)
            except ProcessLookupError:
                pass
        self.assertEqual(len([*place.iterdir()]), 1)
        wait_until(lambda: not any(Path(f"/proc/{child}").exists() for child in children), 30,
                   "the end of the programs")
        aquarama("inspect", ROOT / "config/desk.txtpb", environment=environment)
        self.assertEqual([*place.iterdir()], [])


class StandardOutput(unittest.TestCase):
    def test_that_is_full_is_an_error(self):
        for program, command in [("aquarama-compose", "inspect"), ("aquarama", "inspect")]:
            with open("/dev/full", "w") as full:
                run = subprocess.run([BIN / program, command, ROOT / "config/desk.txtpb"], stdout=full,
                                     stderr=subprocess.PIPE,
                                     text=True, cwd=ROOT)
            self.assertEqual((run.returncode, run.stderr.count("\n")), (1, 1), run.stderr)
            self.assertIn("No space left", run.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
