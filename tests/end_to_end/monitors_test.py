"""Three monitors of one machine: channels go by the names of connectors, and a monitor that goes and comes back has its
picture."""

import os
import re
import shutil
import subprocess
import time
import unittest
from pathlib import Path

from show import (BIN, CHANNELS, EMPTY_SEA, ROOT, aquarama, control_address, end, free_ports, rig_on_free_ports, start,
                  temporary_folder, trace, wait_until)
from windows_test import Display

SIZE = 480, 360         # of each monitor, as the desk's channels
TELEVISION = 640, 360   # wider
MODES = {SIZE: "13.32 480 488 528 592 360 361 364 375",
         TELEVISION: "17.75 640 664 720 800 360 363 368 374"}  # clock in MHz and timing
CONFIGURATION = """
Section "ServerFlags"
  Option "AutoAddDevices" "false"
  Option "AutoAddGPU" "false"
EndSection
Section "Device"
  Identifier "card"
  Driver "dummy"
  VideoRam 65536
EndSection
Section "Monitor"
  Identifier "monitor"
  HorizSync 5-1000
  VertRefresh 5-200
  Modeline "MODE" TIMING
EndSection
Section "Screen"
  Identifier "screen"
  Device "card"
  Monitor "monitor"
  DefaultDepth 24
  SubSection "Display"
    Depth 24
    Modes "MODE"
    Virtual ALL
  EndSubSection
EndSection
"""


