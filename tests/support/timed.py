#!/usr/bin/env python3
"""timed.py FILE COMMAND...: runs the command, and writes two numbers to the file.

The first is the processor time of the command and of what it started, in seconds. The second is that of a fixed piece
of work, in milliseconds, the median of one at each end and every few seconds meanwhile: how slow the machine was."""

import os
import signal
import statistics
import sys
import threading
import time

PERIOD_SECONDS = 5
ADDITIONS = 500_000


def piece_of_work():
    begun = time.thread_time()
    total = 0
    for i in range(ADDITIONS):
        total += i
    return 1000 * (time.thread_time() - begun)


def main(file, command):
    pieces, has_ended = [], threading.Event()

    def keep_measuring():
        while not has_ended.wait(PERIOD_SECONDS if pieces else 0):
            pieces.append(piece_of_work())

    # Python ignores these two, and what it starts would as well.
    child = os.posix_spawnp(command[0], command, os.environ, setsigdef=[signal.SIGPIPE, signal.SIGXFSZ])
    measuring = threading.Thread(target=keep_measuring)
    measuring.start()
    _, status, usage = os.wait4(child, 0)
    has_ended.set()
    measuring.join()
    pieces.append(piece_of_work())
    with open(file, "w") as out:
        out.write(f"{usage.ru_utime + usage.ru_stime:.3f} {statistics.median(pieces):.3f}\n")
    code = os.waitstatus_to_exitcode(status)
    return code if code >= 0 else 128 - code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
