"""What hosts.sh runs, in namespaces of its own. Every machine is a namespace; commands run there by `ip netns exec`."""

import argparse
import fcntl
import heapq
import os
import random
import re
import select
import signal
import statistics
import struct
import subprocess
import sys
import threading
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "end_to_end"))
from show import BIN, CHANNELS, ROOT, end, temporary_folder, trace, wait_until  # noqa: E402

ADDRESS = {"master": "10.77.0.1", "left": "10.77.0.11", "middle": "10.77.0.12", "right": "10.77.0.13"}
PATIENCE = 20  # seconds: only a hang meets it
# What is promised, times three: a picture is back in two seconds, and nobody stalls for longer than a node may be
# silent and a deadline.
BACK, GAP_MS = 6, 3 * (250 + 17)


def sh(*command):
    subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True)


class Wall:
    """The machines, the rig and the keys; and the processes that run on them."""

    def __init__(self, folder):
        self.folder, self.processes = Path(folder), {}
        self.power_folder("left").mkdir(parents=True)
        self.shared = self.mixed = 0
        self.build_network()
        self.rig = self.folder / "hall.txtpb"
        text = (ROOT / "config/desk.txtpb").read_text()
        # Sixty fish: before its first picture the default scene lives for ninety seconds, of which a debug build takes
        # three, and masters are started some sixty times here.
        text = text.replace("scenes/reef.txtpb", f"{ROOT}/config/scenes/reef_1998.txtpb")
        text = text.replace("127.0.0.1", ADDRESS["master"])
        text = re.sub(r"timing \{.*?\}", "timing { refresh_hz: 60 }", text, flags=re.S)
        for side in CHANNELS:  # small pictures: the wall is to be busy with its network
            text = text.replace(f'name: "{side}"', f'name: "{side}"\n  machine: "{side}-pc"')
        for whole, part in (("480", "96"), ("360", "72"), ("1113.6", "222.72"), ("652.1", "130.42"),
                            ("-12.34", "-2.468")):
            text = text.replace(f"px: {whole}\n", f"px: {part}\n")
        self.rig.write_text(text)
        self.keys = self.folder / "keys"
        self.aquarama("master", "keys", "new", self.rig, "--keys", self.keys)
        for name in [*CHANNELS, "operator", "visitor", "watcher"]:
            self.aquarama("master", "keys", "bundle", self.rig, name, "--keys", self.keys, "--out",
                          self.folder / f"{name}.key")

    def build_network(self):
        sh("mount", "-t", "tmpfs", "none", "/run")
        sh("ip", "link", "add", "switch", "type", "bridge")
        sh("ip", "link", "set", "switch", "up")
        for machine, address in ADDRESS.items():
            sh("ip", "netns", "add", machine)
            sh("ip", "link", "add", f"to-{machine}", "type", "veth", "peer", "name", "eth0", "netns", machine)
            sh("ip", "link", "set", f"to-{machine}", "master", "switch", "up")
            self.on(machine, "ip", "addr", "add", f"{address}/24", "dev", "eth0")
            self.on(machine, "ip", "link", "set", "eth0", "up")
            self.on(machine, "ip", "link", "set", "lo", "up")

    @staticmethod
    def on(machine, *command):
        sh("ip", "netns", "exec", machine, *map(str, command))

    def run(self, machine, *command):
        environment = os.environ | {"XDG_STATE_HOME": str(self.folder / "state")}
        return subprocess.run(["ip", "netns", "exec", machine, *map(str, command)], capture_output=True, text=True,
                              timeout=60, env=environment)

    def aquarama(self, machine, *arguments):
        return self.run(machine, BIN / "aquarama", *arguments)

    def start(self, name, *arguments, on=None):
        """On the machine of that name, or on another."""
        machine = on or name
        environment = os.environ | {"LP_NUM_THREADS": "0", "XDG_STATE_HOME": str(self.folder / "state"),
                                    "AQUARAMA_POWER_FOLDER": str(self.power_folder(machine))}
        with open(self.folder / "log", "a") as log:
            self.processes[name] = subprocess.Popen(["ip", "netns", "exec", machine, *map(str, arguments)], stdout=log,
                                                       stderr=subprocess.STDOUT, env=environment, cwd=ROOT)

    def power_folder(self, machine):
        """Where its word goes; only left's is there."""
        return self.folder / "power" / machine

    def start_master(self):
        (self.folder / "master.csv").unlink(missing_ok=True)
        self.start("master", BIN / "aquarama", "master", self.rig, "--keys", self.keys, "--pattern", "grid",
                   "--quality", "low", "--trace", self.folder)

    def start_node(self, name, key=None):
        (self.folder / f"{name}.csv").unlink(missing_ok=True)
        self.start(name, BIN / "aquarama-node", "--key", key or self.folder / f"{name}.key", "--headless", "--trace",
                   self.folder)

    def kill(self, machine):
        self.processes[machine].send_signal(signal.SIGKILL)
        self.processes[machine].wait()

    def plug(self, machine, isIn):
        sh("ip", "link", "set", f"to-{machine}", "up" if isIn else "down")

    def states(self):
        """node -> in step, late, absent, preparing; nothing where the master does not answer."""
        asked = self.aquarama("master", "status", "--key", self.folder / "operator.key")
        rows = (line.split() for line in asked.stdout.splitlines())
        return {row[0]: " ".join(row[1:3]) if row[1] == "in" else row[1] for row in rows if row and row[0] in CHANNELS}

    def skew_ms(self):
        asked = self.aquarama("master", "status", "--key", self.folder / "operator.key").stdout
        return " / ".join(re.search(r"release skew +median +([\d.]+) ms +p99 +([\d.]+) ms", asked).groups())

    def all_in_step(self, names=CHANNELS):
        states = self.states()
        return all(states.get(name) == "in step" for name in names)

    def seconds_until(self, condition, what):
        begin = time.monotonic()
        try:
            wait_until(condition, PATIENCE, what)
        except AssertionError:
            print((self.folder / "log").read_text()[-4000:], self.aquarama(
                "master", "status", "--key", self.folder / "operator.key"), sep="\n")
            raise
        return time.monotonic() - begin

    def longest_gap_ms(self, names, since_ns):
        """Between two frames that one of these nodes presented."""
        worst = 0
        for name in names:
            shown = sorted(row[2] for row in trace(self.folder, name).values() if row[2] and row[2] > since_ns)
            worst = max([worst, *(b - a for a, b in zip(shown, shown[1:]))])
        return worst / 1e6

    def intervals_ms(self, names, since_ns):
        """Between two frames that each of these nodes presented, sorted."""
        gaps = []
        for name in names:
            shown = sorted(row[2] for row in trace(self.folder, name).values() if row[2] and row[2] > since_ns)
            gaps += [(b - a) / 1e6 for a, b in zip(shown, shown[1:])]
        return sorted(gaps)

    def tally(self):
        """While nobody is hurt: notes the frames that all presented, and those that one presented before all were
        ready."""
        since = time.monotonic_ns()
        time.sleep(0.4)
        rows = [trace(self.folder, name) for name in CHANNELS]
        for frame in set.intersection(*map(set, rows)):
            ready, shown = [[row[frame][column] for row in rows] for column in (1, 2)]
            if None in ready + shown or min(ready) < since:
                continue
            self.shared += 1
            self.mixed += max(ready) > min(shown)


