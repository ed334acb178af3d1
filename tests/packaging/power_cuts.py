"""power_cuts.py IMAGE KEY [CUTS]: an emulated machine loses its power CUTS times (20) at random moments of an update.

The machine has the kernel, the boot loader, the FAT of its system partition, the depot and the agent of IMAGE, and none
of the wall's programs runs. Its two releases are the kernel with a small first system each; the programs are on a
read-only disk. It begins with release 1.0, copies 1.1, starts with it, counts it as good, and begins with 1.0 again.
After each cut it must start with 1.0 or 1.1, find its data as they were, and go on. The first cut comes while a file
does. KEY signs releases.

A cut ends QEMU: what the machine has not brought to its disk is lost, what it has stays in order. The file that was
coming gets clusters that its size does not know of, as where FAT reached the disk first.
"""

import lzma
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from emulated import ROOT, Machine, called, partitions, sign_release, wait_until

MOST_SECONDS = 600  # from the power to the end of an update
SYSTEM_MIB, DATA_MIB = 300, 200
RELEASE_BYTES = 20_000_000
COMING = "aquarama/1.1/filesystem.squashfs"
BOOT = Path("/usr/lib/systemd/boot/efi/systemd-bootx64.efi")
# What Debian's kernel does not have built in, and this machine needs.
MODULES = ("virtio_pci", "virtio_blk", "crc32c_generic", "ext4", "nls_cp437", "nls_ascii", "vfat", "squashfs")
DEPOT = '  depot: "tcp://127.0.0.1:7403"'
FOLDERS = ("proc", "sys", "dev", "root")
# The first program. The programs' disk becomes its root.
FIRST = """#!/busybox sh
/busybox mount -t proc none /proc
/busybox mount -t sysfs none /sys
/busybox mount -t devtmpfs none /dev
for module in $(/busybox cat /modules); do /busybox insmod /$module.ko; done
until [ -b /dev/vda2 ] && [ -b /dev/vdb ]; do /busybox sleep 0.1; done
/busybox mount -t squashfs -o ro /dev/vdb /root
for folder in proc sys dev; do /busybox mount -o bind /$folder /root/$folder; done
/busybox mount -t tmpfs none /root/run
/busybox mount -t tmpfs none /root/tmp
/busybox mount -t vfat -o ro /dev/vda1 /root/boot
exec /busybox chroot /root /bin/sh -c 'e2fsck -p /dev/vda2; mount /dev/vda2 /mnt && exec sh /mnt/update'
"""
# Goes on with the update until all run 1.1. What an order is refused for does not matter: it is given again.
UPDATE = """
export XDG_STATE_HOME=/mnt/state PATH=/usr/sbin:/usr/bin:/sbin:/bin
ip link set lo up
cd /mnt
sha256sum --quiet -c SHA256SUMS && echo "data are whole"
/usr/lib/aquarama/image/writable
echo "runs $(sed -n 's/.*aquarama.release=\\([^ ]*\\).*/\\1/p' /proc/cmdline)"
aquarama release serve hall.txtpb --depot releases --signed-by show.pub --frames 1 --seconds 120 &
aquarama release follow --depot tcp://127.0.0.1:7403 --system /boot --machine /mnt/machine --signed-by show.pub &
until aquarama release status hall.txtpb | grep -q "all run 1\\.1"; do
    aquarama release stage hall.txtpb 1.1
    aquarama release go hall.txtpb
    sleep 1
done
aquarama release check /boot/aquarama/1.1 --key show.pub && ls /boot/loader/entries && echo "the update has ended"
sleep infinity
"""
MACHINE = """#!/bin/sh
case $1 in
    started) sed 's/.*aquarama.release=\\([^ ]*\\).*/\\1/' /proc/cmdline; cat /proc/sys/kernel/random/boot_id ;;
    frames) echo 100 ;;
    entry) sed "s/VERSION/$2/g; s/SERIAL/$3/" /mnt/entry ;;
    reboot) echo b >/proc/sysrq-trigger ;;
esac
"""
ENTRY = """title Aquarama VERSION
sort-key aquarama
version SERIAL
linux /aquarama/VERSION/vmlinuz
initrd /aquarama/VERSION/initrd.img
options rdinit=/first console=ttyS0 quiet panic=5 aquarama.release=VERSION
"""


