"""two_machines.py IMAGE PICTURES SCREENS KEY [CUTS]: a hall on one emulated machine, and a second one that waits for
its channel; then releases for both.

IMAGE has the hall of packaging/try-image.sh: its machine gives addresses to others. Both have it on their disks, the
second with the mode "node". Its letter is found by the first, its code is typed there, and it takes the place of the
first one's right channel. It comes back with it after a power cut.

Then a depot on the first brings releases to both: one that shows the wall, one whose nodes crash, one whose nodes hang,
and one that draws black. The bad ones are left again by both together. During the first, one of both machines loses its
power CUTS times (2), at random moments; the file that was coming has then more clusters than its size. KEY signs
releases.

PICTURES has what the channels show without a display; screens are left in SCREENS as try-*.ppm.
"""

import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from emulated import ROOT, Machine, called, partitions, read_png, sign_release, wait_until

MOST_SECONDS = 1800  # until a picture is there
CABLE = {"master": (7490, 7491), "spare": (7491, 7490)}
WIDTH = 160  # of a channel, in pixels
# What becomes of aquarama-node in a release. A library that takes every call to draw, and draws nothing, makes black.
FAULTS = {"9.2": "#!/bin/sh\nexit 1\n", "9.3": "#!/bin/sh\nexec sleep infinity\n",
          "9.4": "#!/bin/sh\nLD_PRELOAD=/usr/lib/aquarama/blind.so exec /usr/lib/aquarama/aquarama-node \"$@\"\n"}
BLIND = """#include <epoxy/gl.h>
static void nothing(GLenum mode, GLint first, GLsizei count) { (void)mode; (void)first; (void)count; }
__attribute__((constructor)) static void go_blind(void) { epoxy_glDrawArrays = nothing; }
"""


