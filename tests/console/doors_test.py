"""What the console refuses, whoever asks; and that the wall is unharmed by it, and by the console's death."""

import hashlib
import http.client
import os
import re
import resource
import secrets
import shutil
import signal
import socket
import ssl
import subprocess
import threading
import time
import unittest
from pathlib import Path

from desk import BIN, Desk, Socket, aquarama, children_of, frame, skin_png, wait_until
from show import lacks


class PretendedProjector:
    """Of PJLink, with manners: lower, closes, password, slow, err3 (in standby), deaf shutter (it cannot be asked)."""

    def __init__(self, *manners):
        self.manners, self.power, self.shut, self.input = manners, "0", True, "11"
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        threading.Thread(target=self.serve, daemon=True).start()

    def serve(self):
        while True:
            client, _ = self.listener.accept()
            with client:
                try:
                    self.talk(client)
                except OSError:
                    pass

    def say(self, client, text):
        client.sendall(((text.lower() if "lower" in self.manners else text)
                        + ("\r\n" if "slow" in self.manners else "\r")).encode())

    def talk(self, client):
        salt = secrets.token_hex(4)
        self.say(client, f"PJLINK 1 {salt}" if "password" in self.manners else "PJLINK 0")
        lines = client.makefile("r", newline="\r")
        proof = hashlib.md5((salt + "secret").encode()).hexdigest() if "password" in self.manners else ""
        while line := lines.readline():
            if not line.startswith(proof):
                return self.say(client, "PJLINK ERRA")
            line, proof = line[len(proof):].strip(), ""
            time.sleep(0.4 if "slow" in self.manners else 0)
            self.say(client, f"{line[:6]}={self.answer(line[2:6], line[7:])}")
            if "closes" in self.manners:
                return

    def answer(self, command, value):
        if command == "POWR" and value != "?":
            self.power = value
        elif "err3" in self.manners and self.power == "0":
            return "ERR3"
        elif command == "AVMT" and value != "?":
            self.shut = value == "31"
        elif command == "INPT" and value != "?":
            self.input = value
        else:
            mute = "ERR1" if "deaf shutter" in self.manners else "31" if self.shut else "30"
            return {"POWR": self.power, "AVMT": mute, "INPT": self.input, "ERST": "000000", "LAMP": "7 1"}[command]
        return "OK"


