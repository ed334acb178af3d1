"""Real processes: the standby of a rig takes over from a master that is killed, held up, or ended.

AQUARAMA_TAKEOVERS is how often a master is killed; without it once. Prints how long each takeover took: until the other
machine was the master, and between two frames that a node showed.
"""

import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from show import BIN, ROOT, aquarama, end, free_ports, lacks, rig_on_free_ports, skin_png, temporary_folder, wait_until

TAKEOVERS = int(os.environ.get("AQUARAMA_TAKEOVERS", "1"))
INPUT, CHECKPOINT = 0x1A, 0x22  # first bytes of entries of a recording


def varint(data, at):
    value = shift = 0
    while True:
        byte = data[at]
        value |= (byte & 0x7F) << shift
        at, shift = at + 1, shift + 7
        if byte < 0x80:
            return value, at


def entries(recording):
    """(kind, tick, bytes) of each whole entry of a recording; only inputs and checkpoints have a tick."""
    data = recording.read_bytes()
    at = 0
    while at < len(data):
        begin = at
        length, at = varint(data, at)
        if at + length > len(data):
            return
        kind, tick = data[at], 0
        if kind in (INPUT, CHECKPOINT):
            _, inner = varint(data, at + 1)
            tick, _ = varint(data, inner + 1)
        at += length
        yield kind, tick, data[begin:at]


def joined(first, second, path):
    """A recording of `first`, as far as it goes, then what `second` says of the time after it."""
    known = list(entries(first))
    last = max(tick for _, tick, _ in known)
    after = [data for kind, tick, data in entries(second) if kind in (INPUT, CHECKPOINT) and tick > last]
    path.write_bytes(b"".join([data for _, _, data in known] + after))
    return len(after)