class SlowCable(threading.Thread):
    """In place of a machine's cable: every packet takes its time, each another, so that some overtake others."""

    def __init__(self, wall, machine, least_ms, most_ms):
        super().__init__(daemon=True)
        self.least, self.most, self.waiting, self.over = least_ms / 1e3, most_ms / 1e3, [], False
        self.ends = [self.tap(f"slow-{machine}"), self.tap(f"far-{machine}")]
        wall.plug(machine, False)
        sh("ip", "link", "set", f"slow-{machine}", "master", "switch", "up")
        wall.on(machine, "ip", "addr", "flush", "dev", "eth0")
        sh("ip", "link", "set", f"far-{machine}", "netns", machine)
        wall.on(machine, "ip", "addr", "add", f"{ADDRESS[machine]}/24", "dev", f"far-{machine}")
        wall.on(machine, "ip", "link", "set", f"far-{machine}", "up")
        self.start()

    @staticmethod
    def tap(name):
        set_interface, tap, no_header = 0x400454CA, 2, 0x1000
        end = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
        fcntl.ioctl(end, set_interface, struct.pack("16sH", name.encode(), tap | no_header))
        return end

    def run(self):
        number = 0
        while not self.over:
            now = time.monotonic()
            while self.waiting and self.waiting[0][0] <= now:
                _, _, end, packet = heapq.heappop(self.waiting)
                try:
                    os.write(end, packet)
                except OSError:  # a full queue: lost
                    pass
            patience = min(self.waiting[0][0] - now, 0.05) if self.waiting else 0.05
            for end in select.select(self.ends, [], [], max(patience, 0))[0]:
                packet, number = os.read(end, 65536), number + 1
                other = self.ends[1 - self.ends.index(end)]
                heapq.heappush(self.waiting,
                               (time.monotonic() + random.uniform(self.least, self.most), number, other, packet))


