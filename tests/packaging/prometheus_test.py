"""The example of a fleet's Prometheus: Debian's own tool reads it, its alarms fire, and it brings figures of a hall."""

import base64
import http.server
import json
import os
import shutil
import socket
import ssl
import subprocess
import tempfile
import threading
import time
import unittest
import urllib.error
import urllib.request
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parents[2] / "packaging/prometheus"
PASSWORD = "of the hall"
HASH = "$2y$05$tOtJDh2qV/f3KiE.avucZ.twrdlTFVAiVqByImPFfPSrY86ZI7QBa"  # of it, as htpasswd -nB prints it
RULES = """
rule_files: [aquarama.rules.yml]
evaluation_interval: 1m
tests:
  - interval: 1m
    input_series:
      - {series: 'aquarama_doctor_findings{hall="north",verdict="fail"}', values: "2x60"}
      - {series: 'aquarama_doctor_findings{hall="south",verdict="fail"}', values: "0x60"}
      - {series: 'aquarama_doctor_findings{hall="south",verdict="warn"}', values: "7x60"}
      - {series: 'aquarama_doctor_answered{hall="east",master="192.168.10.1"}', values: "0x60"}
      - {series: 'aquarama_doctor_answered{hall="north",master="192.168.7.1"}', values: "1x60"}
      - {series: 'aquarama_node_condition{hall="north",node="left"}', values: "1x60"}
      - {series: 'aquarama_node_condition{hall="north",node="right"}', values: "3x60"}
      - {series: 'aquarama_frames_total{hall="north"}', values: "0+3600x60"}
      - {series: 'aquarama_frames_total{hall="south"}', values: "5x60"}
    alert_rule_test:
      - eval_time: 20m
        alertname: HallHasFault
        exp_alerts:
          - exp_labels: {hall: north, verdict: fail}
            exp_annotations: {summary: "north: the doctor has 2 faults; ask aquarama doctor there"}
      - {eval_time: 5m, alertname: HallHasFault}
      - eval_time: 20m
        alertname: HallSilent
        exp_alerts:
          - exp_labels: {hall: east, master: 192.168.10.1}
            exp_annotations: {summary: "east: its doctor does not answer; is 192.168.10.1 on, and reached by ssh?"}
      - eval_time: 20m
        alertname: NodeAbsent
        exp_alerts:
          - exp_labels: {hall: north, node: left}
            exp_annotations: {summary: "north: the node left is absent"}
      - eval_time: 20m
        alertname: WallStands
        exp_alerts:
          - exp_labels: {hall: south}
            exp_annotations: {summary: "south: the master makes no frames"}
"""


def called(*command, **more):
    return subprocess.run([*map(str, command)], capture_output=True, text=True, check=False, timeout=60, **more)


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Figures(http.server.BaseHTTPRequestHandler):
    """A master's figures, as it serves them to its own machine."""

    def do_GET(self):
        self.send_response(200)
        self.end_headers()
        self.wfile.write(b"# TYPE aquarama_fish gauge\naquarama_fish 381\n")

    def log_message(self, *_):
        pass


HAS_PROMETHEUS = shutil.which("promtool") and shutil.which("prometheus")


