"""What `./run mutants` is built on, held to small sources: python3 -m unittest mutants_test."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import named
import scoring
import summary
import tree
from schemata import HEADER, Mutant, with_branches

SOURCE = """#include <cstdio>
constexpr int twice(int n) { return 2 * n; }
int main() {
  int sum = twice(3);
  sum += 1;
  std::printf("%d\\n",
              sum);
}
"""


def mutant(number, find, replace, **more):
    start = SOURCE.index(find)
    return Mutant(file="x.cpp", start=start, end=start + len(find), line=SOURCE.count("\n", 0, start) + 1,
                  operator="test", find=find, replace=replace, number=number, **more)


MUTANTS = [mutant(1, "2 * n", "2 + n", constexpr=True), mutant(2, "sum += 1", "", statement=True),
           mutant(3, "twice(3)", "twice(4)"), mutant(4, "twice(3)", "7"),
           mutant(5, 'std::printf("%d\\n",\n              sum);', "return 1;", statement=True),
           mutant(6, "sum += 1", "sum = 40;", before=True)]


class Schemata(unittest.TestCase):
    def test_one_program_is_all_of_them(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            text = with_branches(SOURCE.encode(), [m for m in MUTANTS if m.number != 6])
            (folder / "x.cpp").write_bytes(text)
            (folder / "mutants.h").write_text(HEADER % {"size": 7})
            subprocess.run([os.environ.get("CXX", "c++"), "-std=c++20", "-include", folder / "mutants.h", "-o", folder / "x",
                            folder / "x.cpp"], check=True)

            def run(number, **more):
                return subprocess.run([folder / "x"], capture_output=True, text=True,
                                      env=scoring.environment(PLUMBLINE_MUTANT=str(number), **more))

            # Without a fault, and with each; the last one leaves before it prints.
            self.assertEqual([run(n).stdout.strip() for n in range(6)], ["7", "6", "6", "9", "8", ""])
            run(0, PLUMBLINE_MUTANT_TRACE=str(folder / "trace"))
            self.assertEqual((folder / "trace").read_bytes(), b"\0\1\1\1\1\1\0")

    def test_lines_keep_their_numbers(self):
        text = with_branches(SOURCE.encode(), MUTANTS[:5]).decode()
        self.assertEqual(text.count("\n"), SOURCE.count("\n"))

    def test_what_is_put_before_a_statement_leaves_it(self):
        text = with_branches(SOURCE.encode(), MUTANTS[5:]).decode()
        self.assertIn("if (PLUMBLINE_MUTANT(6)) { sum = 40; } sum += 1;", text)

    def test_places_that_overlap_are_refused(self):
        inner = mutant(7, "= twice(3)", "= 1")
        with self.assertRaises(ValueError):
            with_branches(SOURCE.encode(), [inner, MUTANTS[2]])


class Named(unittest.TestCase):
    def place(self, **place):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "x.cpp").write_text(SOURCE)
            return named.places_of({"id": "bug", "places": [{"file": "x.cpp", "replace": "0", **place}]}, folder)[0]

    def test_a_place_is_found_by_its_text(self):
        found = self.place(find="twice(3)")
        self.assertEqual((found.line, SOURCE[found.start:found.end], found.constexpr), (4, "twice(3)", False))
        self.assertTrue(self.place(find="2 * n").constexpr)

    def test_a_text_that_stands_twice_needs_a_context(self):
        with self.assertRaises(named.OutOfDate):
            self.place(find="sum")
        self.assertEqual(self.place(find="sum", within="sum += 1").line, 5)

    def test_a_text_that_has_gone_is_out_of_date(self):
        for place in ({"find": "thrice"}, {"find": "3", "within": "thrice(3)"}, {"find": "3", "file": "y.cpp"}):
            with self.assertRaises(named.OutOfDate):
                self.place(**place)


class Scoring(unittest.TestCase):
    def test_quick_tests_that_reach_the_place_come_first(self):
        test = lambda name, binary, seconds, reached, passed=True: scoring.Test(
            name, binary, name, "unit", seconds, passed, reached)
        tests = [test("slow", "a", 5, b"\0\1"), test("quick", "b", 0.01, b"\0\1"), test("elsewhere", "a", 0.01, b"\0\0"),
                 test("near", "a", 2, b"\0\1"), test("red", "a", 0.01, b"\0\1", passed=False)]
        groups = scoring.groups_for(1, tests, ["near"])
        self.assertEqual([[t.name for t in g] for g in groups], [["near"], ["quick"], ["slow"]])

    def test_an_equivalent_fault_is_no_survivor(self):
        def record(**more):
            return {"file": "f", "line": 1, "text": "line", "fault": "x", "killed": False, "tests": 3, "exhausted": True, "seconds": 1.0,
                    **more}

        seen, same, open_ = record(killed=True), record(pictures_differ=False), record(fault="y", pictures_differ=True)
        self.assertFalse(summary.is_equivalent(seen, set()))
        self.assertTrue(summary.is_equivalent(same, set()))
        self.assertFalse(summary.is_equivalent(open_, set()))
        self.assertTrue(summary.is_equivalent(open_, {("f", "line", "y")}))
        self.assertEqual(summary.set_row("set", [seen, same, open_], set())[1:5], ["3", "1", "1", "0.500"])

    def test_a_known_equivalent_is_a_line_that_stands_there_and_a_reason(self):
        for row in json.loads((tree.ROOT / "tests/mutants/equivalent.json").read_text()):
            lines = [line.strip() for line in (tree.ROOT / row["file"]).read_text().splitlines()]
            self.assertIn(row["line"], lines, f'{row["file"]}: a known equivalent of a line that has gone')
            self.assertGreater(len(row["why"]), 20, row)

    def test_wilsons_interval(self):
        self.assertEqual(summary.interval(8, 10), "0.490 … 0.943")
        self.assertEqual(summary.interval(10, 10), "0.722 … 1.000")


if __name__ == "__main__":
    unittest.main()
