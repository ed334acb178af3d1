#!/usr/bin/env python3
"""cost.py [PAIRS]: what operators cost the wall, paired: phases of 22 seconds with five who look at everything, and
without.

The wall and its console have one core, the load the other; a light pattern, so that frames keep to 60 Hz. Figures are
those of the last 600 frames, by aquarama status. Prints a line for each phase, and the means. """

import os
import re
import statistics
import sys
import threading
import time

from desk import Desk, Socket, aquarama


def figures(desk):
    """Frame time median and 99 %, release skew median and 99 %, ms."""
    text = aquarama("status", desk.rig).stdout
    return [float(value) for line in re.findall(r"(?:frame time|release skew).*", text)
            for value in re.findall(r"([\d.]+) ms", line)]


def look(desk, cookie, ended):
    client = Socket(desk, Cookie=cookie)
    client.say({"look": {"topics": ["log", "doctor", "history", "hours", "people", "panorama", "calibrations"],
                         "channels": ["left", "middle", "right"], "widthPx": 480}})
    said = time.monotonic()
    while not ended.is_set():
        message = client.hear()
        if isinstance(message, bytes):
            client.say({"seen": {"channel": int.from_bytes(message[:2], "little")}})
        if time.monotonic() - said > 1:
            said = time.monotonic()
            client.say({"look": {"topics": ["log", "history", "panorama", "calibrations"],
                                 "channels": ["left", "middle", "right"], "widthPx": 480}})
    client.close()


def main():
    pairs = int(sys.argv[1]) if len(sys.argv) > 1 else 4
    cores = sorted(os.sched_getaffinity(0))
    os.sched_setaffinity(0, {cores[0]})
    desk = Desk("--pattern", "grey", refresh_hz=60)
    os.sched_setaffinity(0, {cores[-1]})
    try:
        cookie = desk.pair(desk.code())
        time.sleep(10)
        found = {True: [], False: []}
        for phase in range(2 * pairs):
            looked = phase % 2 == 1
            ended = threading.Event()
            threads = [threading.Thread(target=look, args=(desk, cookie, ended)) for _ in range(5 if looked else 0)]
            for thread in threads:
                thread.start()
            time.sleep(22)  # so that the last 600 frames are of this phase, also at 30 a second
            found[looked].append(figures(desk))
            ended.set()
            for thread in threads:
                thread.join()
            print("with five operators" if looked else "without            ",
                  *(f"{value:8.3f}" for value in found[looked][-1]), flush=True)
        for looked, name in ((False, "mean without"), (True, "mean with   ")):
            print(name, *(f"{statistics.mean(column):8.3f}" for column in zip(*found[looked])))
        print("late", desk.status()["late"], "dropped", desk.status()["dropped"])
    finally:
        desk.close()


main()
