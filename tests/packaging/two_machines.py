"""two_machines.py IMAGE PICTURES SCREENS: a hall on one emulated machine, and a second one that waits for its channel.

IMAGE has the hall of packaging/try-image.sh: its machine gives addresses to others. Both start from that image, the
second by the entry "node". Its letter is found by the first, its code is typed there, and it takes the place of the
first one's right channel. It comes back with it after a power cut. PICTURES has what the channels show without a
display; screens are left in SCREENS as try-*.ppm.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from emulated import Machine, picture, wait_until

MOST_SECONDS = 1800  # until a picture is there
CABLE = 7490
WIDTH = 160  # of a channel, in pixels


class Hall:
    def __init__(self, folder, image, pictures, screens):
        self.screens = screens
        disks = {name: folder / f"{name}.img" for name in ("master", "spare")}
        for disk in disks.values():
            subprocess.run(["cp", "--sparse=always", image, disk], check=True)
        self.master, self.spare = (Machine(folder, name, disk, CABLE) for name, disk in disks.items())
        self.spare.write("loader/loader.conf", "timeout 0\ndefault aquarama-node.conf\n")
        self.picture = {name: (picture(pictures / f"channel-{name}.png"), left * WIDTH)
                        for left, name in enumerate(("left", "middle", "right"))}

    def end(self):
        self.master.cut_power()
        self.spare.cut_power()

    def keep(self, machine, name):
        machine.keep_screen(self.screens / f"try-{name}.ppm")

    def await_shown(self, machine, *channels):
        wanted = {name: self.picture[name] for name in channels}
        wait_until(lambda: machine.shows(**wanted), MOST_SECONDS, f"{machine.name} shows {', '.join(channels)}")
        print(f"{machine.name} shows {', '.join(channels)} {machine.since_power()} s after its power", flush=True)

    def waiting(self):
        """Letters of the machines that wait, as the master's machine finds them."""
        said = self.master.tell("aquarama nodes waiting")
        return re.findall(r"^([A-Z])\b", said, re.MULTILINE)

    def code(self):
        """Nobody reads the screen here: a node without windows says its code in its log."""
        self.spare.tell("sed -i 's/--wait-for-key/& --headless/' /etc/aquarama/nodes/waiting.conf; "
                        "systemctl restart aquarama-node@waiting")
        found = wait_until(lambda: re.findall(r"as ([A-Z]), code (\S+)", self.spare.tell(
            "journalctl -b --no-pager -u aquarama-node@waiting")), MOST_SECONDS, "a code")
        self.spare.tell("sed -i 's/ --headless//' /etc/aquarama/nodes/waiting.conf")
        return found[-1]

    def assign(self):
        letter, code = self.code()
        wait_until(lambda: letter in self.waiting(), MOST_SECONDS, f"{letter} is found")
        wrong = self.master.tell(f"aquarama-hall nodes assign hall.txtpb {letter} right AAAA-AAAA 2>&1")
        assert "this is not the code on its screen" in wrong, wrong
        said = self.master.tell(f"aquarama-hall nodes assign hall.txtpb {letter} right {code} 2>&1", 600)
        print("assigned:", said.strip(), flush=True)
        self.spare.tell("systemctl restart aquarama-node@waiting")  # with its window again


def main(image, pictures, screens):
    with tempfile.TemporaryDirectory(prefix="aquarama-", dir="/var/tmp") as folder:
        hall = Hall(Path(folder), Path(image), Path(pictures), Path(screens))
        try:
            hall.master.power_on(listens=True)
            hall.await_shown(hall.master, "left", "middle", "right")
            hall.keep(hall.master, "hall")
            hall.spare.power_on(listens=False)
            wait_until(hall.waiting, MOST_SECONDS, "the second machine waits for its channel")
            print(f"the second machine is found {hall.spare.since_power()} s after its power", flush=True)
            print(hall.spare.tell("networkctl --no-pager list; ip -4 -brief address").strip(), flush=True)
            hall.keep(hall.spare, "letter")
            hall.assign()
            hall.await_shown(hall.spare, "right")
            hall.keep(hall.spare, "spare")
            hall.keep(hall.master, "hall-without-right")
            assert not hall.master.shows(right=hall.picture["right"]), "two machines show one channel"
            hall.spare.cut_power()
            hall.spare.power_on(listens=False)
            hall.await_shown(hall.spare, "right")
            print("it comes back with its channel after a power cut", flush=True)
        except BaseException:
            for machine in (hall.master, hall.spare):
                serial = machine.folder / "serial"
                if serial.exists():
                    shutil.copy(serial, Path(screens) / f"{machine.name}.log")
            raise
        finally:
            hall.end()


if __name__ == "__main__":
    main(*sys.argv[1:])
