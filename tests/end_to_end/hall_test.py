"""A hall that travels: written into one file on one machine, put into a folder of another, and shown there."""

import hashlib
import os
import pty
import shutil
import subprocess
import unittest
import zipfile
from pathlib import Path

from show import BIN, ROOT, aquarama, lacks, rig_on_free_ports, temporary_folder

WORDS = "a fish in a hall\n"
ADDRESS = "192.0.2.7"  # past the loopback, where everybody needs a key
HOURS = """zone: "Europe/Berlin"
open { days: [SUNDAY] from: "10:00" to: "18:00" scene: "empty" }
projectors { name: "left" address: "192.168.7.21" password: "of the projector" }
"""


class Machine:
    """A machine: folders of a user, and whatever is run with them."""

    def __init__(self, folder):
        self.folder = folder
        self.rigs = folder / "rigs"
        self.keys = folder / "config/aquarama/keys/hall"
        self.hours = folder / "state/aquarama/console/hall/hours.txtpb"
        self.drawings = folder / "state/aquarama/shows/hall.drawings"
        self.user = {"XDG_CONFIG_HOME": str(folder / "config"), "XDG_STATE_HOME": str(folder / "state")}

    def run(self, *arguments, words=WORDS):
        return aquarama(*arguments, environment=dict(self.user), input=words)

    def show(self, rig):
        """The digest of what the whole wall shows, with keys over a network card."""
        out = self.folder / "shown"
        network = f"ip link set lo up && ip address add {ADDRESS}/32 dev lo && exec \"$@\""
        done = subprocess.run(["unshare", "-rn", "sh", "-c", network, "sh", BIN / "aquarama", "run", rig, "--headless",
                               "--frames", "3", "--seed", "7", "--snapshot", out],
                              env=os.environ | self.user, capture_output=True, text=True, timeout=300)
        assert done.returncode == 0, done.stderr
        return hashlib.sha256((out / "panorama.png").read_bytes()).hexdigest()


def files_of(folder):
    """name -> (mode, content) of all files below a folder."""
    return {str(path.relative_to(folder)): (path.stat().st_mode & 0o777, path.read_bytes())
            for path in folder.rglob("*") if path.is_file()}


