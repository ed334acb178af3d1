"""What check_budgets.py says of a suite that grew, of one without a budget, and of a machine that is slow."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from check_budgets import FILE, at_one_speed, complaints, read_budgets, read_times

TIMED = Path(__file__).with_name("timed.py")
BUDGETS = {"reef": 20.0, "motion": 10.0, "wall": 6.0, "body": 1.0}


class Budgets(unittest.TestCase):
    def lines(self, **changed):
        return complaints(BUDGETS | changed, BUDGETS)

    def test_a_suite_that_grew_by_half_is_named_with_what_to_do(self):
        self.assertEqual(self.lines(reef=29.9), [])
        self.assertEqual(self.lines(reef=30.1), [
            "the suite reef took 30 s of processor time, its budget is 20 s: make it cheaper, "
            f"or raise its line in {FILE} and say why"])

    def test_a_suite_shorter_than_two_seconds_may_take_three(self):
        self.assertEqual(self.lines(body=2.9), [])
        self.assertEqual(len(self.lines(body=3.1)), 1)

    def test_a_suite_without_a_budget_and_a_budget_without_a_suite(self):
        self.assertEqual(complaints({"reef": 20.0, "new": 7.4}, {"reef": 20.0, "gone": 5.0}), [
            f"{FILE}: there is no suite gone: remove its line",
            f"{FILE}: the suite new has no budget: add the line new,7"])

    def test_on_a_machine_half_as_fast_only_what_grew_there_is_named(self):
        slow = {suite: 2 * seconds for suite, seconds in BUDGETS.items()}
        self.assertEqual(complaints(slow, BUDGETS), [])
        self.assertIn("motion took 31 s", complaints(slow | {"motion": 31.0}, BUDGETS)[0])

    def test_a_fast_machine_does_not_tighten_the_budgets(self):
        fast = {suite: seconds / 2 for suite, seconds in BUDGETS.items()}
        self.assertEqual(complaints(fast | {"motion": 10.0}, BUDGETS), [])

    def test_a_suite_is_not_named_for_slow_minutes_of_the_machine(self):
        times = {suite: (seconds, 20.0) for suite, seconds in BUDGETS.items()} | {"reef": (40.0, 40.0)}
        self.assertEqual(complaints(at_one_speed(times), BUDGETS), [])
        self.assertEqual(len(complaints(at_one_speed(times | {"reef": (40.0, 20.0)}), BUDGETS)), 1)

    def test_quick_minutes_tighten_no_budget(self):
        times = {suite: (seconds, 20.0) for suite, seconds in BUDGETS.items()} | {"reef": (25.0, 10.0)}
        self.assertEqual(complaints(at_one_speed(times), BUDGETS), [])

    def test_what_a_command_and_its_children_took_is_written_with_its_status(self):
        with tempfile.TemporaryDirectory() as folder:
            spin = "import time\nwhile time.process_time() < 0.3: pass"
            run = subprocess.run([TIMED, Path(folder, "spin"), "sh", "-c", f"{sys.executable} -c '{spin}'; exit 3"])
            killed = subprocess.run([TIMED, Path(folder, "killed"), "sh", "-c", "kill -9 $$"])
            self.assertEqual((run.returncode, killed.returncode), (3, 128 + 9))
            seconds, piece = read_times(folder)["spin"]
            self.assertGreaterEqual(seconds, 0.3)
            self.assertGreater(piece, 0)

    def test_a_command_ends_where_nobody_reads_what_it_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.run(["bash", "-c", f"{TIMED} {folder}/yes yes | head -n 1; exit ${{PIPESTATUS[0]}}"],
                                 stdout=subprocess.DEVNULL)
            self.assertEqual(run.returncode, 128 + 13)

    def test_the_file_in_the_tree_is_sorted_and_read(self):
        budgets = read_budgets(Path(__file__).resolve().parents[2] / FILE)
        self.assertEqual(list(budgets), sorted(budgets))
        self.assertIn("budgets", budgets)


if __name__ == "__main__":
    unittest.main()
