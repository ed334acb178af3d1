"""Machines that QEMU emulates, with UEFI and without KVM, and what their screens show."""

import contextlib
import json
import re
import shutil
import socket
import struct
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FIRMWARE = Path("/usr/share/OVMF/OVMF_CODE.fd")
PROCESSOR = re.search(r"^emulated_processor=(\S+)", (ROOT / "packaging/bare_systems.sh").read_text(), re.MULTILINE)[1]
sys.path.insert(0, str(ROOT / "packaging"))

from check_screen import MOST_SHARE, read_ppm, share_apart  # noqa: E402
from check_pictures import read_png  # noqa: E402, F401


def called(*command, okay=(0,), **more):
    done = subprocess.run([*map(str, command)], capture_output=True, text=True, **more)
    assert done.returncode in okay, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout


def wait_until(condition, seconds, what):
    """What the condition says, once it says something; a machine that has ended ends the waiting."""
    until = time.monotonic() + seconds
    while not (said := condition()):
        if time.monotonic() > until:
            raise AssertionError(f"not after {seconds} s: {what}")
        time.sleep(2)
    return said


def sign_release(folder, version, key, serial):
    """As packaging/build-image does it."""
    called("bash", "-euc", f"source <(sed -n '/^sign()/,/^}}/p' packaging/build-image); key={key} version={version}; "
           f"sign {folder} {serial}", cwd=ROOT)


def partitions(disk):
    return json.loads(called("sfdisk", "--json", disk))["partitiontable"]["partitions"]


