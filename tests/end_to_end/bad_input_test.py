"""Bad input gets one line that says what and where, and a status other than 0."""

import os
import re
import socket
import subprocess
import time
import unittest
from pathlib import Path

from show import BIN, ROOT, aquarama, control_address, rig_on_free_ports, temporary_folder


class BadInput(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder()

    def tearDown(self):
        self.folder.cleanup()

    def refuses(self, expected, *arguments, **options):
        run = aquarama(*arguments, timeout=60, **options)
        self.assertNotEqual(run.returncode, 0, run.stdout)
        errors = [line for line in run.stderr.splitlines() if re.search(expected, line)]
        self.assertTrue(errors, f"no line of this says {expected}:\n{run.stderr}")
        return run

    def edited(self, *replace):
        return rig_on_free_ports(self.folder.name, replace=replace)

    def test_an_unknown_field_is_named_with_its_place(self):
        rig = self.edited((r"screen \{", "screen { curvature: 3"))
        self.refuses(r"desk\.txtpb:\d+:\d+:.*curvature", "check", rig)

    def test_overlapping_ids(self):
        rig = self.edited((r"\bid: 2\b", "id: 1"))
        self.refuses(r"desk\.txtpb:\d+:\d+:.*\b1\b", "check", rig)

    def test_a_projector_that_misses_the_screen(self):
        rig = Path(self.edited())
        text = re.sub(r"yaw_deg: *-?[\d.]+", "yaw_deg: 170", rig.read_text(), count=1)
        rig.write_text(text)
        self.refuses(r"desk\.txtpb:\d+:\d+:.*(misses|screen)", "check", rig)

    def test_a_window_of_no_size(self):
        rig = self.edited((r"width_px: *480", "width_px: 0"))
        self.refuses(r"desk\.txtpb:\d+:\d+:", "check", rig)

    def test_a_rig_that_is_not_there(self):
        self.refuses(r"nowhere\.txtpb", "check", "nowhere.txtpb")
        self.refuses(r"nowhere\.txtpb", "run", "nowhere.txtpb", "--headless", "--frames", 1)

    def test_a_scene_that_is_not_there(self):
        self.refuses(r"nowhere\.txtpb", "run", self.edited(), "--headless", "--frames", 1, "--scene", "nowhere.txtpb")
        rig = self.edited((r"reef\.txtpb", "atlantis.txtpb"))
        self.refuses(r"desk\.txtpb:\d+:\d+:.*atlantis", "run", rig, "--headless", "--frames", 1)
        self.refuses(r"desk\.txtpb:\d+:\d+:.*atlantis", "check", rig)

    def test_a_mistake_in_a_scene_and_in_a_species_of_it(self):
        scene = (ROOT / "config/scenes/reef.txtpb").read_text().replace("../species", str(ROOT / "config/species"))
        own = Path(self.folder.name) / "own.txtpb"
        for wrong, expected in [
            (scene.replace("plankton: 300", "plankton: -3"), r"own\.txtpb:\d+:\d+: .*"),
            (scene.replace("blue_tang", "mermaid"), r"own\.txtpb:\d+:\d+: .*mermaid"),
            (scene.replace(str(ROOT / "config/species/parrotfish"), "odd"), r"odd\.txtpb:\d+:\d+: .*hunts"),
        ]:
            species = (ROOT / "config/species/parrotfish.txtpb").read_text()
            hunt = 'hunt { prey: "clownfish" chase_s: 1 give_up_m: 1 rest_s: 1 }'
            (Path(self.folder.name) / "odd.txtpb").write_text(species.replace("persistence:", hunt + " persistence:"))
            own.write_text(wrong)
            self.refuses(expected, "check", own)
            self.refuses(expected, "run", self.edited(), "--headless", "--frames", 1, "--scene", own)

    def test_a_number_of_fish_that_the_scene_cannot_hold(self):
        reef = ROOT / "config/scenes/reef.txtpb"
        for fish, expected in [(0, "only an open sea"), (999_000, "room for"), (2_000_000, "--fish")]:
            self.refuses(expected, "run", self.edited(), "--headless", "--frames", 1, "--scene", reef, "--fish", fish)

    def test_binding_past_the_loopback_is_refused(self):
        rig = self.edited((r"tcp://127\.0\.0\.1:", "tcp://0.0.0.0:"))
        self.refuses("loopback|keys", "run", rig, "--headless", "--frames", 1)

    def test_a_malformed_address(self):
        self.refuses("address|tcp://", "node", "left", "--master", "somewhere", "--headless")

    def test_an_occupied_port(self):
        rig = self.edited()
        port = int(control_address(rig).rsplit(":", 1)[1])
        with socket.socket() as other:
            other.bind(("127.0.0.1", port))
            other.listen()
            self.refuses(str(port), "run", rig, "--headless", "--frames", 1)

    def test_a_channel_that_the_rig_does_not_have(self):
        rig = self.edited()
        master = subprocess.Popen([BIN / "aquarama-master", rig, "--pattern", "grid"], stderr=subprocess.DEVNULL, cwd=ROOT)
        try:
            time.sleep(0.3)
            self.refuses("ceiling", "node", "ceiling", "--master", control_address(rig), "--headless")
        finally:
            master.terminate()
            master.wait(15)

    def test_a_window_without_a_display(self):
        rig = self.edited()
        environment = {"DISPLAY": "", "WAYLAND_DISPLAY": ""}
        self.refuses("headless", "run", rig, "--frames", 1, environment=environment)

    def test_a_device_that_is_not_there(self):
        rig = self.edited()
        text = Path(rig).read_text()
        Path(rig).write_text(re.sub(r'device: *"\w+"', 'device: "device:77"', text) if "device:" in text else text)
        self.refuses("device:77", "run", rig, "--headless", "--frames", 1)

    def test_no_opengl_4_5(self):
        environment = {"MESA_GL_VERSION_OVERRIDE": "4.1"}
        self.refuses(r"4\.5", "run", self.edited(), "--headless", "--frames", 1, environment=environment)

    def test_a_damaged_repertoire(self):
        out = aquarama("capture", "--species", "bigeye_scad", "--out", self.folder.name)
        self.assertEqual(out.returncode, 0, out.stderr)
        whole = next(Path(self.folder.name).glob("*.aqrep"))
        content = bytearray(whole.read_bytes())
        self.assertEqual(aquarama("inspect", whole).returncode, 0)
        whole.write_bytes(content[:-100])
        self.refuses(whole.name, "inspect", whole)
        content[len(content) // 2] ^= 1
        whole.write_bytes(content)
        self.refuses(whole.name, "inspect", whole)

    def test_unknown_arguments_and_commands(self):
        self.refuses("--warp-nine", "run", "--warp-nine")
        self.refuses("dance", "dance")
        for command in ["run", "master", "node", "capture", "check", "inspect", "export", "status", "explain", "replay"]:
            asked = aquarama(command, "--help")
            self.assertEqual(asked.returncode, 0, f"{command} --help: {asked.stderr}")
            self.assertIn("--help", asked.stdout)

    def test_a_folder_that_cannot_be_written(self):
        blocked = Path(self.folder.name) / "file"
        blocked.write_text("")
        self.refuses("file", "run", self.edited(), "--headless", "--frames", 1, "--snapshot", blocked / "pictures")


if __name__ == "__main__":
    unittest.main(verbosity=2)