class Doors(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.desk = Desk("--pattern", "grid", more='drawings { species: "clownfish" folder: "scans" }')
        cls.addClassCleanup(cls.desk.close)
        cls.scans = Path(cls.desk.folder.name) / "scans"
        cls.scans.mkdir()
        cls.origin = f"http://{cls.desk.address}"
        cls.cookie = cls.desk.pair(cls.desk.code())
        cls.watcher, cls.operator, cls.crew = (cls.desk.token(role) for role in ("watcher", "operator", "crew"))

    def bearer(self, token):
        return {"Authorization": f"Bearer {token}"}

    def test_a_table_of_requests(self):
        ask = self.desk.request
        own = {"Origin": self.origin}
        command = {"command": {"id": "1", "run": "1", "order": {"show": {"black": True}}}}
        other = "http://evil.example"
        for expected, method, target, body, headers in (
                (200, "GET", "/", None, {}),
                (200, "HEAD", "/console.js", None, {}),
                (421, "GET", "/", None, {"Host": "evil.example"}),
                (421, "POST", "/pair", {"code": "x"}, {"Host": "evil.example", "Origin": "http://evil.example"}),
                (404, "GET", "/../etc/passwd", None, {"Cookie": self.cookie}),
                (401, "GET", "/metrics", None, {}),
                (401, "GET", "/bundle.zip", None, {}),
                (200, "GET", "/bundle.zip", None, self.bearer(self.watcher)),
                (308, "GET", "/bundle.tar", None, {"Cookie": self.cookie}),
                (401, "GET", "/metrics", None, self.bearer("0" * 32)),
                (401, "GET", "/metrics", None, {"Cookie": self.cookie[:-1] + ("0" if self.cookie[-1] != "0" else "1")}),
                (200, "GET", "/metrics", None, self.bearer(self.watcher)),
                (200, "GET", "/metrics", None, {"Cookie": self.cookie}),
                (404, "GET", "/command", None, {"Cookie": self.cookie}),  # nothing that is got acts
                (404, "GET", "/pair?code=1", None, {"Cookie": self.cookie}),
                (403, "POST", "/command", command, {"Cookie": self.cookie}),  # no origin, no token
                (403, "POST", "/command", command, {"Cookie": self.cookie, "Origin": other}),
                (403, "POST", "/command", command, {"Cookie": self.cookie, "Origin": "null"}),
                (403, "POST", "/command", command, {"Cookie": self.cookie, **own, "Sec_Fetch_Site": "cross-site"}),
                (415, "POST", "/command", command, {"Cookie": self.cookie, **own, "Content_Type": "text/plain"}),
                (401, "POST", "/command", command, own),
                (400, "POST", "/command", {"command": 7}, {"Cookie": self.cookie, **own}),
                (400, "POST", "/command", {"nothing": 7}, self.bearer(self.operator)),
                (403, "POST", "/command", {"command": {"id": "2", "run": "1", "order": {"show": {"black": True}}}},
                 self.bearer(self.watcher)),
                (403, "POST", "/command", {"command": {"id": "3", "run": "1", "revoke": "x"}},
                 self.bearer(self.operator)),
                (403, "POST", "/command", {"command": {"id": "4", "run": "1", "order": {"show": {"black": True}}}},
                 self.bearer(self.operator)),  # another show
                (403, "POST", "/command", {"command": {"id": "0", "run": "1", "order": {"show": {"black": True}}}},
                 self.bearer(self.operator)),
                (400, "POST", "/pair", {"nothing": 1}, own),
                (403, "POST", "/pair", {"code": "00000000"}, own),
                (403, "POST", "/pair", {"code": "00000000"}, {"Origin": other}),
                (405, "PUT", "/command", command, own),
                (405, "DELETE", "/", None, own),
        ):
            if "Content_Type" in headers:
                headers = {k.replace("_", "-"): v for k, v in headers.items()}
            status, given, _ = ask(method, target, body, **headers)
            self.assertEqual(status, expected, (method, target, headers))
            self.assertIn("default-src 'none'", given["Content-Security-Policy"])
            self.assertNotIn("Access-Control-Allow-Origin", given)
        self.assertEqual(self.desk.status()["black"], "off")

    def test_over_the_socket_the_same_holds(self):
        for expected, headers in (
                (101, {"Cookie": self.cookie}),
                (401, {}),
                (403, {"Cookie": self.cookie, "Origin": "http://evil.example"}),
                (403, {"Cookie": self.cookie, "Origin": None}),
                (421, {"Cookie": self.cookie, "Host": "evil.example"}),
                (101, {"Origin": None, **self.bearer(self.watcher)})):
            client = Socket(self.desk, **headers)
            self.assertEqual(client.status, expected, headers)
            client.close()
        self.assertEqual(Socket(self.desk, "/other", Cookie=self.cookie).status, 404)

    def test_roles_are_held_to_where_a_command_is_carried_out(self):
        before = self.desk.status()
        for token, allowed in ((self.watcher, {"pointAt"}),
                               (self.operator, {"pointAt", "black", "freeze", "pattern", "scan"}),
                               (self.crew, {"pointAt", "black", "freeze", "pattern", "scan", "newCode"})):
            client = Socket(self.desk, Origin=None, **self.bearer(token))
            run = client.hear()["snapshot"]["wall"]["run"]
            for what, value in (("black", False), ("freeze", False), ("pattern", "GRID"), ("newCode", "WATCHER"),
                                ("scan", {}),
                                ("useCalibration", "--help"), ("power", "nonsense"),
                                ("pointAt", {"channel": "left", "x": 0.5, "y": 0.5})):
                done = client.command(run, **{what: value})
                self.assertEqual(done["outcome"], "done" if what in allowed else "refused", (what, done))
            client.say({"helm": {"ahead": 127}})
            client.close()
        self.assertEqual(self.desk.status()["pattern"], before["pattern"])

    def test_secrets_of_the_hours_are_told_to_the_crew_alone(self):
        text = 'zone: "UTC"\nprojectors { name: "left" address: "127.0.0.1:1" password: "secret" }\n'
        crew = Socket(self.desk, Origin=None, **self.bearer(self.crew))
        run = crew.hear()["snapshot"]["wall"]["run"]
        self.assertEqual(crew.command(run, holdHours=1)["outcome"], "done")
        self.assertEqual(crew.command(run, hoursText=text)["outcome"], "done")
        try:
            for token, secret in ((self.watcher, ""), (self.operator, ""), (self.crew, "secret")):
                client = Socket(self.desk, Origin=None, **self.bearer(token))
                told = [client.hear()["snapshot"]["hours"]]
                client.say({"look": {"topics": ["hours"]}})
                told.append(client.hear_until(lambda message: isinstance(message, dict)
                                              and "hours" in message)["hours"])
                for hours in told:
                    self.assertEqual(hours["form"]["projectors"][0].get("password", ""), secret)
                    self.assertEqual(hours.get("text", ""), text if secret else "")
                client.close()
        finally:
            crew.command(run, hoursText="")
            crew.command(run, holdHours=0)
            crew.close()

    def test_the_hours_are_set_as_a_message_and_mistakes_come_by_field(self):
        crew = Socket(self.desk, Origin=None, **self.bearer(self.crew))
        hours = {"zone": "UTC", "exceptions": [{"date": "2026-12-24"}, {"date": "2026-12-24"}],
                 "projectors": [{"name": "left", "address": "beamer"}]}
        crew.say({"command": {"id": "77", "hours": hours}})
        heard = {}
        while not {"mistakes", "done"} <= heard.keys():  # in either order
            heard |= crew.hear_until(lambda message: isinstance(message, dict))
        told, done = heard["mistakes"], heard["done"]
        self.assertEqual(told["request"], "77")
        self.assertEqual([one["field"] for one in told["mistakes"]], ["exceptions.1.date", "projectors.0.address"])
        self.assertIn("is there already", told["mistakes"][0]["what"])
        self.assertEqual(done["outcome"], "REFUSED")
        self.assertTrue(done["reason"].startswith("exceptions.1.date: "), done)
        hours["exceptions"].pop()
        hours["projectors"].pop()
        self.assertEqual(crew.command(0, holdHours=1)["outcome"], "done")
        self.assertEqual(crew.command(0, hours=hours)["outcome"], "done")
        crew.say({"look": {"topics": ["hours"]}})
        kept = crew.hear_until(lambda message: isinstance(message, dict) and "hours" in message)["hours"]
        self.assertEqual([day["date"] for day in kept["form"]["exceptions"]], ["2026-12-24"])
        self.assertIn('date: "2026-12-24"', kept["text"])
        crew.command(0, hoursText="")
        crew.command(0, holdHours=0)
        crew.close()

    def test_projectors_of_a_hall_are_switched_whatever_their_manners(self):
        """One in lower case that closes after each answer and is asked for its password each time; one that is slow,
        with ERR3 in standby and a shutter that cannot be asked."""
        polite, odd = (PretendedProjector(*manners)
                       for manners in (("lower", "closes", "password"), ("slow", "err3", "deaf shutter")))
        crew = Socket(self.desk, Origin=None, Authorization=f"Bearer {self.crew}")
        every_day = "MONDAY, TUESDAY, WEDNESDAY, THURSDAY, FRIDAY, SATURDAY, SUNDAY"
        text = f'''zone: "UTC" open {{ days: [{every_day}] from: "00:00" to: "24:00" }}
            projectors {{ name: "polite" address: "127.0.0.1:{polite.port}" password: "secret" input: "31" }}
            projectors {{ name: "odd" address: "127.0.0.1:{odd.port}" input: "32" }}'''
        self.assertEqual(crew.command(0, hoursText=text)["outcome"], "done")
        crew.say({"look": {"topics": ["hours"]}})
        state = lambda one: (one["reach"], one["power"], one.get("shut"), one["input"])
        def projectors():
            crew.say({"look": {"topics": ["hours"]}})
            message = crew.hear_until(lambda m: isinstance(m, dict) and "projectors" in m)
            return {one["name"]: state(one) for one in message["projectors"]["projectors"]}
        wanted = {"polite": ("answers", "on", False, "31"), "odd": ("answers", "on", None, "32")}
        wait_until(lambda: projectors() == wanted, 60, "both on and open, as far as they tell")
        self.assertEqual([(one.power, one.shut, one.input) for one in (polite, odd)],
                         [("1", False, "31"), ("1", False, "32")])
        self.assertNotIn("shut{projector=\"odd\"}",
                         metrics := self.desk.request("GET", "/metrics", **self.bearer(self.watcher))[2])
        self.assertIn("aquarama_console_projector_shut{projector=\"polite\"} 0", metrics)
        self.assertEqual(crew.command(0, hoursText="")["outcome"], "done")
        crew.close()

    def test_two_desks_on_one_machine_know_nothing_of_each_other(self):
        state = os.environ["XDG_STATE_HOME"]  # a desk brings one of its own
        other = Desk("--pattern", "grid")
        try:
            cookie = other.pair(other.code())
            self.assertNotEqual(cookie.split("=")[0], self.cookie.split("=")[0], "browsers know no ports of cookies")
            for desk, theirs in ((self.desk, cookie), (other, self.cookie)):
                self.assertEqual(desk.request("GET", "/metrics", Cookie=theirs)[0], 401)
                self.assertEqual(desk.request("GET", "/metrics", **self.bearer("0" * 32))[0], 401)
            self.assertEqual(other.request("GET", "/metrics", **self.bearer(self.crew))[0], 401)
            mine, its = Socket(self.desk, Cookie=self.cookie), Socket(other, Cookie=f"{self.cookie}; {cookie}")
            runs = [client.hear()["snapshot"]["wall"]["run"] for client in (mine, its)]
            self.assertNotEqual(*runs)
            self.assertEqual(its.command(runs[0], black=True)["outcome"], "refused", "meant for the other show")
            self.assertEqual(its.command(runs[1], black=True)["outcome"], "done")
            self.assertEqual((self.desk.status()["black"], other.status()["black"]), ("off", "on"))
            for client in (mine, its):
                client.say({"look": {"channels": ["left"], "widthPx": 64}})
                self.assertEqual(client.hear_until(lambda message: isinstance(message, bytes))[16:18], b"\xff\xd8")
                client.close()
        finally:
            os.environ["XDG_STATE_HOME"] = state
            other.close()

    def drawings(self, wanted, seconds=15):
        """The list as a page is told it, as soon as it is as it should be."""
        client = Socket(self.desk, Cookie=self.cookie)
        client.say({"look": {"topics": ["drawings"]}})
        until = time.monotonic() + seconds
        listed = client.hear_until(lambda m: isinstance(m, dict) and self.looks(client, until)
                                   and "drawings" in m and wanted(m["drawings"]), seconds)["drawings"]
        client.close()
        return listed

    @staticmethod
    def looks(client, until):
        client.say({"look": {"topics": ["drawings"]}})
        return time.monotonic() < until

    def decide(self, number, verdict, token=None):
        return self.desk.request("POST", "/api/order", {"moderation": {"number": number, "verdict": verdict}},
                                 **self.bearer(token or self.operator))

    def test_the_crew_decides_who_swims_and_everybody_sees_the_pictures(self):
        number = self.desk.offer(self.operator, 230, 100, 10)
        path = f"/drawing/{number}.png"
        of = lambda listed: next((one for one in listed["drawings"] if one["number"] == number), None)
        listed = self.drawings(lambda listed: any(one["number"] == number for one in listed["pictures"]))
        self.assertEqual((of(listed)["condition"], of(listed)["species"]), ("WAITING", "clownfish"))
        self.assertEqual(listed["species"], ["clownfish"])
        status, headers, _ = self.desk.request("GET", path, **self.bearer(self.watcher))
        self.assertEqual((status, headers["Content-Type"]), (200, "image/png"))
        self.assertEqual(int(headers["Content-Length"]), len(skin_png(230, 100, 10)))
        again = self.desk.request("GET", path, If_None_Match=headers["ETag"], **self.bearer(self.watcher))
        self.assertEqual((again[0], again[2]), (304, ""))
        self.assertEqual(self.desk.request("GET", path)[0], 401)
        for nowhere in ("/drawing/999.png", "/drawing/x.png", "/drawing/../me", f"/drawing/{number}"):
            self.assertEqual(self.desk.request("GET", nowhere, **self.bearer(self.watcher))[0], 404, nowhere)
        self.assertEqual(self.decide(number, "LET_IN", self.watcher)[0], 403)
        self.assertEqual(of(self.drawings(of))["condition"], "WAITING")
        self.assertEqual(self.decide(number, "LET_IN")[0], 202)
        self.assertEqual(self.decide(number, "KEEP")[0], 202)
        swims = of(self.drawings(lambda listed: of(listed)["condition"] == "SWIMMING" and "fish" in of(listed)))
        self.assertTrue(swims["kept"])
        self.assertEqual(self.decide(number, "TAKE_DOWN")[0], 202)
        self.drawings(lambda listed: not of(listed) or of(listed)["condition"] == "LEAVING")
        self.assertEqual(self.decide(0, "VERDICT_UNSPECIFIED")[0], 403)

    def send(self, picture, token=None, target="/api/drawing", **headers):
        status, _, text = self.desk.request("POST", target, picture, **{"Content-Type": "image/jpeg"}
                                            | self.bearer(token or self.operator) | headers)
        return status, text

    def test_a_picture_of_a_sheet_comes_by_its_own_door(self):
        long = b"x" * 1_000_000
        self.assertEqual(self.send(long, self.watcher)[0], 403)
        self.assertEqual(self.send(long, "0" * 64)[0], 401)
        self.assertEqual(self.send(long, Origin="http://evil.example")[0], 403)
        self.assertEqual(self.send(b"x", **{"Content-Type": "application/json"})[0], 415)
        self.assertEqual(self.send(b"")[0], 400)
        for target, size in (("/api/order", 100_000), ("/api/drawing", (16 << 20) + 1)):
            with self.assertRaises((ConnectionError, http.client.HTTPException), msg=target):
                self.send(b"x" * size, target=target)

    def sheet(self):
        """A photograph of a sheet, as good as a scanner's."""
        folder = Path(self.desk.folder.name)
        printed = aquarama("sheets", "--species", "clownfish", "--out", folder / "sheets")
        self.assertEqual(printed.returncode, 0, printed.stderr)
        pdf, = (folder / "sheets").glob("*.pdf")
        subprocess.run(["pdftoppm", "-r", "70", "-jpeg", "-singlefile", pdf, folder / "photo"], check=True)
        return (folder / "photo.jpg").read_bytes()

    @unittest.skipIf(*lacks((BIN / "aquarama-drawings").exists() and shutil.which("pdftoppm"), "aquarama-drawings"))
    def test_a_picture_becomes_a_drawing_that_waits(self):
        photo = self.sheet()
        status, text = self.send(photo, target="/api/drawing?aside=-1&request=4711")
        self.assertEqual((status, text), (202, "waiting: the picture is read; request 4711\n"))
        end = lambda request: self.desk.request("POST", "/api/order", {"request": request},
                                                **self.bearer(self.operator))
        wait_until(lambda: end("4711")[0] != 202, 60, "it is read")
        self.assertRegex(end("4711")[2], r"\Adone: drawing \d+\n\Z")
        self.assertEqual(self.send(b"no picture", target="/api/drawing?request=4712")[0], 202)
        wait_until(lambda: end("4712")[0] != 202, 60, "it is read")
        self.assertEqual(end("4712")[::2], (403, "refused: this is no JPEG, PNG or WebP that can be read\n"))
        # The same by the folder of a scanner.
        before = len(self.drawings(lambda listed: True)["drawings"])
        (self.scans / "scan_1.jpg").write_bytes(photo)
        (self.scans / "notes.txt").write_text("no picture")
        self.drawings(lambda listed: len(listed["drawings"]) > before, 60)
        wait_until(lambda: (self.scans / "refused/notes.txt").exists(), 60, "what is refused is moved")
        wait_until(lambda: [path.name for path in self.scans.iterdir()] == ["refused"], 60, "and what is read, gone")
        events = self.events()
        self.assertIn("folder of drawings: picture of notes.txt, refused: "
                      "this is no JPEG, PNG or WebP that can be read", events)
        self.assertRegex("\n".join(events), r"folder of drawings: picture of scan_1.jpg: drawing \d+")

    def test_y_a_master_that_is_killed_has_the_drawings_again(self):
        kept, waits = (self.desk.offer(self.operator, *colour) for colour in ((20, 200, 60), (20, 60, 200)))
        for verdict in ("LET_IN", "KEEP"):
            self.assertEqual(self.decide(kept, verdict)[0], 202)
        known = lambda listed: {one["number"]: (one["condition"], one.get("kept", False)) for one in listed["drawings"]
                                if one["number"] in (kept, waits)}
        wanted = {kept: ("SWIMMING", True), waits: ("WAITING", False)}
        self.drawings(lambda listed: known(listed) == wanted)
        time.sleep(1)  # it is written beside the frames
        before = self.desk.status()["frame"]
        master = next(pid for command, pid in children_of(self.desk.show).items() if "aquarama master" in command)
        os.kill(master, signal.SIGKILL)
        again = lambda: re.search(r"frame (\d+)", aquarama("status", self.desk.rig).stdout)
        wait_until(lambda: (found := again()) and int(found[1]) < before, 60, "the master is started again")
        self.assertEqual(known(self.drawings(lambda listed: known(listed) == wanted, 60)), wanted)
        path = f"/drawing/{waits}.png"
        self.assertEqual(self.desk.request("GET", path, **self.bearer(self.watcher))[0], 200)
        goes_on = r"(?m)^wall: the world goes on from 0:\d\d:\d\d, away for \d+ s$"
        wait_until(lambda: re.search(goes_on, "\n".join(self.events())), 20, "the console says that the world goes on")

    def events(self):
        client = Socket(self.desk, Cookie=self.cookie)
        events = client.hear()["snapshot"]["events"]["events"]
        client.close()
        return [f"{event['who']}: {event['what']}" for event in events]

    def test_z_a_full_disk_pauses_the_journal_which_is_an_alert_and_the_show_goes_on(self):
        master = next(pid for command, pid in children_of(self.desk.show).items() if "aquarama master" in command)
        before = self.desk.status()["frame"]
        limit = resource.prlimit(master, resource.RLIMIT_FSIZE)
        resource.prlimit(master, resource.RLIMIT_FSIZE, (1000, limit[1]))  # stands for a full disk
        client = Socket(self.desk, Cookie=self.cookie)
        alert = client.hear_until(lambda m: isinstance(m, dict) and any(
            one["key"] == "journal" for one in m.get("alerts", {}).get("alerts", [])))["alerts"]["alerts"][-1]
        resource.prlimit(master, resource.RLIMIT_FSIZE, limit)
        client.close()
        self.assertEqual(alert["state"], "firing")
        self.assertRegex(alert["text"], r"^the journal is paused: it cannot be written \(File too large\)")
        self.assertIn(f"alert: {alert['text']}", self.events())
        self.assertRegex(aquarama("status", self.desk.rig).stdout, r"(?m)^journal +paused: ")
        wait_until(lambda: self.desk.status()["frame"] > before + 10, 20, "the show goes on")

    def test_a_command_is_a_wanted_value_and_carried_out_once(self):
        client = Socket(self.desk, Cookie=self.cookie)
        run = client.hear()["snapshot"]["wall"]["run"]
        self.assertEqual(client.command(run, black=True)["outcome"], "done")
        self.assertEqual(client.command(run, black=True)["outcome"], "done")
        self.assertEqual(self.desk.status()["black"], "on")
        identity = secrets.randbits(62) | 1
        self.assertEqual(client.command(run, identity, black=False)["outcome"], "done")
        self.assertEqual(client.command(run, black=True)["outcome"], "done")
        self.assertEqual(client.command(run, identity, black=False)["outcome"],
                         "done")  # said again: answered, not done
        self.assertEqual(self.desk.status()["black"], "on")
        self.assertEqual(client.command(run, black=False)["outcome"], "done")
        for what in ({"scene": "none/such"}, {"scene": ""}, {"scene": "x\ny"}, {"pattern": "SHOWN_UNSPECIFIED"},
                     {"restart": "nobody"}, {"scene": "x" * 500}, {"acknowledge": "nothing"}):
            done = client.command(run, **what)
            self.assertEqual(done["outcome"], "refused", what)
            self.assertTrue(done["reason"])
        self.assertEqual(client.command(str(int(run) ^ 1), black=True)["outcome"], "refused")
        client.close()

    def test_floods_and_fragments_are_cut_off_and_the_wall_is_unharmed(self):
        host, port = self.desk.address.split(":")
        address = (host, int(port))
        before = self.desk.status()
        soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
        count = min(10_000, hard - 200)
        resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, count + 200), hard))
        idle = []
        for _ in range(count):
            client = socket.socket()
            client.setblocking(False)
            client.connect_ex(address)
            idle.append(client)
        slow = [socket.create_connection(address) for _ in range(100)]
        for client in slow:
            client.sendall(b"GET / HTTP/1.1\r\nHost: ")
        self.assertEqual(self.desk.request("GET", "/")[0], 200)
        # The answer does not wait until the others are cut off: the last of them is still connected.
        with self.assertRaises(BlockingIOError):
            slow[-1].recv(1, socket.MSG_DONTWAIT)
        for client in idle:
            client.close()
        giant = {"a header of 20 kB": b"GET / HTTP/1.1\r\nHost: x\r\nX: " + b"y" * 20_000,
                 "a body of 1 MB": b"POST /pair HTTP/1.1\r\nHost: x\r\nContent-Length: 1000000\r\n\r\n"
                 + b"y" * 100_000,
                 "no HTTP": secrets.token_bytes(3000)}
        for what, content in giant.items():
            client = socket.create_connection(address, timeout=8)
            try:
                client.sendall(content)
                while client.recv(4096):
                    pass
            except (ConnectionError, BrokenPipeError):
                pass
            client.close()
        for client in slow:  # five seconds for a whole request
            client.settimeout(8)
            try:
                self.assertEqual(client.recv(100), b"")
            except ConnectionError:
                pass
            client.close()
        self.cut_frames()
        status = self.desk.request("GET", "/metrics", **self.bearer(self.watcher))[2]
        cut_off = int(re.search(r"^aquarama_console_cut_off_connections_total (\d+)$", status, re.M)[1])
        self.assertGreater(cut_off, 100)
        after = self.desk.status()
        self.assertEqual((after["late"], after["dropped"]), (before["late"], before["dropped"]))
        self.assertGreater(after["frame"], before["frame"])

    def cut_frames(self):
        """Each leaves a console that serves the next."""
        whole = frame(b'{"command":{"id":"7","run":"1","order":{"show":{"black":true}}}}')
        pieces = [whole[:cut] for cut in range(1, len(whole), 7)]
        pieces += [b"\x81\xff" + b"\xff" * 8 + b"\0\0\0\0", b"\xff\xff\xff", frame(b"x" * 70_000), b"\x81\x05hello"]
        for piece in pieces:
            client = Socket(self.desk, Cookie=self.cookie)
            self.assertEqual(client.status, 101)
            client.socket.sendall(piece)
            client.close()
        noisy = Socket(self.desk, Cookie=self.cookie)
        with self.assertRaises(ConnectionError):
            for _ in range(300):
                noisy.say(b"{no json")
            while True:
                noisy.hear()
        client = Socket(self.desk, Cookie=self.cookie)
        self.assertIn("snapshot", client.hear())
        client.close()

    def test_pictures_are_pulled_and_name_their_frame(self):
        clients = [Socket(self.desk, Cookie=self.cookie) for _ in range(3)]
        frames = {}
        for client in clients:
            client.hear()
            client.say({"look": {"channels": ["left"], "widthPx": 240}})
            picture = client.hear_until(lambda message: isinstance(message, bytes))
            channel, _, width, height, number = (int.from_bytes(picture[a:b], "little")
                                                 for a, b in ((0, 2), (2, 4), (4, 6), (6, 8), (8, 16)))
            self.assertEqual((channel, width, height), (0, 240, 180))
            self.assertEqual(picture[16:18], b"\xff\xd8")
            frames[client] = number
        # Who does not say that it has drawn one gets no other; who does, the next.
        clients[0].say({"seen": {"channel": 0}})
        clients[0].say({"look": {"channels": ["left"], "widthPx": 240}})
        following = clients[0].hear_until(lambda message: isinstance(message, bytes))
        self.assertGreater(int.from_bytes(following[8:16], "little"), frames[clients[0]])
        silent = time.monotonic() + 1.5
        while time.monotonic() < silent:
            self.assertFalse(isinstance(clients[1].hear(), bytes), "a picture before the last was drawn")
        for client in clients:
            client.close()

    def test_x_killed_it_costs_no_frame_and_comes_back_with_what_it_knew(self):
        client = Socket(self.desk, Cookie=self.cookie)
        run = client.hear()["snapshot"]["wall"]["run"]
        self.assertEqual(client.command(run, black=True)["outcome"], "done")
        before = self.desk.status()
        for _ in range(3):
            process = self.desk.console_process()
            started = self.desk.said().count("console at")
            os.kill(process, signal.SIGKILL)
            wait_until(lambda: self.desk.said().count("console at") > started, 20, "the console to be started again")
            wait_until(lambda: self.desk.request("GET", "/me", Cookie=self.cookie)[2].find("crew") > 0, 10,
                       "the session")
        after = self.desk.status()
        self.assertEqual((after["late"], after["dropped"]), (before["late"], before["dropped"]))
        self.assertGreater(after["frame"], before["frame"])
        again = Socket(self.desk, Cookie=self.cookie)
        snapshot = again.hear()["snapshot"]
        wait_until(lambda: self.desk.status()["black"] == "on", 5, "the wall to be black still")
        self.assertIn("black on", [event["what"] for event in snapshot["events"]["events"]])
        self.assertEqual(again.command(run, black=False)["outcome"], "done")

    def test_past_the_loopback_only_with_a_certificate(self):
        refused = aquarama("console", self.desk.rig, "--listen", "127.0.0.2", "--port", "0")
        self.assertEqual((refused.returncode, refused.stdout), (1, ""))
        self.assertIn("--certify 127.0.0.2", refused.stderr)
        self.assertEqual(len(refused.stderr.strip().splitlines()), 1)
        made = aquarama("console", self.desk.rig, "--certify", "127.0.0.2", "master.local").stdout
        authority = made.split("once: ")[1].split()[0]
        self.assertEqual(Path(authority).stat().st_mode & 0o077, 0)
        text = Path(self.desk.rig).read_text()
        other = Path(self.desk.folder.name) / "desk.tls"  # nodes' pictures go to the first console
        other.mkdir(exist_ok=True)
        rig = other / "desk.txtpb"
        rig.write_text("\n".join(line for line in text.splitlines() if "watch:" not in line))
        with open(other / "log", "w") as log:
            console = subprocess.Popen([BIN / "aquarama-console", rig, "--listen", "127.0.0.2", "--port", "0"],
                                       stdout=log, stderr=log)
        try:
            wait_until(lambda: "console at https://" in (other / "log").read_text(), 10, "the console over TLS")
            port = int((other / "log").read_text().split("https://127.0.0.2:")[1].split()[0])
            context = ssl.create_default_context(cafile=authority)
            for name in ("127.0.0.2", "master.local"):
                with socket.create_connection(("127.0.0.2",
                                               port)) as raw, context.wrap_socket(raw, server_hostname=name) as tls:
                    tls.sendall(f"GET /me HTTP/1.1\r\nHost: 127.0.0.2:{port}\r\nConnection: close\r\n\r\n".encode())
                    self.assertIn(b"200 OK", tls.recv(1000))
            with socket.create_connection(("127.0.0.2", port)) as raw, self.assertRaises(ssl.SSLError):
                ssl.create_default_context().wrap_socket(raw, server_hostname="127.0.0.2")
        finally:
            console.terminate()
            console.wait(10)


