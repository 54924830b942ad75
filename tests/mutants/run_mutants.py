#!/usr/bin/python3
"""Scores the gate: which faults do its tests see, how soon, by which check, and what do they name?

All faults are branches of one build (schemata.py) of a copy of the tree: bugs with a name (named.json) and, where asked
for, small mechanical faults (mechanical.py) of the renderer and of verify. The results stand in
build/mutants/results.jsonl, a line for each fault; a run that is repeated goes on where it was.
"""

import argparse
import concurrent.futures
import dataclasses
import functools
import hashlib
import json
import os
import pathlib
import random
import subprocess
import sys
import threading

import named
import scoring
import summary
import tree
from schemata import Mutant

HERE = pathlib.Path(__file__).resolve().parent
EQUIVALENT = HERE / "equivalent.json"
PARTS = ("renderer", "verify")
LABELS = ("unit", "contract", "stability", "corpus", "chi2", "analytic", "variance", "reports", "calibration")


def parse():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--only", help="a fault's name or number; several with commas")
    parser.add_argument("--list", action="store_true", help="name the faults and stop")
    parser.add_argument("--check", action="store_true", help="only say whether every named bug still has its place")
    parser.add_argument("--renderer", type=int, default=0, metavar="N", help="mechanical faults of renderer/")
    parser.add_argument("--verify", type=int, default=0, metavar="N", help="mechanical faults of verify/")
    parser.add_argument("--seed", help="for the choice of mechanical faults; the commit's hash unless given")
    parser.add_argument("--limit", type=float, default=120, help="seconds of tests for one fault")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    return parser.parse_args()


def commit():
    return subprocess.run(["git", "rev-parse", "HEAD"], cwd=tree.ROOT, capture_output=True, text=True).stdout.strip()


def named_mutants():
    result = []
    for number, bug in enumerate(named.bugs(), 1):
        for mutant in named.places_of(bug, tree.ROOT):
            result.append(dataclasses.replace(mutant, number=number))
    return result


def known_equivalents():
    """What a person has proved to change nothing: (file, text of the line, fault)."""
    if not EQUIVALENT.exists():
        return set()
    return {(e["file"], e["line"], e["fault"]) for e in json.loads(EQUIVALENT.read_text())}


@functools.cache
def lines_of(path):
    return path.read_text().splitlines()


def where(mutant):
    """The file of a fault and the text of its line: a line's number changes with what stands above it."""
    path = pathlib.Path(mutant.file)
    return str(path.relative_to(tree.ROOT)), lines_of(path)[mutant.line - 1].strip()


def mechanical_mutants(arguments, after, taken):
    """The chosen faults of both parts, none over a named bug's place, none known to change nothing."""
    import mechanical
    skip, result = known_equivalents(), []
    commands = tree.alone(tree.ROOT, tree.PLAIN)
    for part, count in zip(PARTS, (arguments.renderer, arguments.verify)):
        if not count:
            continue
        free = [m for m in mechanical.all_candidates(commands, tree.ROOT, [part])
                if (*where(m), m.key()) not in skip
                and all(m.file != t.file or m.end <= t.start or t.end <= m.start for t in taken)]
        result += mechanical.choose(free, count, f"{arguments.seed or commit()} {part}", tree.ROOT)
    return [dataclasses.replace(m, number=after + i) for i, m in enumerate(result, 1)]


def choice_stamp(arguments):
    """What the choice of faults depends on: the sources, the lists of bugs and equivalents, and what is asked for."""
    stamp = hashlib.sha256(f"{arguments.renderer} {arguments.verify} {arguments.seed or commit()}".encode())
    files = [path for part in PARTS for path in (tree.ROOT / part).rglob("*") if path.suffix in (".h", ".cpp")]
    for path in [*sorted(files), named.LIST, *([EQUIVALENT] if EQUIVALENT.exists() else [])]:
        stamp.update(path.read_bytes())
    return stamp.hexdigest()


def chosen_faults(arguments):
    """Those of the last run where nothing has changed since: finding the mechanical ones takes minutes."""
    kept, stamp = tree.WORK / "chosen.json", choice_stamp(arguments)
    if kept.exists():
        data = json.loads(kept.read_text())
        if data["stamp"] == stamp:
            return [Mutant(**m) for m in data["faults"]], True
    chosen = named_mutants()
    if arguments.renderer or arguments.verify:
        chosen += mechanical_mutants(arguments, len(named.bugs()), chosen)
    return chosen, False


def prepare(arguments):
    """The faults that compile; the copy with them is built."""
    chosen, compiled = chosen_faults(arguments)
    while True:
        tree.write_copy(chosen)
        wrong, output = set(), ""
        if not compiled and (arguments.renderer or arguments.verify):
            wrong, output = tree.not_valid(chosen, PARTS)
        if not wrong:
            output = tree.build(arguments.jobs)
            wrong = tree.blamed(output, chosen)
            if not output:
                break
            if not wrong:
                sys.exit("the copy does not build, and no fault is to blame:\n" + output[-6000:])
        if any(number <= len(named.bugs()) for number in wrong):
            sys.exit(f"a named bug does not compile: {sorted(wrong)[0]}\n" + output[-6000:])
        print(f"{len(wrong)} mechanical faults do not compile and are left out", flush=True)
        chosen = [m for m in chosen if m.number not in wrong]
    (tree.WORK / "chosen.json").write_text(json.dumps(
        {"stamp": choice_stamp(arguments), "faults": [dataclasses.asdict(m) for m in chosen]}))
    return chosen


def stamp_of(binary, mutants):
    """What the tests of a binary depend on: itself, and what the faults' numbers mean."""
    stat = os.stat(binary)
    meaning = hashlib.sha256(repr([(m.number, m.file, m.key()) for m in mutants]).encode()).hexdigest()
    return f"{stat.st_size} {stat.st_mtime_ns} {meaning}"