class Hall(unittest.TestCase):
    def setUp(self):
        temporary = temporary_folder()
        self.addCleanup(temporary.cleanup)
        folder = Path(temporary.name)
        self.here, self.there = Machine(folder / "here"), Machine(folder / "there")
        self.file = folder / "stick/hall.aqhall"
        self.elsewhere = folder / "elsewhere"
        self.make_hall()

    def make_hall(self):
        """A hall whose files lie where those of halls do: wall files beside the rig, scenes elsewhere."""
        self.here.rigs.mkdir(parents=True)
        (self.elsewhere / "scenes").mkdir(parents=True)
        (self.elsewhere / "fish").mkdir()
        shutil.copy(ROOT / "config/canvas.obj", self.here.rigs)
        shutil.copy(ROOT / "config/species/bigeye_scad.txtpb", self.elsewhere / "fish")
        alone = (ROOT / "config/scenes/study/alone.txtpb").read_text()
        first_of_cast = alone[:alone.index("cast {", alone.index("cast {") + 1)]
        scene = first_of_cast.replace("../../species/", "../fish/").replace("fish: 1", "fish: 40")
        for name in ("alone", "empty"):
            (self.elsewhere / f"scenes/{name}.txtpb").write_text(scene)
        rig = rig_on_free_ports(self.here.rigs, "measured_3", [
            (r"tcp://127\.0\.0\.1", f"tcp://{ADDRESS}"),
            (r'scene: "\S+"', f'scene: "{self.elsewhere}/scenes/alone.txtpb"\nadjustments: "by_hand.txtpb"')])
        self.rig = rig.rename(self.here.rigs / "hall.txtpb")
        (self.here.rigs / "by_hand.txtpb").write_text(
            "points { channel: 'left' picture { x_px: 320 y_px: 200 } right_px: 12 radius_px: 300 }\n")
        self.here.hours.parent.mkdir(parents=True)
        self.here.hours.write_text(HOURS)
        self.here.drawings.mkdir(parents=True)
        (self.here.drawings / "1.png").write_bytes(b"a drawing")
        self.assertEqual(self.here.run("keys", "new", self.rig).returncode, 0)

    def leave(self, *options):
        done = self.here.run("hall", "export", self.rig, self.file, "--passphrase", "-", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def arrive(self, words=WORDS):
        return self.there.run("hall", "import", self.file, self.there.rigs, "--passphrase", "-", words=words)

    def refuses(self, done, said):
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, said)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertFalse(self.there.folder.exists(), "nothing arrives")

    @unittest.skipIf(*lacks(shutil.which("unshare") and shutil.which("ip"), "iproute2"))
    def test_the_same_picture_with_the_same_keys_on_another_machine(self):
        self.assertRegex(self.leave("--drawings"), r"hall\.aqhall: hall\.txtpb with 5 files; sealed: 9 keys, hours, "
                                                   r"1 drawing\n")
        shown_here = self.here.show(self.rig)
        for gone in (self.elsewhere, self.here.folder):
            shutil.move(gone, gone.with_name(gone.name + "_gone"))
        arrived = self.arrive()
        self.assertEqual(arrived.returncode, 0, arrived.stderr)
        self.assertRegex(arrived.stdout, r"there/rigs/hall\.txtpb: with 5 files; 9 keys, hours, 1 drawing\nnext: ")
        gone = Machine(self.here.folder.with_name("here_gone"))
        for folder in ("keys", "drawings"):
            before, after = files_of(getattr(gone, folder)), files_of(getattr(self.there, folder))
            self.assertEqual({name: content for name, (_, content) in after.items()},
                             {name: content for name, (_, content) in before.items()})
            self.assertEqual({mode for mode, _ in after.values()}, {0o600})
        self.assertEqual(self.there.keys.stat().st_mode & 0o777, 0o700)
        self.assertEqual(self.there.hours.read_text(), HOURS)
        self.assertEqual(self.there.show(self.there.rigs / "hall.txtpb"), shown_here)
        # A picture that is the same without adjustments would prove less.
        (self.there.rigs / "by_hand.txtpb").write_text("")
        self.assertNotEqual(self.there.show(self.there.rigs / "hall.txtpb"), shown_here)

    def test_what_is_secret_cannot_be_read_in_the_file(self):
        self.leave()
        with zipfile.ZipFile(self.file) as archive:
            names = archive.namelist()
            content = b"".join(archive.read(name) for name in names)
        self.assertIn("files/by_hand.txtpb", names)
        self.assertNotIn(b"secret_key", content)
        self.assertNotIn(b"of the projector", content)
        self.assertNotIn(b"a drawing", content)
        arrived = self.arrive()
        self.assertEqual(arrived.returncode, 0, arrived.stderr)
        self.assertFalse(self.there.drawings.exists(), "drawings travel if wished")

    def test_what_cannot_arrive_is_one_line_and_leaves_nothing(self):
        self.leave()
        self.refuses(self.arrive("a fish in the hall\n"), r"aquarama hall import: \S+hall\.aqhall: the passphrase is "
                                                          "wrong")
        self.refuses(self.arrive(""), "has no passphrase")
        self.refuses(self.there.run("hall", "import", self.file, self.there.rigs, words=""),
                     "asked at a terminal; give --passphrase FILE")
        whole = self.file.read_bytes()
        self.file.write_bytes(whole[:-2000])
        self.refuses(self.arrive(), r"hall\.aqhall: is no whole zip archive")
        with zipfile.ZipFile(self.file, "w") as archive:
            archive.writestr("../../outside.txtpb", "name: 'outside'")
        self.refuses(self.arrive(), r'its entry "\.\./\.\./outside\.txtpb" leads out of the archive')
        with open(self.file, "wb") as huge:
            huge.truncate((1 << 30) + 1)
        self.refuses(self.arrive(), r"hall\.aqhall: ")

    def test_a_hall_that_is_not_whole_does_not_leave(self):
        (self.elsewhere / "scenes/empty.txtpb").unlink()
        done = self.here.run("hall", "export", self.rig, self.file, "--passphrase", "-")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"scenes/empty\.txtpb: is not there, and the hours of \S+ name this scene")
        self.refuses(self.here.run("hall", "export", self.rig, self.file, "--passphrase", "-", words="short\n"),
                     "empty.txtpb")
        shutil.copy(self.elsewhere / "scenes/alone.txtpb", self.elsewhere / "scenes/empty.txtpb")
        self.refuses(self.here.run("hall", "export", self.rig, self.file, "--passphrase", "-", words="short\n"),
                     "fewer than 8 characters")
        self.assertFalse(self.file.exists())

    def on_a_terminal(self, answers):
        """What export says at a terminal, and its status."""
        process, terminal = pty.fork()
        if process == 0:
            os.environ.update(self.here.user)
            os.execv(BIN / "aquarama", ["aquarama", "hall", "export", str(self.rig), str(self.file)])
        said = b""
        try:
            while part := os.read(terminal, 4096):
                said += part
                if said.endswith(b": ") and answers:
                    os.write(terminal, answers.pop(0))
        except OSError:  # it has ended
            pass
        status = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
        os.close(terminal)
        return status, said.decode()

    def test_at_a_terminal_the_passphrase_is_asked_twice_and_not_shown(self):
        status, said = self.on_a_terminal([b"a fisch\x7f\x7fh in a hall\r", b"a fish in a hall\r"])
        self.assertEqual(status, 0, said)
        self.assertNotIn("fish", said)
        arrived = self.arrive()
        self.assertEqual(arrived.returncode, 0, arrived.stderr)
        for answers, why in (([b"one of them\r", b"another one\r"], "differ"), ([b"\x03"], "no passphrase was given")):
            status, said = self.on_a_terminal(answers)
            self.assertEqual(status, 1)
            self.assertIn(why, said)


if __name__ == "__main__":
    unittest.main(verbosity=2)
