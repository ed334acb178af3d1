"""Real processes under a service manager of the test's own: READY, WATCHDOG from the frame loop alone, STOPPING."""

import ctypes
import os
import re
import socket
import subprocess
import time
import unittest
from pathlib import Path

from show import BIN, ROOT, aquarama, control_address, end, rig_on_free_ports, temporary_folder, wait_until

PATIENCE = 60    # seconds: software OpenGL builds for some
ALLOWED = 2      # seconds between two signs of life, as a unit would say by WatchdogSec
WALL = 0x40000000  # __WALL: threads as well


class Held:
    """One thread of a process stands still, the others run on. By ptrace, as a debugger does it."""

    def __init__(self, process, thread):
        self.libc = ctypes.CDLL(None, use_errno=True)
        # Threads that it starts have its name: the eldest is meant. None: the main thread.
        named = [int(path.name) for path in Path(f"/proc/{process.pid}/task").iterdir()
                 if Path(path, "comm").read_text().strip() == thread]
        self.thread = min(named) if thread else process.pid
        for request in 0x4206, 0x4207:  # PTRACE_SEIZE, PTRACE_INTERRUPT
            self.ask(request)
        os.waitpid(self.thread, WALL)

    def ask(self, request):
        if self.libc.ptrace(request, self.thread, None, None) != 0:
            raise unittest.SkipTest("this kernel lets nobody hold a thread: " + os.strerror(ctypes.get_errno()))

    def let_go(self):
        self.ask(17)  # PTRACE_DETACH


class Manager:
    """The socket of a service manager, and one service that it has started."""

    def __init__(self, *command, abstract=False, folder=None):
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        address = f"aquarama-service-{os.getpid()}-{time.monotonic_ns()}"
        self.socket.bind("\0" + address if abstract else f"{folder}/{address}")
        environment = os.environ | {"LP_NUM_THREADS": "1", "WATCHDOG_USEC": str(ALLOWED * 1_000_000),
                                    "NOTIFY_SOCKET": "@" + address if abstract else f"{folder}/{address}"}
        environment.pop("WATCHDOG_PID", None)
        self.process = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL,
                                        env=environment, cwd=ROOT)

    def close(self):
        end([self.process])
        self.socket.close()

    def within(self, seconds, until=lambda message: False):
        """The messages of so many seconds, or up to the first that `until` is true of."""
        deadline = time.monotonic() + seconds
        messages = []
        while (left := deadline - time.monotonic()) > 0:
            self.socket.settimeout(left)
            try:
                messages.append(self.socket.recv(4096).decode())
            except TimeoutError:
                break
            if until(messages[-1]):
                break
        return messages

    def await_ready(self):
        messages = self.within(PATIENCE, lambda message: message == "READY=1")
        assert messages and messages[-1] == "READY=1", messages
        return messages

    def is_alive(self, seconds=2 * ALLOWED):
        """Whether signs of life come often enough for all of this time; whatever has arrived before counts for
        nothing."""
        self.within(0.05)
        times = [time.monotonic()]
        deadline = times[0] + seconds
        while time.monotonic() < deadline:
            if not any("WATCHDOG=1" in message
                       for message in self.within(ALLOWED, lambda message: "WATCHDOG=1" in message)):
                return False
            times.append(time.monotonic())
        return all(later - earlier < ALLOWED for earlier, later in zip(times, times[1:]))

    def is_silent(self, seconds=2 * ALLOWED):
        """Whether none comes. What is under way when a thread is held may still arrive, and a master waits 2 s for a
        tick."""
        self.within(2.3)
        return not any("WATCHDOG=1" in message for message in self.within(seconds))