def archive(folder):
    """What the kernel unpacks as its first system (cpio, "newc")."""
    out = bytearray()
    for number, path in enumerate(sorted(folder.rglob("*")), 1):
        content = path.read_bytes() if path.is_file() else b""
        out += entry_of(str(path.relative_to(folder)), number, path.stat().st_mode, content)
    return bytes(out + entry_of("TRAILER!!!", 0, 0, b""))


def entry_of(name, number, mode, content):
    fields = (number, mode, 0, 0, 1, 0, len(content), 0, 0, 0, 0, len(name) + 1, 0)
    head = b"070701" + b"".join(b"%08X" % field for field in fields) + name.encode() + b"\0"
    return head + bytes(-len(head) % 4) + content + bytes(-len(content) % 4)


def rig():
    """The desk with a depot."""
    desk = (ROOT / "config/desk.txtpb").read_text()
    return desk.replace("network {", "network {\n" + DEPOT).replace('"scenes/', '"/usr/share/aquarama/config/scenes/')


class Update:
    """A disk with 1.0 on it and 1.1 in the depot."""

    def __init__(self, folder, image, key):
        self.folder, self.key = folder, key
        self.programs = folder / "filesystem.squashfs"
        system = f"{image}@@{2048 * 512}"
        version = re.fullmatch(r"aquarama-(.*)\.img", image.name)[1]
        for file in ("vmlinuz", "filesystem.squashfs"):
            called("mcopy", "-n", "-i", system, f"::aquarama/{version}/{file}", folder)
        self.make_first_system()
        called("openssl", "pkey", "-in", key, "-pubout", "-out", folder / "show.pub")
        for serial, release in ((100, "1.0"), (200, "1.1")):
            self.make_release(release, serial)
        self.disk = folder / "disk.img"
        self.make_disk()

    def make_first_system(self):
        tree, first = self.folder / "tree", self.folder / "first"
        called("unsquashfs", "-q", "-n", "-d", tree, self.programs, "usr/bin/busybox", "usr/lib/modules",
               "usr/lib/x86_64-linux-gnu/libc.so.6", "usr/lib/x86_64-linux-gnu/libresolv.so.2",
               "usr/lib/x86_64-linux-gnu/ld-linux-x86-64.so.2")
        for name in FOLDERS:
            (first / name).mkdir(parents=True)
        (first / "lib64").mkdir()
        (first / "lib/x86_64-linux-gnu").mkdir(parents=True)
        libraries = tree / "usr/lib/x86_64-linux-gnu"
        shutil.copy(libraries / "ld-linux-x86-64.so.2", first / "lib64")
        for name in ("libc.so.6", "libresolv.so.2"):
            shutil.copy(libraries / name, first / "lib/x86_64-linux-gnu")
        shutil.copy(tree / "usr/bin/busybox", first)
        (first / "first").write_text(FIRST)
        (first / "first").chmod(0o755)
        (first / "modules").write_text("\n".join(self.put_modules(next((tree / "usr/lib/modules").iterdir()), first)))
        (self.folder / "initrd.img").write_bytes(archive(first))

    def put_modules(self, modules, first):
        """Those that are needed, each after what it needs itself."""
        needs = dict(line.split(":", 1) for line in (modules / "modules.dep").read_text().splitlines())
        of_name = {Path(path).name.split(".")[0].replace("-", "_"): path for path in needs}
        order = []

        def put(path):
            for other in needs[path].split():
                put(other)
            name = Path(path).name.split(".")[0]
            if name in order:
                return
            order.append(name)
            content = (modules / path).read_bytes()
            (first / f"{name}.ko").write_bytes(lzma.decompress(content) if path.endswith(".xz") else content)
        for name in MODULES:
            if name in of_name:
                put(of_name[name])
        return order

    def make_release(self, release, serial):
        folder = self.folder / release
        folder.mkdir()
        for file in ("vmlinuz", "initrd.img"):
            shutil.copy(self.folder / file, folder)
        (folder / "filesystem.squashfs").write_bytes(random.randbytes(RELEASE_BYTES))
        sign_release(folder, release, self.key, serial)

    def make_disk(self):
        with open(self.disk, "wb") as disk:
            disk.truncate((SYSTEM_MIB + DATA_MIB + 2) << 20)
        called(ROOT / "packaging/image/partition", self.disk, SYSTEM_MIB)
        called("mkfs.vfat", "-F", 32, "--offset", 2048, self.disk, SYSTEM_MIB << 10)
        system = f"{self.disk}@@{2048 * 512}"
        tree = self.folder / "system"
        for name in ("EFI/BOOT", "loader/entries", "aquarama"):
            (tree / name).mkdir(parents=True)
        shutil.copy(BOOT, tree / "EFI/BOOT/BOOTX64.EFI")
        (tree / "loader/loader.conf").write_text("timeout 0\n")
        (tree / "loader/entries/aquarama-1.0.conf").write_text(
            ENTRY.replace("VERSION", "1.0").replace("SERIAL", "100"))
        shutil.copytree(self.folder / "1.0", tree / "aquarama/1.0")
        called("mcopy", "-s", "-i", system, *tree.iterdir(), "::")
        data = self.folder / "data"
        (data / "releases").mkdir(parents=True)
        (data / "state").mkdir()
        shutil.copytree(self.folder / "1.1", data / "releases/1.1")
        for name, text in (("update", UPDATE), ("machine", MACHINE), ("entry", ENTRY), ("hall.txtpb", rig())):
            (data / name).write_text(text)
        (data / "machine").chmod(0o755)
        (data / "calibration").write_bytes(random.randbytes(5_000_000))
        shutil.copy(self.folder / "show.pub", data)
        (data / "SHA256SUMS").write_text(called("sha256sum", "calibration", "hall.txtpb", "update", cwd=data))
        part = partitions(self.disk)[1]
        called("mke2fs", "-q", "-t", "ext4", "-d", data, "-E", f"offset={512 * part['start']}", self.disk,
               f"{part['size'] // 2}K")

    def begin(self, machine):
        """On a fresh disk."""
        machine.cut_power()
        subprocess.run(["cp", "--sparse=always", self.disk, machine.disk], check=True)
        machine.power_on()