class Etcd:
    """One member, with the timing of docs/cluster.md."""

    def __init__(self):
        self.folder = tempfile.mkdtemp(prefix="aquarama-etcd-")
        client, peer = (f"http://127.0.0.1:{port}" for port in free_ports(2))
        self.url = client
        self.process = subprocess.Popen(
            ["etcd", "--name", "one", "--data-dir", self.folder, "--listen-client-urls", client,
             "--advertise-client-urls", client, "--listen-peer-urls", peer, "--initial-advertise-peer-urls", peer,
             "--initial-cluster", f"one={peer}", "--heartbeat-interval", "50", "--election-timeout", "500"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def end(self):
        self.process.kill()
        self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)


class Machine:
    """The process that is, or may become, the master; it keeps what it keeps in a folder of its own."""

    def __init__(self, folder, name, command, rig):
        self.folder, self.name, self.rig, self.command = Path(folder) / name, name, rig, command
        self.folder.mkdir()
        self.log = self.folder / "log"
        self.drawings = self.folder / "aquarama/shows/desk.drawings"

    def start(self):
        environment = os.environ | {"XDG_STATE_HOME": str(self.folder)}
        with self.log.open("a") as output:
            self.process = subprocess.Popen([BIN / "aquarama", *self.command, self.rig], stdout=output,
                                            stderr=subprocess.STDOUT, env=environment, cwd=ROOT)

    def says(self, text, times=1):
        return self.log.read_text().count(text) >= times

    def recordings(self):
        return sorted(self.folder.glob("aquarama/shows/desk.journal/*.aqrec"))


@unittest.skipIf(*lacks(shutil.which("etcd"), "etcd-server"))
class Standby(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder()
        self.addCleanup(self.folder.cleanup)
        self.etcd = Etcd()
        self.addCleanup(self.etcd.end)
        self.rig = rig_on_free_ports(self.folder.name)
        control, state = free_ports(2)
        with self.rig.open("a") as rig:
            rig.write(f'standby {{ machine: "spare" control: "tcp://127.0.0.1:{control}" '
                      f'state: "tcp://127.0.0.1:{state}" etcd: "{self.etcd.url}" }}\n'
                      'drawings { species: "clownfish" }\n')
        self.main = Machine(self.folder.name, "main", ["master", "--pattern", "grid"], self.rig)
        self.spare = Machine(self.folder.name, "spare", ["standby"], self.rig)
        self.main.drawings.mkdir(parents=True)
        (self.main.drawings / "list.txtpb").write_text(
            'last_number: 7 drawings { number: 7 species: "clownfish" verdict: LET_IN kept: true offered_at: 1 }')
        (self.main.drawings / "7.png").write_bytes(skin_png(200, 120, 40))
        self.main.start()
        self.spare.start()
        self.addCleanup(self.end_machines)

    def end_machines(self):
        end([self.main.process, self.spare.process])

    def has_the_drawing(self, machine):
        kept = machine.drawings / "list.txtpb"
        return (kept.exists() and "number: 7" in kept.read_text()
                and (machine.drawings / "7.png").read_bytes() == skin_png(200, 120, 40))

    def start_node(self):
        first, = re.findall(r'control: "(tcp://[^"]+)"', self.rig.read_text())[:1]
        self.node_log = Path(self.folder.name) / "node.log"
        with self.node_log.open("w") as output:
            node = subprocess.Popen([BIN / "aquarama-node", "left", "--master", first, "--headless", "--trace",
                                     self.folder.name], stdout=output, stderr=subprocess.STDOUT,
                                    env=os.environ | {"LP_NUM_THREADS": "1"}, cwd=ROOT)
        self.addCleanup(end, [node])

    def shown(self):
        """When the node showed frames, seconds of the monotonic clock."""
        trace = Path(self.folder.name) / "left.csv"
        rows = (row.split(",") for row in (trace.read_text().splitlines() if trace.exists() else []))
        return [int(row[3]) * 1e-9 for row in rows if len(row) == 4 and row[0].isdigit() and row[3]]

    def stands_by(self, machine, times=1):
        wait_until(lambda: machine.says("simulates along with the master", times), 60, "a standby in step")

    def stood_still(self, since):
        """The longest time between two frames that the node showed, once it shows them again."""
        wait_until(lambda: self.shown()[-1] > since + 1 and time.monotonic() - self.shown()[-1] < 0.5, 60,
                   "the node to show frames again")
        shown = self.shown()
        return max(after - before for before, after in zip(shown, shown[1:]) if after > since)

    def takes_over(self, new, does):
        """What is done to the master's process makes the other machine the master."""
        times = new.log.read_text().count("takes over at")
        begun = time.monotonic()
        does()
        wait_until(lambda: new.says("takes over at", times + 1), 30, "the other machine to take over")
        seconds = time.monotonic() - begun
        print(f"master after {seconds:.2f} s, the wall stood still for {self.stood_still(begun):.2f} s", flush=True)

    def is_killed(self, old, new):
        leading, following = old.recordings()[-1], new.recordings()[-1]
        self.takes_over(new, lambda: os.kill(old.process.pid, signal.SIGKILL))
        time.sleep(2.5)
        whole = Path(self.folder.name) / "whole.aqrec"
        self.assertGreater(joined(leading, following, whole), 1, "hashes of the time after")
        checked = aquarama("replay", whole, "--check")
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        self.assertIn("the replay is the same world", checked.stdout)
        old.process.wait()
        old.start()

    def is_held_up(self, old, new):
        lost = self.node_log.read_text().count("lost the master")
        self.takes_over(new, lambda: os.kill(old.process.pid, signal.SIGSTOP))
        os.kill(old.process.pid, signal.SIGCONT)
        wait_until(lambda: old.says("no longer the master: " + new.name), 30, "the former master to step down")
        self.assertFalse(new.says("no longer the master: " + old.name))
        self.assertEqual(self.node_log.read_text().count("lost the master"), lost + 1, "nothing that it said counts")

    def is_told(self, old, new):
        def tell():
            said = aquarama("set", self.rig, "master", new.name)
            self.assertEqual(said.returncode, 0, said.stdout + said.stderr)

        self.takes_over(new, tell)

    def test_the_world_goes_on_whatever_becomes_of_the_master(self):
        self.start_node()
        machines, followed = [self.main, self.spare], {self.main: 0, self.spare: 1}
        for what in [self.is_killed] * TAKEOVERS + [self.is_told, self.is_held_up]:
            old, new = machines
            self.stands_by(new, followed[new])
            wait_until(lambda: self.shown() and time.monotonic() - self.shown()[-1] < 0.5, 60, "frames")
            time.sleep(1)
            status = aquarama("status", self.rig).stdout
            self.assertIn(f"{old.name} is the master", status)
            self.assertIn(f"{new.name} simulates along", status)
            wait_until(lambda: self.has_the_drawing(new), 10, "the standby to have the drawing")
            what(old, new)
            followed[old] += 1
            machines.reverse()
        for machine in machines:
            self.assertTrue(self.has_the_drawing(machine))
            self.assertNotIn("differs from the master's", machine.log.read_text())


if __name__ == "__main__":
    unittest.main(verbosity=2)
