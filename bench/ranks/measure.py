#!/usr/bin/python3
"""Measures what the simulation of ranks needs, on this machine, without MPI where that goes, predicts the time of 1, 2, 3 and 7
ranks, and measures those: bench/ranks/measure.py [--plumbline FILE] [--repeats N]. Each time is the shortest of some, for a
machine that does other things too."""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile
import time

from simulate import Job, time_of

RANKS = (1, 2, 3, 7)
SCENE = ("render", "edge_shadow", "--threads", "1")
SAMPLES = 64
WORK = ("--size", "512x384")
ALL, ONE = ("--spp", str(SAMPLES)), ("--spp", "1")
TINY = ("--size", "1x1", "--spp", "1")
LARGE = ("--size", "2048x1536", "--spp", "1", "--max-depth", "1")
LARGE_BYTES = 60 * 2048 * 1536
ENVIRONMENT = dict(
    os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1"
)


class Bench:
    def __init__(self, plumbline, folder):
        self.plumbline, self.folder = plumbline, folder

    def words(self, options, ranks=0):
        before = ["mpirun", "--bind-to", "none", "-n", str(ranks)] if ranks else []
        out = [] if "-o" in options else ["-o", "out.exr"]
        return before + [self.plumbline, *SCENE, *options, *out] + (["--mpi"] if ranks else [])

    def seconds(self, *commands):
        """Of commands at the same time."""
        begin = time.perf_counter()
        running = [
            subprocess.Popen(words, cwd=self.folder, env=ENVIRONMENT, stdout=subprocess.DEVNULL) for words in commands
        ]
        if any([process.wait() for process in running]):
            sys.exit(f"failed: {commands}")
        return time.perf_counter() - begin

    def alone(self, *options):
        return self.seconds(self.words(options))

    def ranks(self, count, *options):
        return self.seconds(self.words(options, count))

    def shards(self, count, samples=(), together=False):
        commands = [
            self.words((*WORK, *samples, "-o", "/dev/null", "--shard", f"{i + 1}/{count}", "--checkpoint", f"{i}.state"))
            for i in range(count)
        ]
        if together:
            return [self.seconds(*commands)]
        return [self.seconds(words) for words in commands]


def rounds(repeats, measures):
    """The shortest times of each measure, by its name: all of them in turn, again and again."""
    times = {name: [] for name in measures}
    for _ in range(repeats):
        for name, measure in measures.items():
            times[name].append(measure())
    return {name: [min(of_one) for of_one in zip(*runs)] for name, runs in times.items()}


def mean(values):
    return sum(values) / len(values)


def inputs(bench, repeats):
    """The job of one rank as measured: none of the runs that are predicted is used, but for starts of a tiny image."""
    cores = len(os.sched_getaffinity(0))
    t = rounds(
        repeats,
        {
            "program": lambda: [bench.alone(*TINY)],
            "start 1": lambda: [bench.ranks(1, *TINY)],
            "start 5": lambda: [bench.ranks(5, *TINY)],
            "all": lambda: [bench.alone(*WORK, *ALL)],
            "8 shards": lambda: bench.shards(8, ALL),
            "8 shards, 1 sample": lambda: bench.shards(8, ONE),
            "2 shards": lambda: bench.shards(2, ALL),
            "2 shards, 1 sample": lambda: bench.shards(2, ONE),
            "2 shards at once": lambda: bench.shards(2, ALL, together=True),
            "2 shards at once, 1 sample": lambda: bench.shards(2, ONE, together=True),
            "large": lambda: [bench.alone(*LARGE)],
            "large, 2 ranks": lambda: [bench.ranks(2, *LARGE)],
        },
    )
    for name, values in t.items():
        print(f"  {name:28} {' '.join(f'{value:.3f}' for value in values)} s")

    def samples_of(name):  # without what a shard costs that has hardly any: its start and its checkpoint
        differences = (more - one for more, one in zip(t[name], t[name + ", 1 sample"]))
        return [difference * SAMPLES / (SAMPLES - 1) for difference in differences]

    work = t["all"][0] - t["program"][0]
    parts = samples_of("8 shards")
    of_each = (t["start 5"][0] - t["start 1"][0]) * cores / 4  # four ranks more on so many cores
    # Two ranks share the samples of the large image, and the second one's half goes to the first.
    gathered = t["large, 2 ranks"][0] - t["start 1"][0] - (t["large"][0] - t["program"][0])
    job = Job(
        ranks=1,
        work=work,
        dilution=max(0, sum(parts) / work - 1) / 7,
        cores=cores,
        both=min(1, mean(samples_of("2 shards")) / samples_of("2 shards at once")[0]),
        start=t["start 1"][0] - of_each,
        start_of_each=of_each,
        image_bytes=60 * 512 * 384,
        unpack=max(0, gathered) / (LARGE_BYTES / 2),
    )
    print(f"  work {work:.3f} s, {100 * job.dilution:.2f} % more for each rank; speed of a core beside another {job.both:.3f}")
    print(f"  start {job.start:.3f} s and {of_each:.3f} s of a core for each rank; {job.unpack * 1e9:.1f} ns a byte to gather")
    print(f"  eighths of the samples: {min(parts):.3f} to {max(parts):.3f} s")
    return job


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    root = pathlib.Path(__file__).resolve().parents[2]
    parser.add_argument("--plumbline", default=str(root / "build/release/plumbline"))
    parser.add_argument("--repeats", type=int, default=5)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(arguments.plumbline, folder)
        print(f"inputs, the shortest of {arguments.repeats}:")
        job = inputs(bench, arguments.repeats)
        measured = rounds(arguments.repeats, {n: (lambda n=n: [bench.ranks(n, *WORK, *ALL)]) for n in RANKS})
    print("ranks  predicted   measured      off  efficiency")
    for count in RANKS:
        job.ranks = job.ranks_per_machine = count
        predicted = time_of(job)
        used = min(count, job.cores)
        seconds = measured[count][0]
        print(
            f"{count:>5} {predicted:>9.3f} s {seconds:>8.3f} s {100 * (predicted / seconds - 1):>+7.1f} % "
            f"{job.work / used / seconds:>10.3f}"
        )


if __name__ == "__main__":
    main()
