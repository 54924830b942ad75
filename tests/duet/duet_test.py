"""What `./run compare-runs` is built on: the driver with workers whose times are known, and the copies of revisions."""

import contextlib
import io
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import compare_runs
import count_parts
import lockstep
import revisions

PROGRAMS = pathlib.Path(os.environ["PLUMBLINE_DUET"])

# Says that a slice took 1 ms with a scatter of 0.1 %, `slow` per mille more in the part `twist`; nothing is really done.
WORKER = """#!/bin/sh
case $1 in
parts) printf 'twist\\nturn\\n' ;;
count) printf 'rays %d\\nresult 5\\n' @RAYS@ ;;
play)
  extra=0; [ "$2" = twist ] && extra=@SLOW@
  echo ready; i=$$
  while read -r line; do
    i=$(( (i * 1103515245 + 12345) % 2147483648 ))
    printf '0.%09d\\n' $(( (1000000 + i / 65536 / 8) * (1000 + extra) / 1000 ))
  done ;;
esac
"""


class Driver(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def worker(self, name, slow=0, rays=7, text=WORKER):
        path = self.folder / name
        path.write_text(text.replace("@SLOW@", str(slow)).replace("@RAYS@", str(rays)))
        path.chmod(0o755)
        return str(path)

    def compare(self, a, b, *more):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            code = compare_runs.main([a, b, "--workers", "--judge", str(PROGRAMS / "plumbline_duet_judge"), *more])
        return code, out.getvalue()

    def test_the_part_that_is_slower_is_named_and_no_other(self):
        log = self.folder / "duets.jsonl"
        code, out = self.compare(self.worker("a"), self.worker("b", slow=30), "--json", str(log))
        self.assertEqual((code, out.splitlines()[-1]), (1, "slower: twist"), out)
        lines = [json.loads(line) for line in log.read_text().splitlines()]
        self.assertEqual([line["format"] for line in lines], ["plumbline.environment/1"] + 2 * ["plumbline.duet/1"])
        twist, turn = lines[1:]
        self.assertAlmostEqual(twist["ratio"], 1.03, delta=0.003)
        self.assertTrue(twist["low"] < twist["ratio"] < twist["high"])
        self.assertTrue(0.99 < turn["low"] < turn["high"] < 1.01)
        self.assertEqual(len(twist["a_seconds"]), lockstep.SLICES * compare_runs.LAUNCHES)

    def test_faster_is_no_failure(self):
        code, out = self.compare(self.worker("a", slow=30), self.worker("b"), "--only", "twist")
        self.assertEqual(code, 0)
        self.assertIn("faster", out)
        self.assertNotIn("turn", out)

    def test_what_is_counted_differs_by_one(self):
        code, out = self.compare(self.worker("a", rays=100), self.worker("b", rays=101), "--counters")
        self.assertEqual(code, 0)
        self.assertIn("rays 100 → 101 (+1.00 %)", out)
        self.assertIn("not timed", out)

    def test_a_worker_that_dies_is_named(self):
        dead = self.worker("dead", text=WORKER.replace("read -r line", "exit 3"))
        with self.assertRaisesRegex(lockstep.WorkerError, "dead ended with 3"):
            self.compare(self.worker("a"), dead)

    def test_a_part_that_there_is_not_is_refused(self):
        with self.assertRaisesRegex(lockstep.WorkerError, "'shout'; there are: twist, turn"):
            self.compare(self.worker("a"), self.worker("b"), "--only", "shout")


class Player:
    """A side that notes what it is told; its slice takes as long as its core is slow."""

    def __init__(self, log, name):
        self.log, self.name, self.core = log, name, None

    def move_to(self, core):
        self.core = core

    def go(self, units):
        self.log.append(("go", self.name))

    def answer(self):
        self.log.append(("done", self.name))
        return f"{self.core}"

    def time(self, units):
        self.go(units)
        return float(len(self.log)) + 0 * len(self.answer())


class Slices(unittest.TestCase):
    def play(self, cores, swapped):
        log = []
        return lockstep.play_slice([Player(log, "a"), Player(log, "b")], 1, cores, swapped), log

    def test_sides_start_together_and_exchange_their_cores(self):
        seconds, log = self.play([4, 9], False)
        self.assertEqual((seconds, log), ([4, 9], [("go", "a"), ("go", "b"), ("done", "a"), ("done", "b")]))
        seconds, log = self.play([4, 9], True)
        self.assertEqual((seconds, log[:2]), ([9, 4], [("go", "b"), ("go", "a")]))

    def test_on_one_core_they_take_turns_and_exchange_who_is_first(self):
        seconds, log = self.play([4], False)
        self.assertEqual(log, [("go", "a"), ("done", "a"), ("go", "b"), ("done", "b")])
        self.assertLess(seconds[0], seconds[1])
        seconds, log = self.play([4], True)
        self.assertEqual(log[0], ("go", "b"))
        self.assertLess(seconds[1], seconds[0])


class Revisions(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name) / "tree"
        self.root.mkdir()
        self.git("init", "-q")
        (self.root / ".gitignore").write_text("ignored\n")
        (self.root / "x.cpp").write_text("int x;\n")
        self.git("add", ".")
        self.git("commit", "-q", "-m", "x")

    def git(self, *arguments):
        subprocess.run(["git", "-c", "user.name=n", "-c", "user.email=n@example.org", *arguments], cwd=self.root, check=True)

    def test_a_revision_that_there_is_not_is_refused(self):
        for name in ("no-such-branch", "--all", "HEAD:x.cpp"):
            with self.assertRaisesRegex(revisions.RevisionError, "is no revision"):
                revisions.full_name(name, self.root)

    def test_the_tree_as_it_is_has_what_is_not_committed(self):
        self.assertEqual(revisions.full_name(".", self.root), revisions.full_name("HEAD", self.root))
        (self.root / "x.cpp").write_text("int y;\n")
        (self.root / "new.h").write_text("")
        (self.root / "ignored").write_text("")
        self.assertEqual(revisions.full_name(".", self.root), revisions.full_name("HEAD", self.root) + "+")
        self.assertEqual(revisions.files_of("HEAD", self.root)["x.cpp"], (b"int x;\n", False))
        work = revisions.files_of(".", self.root)
        self.assertEqual((set(work), work["x.cpp"]), ({".gitignore", "x.cpp", "new.h"}, (b"int y;\n", False)))

    def test_a_copy_is_written_only_where_it_differs(self):
        copy = self.root.parent / "copy"
        revisions.bring_to(copy, {"old": (b"1", False), "kept": (b"2", True)})
        os.utime(copy / "kept", (1, 1))
        revisions.bring_to(copy, {"kept": (b"2", True), "sub/new": (b"3", False)})
        self.assertEqual({str(p.relative_to(copy)) for p in copy.rglob("*") if p.is_file()}, {"kept", "sub/new"})
        self.assertEqual((copy / "kept").stat().st_mtime, 1)
        self.assertTrue(os.access(copy / "kept", os.X_OK))


class CountedParts(unittest.TestCase):
    def test_every_counter_of_every_part_becomes_a_record_of_the_history(self):
        with tempfile.TemporaryDirectory() as folder:
            worker, log = pathlib.Path(folder) / "worker", pathlib.Path(folder) / "new/counters.jsonl"
            worker.write_text(WORKER.replace("@RAYS@", "7"))
            worker.chmod(0o755)
            self.assertEqual(count_parts.main([str(log)], [str(worker)]), 0)
            records = [json.loads(line) for line in log.read_text().splitlines()]
            self.assertEqual(records, [{"format": "plumbline.counter/1", "name": f"duet/{part}/rays", "unit": "rays", "value": 7}
                                       for part in ("twist", "turn")])
            worker.write_text("#!/bin/sh\necho heap_bytes 5; echo heap_blocks 2\n")
            self.assertEqual([r["name"] for r in count_parts.records([str(worker)], ["image-file"])], ["duet/image-file/heap_blocks"])
            worker.write_text("#!/bin/sh\nexit 1\n")
            with self.assertRaises(lockstep.WorkerError):
                count_parts.main([str(log)], [str(worker)])


class RealWorker(unittest.TestCase):
    WORKER = str(PROGRAMS / "plumbline_duet_worker")

    def test_what_is_counted_is_the_same_twice(self):
        for part in ("render/mis", "bsdf-evaluate/lambertian", "verify/mean"):
            counted = compare_runs.counters([self.WORKER], part)
            self.assertEqual(counted, compare_runs.counters([self.WORKER], part))
            self.assertNotEqual(counted["result"], 0)
        self.assertGreater(counted["samples"], 1000)

    def test_a_slice_takes_some_time(self):
        worker = lockstep.Worker([self.WORKER], "sampler/independent")
        self.addCleanup(worker.end)
        self.assertGreater(worker.time(100), 0)

    def test_what_is_no_order_is_refused(self):
        for words, order, said in ((["play", "sampler/sobol"], "run 3\n", "expected 'go N', got 'run 3'"),
                                   (["play", "sampler/sobol"], "go 0\n", "expected 'go N', got 'go 0'"),
                                   (["play", "nothing"], "", "no part is named 'nothing'"), ([], "", "usage")):
            run = subprocess.run([self.WORKER, *words], input=order, capture_output=True, text=True)
            self.assertEqual(run.returncode, 2)
            self.assertIn(said, run.stderr)


class SameCode(unittest.TestCase):
    def test_symbols_are_no_code(self):
        judge = PROGRAMS / "plumbline_duet_judge"
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / "copy"
            subprocess.run(["strip", "--strip-all", "-o", copy, judge], check=True)
            self.assertTrue(revisions.same_code(judge, copy))
            shutil.copy(PROGRAMS / "plumbline_duet_worker", copy)
            self.assertFalse(revisions.same_code(judge, copy))


if __name__ == "__main__":
    unittest.main()
