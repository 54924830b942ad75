#!/usr/bin/python3
"""Simulates a render by ranks, event by event: how long it takes, with cores that ranks share, parts that differ, slow machines
and machines that fail. docs/scaling.md has the model; measure.py measures its inputs and holds it against real runs."""

import argparse
import dataclasses
import heapq
import math
import random


@dataclasses.dataclass
class Job:
    """All times in seconds of one core that has no other to share with, all rates for one machine."""

    ranks: int
    work: float  # of all samples, in one process
    dilution: float = 0  # share of the work that each rank more adds: tiles with fewer pixels of each
    spread: float = 0  # standard deviation of a part's work over its mean
    cores: int = 1  # of a machine
    ranks_per_machine: int = 1
    both: float = 1  # speed of a core while all of its machine are busy
    start: float = 0  # until ranks work, whatever their number
    start_of_each: float = 0  # what each rank of a machine adds to that, on a core
    image_bytes: float = 0  # of all parts together
    pack: float = 0  # per byte, in the rank that sends
    unpack: float = 0  # per byte, in rank 0
    message: float = 0  # what rank 0 needs for a message of no bytes
    finish: float = 0  # the image file, and the end of all
    slow: float = 0  # share of the machines that are slow
    slowness: float = 1  # how many times as long they take


class Machine:
    """Cores that share out what is asked of them: each task has an equal part, no more than one core."""

    def __init__(self, cores, both):
        self.cores, self.both = cores, both
        self.left = {}  # work left of each task
        self.time = 0
        self.version = 0  # of the plan: events of an earlier one are void

    def rate(self):
        busy = len(self.left)
        speed = self.both if busy >= self.cores and self.cores > 1 else 1
        return speed * min(1, self.cores / busy)

    def advance(self, now):
        if self.left:
            done = (now - self.time) * self.rate()
            for task in self.left:
                self.left[task] -= done
        self.time = now

    def next_end(self):
        task = min(self.left, key=self.left.get)
        return self.time + max(self.left[task], 0) / self.rate(), task


class Simulation:
    """One run. Ranks start, work, pack and send; rank 0 takes what has come in turn, once its own part is done."""

    def __init__(self, job, rng):
        self.job, self.rng = job, rng
        self.events, self.count = [], 0
        machines = math.ceil(job.ranks / job.ranks_per_machine)
        self.machines = [Machine(job.cores, job.both) for _ in range(machines)]
        slow = [job.slowness if rng.random() < job.slow else 1 for _ in range(machines)]
        mean = job.work / job.ranks * (1 + job.dilution * (job.ranks - 1))
        self.parts = [
            mean * max(0, rng.gauss(1, job.spread)) * slow[self.machine_of(rank)] for rank in range(job.ranks)
        ]
        self.inbox, self.missing, self.is_taking, self.first_is_done = 0, job.ranks - 1, False, False
        self.end = None

    def machine_of(self, rank):
        return rank // self.job.ranks_per_machine

    def plan(self, number):
        machine = self.machines[number]
        machine.version += 1
        if machine.left:
            at, task = machine.next_end()
            self.count += 1
            heapq.heappush(self.events, (at, self.count, number, machine.version, task))

    def begin(self, now, rank, stage, work):
        number = self.machine_of(rank)
        self.machines[number].advance(now)
        self.machines[number].left[(rank, stage)] = work
        self.plan(number)

    def run(self):
        job = self.job
        for rank in range(job.ranks):
            self.begin(job.start, rank, "start", job.start_of_each)
        while self.events:
            now, _, number, version, task = heapq.heappop(self.events)
            machine = self.machines[number]
            if version != machine.version:
                continue
            machine.advance(now)
            del machine.left[task]
            self.plan(number)
            self.ended(now, *task)
        return self.end

    def ended(self, now, rank, stage):
        part_bytes = self.job.image_bytes / self.job.ranks
        if stage == "start":
            self.begin(now, rank, "work", self.parts[rank])
        elif stage == "work":
            self.begin(now, rank, "pack", self.job.pack * part_bytes)
        elif stage == "pack" and rank > 0:
            self.inbox += 1
            self.take(now)
        elif stage == "pack":
            self.first_is_done = True
            self.take(now)
        elif stage == "take":
            self.is_taking = False
            self.missing -= 1
            self.take(now)
        else:
            self.end = now

    def take(self, now):
        if not self.first_is_done or self.is_taking:
            return
        if self.inbox:
            self.inbox -= 1
            self.is_taking = True
            part_bytes = self.job.image_bytes / self.job.ranks
            self.begin(now, 0, "take", self.job.message + self.job.unpack * part_bytes)
        elif self.missing == 0:
            self.begin(now, 0, "finish", self.job.finish)


