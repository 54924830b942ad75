#!/usr/bin/env python3
"""Runs a night: its parts one after the other, each with a limit of its own, and appends what came of it to the history.

`./run nightly` builds first and makes the page afterwards. docs/nights.md says what the parts are.
"""

import argparse
import csv
import dataclasses
import io
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree as xml

import parts
import plan
import sources

ROOT = sources.ROOT
WORK = pathlib.Path("build/nightly")
RESULTS = pathlib.Path("build/release/results")
SEEDS = pathlib.Path("build/seeds.jsonl")
REMINDER = 300  # seconds between words of progress
ENOUGH = 0.9  # of its minutes must be left for a part to begin
SHOWN_LINES = 20  # of the output of a part that failed


@dataclasses.dataclass
class Outcome:
    name: str
    status: str  # as `plumbline history append --part` takes it
    seconds: float = 0
    note: str = ""

    def good(self):
        return self.status in ("passed", "skipped")


def say(text):
    print(text, file=sys.stderr, flush=True)


def fresh_seed():
    """48 bits, so that every reader of JSON keeps them whole."""
    return int(os.environ.get("PLUMBLINE_SEED") or int.from_bytes(os.urandom(6), "little"))


def end(process):
    """A part and all that it has started."""
    for kind in (signal.SIGTERM, signal.SIGKILL):
        try:
            os.killpg(process.pid, kind)
            process.wait(timeout=10)
        except ProcessLookupError:
            return
        except subprocess.TimeoutExpired:
            continue
    process.wait()


def wait(process, seconds, name, clock=time.monotonic):
    """Until its end, or that of its time; whether it came to its own."""
    start = clock()
    while True:
        spent = clock() - start
        if spent >= seconds:
            return False
        try:
            process.wait(timeout=min(REMINDER, seconds - spent))
            return True
        except subprocess.TimeoutExpired:
            say(f"   {name}: {plan.duration((clock() - start) / 60)} so far")


def run_part(name, command, seconds, environment, log):
    """The outcome of one part, whatever becomes of it. What it prints goes into the log."""
    start = time.monotonic()
    try:
        with log.open("wb") as out:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT,
                                       env=environment, start_new_session=True)
    except OSError as error:
        return Outcome(name, "failed", 0, f"cannot be run: {error.strerror}: {command[0]}")
    try:
        in_time = wait(process, seconds, name)
    except KeyboardInterrupt:
        end(process)
        raise
    if not in_time:
        end(process)
        return Outcome(name, "timed out", time.monotonic() - start, f"ended after {plan.duration(seconds / 60)}; {log}")
    took = time.monotonic() - start
    if process.returncode == 0:
        return Outcome(name, "passed", took)
    return Outcome(name, "failed", took, f"exit code {process.returncode}; {log}")


def limit(effort, left):
    """Seconds that a part may take: twice its plan, for slower machines, and not what is kept for the end."""
    most = 120 * effort.minutes
    return most if left is None else min(most, left)


def run_all(chosen, seconds, seed, accepted, work=WORK):
    """The outcomes of all parts, in their order. An interrupt ends the night, not what it has done."""
    began, outcomes = time.monotonic(), []
    words = {"seed": str(seed), "cores": str(os.cpu_count()), "here": os.getcwd(), "accepted": accepted or ""}
    # Each part says itself which seed it has and where its results go: what one sets would mislead another.
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PLUMBLINE_")}
    interrupted = False
    for number, planned in enumerate(chosen, 1):
        name, effort = planned.part.name, planned.effort
        left = None if seconds is None else seconds - (time.monotonic() - began)
        if interrupted:
            outcome = Outcome(name, "skipped", 0, "the night was interrupted")
        elif effort is None:
            outcome = Outcome(name, "skipped", 0, plan.why_skipped(planned.part.efforts[0], planned.left))
        elif left is not None and left < 60 * ENOUGH * effort.minutes:
            outcome = Outcome(name, "skipped", 0, plan.why_skipped(effort, left / 60))
        elif accepted is None and "{accepted}" in effort.command:
            outcome = Outcome(name, "skipped", 0, "no night was accepted before this one")
        else:
            say(f"== {number} of {len(chosen)}: {name}, {effort.what}, about {plan.duration(effort.minutes)}, from "
                f"{time.strftime('%H:%M')} on")
            try:
                command = [word.format(**words) for word in effort.command]
                outcome = run_part(name, command, limit(effort, left), environment, work / f"{name}.log")
            except KeyboardInterrupt:
                interrupted, outcome = True, Outcome(name, "failed", 0, "interrupted")
        outcomes.append(outcome)
        say(f"   {name}: {outcome.status}, {plan.duration(outcome.seconds / 60)}. {outcome.note}")
        if not outcome.good():
            show_end_of(work / f"{name}.log")
    return outcomes