def said(machine, what):
    return re.findall(what, machine.log(), re.MULTILINE)


def await_start(machine):
    """The release that it starts with."""
    began = wait_until(lambda: said(machine, r"^runs (.*?)\r?$"), MOST_SECONDS, "it starts")
    assert began[0] in ("1.0", "1.1"), began
    assert said(machine, "data are whole"), machine.log()[-2000:]
    return began[0]


def await_part(machine):
    """Until a part of the file has reached the disk."""
    part, until = machine.folder / "part", time.monotonic() + MOST_SECONDS
    while True:
        called("mcopy", "-n", "-i", machine.system(), f"::{COMING}", part, okay=(0, 1))
        size = part.stat().st_size if part.exists() else 0
        assert size < RELEASE_BYTES and time.monotonic() < until, f"{size} bytes of {COMING} have come"
        if size > 0:
            return
        time.sleep(0.1)


def await_end(machine):
    wait_until(lambda: said(machine, "the update has ended"), MOST_SECONDS, "the update ends")


def main(image, key, cuts="20"):
    with tempfile.TemporaryDirectory(prefix="aquarama-", dir="/var/tmp") as folder:
        update = Update(Path(folder), Path(image).resolve(), Path(key).resolve())
        machine = Machine(Path(folder), "machine", Path(folder, "machine.img"), (7492, 7493),
                          [f"file={update.programs},format=raw,if=virtio,readonly=on"])
        try:
            update.begin(machine)
            await_start(machine)
            began = time.monotonic()
            await_end(machine)
            whole = time.monotonic() - began
            print(f"without a cut the update takes {whole:.0f} s", flush=True)
            update.begin(machine)
            for cut in range(int(cuts)):
                runs = await_start(machine)
                moment = random.uniform(0, whole) if cut > 0 else 0
                time.sleep(moment)
                if cut == 0:
                    await_part(machine)
                has_ended = bool(said(machine, "the update has ended"))
                machine.cut_power()
                is_longer = machine.lengthen_chain(COMING, 100)
                print(f"cut {cut + 1}: started with {runs}, {f'{moment:.0f} s' if cut else 'a part'} later "
                      f"{sorted(machine.entries())}"
                      f"{', with a chain too long' if is_longer else ''}"
                      f"{', the update had ended' if has_ended else ''}", flush=True)
                if has_ended:
                    machine.power_on()
                    assert await_start(machine) == "1.1"
                    update.begin(machine)
                else:
                    machine.power_on()
            await_start(machine)
            await_end(machine)
            print("the last one ends")
        except BaseException:
            print(machine.log()[-3000:], file=sys.stderr)
            raise
        finally:
            machine.cut_power()


if __name__ == "__main__":
    main(*sys.argv[1:])