def learned_tests(mutants, jobs):
    """The gate's tests with the places they reach; of a binary that has not changed since, as an earlier run saw it."""
    tests = scoring.tests_of(tree.BUILD, LABELS)
    stamps = {binary: stamp_of(binary, mutants) for binary in {t.binary for t in tests}}
    kept, known = tree.WORK / "learned.json", {}
    if kept.exists():
        for record in json.loads(kept.read_text()):
            known[record["test"]["name"], record["stamp"]] = record["test"]
    same = [known.get((t.name, stamps[t.binary])) for t in tests]
    fresh = [t for t, record in zip(tests, same) if record is None]
    tests = [scoring.Test(**{**record, "reached": bytes.fromhex(record["reached"])}) for record in same if record]
    if not fresh:
        return tests
    print(f"running {len(fresh)} tests without a fault", flush=True)
    tests += scoring.learn(fresh, tree.SOURCE, jobs)
    kept.write_text(json.dumps([{"stamp": stamps[t.binary], "test": {**dataclasses.asdict(t), "reached": t.reached.hex()}}
                                for t in tests]))
    return tests


def describe(mutants, bugs):
    """What a line of the results says of a fault before it is scored."""
    first = mutants[0]
    file, text = where(first)
    record = {"number": first.number, "file": file, "line": first.line, "text": text}
    if first.number <= len(bugs):
        bug = bugs[first.number - 1]
        return {**record, "name": bug["id"], "like": bug["like"], "part": bug["part"], "changes": bug["changes"]}
    return {**record, "fault": first.key()}


def score_all(faults, tests, arguments, results):
    done = {}
    if results.exists() and results.stat().st_mtime > (tree.WORK / "learned.json").stat().st_mtime:
        for line in results.read_text().splitlines():
            record = json.loads(line)
            if record["killed"] or record["exhausted"] or record.get("limit", 0) >= arguments.limit:
                done[record["number"]] = record
    else:
        results.unlink(missing_ok=True)
    favoured, lock = {}, threading.Lock()

    def one(fault):
        record = fault
        with lock:
            near = sorted(favoured.get(record["file"], {}).items(), key=lambda item: -item[1])
        verdict = scoring.score(record["number"], tests, tree.SOURCE, [name for name, _ in near], arguments.limit)
        if not verdict.killed and pictured[record["number"]]:
            record = {**record, "pictures_differ": scoring.fingerprint(program, record["number"], tree.SOURCE) != clean}
        record = {**record, **dataclasses.asdict(verdict), "limit": arguments.limit}
        with lock:
            if verdict.killed:
                counts = favoured.setdefault(record["file"], {})
                counts[verdict.by] = counts.get(verdict.by, 0) + 1
            with results.open("a") as out:
                out.write(json.dumps(record, ensure_ascii=False) + "\n")
            print(line_of(record), flush=True)
        return record

    program = tree.BUILD / "tests/mutants/mutant_fingerprint"
    clean, pictured = scoring.fingerprint(program, 0, tree.SOURCE), scoring.run_traced([program], tree.SOURCE)[1]
    # Named ones first, the others in any order: a run that is cut short has scored a fair sample.
    open_faults = [f for f in faults if f["number"] not in done]
    random.Random(0).shuffle(open_faults)
    open_faults.sort(key=lambda f: "name" not in f)
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        return [done[f["number"]] for f in faults if f["number"] in done] + list(pool.map(one, open_faults))


def line_of(record):
    name = record.get("name") or f'{record["file"].split("/")[-1]}:{record["line"]} {record["fault"][:90]}'
    if record["killed"]:
        return f'killed    {record["number"]:4d} {name}  [{record["by"]}, {record["how"]}, {record["seconds"]:.1f} s]'
    why = "no test reaches it" if not record["tests"] else "" if record["exhausted"] else " (not all tests were run)"
    same = " pictures are the same" if record.get("pictures_differ") is False else ""
    return f'SURVIVED  {record["number"]:4d} {name}  [{record["tests"]} tests reach it, {record["seconds"]:.0f} s{same}]{why}'


def main():
    arguments = parse()
    bugs = named.bugs()
    if arguments.list:
        for number, bug in enumerate(bugs, 1):
            print(f'{number:4d}  {bug["id"]}  ({bug["like"]})')
        return
    try:
        mutants = named_mutants()
    except named.OutOfDate as error:
        sys.exit(str(error))
    if arguments.check:
        print(f"all {len(bugs)} named bugs have their places")
        return
    mutants = prepare(arguments)
    by_number = {}
    for mutant in mutants:
        by_number.setdefault(mutant.number, []).append(mutant)
    tests = learned_tests(mutants, arguments.jobs)
    for test in tests:
        if not test.passed:
            print(f"fails without a fault: {test.name}")
    faults = [describe(group, bugs) for group in by_number.values()]
    results = tree.WORK / "results.jsonl"
    if arguments.only:
        wanted = set(arguments.only.split(","))
        faults = [f for f in faults if str(f["number"]) in wanted or f.get("name") in wanted]
        if not faults:
            sys.exit(f"no fault has the name or number {arguments.only}: --list shows the names")
        results = tree.WORK / "only.jsonl"
        results.unlink(missing_ok=True)
    records = score_all(faults, tests, arguments, results)
    known = known_equivalents()
    summary.print_score(records, known)
    if not arguments.only:
        summary.write(records, known, tree.ROOT / "build/release/results/mutants.jsonl")
    sys.exit(1 if any("name" in r and not r["killed"] for r in records) else 0)


if __name__ == "__main__":
    main()
