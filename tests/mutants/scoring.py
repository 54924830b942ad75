"""Runs the gate's tests against faults, cheap ones first, until one of them fails."""

import concurrent.futures
import dataclasses
import hashlib
import json
import os
import pathlib
import re
import stat
import subprocess
import tempfile
import time

# The tests of a group run in one process and stop at the first that fails; a group's tests take about as long as each
# other when they run alone, in seconds.
GROUPS = (0.03, 0.1, 0.3, 1, 3, 10, float("inf"))


@dataclasses.dataclass
class Test:
    name: str
    binary: str
    filter: str
    label: str
    seconds: float = 0.0
    passed: bool = True
    reached: bytes = b""


def environment(**more):
    clean = {k: v for k, v in os.environ.items() if not k.startswith(("PLUMBLINE_", "GTEST_"))}
    return {**clean, **more}


def tests_of(build, labels):
    """The GoogleTest tests of a build folder that carry one of the labels."""
    shown = subprocess.run(["ctest", "--show-only=json-v1"], cwd=build, capture_output=True, text=True, check=True)
    result = []
    for test in json.loads(shown.stdout)["tests"]:
        label = next((p["value"] for p in test.get("properties", []) if p["name"] == "LABELS"), [""])[0]
        filters = [a for a in test.get("command", []) if a.startswith("--gtest_filter=")]
        if label in labels and filters:
            result.append(Test(test["name"], test["command"][0], filters[0].split("=", 1)[1], label))
    return result


def run_traced(command, folder):
    """(exit status, a byte per fault: whether its place was reached) of the clean program."""
    with tempfile.NamedTemporaryFile() as trace:
        run = subprocess.run(command, cwd=folder, capture_output=True, timeout=1200,
                             env=environment(PLUMBLINE_MUTANT_TRACE=trace.name))
        return run.returncode, pathlib.Path(trace.name).read_bytes()


def run_alone(test, folder):
    """Runs a test without a fault: how long it takes, whether it passes, which faults' places it reaches."""
    start = time.monotonic()
    status, test.reached = run_traced([test.binary, f"--gtest_filter={test.filter}"], folder)
    test.seconds, test.passed = time.monotonic() - start, status == 0
    return test


def learn(tests, folder, jobs):
    """`run_alone` for all of them."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(lambda test: run_alone(test, folder), tests))


def groups_for(number, tests, favoured):
    """The tests that reach a fault, in groups of one binary, the quickest first; before those, in groups of their own,
    the ones in `favoured`, which saw faults nearby."""
    reaching = [t for t in tests if t.passed and len(t.reached) > number and t.reached[number]]
    near = [t for name in favoured for t in reaching if t.name == name]
    groups = [[t] for t in near[:4]]
    groups.sort(key=lambda g: g[0].seconds)
    done = {t.name for group in groups for t in group}
    lower = 0.0
    for upper in GROUPS:
        here = {}
        for test in reaching:
            if lower <= test.seconds < upper and test.name not in done:
                here.setdefault(test.binary, []).append(test)
        groups += sorted(here.values(), key=lambda g: sum(t.seconds for t in g))
        lower = upper
    return groups


def cut(group, most):
    """Pieces of a group, so that one process does not outlast `most` seconds by much."""
    piece, seconds = [], 0.0
    for test in group:
        if piece and seconds + test.seconds > most:
            yield piece
            piece, seconds = [], 0.0
        piece.append(test)
        seconds += test.seconds
    if piece:
        yield piece


@dataclasses.dataclass
class Verdict:
    number: int
    killed: bool = False
    by: str = ""        # the test that fails
    label: str = ""
    how: str = ""       # "failed", "crashed", "ran too long"
    said: str = ""      # what the test printed about it, its first lines
    check: str = ""     # the kind of the check that fails, where one was recorded
    samples: int = 0
    cause: str = ""     # what the check named
    seconds: float = 0.0
    tests: int = 0      # how many reach the fault
    exhausted: bool = True  # no test that reaches it was left out


def run_group(number, group, folder):
    """(the test that failed, how, what was printed, what checks recorded), or None."""
    known = sum(t.seconds for t in group)
    if not stat.S_ISCHR(os.stat(os.devnull).st_mode):
        raise RuntimeError(f"a fault has put a file in the place of {os.devnull}: every later result would be wrong")
    with tempfile.TemporaryDirectory() as results:
        flags = pathlib.Path(results) / "flags"
        flags.write_text("--gtest_fail_fast\n--gtest_brief=0\n--gtest_filter=" + ":".join(t.filter for t in group) + "\n")
        log = pathlib.Path(results) / "log"
        with log.open("wb") as out:
            try:
                run = subprocess.run([group[0].binary, f"--gtest_flagfile={flags}"], cwd=folder, stdout=out,
                                     stderr=subprocess.STDOUT, timeout=30 + 10 * known,
                                     env=environment(PLUMBLINE_MUTANT=str(number), PLUMBLINE_RESULTS=results))
                how = "failed" if run.returncode == 1 else "crashed" if run.returncode else ""
            except subprocess.TimeoutExpired:
                how = "ran too long"
        if not how:
            return None
        text = log.read_bytes().decode(errors="replace")
        records = [json.loads(line) for path in pathlib.Path(results).glob("*.jsonl")
                   for line in path.read_text(errors="replace").splitlines() if line.startswith("{") and line.endswith("}")]
    # What fails says so; what crashes or hangs was the last to start.
    names = (re.findall(r"^\[  FAILED  \] (\S+?),? .*ms\)$", text, re.MULTILINE)[:1] or
             re.findall(r"^\[ RUN      \] (\S+)$", text, re.MULTILINE)[-1:])
    return next((t for t in group if t.filter in names), group[0]), how, text, records


def score(number, tests, folder, favoured, limit, most=20):
    """What the gate says of one fault. `limit`: seconds of tests after which no further group starts."""
    verdict = Verdict(number)
    start = time.monotonic()
    groups = groups_for(number, tests, favoured)
    verdict.tests = sum(map(len, groups))
    spent = 0.0
    for piece in (piece for group in groups for piece in cut(group, most)):
        cost = sum(t.seconds for t in piece)
        if spent + cost > limit:
            verdict.exhausted = False
            continue
        spent += cost
        found = run_group(number, piece, folder)
        if found:
            test, how, text, records = found
            verdict.killed, verdict.by, verdict.label, verdict.how = True, test.name, test.label, how
            verdict.said = failure_text(text)
            wrong = [r for r in records if r.get("verdict") != r.get("expected")]
            if wrong:
                first = min(wrong, key=lambda r: r.get("samples", 0))
                verdict.check, verdict.samples = first.get("check", ""), first.get("samples", 0)
                verdict.cause = next((r["diagnosis"] for r in wrong if r.get("diagnosis")), "")
            break
    verdict.seconds = time.monotonic() - start
    return verdict


def failure_text(text, lines=14):
    """The first failure that a test printed."""
    rows = text.splitlines()
    first = next((i for i, row in enumerate(rows) if "Failure" in row), max(0, len(rows) - lines))
    return "\n".join(rows[first:first + lines])[:2000]


def fingerprint(program, number, folder):
    """What the pictures of the covering array hash to, with a fault in place; "" where the program does not end well."""
    try:
        run = subprocess.run([program], cwd=folder, capture_output=True, timeout=300,
                             env=environment(PLUMBLINE_MUTANT=str(number)))
    except subprocess.TimeoutExpired:
        return "ran too long"
    return hashlib.sha256(run.stdout).hexdigest() if run.returncode == 0 else f"exit {run.returncode}"
