"""A desk with its console, for tests: a real show, its address and codes; and clients that say what no browser says."""

import base64
import http.client
import json
import os
import re
import secrets
import socket
import struct
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "end_to_end"))

from show import (BIN, ROOT, aquarama, children_of, control_address, end, give_colours,  # noqa: E402,F401
                  rig_on_free_ports, skin_png, start, temporary_folder, wait_until)


def free_udp_port():
    """Of the loopback, that nobody listens on at the moment."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        return free.getsockname()[1]


class Desk:
    """`aquarama run` of a desk; test patterns need no world, and are drawn at once."""

    # Three nodes share two cores with a browser: a slow wall leaves them room.
    # `more`: text of the rig.
    # `machines`: channel -> name of the machine that shows it, whose nodes a test starts (start_node).
    def __init__(self, *arguments, refresh_hz=6, calibrated=False, more="", machines=None):
        self.folder = temporary_folder()
        elsewhere = [(f'name: "{channel}"', f'name: "{channel}" machine: "{machine}"')
                     for channel, machine in (machines or {}).items()]
        self.rig = rig_on_free_ports(self.folder.name,
                                     replace=((r"refresh_hz: 60", f"refresh_hz: {refresh_hz}"), *elsewhere))
        self.rig.write_text(self.rig.read_text() + more)
        self.nodes = []
        if calibrated:
            self.calibrate()
        self.log = Path(self.folder.name) / "log"
        self.show = start("run", self.rig, "--headless", "--live", *arguments, log=self.log)
        try:
            wait_until(lambda: "showing" in self.said() and "console at" in self.said(), 90,
                       "the first frame and the console")
        except AssertionError:
            self.close()
            raise

    def calibrate(self):
        """The rig names a wall file from now on: its own geometry, with colours of its projectors. An earlier one, of a
        projector that hung a little otherwise, one that no rig can be shown by, and a look at the dots are kept beside
        it."""
        folder = Path(self.folder.name)
        history = folder / "hall.history"
        history.mkdir()
        text = self.rig.read_text()
        moved = folder / "moved.txtpb"
        moved.write_text(text.replace("yaw_deg: 39.2", "yaw_deg: 39.5", 1))
        for rig, name, verdict in ((moved, "2026-01-24T210301", "warn"), (self.rig, "2026-02-24T210301", "pass")):
            done = aquarama("convert", rig, history / f"{name}.mpcdi")
            assert done.returncode == 0, done.stderr
            give_colours(history / f"{name}.mpcdi")
            figures = {"verdict": verdict, "cause": "" if verdict == "pass" else "a bright window",
                       "overlap_rms_px": 0.031, "overlap_max_px": 0.4, "absolute_rms_px": 0.52}
            (history / f"{name}.json").write_text(json.dumps(figures))
        (history / "2026-01-20T101500.mpcdi").write_text("no wall file")
        (folder / "hall.mpcdi").write_bytes((history / "2026-02-24T210301.mpcdi").read_bytes())
        channels = [{"name": name, "verdict": verdict, "shift_px": shift}
                    for name, verdict, shift in (("left", "in place", 0.12), ("middle", "in place", 0.08),
                                                 ("right", "moved", 1.81))]
        (folder / "hall.drift.last.json").write_text(json.dumps(
            {"looked": "2026-03-01T05:00:20Z", "learned": "2026-02-24T21:03:01Z", "camera_moved_px": 0.31,
             "camera_lost": False, "channels": channels}))
        self.rig.write_text(text + 'calibration: "hall.mpcdi"\n')

    def start_node(self, channel, **environment):
        """As the service of another machine does, with variables of its own."""
        command = [BIN / "aquarama-node", channel, "--master", control_address(self.rig), "--headless"]
        with open(self.log, "a") as output:
            self.nodes.append(subprocess.Popen(command, stdout=output, stderr=output,
                                               env=os.environ | {"LP_NUM_THREADS": "1"} | environment))

    def close(self):
        end([*self.nodes, self.show])
        self.folder.cleanup()

    def said(self):
        return self.log.read_text()

    @property
    def address(self):
        return re.findall(r"console at http://(\S+)", self.said())[-1]

    def code(self, role=None):
        """A pairing code: that of the first start, or one that is made now."""
        if role is None:
            return re.findall(r"pairing code (\S+)", self.said())[-1]
        return aquarama("console", self.rig, "--pair", role).stdout.split()[0]

    def token(self, role):
        return aquarama("console", self.rig, "--token", role, "--role", role).stdout.strip()

    def status(self, *fields):
        """What `aquarama status` says, field -> value of its line about the show; `late` in all."""
        text = aquarama("status", self.rig).stdout
        shown = dict(pair.split(" ", 1) for pair in re.split(r" {3}", re.search(r"show +(.*)", text)[1]))
        rows = re.findall(r"^(\w+) +(absent|preparing|in step|late) +(\d+) +(\d+)", text, re.M)
        shown["late"] = sum(int(row[2]) for row in rows)
        shown["dropped"] = sum(int(row[3]) for row in rows)
        shown["conditions"] = [row[1] for row in rows]
        shown["frame"] = int(re.search(r"frame (\d+)", text)[1])
        return shown

    def console_process(self):
        return next((pid for command, pid in children_of(self.show).items() if "aquarama-console" in command), None)

    # --- clients

    def request(self, method, target, body=None, **headers):
        """Status, headers and body of an answer; a header that is None is left out. A body of bytes goes as it is."""
        connection = http.client.HTTPConnection(self.address, timeout=10)
        given = {name.replace("_", "-"): value for name, value in headers.items() if value is not None}
        content = json.dumps(body).encode() if body is not None and not isinstance(body, bytes) else body
        if content is not None and "Content-Type" not in given:
            given["Content-Type"] = "application/json"
        connection.putrequest(method, target, skip_host="Host" in given, skip_accept_encoding=True)
        for name, value in given.items():
            connection.putheader(name, value)
        if content is not None:
            connection.putheader("Content-Length", str(len(content)))
        connection.endheaders(content or None)
        answer = connection.getresponse()
        text = answer.read()
        connection.close()
        return answer.status, dict(answer.getheaders()), text.decode(errors="replace")

    def offer(self, token, red, green, blue, species="clownfish"):
        """The number of a drawing that was offered."""
        order = {"request": str(secrets.randbits(62) | 1),
                 "drawing": {"skin": base64.b64encode(skin_png(red, green, blue)).decode(), "species": species}}
        ended = []

        def is_done():
            status, _, text = self.request("POST", "/api/order", order, Authorization=f"Bearer {token}")
            assert status in (200, 202), text
            ended[:] = re.findall(r"done: drawing (\d+)", text)
            return ended
        wait_until(is_done, 10, "the number of a drawing")
        return int(ended[0])

    def pair(self, code, name="test"):
        """The cookie of a new session."""
        status, headers, text = self.request("POST", "/pair", {"code": code, "name": name},
                                             Origin=f"http://{self.address}")
        assert status == 200, text
        return headers["Set-Cookie"].split(";")[0]


class Socket:
    """A WebSocket by hand. `status` is that of the upgrade: 101, or why not."""

    # `raw`: a connection that stands already, over TLS or through a proxy.
    def __init__(self, desk, target="/ws", raw=None, **headers):
        host, port = desk.address.split(":")
        self.socket = raw or socket.create_connection((host, int(port)), timeout=10)
        key = base64.b64encode(secrets.token_bytes(16)).decode()
        given = {"Host": desk.address, "Origin": f"http://{desk.address}", "Upgrade": "websocket",
                 "Connection": "Upgrade",
                 "Sec-WebSocket-Version": "13",
                 "Sec-WebSocket-Key": key} | {n.replace("_", "-"): v for n, v in headers.items()}
        lines = [f"GET {target} HTTP/1.1"] + [f"{name}: {value}" for name, value in given.items() if value is not None]
        self.socket.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
        self.buffer = b""
        while b"\r\n\r\n" not in self.buffer:
            part = self.socket.recv(4096)
            if not part:
                break
            self.buffer += part
        head, _, self.buffer = self.buffer.partition(b"\r\n\r\n")
        self.status = int(head.split()[1])

    def close(self):
        self.socket.close()

    def say(self, message, opcode=1):
        content = message if isinstance(message, bytes) else json.dumps(message).encode()
        self.socket.sendall(frame(content, opcode))

    def take(self, count):
        while len(self.buffer) < count:
            part = self.socket.recv(65536)
            if not part:
                raise ConnectionError("closed")
            self.buffer += part
        taken, self.buffer = self.buffer[:count], self.buffer[count:]
        return taken

    def hear(self):
        """The next message: an object, or the bytes of a picture; a closed one raises."""
        first, second = self.take(2)
        size = second & 0x7F
        if size == 126:
            size, = struct.unpack(">H", self.take(2))
        elif size == 127:
            size, = struct.unpack(">Q", self.take(8))
        content = self.take(size)
        opcode = first & 0x0F
        if opcode == 8:
            raise ConnectionError(f"closed {struct.unpack('>H', content[:2])[0] if content else ''}")
        if opcode == 9:
            self.say(content, 10)
            return self.hear()
        return json.loads(content) if opcode == 1 else content

    def hear_until(self, wanted, seconds=15):
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            message = self.hear()
            if wanted(message):
                return message
        raise AssertionError("not heard in time")

    def command(self, run, identity=None, **what):
        """Says it, and waits until it is done or refused."""
        identity = str(identity or secrets.randbits(63) | 1)
        self.say({"command": {"id": identity, "run": run, **command_of(**what)}})
        ended = self.hear_until(lambda m: isinstance(m, dict) and m.get("done", {}).get("request") == identity
                                and m["done"]["outcome"] != "WAITING")
        return {**ended["done"], "outcome": ended["done"]["outcome"].lower()}


def command_of(**what):
    """A command in JSON; what is for the wall is an order."""
    (name, value), = what.items()
    if name in ("black", "freeze", "scene", "quality", "pattern"):
        return {"order": {"show": {name: value}}}
    if name == "restart":
        return {"order": {"restart": {"channel": value}}}
    if name == "machine":
        return {"order": {"power": value}}
    return what


def frame(content, opcode=1, mask=b"\0\0\0\0"):
    """One whole frame of a client."""
    size = len(content)
    head = bytes([0x80 | opcode])
    head += bytes([0x80 | size]) if size < 126 else bytes([0x80 | 126]) + struct.pack(
        ">H", size) if size < 65536 else bytes([0x80 | 127]) + struct.pack(">Q", size)
    return head + mask + content