def report(case, **figures):
    print(f"{case:<34}" + "   ".join(f"{name.replace('_', ' ')} {value}" for name, value in figures.items()),
          flush=True)


def any_order(wall, options):
    order = [*CHANNELS, "master"]
    random.Random(options.seed).shuffle(order)
    for machine in order:
        wall.start_master() if machine == "master" else wall.start_node(machine)
        time.sleep(random.Random(machine).random() / 2)
    seconds = wall.seconds_until(wall.all_in_step, "all in step")
    time.sleep(2)
    report("started in the order " + " ".join(name[0] for name in order), all_in_step_s=f"{seconds:.1f}",
           release_skew_ms=f"{wall.skew_ms()} (median / 99 %)")


def cut(wall, options, machines):
    others = [name for name in CHANNELS if name not in machines]
    since = time.monotonic_ns()
    for machine in machines:
        wall.plug(machine, False)
    time.sleep(options.cut)
    gap = wall.longest_gap_ms(others, since)
    for machine in machines:
        wall.plug(machine, True)
    seconds = wall.seconds_until(wall.all_in_step, f"{machines} back in step")
    figures = {"others_longest_gap_ms": f"{gap:.0f}"} if "master" not in machines else {}
    report(f"cable of {', '.join(machines)} out for {options.cut} s", **figures, back_s=f"{seconds:.1f}")
    assert seconds < BACK and gap < GAP_MS, (seconds, gap)


def back(wall):
    seconds = wall.seconds_until(wall.all_in_step, "all in step again")
    assert seconds < BACK, seconds
    wall.tally()
    return seconds


def another_address(wall, _):
    wall.kill("left")
    wall.on("left", "ip", "addr", "flush", "dev", "eth0")
    wall.on("left", "ip", "addr", "add", "10.77.0.99/24", "dev", "eth0")
    wall.start_node("left")
    report("left back with another address", back_s=f"{back(wall):.1f}")


def master_again(wall, _):
    wall.kill("master")
    wall.start_master()
    report("master killed and started again", back_s=f"{back(wall):.1f}")


def quantiles(gaps):
    return f"{statistics.median(gaps):.1f} / {gaps[int(0.99 * (len(gaps) - 1))]:.1f} / {gaps[-1]:.0f}"


