#!/usr/bin/env python3
"""Kills with -9 before a running wall: kills.py [PHONES] [KILLS] [SEED]. Under a load of phones that come, go, steer
and send drawings, and of a crew that lets them in, a process of the wall (visitors' program, console, node or
master) is killed at a random moment and started again, so many times. Whatever was acknowledged must still be so:
who was let in, who has a seat, which drawings there are, and which the crew has let in; and no drawing may be there
twice. Also tells how long each is away, and that frames are late for nobody's sake but a node's or a master's own."""

import asyncio
import collections
import http.client
import os
import random
import re
import resource
import secrets
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from hall import BIN, Hall, Visitor, end_of, wait_until

# What is killed, by a part of its command line; the visitors' program most often, as strangers speak to it.
VICTIMS = {"guests": "aquarama-guests", "console": "aquarama-console", "node": "aquarama-node", "master": "master"}
ORDER = ("guests", "console", "guests", "node", "guests", "master")
SEATS_LAST_S = 30  # of the 45 s for which a phone may be away


class Problem(AssertionError):
    """Something that was acknowledged is not so any more."""


class Guest(Visitor):
    """A visitor who comes back whenever the connection ends, and holds the program to what it has told."""

    def __init__(self, crowd, number):
        super().__init__(crowd.hall.guests, crowd.echoes)
        self.crowd, self.number = crowd, number
        self.drawings = set()  # numbers that it was told

    async def enter(self):
        """Lets himself in by the code that is on the wall."""
        while not self.session and not self.crowd.is_over():
            try:
                await self.connect(enter=self.crowd.token)
            except (OSError, AssertionError, asyncio.IncompleteReadError):  # the code is of the run before
                await asyncio.sleep(0.5)

    async def hear(self):
        message = await self.hear_message()
        if message is None:
            return
        if message.get("refused") == "session":
            raise Problem(f"phone {self.number} was forgotten")
        assert "refused" not in message, message
        self.session = message.get("session", self.session)
        if "you" in message:
            self.you = message["you"]
        if "drawings" in message:
            self.drawings |= {fish["number"] for fish in message["drawings"]["fish"]}

    async def resume(self):
        """Until it is connected again; who waited for the helm still does, or steers."""
        before, lost = self.you, time.monotonic()
        while not self.crowd.is_over():
            self.you = None
            try:
                await self.connect(resume=self.session)
                break
            except (OSError, asyncio.IncompleteReadError):
                await asyncio.sleep(0.2 + 0.3 * random.random())
        away = time.monotonic() - lost
        self.crowd.aways.append(away)
        if before == "waiting" and self.you == "guest" and away < SEATS_LAST_S:
            raise Problem(f"phone {self.number} has lost its seat after {away:.1f} s")

    async def live(self):
        await asyncio.sleep(self.number / self.crowd.phones * 5)
        await self.enter()
        while not self.crowd.is_over():
            listening = asyncio.create_task(self.listen())
            while not (await asyncio.wait({listening}, timeout=1 + 2 * random.random()))[0]:
                if self.crowd.is_over():
                    break
                self.do_something()
            if not listening.done():
                listening.cancel()
            elif isinstance(listening.exception(), (OSError, asyncio.IncompleteReadError)):
                await self.resume()
            else:
                listening.result()
        self.drop()

    async def listen(self):
        while True:
            await self.hear()

    def do_something(self):
        if random.random() < 0.03:
            self.drop()  # a phone that sleeps
        elif self.you == "steering":
            self.say({"helm": [random.randint(-127, 127), 0, 0, 20, 0]})
        elif self.you == "guest":
            self.say({"join": True})
        elif self.you == "waiting" and random.random() < 0.05:
            self.you = "leaving"
            self.say({"leave": True})

    async def draw(self, photo):
        """Sends a photograph. Whether it was accepted."""
        try:
            reader, writer = await asyncio.open_connection(*end_of(self.address))
            writer.write(f"POST /drawing/left HTTP/1.1\r\nHost: {self.address}\r\nOrigin: http://{self.address}\r\n"
                         f"Authorization: Bearer {self.session}\r\nContent-Length: {len(photo)}\r\n"
                         "Connection: close\r\n\r\n".encode() + photo)
            answer = await asyncio.wait_for(reader.read(), 30)
            writer.close()
            return answer.startswith(b"HTTP/1.1 202")
        except (OSError, asyncio.TimeoutError):
            return None  # it may have been


