#!/usr/bin/env python3
"""A crowd before a running wall: crowd.py [PHONES] [SECONDS]. Phones that come, go and look, five operators, and a
drawing each ten seconds. Prints what the guests' program takes, how long phones wait for an answer, and how the wall's
frames are beside those of the same wall, in the same run, with nobody before it."""

import asyncio
import http.client
import os
import random
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from hall import Hall, Socket, Visitor, aquarama, end_of, wait_until
from show import BIN

TICKS = os.sysconf("SC_CLK_TCK")
OPERATORS = 5
DRAWING_EVERY_S = 10


def taken(pid):
    """Seconds of processor time and MB of memory of a process and its children, and of itself alone."""
    def one(of):
        fields = Path(f"/proc/{of}/stat").read_text().rpartition(")")[2].split()
        status = Path(f"/proc/{of}/status").read_text()
        memory = next(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmRSS"))
        return sum(map(int, fields[11:15])) / TICKS, memory / 1024
    children = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    own = one(pid)
    memory = own[1]
    for child in children:
        try:
            memory += one(child)[1]
        except (FileNotFoundError, StopIteration):
            pass
    return own[0], own[1], memory


def frames(hall, seconds):
    """Median and p99 of the frame times, and late frames, over so many seconds."""
    before = hall.status()
    times, until = [], time.monotonic() + seconds
    while time.monotonic() < until:
        said = aquarama("status", hall.rig).stdout
        times.append(tuple(map(float, re.search(r"frame time +median +(\S+) ms +p99 +(\S+) ms", said).groups())))
        time.sleep(1)
    medians, tails = zip(*times)
    return statistics.median(medians), statistics.median(tails), hall.status()["late"] - before["late"]


class Crowd:
    def __init__(self, hall, phones, seconds, photos):
        self.hall, self.phones, self.photos = hall, phones, photos
        self.until = time.monotonic() + seconds
        self.echoes, self.pictures, self.lost = [], [], 0

    def is_over(self):
        return time.monotonic() > self.until

    async def visit(self, number, token):
        await asyncio.sleep(number / self.phones * 15)
        visitor = Visitor(self.hall.guests, self.echoes)
        await visitor.connect(enter=token())
        looks = asyncio.create_task(self.look(visitor))
        while not self.is_over():
            await asyncio.sleep(2 + 2 * random.random())
            if random.random() < 0.05:
                visitor.drop()
                await asyncio.sleep(0.5)
                await visitor.connect(resume=visitor.session)
            await visitor.echo()
        await looks
        visitor.drop()

    async def look(self, visitor):
        """The wall's picture once a second, as a page does."""
        while not self.is_over():
            began = time.monotonic()
            reader, writer = await asyncio.open_connection(*end_of(self.hall.guests))
            writer.write(f"GET /wall.jpg?{visitor.session}.1 HTTP/1.1\r\nHost: {self.hall.guests}\r\n"
                         "Connection: close\r\n\r\n".encode())
            answer = await reader.read()
            writer.close()
            if answer.startswith(b"HTTP/1.1 200"):
                self.pictures.append(len(answer.partition(b"\r\n\r\n")[2]))
            await asyncio.sleep(max(0, began + 1 - time.monotonic()))

    async def run(self, token):
        visits = [self.visit(number, token) for number in range(self.phones)]
        done = await asyncio.gather(*visits, return_exceptions=True)
        self.lost = [problem for problem in done if isinstance(problem, Exception)]

    def operate(self):
        """Looks at the wall as an operator's page does."""
        client = Socket(self.hall, Cookie=self.hall.cookie)
        client.hear()
        client.say({"look": {"channels": ["middle"], "widthPx": 480}})
        while not self.is_over():
            client.hear()
        client.close()

    def draw(self):
        """Puts a photograph into the folder each ten seconds."""
        number = 0
        while not self.is_over():
            photo = self.photos[number % len(self.photos)]
            number += 1
            target = self.hall.scanner / f"{number}.part"
            target.write_bytes(photo.read_bytes())
            target.rename(target.with_suffix(".jpg"))
            time.sleep(DRAWING_EVERY_S)


def main():
    phones = int(sys.argv[1]) if len(sys.argv) > 1 else 300
    seconds = int(sys.argv[2]) if len(sys.argv) > 2 else 120
    resource.setrlimit(resource.RLIMIT_NOFILE, (8192, 8192))
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([BIN.parent / "tests" / "aquarama_draw_photos", folder, "6", "clownfish", "blue_tang"],
                       check=True, stdout=subprocess.DEVNULL)
        hall = Hall(scene="reef", drawings="AT_ONCE")
        try:
            wait_until(hall.token, 60, "the code on the wall")
            alone = frames(hall, seconds / 4)
            crowd = Crowd(hall, phones, seconds, sorted(Path(folder).iterdir()))
            pid = hall.guests_process()
            began, before = time.monotonic(), taken(pid)
            helpers = [threading.Thread(target=crowd.operate) for _ in range(OPERATORS)]
            helpers.append(threading.Thread(target=crowd.draw))
            most = [0, 0]
            token = [hall.token()]

            def watch():
                while not crowd.is_over():
                    _, own, family = taken(pid)
                    most[:] = max(most[0], own), max(most[1], family)
                    token[0] = hall.token() or token[0]
                    time.sleep(2)
            helpers.append(threading.Thread(target=watch))
            beside = []
            helpers.append(threading.Thread(target=lambda: beside.append(frames(hall, seconds - 5))))
            for helper in helpers:
                helper.start()
            asyncio.run(crowd.run(lambda: token[0]))
            for helper in helpers:
                helper.join()
            share = (taken(pid)[0] - before[0]) / (time.monotonic() - began)
            hundredths = statistics.quantiles(crowd.echoes, n=100)
            print(f"{phones} phones, {len(crowd.echoes)} answers: p50 {hundredths[49] * 1e3:.1f} ms, "
                  f"p99 {hundredths[98] * 1e3:.1f} ms; {len(crowd.lost)} phones were lost")
            print(f"{len(crowd.pictures)} pictures of the wall, the largest of {max(crowd.pictures, default=0)} bytes")
            print(f"guests: {100 * share:.1f} % of a core, {most[0]:.0f} MB, with decoders {most[1]:.0f} MB")
            for what, (median, tail, late) in (("alone", alone), ("with the crowd", beside[0])):
                print(f"frames {what}: median {median:.1f} ms, p99 {tail:.1f} ms, {late} late")
            again = frames(hall, seconds / 4)
            print(f"frames alone again: median {again[0]:.1f} ms, p99 {again[1]:.1f} ms, {again[2]} late")
            return 1 if crowd.lost else 0
        finally:
            hall.close()


if __name__ == "__main__":
    sys.exit(main())
