#!/usr/bin/python3
"""Is one revision slower than another? `./run compare-runs REV_A REV_B`; docs/compare_runs.md says how it is judged."""

import argparse
import json
import os
import subprocess
import sys
import time

import lockstep
import revisions

# Launches between two looks: the statistics put all pairs into 20 batches, each of whole launches then.
LAUNCHES = 20
COUNTED = ("rays", "samples", "bytes", "heap_bytes", "heap_blocks", "instructions")


def parse(words):
    parser = argparse.ArgumentParser(prog="./run compare-runs", description=__doc__.split("?")[0] + "?")
    parser.add_argument("a", metavar="REV_A", help="what is compared with: a commit, tag or branch, or . for the tree as it is")
    parser.add_argument("b", metavar="REV_B", help="what is judged")
    parser.add_argument("--only", default="", metavar="PART", help="parts whose names begin so; several with commas")
    parser.add_argument("--seconds", type=float, default=120, help="time limit of one part (120)")
    parser.add_argument("--force", action="store_true", help="measure even if both are the same code")
    parser.add_argument("--counters", action="store_true", help="only what is counted, no times")
    parser.add_argument("--json", metavar="FILE", help="records for the page (*.jsonl)")
    parser.add_argument("--judge", default=str(revisions.ROOT / "build/release/bench/duet/plumbline_duet_judge"), help=argparse.SUPPRESS)
    parser.add_argument("--workers", action="store_true", help=argparse.SUPPRESS)  # REV_A and REV_B are programs
    return parser.parse_args(words)


def output_of(command):
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode:
        raise lockstep.WorkerError(f"{' '.join(map(str, command))}: {run.stderr.strip()}")
    return run.stdout


def chosen_parts(workers, only):
    """Those that both sides have and that are asked for."""
    names = [output_of([*worker, "parts"]).split() for worker in workers]
    asked = tuple(only.split(","))
    chosen = [name for name in names[0] if name in names[1] and name.startswith(asked)]
    if not chosen:
        raise lockstep.WorkerError(f"no part is named '{only}'; there are: {', '.join(names[0])}")
    return chosen


def counters(worker, part):
    pairs = (line.split() for line in output_of([*worker, "count", part]).splitlines())
    return {name: int(value) for name, value in pairs}


def counted_differences(record):
    """Words for each counter that is not the same on both sides."""
    a, b, words = record["counters_a"], record["counters_b"], []
    for name in COUNTED:
        before, after = a.get(name, 0), b.get(name, 0)
        if before != after:
            words.append(f"{name} {before} → {after}" + (f" ({100 * (after / before - 1):+.2f} %)" if before else ""))
    if a.get("result") != b.get("result"):
        words.append("results differ")
    return words


class Judge:
    """plumbline_duet_judge: ratio, interval and verdict of records, and where they are kept."""

    def __init__(self, program):
        self.program = program

    def __call__(self, records, *arguments):
        lines = "".join(json.dumps(record) + "\n" for record in records)
        run = subprocess.run([self.program, *arguments], input=lines, capture_output=True, text=True)
        if run.returncode:
            raise lockstep.WorkerError(run.stderr.strip())
        judged = []
        for line in run.stdout.splitlines():
            ratio, low, high, narrow, verdict = line.split(maxsplit=4)
            judged.append((float(ratio), float(low), float(high), narrow == "1", verdict))
        return judged


def measure(record, workers, cores, judge, limit):
    """Adds launches until the interval is as narrow as it must be, or time is up."""
    part, end = record["part"], time.monotonic() + limit
    units, slices = lockstep.work_of_a_launch(workers[0], part)
    while True:
        for _ in range(LAUNCHES):
            for a, b in lockstep.launch(workers, part, units, slices, cores):
                record["a_seconds"].append(a)
                record["b_seconds"].append(b)
        if judge([record])[0][3] or time.monotonic() >= end:
            return


def new_record(part, names, identical, confidence):
    return {"format": "plumbline.duet/1", "part": part, "revision_a": names[0], "revision_b": names[1], "identical_code": identical,
            "confidence": confidence, "ratio": 1.0, "low": 1.0, "high": 1.0, "a_seconds": [], "b_seconds": [], "counters_a": {}, "counters_b": {}}


def row(record, judged):
    ratio, low, high, _, verdict = judged
    times = f"{ratio:.4f} [{low:.4f}, {high:.4f}]" if record["a_seconds"] else "-"
    return f"  {record['part']:<30} {times:<26} {len(record['a_seconds']):>5}  {verdict:<16} {'; '.join(counted_differences(record))}"


def compare(arguments, workers, names, identical):
    parts, judge, cores = chosen_parts(workers, arguments.only), Judge(arguments.judge), lockstep.choose_cores()
    timed = not arguments.counters and (not identical or arguments.force)
    if identical:
        print("The two are the same code, byte for byte" + (": nothing to measure" if not timed else ""))
    if timed:
        print(f"{len(parts)} parts: some 10 to {arguments.seconds:.0f} s each, {len(parts) * arguments.seconds / 60:.0f} min at most; "
              + ("side by side on cores " + " and ".join(map(str, cores)) if len(cores) > 1 else "in turns on one core"))
    print(f"  {'part':<30} {'time of b / a':<26} {'pairs':>5}  {'verdict':<16} counted", flush=True)
    records = [new_record(part, names, identical, 1 - 0.01 / len(parts)) for part in parts]
    for record in records:
        record["counters_a"], record["counters_b"] = (counters(worker, record["part"]) for worker in workers)
        if timed:
            measure(record, workers, cores, judge, arguments.seconds)
        print(row(record, judge([record])[0]), flush=True)
    judged = judge(records, *(["--json", arguments.json] if arguments.json else []))
    slower = [record["part"] for record, (*_, verdict) in zip(records, judged) if verdict == "slower"]
    print(f"slower: {', '.join(slower)}" if slower else "nothing is slower")
    return 1 if slower else 0


def main(words):
    arguments = parse(words)
    if arguments.workers:
        return compare(arguments, [[arguments.a], [arguments.b]], ["a", "b"], False)
    names = [revisions.full_name(revision) for revision in (arguments.a, arguments.b)]
    print(f"a: {names[0]}\nb: {names[1]}\nbuilding both under {os.path.relpath(revisions.FOLDER)} (minutes where it is new)", flush=True)
    programs = [revisions.build(side, revision) for side, revision in zip("ab", (arguments.a, arguments.b))]
    return compare(arguments, [[program] for program in programs], names, revisions.same_code(*programs))


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except (lockstep.WorkerError, revisions.RevisionError) as error:
        print(f"compare-runs: {error}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)
