"""Real processes: the figures of a running show, the dashboard that draws them, and the log of all nodes."""

import json
import re
import subprocess
import unittest
import urllib.request
from pathlib import Path

from show import CHANNELS, ROOT, control_address, end, rig_on_free_ports, start, temporary_folder, wait_until

PATIENCE = 60  # seconds: software OpenGL builds for some


def port_of(rig):
    return int(re.search(r"metrics_port: (\d+)", Path(rig).read_text()).group(1))


def figures(port):
    """{name with labels: value} of the process that serves there; empty where none does."""
    try:
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/metrics", timeout=5) as reply:
            lines = reply.read().decode().splitlines()
    except OSError:
        return {}
    return {line.rsplit(" ", 1)[0]: float(line.rsplit(" ", 1)[1]) for line in lines if line
            and not line.startswith("#")}


class Metrics(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder()
        self.rig = rig_on_free_ports(self.folder.name)
        self.port = port_of(self.rig)
        self.processes = [start("master", self.rig, "--pattern", "grid")]
        for name in CHANNELS:
            self.start_node(name)
        wait_until(lambda: all(self.master(f'aquarama_node_condition{{node="{name}"}}') == 3 for name in CHANNELS),
                   PATIENCE, "all in step")

    def tearDown(self):
        end(self.processes)
        self.folder.cleanup()

    def start_node(self, name):
        self.processes.append(start("node", name, "--master", control_address(self.rig), "--headless"))

    def master(self, name):
        return figures(self.port).get(name)

    def log(self):
        path = Path(self.folder.name) / "state/aquarama/logs/desk.jsonl"
        return [json.loads(line) for line in path.read_text().splitlines()
                if line.endswith("}")] if path.exists() else []

    def test_the_figures_go_on_with_the_show(self):
        before = figures(self.port)
        wait_until(lambda: self.master("aquarama_frames_total") > before["aquarama_frames_total"] + 30, PATIENCE,
                   "30 frames")
        wait_until(lambda: self.master("aquarama_release_skew_seconds_count") > 0, PATIENCE, "a skew of all three")
        self.assertEqual(before["aquarama_fish"], 381)
        self.assertEqual(before["aquarama_black"], 0)
        self.assertGreater(self.master("aquarama_state_bytes_total"), before["aquarama_state_bytes_total"])
        self.assertEqual(self.master("aquarama_journal_written"), 1)
        self.assertLess(self.master("aquarama_journal_save_age_seconds"), 30)
        self.assertGreater(self.master("aquarama_journal_bytes"), self.master("aquarama_journal_file_bytes"))
        self.assertGreater(self.master("aquarama_journal_free_disk_bytes"), 1e6)
        for place, name in enumerate(CHANNELS):
            node = figures(self.port + 1 + place)
            self.assertGreater(node["aquarama_presented_total"], 0, name)
            self.assertGreater(node["aquarama_picture_seconds_count"], 0, name)
            self.assertGreater(node["aquarama_received_bytes_total"], 0, name)
            self.assertEqual(node["aquarama_hash_mismatches_total"], 0, name)
            self.assertLess(abs(node["aquarama_clock_offset_seconds"]), 0.01, f"{name}: one machine has one clock")

    def test_nobody_but_this_machine_is_served(self):
        listening = subprocess.run(["ss", "-tln"], capture_output=True, text=True, check=True).stdout
        addresses = [line.split()[3] for line in listening.splitlines()[1:]
                     if line.split()[3].endswith(f":{self.port}")]
        self.assertEqual(addresses, [f"127.0.0.1:{self.port}"])

    def test_the_dashboard_draws_figures_that_there_are(self):
        served = {re.sub(r"\{.*", "", name) for port in range(self.port, self.port + 4) for name in figures(port)}
        dashboard = json.loads((ROOT / "packaging/grafana/aquarama.json").read_text())
        drawn = set(re.findall(r"aquarama_\w+", " ".join(t["expr"] for p in dashboard["panels"] for t in p["targets"])))
        self.assertGreater(len(drawn), 10)
        of_fleet = {name for name in drawn if name.startswith("aquarama_doctor_")}  # tests/packaging/ansible_test.py
        self.assertEqual(drawn - served, of_fleet)

    def test_one_log_has_the_lines_of_all_with_node_and_frame(self):
        wait_until(lambda: {"master", *CHANNELS} <= {line["node"] for line in self.log()}, PATIENCE, "a line of each")
        for line in self.log():
            self.assertEqual(list(line), ["time", "node", "frame", "severity", "text"])
            self.assertRegex(line["time"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z$")
        self.processes[1].kill()
        gone = lambda line: line["node"] == "master" and "left is not counted" in line["text"]  # noqa: E731
        wait_until(lambda: any(map(gone, self.log())), PATIENCE, "the master's line of a node that was killed")
        line = next(filter(gone, self.log()))
        self.assertEqual(line["severity"], "warning")
        self.assertGreater(line["frame"], 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
