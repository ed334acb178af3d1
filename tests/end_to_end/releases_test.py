"""Real processes: a depot and the agents of three machines, with keys over a network card, bring releases to all
machines together.

A pretended machine has a folder as its system partition, and starts as a boot loader that counts tries does. When which
machine shows which release stands in one log: at no moment are there two. AQUARAMA_POWER_CUTS is how often a machine,
or the depot, loses its power at a random moment of an update; without it six times.
"""

import contextlib
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

from show import BIN, ROOT, aquarama, end, rig_on_free_ports, temporary_folder, wait_until

ADDRESS = "192.0.2.77"
POWER_CUTS = int(os.environ.get("AQUARAMA_POWER_CUTS", "6"))
FILES = ("vmlinuz", "initrd.img", "filesystem.squashfs")

# What the agent asks of its machine (docs/releases.md). As long as it shows it presents a hundred frames a second.
MACHINE = """#!/bin/sh
cd "$(dirname "$0")"
log() { echo "$(date +%s.%N) $1 $(cat name) $(cat booted)" >>../shown; }
case $1 in
    started) echo "$(cat booted) $(cat boot)" ;;
    show) touch lit; date +%s%N >since; log show ;;
    dark) rm -f lit; log dark ;;
    frames)
        if [ ! -f lit ] || [ -f blind-"$(cat booted)" ]; then echo 0; exit; fi
        echo $((($(date +%s%N) - $(cat since)) / 10000000))
        ;;
    entry) printf 'title Aquarama %s\\nversion %s\\nlinux /aquarama/%s/vmlinuz\\n' "$2" "$3" "$2" ;;
    reboot) touch reboots ;;
esac
"""


class Machine:
    """A machine of the hall: its disk, its boot loader, and the agent that runs on it."""

    def __init__(self, hall, name, key):
        self.hall, self.name, self.key = hall, name, key
        self.folder = hall.folder / name
        self.system = self.folder / "system"
        self.entries = self.system / "loader/entries"
        self.entries.mkdir(parents=True)
        shutil.copytree(hall.releases / "1.0", self.system / "aquarama/1.0")
        self.program = self.folder / "machine"
        self.program.write_text(MACHINE)
        self.program.chmod(0o755)
        self.put("name", name)
        self.put("data", "a calibration")
        (self.entries / "aquarama-1.0.conf").write_text("title Aquarama 1.0\nlinux /aquarama/1.0/vmlinuz\n")
        self.agent, self.boots, self.mute = None, 0, set()

    def put(self, name, text):
        (self.folder / name).write_text(text)

    def booted(self):
        return (self.folder / "booted").read_text()

    def is_lit(self):
        return (self.folder / "lit").exists()

    def release_of(self, entry):
        """(serial, version, tries left) of an entry's file; it must lead to a whole release."""
        version, _, tries = re.fullmatch(r"aquarama-([\w.]+?)(\+(\d+)(?:-\d+)?)?\.conf", entry.name).groups()
        head = (self.system / "aquarama" / version / "SHA256SUMS").read_text().splitlines()[0]
        return int(head.split()[-1]), version, None if tries is None else int(tries)

    def power_on(self):
        """Starts the newest release that has tries left. Whatever happened before, there must be one, and whole."""
        candidates = [(self.release_of(entry), entry) for entry in self.entries.glob("aquarama-*.conf")]
        (_, version, tries), entry = max(c for c in candidates if c[0][2] != 0)
        done = aquarama("release", "check", self.system / "aquarama" / version, "--key", self.hall.open_key)
        assert done.returncode == 0, done.stderr
        assert (self.folder / "data").read_text() == "a calibration"
        if tries is not None:
            entry.rename(self.entries / f"aquarama-{version}+{tries - 1}-{3 - tries + 1}.conf")
        self.boots += 1
        self.put("booted", version)
        self.put("boot", str(self.boots))
        (self.folder / "reboots").unlink(missing_ok=True)
        if version not in self.mute:
            self.start_agent()
            return
        self.power_on()  # it does not come so far, and starts anew

    def start_agent(self):
        environment = os.environ | {"XDG_STATE_HOME": str(self.folder / "state")}
        with open(self.hall.folder / "log", "a") as log:
            self.agent = subprocess.Popen(
                [BIN / "aquarama", "release", "follow", "--key", self.key, "--system", self.system, "--machine",
                 self.program, "--signed-by", self.hall.open_key],
                env=environment, stdout=log, stderr=log, start_new_session=True)

    def kill_agent(self):
        """With what it has started."""
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.agent.pid, signal.SIGKILL)
        self.agent.wait()

    def power_off(self):
        """All that runs on it ends at once."""
        if self.agent:
            self.kill_agent()
        subprocess.run([self.program, "dark"], check=True)

    def look(self):
        """As the service manager, and the machine itself, do."""
        if self.agent and self.agent.poll() is not None:
            if (self.folder / "reboots").exists():
                self.power_off()
                self.power_on()
            else:
                self.start_agent()


