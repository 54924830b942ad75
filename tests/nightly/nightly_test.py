"""A night whose parts are a second long: what fails, hangs, is missing or does not fit costs no other part."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock
import xml.etree.ElementTree as xml

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/nightly"))

import nightly  # noqa: E402
import parts  # noqa: E402
import plan  # noqa: E402
import sources  # noqa: E402
from parts import Effort, Part  # noqa: E402

SECOND = 1 / 60  # in minutes
CHECK = {"format": "plumbline.check/1", "check": "mean", "subject": "a/b", "verdict": "pass", "expected": "pass",
         "estimate": 1, "reference": 1, "tolerance": 1, "bound": 1, "detectable": 1, "p_value": 0.5, "interval_low": 0,
         "interval_high": 2, "samples": 10, "seconds": 1, "leaned_on": "", "reason": "", "diagnosis": "", "seed": 1,
         "replay": "", "figures": []}
SEED_RUN = {"format": "plumbline.seed_run/1", "seed": 5, "commit": "abc", "time": "2024-03-01T12:00:00Z", "tests": 3,
            "failures": ["A.B"]}


def shell(name, script, minutes=10 * SECOND):
    return Part(name, "", (Effort("", minutes, ("sh", "-c", script)),))


def fake_parts(_):
    """The third starts a process of its own; the braces of a record are no word of the night's."""
    def record(value):
        return json.dumps(value).replace("{", "{{").replace("}", "}}")

    return (
        shell("good", f"echo '{record(CHECK)}' >>build/release/results/checks/checks.jsonl; echo {{seed}}"),
        shell("bad", f"echo before; echo '{record(SEED_RUN)}' >>build/seeds.jsonl; echo after >&2; exit 3"),
        shell("hangs", "sleep 60 & echo $! >build/sleeper; wait", SECOND / 8),
        Part("missing", "", (Effort("", SECOND, ("build/no-such-program",)),)),
        shell("long", "true", 600),
        shell("last", "test -z \"$PLUMBLINE_RESULTS\""),
    )