class OtherMachines(unittest.TestCase):
    """Two nodes with folders of their own for the word stand for two machines; the third is the master's."""

    @classmethod
    def setUpClass(cls):
        cls.desk = Desk("--pattern", "grid", machines={"left": "pit", "right": "balcony"})
        cls.addClassCleanup(cls.desk.close)
        cls.pit, cls.nowhere = (Path(cls.desk.folder.name) / name for name in ("pit", "nowhere"))
        cls.pit.mkdir()
        cls.desk.start_node("left", AQUARAMA_POWER_FOLDER=str(cls.pit))
        cls.desk.start_node("right", AQUARAMA_POWER_FOLDER=str(cls.nowhere))
        cls.crew = Socket(cls.desk, Origin=None, Authorization=f"Bearer {cls.desk.token('crew')}")
        cls.run_number = cls.crew.hear()["snapshot"]["wall"]["run"]
        cls.wall(lambda nodes: all(node.get("report") for node in nodes.values()))

    @classmethod
    def wall(cls, wanted):
        """The nodes by name, as soon as they are as they should be."""
        nodes = lambda message: {node["name"]: node for node in message["wall"]["status"]["nodes"]}
        return nodes(cls.crew.hear_until(lambda message: isinstance(message, dict) and "wall" in message
                                         and wanted(nodes(message)), 60))

    def switch(self, channel, word, identity=None, run=None):
        return self.crew.command(run or self.run_number, identity, machine={"channel": channel, "word": word})

    def events(self):
        return [event["what"] for event in self.crew.hear_until(lambda message: isinstance(message, dict)
                                                                and "events" in message)["events"]["events"]]

    def test_the_word_goes_to_the_machine_of_the_node_once(self):
        word, identity = self.pit / "word", secrets.randbits(62) | 1
        done = self.switch("left", "REBOOT", identity)
        self.assertEqual((done["request"], done["outcome"], done["reason"]), (str(identity), "done", ""))
        self.assertIn("reboot of the machine of left", self.events())
        self.assertEqual(word.read_text(), "reboot\n")
        word.unlink()  # as its service does
        self.assertEqual(self.switch("left", "REBOOT", identity)["outcome"], "done")
        time.sleep(0.5)
        self.assertFalse(word.exists(), "said again: answered, not done")
        self.assertEqual(self.switch("left", "POWEROFF")["outcome"], "done")
        self.assertEqual(word.read_text(), "poweroff\n")
        word.unlink()

    def test_only_the_crew_and_only_one_of_two_words_of_this_show(self):
        operator = Socket(self.desk, Origin=None, Authorization=f"Bearer {self.desk.token('operator')}")
        self.assertEqual(operator.command(self.run_number, machine={"channel": "left", "word": "POWEROFF"})["reason"],
                         "only crew may do this")
        operator.close()
        for channel, word, run in (("left", "WORD_UNSPECIFIED", None), ("", "REBOOT", None),
                                   ("nobody", "REBOOT", None),
                                   ("left", "POWEROFF", str(int(self.run_number) ^ 1))):
            self.assertEqual(self.switch(channel, word, run=run)["outcome"], "refused", (channel, word, run))
        self.assertEqual(list(self.pit.iterdir()), [])

    def test_a_machine_that_is_not_set_up_says_so_and_does_nothing(self):
        nodes = self.wall(lambda nodes: "takesPowerWord" in nodes["left"]["report"])
        self.assertEqual([nodes[name]["report"]["takesPowerWord"] for name in ("left", "right")], [True, False])
        refused = self.switch("right", "POWEROFF")
        self.assertEqual(refused["reason"], "the machine of right takes no such word; set up aquarama-power.path there")
        self.assertFalse(self.nowhere.exists())
        self.pit.rename(self.nowhere)  # taken away since the node's last report: the node refuses it itself
        try:
            done = self.switch("left", "POWEROFF")
            self.assertEqual(done["outcome"], "refused")
            self.assertIn("takes no such word", done["reason"])
            self.assertNotIn("\n", done["reason"])
        finally:
            self.nowhere.rename(self.pit)
        self.assertEqual(list(self.pit.iterdir()), [])
        self.wall(lambda nodes: nodes["left"]["report"]["takesPowerWord"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