def accepted_commit(history):
    """That of the latest night of which no part has failed; None where there is none.

    What its duets found does not count: what is slower is said in one night, and what comes after it is compared with it."""
    export = subprocess.run(["build/release/plumbline", "history", "export", "--csv", "--table", "parts", "--history", history],
                            capture_output=True, text=True)
    nights = {}
    for row in csv.DictReader(io.StringIO(export.stdout)):
        if row["kind"] == "nightly" and row["part"] != "duets":
            nights.setdefault((int(row["run"]), row["commit"]), set()).add(row["status"])
    good = [night for night, found in nights.items() if "passed" in found and found <= {"passed", "skipped"}]
    return max(good)[1] if good else None


def show_end_of(log):
    if log.exists():
        for line in log.read_text(errors="replace").splitlines()[-SHOWN_LINES:]:
            say(f"   | {line}")


def write_junit(outcomes, path):
    """The parts as tests of one suite; what ctest runs has files of its own beside it."""
    suite = xml.Element("testsuite", name="nightly", tests=str(len(outcomes)),
                        failures=str(sum(not o.good() for o in outcomes)),
                        skipped=str(sum(o.status == "skipped" for o in outcomes)),
                        time=f"{sum(o.seconds for o in outcomes):.3f}")
    for outcome in outcomes:
        case = xml.SubElement(suite, "testcase", classname="nightly", name=outcome.name, time=f"{outcome.seconds:.3f}")
        if outcome.status == "skipped":
            xml.SubElement(case, "skipped", message=outcome.note)
        elif not outcome.good():
            xml.SubElement(case, "failure", message=f"{outcome.status}: {outcome.note}")
    xml.ElementTree(suite).write(path, encoding="utf-8", xml_declaration=True)


def part_words(outcomes):
    """For `plumbline history append`."""
    return [word for o in outcomes
            for word in ("--part", f"{o.name}={o.status},{o.seconds:.3f}" + (f",{o.note}" if o.note else ""))]


def take_seed_runs(since, results=RESULTS, tally=SEEDS):
    """What the tally of `./run seeds` has gained goes to the results of this night."""
    if tally.exists():
        with tally.open("rb") as lines:
            lines.seek(since)
            gained = lines.read()
        if gained:
            (results / "seeds.jsonl").write_bytes(gained)


def publish(history, outcomes, seed):
    """Into the history; and what it shows as Markdown, where a job's page takes it, and as a record for our page.

    Whether all arrived, and no sequence over the nights is refuted."""
    command = ["build/release/plumbline", "history"]
    appended = subprocess.run([*command, "append", str(RESULTS), "--history", history, "--kind", "nightly", "--seed",
                               str(seed), "--sources", sources.hash_of(), *part_words(outcomes)])
    if appended.returncode != 0:
        return False
    said = [subprocess.run([*command, *words, "--history", history], stdout=subprocess.PIPE)
            for words in (["summary"], ["report", "--json", str(RESULTS / "history.json")])]
    text = b"\n".join(one.stdout for one in said)
    (WORK / "summary.md").write_bytes(text)
    page = os.environ.get("GITHUB_STEP_SUMMARY")
    if page:
        with open(page, "ab") as out:
            out.write(text)
    return all(one.returncode == 0 for one in said)


def hours(text):
    value = float(text)
    if not 0 < value < float("inf"):
        raise ValueError
    return value


def parse(words):
    parser = argparse.ArgumentParser(prog="./run nightly", description=__doc__.split("\n")[0])
    parser.add_argument("--hours", type=hours, metavar="H", help="take no longer: the most valuable parts first")
    parser.add_argument("--history", default="build/history.db", metavar="FILE",
                        help="the database that the night is appended to (default: %(default)s)")
    parser.add_argument("--plan", action="store_true", help="only say what would run, and how long it would take")
    return parser.parse_args(words)


def main(words, make_parts=parts.parts, root=ROOT):
    arguments = parse(words)
    os.chdir(root)
    chosen = plan.share_out(make_parts(WORK), arguments.hours)
    say(f"a night of {plan.duration(plan.total(chosen))}:\n{plan.table(chosen)}")
    if arguments.plan:
        return 0
    seed = fresh_seed()
    say(f"seed {seed}; logs in {WORK}, history in {arguments.history}")
    shutil.rmtree(RESULTS, ignore_errors=True)  # or the numbers of other runs would be this one's
    shutil.rmtree(WORK, ignore_errors=True)
    (WORK / "junit").mkdir(parents=True)
    (RESULTS / "checks").mkdir(parents=True)
    since = SEEDS.stat().st_size if SEEDS.exists() else 0
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    seconds = None if arguments.hours is None else 60 * (60 * arguments.hours - plan.KEPT)
    outcomes = run_all(chosen, seconds, seed, accepted_commit(arguments.history))
    take_seed_runs(since)
    write_junit(outcomes, WORK / "junit/parts.xml")
    published = publish(arguments.history, outcomes, seed)
    ran = any(o.status == "passed" for o in outcomes)  # a night of which nothing fits has shown nothing
    return 0 if published and ran and all(o.good() for o in outcomes) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
