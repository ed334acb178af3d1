"""The mains fail: nut's own programs watch a UPS that its driver for tests pretends, and a real show goes black, comes
back, and goes off in order."""

import os
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from show import (BIN, EMPTY_SEA, ROOT, ShowCase, aquarama, control_address, free_ports, lacks, rig_on_free_ports,
                  start, wait_until)

PROGRAMS = Path("/lib/nut")  # those of /usr/sbin ask /etc/nut/nut.conf first whether they may run
NUT = ROOT / "packaging/nut"
HAS_NUT = all((PROGRAMS / name).exists() for name in ("dummy-ups", "upsd", "upsmon")) and os.geteuid() == 0
# As the real one does, in a folder of the test.
HALL = """#!/bin/sh
cd {folder}
echo "$@" >>{folder}/said
exec {program} "$@"
"""


class Mains:
    """A UPS of nut's driver `dummy-ups`, upsd and upsmon with the hall's files of packaging/nut."""

    def __init__(self, folder, environment, minute):
        """`minute`: the seconds that a minute on battery takes."""
        self.folder = Path(tempfile.mkdtemp(prefix="aq-nut-", dir=folder))
        self.device = self.folder / "hall.dev"
        self.environment = environment | {"NUT_CONFPATH": str(self.folder), "NUT_STATEPATH": str(self.folder),
                                          "NUT_ALTPIDPATH": str(self.folder)}
        self.write_files(free_ports(1)[0], minute)
        self.say("OL")
        self.processes = []

    def write_files(self, port, minute):
        write = lambda name, text: (self.folder / name).write_text(text)
        write("nut.conf", "MODE=standalone\n")
        write("ups.conf", f'[hall]\ndriver = dummy-ups\nport = {self.device}\nmode = dummy-loop\npollinterval = 1\n')
        write("upsd.conf", f"LISTEN 127.0.0.1 {port}\n")
        write("upsd.users", "[hall]\npassword = word\nupsmon primary\n")
        script = ROOT / "packaging/hall/aquarama-ups"
        monitor = (NUT / "upsmon.conf").read_text()
        for old, new in (("hall@localhost", f"hall@127.0.0.1:{port}"), ("PASSWORD", "word"),
                         ("RUN_AS_USER aquarama", "RUN_AS_USER root"), ("/usr/lib/aquarama/aquarama-ups", str(script)),
                         ("POLLFREQ 5", "POLLFREQ 1"), ("POLLFREQALERT 5", "POLLFREQALERT 1"),
                         ("/etc/killpower", f"{self.folder}/killpower"), ("FINALDELAY 5", "FINALDELAY 0")):
            assert old in monitor, old
            monitor = monitor.replace(old, new)
        write("upsmon.conf", monitor)
        schedule = (NUT / "upssched.conf").read_text()
        for old, new in (("/usr/lib/aquarama/aquarama-ups", str(script)), ("/run/nut", str(self.folder)),
                         ("onbatt 60", f"onbatt {minute}")):
            assert old in schedule, old
            schedule = schedule.replace(old, new)
        write("upssched.conf", schedule)

    def begin(self):
        for arguments, sign in ((("dummy-ups", "-a", "hall", "-u", "root", "-F"), "dummy-ups-hall"),
                                (("upsd", "-u", "root", "-F"), "Connected to UPS"),
                                (("upsmon", "-F"), "UPS: hall@")):
            with open(self.folder / "log", "a") as log:
                self.processes.append(subprocess.Popen([PROGRAMS / arguments[0], *arguments[1:]], stdout=log,
                                                       stderr=subprocess.STDOUT, env=self.environment,
                                                       start_new_session=True))
            try:
                wait_until(lambda: sign in self.log() or list(self.folder.glob(sign + "*")), 30, arguments[0])
            except AssertionError as failure:
                raise AssertionError(f"{failure}\n{self.log()}") from None

    def log(self):
        return (self.folder / "log").read_text()

    def say(self, status):
        """What the UPS reports from now on: OL on line, OB on battery, OB LB nearly empty."""
        whole = self.device.with_suffix(".part")
        whole.write_text(f"ups.status: {status}\nbattery.charge: 50\nTIMER 1\n")
        whole.rename(self.device)

    def close(self):
        for process in reversed(self.processes):
            os.killpg(process.pid, signal.SIGTERM)  # upsmon has two, and upssched beside them
            process.wait(20)
            # The next upsmon does not start while a part of this one is there.
            wait_until(lambda: self.has_ended(process.pid), 20, "the end of nut's programs")

    @staticmethod
    def has_ended(group):
        try:
            os.killpg(group, 0)
            return False
        except ProcessLookupError:
            return True