class Crowd:
    def __init__(self, hall, phones, photos, between_drawings):
        self.hall, self.phones, self.photos, self.between_drawings = hall, phones, photos, between_drawings
        self.token = code(hall)
        self.ended = threading.Event()
        self.echoes, self.aways, self.problems = [], [], []
        self.sent = collections.Counter()  # pictures, by what became of them
        self.let_in = set()  # numbers, as the console has said
        self.guests = [Guest(self, number) for number in range(phones)]
        self.bearer = {"Authorization": f"Bearer {hall.crew_token()}"}

    def is_over(self):
        return self.ended.is_set()

    async def run(self):
        done = await asyncio.gather(*(guest.live() for guest in self.guests), self.draw(), return_exceptions=True)
        self.problems += [problem for problem in done if isinstance(problem, Exception)]

    async def draw(self):
        """A drawing now and then, by whoever is connected."""
        number = 0
        while not self.is_over():
            guest = random.choice(self.guests)
            if guest.session:
                accepted = await guest.draw(self.photos[number % len(self.photos)])
                self.sent[{True: "accepted", False: "refused", None: "cut off"}[accepted]] += 1
                number += 1
            await asyncio.sleep(self.between_drawings)

    # --- threads of their own

    def order(self, **what):
        """Until the console says done; whatever is killed meanwhile. Nothing where it is refused or the crowd has
        gone."""
        order = {"request": str(secrets.randbits(62) | 1), **what}
        while not self.is_over():
            try:
                status, _, text = self.hall.request("POST", "/api/order", order, **self.bearer)
            except (OSError, http.client.HTTPException):
                time.sleep(0.3)
                continue
            if status == 200:
                return text
            if status != 202:
                return None
            time.sleep(0.1)
        return None

    def moderate(self):
        """Lets in whatever waits."""
        while not self.is_over():
            for number, verdict in kept(self.hall).items():
                if verdict == "WAITING" and self.order(moderation={"number": number, "verdict": "LET_IN"}):
                    self.let_in.add(number)
            time.sleep(0.5)

    def watch(self):
        """Reads the code on the wall, as it changes."""
        while not self.is_over():
            self.token = code(self.hall) or self.token
            time.sleep(2)


def code(hall):
    """That on the wall; None while the console is away, or slow."""
    try:
        return hall.token()
    except (OSError, AssertionError):
        return None


def kept(hall):
    """Number -> verdict, of the drawings that the master has on its disk."""
    listed = Path(os.environ["XDG_STATE_HOME"]) / "aquarama/shows/desk.drawings/list.txtpb"
    text = listed.read_text() if listed.exists() else ""
    return {int(number): verdict for number, verdict in
            re.findall(r"drawings \{\s*number: (\d+)\s*species: \"\w+\"\s*verdict: (\w+)", text)}


def joins(hall):
    """How often a master has let the node in."""
    return hall.said().count("takes part from frame")


def served(hall, victim, before):
    """Whether a process that was killed does its work again."""
    if victim == "guests":
        connection = http.client.HTTPConnection(*end_of(hall.guests), timeout=5)
    elif victim == "console":
        connection = http.client.HTTPConnection(hall.address, timeout=5)
    else:
        return joins(hall) > before and hall.status()["conditions"] == ["in step"]
    try:
        connection.request("GET", "/")
        return connection.getresponse().status == 200
    except OSError:
        return False
    finally:
        connection.close()


def is_served(hall, victim, before):
    try:
        return served(hall, victim, before)
    except (TypeError, ValueError, KeyError, IndexError):  # `aquarama status` found no master
        return False


