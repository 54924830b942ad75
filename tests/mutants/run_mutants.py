#!/usr/bin/env python3
"""Puts known bugs into a copy of the tree, one at a time, and shows which tests see each.

usage: run_mutants.py [--only REGEX] [--label LABEL ...] [--test REGEX]
                       [--target TARGET ...] [--list]

A mutant that no test notices, or whose text is not found exactly once, is a failure: exit code 1.
Tests that already fail without mutants are named and see nothing.
"""

import argparse
import collections
import filecmp
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
WORK = ROOT / "build" / "mutants"
PARTS = ["CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "cmake", "docs", "verify", "analytic",
         "renderer", "reports", "tools", "tests", "bench/scenes"]


def files_of(folder):
    return {path.relative_to(folder) for part in PARTS
            for path in [folder / part, *(folder / part).rglob("*")] if path.is_file()}


def copy_tree():
    """A copy of the sources under build/. Only what differs is written, so that nothing else is built again; by what
    stands in it, not by its time: a run that was killed leaves a mutant behind."""
    source = WORK / "src"
    wanted = files_of(ROOT)
    for name in files_of(source) - wanted:
        (source / name).unlink()
    for name in wanted:
        if not (source / name).exists() or not filecmp.cmp(ROOT / name, source / name, shallow=False):
            (source / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, source / name)
    return source


def build(build_folder, targets):
    return subprocess.run(["cmake", "--build", build_folder, *(["--target", *targets] if targets else [])],
                          capture_output=True, text=True)


def failing_tests(build_folder, arguments, results):
    """Names of the tests that fail; what their checks say is left in the folder `results`."""
    shutil.rmtree(results, ignore_errors=True)
    which = ["-L", "|".join(arguments.label), "-R", arguments.test]
    run = subprocess.run(["ctest", f"-j{os.cpu_count()}", *which], cwd=build_folder, capture_output=True, text=True,
                         env={**os.environ, "PLUMBLINE_RESULTS": str(results)})
    if "No tests were found" in run.stdout + run.stderr:
        sys.exit(f"no test has a label of {arguments.label} and a name like {arguments.test}")
    failed = re.findall(r"^\s*\d+ - (.+) \([A-Za-z*]", run.stdout, re.MULTILINE)
    return {name for name in failed if not name.endswith("_NOT_BUILT")}


def unexpected_checks(results):
    """Per kind of check: how many gave another verdict than they should, and the quickest of them."""
    kinds = collections.defaultdict(list)
    log = results / "checks.jsonl"
    for line in log.read_text().splitlines() if log.exists() else []:
        if not line:  # what a log gets where one process looks while another writes
            continue
        record = json.loads(line)
        if record.get("verdict") != record.get("expected"):
            kinds[record["check"]].append((record["samples"], record["subject"]))
    return [f"{kind}: {len(found)} checks, the quickest after {min(found)[0]:,} samples: {min(found)[1]}"
            for kind, found in sorted(kinds.items())]


def try_mutant(mutant, source, build_folder, arguments, known):
    """The tests that fail with the mutant in place and what their checks say, or what went wrong."""
    path = source / mutant["file"]
    original = path.read_text()
    changed = original
    for change in mutant.get("changes", [mutant]):
        found = original.count(change["find"])
        if found != 1:
            return [], [f"its text is found {found} times in {mutant['file']}: bring the mutant up to date",
                        change["find"]]
        changed = changed.replace(change["find"], change["replace"])
    try:
        path.write_text(changed)
        built = build(build_folder, arguments.target)
        if built.returncode != 0:
            return [], ["does not compile:\n" + built.stdout[-2000:]]
        tests = sorted(failing_tests(build_folder, arguments, WORK / "results") - known)
        return tests, tests + unexpected_checks(WORK / "results")
    finally:
        path.write_text(original)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--only", help="a regular expression that the ids, or the bugs they are like, must match")
    parser.add_argument("--label", nargs="*", help="of the tests to run",
                        default=["unit", "contract", "chi2", "analytic", "variance", "stability"])
    parser.add_argument("--test", default=".", help="a regular expression that the names of the tests must match")
    parser.add_argument("--target", nargs="*", default=[], help="tests to build; all unless named")
    parser.add_argument("--list", action="store_true", help="name the mutants and stop")
    arguments = parser.parse_args()

    mutants = [m for m in json.loads((HERE / "mutants.json").read_text())
               if not arguments.only or re.search(arguments.only, m["id"] + " " + m["like"])]
    if not mutants:
        sys.exit(f"no mutant matches {arguments.only}")
    if arguments.list:
        for mutant in mutants:
            print(f"{mutant['id']}  ({mutant['like']})")
        return

    source, build_folder = copy_tree(), WORK / "build"
    # Warnings are no errors here: a mutant may leave a variable without use.
    subprocess.run(["cmake", "-S", source, "-B", build_folder, "-G", "Ninja",
                    "-DCMAKE_BUILD_TYPE=Release", "-DPLUMBLINE_BENCH=OFF"], check=True,
                   stdout=subprocess.DEVNULL)
    clean = build(build_folder, arguments.target)
    if clean.returncode != 0:
        sys.exit("the tree does not build without mutants:\n" + clean.stdout[-4000:])
    known = failing_tests(build_folder, arguments, WORK / "results")
    for name in sorted(known):
        print(f"fails without a mutant: {name}")

    missed = 0
    for mutant in mutants:
        caught_by, report = try_mutant(mutant, source, build_folder, arguments, known)
        missed += not caught_by
        print(f"{'caught' if caught_by else 'MISSED'}  {mutant['id']}  ({mutant['like']})")
        for line in report:
            print(f"        {line}")
        sys.stdout.flush()
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()
