"""What a night is made of, the most valuable first. The table in docs/nights.md says the same (tests/nightly)."""

import dataclasses


@dataclasses.dataclass(frozen=True)
class Effort:
    """One way to do a part: what it takes and how it is done. `minutes` are of two cores of a server."""

    what: str
    minutes: float
    command: tuple


@dataclasses.dataclass(frozen=True)
class Part:
    """`efforts` grow; a night takes the least of each part first, and more where there is time."""

    name: str
    shows: str
    efforts: tuple


def parts(directory):
    """Of the release build; `directory` takes JUnit's files, in a subdirectory. In braces: what a night fills in."""
    build = "build/release"

    def gate(runs):
        return Effort(f"{runs} run{'s' * (runs > 1)}", 12 * runs,
                      ("env", "PLUMBLINE_NIGHTLY=gate", f"PLUMBLINE_JUNIT={{here}}/{directory}/junit", "./run", "seeds", str(runs), "--gate"))

    # Every run of a night is held to the night's level; what is "1" runs full grids too.
    suites = ("env", "PLUMBLINE_NIGHTLY=1", "PLUMBLINE_SEED={seed}", f"PLUMBLINE_RESULTS={{here}}/{build}/results/checks", "ctest", "--preset", "release", "-C", "nightly", "-L", "nightly", "-E", "^nightly.calibration_test$",
              "-j", "{cores}", "--output-junit", f"{directory}/junit/suites.xml")
    bench = (f"{build}/bench/plumbline_bench", "--results", f"{build}/results/bench")
    calibrate = ("env", "PLUMBLINE_NIGHTLY=1", f"{build}/plumbline", "calibrate", "--seed", "{seed}", "--results", f"{build}/results/calibration")
    count = ("bench/duet/count_parts.py", f"{build}/results/duet/counters.jsonl")

    def duets(*more):
        return ("./run", "compare-runs", "{accepted}", ".", "--json", f"{build}/results/duet/duets.jsonl", *more)

    short = "bsdf-sample,render/mis,shadow-rays,verify"
    return (
        Part("gate", "the gate with seeds that nobody chose", tuple(gate(n) for n in (1, 2, 4, 8))),
        Part("suites", "full grids and tighter tolerances, with one fresh seed", (Effort("all", 35, suites),)),
        Part("counters", "rays, samples, bytes, heap and instructions of the parts of a duet", (Effort("all", 2, count),)),
        Part("benchmarks", "times, repeated; rays", (
            Effort("the one-minute set", 3, bench), Effort("full", 30, (*bench, "--full")))),
        Part("duets", "times and counters beside the last accepted night", (
            Effort("a short set", 15, duets("--only", short, "--seconds", "30")), Effort("all parts", 70, duets()))),
        Part("calibration", "levels, power and coverage of the checks", (
            Effort("as in the gate", 2, calibrate), Effort("full", 60, (*calibrate, "--full")))),
        Part("fuzz", "hostile input for every reader of what users hand us, under sanitizers", (
            Effort("60 s of each target", 16, ("./run", "fuzz", "60")),
            Effort("600 s of each", 97, ("./run", "fuzz", "600")))),
        Part("mutants", "known bugs, each of which the gate must see", (
            Effort("named", 60, ("tests/mutants/run_mutants.py",)),
            Effort("named and 200 mechanical", 240,
                   ("tests/mutants/run_mutants.py", "--renderer", "140", "--verify", "60")))),
    )