@unittest.skipIf(not HAS_PROMETHEUS and not os.environ.get("CI"), "prometheus is not installed (packaging/packages)")
class Fleet(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="aquarama-")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        for example in EXAMPLES.iterdir():
            text = example.read_text().replace("/etc/prometheus", str(self.folder))
            (self.folder / example.name).write_text(text)
        made = called("openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes",
                      "-days", "2", "-subj", "/CN=fleet", "-addext", "subjectAltName=IP:127.0.0.1", "-keyout",
                      self.folder / "fleet-key.pem", "-out", self.folder / "fleet.pem")
        self.assertEqual(made.returncode, 0, made.stderr)
        (self.folder / "fleet.password").write_text(PASSWORD)
        self.edit("web.yml", ("NORTH", HASH))

    def edit(self, name, *replacements):
        text = (self.folder / name).read_text()
        for old, new in replacements:
            self.assertIn(old, text)
            text = text.replace(old, new)
        (self.folder / name).write_text(text)

    def test_its_own_tool_reads_all_files(self):
        for kind, name in (("config", "fleet.yml"), ("rules", "aquarama.rules.yml"), ("web-config", "web.yml")):
            done = called("promtool", "check", kind, self.folder / name)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        done = called("promtool", "check", "config", "--agent", self.folder / "hall.yml")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.edit("fleet.yml", ("scrape_interval", "scrape_intervall"))
        self.assertNotEqual(called("promtool", "check", "config", self.folder / "fleet.yml").returncode, 0)

    def test_the_dashboard_asks_what_prometheus_understands(self):
        dashboard = json.loads((EXAMPLES.parent / "grafana/aquarama.json").read_text())
        asked = [target["expr"] for panel in dashboard["panels"] for target in panel["targets"]]
        self.assertTrue(all('hall=~"$hall"' in question for question in asked), asked)
        rules = [{"record": "asked", "labels": {"number": str(number)}, "expr": question.replace("$hall", ".*")}
                 for number, question in enumerate(asked)]
        (self.folder / "asked.yml").write_text(json.dumps({"groups": [{"name": "dashboard", "rules": rules}]}))
        done = called("promtool", "check", "rules", self.folder / "asked.yml")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_each_alarm_fires_for_its_cause_alone(self):
        (self.folder / "test.yml").write_text(RULES)
        done = called("promtool", "test", "rules", "test.yml", cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def run_prometheus(self, config, port, *arguments):
        log = open(self.folder / f"{config}.log", "w")
        self.addCleanup(log.close)
        process = subprocess.Popen(["prometheus", f"--config.file={self.folder / config}",
                                    f"--web.listen-address=127.0.0.1:{port}", *arguments], stdout=log, stderr=log,
                                   cwd=self.folder)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)

    def answer(self, port, password):
        """What the fleet knows of the fish of its halls; None where it does not say."""
        word = base64.b64encode(f"north:{password}".encode()).decode()
        question = urllib.request.Request(f"https://127.0.0.1:{port}/api/v1/query?query=aquarama_fish",
                                          headers={"Authorization": f"Basic {word}"})
        try:
            context = ssl.create_default_context(cafile=self.folder / "fleet.pem")
            with urllib.request.urlopen(question, timeout=5, context=context) as reply:
                return json.load(reply)["data"]["result"]
        except urllib.error.HTTPError as refusal:
            return refusal.code
        except OSError:
            return None

    def test_figures_of_a_hall_come_to_the_fleet_over_tls_and_by_a_password(self):
        hall = http.server.HTTPServer(("127.0.0.1", 0), Figures)
        self.addCleanup(hall.server_close)
        threading.Thread(target=hall.serve_forever, daemon=True).start()
        self.addCleanup(hall.shutdown)
        fleet, agent = free_port(), free_port()
        self.edit("hall.yml", ("127.0.0.1:7410", f"127.0.0.1:{hall.server_port}"), ("10s", "1s"),
                  ("fleet.example:9090", f"127.0.0.1:{fleet}"))
        self.run_prometheus("fleet.yml", fleet, "--web.enable-remote-write-receiver",
                            f"--web.config.file={self.folder}/web.yml", f"--storage.tsdb.path={self.folder}/fleet")
        self.run_prometheus("hall.yml", agent, "--enable-feature=agent", f"--storage.agent.path={self.folder}/agent")
        deadline = time.monotonic() + 60
        while not (found := self.answer(fleet, PASSWORD)) and time.monotonic() < deadline:
            time.sleep(0.5)
        self.assertTrue(found, (self.folder / "hall.yml.log").read_text() + (self.folder / "fleet.yml.log").read_text())
        self.assertEqual((found[0]["metric"]["hall"], found[0]["metric"]["machine"], found[0]["value"][1]),
                         ("north", "north-main", "381"))
        self.assertEqual(self.answer(fleet, "a guess"), 401)


if __name__ == "__main__":
    unittest.main(verbosity=2)