class Services(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder()
        self.rig = rig_on_free_ports(self.folder.name)
        self.started = []

    def tearDown(self):
        for service in self.started:
            service.close()
        self.folder.cleanup()

    def serve(self, *command, **options):
        self.started.append(Manager(*command, folder=self.folder.name, **options))
        return self.started[-1]

    def master(self):
        return self.serve(BIN / "aquarama", "master", self.rig, "--pattern", "grid", abstract=True)

    def node(self):
        return self.serve(BIN / "aquarama-node", "middle", "--master", control_address(self.rig), "--headless")

    def condition(self):
        """Of the node, as the master says it."""
        found = re.search(r"^middle +(absent|preparing|in step|late)", aquarama("status", self.rig).stdout,
                          re.MULTILINE)
        return found[1] if found else "unknown"

    def held(self, service, thread):
        """Silent while its thread is held, alive before and after."""
        self.assertTrue(service.is_alive(), "before")
        held = Held(service.process, thread)
        try:
            silent = service.is_silent()
        finally:
            held.let_go()
        self.assertTrue(silent, f"signs of life come while {thread or 'the main thread'} stands still")
        wait_until(lambda: service.is_alive(ALLOWED), PATIENCE, "signs of life again")

    def test_a_node_is_ready_when_prepared_and_alive_as_long_as_its_frame_loop_is(self):
        node = self.node()
        waiting = node.within(3)
        self.assertIn(f"STATUS=waiting for the master at {control_address(self.rig)}", waiting)
        self.assertGreater(waiting.count("EXTEND_TIMEOUT_USEC=30000000"), 1,
                           "it does not ask for patience without a master")
        self.assertFalse([message for message in waiting if "READY" in message or "WATCHDOG" in message])
        master = self.master()
        before = node.await_ready()
        self.assertFalse([message for message in before if "WATCHDOG=1" in message])
        wait_until(lambda: self.condition() == "in step", 5, "the node that said it is ready to be in step")
        self.assertTrue(any(message.startswith("STATUS=frame ")
                            for message in node.within(PATIENCE, lambda m: m.startswith("STATUS=frame"))))
        self.held(node, "frames")
        # Its other threads were not held: the master has heard of it all the time.
        self.assertIn(self.condition(), ("in step", "late"))
        # Without a master it waits, as it is meant to.
        master.process.kill()
        master.process.wait()
        self.assertIn("STATUS=the master is gone; waiting for it",
                      node.within(PATIENCE, lambda message: "the master is gone" in message))
        self.assertTrue(node.is_alive(), "a node that waits for its master is taken for hung")
        node.process.terminate()
        self.assertIn("STOPPING=1", node.within(10, lambda message: message == "STOPPING=1"))
        self.assertEqual(node.process.wait(10), 0)

    def test_a_master_is_ready_when_nodes_may_come_and_alive_as_long_as_frames_and_ticks_are(self):
        master = self.master()
        master.await_ready()
        self.assertEqual(aquarama("status", self.rig).returncode, 0)
        self.held(master, None)
        self.held(master, "ticks")
        self.assertEqual(aquarama("set", self.rig, "freeze", "on").returncode, 0)
        self.assertTrue(master.is_alive(), "a world that stands still as it is told to is taken for hung")
        master.process.terminate()
        self.assertIn("STOPPING=1", master.within(10, lambda message: message == "STOPPING=1"))
        self.assertEqual(master.process.wait(10), 0)

    def test_a_node_that_hangs_is_started_again_and_is_back_in_step(self):
        # As systemd does it: no sign of life for as long as is allowed, so it is killed, and another is started.
        self.master().await_ready()
        node = self.node()
        node.await_ready()
        wait_until(lambda: self.condition() == "in step", PATIENCE, "the node to be in step")
        held = Held(node.process, "frames")
        try:
            messages = ["WATCHDOG=1"]
            while any("WATCHDOG=1" in message for message in messages):
                messages = node.within(ALLOWED)
            self.assertIsNone(node.process.poll(), "it has ended by itself")
        finally:
            node.process.kill()
            os.waitpid(held.thread, WALL)  # a debugger buries what it held, or the process stays
            node.process.wait(10)
        self.node().await_ready()
        wait_until(lambda: self.condition() == "in step", PATIENCE,
                   "the node that was started in its place to be in step")

    @unittest.skipUnless((BIN / "aquarama-console").exists(), "the console is not built")
    def test_a_console_is_ready_when_it_listens(self):
        console = self.serve(BIN / "aquarama-console", self.rig, "--port", "0")
        console.await_ready()
        self.held(console, None)
        console.process.terminate()
        self.assertIn("STOPPING=1", console.within(10, lambda message: message == "STOPPING=1"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
