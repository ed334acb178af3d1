"""The scripts of the image for a stick, with pretended disks."""

import os
import shutil
import socket
import subprocess
import tempfile
import unittest
from pathlib import Path

IMAGE = Path(__file__).resolve().parents[2] / "packaging/image"
DISKS = """sda disk 7.5G USB stick
sdb disk 238G Disk of a machine
nvme0n1 disk 1T
loop0 loop 440M
sr0 rom 1G DVD
zram0 disk 4G
"""


class Machine:
    """A folder with the scripts, and programs that write down how they are called."""

    def __init__(self, folder, stick="sda"):
        self.folder, self.calls = folder, folder / "calls"
        for script in ("install", "entry", "partition"):
            shutil.copy(IMAGE / script, folder)
        (folder / "version").write_text("1.2.3\n")
        (folder / "disks").write_text(DISKS)
        self.program("lsblk", f'[ "$1" = -no ] && echo "{stick}" || cat {folder}/disks')
        self.program("findmnt", "echo /dev/sda1")
        self.program("logger", "true")
        self.program("wipefs", f'echo "wipefs $*" >>{self.calls}; exit 1')

    def program(self, name, text):
        path = self.folder / "bin" / name
        path.parent.mkdir(exist_ok=True)
        path.write_text("#!/bin/sh\n" + text + "\n")
        path.chmod(0o755)

    def install(self, typed):
        path = f"{self.folder}/bin:{os.environ['PATH']}"
        return subprocess.run([self.folder / "install"], input=typed, capture_output=True, text=True, timeout=30,
                              env=os.environ | {"PATH": path})

    def called(self):
        return self.calls.read_text() if self.calls.exists() else ""


