"""A lighting desk drives a real show: by Art-Net over UDP to a real olad, which the console hears."""

import json
import os
import pwd
import shutil
import socket
import struct
import subprocess
import time
import unittest
from pathlib import Path

from desk import Desk, end, temporary_folder, wait_until

UNIVERSE = 7
ARTNET = ("127.0.0.1", 6454)
RPC = ("127.0.0.1", 9010)  # where OLA's clients look for olad; it has no other
CONFIG = {
    "artnet": "enabled = true\nip = 127.0.0.1\nuse_loopback = true\n",
    "universe": f"uni_{UNIVERSE}_merge = LTP\n",
}


def answers(place):
    with socket.socket() as probe:
        return probe.connect_ex(place) == 0


def missing():
    """Why this cannot be tried; empty where it can."""
    lacks = [name for name in ("olad", "ola_patch", "ola_dev_info") if not shutil.which(name)]
    if lacks:
        return f"no {', '.join(lacks)}: the package ola is not installed"
    return "another olad runs on this machine" if answers(RPC) else ""


def frame(*channels):
    """ArtDmx of the Art-Net 4 specification, to port-address UNIVERSE, as olad has it, without a sequence."""
    data = bytes(channels) + b"\0" * (len(channels) % 2)
    return b"Art-Net\0" + struct.pack("<H", 0x5000) + struct.pack(">HBBBBH", 14, 0, 0, UNIVERSE, 0, len(data)) + data


class Olad:
    """The daemon, with its Art-Net on the loopback and port 0 in UNIVERSE. It does not run as root."""

    def __init__(self):
        self.temporary = temporary_folder()
        self.folder = Path(self.temporary.name)
        for name, text in CONFIG.items():
            (self.folder / f"ola-{name}.conf").write_text(text)
        self.start()

    def start(self):
        user = {}
        if os.getuid() == 0:
            nobody = pwd.getpwnam("nobody")
            for path in [self.folder, *self.folder.iterdir()]:
                os.chown(path, nobody.pw_uid, nobody.pw_gid)
            user = {"user": nobody.pw_uid, "group": nobody.pw_gid, "extra_groups": []}
        self.process = subprocess.Popen(
            ["olad", "--no-http", "--no-register-with-dns-sd", "-l", "1", "-c", str(self.folder)],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **user)
        wait_until(lambda: answers(RPC), 20, "olad answers")
        wait_until(lambda: "ArtNet" in self.ask("ola_dev_info"), 20, "it has Art-Net")
        device = next(line for line in self.ask("ola_dev_info").splitlines() if "ArtNet" in line).split()[1].rstrip(":")
        self.ask("ola_patch", "-d", device, "-p", "0", "-i", "-u", str(UNIVERSE))

    def ask(self, *command):
        return subprocess.run(command, capture_output=True, text=True, check=False).stdout

    def stop(self):
        end([self.process])

    def close(self):
        self.stop()
        self.temporary.cleanup()


@unittest.skipIf(missing(), missing())
class LightingDesk(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.olad = Olad()
        cls.addClassCleanup(cls.olad.close)
        cls.sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        cls.addClassCleanup(cls.sender.close)
        cls.desk = Desk("--pattern", "grid", more=f'''
            cues {{ art_net {{ universe: {UNIVERSE} brightness: 1 black: 2 }} }}''')
        cls.addClassCleanup(cls.desk.close)
        heard = f"cues by DMX of olad's universe {UNIVERSE}"
        wait_until(lambda: heard in cls.desk.said(), 20, "the console hears olad")
        cls.watcher = cls.desk.token("watcher")
        wait_until(lambda: cls.state().get("nodes_in_step") == 3, 30, "all nodes in step")

    @classmethod
    def state(cls):
        return json.loads(cls.desk.request("GET", "/api/state", Authorization=f"Bearer {cls.watcher}")[2])

    def send(self, *channels):
        self.sender.sendto(frame(*channels), ARTNET)

    def shows(self, seconds=5, **values):
        wait_until(lambda: all(abs(self.state()[name] - value) < 0.01 for name, value in values.items()), seconds,
                   f"{values}: {self.state()}")

    def test_art_net_dims_and_blackens_the_wall(self):
        self.send(255, 0)
        time.sleep(1)
        self.shows(black=0, brightness=1)
        before = time.monotonic()
        self.send(255, 255)
        self.shows(black=1)
        print(f"black: shown {1000 * (time.monotonic() - before):.0f} ms after the packet")
        self.send(255, 0)
        self.shows(black=0, brightness=1)
        for value in range(255, 50, -1):  # a fader that moves for two seconds
            self.send(value, 0)
            time.sleep(0.01)
        self.shows(brightness=51 / 255)
        wait_until(lambda: "brightness 0.20" in self.events(), 5, "the fader has come to rest")
        lines = [line for line in self.events().splitlines() if "brightness" in line]
        self.assertEqual(len(lines), 1, lines)
        self.send(255, 0)
        self.shows(brightness=1)

    @classmethod
    def events(cls):
        files = list((Path(cls.desk.folder.name) / "state").rglob("events.jsonl"))
        return files[0].read_text() if files else ""

    def test_the_wall_stays_as_it_is_without_a_signal(self):
        self.send(255, 0)
        time.sleep(0.3)
        self.send(128, 0)
        self.shows(brightness=128 / 255)
        wait_until(lambda: "no DMX in universe" in self.events(), 25, "an alert of the silence")
        self.shows(brightness=128 / 255)
        self.olad.stop()
        wait_until(lambda: "olad does not answer" in self.desk.said(), 30, "olad is gone, and the console says so")
        self.shows(brightness=128 / 255)
        self.olad.start()
        for _ in range(30):  # until the console listens again
            self.send(255, 0)
            time.sleep(0.1)
        self.shows(brightness=1, seconds=10)


if __name__ == "__main__":
    unittest.main(verbosity=2)
