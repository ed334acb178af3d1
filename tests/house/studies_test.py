#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""docs/studies.py sees figures of an earlier motor or earlier minds, and fills in what a command prints."""
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "docs"))
import studies

MARK = "<!-- study: aquarama study --seeds 2 --out DIR | motor 3, minds 5, commit abcdef0 -->\n"
OF_MOTOR = "<!-- study: aquarama fidelity --out DIR | table 2 | motor 3, commit abcdef0 -->\n"
END = "<!-- end of study -->\n"
PRINTED = "### one\n\n| a |\n|---|\n| 1 |\n\n### two\n\n| b |\n|---|\n| 2 |\n\nmotor 4, minds 6\n"


class Studies(unittest.TestCase):
    def problems(self, text, motor="3", minds="5"):
        return list(studies.problems("a.md", text, (motor, minds)))

    def test_figures_of_these_versions_pass(self):
        self.assertEqual(self.problems(MARK + OF_MOTOR + "| b |\n" + END), [])

    def test_those_of_an_earlier_motor_are_named_with_the_command_that_makes_them_anew(self):
        said = self.problems(MARK + "by hand\n" + OF_MOTOR + "| b |\n" + END, motor="4")
        self.assertEqual(said, [
            "a.md: figures are of motor 3, minds 5, commit abcdef0, not of motor 4, minds 5: "
            "run aquarama study --seeds 2 --out DIR, and enter figures and versions",
            "a.md: figures are of motor 3, commit abcdef0, not of motor 4, minds 5: "
            "run docs/studies.py 'aquarama fidelity --out DIR'"])

    def test_of_earlier_minds_are_only_figures_that_depend_on_them(self):
        self.assertEqual(len(self.problems(MARK, minds="6")), 1)
        self.assertEqual(self.problems(OF_MOTOR, minds="6"), [])

    def test_a_mark_of_another_form_is_a_problem(self):
        self.assertEqual(len(self.problems(MARK.replace(", commit abcdef0", ""))), 1)

    def test_versions_are_those_of_the_header(self):
        self.assertTrue(all(number.isdecimal() for number in studies.versions_in(studies.VERSIONS.read_text())))

    def test_a_block_is_filled_with_all_or_with_one_table_and_what_moved_the_fish(self):
        whole = studies.block("aquarama study", None, PRINTED, "1234567")
        self.assertTrue(whole.startswith("<!-- study: aquarama study | motor 4, minds 6, commit 1234567 -->\n"))
        self.assertIn("\n### one\n\n| a |", whole)
        self.assertTrue(whole.endswith("| 2 |\n<!-- end of study -->"))
        second = studies.block("aquarama study", "2", PRINTED, "1234567")
        self.assertIn(" | table 2 | ", second)
        self.assertIn("\n| b |\n|---|\n| 2 |\n<!--", second)
        self.assertNotIn("| a |", second)

    def test_an_end_belongs_to_the_mark_before_it(self):
        blocks = studies.BLOCK.finditer(MARK + "by hand\n" + OF_MOTOR + "| b |\n" + END)
        self.assertEqual([found[1] for found in blocks], ["aquarama fidelity --out DIR"])


if __name__ == "__main__":
    unittest.main()