class Installer(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def test_lists_the_disks_but_for_the_stick(self):
        said = Machine(self.folder).install("\n").stdout
        listed = [line.split()[0] for line in said.splitlines() if line.startswith("    ")]
        self.assertEqual(listed[:len(listed) // 2], ["sdb", "nvme0n1"])

    def test_takes_no_name_that_is_not_in_the_list(self):
        machine = Machine(self.folder)
        for name in ("", "sda", "sd", "sdb1", "/dev/sdb", "loop0", ".*", "s.b"):
            self.assertIn(f'there is no disk "{name}" here', machine.install(name + "\n").stdout)
        self.assertEqual(machine.called(), "")

    def test_erases_the_disk_that_was_named_and_says_when_it_cannot(self):
        machine = Machine(self.folder)
        said = machine.install("sdb\n").stdout
        self.assertEqual(machine.called(), "wipefs -qaf /dev/sdb\n")
        self.assertIn("it could not be installed on sdb", said)

    def test_takes_no_other_word_behind_the_disk_than_node(self):
        machine = Machine(self.folder)
        said = machine.install("sdb nod\n")
        self.assertIn('"nod" says nothing; type sdb or sdb node', said.stdout)
        self.assertEqual(machine.called(), "")
        self.assertIn("it could not be installed on sdb", machine.install("sdb node\n").stdout)
        self.assertEqual(machine.called(), "wipefs -qaf /dev/sdb\n")

    def test_ends_where_it_does_not_know_its_own_stick(self):
        machine = Machine(self.folder, stick="")
        ended = machine.install("sdb\n")
        self.assertNotEqual(ended.returncode, 0)
        self.assertIn("the stick is not found", ended.stderr)
        self.assertEqual(machine.called(), "")


class Entry(unittest.TestCase):
    def entry(self, mode):
        return subprocess.run([IMAGE / "entry", "1.2.3", mode, "0a-1b"], capture_output=True, text=True,
                              check=True).stdout

    def test_names_release_mode_and_data(self):
        lines = dict(line.split(" ", 1) for line in self.entry("show").splitlines())
        self.assertEqual(lines["linux"], "/aquarama/1.2.3/vmlinuz")
        words = lines["options"].split()
        for word in ("boot=live", "live-media-path=/aquarama/1.2.3", "aquarama.mode=show", "aquarama.data=0a-1b",
                     "panic=5", "loglevel=0"):
            self.assertIn(word, words)

    def test_orders_releases_by_their_serial(self):
        def lines(*serial):
            return subprocess.run([IMAGE / "entry", "1.2.3", "show", "0a-1b", *serial], capture_output=True, text=True,
                                  check=True).stdout.splitlines()
        self.assertEqual(lines("17")[1:3], ["sort-key aquarama", "version 17"])
        self.assertEqual(lines()[1:3], ["sort-key aquarama", "version 0"])  # nobody has signed it

    def test_only_the_show_is_black_and_starts_anew_after_a_panic(self):
        for mode in ("install", "rescue"):
            self.assertIn(f"aquarama.mode={mode}", self.entry(mode))
            self.assertNotIn("panic=", self.entry(mode))
        self.assertEqual(self.entry("node").replace("node", "show"), self.entry("show"))


class Channels(unittest.TestCase):
    """Which channels a machine has, by pretended connectors and service manager."""

    def channels(self, mode, monitors=(), keys=(), files=()):
        """The names that are started, and the files of configuration afterwards."""
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary)
            for name in ("nodes", "lib", "drm"):
                (folder / name).mkdir()
            for name in monitors:
                (folder / "drm" / name).mkdir()
                (folder / "drm" / name / "status").write_text("connected\n")
            (folder / "drm/card0-DP-7").mkdir()
            (folder / "drm/card0-DP-7/status").write_text("disconnected\n")
            (folder / "cmdline").write_text(f"quiet aquarama.mode={mode} aquarama.data=0a-1b\n")
            for name in keys:
                (folder / "lib" / f"{name}.key").touch()
            for name in files:
                (folder / "nodes" / f"{name}.conf").write_text("NODE=own\n")
            script = (IMAGE / "channels").read_text()
            for old, new in (("/etc/aquarama/nodes", "nodes"), ("/var/lib/aquarama", "lib"),
                             ("/sys/class/drm", "drm"), ("/proc/cmdline", "cmdline"), ("/proc/driver", "driver"),
                             ("/run/aquarama-channels", "started")):
                self.assertIn(old, script)
                script = script.replace(old, str(folder / new))
            for name, text in (("systemctl", 'echo "$*"'), ("udevadm", "true")):
                (folder / name).write_text(f"#!/bin/sh\n{text}\n")
                (folder / name).chmod(0o755)

            def said(word):
                return subprocess.run(["sh", "-c", script, "channels", word], check=True, capture_output=True,
                                      text=True, env=os.environ | {"PATH": f"{folder}:{os.environ['PATH']}"}
                                      ).stdout.splitlines()
            self.assertEqual(said("list") + said("stop"), [], "nothing was started")
            started = said("start")
            # A monitor that comes later, and a file that goes, are for the next start.
            (folder / "drm/card0-DP-7/status").write_text("connected\n")
            names = [line.removeprefix("start --no-block aquarama-node@") for line in started]
            self.assertEqual(said("list"), names)
            self.assertEqual(said("stop"), [f"stop aquarama-node@{name}" for name in names])
            return names, {file.stem: file.read_text().replace(str(folder), "") for file in folder.glob("nodes/*")}

    def test_of_a_hall_are_those_of_its_files(self):
        self.assertEqual(self.channels("show", ["card0-HDMI-A-1"], files=["left", "right"])[0], ["left", "right"])
        self.assertEqual(self.channels("show")[0], [])

    def test_of_a_machine_that_waits_are_its_monitors_and_what_it_was_given(self):
        names, files = self.channels("node", ["card0-HDMI-A-1", "card1-DP-2"], ["HDMI-A-3"], ["left"])
        self.assertEqual(names, ["DP-2", "HDMI-A-1", "HDMI-A-3"])
        self.assertEqual(files["DP-2"], "NODE=--key /lib/DP-2.key --wait-for-key --connector DP-2\n")

    def test_without_monitors_it_waits_for_them_and_stays_one(self):
        names, files = self.channels("node")
        self.assertEqual(names, ["any"])
        self.assertEqual(files["any"], "NODE=--key /lib/any.key --wait-for-key \n")
        self.assertEqual(self.channels("node", ["card0-HDMI-A-1"], ["any"])[0], ["any"])

    def test_a_file_of_the_crew_stays(self):
        self.assertEqual(self.channels("node", ["card0-DP-2"], files=["DP-2"]), (["DP-2"], {"DP-2": "NODE=own\n"}))


class Frames(unittest.TestCase):
    """What the agent is told of the nodes, by a pretended service manager."""

    def frames(self, **said):
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary)
            for name, text in (("channels", "\n".join(f"echo {channel}" for channel in said)),
                               ("systemctl", "cat " + temporary + "/${5#aquarama-node@}")):
                (folder / name).write_text("#!/bin/sh\n" + text + "\n")
                (folder / name).chmod(0o755)
            for channel, status in said.items():
                (folder / channel).write_text(status + "\n")
            shutil.copy(IMAGE / "machine", folder)
            return subprocess.run([folder / "machine", "frames"], capture_output=True, text=True, check=True,
                                  timeout=30, env=os.environ | {"PATH": f"{temporary}:{os.environ['PATH']}"}).stdout

    def test_are_those_of_the_channel_that_has_presented_the_fewest(self):
        self.assertEqual(self.frames(left="frame 700", right="frame 90"), "90\n")
        self.assertEqual(self.frames(left="frame 700", right="waits for the master"), "0\n")
        self.assertEqual(self.frames(left="frame 700", right=""), "0\n")
        self.assertEqual(self.frames(), "")

    def test_are_none_of_a_node_that_waits_for_its_channel(self):
        self.assertEqual(self.frames(waiting="waits for a channel as Q"), "")
        self.assertEqual(self.frames(left="frame 700", waiting="waits for a channel"), "700\n")


class Adoption(unittest.TestCase):
    """A machine that is given its channel follows the depot that its key names."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        for name, text in (("systemctl", f'echo "$*" >>{self.folder}/calls'),
                           ("channels", f'echo "channels $*" >>{self.folder}/calls')):
            (self.folder / name).write_text(f"#!/bin/sh\n{text}\n")
            (self.folder / name).chmod(0o755)
        (self.folder / "release.pub").touch()
        self.depot = socket.create_server(("127.0.0.1", 0))
        self.addCleanup(self.depot.close)

    def adopt(self):
        """What the script asks of the service manager."""
        (self.folder / "calls").write_text("")
        script = (IMAGE / "adopt").read_text()
        for path in ("/var/lib/aquarama", "/etc/aquarama"):
            self.assertIn(path, script)
            script = script.replace(path, str(self.folder))
        (self.folder / "adopt").write_text(script)
        subprocess.run(["sh", self.folder / "adopt"], check=True,
                       env=os.environ | {"PATH": f"{self.folder}:{os.environ['PATH']}"})
        return (self.folder / "calls").read_text()

    def give(self, connector, depot=True):
        named = f'depot_address: "tcp://127.0.0.1:{self.depot.getsockname()[1]}"\n' if depot else ""
        (self.folder / f"{connector}.key").write_text('rig: "hall"\n' + named)

    def followed(self):
        file = self.folder / "follow.conf"
        return file.read_text().splitlines()[-1] if file.exists() else None

    def line(self, connector):
        return f'FOLLOW="--key {self.folder}/{connector}.key"'

    def test_while_a_key_names_one(self):
        self.give("DP-1", depot=False)
        self.assertEqual((self.adopt(), self.followed()), ("", None))
        self.give("HDMI-A-1")
        self.assertEqual((self.adopt(), self.followed()),
                         ("restart --no-block aquarama-follow\n", self.line("HDMI-A-1")))
        self.assertEqual(self.adopt(), "", "nothing has changed")
        self.give("DP-1")
        (self.folder / "HDMI-A-1.key").unlink()
        self.assertEqual((self.adopt(), self.followed()), ("restart --no-block aquarama-follow\n", self.line("DP-1")))
        (self.folder / "DP-1.key").unlink()
        self.assertEqual((self.adopt(), self.followed()), ("stop aquarama-follow\nchannels start\n", None))

    def test_not_before_the_depot_is_there_and_also_while_it_is_away(self):
        self.give("DP-1")
        address = self.depot.getsockname()
        self.depot.close()
        self.assertEqual((self.adopt(), self.followed()), ("", None))
        self.depot = socket.create_server(address)
        self.assertEqual(self.adopt(), "restart --no-block aquarama-follow\n")
        self.depot.close()
        self.assertEqual((self.adopt(), self.followed()), ("", self.line("DP-1")))

    def test_not_against_the_crew_and_not_where_the_image_takes_no_releases(self):
        self.give("DP-1")
        (self.folder / "follow.conf").write_text("FOLLOW=own\n")
        self.assertEqual((self.adopt(), self.followed()), ("", "FOLLOW=own"))
        (self.folder / "follow.conf").unlink()
        (self.folder / "release.pub").unlink()
        self.assertEqual((self.adopt(), self.followed()), ("", None))


class Signature(unittest.TestCase):
    def test_of_an_image_is_what_machines_take(self):
        aquarama = Path(os.environ["AQUARAMA_BIN"]) / "aquarama"
        with tempfile.TemporaryDirectory() as temporary:
            release, key = Path(temporary) / "1.2.3", Path(temporary) / "show.key"
            release.mkdir()
            for file in ("vmlinuz", "initrd.img", "filesystem.squashfs"):
                (release / file).write_text(file)
            subprocess.run([aquarama, "release", "key", "new", key], check=True, capture_output=True)
            sign = (f"source <(sed -n '/^sign()/,/^}}/p' {IMAGE.parent}/build-image); key={key} version=1.2.3; "
                    f"sign {release} 17")
            subprocess.run(["bash", "-euc", sign], check=True)
            checked = subprocess.run([aquarama, "release", "check", release, "--key", f"{key}.pub"],
                                     capture_output=True, text=True)
            self.assertEqual((checked.stderr, checked.stdout),
                             ("", "release 1.2.3 is as it was signed: serial 17, 3 files\n"))


if __name__ == "__main__":
    unittest.main()
