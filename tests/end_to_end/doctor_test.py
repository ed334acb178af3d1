"""Real processes: what the doctor finds before a show, while it runs, and when a node is missing."""

import json
import unittest

from show import aquarama, control_address, end, rig_on_free_ports, start, temporary_folder, wait_until


class Doctor(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder()
        self.rig = rig_on_free_ports(self.folder.name)
        self.processes = []

    def tearDown(self):
        end(self.processes)
        self.folder.cleanup()

    def findings(self):
        """(exit status, {subject: [(verdict, what, todo)]})."""
        run = aquarama("doctor", self.rig, "--json")
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

    def test_a_running_show_tells_of_its_nodes_and_of_one_that_is_missing(self):
        # Shown without a display, so that the monitor of the rig is not there.
        self.rig.write_text(self.rig.read_text().replace("mode: WINDOW", "mode: FULLSCREEN", 1))
        self.processes = [start("master", self.rig, "--pattern", "grid")]
        for name in ("left", "middle"):
            self.processes.append(start("node", name, "--master", control_address(self.rig), "--headless"))
        wait_until(lambda: len(self.findings()[1].get("node left", [])) > 3 and len(self.findings()[1].get("node middle", [])) > 3,
                   60, "the reports of two nodes")
        status, found = self.findings()
        self.assertEqual(status, 1, "right is missing")
        self.assertEqual(found["node right"][0][0], "fail")
        self.assertIn("absent", found["node right"][0][1])
        said = " ".join(what for _, what, _ in found["node left"])
        for word in ("in step", "OpenGL", "build 0.2.0", "round trip", "jitter", "real-time", "free"):
            self.assertIn(word, said)
        self.assertIn("its only monitor, of 0", said)
        self.assertNotIn("monitor", " ".join(what for _, what, _ in found["node middle"]))
        text = aquarama("doctor", self.rig)
        self.assertRegex(text.stdout, r"fail +node right +absent")


if __name__ == "__main__":
    unittest.main(verbosity=2)