def intervals_with_loss_ms(wall, seconds):
    """Between frames, while one packet of a hundred is lost at every machine."""
    for machine in ADDRESS:
        wall.on(machine, "iptables", "-A", "INPUT", "-m", "statistic", "--mode", "random", "--probability", "0.01",
                "-j", "DROP")
    since = time.monotonic_ns()
    time.sleep(seconds)
    gaps = wall.intervals_ms(CHANNELS, since)
    for machine in ADDRESS:
        wall.on(machine, "iptables", "-F", "INPUT")
    return gaps


def loss(wall, options):
    gaps = intervals_with_loss_ms(wall, options.cut + 2)
    seconds = back(wall)
    report("1 % of packets lost", frames_ms=f"{quantiles(gaps)} (median / 99 % / most)", back_s=f"{seconds:.1f}")


def slow_cable(wall, options):
    cable = SlowCable(wall, "right", 20, 30)
    wall.seconds_until(lambda: wall.states().get("right") in ("in step", "late")
                       and wall.all_in_step(["left", "middle"]),
                       "all there again")
    time.sleep(1)
    since = time.monotonic_ns()
    time.sleep(options.cut + 2)
    others, slow = wall.intervals_ms(["left", "middle"], since), wall.intervals_ms(["right"], since)
    report("right 20 to 30 ms away, each way", others_ms=quantiles(others), right_ms=quantiles(slow))
    assert others[-1] < GAP_MS and slow[-1] < GAP_MS, (others[-1], slow[-1])
    cable.over = True


def hurt_at_random(wall, options):
    chance = random.Random(options.seed)
    since, hurt, slowest = time.monotonic(), 0, 0.0
    while time.monotonic() - since < options.hurt:
        name, way = chance.choice(CHANNELS), chance.choice(["killed", "stopped", "restarted"])
        if way == "stopped":
            wall.processes[name].send_signal(signal.SIGSTOP)
            time.sleep(chance.uniform(0.1, 1.0))
            wall.processes[name].send_signal(signal.SIGCONT)
        else:
            if way == "restarted":
                wall.processes[name].terminate()
            wall.kill(name)
            wall.start_node(name)
        hurt, slowest = hurt + 1, max(slowest, back(wall))
    report(f"a random node hurt for {options.hurt} s", times=hurt, slowest_back_s=f"{slowest:.1f}")


def random_starts(wall, options):
    """Of all four machines, in every order."""
    lost, slowest = 0, 0.0
    for number in range(options.starts):
        for machine in list(wall.processes):
            wall.kill(machine)
        chance = random.Random(number)
        order = [*CHANNELS, "master"]
        chance.shuffle(order)
        begin = time.monotonic()
        for machine in order:
            wall.start_master() if machine == "master" else wall.start_node(machine)
            time.sleep(chance.uniform(0, 0.3))
        try:
            wall.seconds_until(wall.all_in_step, "all in step")
            slowest = max(slowest, time.monotonic() - begin)
        except AssertionError:
            lost += 1
    report(f"{options.starts} starts in a random order", lost=lost, slowest_s=f"{slowest:.1f}")
    assert lost == 0


# Run on the master's machine, whose loopback the console listens at: which channels' pictures come; then what becomes
# of the word to two machines, of which the first takes it.
LOOK = """
import sys
from types import SimpleNamespace
sys.path.insert(0, sys.argv[1])
from desk import Socket
client = Socket(SimpleNamespace(address=sys.argv[2]), Origin=None, Authorization="Bearer " + sys.argv[3])
snapshot = client.hear()["snapshot"]
names = [channel["name"] for channel in snapshot["channels"]]
seen = set()
while len(seen) < len(names):
    client.say({"look": {"channels": names, "widthPx": 64}})
    message = client.hear()
    if isinstance(message, bytes):
        seen.add(names[message[0]])
print(*sorted(seen))
for name in ("left", "right"):
    print(client.command(snapshot["wall"]["run"], machine={"channel": name, "word": "REBOOT"})["outcome"])
"""