class Hall:
    """A rig of three machines, its keys, its depot."""

    def __init__(self, folder):
        self.folder = folder
        (folder / "shown").touch()
        self.releases = folder / "depot"
        self.key = folder / "show.key"
        self.open_key = folder / "show.key.pub"
        assert aquarama("release", "key", "new", self.key).returncode == 0
        self.rig = rig_on_free_ports(folder, replace=[
            (r"tcp://127\.0\.0\.1", f"tcp://{ADDRESS}"),
            (r'(  watch: "tcp://\S+):(\d+)".*', r'\1:\2"' + f'\n  depot: "tcp://{ADDRESS}:7999"'),
            (r'name: "middle"', 'name: "middle" machine: "b"'), (r'name: "right"', 'name: "right" machine: "c"')])
        self.keys = folder / "keys"
        assert aquarama("keys", "new", self.rig, "--keys", self.keys).returncode == 0
        self.release("1.0")
        self.depot = None
        self.start_depot()
        self.machines = [Machine(self, "main", self.keys / "crew.key"), Machine(self, "b", self.keys / "middle.key"),
                         Machine(self, "c", self.keys / "right.key")]
        for machine in self.machines:
            machine.power_on()

    def release(self, version, size=3_000_000):
        """Makes one, signed in a later second than those before."""
        folder = self.releases / version
        folder.mkdir(parents=True)
        for file in FILES:
            (folder / file).write_bytes(f"{file} of {version}".encode() + random.randbytes(size))
        time.sleep(1.05)
        done = aquarama("release", "sign", folder, "--key", self.key)
        assert done.returncode == 0, done.stderr

    def start_depot(self):
        with open(self.folder / "log", "a") as log:
            self.depot = subprocess.Popen(
                [BIN / "aquarama", "release", "serve", self.rig, "--depot", self.releases, "--keys", self.keys,
                 "--signed-by", self.open_key, "--frames", "100", "--seconds", "15"],
                env=os.environ | {"XDG_STATE_HOME": str(self.folder / "state")}, stdout=log, stderr=log)

    def ask(self, what, *arguments, key="crew"):
        return aquarama("release", what, self.rig, *arguments, "--key", self.keys / f"{key}.key")

    def status(self):
        time.sleep(0.2)  # a process each time
        return json.loads(self.ask("status", "--json").stdout)

    def reads(self, version):
        """Whether the depot has a file of this release open."""
        for file in Path(f"/proc/{self.depot.pid}/fd").iterdir():
            with contextlib.suppress(FileNotFoundError):
                if f"/{version}/" in os.readlink(file):
                    return True
        return False

    def look(self):
        if self.depot.poll() is not None:
            self.start_depot()
        for machine in self.machines:
            machine.look()

    def wait_for(self, condition, what, seconds=120):
        def holds():
            self.look()
            return condition()
        wait_until(holds, seconds, f"{what}; {(self.folder / 'log').read_text()[-3000:]}")

    def wait_for_wall(self, version):
        self.wait_for(lambda: all(machine.booted() == version and machine.is_lit() for machine in self.machines),
                      f"{version} on the wall")

    def stage(self, version):
        done = self.ask("stage", version)
        assert done.returncode == 0, done.stderr
        self.wait_for(lambda: self.status()["ready"], f"{version} on all machines")

    def go_on(self):
        """Says go as soon as it can be said; whether the update has ended."""
        self.look()
        status = self.status()
        if status["ready"]:
            self.ask("go")
        return status["phase"] == "settled"

    def cut(self, chance):
        """A machine loses its power, an agent dies, or the depot does."""
        machine = chance.choice(self.machines)
        victim = chance.choice(["machine", "machine", "agent", "depot"])
        if victim == "machine":
            machine.power_off()
            machine.power_on()
        elif victim == "agent":
            machine.kill_agent()
        else:
            self.depot.kill()
            self.depot.wait()

    def end(self):
        for machine in self.machines:
            machine.power_off()
        end([self.depot])

    def expect_one_release_shown(self, test):
        """At no moment of the log."""
        shown = {}
        for line in sorted((self.folder / "shown").read_text().splitlines(), key=lambda line: float(line.split()[0])):
            _, what, machine, version = line.split()
            shown.pop(machine, None)
            if what == "show":
                shown[machine] = version
            test.assertLessEqual(len(set(shown.values())), 1, line)


