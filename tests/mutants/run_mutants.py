#!/usr/bin/env python3
"""Puts known bugs into a copy of the tree, one at a time, and shows which tests see each.

usage: run_mutants.py [--only ID] [--label LABEL ...]

A mutant that no test notices, or whose text is not found exactly once, is a failure: exit code 1.
"""

import argparse
import json
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK = ROOT / "build" / "mutants"
PARTS = ["CMakeLists.txt", "CMakePresets.json", "cmake", "verify", "analytic", "renderer", "reports",
         "tools", "tests"]


def copy_tree():
    """A copy of the sources under build/, refreshed so that unchanged files keep their times."""
    source = WORK / "src"
    source.mkdir(parents=True, exist_ok=True)
    for part in PARTS:
        if (ROOT / part).is_dir():
            subprocess.run(["cp", "-r", "--update", "--preserve=timestamps", "-T",
                            ROOT / part, source / part], check=True)
        else:
            shutil.copy2(ROOT / part, source / part)
    return source


def build(build_folder):
    return subprocess.run(["cmake", "--build", build_folder], capture_output=True, text=True)


def failing_tests(build_folder, labels):
    run = subprocess.run(["ctest", "-j2", "-L", "|".join(labels)], cwd=build_folder,
                         capture_output=True, text=True)
    return re.findall(r"^\s*\d+ - (\S+) \(", run.stdout, re.MULTILINE)


def try_mutant(mutant, source, build_folder, labels):
    """The tests that fail with the mutant in place, or a string that says what went wrong."""
    path = source / mutant["file"]
    original = path.read_text()
    found = original.count(mutant["find"])
    if found != 1:
        return f"its text is found {found} times in {mutant['file']}: bring the mutant up to date"
    try:
        path.write_text(original.replace(mutant["find"], mutant["replace"]))
        built = build(build_folder)
        if built.returncode != 0:
            return "does not compile:\n" + built.stdout[-2000:]
        return failing_tests(build_folder, labels)
    finally:
        path.write_text(original)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--only", help="a regular expression that the ids must match")
    parser.add_argument("--label", nargs="*",
                        default=["unit", "contract", "chi2", "analytic", "variance", "stability"])
    arguments = parser.parse_args()

    source, build_folder = copy_tree(), WORK / "build"
    # Warnings are no errors here: a mutant may leave a variable without use.
    subprocess.run(["cmake", "-S", source, "-B", build_folder, "-G", "Ninja",
                    "-DCMAKE_BUILD_TYPE=Release", "-DPLUMBLINE_BENCH=OFF"], check=True,
                   stdout=subprocess.DEVNULL)
    clean = build(build_folder)
    if clean.returncode != 0:
        sys.exit("the tree does not build without mutants:\n" + clean.stdout[-4000:])

    missed = 0
    for mutant in json.loads((pathlib.Path(__file__).parent / "mutants.json").read_text()):
        if arguments.only and not re.search(arguments.only, mutant["id"]):
            continue
        outcome = try_mutant(mutant, source, build_folder, arguments.label)
        caught = isinstance(outcome, list) and outcome
        missed += not caught
        print(f"{'caught' if caught else 'MISSED'}  {mutant['id']}  ({mutant['like']})")
        for line in outcome if isinstance(outcome, list) else [outcome]:
            print(f"        {line}")
        sys.stdout.flush()
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()
