"""What check_budgets.py says of a suite that grew, of one without a budget, and of a machine that is slow."""

import tempfile
import unittest
from pathlib import Path

from check_budgets import FILE, complaints, read_budgets, read_times

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

    def test_the_childrens_time_is_read_user_and_system(self):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "reef").write_text("0m0.010000s 0m0.020000s\n1m2.500000s 0m1.250000s\n")
            self.assertEqual(read_times(folder), {"reef": 63.75})

    def test_the_file_in_the_tree_is_sorted_and_read(self):
        budgets = read_budgets(Path(__file__).resolve().parents[2] / FILE)
        self.assertEqual(list(budgets), sorted(budgets))
        self.assertIn("budgets", budgets)


if __name__ == "__main__":
    unittest.main()