class Hall:
    def __init__(self, folder, image, pictures, screens, key):
        self.folder, self.screens, self.key = folder, screens, key
        self.serial = int(time.time())  # of the newest release
        self.version = re.fullmatch(r"aquarama-(.*)\.img", image.name)[1]
        self.master, self.spare = self.machines = [self.installed(image, *mode) for mode in
                                                   (("master", "show"), ("spare", "node"))]
        self.master.grow(4096)
        self.picture = {name: (read_png(pictures / f"channel-{name}.png"), left * WIDTH)
                        for left, name in enumerate(("left", "middle", "right"))}

    def installed(self, image, name, mode):
        """A machine with the image on its disk, and the boot loader's entry that `install` writes there."""
        disk = self.folder / f"{name}.img"
        subprocess.run(["cp", "--sparse=always", image, disk], check=True)
        machine = Machine(self.folder, name, disk, CABLE[name])
        listed = called("mtype", "-i", machine.system(), f"::aquarama/{self.version}/SHA256SUMS").splitlines()[0]
        words = re.search(r"^options .*aquarama\.data=\S+ (.*)$", called(
            "mtype", "-i", machine.system(), "::loader/entries/aquarama-show.conf"), re.MULTILINE)[1]
        entry = called(ROOT / "packaging/image/entry", self.version, mode, partitions(disk)[1]["uuid"].lower(),
                       listed.split()[-1])
        for other in machine.entries():
            called("mdel", "-i", machine.system(), f"::loader/entries/{other}")
        machine.write(f"loader/entries/aquarama-{self.version}+3.conf", entry.rstrip("\n") + words + "\n")
        machine.write("loader/loader.conf", "timeout 0\n")
        return machine

    def end(self):
        for machine in self.machines:
            machine.cut_power()

    def keep(self, machine, name):
        machine.keep_screen(self.screens / f"try-{name}.ppm")

    def shows(self, machine, *channels):
        return machine.shows(**{name: self.picture[name] for name in channels})

    def await_shown(self, machine, *channels):
        wait_until(lambda: self.shows(machine, *channels), MOST_SECONDS, f"{machine.name} shows {', '.join(channels)}")
        print(f"{machine.name} shows {', '.join(channels)} {machine.since_power()} s after its power", flush=True)

    # --- a channel for the second machine

    def waiting(self):
        """Letters of the machines that wait, as the master's machine finds them."""
        said = self.master.tell("aquarama nodes waiting")
        return re.findall(r"^([A-Z])\b", said, re.MULTILINE)

    def code(self):
        """Nobody reads the screen here: a node without windows says its code in its log."""
        self.spare.tell("cd /etc/aquarama/nodes; cp Virtual-1.conf kept; "
                        "sed -i 's/--connector.*/--headless/' Virtual-1.conf; "
                        "systemctl restart --no-block aquarama-node@Virtual-1")
        found = wait_until(lambda: re.findall(r"as ([A-Z]), code (\S+)", self.spare.tell(
            "journalctl -b --no-pager -u aquarama-node@Virtual-1")), MOST_SECONDS, "a code")
        self.spare.tell("cd /etc/aquarama/nodes; mv kept Virtual-1.conf")
        return found[-1]

    def assign(self):
        letter, code = self.code()
        wait_until(lambda: letter in self.waiting(), MOST_SECONDS, f"{letter} is found")
        wrong = self.master.tell(f"aquarama-hall nodes assign hall.txtpb {letter} right AAAA-AAAA 2>&1")
        assert "this is not the code on its screen" in wrong, wrong
        said = self.master.tell(f"aquarama-hall nodes assign hall.txtpb {letter} right {code} 2>&1", 600)
        print("assigned:", said.strip(), flush=True)
        self.spare.tell("systemctl restart --no-block aquarama-node@Virtual-1")  # with its window again

    def await_out(self, channel):
        """The node whose channel another machine has now: the master knows its key no more. It keeps its picture, as
        any node without a master does. Its service is removed, as the guide says."""
        log = f"journalctl -b --no-pager -n 3 -u aquarama-node@{channel}"
        wait_until(lambda: "no master answers" in self.master.tell(log), MOST_SECONDS, f"the first {channel} is out")
        self.master.tell(f"rm /etc/aquarama/nodes/{channel}.conf; sync")

    # --- releases

    def system_of_releases(self):
        """The folder that becomes the root of each release: that of the image, and what makes faults of it."""
        tree = self.folder / "tree"
        called("mcopy", "-n", "-i", self.master.system(), f"::aquarama/{self.version}/filesystem.squashfs",
               self.folder)
        called("unsquashfs", "-q", "-n", "-d", tree, self.folder / "filesystem.squashfs")
        shutil.rmtree(tree / "usr/lib/firmware", ignore_errors=True)  # of no use here, and long to copy
        shutil.copy(tree / "usr/bin/aquarama-node", tree / "usr/lib/aquarama/aquarama-node")
        (self.folder / "blind.c").write_text(BLIND)
        called("cc", "-shared", "-fPIC", "-o", tree / "usr/lib/aquarama/blind.so", self.folder / "blind.c", "-lepoxy")
        return tree

    def make_release(self, version, tree):
        """A release of another version, in the depot of the master's machine, which is off."""
        release = self.folder / version
        release.mkdir()
        for file in ("vmlinuz", "initrd.img"):
            called("mcopy", "-n", "-i", self.master.system(), f"::aquarama/{self.version}/{file}", release)
        (tree / "usr/lib/aquarama/image/version").write_text(f"{version}\n")
        node = tree / "usr/bin/aquarama-node"
        if version in FAULTS:
            node.write_text(FAULTS[version])
        called("mksquashfs", tree, release / "filesystem.squashfs", "-comp", "zstd", "-Xcompression-level", "3",
               "-no-progress")
        shutil.copy(tree / "usr/lib/aquarama/aquarama-node", node)
        self.serial += 1
        sign_release(release, version, self.key, self.serial)
        self.master.put_in_data(release, "/var/lib/aquarama/releases")
        shutil.rmtree(release)

    def status(self):
        return self.master.tell("aquarama-hall release status hall.txtpb 2>&1")

    def await_status(self, what):
        wait_until(lambda: re.search(what, self.status()), MOST_SECONDS, f"{what}: {self.status()}")

    def allow(self, seconds):
        """So long all machines may take to show a release."""
        self.master.tell(f"echo 'DEPOT=\"--frames 20 --seconds {seconds}\"' >/etc/aquarama/depot.conf; sync; "
                         "systemctl try-restart --no-block aquarama-depot")

    def begin_depot(self):
        """The second machine follows it by itself, as its key names it."""
        self.allow(1200)
        self.master.tell("echo 'FOLLOW=\"--key /etc/aquarama/keys/hall/crew.key\"' >/etc/aquarama/follow.conf; "
                         "install -d -o aquarama -g aquarama /var/lib/aquarama/releases; sync; "
                         "systemctl start --no-block aquarama-depot aquarama-follow")
        self.await_status(f"all run {re.escape(self.version)}")
        assert "Virtual-1.key" in self.spare.tell("cat /etc/aquarama/follow.conf")

    def boots_of(self, machine):
        return machine.tell("cat /usr/lib/aquarama/image/version").strip()

    def activate(self, version, cuts=0):
        """Stages it and says go; one of both loses its power so often meanwhile."""
        said = self.master.tell(f"aquarama-hall release stage hall.txtpb {version} 2>&1", 900)
        print(f"stage {version}: {said.strip()}", flush=True)
        for _ in range(cuts):
            time.sleep(random.uniform(1, 120))
            machine = random.choice(self.machines)
            machine.cut_power()
            is_longer = machine.lengthen_chain(f"aquarama/{version}/filesystem.squashfs", 100)
            print(f"{machine.name} loses its power: {sorted(machine.entries())}"
                  f"{', with a chain too long' if is_longer else ''}", flush=True)
            machine.power_on()
        self.await_status("all machines have it")
        print(self.master.tell("aquarama-hall release go hall.txtpb 2>&1").strip(), flush=True)

    def take_releases(self, cuts):
        """Returns how many seconds passed from the word until 9.1 was good on both."""
        self.master.power_on()
        self.await_shown(self.master, "left", "middle")
        self.activate("9.1", cuts)
        began = time.monotonic()
        self.await_status(r"all run 9\.1")
        needed = round(time.monotonic() - began)
        print(f"both run 9.1 {needed} s after the word", flush=True)
        self.await_released("9.1")
        return needed

    def await_released(self, version):
        self.await_shown(self.master, "left", "middle")
        self.await_shown(self.spare, "right")
        assert {self.boots_of(machine) for machine in self.machines} == {version}

    def leave_again(self, version):
        self.activate(version)
        began = time.monotonic()
        self.await_status(rf"release {re.escape(version)} was left: \S+ has presented 0 of 20 frames")
        self.await_status(r"all run 9\.1")
        print(f"both run 9.1 again {round(time.monotonic() - began)} s after the word\n{self.status()}", flush=True)
        if version == "9.4":
            assert "draws a black picture" in self.spare.log(), "it was left for another reason"
        self.await_released("9.1")