@unittest.skipIf(*lacks(HAS_NUT, "nut-server with root's rights"))
class Ups(ShowCase):
    def setUp(self):
        super().setUp()
        folder = Path(self.folder.name)
        self.rig = rig_on_free_ports(folder, replace=[*EMPTY_SEA,
                                                      ('name: "left"', 'name: "left" machine: "left-pc"'),
                                                      ('name: "right"', 'name: "right" machine: "right-pc"')])
        self.rig = self.rig.rename(folder / "hall.txtpb")
        programs = folder / "bin"
        programs.mkdir()
        self.put(programs / "aquarama-hall", HALL.format(folder=folder, program=BIN / "aquarama"))
        self.put(programs / "systemctl", "#!/bin/sh\nexit 1\n")  # this machine stays on
        self.power = {name: folder / "power" / name for name in ("this", "left", "right")}
        for one in self.power.values():
            one.mkdir(parents=True)
        self.environment = os.environ | {"PATH": f"{programs}:{os.environ['PATH']}",
                                         "AQUARAMA_POWER_FOLDER": str(self.power["this"])}
        self.mark = Path(os.environ["XDG_STATE_HOME"]) / "aquarama/ups-black"
        self.mains = None

    def tearDown(self):
        if self.mains:
            self.mains.close()
        super().tearDown()

    @staticmethod
    def put(path, text):
        path.write_text(text)
        path.chmod(0o755)

    def begin_show(self):
        self.master = start("master", self.rig, "--resume", log=self.log)
        self.processes.append(self.master)
        wait_until(lambda: self.is_black() is False, 120, "a show")

    def begin_mains(self, minute=2):
        self.mains = Mains(self.folder.name, self.environment, minute)
        self.mains.begin()

    def is_black(self):
        done = aquarama("status", self.rig)
        return ("black on" in done.stdout) if done.returncode == 0 else None

    def event(self, name):
        return subprocess.run([ROOT / "packaging/hall/aquarama-ups", name], env=self.environment, capture_output=True,
                              text=True, timeout=120)

    def said(self):
        file = Path(self.folder.name) / "said"
        return file.read_text() if file.exists() else ""

    def test_black_after_a_minute_on_battery_and_the_world_when_the_mains_are_back(self):
        self.begin_show()
        self.begin_mains()
        self.mains.say("OB")
        wait_until(self.is_black, 30, "a black wall")
        on_battery = self.power["this"] / "on-battery"
        self.assertTrue(on_battery.exists(), "what the console looks at: nothing opens")
        self.mains.say("OL")
        wait_until(lambda: self.is_black() is False, 30, "the world")
        self.assertFalse(on_battery.exists())
        wait_until(lambda: not self.mark.exists(), 30, "the end of what the wall was black by")

    def test_a_short_failure_is_not_seen(self):
        self.begin_show()
        self.begin_mains(minute=10)
        self.mains.say("OB")
        wait_until(lambda: "on battery" in self.mains.log(), 30, "the word of upsmon")
        self.mains.say("OL")
        wait_until(lambda: "on line power" in self.mains.log(), 30, "the word of upsmon")
        time.sleep(12)  # longer than the wall would take to be black
        self.assertEqual(self.said(), "", "nobody is called")
        self.assertIs(self.is_black(), False)

    def test_before_the_battery_is_empty_nodes_go_off_then_this_machine(self):
        self.begin_show()
        nodes = {}
        for name in ("left", "middle", "right"):
            os.environ["AQUARAMA_POWER_FOLDER"] = str(self.power.get(name, self.power["this"]))
            nodes[name] = start("node", name, "--master", control_address(self.rig), "--headless", log=self.log)
        os.environ.pop("AQUARAMA_POWER_FOLDER")
        self.processes += nodes.values()
        wait_until(lambda: aquarama("status", self.rig).stdout.count("in step") == 3, 120, "three nodes")
        time.sleep(6)  # their first reports: whether their machines take the word
        self.begin_mains()
        self.mains.say("OB LB")
        word = {name: folder / "word" for name, folder in self.power.items()}
        for name in ("left", "right"):
            wait_until(word[name].exists, 60, f"the word at {name}: {self.mains.log()}")
            self.assertEqual(word[name].read_text(), "poweroff\n")
        time.sleep(1)
        self.assertFalse(word["this"].exists(), "this machine waits for the others")
        for name in ("left", "right"):
            nodes[name].kill()  # its machine goes off
        wait_until(word["this"].exists, 60, "the word at this machine")
        self.assertEqual(word["this"].read_text(), "poweroff\n")

    def test_without_a_master_this_machine_goes_off_all_the_same(self):
        done = self.event("lowbatt")
        self.assertEqual(done.returncode, 0)
        self.assertEqual((self.power["this"] / "word").read_text(), "poweroff\n")
        self.assertIn("the machines of nodes may stay on", done.stderr + done.stdout)

    def test_what_an_operator_made_black_stays_black(self):
        self.begin_show()
        aquarama("set", self.rig, "black", "on")
        self.assertEqual(self.event("onbatt").returncode, 0)
        self.assertTrue((self.power["this"] / "on-battery").exists())
        self.assertEqual(self.event("online").returncode, 0)
        self.assertTrue(self.is_black())

    def test_hours_that_have_closed_meanwhile_keep_it_black(self):
        self.begin_show()
        self.assertEqual(self.event("onbatt").returncode, 0)
        hours = Path(os.environ["XDG_STATE_HOME"]) / "aquarama/console/hall/hours.txtpb"
        hours.parent.mkdir(parents=True)
        hours.write_text('zone: "UTC"\n')  # never open
        self.assertEqual(self.event("online").returncode, 0)
        self.assertTrue(self.is_black())
        self.assertFalse(self.mark.exists())

    def test_a_battery_that_dies_suddenly_leaves_no_black_wall_behind(self):
        self.begin_show()
        self.assertEqual(self.event("onbatt").returncode, 0)
        self.master.kill()
        self.master.wait()
        self.processes = [start("master", self.rig, "--resume", log=self.log)]
        wait_until(self.is_black, 60, "what was set is kept")
        self.assertTrue(self.mark.exists(), "the condition of aquarama-ups.service")
        self.assertEqual(self.event("online").returncode, 0)
        self.assertIs(self.is_black(), False)


if __name__ == "__main__":
    unittest.main(verbosity=2)