class Machine:
    """One of them, with a disk. `ports`: of UDP, its own end of a cable and the other one. `drives`: more of them, as
    QEMU names them."""

    def __init__(self, folder, name, disk, ports, drives=()):
        self.folder, self.name, self.disk, self.ports, self.drives = folder / name, name, disk, ports, drives
        self.folder.mkdir()
        self.process = None

    def system(self):
        """Where mtools find the system partition."""
        return f"{self.disk}@@{2048 * 512}"

    def write(self, name, text):
        (self.folder / "text").write_text(text)
        called("mcopy", "-o", "-i", self.system(), self.folder / "text", f"::{name}")

    def entries(self):
        listed = called("mdir", "-b", "-i", self.system(), "::loader/entries")
        return {line.rsplit("/", 1)[1] for line in listed.split()}

    def lengthen_chain(self, file, clusters):
        """Gives a file free clusters and leaves its size, as a power cut does before the size is written. Whether there
        is such a file."""
        listed = called("mshowfat", "-i", self.system(), f"::{file}", okay=(0, 1))
        if not (chain := re.findall(r"(\d+)>", listed)):
            return False
        start = 2048 * 512
        with open(self.disk, "r+b") as disk:
            disk.seek(start)
            boot = disk.read(512)
            (sector,), (reserved,), (sectors,) = (struct.unpack_from(form, boot, at)
                                                  for form, at in (("<H", 11), ("<H", 14), ("<I", 36)))
            disk.seek(start + reserved * sector)
            table = bytearray(disk.read(sectors * sector))
            entries = memoryview(table).cast("I")
            free = [k for k in range(2, len(entries)) if entries[k] == 0][:clusters]
            for cluster, following in zip([int(chain[-1]), *free], [*free, 0x0fffffff]):
                entries[cluster] = following
            for copy in range(boot[16]):
                disk.seek(start + (reserved + copy * sectors) * sector)
                disk.write(table)
        return True

    @contextlib.contextmanager
    def data(self):
        """The data partition as a device, while the machine is off."""
        data = partitions(self.disk)[1]
        device = called("losetup", "--find", "--show", "--offset", 512 * data["start"], "--sizelimit",
                        512 * data["size"], self.disk).strip()
        try:
            yield device
        finally:
            called("losetup", "--detach", device)

    def grow(self, mebibytes):
        """More room for data, which are empty before the first start."""
        with open(self.disk, "r+b") as disk:
            disk.truncate(disk.seek(0, 2) + (mebibytes << 20))
        called("sfdisk", "-q", "-N", 2, self.disk, input=",+\n")
        with self.data() as data:
            called("mke2fs", "-q", "-F", "-t", "ext4", "-L", "aquarama-data", data)

    def put_in_data(self, folder, where):
        """Copies a folder into one of the data partition, while it is off."""
        target = f"{where}/{folder.name}"
        commands = [f"mkdir {target}", *(f"write {file} {target}/{file.name}" for file in sorted(folder.iterdir()))]
        (self.folder / "commands").write_text("\n".join(commands))
        with self.data() as data:
            called("e2fsck", "-fp", data, okay=(0, 1))
            called("debugfs", "-w", "-f", self.folder / "commands", data)
            for file in folder.iterdir():
                there = called("debugfs", "-R", f"stat {target}/{file.name}", data)
                assert f"Size: {file.stat().st_size}" in there, f"{file} is not in the data partition: {there}"

    def power_on(self):
        variables, serial, monitor, shell = (self.folder / name for name in ("vars", "serial", "monitor", "shell"))
        shutil.copy("/usr/share/OVMF/OVMF_VARS.fd", variables)
        serial.write_bytes(b"")  # what it said before is over
        drives = (f"if=pflash,format=raw,unit=0,readonly=on,file={FIRMWARE}",
                  f"if=pflash,format=raw,unit=1,file={variables}", f"file={self.disk},format=raw,if=virtio",
                  *self.drives)
        end = "socket,id=wire,localaddr=127.0.0.1:{},udp=127.0.0.1:{}".format(*self.ports)
        card = "virtio-net,netdev=wire,mac=52:54:00:00:{:02x}:{:02x}".format(*divmod(self.ports[0], 256))
        self.process = subprocess.Popen(
            ["qemu-system-x86_64", "-accel", "tcg,thread=multi", "-cpu", PROCESSOR, "-smp", "2", "-m", "2500",
             "-display", "none", "-vga", "std", "-netdev", end, "-device", card,
             "-serial", f"file:{serial}", "-serial", f"unix:{shell},server,nowait",
             "-monitor", f"unix:{monitor},server,nowait",
             *(word for drive in drives for word in ("-drive", drive))])
        self.began = time.monotonic()

    def cut_power(self):
        if self.process:
            self.process.kill()
            self.process.wait()
        self.process = None

    def log(self):
        """What came by the first serial line since the power."""
        return (self.folder / "serial").read_text(errors="replace")

    def since_power(self):
        return round(time.monotonic() - self.began)

    def screen(self):
        """What it shows; nothing where it cannot say so yet."""
        picture = self.folder / "screen.ppm"
        assert self.process.poll() is None, f"{self.name} has ended"
        try:
            with socket.socket(socket.AF_UNIX) as monitor:
                monitor.connect(str(self.folder / "monitor"))
                monitor.sendall(f"screendump {picture}\n".encode())
                time.sleep(2)
            return read_ppm(picture)
        except (OSError, ValueError):
            return None

    def keep_screen(self, file):
        if self.screen():
            shutil.copy(self.folder / "screen.ppm", file)

    def shows(self, **channels):
        """Whether the screen has these pictures: where each begins, from the left."""
        screen = self.screen()
        return screen is not None and all(share_apart(screen, picture, left) <= MOST_SHARE
                                          for picture, left in channels.values())

    def tell(self, command, seconds=120):
        """What a command of root says there, through the shell at the second serial line; nothing where there is no
        shell yet."""
        said = b""
        with socket.socket(socket.AF_UNIX) as line:
            line.settimeout(5)
            try:
                line.connect(str(self.folder / "shell"))
            except OSError:  # QEMU has not made it yet
                return ""
            line.sendall(b"stty -echo -onlcr; PS1=; echo BEG''IN\n" + command.encode() + b"\necho E''ND:$?:\n")
            until = time.monotonic() + seconds
            while b"END:" not in said and time.monotonic() < until:
                try:
                    said += line.recv(65536)
                except TimeoutError:
                    pass
        if b"END:" not in said:
            return ""
        return said.decode(errors="replace").split("BEGIN\n", 1)[-1].split("END:")[0].replace("\r", "")