def main(image, pictures, screens, key, cuts="2"):
    with tempfile.TemporaryDirectory(prefix="aquarama-", dir="/var/tmp") as folder:
        hall = Hall(Path(folder), Path(image), Path(pictures), Path(screens), Path(key).resolve())
        try:
            hall.master.power_on()
            hall.await_shown(hall.master, "left", "middle", "right")
            hall.keep(hall.master, "hall")
            hall.spare.power_on()
            wait_until(hall.waiting, MOST_SECONDS, "the second machine waits for its channel")
            print(f"the second machine is found {hall.spare.since_power()} s after its power", flush=True)
            print(hall.spare.tell("networkctl --no-pager list; ip -4 -brief address").strip(), flush=True)
            hall.keep(hall.spare, "letter")
            hall.assign()
            hall.await_shown(hall.spare, "right")
            hall.keep(hall.spare, "spare")
            hall.await_out("right")
            hall.begin_depot()
            hall.spare.cut_power()
            hall.spare.power_on()
            hall.await_shown(hall.spare, "right")
            print("it comes back with its channel after a power cut", flush=True)
            hall.master.cut_power()
            tree = hall.system_of_releases()
            for version in ("9.1", *FAULTS):
                hall.make_release(version, tree)
            needed = hall.take_releases(int(cuts))
            hall.allow(needed * 5 // 4)
            for version in FAULTS:
                hall.leave_again(version)
        except BaseException:
            for machine in hall.machines:
                serial = machine.folder / "serial"
                if serial.exists():
                    shutil.copy(serial, Path(screens) / f"{machine.name}.log")
                if machine.process:
                    hall.keep(machine, f"failed-{machine.name}")
            raise
        finally:
            hall.end()


if __name__ == "__main__":
    main(*sys.argv[1:])
