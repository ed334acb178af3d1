"""A theatre's desk drives a real show: by OSC over UDP, and by a program's token over HTTP."""

import json
import re
import signal
import socket
import struct
import time
import unittest
from pathlib import Path

from desk import (Desk, aquarama, control_address, end, free_udp_port, rig_on_free_ports, start, temporary_folder,
                  wait_until)


def padded(text):
    data = text.encode()
    return data + b"\0" * (4 - len(data) % 4)


def message(address, *arguments):
    """An OSC message by hand: int, float and str."""
    tags, content = ",", b""
    for one in arguments:
        tags += {int: "i", float: "f", str: "s"}[type(one)]
        content += padded(one) if isinstance(one, str) else struct.pack(">i" if isinstance(one, int) else ">f", one)
    return padded(address) + padded(tags) + content


def read(packet):
    """Address and arguments of a message."""
    def text(at):
        end = packet.index(b"\0", at)
        return packet[at:end].decode(), at + ((end - at) // 4 + 1) * 4
    address, at = text(0)
    tags, at = text(at)
    values = []
    for tag in tags[1:]:
        if tag == "s":
            value, at = text(at)
        else:
            (value,), at = struct.unpack_from(">" + tag, packet, at), at + 4
        values.append(value)
    return address, values


class End:
    """A socket of UDP at a host of the loopback; what it has heard, by address."""

    def __init__(self, host="127.0.0.1"):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind((host, 0))
        self.socket.setblocking(False)
        self.port = self.socket.getsockname()[1]
        self.known, self.refusals = {}, []

    def hear(self):
        while True:
            try:
                address, values = read(self.socket.recv(65536))
            except BlockingIOError:
                return self.known
            if address == "/aquarama/refused":
                self.refusals.append(values)
            else:
                self.known[address.removeprefix("/aquarama/state/")] = values[0]


class Cues(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.taken = End()
        cls.desk_end, cls.stranger, cls.receiver = End(), End("127.0.0.2"), End()
        cls.place = ("127.0.0.1", cls.taken.port)
        cls.desk = Desk("--pattern", "grid", more=f'''
            cues {{ osc {{ listen: "udp://127.0.0.1:{cls.taken.port}" from: "127.0.0.1"
                           send_to: "udp://127.0.0.1:{cls.receiver.port}" }} }}
            drawings {{ species: "clownfish" }}''')
        cls.addClassCleanup(cls.desk.close)
        wait_until(lambda: "cannot listen at udp" in cls.desk.said(), 10, "the port is another program's")
        cls.taken.socket.close()
        wait_until(lambda: "cues by OSC at" in cls.desk.said(), 10, "it is free, and the console listens")
        cls.operator, cls.watcher = (cls.desk.token(role) for role in ("operator", "watcher"))
        wait_until(lambda: cls.receiver.hear().get("nodes_in_step") == 3, 30, "all nodes in step")

    def send(self, *what, by=None):
        (by or self.desk_end).socket.sendto(what[0] if isinstance(what[0], bytes) else message(*what), self.place)

    def told(self, name, value, seconds=5):
        wait_until(lambda: self.receiver.hear().get(name) == value, seconds, f"{name} {value}: {self.receiver.known}")

    def refusal(self, seconds=10):
        wait_until(lambda: self.desk_end.hear() is not None and self.desk_end.refusals, seconds, "a refusal")
        return self.desk_end.refusals.pop(0)

    def figure(self, name):
        text = self.desk.request("GET", "/metrics", Authorization=f"Bearer {self.watcher}")[2]
        return float(re.search(rf"^aquarama_console_{name} (\S+)", text, re.M)[1])

    def order(self, token=None, **order):
        """Status and text of the answer."""
        key = f"Bearer {token or self.operator}"
        status, _, text = self.desk.request("POST", "/api/order", order, Authorization=key)
        return status, text.strip()

    def state(self):
        return json.loads(self.desk.request("GET", "/api/state", Authorization=f"Bearer {self.watcher}")[2])

    def test_a_cue_is_shown_and_told(self):
        self.told("running", 1)
        before = time.monotonic()
        self.send("/aquarama/black", 1)
        self.told("black", 1)
        print(f"black: told {1000 * (time.monotonic() - before):.0f} ms after the cue")
        self.assertEqual(self.desk.status()["black"], "on")
        self.told("brightness", 0)
        self.send("/aquarama/black", 0)
        self.send("/aquarama/brightness", 0.2)
        self.told("black", 0)
        wait_until(lambda: abs(self.receiver.hear()["brightness"] - 0.2) < 1e-6, 5, "a fifth of the light")
        state = self.state()
        told = self.receiver.known | {name: state[name] for name in ("frame", "brightness", "colour")}
        self.assertEqual(state, told)
        self.send("/aquarama/brightness", 1)
        self.told("brightness", 1)
        self.send("/aquarama/pattern", "grey")
        self.told("pattern", "grey")

    def test_phones_and_drawings_are_switched_and_told(self):
        for name in ("guests", "drawings"):
            self.told(name, 1)
            self.send(f"/aquarama/{name}", 0)
            self.told(name, 0)
            self.assertEqual(self.state()[name], 0)
            self.send(f"/aquarama/{name}", 1)
            self.told(name, 1)
        number = self.desk.offer(self.operator, 200, 90, 20)
        self.told("drawings_waiting", 1)
        self.assertEqual(self.order(moderation={"number": number, "verdict": "LET_IN"})[0], 202)
        self.told("drawings_swimming", 1)
        self.assertEqual((self.state()["drawings_waiting"], self.state()["drawings_swimming"]), (0, 1))
        self.assertEqual(self.order(show={"drawings": False})[0], 202)
        self.told("drawings", 0)
        self.assertEqual(self.order(show={"drawings": True})[0], 202)
        self.told("drawings", 1)
        self.assertEqual(self.order(moderation={"number": number, "verdict": "TAKE_DOWN"})[0], 202)
        self.told("drawings_swimming", 0, 60)

    def test_the_time_of_day_is_set_and_a_shark_is_released(self):
        self.told("day", "clock")
        self.send("/aquarama/day", "first light")
        self.told("day", "first light")
        self.assertEqual(self.desk.status()["day"], "first light")
        self.assertEqual(self.order(show={"day": "DUSK"})[0], 202)
        self.told("day", "dusk")
        self.assertEqual(self.state()["day"], "dusk")
        self.send("/aquarama/day", "clock")
        self.told("day", "clock")
        self.send("/aquarama/release", "blacktip_reef_shark")
        wait_until(lambda: "releases a blacktip_reef_shark" in self.desk.said(), 30, "a shark comes")
        self.send("/aquarama/release", "clownfish")
        self.assertEqual(self.refusal(), ["/aquarama/release",
                                          "no clownfish patrols in this scene, only blacktip_reef_shark"])
        self.assertEqual(self.order(request="4712", release={"species": "trout"})[0], 202)
        wait_until(lambda: self.order(request="4712", release={"species": "trout"})[0] == 403, 30, "its refusal")

    def test_what_is_no_cue_of_the_desk_changes_nothing(self):
        before, dropped = self.state(), self.figure("dropped_cues_total")
        self.send("/aquarama/black", 1, by=self.stranger)
        for packet, address, why in ((b"nonsense", "", "it begins with no address"),
                                     (b"/" + b"a" * 20_000, "", "larger than 8192 bytes"),
                                     (message("/aquarama/black", "on"), "/aquarama/black", "1 or 0"),
                                     (message("/aquarama/brightness", 1.5), "/aquarama/brightness", "from 0 to 1"),
                                     (message("/aquarama/shutdown"), "/aquarama/shutdown", "no such address")):
            self.send(packet)
            refused = self.refusal()
            self.assertEqual(refused[0], address)
            self.assertIn(why, refused[1])
        self.send("/aquarama/scene", "no_such_scene")
        refused = self.refusal()
        self.assertEqual(refused[0], "/aquarama/scene")
        self.assertIn("no_such_scene", refused[1])
        wait_until(lambda: self.figure("dropped_cues_total") == dropped + 1, 5, "the stranger's is counted")
        self.stranger.hear()
        self.assertEqual(self.stranger.refusals, [])
        after = self.state()
        self.assertGreater(after.pop("frame"), before.pop("frame"))
        self.assertEqual(after, before)
        self.assertIn("a cue of 127.0.0.1 is refused", self.desk.said())

    def test_a_program_gives_orders_by_its_token(self):
        self.assertEqual(self.order(token="0" * 64, show={"black": True})[0], 401)
        self.assertEqual(self.order(token=self.watcher, show={"black": True}),
                         (403, "refused: only operator may do this"))
        self.assertEqual(self.order(dark=True), (400, 'this is no order; one is {"show": {"black": true}}'))
        self.assertEqual(self.order(show={"brightness": 2})[0], 403)
        self.assertEqual(self.order(scan={"holder": 1})[0], 403)
        self.assertEqual(self.order(run="7", show={"black": True})[0], 403, "another show's")
        status, text = self.order(request="4711", show={"freeze": True})
        self.assertEqual((status, text), (202, "waiting; request 4711"))
        wait_until(lambda: self.order(request="4711", show={"freeze": True}) == (200, "done"), 5, "its end")
        self.told("freeze", 1)
        self.assertEqual(self.state()["freeze"], 1)
        self.assertEqual(self.order(show={"freeze": False})[0], 202)
        self.told("freeze", 0)
        self.assertEqual(self.desk.request("GET", "/api/state")[0], 401)
        self.assertEqual(self.desk.request("GET", "/api/order", Authorization=f"Bearer {self.operator}")[0], 404)


def bundle(*messages):
    """Messages of OSC in one packet, at once."""
    return padded("#bundle") + struct.pack(">q", 1) + b"".join(struct.pack(">i", len(one)) + one for one in messages)


class Recorded(unittest.TestCase):
    """A time of day and a release reach the world, and its recording, which is the same when it is replayed."""

    def test_cues_of_the_world_are_replayed(self):
        folder = temporary_folder()
        self.addCleanup(folder.cleanup)
        desk, listener = End(), End()
        self.addCleanup(desk.socket.close)
        place = ("127.0.0.1", listener.port)
        listener.socket.close()
        rig = rig_on_free_ports(folder.name)
        rig.write_text(rig.read_text() + f'''
            cues {{ osc {{ listen: "udp://127.0.0.1:{place[1]}" from: "127.0.0.1" }} }}''')
        recording, log = Path(folder.name) / "show.aqrec", Path(folder.name) / "console.log"
        master = start("master", rig, "--pattern", "grey", "--record", recording)
        node = start("node", "middle", "--master", control_address(rig), "--headless")
        console = start("console", rig, log=log)
        self.addCleanup(lambda: end([console, node, master]))
        wait_until(lambda: "cues by OSC at" in log.read_text(), 20, "the console listens")
        wait_until(lambda: re.search(r"submarine +at", aquarama("status", rig).stdout), 60, "a world")

        def dusk_is_wanted():
            desk.socket.sendto(message("/aquarama/day", "dusk"), place)  # until the console hears the master
            return "day dusk" in aquarama("status", rig).stdout
        wait_until(dusk_is_wanted, 20, "dusk is wanted")
        desk.socket.sendto(message("/aquarama/release", "blacktip_reef_shark"), place)
        time.sleep(5)
        master.send_signal(signal.SIGTERM)
        self.assertEqual(master.wait(20), 0)
        said = aquarama("inspect", recording).stdout
        self.assertIn("time of day to 0.8500 of the day in 40 s", said)
        self.assertRegex(said, r"a hunter of species \d+ comes")
        check = aquarama("replay", recording, "--check")
        self.assertEqual(check.returncode, 0, check.stdout + check.stderr)


class Hands(unittest.TestCase):
    """A tracker tells of a hand by TUIO: it reaches the world, and its recording."""

    def setUp(self):
        self.folder = temporary_folder()
        self.addCleanup(self.folder.cleanup)
        self.tracker = End()
        self.port = free_udp_port()
        self.rig = rig_on_free_ports(self.folder.name)
        self.rig.write_text(self.rig.read_text() + f'''
            touch {{ listen: "udp://127.0.0.1:{self.port}" top_left {{ x_m: -1 y_m: 1 z_m: -2 }}
                     top_right {{ x_m: 1 y_m: 1 z_m: -2 }} bottom_left {{ x_m: -1 y_m: -1 z_m: -2 }} }}''')

    def see(self, frame, *hands):
        """A frame of TUIO 1.1: session, x and y of each hand."""
        alive = message("/tuio/2Dcur", "alive", *(hand[0] for hand in hands))
        moves = [message("/tuio/2Dcur", "set", *hand, 0.0, 0.0, 0.0) for hand in hands]
        packet = bundle(alive, *moves, message("/tuio/2Dcur", "fseq", frame))
        self.tracker.socket.sendto(packet, ("127.0.0.1", self.port))

    def test_a_hand_reaches_the_world_and_its_recording(self):
        recording, log = Path(self.folder.name) / "show.aqrec", Path(self.folder.name) / "console.log"
        master = start("master", self.rig, "--pattern", "grey", "--record", recording)
        node = start("node", "middle", "--master", control_address(self.rig), "--headless")
        console = start("console", self.rig, log=log)
        self.addCleanup(lambda: end([console, node, master]))
        wait_until(lambda: "hands by TUIO at" in log.read_text(), 20, "the console listens")
        wait_until(lambda: re.search(r"submarine +at", aquarama("status", self.rig).stdout), 60, "a world")
        for frame in range(1, 31):
            self.see(frame, (7, 0.5, 0.5))
            time.sleep(0.05)
        self.see(31)
        time.sleep(0.5)
        master.send_signal(signal.SIGTERM)
        self.assertEqual(master.wait(20), 0)
        said = aquarama("inspect", recording).stdout
        self.assertIn("hands before the wall: 1", said)
        check = aquarama("replay", recording, "--check")
        self.assertEqual(check.returncode, 0, check.stdout + check.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