class Releases(unittest.TestCase):
    def setUp(self):
        temporary = temporary_folder()
        self.addCleanup(temporary.cleanup)
        self.hall = Hall(Path(temporary.name))
        self.addCleanup(self.hall.end)
        self.hall.wait_for_wall("1.0")
        self.hall.wait_for(lambda: self.hall.status()["stable"], "the depot knows what runs")

    def tearDown(self):
        self.hall.expect_one_release_shown(self)

    def test_all_machines_come_to_a_release_together(self):
        self.hall.release("1.1")
        self.hall.stage("1.1")
        self.assertTrue(all(machine.booted() == "1.0" and machine.is_lit() for machine in self.hall.machines))
        self.assertEqual(self.hall.ask("go").returncode, 0)
        self.hall.wait_for_wall("1.1")
        self.hall.wait_for(lambda: self.hall.status()["phase"] == "settled", "it is good")
        self.hall.wait_for(lambda: all((m.entries / "aquarama-1.1.conf").exists() for m in self.hall.machines),
                           "blessed everywhere")
        self.assertEqual(self.hall.status()["stable"]["version"], "1.1")
        self.assertEqual(self.hall.ask("back").returncode, 0)
        self.hall.wait_for_wall("1.0")

    def test_nobody_needs_to_say_go_while_the_wall_is_closed(self):
        hours = self.hall.folder / "state/aquarama/console/desk/hours.txtpb"
        hours.parent.mkdir(parents=True, exist_ok=True)
        hours.write_text('zone: "Europe/Berlin"\n')  # never open
        self.hall.release("1.1")
        self.assertEqual(self.hall.ask("stage", "1.1").returncode, 0)
        self.hall.wait_for_wall("1.1")

    def test_all_return_where_one_machine_shows_nothing(self):
        self.hall.machines[1].put("blind-1.1", "")
        self.hall.release("1.1")
        self.hall.stage("1.1")
        self.hall.ask("go")
        self.hall.wait_for(lambda: self.hall.status()["reason"], "it is left")
        self.assertRegex(self.hall.status()["reason"], r"release 1\.1 was left: b has presented 0 of 100 frames")
        self.hall.wait_for_wall("1.0")

    def test_all_return_where_one_machine_does_not_start(self):
        self.hall.machines[2].mute.add("1.1")
        self.hall.release("1.1")
        self.hall.stage("1.1")
        self.hall.ask("go")
        self.hall.wait_for(lambda: self.hall.status()["reason"], "it is left")
        self.assertEqual(self.hall.status()["reason"], "release 1.1 was left: c came back with 1.0")
        self.hall.wait_for_wall("1.0")

    def test_power_cuts_leave_the_old_or_the_new_on_all(self):
        chance = random.Random(7)
        taken = 0
        updates = (POWER_CUTS + 1) // 2
        for update in range(updates):
            version = f"1.{update + 1}"
            self.hall.release(version)
            self.hall.ask("stage", version)
            for _ in range(2):
                for _ in range(chance.randrange(1, 40)):
                    self.hall.go_on()
                self.hall.cut(chance)
            self.hall.wait_for(self.hall.go_on, "an end")
            stable = self.hall.status()["stable"]["version"]
            taken += stable == version
            self.hall.wait_for_wall(stable)
        print(f"{2 * updates} power cuts: {taken} of {updates} releases were taken")

    def test_what_is_not_as_it_was_signed_is_refused_by_name(self):
        def refuses(version, said):
            done = self.hall.ask("stage", version)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertRegex(done.stderr, said)
            self.assertEqual(done.stderr.count("\n"), 1)
        folder = self.hall.releases / "1.1"
        self.hall.release("1.1")
        whole = (folder / "vmlinuz").read_bytes()
        (folder / "vmlinuz").write_bytes(whole[:-1])
        refuses("1.1", r"release 1\.1: vmlinuz in \S+ was changed or cut")
        (folder / "vmlinuz").write_bytes(b"x" + whole[1:])
        refuses("1.1", r"release 1\.1: vmlinuz in \S+ was changed or cut")
        (folder / "vmlinuz").write_bytes(whole)
        refuses("1.2", r"1\.2")
        refuses("1.0", r"release 1\.0 \(serial \d+\) is not newer than 1\.0")
        self.assertRegex(self.hall.ask("stage", "1.1", key="watcher").stderr, "only the crew changes the release")
        self.assertRegex(self.hall.ask("go").stderr, "no release waits")

    def staged_meanwhile(self, version):
        """Stages a release; the refusal of another that is staged, and the status, while the depot checks the first.
        None where that was over too soon."""
        stage = subprocess.Popen([BIN / "aquarama", "release", "stage", self.hall.rig, version, "--key",
                                  self.hall.keys / "crew.key"], stdout=subprocess.DEVNULL)
        while stage.poll() is None and not self.hall.reads(version):
            time.sleep(0.01)
        other, status = self.hall.ask("stage", "1.0").stderr, self.hall.status()
        was_checked = stage.poll() is None
        self.assertEqual(stage.wait(), 0)
        return (other, status) if was_checked else None

    def test_machines_are_heard_while_a_release_is_checked(self):
        self.hall.release("1.1", size=150_000_000)
        for _ in range(5):  # a machine may be quick once
            if meanwhile := self.staged_meanwhile("1.1"):
                break
            self.hall.ask("back")
        self.assertIsNotNone(meanwhile, "each check was over too soon")
        other, status = meanwhile
        self.assertEqual(other, "aquarama release stage: another release is being checked; wait for its end\n")
        self.assertEqual((status["phase"], len(status["machines"])), ("settled", 3))
        self.assertEqual(self.hall.status()["candidate"]["version"], "1.1")

    def test_a_machine_refuses_what_was_changed_after_it_was_staged(self):
        self.hall.release("1.1", size=30_000_000)
        self.assertEqual(self.hall.ask("stage", "1.1").returncode, 0)
        with open(self.hall.releases / "1.1/vmlinuz", "r+b") as file:
            file.seek(-1, os.SEEK_END)
            file.write(b"?")
        self.hall.wait_for(lambda: self.hall.status()["reason"], "it is left")
        self.assertRegex(self.hall.status()["reason"],
                         r"release 1\.1 was left: \w+: release 1\.1: vmlinuz was changed or cut after it was signed")
        self.assertEqual(self.hall.status()["phase"], "settled")
        self.hall.wait_for_wall("1.0")


if __name__ == "__main__":
    if "AQUARAMA_IN_NETWORK" not in os.environ:  # a network card of its own
        os.environ["AQUARAMA_IN_NETWORK"] = "1"
        os.execvp("unshare", ["unshare", "-rn", "sh", "-c",
                              f'ip link set lo up && ip address add {ADDRESS}/32 dev lo && exec "$@"', "sh",
                              sys.executable, *sys.argv])
    unittest.main()
