"""Visitors with phones before a running wall: from the code that it shows to the helm, and on to the next."""

import asyncio
import contextlib
import http.client
import math
import os
import random
import shutil
import signal
import statistics
import threading
import time
import unittest

from hall import Hall, Phone, Visitor, aquarama, wait_until


@contextlib.contextmanager
def held(phone, levers):
    """Says them ten times a second, as a page does, from another thread."""
    ended = threading.Event()

    def say():
        while not ended.wait(0.1):
            phone.say({"helm": levers})
    thread = threading.Thread(target=say)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()


class Turn(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not shutil.which("zbarimg"):
            missing = "zbarimg of zbar-tools is needed to read the code on the wall"
            raise AssertionError(missing) if "CI" in os.environ else unittest.SkipTest(missing)
        cls.hall = Hall()
        cls.addClassCleanup(cls.hall.close)
        wait_until(cls.hall.token, 20, "the code on the wall")
        cls.scanned = cls.hall.token()

    def test_a_turn(self):
        hall = self.hall
        connection = http.client.HTTPConnection(hall.guests)
        for path in (f"/P/{self.scanned}", f"/p/{self.scanned.lower()}"):
            connection.request("GET", path)
            answer = connection.getresponse()
            self.assertIn("<title>Aquarama</title>", answer.read().decode())
            self.assertIn("script-src 'self'", answer.headers["Content-Security-Policy"])
        connection.close()
        first, second = self.phone(enter=self.scanned), self.phone()
        first.state("steering")
        second.say({"enter": self.scanned.lower()})
        self.assertLessEqual(second.state("waiting")["wait_s"], 61)

        before, _ = hall.submarine()
        with held(first, [127, 0, 0, 0, 0]):
            wait_until(lambda: math.dist(before, hall.submarine()[0]) > 0.5, 10, "the submarine on its way")
            self.assertNotEqual(hall.submarine()[1], "nobody")

        first.say({"leave": True})
        first.state("guest")
        left = time.monotonic()
        second.state("steering")
        self.assertGreater(time.monotonic() - left, 0.8, "a second at rest between pilots")

        # A hand is lost: its phone says nothing any more, or is gone.
        with held(second, [0, 0, 127, 0, 0]):
            wait_until(lambda: hall.submarine()[1] != "nobody", 5, "the hand of the second")
        silent = time.monotonic()
        wait_until(lambda: hall.submarine()[1] == "nobody", 2, "the helm at rest")
        print(f"a helm whose phone is silent rests after {time.monotonic() - silent:.2f} s at most")

        first.say({"feed": True})
        first.hear_until(lambda message: message.get("feed_s") == 20, 5)

        # Killed: its visitors keep their places.
        session = second.session
        os.kill(hall.guests_process(), signal.SIGKILL)
        wait_until(lambda: hall.said().count("visitors at") == 2, 20, "its restart")
        wait_until(lambda: self.is_served(), 10, "the door")
        again = self.phone(resume=session)
        again.state("steering")

        aquarama("set", hall.rig, "guests", "off")
        again.state("closed")
        wait_until(lambda: hall.token() is None, 5, "the wall without a code")
        aquarama("set", hall.rig, "guests", "on")
        again.state("steering")
        wait_until(hall.token, 5, "the code on the wall")

    def phone(self, **first):
        phone = Phone(self.hall, **first)
        self.addCleanup(phone.close)
        return phone

    def is_served(self):
        try:
            Phone(self.hall).close()
            return True
        except OSError:
            return False

    def test_thirty_phones_that_come_and_go(self):
        wait_until(self.hall.token, 20, "the code on the wall")
        token, echoes = self.hall.token(), []

        async def visit(number):
            await asyncio.sleep(number * 0.06)  # 17 a second
            visitor = Visitor(self.hall.guests, echoes)
            await visitor.connect(enter=token)
            for _ in range(12):
                await asyncio.sleep(0.3 + 0.4 * random.random())
                if random.random() < 0.15:
                    visitor.drop()
                    await asyncio.sleep(0.2)
                    await visitor.connect(resume=visitor.session)
                await visitor.echo()
            visitor.say({"leave": True})
            await asyncio.sleep(0.2)
            visitor.drop()

        async def all_visits():
            await asyncio.wait_for(asyncio.gather(*(visit(number) for number in range(30))), 30)

        before = self.hall.status()
        asyncio.run(all_visits())
        after = self.hall.status()
        hundredths = statistics.quantiles(echoes, n=100)
        print(f"30 phones, {len(echoes)} echoes: p50 {hundredths[49] * 1e3:.1f} ms, p99 {hundredths[98] * 1e3:.1f} ms; "
              f"frames late {after['late'] - before['late']} of {after['frame'] - before['frame']}")
        self.assertGreater(len(echoes), 150)


if __name__ == "__main__":
    unittest.main()
