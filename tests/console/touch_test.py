"""`aquarama touch` on a real show: a simulated tracker sees who follows the words of the marks."""

import math
import re
import signal
import socket
import subprocess
import threading
import unittest
from pathlib import Path

from cues_test import bundle, message
from desk import BIN, ROOT, Desk, aquarama, free_udp_port, temporary_folder, wait_until


class Tracker:
    """Sends frames of TUIO thirty times a second; `hands`: session -> share of the plane. It trembles by 2 mm of 1 m,
    and may tell blobs."""

    def __init__(self, port, kind="2Dcur"):
        self.socket, self.port, self.kind = socket.socket(socket.AF_INET, socket.SOCK_DGRAM), port, kind
        self.hands, self.ended = {}, threading.Event()
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def run(self):
        address, frame = f"/tuio/{self.kind}", 0
        rest = (0.0, 0.0, 0.0) if self.kind == "2Dcur" else (0.0,) * 9
        while not self.ended.wait(1 / 30):
            frame += 1
            hands = dict(self.hands)
            aside = 0.002 * (-1) ** frame
            moves = [message(address, "set", session, x + aside, y - aside, *rest) for session, (x, y) in hands.items()]
            packet = bundle(message(address, "alive", *hands), *moves, message(address, "fseq", frame))
            self.socket.sendto(packet, ("127.0.0.1", self.port))

    def end(self):
        self.ended.set()
        self.thread.join()
        self.socket.close()


def corner(text, name):
    """Its three numbers in a block of the rig."""
    return [float(one) for one in
            re.search(rf"{name} {{ x_m: (\S+) y_m: (\S+) z_m: (\S+) }}", text).groups()]


