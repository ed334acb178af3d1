"""A master and three nodes over real sockets, in lockstep: order, sameness, start order."""

import hashlib
import itertools
import random
import subprocess
import time
import unittest
from pathlib import Path

from show import CHANNELS, EMPTY_SEA, aquarama, control_address, end, rig_on_free_ports, start, temporary_folder, trace


def assert_presented_in_step(case, folder, frames):
    traces = {name: trace(folder, name) for name in CHANNELS}
    for name, rows in traces.items():
        case.assertEqual(sorted(rows), list(range(frames)), f"{name} presented every frame once")
    for frame in range(frames):
        last_ready = max(rows[frame][1] for rows in traces.values())
        first_present = min(rows[frame][2] for rows in traces.values())
        case.assertLessEqual(last_ready, first_present, f"frame {frame} was presented before all were ready for it")


class Lockstep(unittest.TestCase):
    def test_no_frame_is_presented_before_all_are_ready(self):
        with temporary_folder() as folder:
            rig = rig_on_free_ports(folder)
            run = aquarama("run", rig, "--headless", "--frames", 60, "--trace", folder)
            self.assertEqual(run.returncode, 0, run.stderr)
            assert_presented_in_step(self, folder, 60)
            self.assertEqual(sorted(trace(folder, "master")), list(range(60)))

    def test_the_same_seed_gives_the_same_picture(self):
        pictures = []
        for seed in (7, 7, 8):
            with temporary_folder() as folder:
                rig = rig_on_free_ports(folder)
                run = aquarama("run", rig, "--headless", "--frames", 12, "--seed", seed, "--snapshot", folder)
                self.assertEqual(run.returncode, 0, run.stderr)
                pictures.append(hashlib.sha256(Path(folder, "panorama.png").read_bytes()).hexdigest())
        self.assertEqual(pictures[0], pictures[1])
        self.assertNotEqual(pictures[0], pictures[2])

    def test_any_order_and_delay_of_start_comes_up(self):
        chance = random.Random(1998)
        for order in itertools.permutations(range(4)):
            with temporary_folder() as folder:
                rig = rig_on_free_ports(folder, replace=EMPTY_SEA)
                log = f"{folder}/log"
                starts = [("master", rig, "--lockstep", "--frames", 3, "--pattern", "grid", "--trace", folder)]
                starts += [("node", name, "--master", control_address(rig), "--headless", "--trace", folder)
                           for name in CHANNELS]
                starts = [starts[i] for i in order]
                processes = []
                try:
                    for program in starts:
                        processes.append(start(*program, log=log))
                        time.sleep(chance.choice([0, 0, 0.02, 0.1, 0.4]))
                    for process in processes:
                        self.assertEqual(process.wait(60), 0, Path(log).read_text())
                except subprocess.TimeoutExpired:
                    self.fail(f"start {order} hangs: {starts}\n{Path(log).read_text()}")
                finally:
                    end(processes)
                assert_presented_in_step(self, folder, 3)


if __name__ == "__main__":
    unittest.main(verbosity=2)