def kill_one(hall, victim):
    """Seconds until it is there again, and frames that were late meanwhile, where node and master lived on."""
    counts = victim in ("guests", "console")
    late, joined = hall.status()["late"] if counts else 0, joins(hall)
    old = hall.process(VICTIMS[victim])
    began = time.monotonic()
    os.kill(old, signal.SIGKILL)
    wait_until(lambda: hall.process(VICTIMS[victim]) not in (None, old), 30, f"another {victim}")
    wait_until(lambda: is_served(hall, victim, joined), 300, f"the work of the {victim}")
    return time.monotonic() - began, hall.status()["late"] - late if counts else 0


def has_settled(hall, crowd):
    """Whether some drawings were told to phones, and all that there are were let in."""
    verdicts = kept(hall).values()
    return crowd.let_in and any(guest.drawings for guest in crowd.guests) and "WAITING" not in verdicts


def check(hall, crowd):
    """Of what phones and crew were told, once all has settled."""
    on_disk = kept(hall)
    told = set().union(*(guest.drawings for guest in crowd.guests))
    problems = list(crowd.problems)
    problems += [f"drawing {number}, of which a phone was told, is gone" for number in told - on_disk.keys()]
    problems += [f"drawing {number}, which the crew let in, is {on_disk.get(number)}"
                 for number in crowd.let_in if on_disk.get(number) != "LET_IN"]
    most = crowd.sent["accepted"] + crowd.sent["cut off"]
    if len(on_disk) > most:
        problems.append(f"{len(on_disk)} drawings of {most} pictures")
    print(f"pictures: {dict(crowd.sent)}; on disk {len(on_disk)}, told to phones {len(told)}, "
          f"let in {len(crowd.let_in)}")
    return problems


def main():
    phones = int(sys.argv[1]) if len(sys.argv) > 1 else 30
    kills = int(sys.argv[2]) if len(sys.argv) > 2 else 6
    chance = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 20261127)
    large = phones > 100
    resource.setrlimit(resource.RLIMIT_NOFILE, (8192, 8192))
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([BIN.parent / "tests" / "aquarama_draw_photos", folder, "6" if large else "1", "clownfish"],
                       check=True, stdout=subprocess.DEVNULL)
        photos = [path.read_bytes() for path in sorted(Path(folder).iterdir())]
    hall = Hall("--quality", "low", scene="reef" if large else "empty_sea", drawings="WHEN_ASKED", host="[::1]",
                patience_s=600 if large else 90)
    try:
        wait_until(lambda: code(hall), 90, "the code on the wall")
        crowd = Crowd(hall, phones, photos, between_drawings=10 if large else 2)
        helpers = [threading.Thread(target=work) for work in (crowd.moderate, crowd.watch,
                                                             lambda: asyncio.run(crowd.run()))]
        for helper in helpers:
            helper.start()
        time.sleep(8)
        aways, late = collections.defaultdict(list), 0
        for number in range(kills):
            time.sleep(chance.uniform(0, 4 if large else 2))
            victim = ORDER[number % len(ORDER)]
            away, more = kill_one(hall, victim)
            aways[victim].append(away)
            late += more
        wait_until(lambda: has_settled(hall, crowd), 60, "drawings that are told and let in")
        crowd.ended.set()
        for helper in helpers:
            helper.join()
        problems = check(hall, crowd)
        for victim, times in aways.items():
            print(f"{victim}: killed {len(times)} times, away for {statistics.median(times):.1f} s in the median, "
                  f"{max(times):.1f} s at most")
        print(f"{phones} phones, connected again {len(crowd.aways)} times, after "
              f"{statistics.median(crowd.aways or [0]):.1f} s in the median, {max(crowd.aways, default=0):.1f} s at "
              f"most; {late} frames late while visitors' program and console were killed")
        for problem in problems:
            print(f"LOST: {problem!r}")
        return 1 if problems else 0
    finally:
        hall.close()


if __name__ == "__main__":
    sys.exit(main())
