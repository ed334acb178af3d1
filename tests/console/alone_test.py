"""A console without a show: its certificate, its clock, and a proxy that ends TLS before it."""

import http.client
import json
import os
import re
import shutil
import socket
import ssl
import subprocess
import threading
import time
import unittest
from pathlib import Path

from desk import BIN, Socket, aquarama, end, rig_on_free_ports, temporary_folder, wait_until
from show import FAKE_TIME, at_time, free_ports, lacks, ROOT


class Alone(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder()
        self.rig = rig_on_free_ports(self.folder.name)
        self.state = Path(os.environ["XDG_STATE_HOME"]) / "aquarama/console/desk"
        self.processes = []

    def tearDown(self):
        end(self.processes)
        self.folder.cleanup()

    def start(self, *arguments, environment=None):
        """Its log's path, as soon as it listens."""
        log = Path(self.folder.name) / f"log-{len(self.processes)}"
        with open(log, "w") as output:
            self.processes.append(subprocess.Popen([BIN / "aquarama-console", self.rig, "--port", "0", *arguments],
                                                   stdout=output, stderr=output,
                                                   env=os.environ | (environment or {})))
        wait_until(lambda: "console at" in log.read_text(), 20, "the console")
        self.address = re.search(r"console at https?://(\S+)", log.read_text())[1]
        return log

    def certify(self, *names, **options):
        made = aquarama("console", self.rig, "--certify", *names, **options)
        self.assertEqual(made.returncode, 0, made.stderr)
        return self.state / "tls"

    def token(self, **options):
        return aquarama("console", self.rig, "--token", "test", "--role", "crew", **options).stdout.strip()

    def alerts(self, connection=None):
        """Texts of the alerts that fire, by a WebSocket of a token."""
        client = Socket(self, Origin=None, Authorization=f"Bearer {self.token()}", raw=connection)
        told = client.hear_until(lambda message: isinstance(message, dict) and message.get("alerts", {}).get("alerts"))
        client.close()
        return [alert["text"] for alert in told["alerts"]["alerts"] if alert["state"] == "firing"]

    def over_tls(self, verify=None):
        """A connection to the console over TLS."""
        host, port = self.address.split(":")
        context = ssl.create_default_context(cafile=verify)
        if not verify:
            context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
        return context.wrap_socket(socket.create_connection((host, int(port)), timeout=10), server_hostname=host)


class FirstStart(Alone):
    def test_pages_say_what_the_master_prepares(self):
        master = subprocess.Popen([BIN / "aquarama", "master", self.rig], stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL, cwd=ROOT,
                                  env=os.environ | {"XDG_CACHE_HOME": self.folder.name + "/none"})
        try:
            self.start()
            client = Socket(self, Origin=None, Authorization=f"Bearer {self.token()}")
            says_what = lambda message: "capturing" in message.get("wall", {}).get("preparing", "")  # not at once
            wall = client.hear_until(says_what)["wall"]
            self.assertRegex(wall["preparing"], r"^the master prepares: capturing 15 of 15 species, \d+ %$")
            self.assertFalse(wall["heard"])
            client.close()
        finally:
            master.kill()
            master.wait()


class Certificates(Alone):
    @unittest.skipIf(*lacks(FAKE_TIME, "libfaketime"))
    def test_one_that_ran_out_while_the_console_was_off_is_renewed_at_its_start(self):
        folder = self.certify("127.0.0.2")
        first = (folder / "certificate.pem").read_text()
        log = self.start("--listen", "127.0.0.2", environment=at_time("2028-03-01 12:00:00"))
        self.assertRegex(log.read_text(), r"certificate is renewed until 2029-04-02")
        with self.over_tls() as connection:
            served = ssl.DER_cert_to_PEM_cert(connection.getpeercert(True))
        self.assertNotEqual(served.split(), first.split())
        self.assertEqual(served.split(), (folder / "certificate.pem").read_text().split())

    @unittest.skipIf(*lacks(FAKE_TIME, "libfaketime"))
    def test_one_that_cannot_be_renewed_is_an_alert_and_in_the_log_and_doctor(self):
        folder = self.certify("127.0.0.2")
        (folder / "authority.key").unlink()
        then = time.strftime("%Y-%m-%d 12:00:00", time.gmtime(time.time() + (397 - 20) * 86400))
        log = self.start("--listen", "127.0.0.2", environment=at_time(then))
        wait_until(lambda: "runs out on" in log.read_text(), 20, "a line of the log")
        self.assertRegex(log.read_text(),
                         r"\[warning\] the console's certificate runs out on \d{4}-\d\d-\d\d, in (19|20) days; it "
                         r"cannot be renewed: "
                                          r"\S+authority\.key: the authority's key is not there; put it back, or make "
                                          r"another authority")
        with self.over_tls() as connection:
            self.assertRegex(" ".join(self.alerts(connection)), r"certificate runs out on .* in (19|20) days")
        self.assertRegex(aquarama("doctor", self.rig, environment=at_time(then)).stdout,
                         r"(?m)^warn  certificate +runs out on \S+, in (19|20) days: ")

    def test_another_one_is_taken_live_and_who_is_connected_stays(self):
        folder = self.certify("127.0.0.2")
        self.start("--listen", "127.0.0.2")
        with self.over_tls(folder / "authority.pem") as connection:
            first = connection.getpeercert()["serialNumber"]
            client = Socket(self, Origin=None, Authorization=f"Bearer {self.token()}", raw=connection)
            client.hear()
            self.certify("127.0.0.2", "master.local")  # by hand, while it runs

            def serial():
                with self.over_tls(folder / "authority.pem") as fresh:
                    return fresh.getpeercert()["serialNumber"]
            wait_until(lambda: serial() != first, 30, "the other certificate")
            events = client.hear_until(lambda message: "events" in message)["events"]["events"]
            self.assertIn("another certificate, valid until", events[0]["what"])
            now = time.time()
            client.hear_until(lambda message: "wall" in message and message["wall"]["nowS"] > now)

    def test_a_key_that_does_not_fit_is_said_and_the_last_certificate_stays(self):
        folder = self.certify("127.0.0.2")
        log = self.start("--listen", "127.0.0.2")
        (folder / "certificate.pem").write_text("nothing")
        wait_until(lambda: "[warning]" in log.read_text(), 30, "a line of the log")
        self.assertRegex(log.read_text(), r"certificate\.pem: is no certificate with its key beside it")
        with self.over_tls(folder / "authority.pem") as connection:
            self.assertTrue(connection.getpeercert())


@unittest.skipIf(*lacks(FAKE_TIME, "libfaketime"))
class WrongClock(Alone):
    def test_it_is_named_and_nothing_is_made(self):
        refused = aquarama("console", self.rig, "--certify", "127.0.0.2", environment=at_time("1970-01-01 00:10:00"))
        self.assertEqual(refused.returncode, 1)
        self.assertRegex(refused.stderr,
                         r"\Aaquarama console: the clock of this machine says 1970-01-01, before this program was "
                         r"built "
                                         r"\(20\d\d-\d\d-\d\d\): no certificate is made now; set it .*\n\Z")
        self.assertFalse((self.state / "tls/certificate.pem").exists())
        log = self.start(environment=at_time("1970-01-01 00:10:00"))
        wait_until(lambda: "[warning] the clock of this machine says 1970-01-01" in log.read_text(), 20,
                   "a line of the log")
        self.assertRegex(" ".join(self.alerts()),
                         "the clock of this machine says 1970-01-01.*hours and certificates rest")

    def test_hours_switch_nothing_by_it(self):
        for clock, wanted in ((None, True), ("1970-01-01 12:00:00", False)):
            with self.subTest(clock):
                heard = []
                port = self.projector(heard)
                self.state.mkdir(parents=True, exist_ok=True)
                days = "MONDAY, TUESDAY, WEDNESDAY, THURSDAY, FRIDAY, SATURDAY, SUNDAY"
                (self.state / "hours.txtpb").write_text(
                    f'zone: "UTC"\nopen {{ days: [{days}] from: "00:00" to: "24:00" }}\n'
                                                        f'projectors {{ name: "left" address: "127.0.0.1:{port}" }}\n')
                log = self.start(environment=at_time(clock) if clock else None)
                self.assertNotIn("there are no hours", log.read_text())
                wait_until(lambda: any(b"POWR ?" in line for line in heard), 20, "a question of the console")
                if wanted:
                    wait_until(lambda: any(b"POWR 1" in line for line in heard), 20, "the lamp")
                else:
                    time.sleep(4)  # as many looks at the hours
                    self.assertFalse([line for line in heard if b"POWR 1" in line or b"POWR 0" in line])
                end([self.processes.pop()])

    def projector(self, heard):
        """A port where one in standby answers; what it is told comes into `heard`."""
        server = socket.create_server(("127.0.0.1", 0))
        self.addCleanup(server.close)

        def talk(connection):
            with connection:
                connection.sendall(b"PJLINK 0\r")
                while text := connection.recv(1000):
                    for line in text.split(b"\r"):
                        heard.append(line)
                        if line.startswith(b"%"):
                            connection.sendall(line[:6] + b"=" + (b"0" if line.endswith(b"?") else b"OK") + b"\r")

        def serve():
            while True:
                try:
                    threading.Thread(target=talk, args=(server.accept()[0],), daemon=True).start()
                except OSError:
                    return
        threading.Thread(target=serve, daemon=True).start()
        return server.getsockname()[1]


@unittest.skipIf(*lacks(shutil.which("nginx") or Path("/usr/sbin/nginx").exists(), "nginx-light"))
class Proxy(Alone):
    def setUp(self):
        super().setUp()
        self.tls = self.certify("wall.example")
        self.port, = free_ports(1)
        self.name = f"wall.example:{self.port}"

    def snippet(self):
        """The settings of docs/console.md, with files and ports of this test."""
        text = re.search(r"(?ms)^    map \$http_upgrade.*?^    }\n    server \{.*?^    }\n",
                         (ROOT / "docs/console.md").read_text())[0]
        for old, new in (("443 ssl", f"127.0.0.1:{self.port} ssl"),
                         ("/etc/ssl/certs/wall.example.pem", str(self.tls / "certificate.pem")),
                         ("/etc/ssl/private/wall.example.key", str(self.tls / "certificate.key")),
                         ("127.0.0.1:7480", self.address)):
            assert text.count(old) == 1, old
            text = text.replace(old, new)
        return text

    def start_proxy(self):
        folder = Path(self.folder.name) / "nginx"
        folder.mkdir()
        paths = "".join(f"{kind}_temp_path {folder}/{kind};"
                        for kind in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi"))
        user = "user root;" if os.geteuid() == 0 else ""
        (folder / "conf").write_text(f"{user} pid {folder}/pid; error_log {folder}/error; daemon off; events {{}}\n"
                                     f"http {{ access_log off; {paths}\n{self.snippet()} }}\n")
        nginx = shutil.which("nginx") or "/usr/sbin/nginx"
        self.processes.append(subprocess.Popen([nginx, "-p", folder, "-c", folder / "conf", "-e", folder / "error"]))
        wait_until(self.is_there, 20, "nginx")

    def is_there(self):
        try:
            self.connect().close()
            return True
        except OSError:
            return False

    def connect(self, source="127.0.0.1"):
        """To nginx, from an address of this machine."""
        raw = socket.create_connection(("127.0.0.1", self.port), timeout=10, source_address=(source, 0))
        return ssl.create_default_context(cafile=self.tls / "authority.pem").wrap_socket(
            raw, server_hostname="wall.example")

    def ask(self, method, target, body=None, source="127.0.0.1", direct=False, **headers):
        """Status, headers and text, through the proxy or past it."""
        host, port = self.address.split(":")
        connection = http.client.HTTPConnection("wall.example")
        connection.sock = (socket.create_connection((host, int(port)), timeout=10, source_address=(source, 0)) if direct
                           else self.connect(source))
        given = {"Host": self.name} | {name.replace("_", "-"): value for name, value in headers.items()}
        if body is not None:
            given["Content-Type"] = "application/json"
        connection.request(method, target, json.dumps(body) if body is not None else None, given)
        answer = connection.getresponse()
        text = answer.read().decode()
        connection.close()
        return answer.status, dict(answer.getheaders()), text

    def pair(self, code, source="127.0.0.1", origin=None):
        return self.ask("POST", "/pair", {"code": code, "name": "tablet"}, source,
                        Origin=origin or f"https://{self.name}")

    def test_it_is_refused_by_name_without_the_option(self):
        self.start()
        self.start_proxy()
        status, _, text = self.ask("GET", "/")
        self.assertEqual(status, 421)
        self.assertIn("--public", text)
        self.assertEqual(self.ask("GET", "/", direct=True, Host=self.address)[0], 200)

    def test_with_it_browsers_come_in_over_tls_and_are_told_apart(self):
        log = self.start("--public", f"https://{self.name}", "--proxy", "127.0.0.1")
        self.start_proxy()
        code = re.search(r"pairing code (\S+)", log.read_text())[1]
        self.assertEqual(self.ask("GET", "/")[0], 200)
        self.assertEqual(self.ask("GET", "/", Host="evil.example")[0], 421)
        # Nobody is local: a session is asked of who comes through the proxy, and of who is on the machine.
        self.assertEqual(self.ask("GET", "/metrics")[0], 401)
        self.assertEqual(self.ask("GET", "/metrics", direct=True, Host=self.address)[0], 401)
        # What the proxy would have to say, from elsewhere, or of a browser without TLS.
        spoken = {"X_Forwarded_For": "203.0.113.9", "X_Forwarded_Proto": "https"}
        self.assertEqual(self.ask("GET", "/", source="127.0.0.9", direct=True, **spoken)[0], 421)
        self.assertEqual(self.ask("GET", "/", direct=True, **spoken)[0], 200)
        status, _, text = self.ask("GET", "/", direct=True, **spoken | {"X_Forwarded_Proto": "http"})
        self.assertEqual(status, 403)
        self.assertIn("without TLS", text)
        for origin in (f"http://{self.name}", "https://evil.example", f"http://{self.address}", "https://wall.example"):
            self.assertEqual(self.pair(code, origin=origin)[0], 403, origin)
        status, headers, text = self.pair(code)
        self.assertEqual(status, 200, text)
        self.assertRegex(headers["Set-Cookie"],
                         r"\A__Host-aquarama=\w+; Path=/; HttpOnly; SameSite=Strict; Max-Age=\d+; Secure\Z")
        cookie = headers["Set-Cookie"].split(";")[0]
        self.assertEqual(self.ask("GET", "/metrics", Cookie=cookie)[0], 200)
        self.assertEqual(self.ask("GET", "/metrics", direct=True, Host=self.address, Cookie=cookie)[0], 401)
        self.speak(cookie)

    def speak(self, cookie):
        """The same over a WebSocket."""
        for origin, expected in ((f"https://{self.name}", 101), ("https://evil.example", 403),
                                 (f"http://{self.name}", 403)):
            client = Socket(self, Host=self.name, Origin=origin, Cookie=cookie, raw=self.connect())
            self.assertEqual(client.status, expected, origin)
            if expected == 101:
                self.assertIn("snapshot", client.hear())
                self.assertIn("wall", client.hear_until(lambda message: "wall" in message))
            client.close()

    def test_guesses_count_for_the_browser_that_made_them(self):
        self.start("--public", f"https://{self.name}", "--proxy", "127.0.0.1")
        self.start_proxy()
        for _ in range(5):
            self.assertEqual(self.pair("00000000", source="127.0.0.5")[0], 403)
        code = aquarama("console", self.rig, "--pair", "crew").stdout.split()[0]
        self.assertEqual(self.pair(code, source="127.0.0.5")[0], 403)
        status, headers, text = self.pair(code, source="127.0.0.6")
        self.assertEqual(status, 200, text)
        client = Socket(self, Host=self.name, Origin=f"https://{self.name}", Cookie=headers["Set-Cookie"].split(";")[0],
                        raw=self.connect())
        events = [event["what"] for event in client.hear()["snapshot"]["events"]["events"]]
        self.assertIn("five wrong pairing codes, from 127.0.0.5: the code has ended", events)
        client.close()

    def test_an_option_that_is_wrong_says_so(self):
        for arguments, line in ((("--public", "https://wall.example"),
                                 r"aquarama console: --public requires --proxy; see .*"),
                                (("--public", "http://wall.example", "--proxy", "127.0.0.1"),
                                 r"aquarama console: --public http://wall\.example: .*https://NAME.*"),
                                (("--public", "https://wall.example", "--proxy", "nginx"),
                                 r"aquarama console: --proxy nginx: is no address .*")):
            run = aquarama("console", self.rig, "--port", "0", *arguments)
            self.assertNotEqual(run.returncode, 0)
            self.assertRegex(run.stderr, rf"\A{line}\n\Z")


if __name__ == "__main__":
    unittest.main(verbosity=2)