def console(wall, _):
    """Pictures of nodes on other machines, over the watch socket with keys, and the word that switches one of these;
    and what it costs the wall to lose its console."""
    program = BIN / "aquarama-console"
    if not program.exists():
        print("SKIPPED: the console is not built")
        return
    token = wall.run("master", program, wall.rig, "--token", "cluster", "--role", "crew").stdout.strip()
    since = time.monotonic_ns()
    wall.start("console", program, wall.rig, "--keys", wall.keys, on="master")
    begin = time.monotonic()
    wall.seconds_until(lambda: "console at http://127.0.0.1:7480" in (wall.folder / "log").read_text(), "the console")
    looked = wall.run("master", "python3", "-c", LOOK, ROOT / "tests/console", "127.0.0.1:7480", token)
    seconds = time.monotonic() - begin
    wall.kill("console")
    time.sleep(1)
    gap = wall.longest_gap_ms(CHANNELS, since)
    word = wall.power_folder("left") / "word"
    assert looked.stdout.split() == [*sorted(CHANNELS), "done", "refused"] and word.read_text() == "reboot\n", looked
    word.unlink()
    assert wall.all_in_step() and gap < GAP_MS, gap
    report("a console looks at all and is killed", pictures_s=f"{seconds:.1f}", longest_gap_ms=f"{gap:.0f}")


def keys(wall, _):
    denied = {}
    for name, arguments in {"no key": ["--master", f"tcp://{ADDRESS['master']}:7400"],
                            "a visitor's key": ["--key", wall.folder / "visitor.key"]}.items():
        denied[name] = wall.aquarama("left", "status", *arguments).returncode != 0
    allowed = wall.aquarama("left", "status", "--key", wall.folder / "watcher.key").returncode == 0
    since = time.monotonic_ns()
    wall.aquarama("master", "keys", "revoke", wall.rig, "right", "--keys", wall.keys)
    seconds = wall.seconds_until(lambda: wall.states().get("right") == "absent"
                                 and wall.all_in_step(["left", "middle"]),
                                 "right cut off and the others in step")
    gap = wall.longest_gap_ms(["left", "middle"], since)
    wall.kill("right")
    wall.start_node("right")
    time.sleep(2)
    stays_out = wall.states().get("right") == "absent"
    wall.aquarama("master", "keys", "rotate", wall.rig, "right", "--keys", wall.keys)
    (wall.folder / "right.key").unlink()
    wall.aquarama("master", "keys", "bundle", wall.rig, "right", "--keys", wall.keys, "--out",
                  wall.folder / "right.key")
    wall.kill("right")
    wall.start_node("right")
    again = wall.seconds_until(wall.all_in_step, "right in step with its new key")
    assert all(denied.values()) and allowed and stays_out and gap < GAP_MS, (denied, allowed, stays_out, gap)
    report("keys", refused=", ".join(denied), revoked_cut_off_s=f"{seconds:.1f}", others_longest_gap_ms=f"{gap:.0f}",
           new_key_in_step_s=f"{again:.1f}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--long", action="store_true")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--starts", type=int, help="50 by default, 1000 with --long")
    options = parser.parse_args()
    options.cut, options.hurt = (10, 3600) if options.long else (2, 30)
    options.starts = options.starts or (1000 if options.long else 50)
    with temporary_folder() as folder:
        wall = Wall(folder)
        try:
            any_order(wall, options)
            cut(wall, options, ["left"])
            cut(wall, options, ["left", "right"])
            cut(wall, options, ["master"])
            another_address(wall, options)
            master_again(wall, options)
            loss(wall, options)
            hurt_at_random(wall, options)
            console(wall, options)
            keys(wall, options)
            random_starts(wall, options)
            slow_cable(wall, options)
            report("frames shown by all, undisturbed", number=wall.shared, mixed=wall.mixed)
            assert wall.shared and not wall.mixed
        finally:
            end(wall.processes.values())


if __name__ == "__main__":
    main()