class Session:
    """The command as somebody at the wall sees it."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([BIN / "aquarama", "touch", *map(str, arguments)], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=ROOT)
        self.said = ""
        self.reader = threading.Thread(target=self.read)
        self.reader.start()

    def read(self):
        for line in self.process.stdout:
            self.said += line

    def mark(self, number):
        """The words of a mark, once it is asked for."""
        pattern = rf"mark {number} of 3: (.*)\n"
        wait_until(lambda: re.search(pattern, self.said) or self.process.poll() is not None, 20, f"mark {number}")
        found = re.search(pattern, self.said)
        assert found, self.said
        return found[1]

    def end(self):
        status = self.process.wait(20)
        self.reader.join()
        self.process.stdin.close()
        self.process.stdout.close()
        return status


class Touch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.port = free_udp_port()
        cls.block = f'''
# The fence hangs under the roof.
touch {{
  listen: "udp://127.0.0.1:{cls.port}"
  top_left {{ x_m: -1 y_m: 1 z_m: -1 }} top_right {{ x_m: 1 y_m: 1 z_m: -1 }}
  bottom_left {{ x_m: -1 y_m: -1 z_m: -1 }}
}}
# The end.
'''
        cls.desk = Desk("--pattern", "grey", more=cls.block)
        cls.addClassCleanup(cls.desk.close)
        cls.rig, cls.text = cls.desk.rig, cls.desk.rig.read_text()
        cls.radius = float(re.search(r"radius_m: (\S+)", cls.text)[1])

    def setUp(self):
        self.listens()

    def tearDown(self):
        self.rig.write_text(self.text)

    def listens(self, times=1):
        wait_until(lambda: self.desk.said().count("hands by TUIO at") >= times, 10, "the console listens")

    def pattern(self):
        return self.desk.status()["pattern"]

    def point(self, words):
        """Where the words of a mark lead to on the wall, wall frame."""
        degrees = {side: float(number) for number, side in re.findall(r"(\d+) degrees (\w+)", words.split(":")[0])}
        right = math.radians(degrees.get("right", 0) - degrees.get("left", 0))
        up = math.radians(degrees.get("up", 0) - degrees.get("down", 0))
        return (self.radius * math.sin(right), self.radius * math.tan(up), -self.radius * math.cos(right))

    def follow(self, session, tracker, share):
        """Goes from mark to mark, with a friend who looks on at the second."""
        for number in (1, 2, 3):
            words = session.mark(number)
            if number == 2:
                tracker.hands = {20: (0.1, 0.1), 21: (0.9, 0.9)}
                wait_until(lambda: "2 are seen: one alone, please" in session.said, 5, "two are too many")
            if number == 3:
                wait_until(lambda: "go on to this one" in session.said, 5, "the hand that is still at mark 2")
            tracker.hands = {number: share(words)}
        status = session.end()
        tracker.hands = {}
        print(session.said)
        return status

    def test_a_mirrored_tracker_is_mapped_and_written_while_the_console_lends_its_port(self):
        session, tracker = Session(self.rig, "--write"), Tracker(self.port)
        self.addCleanup(tracker.end)
        first = self.point(session.mark(1))
        self.assertEqual(self.pattern(), "grid")
        # It watches 4.4 x 2.4 m of the plane that the marks are in, from behind.
        left, top, wide, high = 2.2, 1.2, -4.4, -2.4

        def share(words):
            point = self.point(words)
            self.assertAlmostEqual(point[2], first[2], places=6, msg="upright")
            return (point[0] - left) / wide, (point[1] - top) / high
        self.assertEqual(self.follow(session, tracker, share), 0, session.said)
        self.assertEqual(self.pattern(), "grey", "what was there before")
        written = self.rig.read_text()
        self.assertTrue(session.said.count("touch {") == 1 and "mirrored" in session.said, session.said)
        for name, there in (("top_left", (left, top)), ("top_right", (left + wide, top)),
                            ("bottom_left", (left, top + high))):
            for told, true in zip(corner(written, name), (*there, first[2])):
                self.assertAlmostEqual(told, true, delta=0.01, msg=f"{name}\n{session.said}")
        self.assertEqual(written.count("touch {"), 1)
        self.assertIn("# The fence hangs under the roof.", written)
        self.assertIn("# The end.", written)
        self.assertEqual(aquarama("check", self.rig).returncode, 0)
        self.assertIn("the tracker's port is lent to aquarama touch", self.desk.said())
        self.listens(times=2)

    def test_people_stand_at_three_places_of_the_floor(self):
        port = free_udp_port()
        session, tracker = Session(self.rig, "--people", "--listen", f"udp://127.0.0.1:{port}"), Tracker(port, "2Dblb")
        self.addCleanup(tracker.end)

        def share(words):  # of 4 x 4 m from the left of the wall, seen from above
            if "sweet spot" in words:
                x, z = 0, 0
            else:
                x, _, z = (one * (self.radius - 0.3) / self.radius for one in self.point(words))
            return (x + 2) / 4, (z + 3) / 4
        self.assertEqual(self.follow(session, tracker, share), 0, session.said)
        for name, there in (("top_left", (-2, -1.6, -3)), ("top_right", (2, -1.6, -3)), ("bottom_left", (-2, -1.6, 1))):
            for told, true in zip(corner(session.said, name), there):
                self.assertAlmostEqual(told, true, delta=0.03, msg=session.said)
        self.assertIn("people { reach_m: 2.5 }", session.said)
        self.assertEqual(self.rig.read_text(), self.text, "without --write it only tells")
        self.rig.write_text(self.text[:self.text.index("touch {")]
                            + session.said[session.said.index("touch {"):session.said.index("\n}\n")] + "\n}\n")
        self.assertEqual(aquarama("check", self.rig).returncode, 0)

    def test_a_key_and_a_signal_end_it_and_the_wall_is_as_before(self):
        for end in ("key", "signal"):
            session = Session(self.rig, "--write")
            session.mark(1)
            self.assertEqual(self.pattern(), "grid")
            if end == "key":
                session.process.stdin.write("q")
                session.process.stdin.flush()
            else:
                session.process.send_signal(signal.SIGINT)
            self.assertEqual(session.end(), 1)
            self.assertIn("aquarama touch: ended before the last mark; nothing was changed", session.said)
            self.assertEqual((self.pattern(), self.rig.read_text()), ("grey", self.text))

    def test_hands_nearly_in_one_place_are_refused(self):
        session, tracker = Session(self.rig, "--write"), Tracker(self.port)
        self.addCleanup(tracker.end)
        places = iter([(0.5, 0.5), (0.56, 0.5), (0.62, 0.5)])
        for number in (1, 2, 3):
            session.mark(number)
            tracker.hands = {number: next(places)}
        self.assertEqual(session.end(), 1)
        self.assertRegex(session.said, r"\naquarama touch: the three places that were seen .*nearly on one line.*\n$")
        self.assertEqual((self.pattern(), self.rig.read_text()), ("grey", self.text))

    def test_a_doubtful_result_is_told_and_not_written(self):
        session, tracker = Session(self.rig, "--write"), Tracker(self.port)
        self.addCleanup(tracker.end)
        places = iter([(0.1, 0.2), (0.9, 0.2), (0.5, 0.9)])  # the third is at another crossing
        for number in (1, 2, 3):
            session.mark(number)
            tracker.hands = {number: next(places)}
        self.assertEqual(session.end(), 1)
        self.assertIn("doubtful: trackers watch rectangles", session.said)
        self.assertRegex(session.said, r"\naquarama touch: .*\.txtpb is as it was, as the result is doubtful; .*\n$")
        self.assertEqual((self.pattern(), self.rig.read_text()), ("grey", self.text))

    def refused(self, *arguments):
        """What is said in one line; the wall is not touched."""
        done = aquarama("touch", *arguments, timeout=20)
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual((done.stdout, done.stderr.count("\n")), ("", 1), done.stdout + done.stderr)
        return done.stderr

    def test_a_port_of_another_program_and_other_bad_input_are_one_line(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
            other.bind(("127.0.0.1", 0))
            listen = f"udp://127.0.0.1:{other.getsockname()[1]}"
            said = self.refused(self.rig, "--listen", listen)
            self.assertIn(f"cannot listen at {listen}: Address already in use", said)
        for listen in ("udp://0.0.0.0:3333", "3333"):
            self.assertIn("no address of one machine", self.refused(self.rig, "--listen", listen))
        self.assertIn("number of one machine", self.refused(self.rig, "--from", "tracker.local"))
        self.assertIn("no three crossings", self.refused(self.rig, "--share", "0.1"))
        self.assertIn("nowhere.txtpb", self.refused("nowhere.txtpb"))
        self.assertEqual(aquarama("set", self.rig, "black", "on").returncode, 0)
        self.addCleanup(aquarama, "set", self.rig, "black", "off")
        self.assertIn("the wall is black", self.refused(self.rig))
        self.assertEqual(self.pattern(), "grey")


class NoShow(unittest.TestCase):
    def test_without_a_show_there_is_no_grid(self):
        folder = temporary_folder()
        self.addCleanup(folder.cleanup)
        rig = Path(folder.name) / "hall.txtpb"
        text = (ROOT / "config/desk.txtpb").read_text().replace("scenes/", str(ROOT / "config/scenes") + "/")
        rig.write_text(text.replace("7400", "17412"))
        done = aquarama("touch", rig, "--listen", f"udp://127.0.0.1:{free_udp_port()}")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"^aquarama touch: no master answers at tcp://127\.0\.0\.1:17412.*\n$")


if __name__ == "__main__":
    unittest.main(verbosity=2)