def is_running(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().split()[2] != "Z"
    except FileNotFoundError:
        return False


class Night(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.here = os.getcwd()
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = pathlib.Path(cls.folder.name)
        (cls.root / "build/release/results").mkdir(parents=True)
        (cls.root / "build/release/results/old.jsonl").write_text(json.dumps(CHECK) + "\n")
        (cls.root / "build/release/plumbline").symlink_to(os.environ["PLUMBLINE"])
        (cls.root / "build/seeds.jsonl").write_text(json.dumps(SEED_RUN | {"seed": 4}) + "\n")
        words = {"GITHUB_STEP_SUMMARY": str(cls.root / "page.md"), "PLUMBLINE_SEED": "77", "PLUMBLINE_RESULTS": "/nowhere"}
        with unittest.mock.patch.dict(os.environ, words), open(os.devnull, "w") as nothing, \
                unittest.mock.patch("sys.stderr", nothing):
            cls.exit_code = nightly.main(["--hours", "1", "--history", "h.db"], fake_parts, cls.root)

    @classmethod
    def tearDownClass(cls):
        os.chdir(cls.here)
        cls.folder.cleanup()

    def history(self, *words):
        return subprocess.run([os.environ["PLUMBLINE"], "history", *words, "--history", "h.db"], cwd=self.root,
                              capture_output=True, text=True, check=True).stdout

    def rows(self, table):
        return [line.split(",")[-4:] for line in self.history("export", "--csv", "--table", table).splitlines()[1:]]

    def test_fails_where_a_part_fails(self):
        self.assertEqual(self.exit_code, 1)

    def test_every_part_has_its_outcome_whatever_became_of_the_others(self):
        shown = self.history("show")
        for name, status in (("good", "passed"), ("bad", "failed"), ("hangs", "timed out"), ("missing", "failed"),
                             ("long", "skipped"), ("last", "passed")):
            self.assertRegex(shown, rf"\n  {name} +{status} ")
        self.assertIn("exit code 3; build/nightly/bad.log", shown)
        self.assertIn("cannot be run: No such file or directory", shown)
        self.assertIn("takes 10 h 00 min, ", shown)

    def test_what_a_part_prints_is_kept(self):
        self.assertEqual((self.root / "build/nightly/bad.log").read_text(), "before\nafter\n")
        self.assertEqual((self.root / "build/nightly/good.log").read_text(), "77\n")

    def test_what_hangs_is_ended_with_all_that_it_started(self):
        pid = (self.root / "build/sleeper").read_text().strip()
        end = time.monotonic() + 20
        while is_running(pid) and time.monotonic() < end:
            time.sleep(0.01)
        self.assertFalse(is_running(pid))

    def test_only_what_this_night_measured_is_appended(self):
        self.assertEqual(len(self.rows("checks")), 1)
        self.assertEqual([row[0] for row in self.rows("gate-runs")], ["5"])
        self.assertIn(sources.hash_of(), self.history("show"))

    def test_writes_junit_and_the_page_of_the_job(self):
        suite = xml.parse(self.root / "build/nightly/junit/parts.xml").getroot()
        self.assertEqual((suite.get("tests"), suite.get("failures"), suite.get("skipped")), ("6", "3", "1"))
        cases = {case.get("name"): [child.tag for child in case] for case in suite}
        self.assertEqual(cases, {"good": [], "bad": ["failure"], "hangs": ["failure"], "missing": ["failure"],
                                 "long": ["skipped"], "last": []})
        page = (self.root / "page.md").read_text()
        self.assertIn("| hangs | **timed out** |", page)
        self.assertIn("- seed 5: A.B", page)
        self.assertIn("## Over all nightly runs, 1 by now", page)
        record = json.loads((self.root / "build/release/results/history.json").read_text())
        self.assertEqual(record["nights"][0]["failed_parts"], 3)

    def test_duets_are_of_the_last_accepted_night(self):
        """Of five nights: accepted, red, accepted but for its duets, one that ran nothing, and one that looks back."""
        with tempfile.TemporaryDirectory() as folder, open(os.devnull, "w") as nothing, \
                unittest.mock.patch("sys.stderr", nothing):
            root = pathlib.Path(folder)
            (root / "build/release").mkdir(parents=True)
            (root / "build/release/plumbline").symlink_to(os.environ["PLUMBLINE"])
            asked = shell("looks", "echo '{accepted}' >build/asked")
            asked = Part("looks", "", (Effort("", SECOND, (*asked.efforts[0].command, "{accepted}")),))
            nights = ((asked, shell("gate", "true")), (shell("gate", "false"),), (shell("gate", "true"), shell("duets", "false")),
                      (shell("gate", "true", 600),))
            for made in nights:
                nightly.main(["--hours", "1", "--history", "h.db"], lambda _: made, root)
            self.assertFalse((root / "build/asked").exists(), "there was no night before the first")
            rows = subprocess.run([os.environ["PLUMBLINE"], "history", "export", "--csv", "--table", "parts", "--history", "h.db"],
                                  cwd=root, capture_output=True, text=True, check=True).stdout
            self.assertIn("no night was accepted before this one", rows)
            # All nights are of one build; what is asked for here is which of them.
            changed = rows.splitlines(keepends=True)
            with unittest.mock.patch("subprocess.run") as run:
                run.return_value.stdout = "".join(
                    [changed[0], *(",".join([c[0], c[1], c[2], f"night {c[0]}", *c[4:]]) for c in (row.split(",") for row in changed[1:]))])
                self.assertEqual(nightly.accepted_commit("h.db"), "night 3")
            self.assertEqual(nightly.main(["--hours", "1", "--history", "h.db"], lambda _: (asked,), root), 0)
            self.assertRegex((root / "build/asked").read_text(), r"^\S+\n$")

    def test_a_night_of_which_nothing_fits_is_no_success(self):
        with tempfile.TemporaryDirectory() as folder, open(os.devnull, "w") as nothing, \
                unittest.mock.patch("sys.stderr", nothing):
            root = pathlib.Path(folder)
            (root / "build/release").mkdir(parents=True)
            (root / "build/release/plumbline").symlink_to(os.environ["PLUMBLINE"])
            words = ["--hours", "0.1", "--history", "h.db"]
            self.assertEqual(nightly.main(words, lambda _: (shell("long", "true", 60),), root), 1)
            self.assertEqual(nightly.main(words, lambda _: (shell("short", "true"),), root), 0)


class Plan(unittest.TestCase):
    def chosen(self, hours, *efforts):
        made = [Part(str(i), "", tuple(Effort(str(m), m, ()) for m in minutes)) for i, minutes in enumerate(efforts)]
        return [p.effort and p.effort.minutes for p in plan.share_out(made, hours)]

    def test_takes_the_least_of_all_before_more_of_any(self):
        self.assertEqual(self.chosen(1, (10, 40), (10, 20), (20,)), [10, 20, 20])
        self.assertEqual(self.chosen(1.2, (10, 29), (10, 20), (20,)), [29, 20, 20])

    def test_leaves_out_what_does_not_fit_and_goes_on(self):
        self.assertEqual(self.chosen(0.5, (10, 20), (30,), (15,)), [10, None, 15])

    def test_takes_all_without_a_limit(self):
        self.assertEqual(self.chosen(None, (10, 400), (30,)), [400, 30])

    def test_never_plans_more_than_it_has(self):
        for hours in (0.1, 0.5, 1, 2, 3, 5, 8, 24):
            self.assertLessEqual(plan.total(plan.share_out(parts.parts("x"), hours)), max(60 * hours, plan.KEPT))

    def test_is_what_the_table_of_the_documentation_says(self):
        rows = re.findall(r"^\| `(\w+)` \| (.+?) \| .* \|$", (ROOT / "docs/nights.md").read_text(), re.M)
        said = [(name, [int(m) for m in re.findall(r"(\d+) min", takes)]) for name, takes in rows]
        self.assertEqual(said, [(p.name, [e.minutes for e in p.efforts]) for p in parts.parts("x")])


class Level(unittest.TestCase):
    def test_every_run_of_checks_is_held_to_that_of_the_night(self):
        nights = {p.name: {e.command[1] for e in p.efforts if e.command[0] == "env"} for p in parts.parts("x")}
        self.assertEqual({name: words for name, words in nights.items() if words}, {
            "gate": {"PLUMBLINE_NIGHTLY=gate"}, "suites": {"PLUMBLINE_NIGHTLY=1"}, "calibration": {"PLUMBLINE_NIGHTLY=1"}})


class Sources(unittest.TestCase):
    def test_hash_follows_names_and_contents_of_code_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            hashes = []
            for name, text in (("verify/a.cpp", "1"), ("verify/a.cpp", "2"), ("renderer/b.h", "2"), ("analytic/s.xml", "")):
                (root / name).parent.mkdir(exist_ok=True)
                (root / name).write_text(text)
                hashes.append(sources.hash_of(root))
            self.assertEqual(len(set(hashes)), 4)
            (root / "verify/README.md").write_text("words")
            (root / "tests").mkdir()
            (root / "tests/c.cpp").write_text("3")
            self.assertEqual(sources.hash_of(root), hashes[-1])


if __name__ == "__main__":
    unittest.main()