def time_of(job, seed=0, runs=1):
    """Mean time of a job that nothing interrupts [s]."""
    rng = random.Random(seed)
    return sum(Simulation(job, rng).run() for _ in range(runs)) / runs


@dataclasses.dataclass
class Failures:
    rate: float  # of one machine [1/s]
    every: float  # between checkpoints [s]
    cost: float = 0  # of a checkpoint: what all wait for [s]
    restart: float = 0  # until work goes on after a failure [s]


def interrupted(seconds, machines, failures, rng):
    """Time of work that all machines do together: a failure of one loses what came after the last checkpoint."""
    now = done = 0
    rate = failures.rate * machines
    failure = now + rng.expovariate(rate) if rate > 0 else math.inf
    while done < seconds:
        segment = min(failures.every, seconds - done)
        end = now + segment + (failures.cost if done + segment < seconds else 0)
        if end <= failure:
            now, done = end, done + segment
            continue
        # Machines may fail while the job is started again, too.
        now = failure + failures.restart
        failure += rng.expovariate(rate)
        while failure < now:
            now = failure + failures.restart
            failure += rng.expovariate(rate)
    return now


def time_with_failures(job, failures, together, seed=0, runs=100):
    """Mean time of a job whose machines fail [s]: of ranks, which end together, or of shards, each of which goes on by itself."""
    rng = random.Random(seed)
    total = 0
    machines = math.ceil(job.ranks / job.ranks_per_machine)
    for _ in range(runs):
        simulation = Simulation(job, rng)
        if together:
            total += interrupted(simulation.run(), machines, failures, rng)
        else:
            parts = (interrupted(part, 1, failures, rng) for part in simulation.parts)
            total += job.start + job.start_of_each + max(parts) + job.image_bytes * job.unpack + job.finish
    return total / runs


def time_of_queue(job, shards_of_each, seed=0):
    """Time of a job array [s]: so many shards for each machine, of which each takes the next as it is done."""
    rng = random.Random(seed)
    count = job.ranks * shards_of_each
    small = dataclasses.replace(job, spread=job.spread * math.sqrt(shards_of_each), slow=0)
    parts = Simulation(dataclasses.replace(small, ranks=count, work=job.work), rng).parts
    slowness = [job.slowness if rng.random() < job.slow else 1 for _ in range(job.ranks)]
    free = [(0.0, machine) for machine in range(job.ranks)]
    end = 0
    for part in parts:
        now, machine = heapq.heappop(free)
        now += job.start + part * slowness[machine]
        end = max(end, now)
        heapq.heappush(free, (now, machine))
    return end + job.image_bytes * job.unpack + job.finish


# A render of 10,000 core-hours, full HD, with the costs of docs/scaling.md; machines of one rank each.
LARGE = Job(
    ranks=1, work=3.6e7, spread=0.002, start=2, image_bytes=60 * 1920 * 1080, pack=6e-9, unpack=7e-9, message=2e-5, finish=1
)
YEAR = 365.25 * 86400


def table():
    """Efficiency: the work over the cores and the time."""
    print("  ranks   alike  1 % of the machines half as fast  machines fail once in 5 years")
    print("                      ranks  20 shards for each           ranks          shards")
    failures = Failures(rate=1 / (5 * YEAR), every=300, cost=2, restart=120)
    for ranks in (1, 10, 100, 1000, 10_000):
        job = dataclasses.replace(LARGE, ranks=ranks, spread=LARGE.spread * math.sqrt(ranks / 100))
        slow = dataclasses.replace(job, slow=0.01, slowness=2)
        runs = max(2, min(200, 2000 // ranks))
        times = (
            time_of(job),
            time_of(slow, runs=runs),
            sum(time_of_queue(slow, 20, seed) for seed in range(runs)) / runs,
            time_with_failures(job, failures, together=True, runs=max(runs, 5)),
            time_with_failures(job, failures, together=False, runs=2),
        )
        alike, of_ranks, of_queue, fail, fail_alone = (job.work / ranks / time for time in times)
        print(f"{ranks:>7} {alike:>7.3f} {of_ranks:>10.3f} {of_queue:>19.3f} {fail:>15.3f} {fail_alone:>15.3f}")


if __name__ == "__main__":
    argparse.ArgumentParser(description=__doc__).parse_args()
    table()
