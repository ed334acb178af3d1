#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each limit of measures.py can be exceeded, and what keeps it is let through."""
import collections
import os
import pathlib
import tempfile
import unittest

import declarations
import measures
import texts

Function = collections.namedtuple("Function", "filename start_line name length cyclomatic_complexity")


def functions(count, length, complexity):
    return [Function("a.cpp", 1, "f", length, complexity)] * count


class Measures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def write(self, name, *lines):
        path = self.root / name
        path.write_text("\n".join(lines) + "\n")
        return path

    def size_problems(self, *lines):
        return [problem for of_file in declarations.declarations([self.write("a.h", *lines)]).values()
                for problem in declarations.size_problems(of_file)]

    def undocumented(self, *lines):
        """The names of declarations without a doc line."""
        return [problem.split()[1] for path, of_file in declarations.declarations([self.write("a.h", *lines)]).items()
                for problem in declarations.doc_problems(path, of_file)]

    def test_functions(self):
        self.assertEqual(list(measures.function_problems(functions(100, 26, 6))), [])
        self.assertEqual(len(list(measures.function_problems(functions(100, 26, 6) + functions(1, 61, 6)))), 1)
        self.assertEqual(len(list(measures.function_problems(functions(100, 27, 6)))), 1)
        self.assertEqual(len(list(measures.function_problems(functions(100, 26, 7)))), 1)

    def test_repetitions(self):
        lines = [f"line {number};" for number in range(measures.REPEATED_LINES)]
        first = self.write("a.cpp", *lines)
        self.assertEqual(list(measures.repetitions([first, self.write("b.cpp", *lines[1:])])), [])
        self.assertEqual(len(list(measures.repetitions([first, self.write("b.cpp", *lines)]))), 1)

    def test_knots(self):
        free = {"a/x.h": {"b/x.h"}, "b/x.h": {"c/x.h", "b/y.h"}, "b/y.h": set(), "c/x.h": {"other.h"}}
        self.assertEqual(list(measures.knots(free)), [])
        self.assertEqual(len(list(measures.knots(free | {"a/y.h": set(), "c/x.h": {"a/y.h"}}))), 1, "folders")
        self.assertEqual(len(list(measures.knots(free | {"b/y.h": {"b/x.h"}}))), 1, "files")

    def test_inclusions(self):
        path = self.write("a.cpp", '#include "b/c.h"', "#include <d>")
        self.assertEqual(measures.inclusions(self.root, [path]), {"a.cpp": {"b/c.h"}})

    @unittest.skipUnless(declarations.has_ctags() or os.environ.get("CI"), "no universal-ctags")
    def test_class_size(self):
        methods = [f"void f{number}();" for number in range(declarations.MOST_METHODS)]
        members = [f"int m{number};" for number in range(declarations.MOST_MEMBERS)]
        self.assertEqual(self.size_problems("class A {", *methods, *members, "static const int s;", "};"), [])
        self.assertEqual(len(self.size_problems("class A {", *methods, "void f();", "};")), 1)
        self.assertEqual(len(self.size_problems("class A {", *members[1:], "struct B { int m, n; };", "};")), 1)

    @unittest.skipUnless(declarations.has_ctags() or os.environ.get("CI"), "no universal-ctags")
    def test_doc_lines(self):
        self.assertEqual(self.undocumented("// One.", "int f();", "int g();", "", "struct A {};  // Two.", "",
                                           "// Three.", "class B {", "  public:", "    B() = default;", "  private:",
                                           "    int h();", "};"), [])
        self.assertEqual(self.undocumented("// One.", "", "int f();"), ["f"], "a blank line ends a group")
        self.assertEqual(self.undocumented("// One.", "struct A {", "    int g();", "};"), ["g"])
        self.assertEqual(self.undocumented("// One.", "class A {", "  public:", "    explicit A(int b);",
                                           "    int c();", "};"), ["c"])
        self.assertEqual(self.undocumented("using A = int;", "", "enum class B { C };"), ["A", "B"])

    def test_width(self):
        fits = "x" * texts.MOST_COLUMNS
        self.assertEqual(list(texts.width_problems("a.md", f"{fits}\n- [{fits}](b)\nhttps://{fits}")), [])
        self.assertEqual(len(list(texts.width_problems("a.md", f"{fits} y"))), 1)
        self.assertEqual(list(texts.width_problems("a.md", f"| {fits} |\n    {fits}")), [])
        self.assertEqual(len(list(texts.width_problems("a.py", f"https://{fits}"))), 1)

    def test_sentences(self):
        short, long = "word " * texts.MOST_WORDS + ".\n", "word " * (texts.MOST_WORDS + 1) + ".\n"
        self.assertEqual(list(texts.sentence_problems("a.md", short * 19 + long)), [])
        self.assertEqual(len(list(texts.sentence_problems("a.md", short * 18 + long))), 1)
        self.assertEqual(list(texts.sentence_problems("a.md", f"```\n{long}```\n|{short}|{short}|\n- {short}")), [])
        self.assertEqual(list(texts.sentences("One `of two`.\n\n# Three\n\n| four five | six |\n")), [2, 1, 2, 1])

    def test_older_decisions_keep_their_sentences(self):
        self.assertTrue(texts.keeps_its_sentences("docs/decisions/0067-clocks.md"))
        self.assertFalse(texts.keeps_its_sentences("docs/decisions/0068-limits.md"))


if __name__ == "__main__":
    unittest.main()