class Monitors(Display):
    """An X server with three outputs, without a window manager, as aquarama-x@.service starts it."""

    def __init__(self, folder, size=SIZE):
        self.size, self.mode = size, f"{size[0]}x{size[1]}"
        configuration = Path(folder, "xorg.conf")
        configuration.write_text(CONFIGURATION.replace("MODE", self.mode).replace("TIMING", MODES[size]).replace(
            "ALL", f"{3 * size[0]} {size[1]}"))
        read, write = os.pipe()
        # -sharevts and -novtswitch: it takes no terminal of the machine that runs the tests.
        self.server = subprocess.Popen(
            ["Xorg", "-displayfd", str(write), "-config", configuration, "-logfile", Path(folder, "xorg.log"),
             "-nocursor", "-s", "0",
             "-dpms", "-background", "none", "-nolisten", "tcp", "-noreset", "-sharevts", "-novtswitch"],
            pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as number:
            self.name = ":" + number.readline().strip()
        try:
            for place in range(3):
                if place > 0:
                    self.xrandr("--addmode", f"DUMMY{place}", self.mode)
                self.plug(place)
        except BaseException:
            self.close()
            raise

    def xrandr(self, *words):
        subprocess.run(["xrandr", *words], env=self.environment, check=True, capture_output=True, timeout=20)

    def plug(self, place):
        self.xrandr("--output", f"DUMMY{place}", "--mode", self.mode, "--pos", f"{self.size[0] * place}x0")
        self.xrandr("--query")  # the driver looks at its outputs only when somebody asks

    def unplug(self, place):
        self.xrandr("--output", f"DUMMY{place}", "--off")

    def place_of(self, place):
        """Of a monitor on the desktop, as a window's."""
        listing = subprocess.run(["xrandr", "--query"], env=self.environment, capture_output=True, text=True,
                                 timeout=20).stdout
        width, height, x, y = map(int, re.search(rf"DUMMY{place} connected[a-z ]* (\d+)x(\d+)\+(\d+)\+(\d+)",
                                                 listing).groups())
        return x, y, width, height

    def window_of(self, channel):
        """Its place on the desktop, None where it has no window."""
        found = [place[:4] for title, place in self.windows().items() if title.split('"')[0] == f"Aquarama {channel}"]
        return found[0] if found else None

    def colours_at(self, place):
        """How many colours the monitor shows in a grid of places."""
        _, _, pixel = self.screenshot()
        width, height = self.size
        return len({pixel(width * place + i * width // 24, j * height // 18) for i in range(1, 24)
                    for j in range(1, 18)})

    def save(self, path):
        """All monitors as they are now, as a picture."""
        from PIL import Image
        width, height, pixel = self.screenshot()
        picture = Image.new("RGB", (width, height))
        picture.putdata([pixel(x, y) for y in range(height) for x in range(width)])
        picture.save(path)


def takes_outputs():
    """Whether there is a server with the dummy driver here."""
    driver = any(Path(folder, "xorg/modules/drivers/dummy_drv.so").exists() for folder in ("/usr/lib", "/usr/lib64"))
    return driver and all(map(shutil.which, ("Xorg", "xrandr", "xwininfo", "xwd")))


@unittest.skipUnless(takes_outputs(),
                     "xserver-xorg-core, xserver-xorg-video-dummy, x11-xserver-utils and x11-apps are needed for three "
                     "monitors")
class ThreeMonitors(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder()
        self.display = Monitors(self.folder.name)
        self.processes = []

    def tearDown(self):
        end(self.processes)
        self.display.close()
        self.folder.cleanup()

    def rig(self, connectors):
        """The desk on whole monitors, at these connectors from left to right, with a scene that is soon prepared."""
        rig = rig_on_free_ports(self.folder.name, replace=EMPTY_SEA)
        names = iter(connectors)
        rig.write_text(re.sub(r"mode: WINDOW[^}]*", lambda _: f"mode: FULLSCREEN {next(names)} ", rig.read_text()))
        return rig

    def start_node(self, channel, rig, log=None, more=()):
        command = [BIN / "aquarama-node", channel, "--master", control_address(rig), "--trace", self.folder.name, *more]
        with open(log or os.devnull, "w") as output:
            self.processes.append(subprocess.Popen(command, env=self.display.environment, cwd=ROOT,
                                                   stdout=subprocess.DEVNULL, stderr=output))
        return self.processes[-1]

    def frames(self, channel):
        return max(trace(self.folder.name, channel), default=-1)

    def test_a_monitor_goes_and_comes_back_while_the_wall_goes_on(self):
        # Not in the order in which the server counts its outputs.
        rig = self.rig(f'connector: "DUMMY{place}"' for place in (2, 1, 0))
        places = {"left": 2, "middle": 1, "right": 0}
        self.processes.append(start("master", rig, "--pattern", "grid"))
        for channel in CHANNELS:
            self.start_node(channel, rig)
        wait_until(lambda: min(map(self.frames, CHANNELS)) >= 10, 60, "ten frames of each")
        where = {channel: (SIZE[0] * place, 0, *SIZE) for channel, place in places.items()}
        self.assertEqual({channel: self.display.window_of(channel) for channel in CHANNELS}, where)
        for place in range(3):
            self.assertGreater(self.display.colours_at(place), 1, "no grid is shown")

        self.display.unplug(places["middle"])
        wait_until(lambda: self.display.window_of("middle")[0] < 0, 10,
                   "the window whose monitor is gone to be out of the way")
        for channel in ("left", "right"):
            self.assertEqual(self.display.window_of(channel), where[channel])
        frames = {channel: self.frames(channel) for channel in CHANNELS}
        wait_until(lambda: all(self.frames(channel) > frames[channel] + 10 for channel in CHANNELS), 60,
                   "all nodes to draw on")

        self.display.plug(places["middle"])
        back = time.monotonic()
        wait_until(lambda: self.display.window_of("middle") == where["middle"], 10, "the window to be back")
        wait_until(lambda: self.display.colours_at(places["middle"]) > 1, 10, "its picture to be back")
        self.assertLess(time.monotonic() - back, 1, "from the monitor's return to its picture, seconds")
        frames = {channel: self.frames(channel) for channel in CHANNELS}
        wait_until(lambda: all(self.frames(channel) > frames[channel] + 10 for channel in CHANNELS), 60,
                   "all nodes to draw on")

        # Monitors that move on the desktop, as the others do where the first one goes, take their windows with them.
        self.display.unplug(0)
        for channel in ("left", "middle"):
            at = self.display.place_of(places[channel])
            self.assertNotEqual(at, where[channel])
            wait_until(lambda: self.display.window_of(channel) == at, 10, "the window to follow its monitor")

    def test_a_connector_that_is_not_there_is_refused_with_those_that_are(self):
        rig = self.rig(["connector: \"HDMI-7\"", "", "connector: \"DUMMY1\""])
        self.processes.append(start("master", rig, "--pattern", "grid"))
        log = Path(self.folder.name, "log")
        for channel, said in (("left",
                               "there is no monitor HDMI-7; this machine has DUMMY0, DUMMY1, DUMMY2: correct the "
                               "channel's connector"),
                              ("middle",
                               "this machine has several monitors (DUMMY0, DUMMY1, DUMMY2); name the channel's")):
            self.assertEqual(self.start_node(channel, rig, log).wait(60), 1)
            self.assertIn(said, log.read_text())

    def test_each_of_two_nodes_without_a_key_shows_its_letter_on_its_monitor(self):
        for place in (0, 2):
            self.processes.append(subprocess.Popen(
                [BIN / "aquarama-node", "--key", Path(self.folder.name, f"{place}.key"), "--wait-for-key",
                 "--connector", f"DUMMY{place}"], env=self.display.environment, stdout=subprocess.DEVNULL))

        def picture(place):
            _, _, pixel = self.display.screenshot()
            return [pixel(SIZE[0] * place + x, y) for y in range(0, SIZE[1] // 2, 4) for x in range(0, SIZE[0], 4)]
        is_lit = lambda place: any(min(colour) > 200 for colour in picture(place))
        wait_until(lambda: is_lit(0) and is_lit(2), 60, "two letters")
        self.assertFalse(is_lit(1))
        self.display.unplug(2)
        wait_until(lambda: not is_lit(2), 30, "the letter to go with its monitor")
        self.display.plug(2)
        wait_until(lambda: is_lit(2), 30, "the letter to be back")

    def test_a_channel_fills_the_monitor_that_its_machine_has_for_it(self):
        rig = self.rig(f'connector: "DUMMY{place}"' for place in range(3))
        self.processes.append(start("master", rig, "--pattern", "grid"))
        self.start_node("left", rig, more=("--connector", "DUMMY2"))
        wait_until(lambda: self.frames("left") >= 3, 60, "its frames")
        self.assertEqual(self.display.window_of("left"), (2 * SIZE[0], 0, *SIZE))

    def test_a_node_is_black_until_its_first_frame(self):
        # Its master makes no frame as long as a node of a lockstep show is missing.
        rig = self.rig(f'connector: "DUMMY{place}"' for place in range(3))
        subprocess.run(["xsetroot", "-solid", "white"], env=self.display.environment, check=True)
        self.processes.append(start("master", rig, "--pattern", "grid", "--lockstep"))
        self.start_node("left", rig)
        wait_until(lambda: self.display.window_of("left") == (0, 0, *SIZE), 60, "the window")
        wait_until(lambda: self.display.screenshot()[2](240, 180) == (0, 0, 0), 20, "black")
        self.assertEqual(self.display.colours_at(0), 1)
        self.assertEqual(self.display.screenshot()[2](SIZE[0] + 240, 180), (255, 255, 255),
                         "the screen itself is black")
        self.assertEqual(self.frames("left"), -1)


@unittest.skipUnless(takes_outputs(), "as above")
class ThreeTelevisions(unittest.TestCase):
    """docs/three_televisions.md, step by step. Where AQUARAMA_SHOTS names a folder, its pictures are left there."""

    def setUp(self):
        self.folder = temporary_folder()
        self.display = Monitors(self.folder.name, TELEVISION)
        self.shots = os.environ.get("AQUARAMA_SHOTS")
        self.show = None

    def tearDown(self):
        if self.show:
            end([self.show], 20)
        self.display.close()
        self.folder.cleanup()

    def frames(self):
        return min(max(trace(self.folder.name, channel), default=-1) for channel in CHANNELS)

    def start_show(self, *arguments):
        for channel in CHANNELS:
            Path(self.folder.name, f"{channel}.csv").unlink(missing_ok=True)
        self.show = subprocess.Popen([BIN / "aquarama", "run", self.rig, "--trace", self.folder.name, *arguments],
                                     env=self.display.environment,
                                     cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_until(lambda: self.frames() >= 5 or self.show.poll() is not None, 120, "five frames of each")
        self.assertIsNone(self.show.poll())

    def end_show(self):
        """By q in the middle window, as the guide says."""
        window = next(place[4] for title, place in self.display.windows().items()
                      if title.startswith("Aquarama middle"))
        self.display.press(window, "q")
        self.assertEqual(self.show.wait(30), 0)

    def test_from_a_new_rig_to_a_picture_on_all_three(self):
        self.rig = Path(self.folder.name, "school.txtpb")
        made = aquarama("new-rig", self.rig, "--screen", "televisions", "--monitors", "DUMMY0,DUMMY1,DUMMY2", "--size",
                        self.display.mode,
                        "--diagonal", 55, "--angle", 50, "--distance", 1.2)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(aquarama("check", self.rig).returncode, 0)
        if self.shots:
            shutil.copy(self.rig, self.shots)
        text = self.rig.read_text()
        # Beside other shows of this machine, and without a graphics card: a scene that is soon prepared.
        text, count = re.subn(r'(scene: "[^"]*)reef', r"\1empty_sea", text)
        self.assertEqual(count, 1)
        for port, other in zip((7400, 7401, 7402, 7480), free_ports(4)):
            text = text.replace(str(port), str(other))
        self.rig.write_text(text.replace("membership_s: 1", "present_deadline_s: 2 membership_s: 5"))

        self.start_show("--pattern", "grid")
        self.assertEqual([self.display.window_of(channel) for channel in CHANNELS],
                         [(TELEVISION[0] * i, 0, *TELEVISION) for i in range(3)])
        self.assertTrue(all(self.display.colours_at(place) > 1 for place in range(3)))
        if self.shots:
            self.display.save(Path(self.shots, "televisions_grid.png"))
        self.end_show()
        if self.shots:
            self.start_show("--scene", "config/scenes/reef.txtpb", "--quality", "medium")
            wait_until(lambda: self.frames() >= 60, 300, "a second of the reef")
            self.display.save(Path(self.shots, "televisions_reef.png"))
            self.end_show()
            aquarama("run", self.rig, "--scene", ROOT / "config/scenes/reef.txtpb", "--headless", "--quality", "medium",
                     "--frames", 61, "--snapshot", self.shots, timeout=600)


class Outputs(unittest.TestCase):
    """What packaging/kiosk/aquarama-outputs makes of a machine, in a folder in place of its root."""

    def setUp(self):
        self.folder = temporary_folder()
        self.root = Path(self.folder.name)
        for name, modes, edid in (("card0-HDMI-A-1", "1920x1080\n1280x720\n", b"television"),
                                  ("card0-HDMI-A-2", "", b""),
                                  ("card1-DP-1", "1400x1050\n", b"projector")):
            connector = self.root / "sys/class/drm" / name
            connector.mkdir(parents=True)
            (connector / "status").write_text("connected\n" if edid else "disconnected\n")
            (connector / "modes").write_text(modes)
            (connector / "edid").write_bytes(edid)

    def tearDown(self):
        self.folder.cleanup()

    def outputs(self, *words):
        return subprocess.run([ROOT / "packaging/kiosk/aquarama-outputs", "--root", self.root, *words],
                              capture_output=True, text=True)

    def test_they_are_pinned_by_connector_and_stored_edid_and_freed_again(self):
        before = {path for path in self.root.rglob("*") if path.is_file()}
        self.assertEqual(self.outputs("show").stdout, "HDMI-1 1920x1080\nDP-1 1400x1050\n")
        done = self.outputs("pin", "DP-1", "HDMI-1")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        boot = (self.root / "etc/default/grub.d/60-aquarama.cfg").read_text()
        line = subprocess.run(["sh", "-c", boot + "echo $GRUB_CMDLINE_LINUX_DEFAULT"], capture_output=True, text=True,
                              env={"GRUB_CMDLINE_LINUX_DEFAULT": "splash"}).stdout.split()
        self.assertEqual(line[0], "splash", "what was there is lost")
        for word in ("consoleblank=0", "vt.global_cursor_default=0", "video=DP-1:1400x1050e",
                     "video=HDMI-A-1:1920x1080e",
                     "drm.edid_firmware=DP-1:edid/aquarama-DP-1.bin,HDMI-A-1:edid/aquarama-HDMI-A-1.bin"):
            self.assertIn(word, line)
        self.assertEqual((self.root / "usr/lib/firmware/edid/aquarama-HDMI-A-1.bin").read_bytes(), b"television")
        layout = (self.root / "etc/X11/xorg.conf.d/60-aquarama.conf").read_text()
        self.assertRegex(layout, r'Identifier "HDMI-1"\n.*"1920x1080"\n.*\n.*"RightOf" "DP-1"')
        self.assertEqual(self.outputs("free").returncode, 0)
        self.assertEqual({path for path in self.root.rglob("*") if path.is_file()}, before)

    def test_what_cannot_be_pinned_is_refused_and_nothing_is_written(self):
        before = {path for path in self.root.rglob("*")}
        for words, said in ((("pin",), "connected are: HDMI-1 DP-1"),
                            (("pin", "HDMI-7"), "there is no connector HDMI-7; connected are: HDMI-1 DP-1"),
                            (("pin", "DP-1", "HDMI-2"), "switch it on"), (("grow",), "show, pin or free")):
            done = self.outputs(*words)
            self.assertEqual(done.returncode, 1)
            self.assertIn(said, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
        self.assertEqual({path for path in self.root.rglob("*")}, before)


if __name__ == "__main__":
    unittest.main(verbosity=2)
