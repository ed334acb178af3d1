"""Real processes: what the doctor finds before a show, while it runs, and when a node is missing."""

import ctypes
import json
import os
import re
import socket
import unittest
from pathlib import Path

from show import (FAKE_TIME, aquarama, at_time, control_address, end, lacks, rig_on_free_ports, start, temporary_folder,
                  wait_until)


class Doctor(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder()
        self.rig = rig_on_free_ports(self.folder.name)
        self.processes = []

    def tearDown(self):
        end(self.processes)
        self.folder.cleanup()

    def findings(self, *arguments, **environment):
        """(exit status, {subject: [(verdict, what, todo)]})."""
        run = aquarama("doctor", self.rig, "--json", *arguments, environment=environment)
        found = {}
        for one in json.loads(run.stdout):
            found.setdefault(one["subject"], []).append((one["verdict"], one["what"], one["todo"]))
        return run.returncode, found

    def test_before_a_show_it_looks_at_this_machine(self):
        status, found = self.findings()
        self.assertEqual(status, 0)
        for subject in ("rig", "scene", "address", "disk", "keys", "ports"):
            self.assertEqual(found[subject][0][0], "pass", subject)
        self.assertEqual(found["show"][0][0], "warn")
        self.rig.write_text(self.rig.read_text().replace("arc_deg: 120", "arc_deg: 1200"))
        status, found = self.findings()
        self.assertEqual((status, list(found)), (1, ["rig"]))
        self.assertRegex(found["rig"][0][1], r"desk\.txtpb:\d+:\d+: ")

    def test_an_address_of_another_machine_fails(self):
        self.rig.write_text(self.rig.read_text().replace("tcp://127.0.0.1", "tcp://192.0.2.7"))
        status, found = self.findings()
        self.assertEqual(status, 1)
        self.assertEqual(found["address"][0][0], "fail")
        self.assertEqual(found["key left"][0][0], "fail")

    def edit(self, *replacements):
        text = self.rig.read_text()
        for old, new in replacements:
            self.assertIn(old, text)
            text = text.replace(old, new)
        self.rig.write_text(text)

    def test_every_address_of_the_loopback_passes(self):
        text = self.rig.read_text()
        for host in ("127.0.1.1", "127.255.9.7", "[::1]", "localhost"):
            with self.subTest(host):
                self.rig.write_text(text.replace("127.0.0.1", host))
                status, found = self.findings()
                self.assertEqual(found["address"][0][0], "pass", found["address"])
                self.assertEqual((status, found["ports"][0][0], found["keys"][0][0]), (0, "pass", "pass"))
        for host in ("[2001:db8::7]", "198.51.100.7"):
            self.rig.write_text(text.replace("127.0.0.1", host))
            self.assertEqual(self.findings()[1]["address"][0][0], "fail", host)

    def test_a_scene_that_is_missing_or_wrong_fails(self):
        self.edit(("reef.txtpb", "atlantis.txtpb"))
        status, found = self.findings()
        self.assertEqual((status, found["scene"][0][0]), (1, "fail"))
        self.assertIn("atlantis.txtpb", found["scene"][0][1])
        wrong = Path(self.folder.name) / "wrong.txtpb"
        wrong.write_text("nothing")
        self.rig.write_text(re.sub(r'scene: "[^"]*"', f'scene: "{wrong}"', self.rig.read_text()))
        self.assertEqual(self.findings()[1]["scene"][0][0], "fail")

    def test_a_disk_without_room_is_a_warning(self):
        status, found = self.findings(XDG_CACHE_HOME="/proc")  # a file system of no size
        self.assertEqual((status, found["disk"][0][0]), (0, "warn"))
        self.assertRegex(found["disk"][0][1], r"^0 GB free at /proc/")

    def test_a_journal_that_cannot_be_written_fails(self):
        folder, room = self.findings()[1]["journal"]
        self.assertRegex(folder[1], r"desk\.journal, the first show makes it$")
        self.assertRegex(room[1], r" free, three days of the show take 450 MB$")
        status, found = self.findings(XDG_STATE_HOME=str(self.rig))  # a file
        self.assertEqual((status, found["journal"][0][0]), (1, "fail"))
        self.assertRegex(found["journal"][0][1], r"desk\.journal: cannot be written \(Not a directory\)")

    def test_a_port_that_another_program_has_fails(self):
        with socket.socket() as other:
            other.bind(("127.0.0.1", int(re.search(r'state: "tcp://127\.0\.0\.1:(\d+)', self.rig.read_text())[1])))
            other.listen()
            status, found = self.findings()
        self.assertEqual((status, found["ports"][0][0]), (1, "fail"))
        self.assertIn("another program does", found["ports"][0][1])

    def test_of_several_machines_the_clock_is_to_be_synchronised(self):
        self.assertEqual(len(self.findings()[1]["clock"]), 1, "one machine has one clock")
        self.edit(('name: "left"', 'name: "left" machine: "pit"'))
        timex = ctypes.create_string_buffer(512)  # modes 0: only asks
        state = ctypes.CDLL(None, use_errno=True).adjtimex(timex)
        verdict = self.findings()[1]["clock"][1]
        self.assertEqual(verdict[:2], ("warn", "not synchronised") if state == 5 else verdict[:2])
        self.assertIn(verdict[0], ("pass", "warn"))

    def keyed(self):
        """A rig of an address that is none of this machine's, with keys; their folder."""
        self.edit(("127.0.0.1", "192.0.2.7"))
        folder = Path(self.folder.name) / "keys"
        self.assertEqual(aquarama("keys", "new", self.rig, "--keys", folder).returncode, 0)
        return folder

    def test_each_state_of_a_key_is_found(self):
        folder = self.keyed()
        key = lambda name: folder / f"{name}.key"
        made = re.search(r'made: "(.*)"', key("left").read_text())[1]
        for name, day in (("left", f"{int(made[:4]) - 2}-01-01"), ("middle", "2999-01-01"), ("right", "long ago")):
            key(name).write_text(key(name).read_text().replace(f'made: "{made}"', f'made: "{day}"'))
        found = self.findings("--keys", folder)[1]
        self.assertEqual(found["key master"][0][:2], ("pass", "0 days old"))
        for name, what in (("left", r"^\d\d\d+ days old$"), ("middle", "^made on 2999-01-01, and the clock"),
                           ("right", "^made on long ago, ")):
            self.assertEqual(found[f"key {name}"][0][0], "warn", name)
            self.assertRegex(found[f"key {name}"][0][1], what)
        self.assertEqual(aquarama("keys", "revoke", self.rig, "left", "--keys", folder).returncode, 0)
        key("middle").chmod(0o644)
        key("right").unlink()
        found = self.findings("--keys", folder)[1]
        for name, what in (("left", "was revoked on"), ("middle", "others than its owner may read this key"),
                           ("right", r"right\.key")):
            self.assertEqual(found[f"key {name}"][0][0], "fail", name)
            self.assertRegex(found[f"key {name}"][0][1], what)

    @unittest.skipIf(*lacks(FAKE_TIME, "libfaketime"))
    def test_a_clock_before_the_build_is_named_and_makes_no_keys(self):
        folder = self.keyed()
        in_1970 = at_time("1970-01-01 00:10:00")
        status, found = self.findings("--keys", folder, **in_1970)
        self.assertEqual(status, 1)
        self.assertEqual(found["clock"][0][0], "fail")
        self.assertRegex(found["clock"][0][1],
                         r"^the clock of this machine says 1970-01-01, before this program was built "
                         r"\(20\d\d-\d\d-\d\d\)$")
        self.assertEqual(found["key left"][0][0], "warn")
        self.assertRegex(found["key left"][0][1],
                         r"^made on 20\d\d-\d\d-\d\d, and the clock of this machine says 1970-01-01$")
        before = {path: path.read_text() for path in folder.iterdir()}
        for command in (("new", self.rig), ("rotate", self.rig, "left"), ("rotate", self.rig, "master")):
            run = aquarama("keys", *command, "--keys", folder, environment=in_1970)
            self.assertEqual(run.returncode, 1)
            self.assertRegex(run.stderr,
                             r"\Aaquarama keys \w+: the clock of this machine says 1970-01-01, .*: no key is made now; "
                             r"set it .*\n\Z")
        self.assertEqual({path: path.read_text() for path in folder.iterdir()}, before)
        self.assertIn("1970-01-01", aquarama("keys", "list", self.rig, "--keys", folder, environment=in_1970).stderr)
        # Who is to be kept out is kept out at once, whatever the clock says.
        self.assertEqual(aquarama("keys", "revoke", self.rig, "left", "--keys", folder, environment=in_1970).returncode,
                         0)
        self.assertRegex((folder / "left.key").read_text(), r'revoked: "20\d\d-')

    @unittest.skipIf(*lacks(FAKE_TIME, "libfaketime"))
    def test_the_end_of_a_consoles_certificate_and_of_its_authority_is_found(self):
        self.assertNotIn("certificate", self.findings()[1], "there is none")
        made = aquarama("console", self.rig, "--certify", "127.0.0.2", environment=at_time("2030-01-01 12:00:00"))
        self.assertEqual(made.returncode, 0, made.stderr)
        for time, verdicts, what in (("2030-02-01 11:00:00", "pass pass", "valid until 2031-02-02"),
                                     ("2031-01-10 11:00:00", "warn pass", "in 23 days"),
                                     ("2031-01-30 11:00:00", "fail pass", "in 3 days"),
                                     ("2039-11-01 11:00:00", "fail warn", "ran out on 2031-02-02"),
                                     ("2039-12-29 11:00:00", "fail fail", "ran out on"),
                                     ("2029-06-01 11:00:00", "fail fail", "is not valid before 2029-12-31")):
            found = self.findings(**at_time(time))[1]
            self.assertEqual(" ".join(found[subject][0][0] for subject in ("certificate", "authority")), verdicts, time)
            self.assertIn(what, found["certificate"][0][1])
        file = next(Path(os.environ["XDG_STATE_HOME"]).glob("aquarama/console/desk/tls/certificate.pem"))
        file.write_text("nothing")
        self.assertEqual(self.findings()[1]["certificate"][0][0], "fail")

    def test_a_running_show_tells_of_its_nodes_and_of_one_that_is_missing(self):
        # Shown without a display, so that the monitor of the rig is not there.
        self.rig.write_text(self.rig.read_text().replace("mode: WINDOW", "mode: FULLSCREEN", 1))
        self.processes = [start("master", self.rig, "--pattern", "grid")]
        for name in ("left", "middle"):
            self.processes.append(start("node", name, "--master", control_address(self.rig), "--headless"))
        wait_until(lambda: len(self.findings()[1].get("node left", [])) > 3
                   and len(self.findings()[1].get("node middle", [])) > 3,
                   60, "the reports of two nodes")
        status, found = self.findings()
        self.assertEqual(status, 1, "right is missing")
        self.assertEqual(found["node right"][0][0], "fail")
        self.assertIn("absent", found["node right"][0][1])
        said = " ".join(what for _, what, _ in found["node left"])
        for word in ("in step", "OpenGL", "build 0.3.0", "round trip", "jitter", "real-time", "free"):
            self.assertIn(word, said)
        self.assertIn("its only monitor, of 0", said)
        self.assertNotIn("monitor", " ".join(what for _, what, _ in found["node middle"]))
        text = aquarama("doctor", self.rig)
        self.assertRegex(text.stdout, r"fail +node right +absent")


if __name__ == "__main__":
    unittest.main(verbosity=2)
