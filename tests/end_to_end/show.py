"""Starts real shows for the end-to-end tests: real processes, real sockets, EGL without a display."""

import csv
import os
import re
import signal
import socket
import struct
import subprocess
import tempfile
import time
import unittest
import zipfile
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BIN = Path(os.environ.get("AQUARAMA_BIN", ROOT / "build/dev/bin"))
CHANNELS = ["left", "middle", "right"]


def free_ports(count):
    """Ports that nobody listens on at the moment."""
    sockets = [socket.socket() for _ in range(count)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


# Replacements of rig_on_free_ports(): a scene that is soon prepared, where neither fish nor reef count.
EMPTY_SEA = [(r"scenes/reef\b", "scenes/empty_sea")]


def rig_on_free_ports(folder, rig="desk", replace=()):
    """A copy of config/RIG.txtpb with ports of its own and other (pattern, text) replacements; returns its path."""
    text = (ROOT / f"config/{rig}.txtpb").read_text()
    ports = iter(free_ports(8))
    text = re.sub(r"(tcp://127\.0\.0\.1:)\d+", lambda match: match.group(1) + str(next(ports)), text)
    text = re.sub(r"((?:metrics|console)_port: )\d+", lambda match: match.group(1) + str(next(ports)), text)
    text = text.replace("scenes/", str(ROOT / "config/scenes") + "/")
    for pattern, replacement in replace:
        text, count = re.subn(pattern, replacement, text)
        assert count, f"{pattern} is not in config/{rig}.txtpb"
    path = Path(folder) / f"{rig}.txtpb"
    path.write_text(text)
    return path


def give_colours(file):
    """To a wall file of the desk's channels: projectors of power 2 with other primaries than the wall's."""
    with zipfile.ZipFile(file) as archive:
        entries = {name: archive.read(name) for name in archive.namelist()}
    curve = " ".join(str((i / 255) ** 2) for i in range(256))
    response = "".join(f"<{primary}>{curve}</{primary}>" for primary in ("red", "green", "blue"))
    colours = "".join(f'<colour region="{name}"><mix>.8 .1 0 .05 .9 0 0 0 .7</mix>{response}</colour>'
                      for name in CHANNELS)
    entries["mpcdi.xml"] = entries["mpcdi.xml"].replace(
        b"</MPCDI>", f'<extensionSet><extension Name="Aquarama">{colours}</extension></extensionSet></MPCDI>'.encode())
    with zipfile.ZipFile(file, "w") as archive:
        for name, content in entries.items():
            archive.writestr(name, content)


def control_address(rig):
    return re.search(r"tcp://127\.0\.0\.1:\d+", Path(rig).read_text()).group(0)


def aquarama(*arguments, **options):
    """Runs the command to its end; a hang is a failure."""
    options.setdefault("timeout", 120)
    environment = os.environ | {"LP_NUM_THREADS": "1"} | options.pop("environment", {})
    command = [str(BIN / "aquarama"), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, env=environment, cwd=ROOT, **options)


def start(command, *arguments, log=None):
    """Starts `aquarama COMMAND`; its output goes to `log`."""
    environment = os.environ | {"LP_NUM_THREADS": "1"}
    with open(log or os.devnull, "a") as output:
        return subprocess.Popen([str(BIN / "aquarama"), command, *map(str, arguments)],
                                stdout=output, stderr=subprocess.STDOUT, env=environment, cwd=ROOT)


def children_of(process):
    """command line -> process id of what it has started."""
    listing = subprocess.run(["ps", "-o", "pid=,args=", "--ppid", str(process.pid)], capture_output=True,
                             text=True).stdout
    return {line.split(None, 1)[1]: int(line.split()[0]) for line in listing.splitlines()}


def end(processes, within=10):
    """Ends what still runs."""
    for process in processes:
        if process.poll() is None:
            process.send_signal(signal.SIGCONT)
            process.terminate()
    for process in processes:
        try:
            process.wait(within)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def trace(folder, name):
    """frame -> (state_ns, ready_ns, present_ns); what a frame lacks is None. A line being written is left out."""
    rows = {}
    path = Path(folder) / f"{name}.csv"
    if not path.exists():
        return rows
    for row in csv.reader(path.read_text().splitlines()):
        if len(row) == 4 and row[0].isdigit():
            rows[int(row[0])] = tuple(int(cell) if cell else None for cell in row[1:])
    return rows


def wait_until(condition, seconds, what):
    """Polls: the deadline is generous, and only a hang meets it."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        if condition():
            return
        time.sleep(0.05)
    raise AssertionError(f"waited {seconds} s in vain for: {what}")


def skin_png(red, green, blue):
    """A skin as a drawing has it (common/body/side_view.h), all of one colour."""
    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
    row = b"\0" + bytes((red, green, blue, 255)) * 1024
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1024, 512, 8, 6, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(row * 512)) + chunk(b"IEND", b""))


# Debian's libfaketime, for programs whose clock is wrong; empty where it is not there.
FAKE_TIME = next(iter(sorted(map(str, Path("/usr/lib").glob("*/faketime/libfaketime.so.1")))), "")


def at_time(text):
    """Variables of a process whose clock begins at this time, UTC; its monotonic clock is right."""
    return {"LD_PRELOAD": FAKE_TIME, "FAKETIME": f"@{text}", "FAKETIME_DONT_FAKE_MONOTONIC": "1", "TZ": "UTC"}


def lacks(found, package):
    """For unittest.skipIf: whether to skip without this package, and why. In CI nothing is skipped."""
    return not found and not os.environ.get("CI"), f"{package} is not installed (packaging/packages)"


def temporary_folder():
    """A folder of its own for a test; what a show keeps for its next start lies in it as well."""
    folder = tempfile.TemporaryDirectory(prefix="aquarama-")
    os.environ["XDG_STATE_HOME"] = folder.name + "/state"
    return folder


class ShowCase(unittest.TestCase):
    """A test with a rig of its own, a log, and processes that end with it."""

    def setUp(self):
        self.folder = temporary_folder()
        self.rig = rig_on_free_ports(self.folder.name)
        self.log = Path(self.folder.name) / "log"
        self.processes = []

    def tearDown(self):
        end(self.processes)
        self.folder.cleanup()
