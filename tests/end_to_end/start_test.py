"""How a show begins and how a clip ends: the first picture comes at once, the cache changes no picture, Ctrl-C keeps a
clip."""

import json
import os
import shutil
import signal
import subprocess
import unittest
from pathlib import Path

from show import BIN, ROOT, aquarama, control_address, rig_on_free_ports, temporary_folder, wait_until

PICTURES = ["channel-left.png", "channel-middle.png", "channel-right.png", "panorama.png", "hall.png"]


def user_cache():
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")


def boxes(mp4):
    """The names of the boxes at the top of an MP4: a player needs moov, which is written last."""
    at, names = 0, []
    while at + 8 <= len(mp4):
        names.append(mp4[at + 4:at + 8].decode())
        at += int.from_bytes(mp4[at:at + 4], "big") or len(mp4)
    return names


class Start(unittest.TestCase):
    def setUp(self):
        self.temporary = temporary_folder()
        self.folder = Path(self.temporary.name)
        self.rig = rig_on_free_ports(self.folder)

    def tearDown(self):
        self.temporary.cleanup()

    def pictures_with(self, cache, name):
        run = aquarama("run", self.rig, "--headless", "--frames", 2, "--quality", "low", "--snapshot",
                       self.folder / name,
                       environment={"XDG_CACHE_HOME": str(cache)})
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertFalse(list((self.folder / name).glob("*.mp4")), "a snapshot alone makes no clip")
        return [(self.folder / name / picture).read_bytes() for picture in PICTURES]

    def test_pictures_are_the_same_with_and_without_the_cache(self):
        cache = self.folder / "cache"
        (cache / "aquarama").mkdir(parents=True)
        captured = user_cache() / "aquarama" / "repertoires"
        if captured.is_dir():  # spares a capture, which other tests look at
            shutil.copytree(captured, cache / "aquarama" / "repertoires")
        made = self.pictures_with(cache, "made")
        kept = {path.name for path in (cache / "aquarama" / "derived").glob("*.data")}
        for kind in ["reef", "ground", "water", "fish", "sand", "rock"]:
            self.assertEqual(sum(name.startswith(kind + "-") for name in kept), 1, f"{kind} in {sorted(kept)}")
        read = self.pictures_with(cache, "read")
        self.assertEqual({path.name for path in (cache / "aquarama" / "derived").glob("*.data")}, kept)
        for name, one, other in zip(PICTURES, made, read):
            self.assertEqual(one, other, f"{name} is another when what it is drawn from comes from the cache")

    def test_a_first_start_says_what_the_master_prepares(self):
        log, cache = self.folder / "log", self.folder / "none"
        prepares = r"the master prepares: (capturing 15 of 15 species, \d+ %|making the world)"
        environment = os.environ | {"LP_NUM_THREADS": "1", "XDG_CACHE_HOME": str(cache)}
        with log.open("w") as output:
            master, node = (subprocess.Popen([BIN / program, *arguments], stdout=output, stderr=output, cwd=ROOT,
                                             env=environment)
                            for program, arguments in (("aquarama", ["master", self.rig]),
                                                       ("aquarama-node",
                                                        ["left", "--master", control_address(self.rig), "--headless"])))
        try:
            wait_until(lambda: "capturing 15 of 15 species: once on this machine" in log.read_text(), 30,
                       "a line of the master")
            status = aquarama("status", self.rig)
            self.assertEqual(status.returncode, 1)
            self.assertRegex(status.stderr, rf"\Aaquarama status: {prepares}; ask again in a while\n\Z")
            found = {one["subject"]: one for one in json.loads(aquarama("doctor", self.rig, "--json").stdout)}
            self.assertEqual(found["show"]["verdict"], "warn")
            self.assertRegex(found["show"]["what"], prepares)
            self.assertNotIn("ports", found)
            wait_until(lambda: "left: " in log.read_text(), 30, "a line of the node")
            self.assertRegex(log.read_text(), rf"left: {prepares}; still trying")
            self.assertNotIn("no master answers", log.read_text())
        finally:
            for process in (node, master):
                process.kill()
                process.wait()

    def test_the_first_picture_comes_at_once_and_an_interrupted_clip_is_kept(self):
        show, log = self.folder / "show", self.folder / "log"
        with log.open("w") as output:
            run = subprocess.Popen([BIN / "aquarama", "run", self.rig, "--headless", "--frames", "100000",
                                    "--film-every", "2",
                                    "--quality", "low", "--snapshot", show, "--clip", show / "clip.mp4"],
                                   stdout=output, stderr=output, cwd=ROOT, env=os.environ | {"LP_NUM_THREADS": "1"})
        try:
            wait_until(lambda: "clip: picture" in log.read_text(), 90, "a line that says how far the clip is")
            said = log.read_text()
            self.assertLess(said.index(f"first picture: {show}/panorama.png, {show}/hall.png"),
                            said.index("clip: picture"))
            self.assertRegex(said, r"clip: picture \d+ of 50000, [\d.]+ a second, \d+ s left\n")
            for name in ["panorama.png", "hall.png"]:
                self.assertTrue((show / name).is_file(), name)
            self.assertFalse((show / "clip.mp4").exists(), "a clip is there when it is whole")
            run.send_signal(signal.SIGINT)
            self.assertEqual(run.wait(90), 130)
        finally:
            run.kill()
            run.wait()
        self.assertRegex(log.read_text(), r"clip of the panorama in \S+clip.mp4: \d+ pictures\n")
        self.assertEqual({"ftyp", "moov", "mdat"} - set(boxes((show / "clip.mp4").read_bytes())), set())
        self.assertEqual(list(show.glob("*.part")), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
