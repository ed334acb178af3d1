"""A wall of one channel with its console and visitors, for tests; and phones, which say what no browser says."""

import asyncio
import base64
import json
import os
import re
import secrets
import struct
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "console"))

from desk import (Desk, Socket, aquarama, children_of, frame, rig_on_free_ports, start,  # noqa: E402,F401
                  temporary_folder, wait_until)
from show import BIN, free_ports  # noqa: E402,F401


class Hall(Desk):
    """`aquarama run` of the desk's middle projector, whose sign is large enough for its preview. `drawings`: how they
    are let in; they are also read from the folder self.scanner. `host`: at which phones reach it."""

    def __init__(self, *arguments, scene="empty_sea", drawings=None, host="127.0.0.1", patience_s=90):
        self.folder = temporary_folder()
        self.nodes = []
        os.environ["XDG_RUNTIME_DIR"] = self.folder.name
        self.rig = rig_on_free_ports(self.folder.name, replace=(
            (r"refresh_hz: 60", "refresh_hz: 15"), (r"arc_deg: 120", "arc_deg: 40"),
            (r"reef\.txtpb", f"{scene}.txtpb")))
        head, *channels = re.split(r"(?m)^channels ", self.rig.read_text())
        self.scanner = Path(self.folder.name) / "scanner"
        self.scanner.mkdir()
        port, pictures = free_ports(2)
        self.guests = f"{host}:{port}"
        self.rig.write_text(f'{head}channels {channels[1].replace("id: 1", "id: 0")}\n'
                            f'guests {{ address: "http://{self.guests}" height: 0.5 '
                            f'pictures: "tcp://127.0.0.1:{pictures}" }}\n'
                            + (f'drawings {{ let_in: {drawings} folder: "scanner" }}\n' if drawings else ""))
        self.log = Path(self.folder.name) / "log"
        self.show = start("run", self.rig, "--headless", "--live", *arguments, log=self.log)
        try:
            wait_until(lambda: all(text in self.said() for text in ("showing", "console at", "visitors at")),
                       patience_s, "the first frame, the console and the visitors")
        except AssertionError:
            print(self.said())
            self.close()
            raise
        self.cookie = self.pair(self.code())

    def picture(self):
        """What the projector gets, a JPEG, as the console has it."""
        client = Socket(self, Cookie=self.cookie)
        client.hear()
        client.say({"look": {"channels": ["middle"], "widthPx": 480}})
        picture = client.hear_until(lambda message: isinstance(message, bytes))
        client.close()
        return picture[16:]

    def token(self):
        """That of the code on the wall, as zbarimg reads it from its picture; None where it reads none."""
        path = Path(self.folder.name) / "wall.jpg"
        path.write_bytes(self.picture())
        read = subprocess.run(["zbarimg", "--nodbus", "--quiet", "--raw", path], capture_output=True, text=True).stdout
        found = re.match(rf"HTTP://{re.escape(self.guests.upper())}/P/(\w{{10}})\n", read)
        return found and found[1]

    def crew_token(self):
        """Of a program of the crew."""
        return super().token("operator")

    def guests_process(self):
        return self.process("aquarama-guests")

    def process(self, name):
        """The number of a process of the show, by a part of its command line."""
        return next((pid for command, pid in children_of(self.show).items() if name in command), None)

    def submarine(self):
        """Where it is, in metres, and who steers."""
        said = re.search(r"submarine +at (\S+) (\S+) (\S+) m .* m/s   (.*) steers\n",
                         aquarama("status", self.rig).stdout)
        return tuple(map(float, said.groups()[:3])), said[4]


class Address:
    """Where phones connect: what Socket needs of a desk."""

    def __init__(self, address):
        self.address = address


def end_of(address):
    """Host and port of an address; a host of version 6 without its brackets."""
    host, _, port = address.rpartition(":")
    return host.strip("[]"), int(port)


class Phone(Socket):
    """Of one visitor."""

    def __init__(self, hall, **first):
        super().__init__(Address(hall.guests), "/g")
        assert self.status == 101, self.status
        self.session = None
        if first:
            self.say(first)

    def state(self, you, seconds=10):
        """The next state of this name."""
        def is_it(message):
            self.session = message.get("session", self.session)
            return message.get("you") == you
        return self.hear_until(is_it, seconds)


class Visitor:
    """A phone of many, on the event loop. `echoes`: seconds between what it says and the state that answers it."""

    def __init__(self, address, echoes):
        self.address, self.echoes = address, echoes
        self.session, self.you = None, None

    async def connect(self, **first):
        self.reader, self.writer = await asyncio.open_connection(*end_of(self.address))
        key = base64.b64encode(secrets.token_bytes(16)).decode()
        self.writer.write(f"GET /g HTTP/1.1\r\nHost: {self.address}\r\nOrigin: http://{self.address}\r\n"
                          f"Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                          f"Sec-WebSocket-Key: {key}\r\n\r\n".encode())
        head = await self.reader.readuntil(b"\r\n\r\n")
        assert b" 101 " in head, head
        await self.hear()  # a stranger, or closed
        self.say(first)
        while self.you in (None, "stranger"):
            await self.hear()

    def say(self, message):
        self.writer.write(frame(json.dumps(message).encode()))

    async def hear(self):
        message = await self.hear_message()
        if message is None:
            return
        assert "refused" not in message, message
        self.session = message.get("session", self.session)
        self.you = message.get("you", self.you)

    async def hear_message(self):
        """The next one; None: it was no message."""
        first, size = await self.reader.readexactly(2)
        if size == 126:
            size, = struct.unpack(">H", await self.reader.readexactly(2))
        content = await self.reader.readexactly(size)
        if first & 0x0F == 9:
            self.writer.write(frame(content, 10))
        return json.loads(content) if first & 0x0F == 1 else None

    async def echo(self):
        """Leaves the line or joins it: the next message is the answer, or one that was under way."""
        began = time.monotonic()
        wanted = "guest" if self.you in ("waiting", "steering") else "waiting"
        self.say({"leave": True} if wanted == "guest" else {"join": True})
        for _ in range(5):
            await self.hear()
            if self.you == wanted or (wanted == "waiting" and self.you == "steering"):
                self.echoes.append(time.monotonic() - began)
                return

    def drop(self):
        self.writer.transport.abort()
