"""The boot loader obeys the entries of the image: it takes the newest serial, three times, and then the one before.

QEMU starts systemd-boot with UEFI, without KVM. What stands for kernels ends at once, so each power on is one try. The
boot loader writes the tries into the names of its entries. Without the packages of packaging/packages/boot.txt and
image.txt it ends with status 77, in CI with 1.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FIRMWARE = Path("/usr/share/OVMF/OVMF_CODE.fd")
BOOT = Path("/usr/lib/systemd/boot/efi")
MOST_SECONDS = 300
ENDS = (b"Shell>", b"Boot Maintenance Manager")  # where the firmware ends when nothing can be started
FIRST_BYTE = 2048 * 512  # of the system partition


def called(*command, **more):
    return subprocess.run([*map(str, command)], check=True, capture_output=True, text=True, **more).stdout


class Machine:
    def __init__(self, folder):
        self.folder, self.disk = folder, folder / "disk.img"
        with open(self.disk, "wb") as disk:
            disk.truncate(600 << 20)
        called(ROOT / "packaging/image/partition", self.disk, 300)
        called("mkfs.vfat", "-F", 32, "--offset", 2048, self.disk, 300 << 10)
        called("mmd", "-i", self.system(), "::EFI", "::EFI/BOOT", "::loader", "::loader/entries", "::aquarama")
        self.put(BOOT / "systemd-bootx64.efi", "EFI/BOOT/BOOTX64.EFI")
        self.write("loader/loader.conf", "timeout 0\n")

    def system(self):
        return f"{self.disk}@@{FIRST_BYTE}"

    def put(self, file, name):
        called("mcopy", "-i", self.system(), file, f"::{name}")

    def write(self, name, text):
        (self.folder / "text").write_text(text)
        self.put(self.folder / "text", name)

    def release(self, version, serial, counter):
        called("mmd", "-i", self.system(), f"::aquarama/{version}")
        for file in ("vmlinuz", "initrd.img"):
            self.put(BOOT / "linuxx64.efi.stub", f"aquarama/{version}/{file}")
        self.write(f"loader/entries/aquarama-{version}{counter}.conf",
                   called(ROOT / "packaging/image/entry", version, "show", "0a-1b", serial))

    def power(self):
        """On, until nothing more is tried, and off; the names of the entries."""
        shutil.copy("/usr/share/OVMF/OVMF_VARS.fd", self.folder / "vars.fd")
        serial = self.folder / "serial.log"
        serial.unlink(missing_ok=True)
        drives = (f"if=pflash,format=raw,unit=0,readonly=on,file={FIRMWARE}",
                  f"if=pflash,format=raw,unit=1,file={self.folder}/vars.fd", f"file={self.disk},format=raw,if=virtio")
        machine = subprocess.Popen(["qemu-system-x86_64", "-accel", "tcg", "-m", "256", "-display", "none", "-nic",
                                    "none", "-monitor", "none", "-serial", f"file:{serial}",
                                    *(word for drive in drives for word in ("-drive", drive))])
        try:
            until = time.monotonic() + MOST_SECONDS
            while not serial.exists() or not any(end in serial.read_bytes() for end in ENDS):
                assert time.monotonic() < until and machine.poll() is None, serial.read_bytes()[-500:]
                time.sleep(0.5)
        finally:
            machine.kill()
            machine.wait()
        listed = called("mdir", "-b", "-i", self.system(), "::loader/entries")
        return {line.rsplit("/", 1)[1] for line in listed.split()}


def main():
    if not (shutil.which("qemu-system-x86_64") and shutil.which("mcopy") and FIRMWARE.exists() and BOOT.is_dir()):
        print("SKIPPED: no QEMU with UEFI, mtools or systemd-boot", file=sys.stderr)
        return 1 if os.environ.get("CI") else 77
    with tempfile.TemporaryDirectory(prefix="aquarama-") as folder:
        machine = Machine(Path(folder))
        machine.release("1.10", 100, "")
        machine.release("1.2", 200, "+3")  # newer, whatever its version says
        for name in ("1.2+2-1", "1.2+1-2", "1.2+0-3", "1.2+0-3"):
            entries = machine.power()
            assert entries == {"aquarama-1.10.conf", f"aquarama-{name}.conf"}, entries
            print("after the power:", *sorted(entries))
    return 0


if __name__ == "__main__":
    sys.exit(main())
