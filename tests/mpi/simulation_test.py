"""The simulation of ranks, where its answer has a closed form."""

import dataclasses
import math
import pathlib
import random
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench/ranks"))

from simulate import Failures, Job, Machine, Simulation, interrupted, time_of, time_of_queue  # noqa: E402


class Ranks(unittest.TestCase):
    def test_alike_and_each_on_a_core_are_amdahls(self):
        for ranks in (1, 2, 7, 1000):
            job = Job(ranks, work=100, start=3, start_of_each=0.5, image_bytes=1e6, pack=1e-8, unpack=2e-8, message=1e-3, finish=1)
            # What is not dealt out: start and end, and what rank 0 takes from the others.
            serial = 3 + 0.5 + 1 + (ranks - 1) * (1e-3 + 2e-8 * 1e6 / ranks)
            self.assertAlmostEqual(time_of(job), serial + (100 + 1e-8 * 1e6) / ranks, places=9)

    def test_share_the_cores_of_one_machine(self):
        for ranks, longest in ((1, 60), (2, 30), (3, 30), (7, 30)):
            job = Job(ranks, work=60, cores=2, ranks_per_machine=7)
            self.assertAlmostEqual(time_of(job), longest, places=9)
        # Cores that slow each other down, as two threads of one do.
        self.assertAlmostEqual(time_of(Job(3, work=60, cores=2, ranks_per_machine=3, both=0.75)), 40, places=9)

    def test_of_which_one_is_longer_have_its_core_alone_at_the_end(self):
        simulation = Simulation(Job(3, work=6, cores=2, ranks_per_machine=3), random.Random(0))
        simulation.parts = [1, 1, 4]  # all three at two thirds until 1.5, then one alone, with 3 left
        self.assertAlmostEqual(simulation.run(), 4.5, places=9)

    def test_wait_for_the_slowest_of_all(self):
        # Each machine is slow with probability p: the job is, but for (1 - p)^N.
        ranks, share, runs = 20, 0.05, 1000
        job = Job(ranks, work=ranks, slow=share, slowness=3)
        chance = 1 - (1 - share) ** ranks
        error = 2 * math.sqrt(chance * (1 - chance) / runs)
        self.assertLess(abs(time_of(job, runs=runs) - (1 + 2 * chance)), 6 * error)
        self.assertGreater(2 * chance, 6 * error, "a slow machine that nobody waits for would be seen")

    def test_of_normal_parts_wait_for_the_largest(self):
        # Blom 1958: E max of N normal numbers is quantile((N - 0.375)/(N + 0.25)) within 1 %; N = 3: 3/(2 sqrt(pi)), exactly.
        runs, spread = 2000, 0.05
        job = Job(3, work=3, spread=spread)
        expected = 1 + spread * 1.5 / math.sqrt(math.pi)
        self.assertLess(abs(time_of(job, runs=runs) - expected), 6 * spread * 0.75 / math.sqrt(runs))

    def test_of_a_queue_are_even_where_machines_are(self):
        # Even where all machines are alike, fast or slow.
        self.assertAlmostEqual(time_of_queue(Job(2, work=6), 3), 3)
        self.assertAlmostEqual(time_of_queue(Job(4, work=12, slow=1, slowness=2), 3), 6)

    def test_do_not_take_while_their_own_part_runs(self):
        simulation = Simulation(Job(2, work=2, message=1), random.Random(0))
        simulation.parts = [5, 1]
        self.assertAlmostEqual(simulation.run(), 6, places=9)


class FailuresOfMachines(unittest.TestCase):
    def mean(self, seconds, failures, machines, runs=2000):
        rng = random.Random(1)
        times = [interrupted(seconds, machines, failures, rng) for _ in range(runs)]
        mean = sum(times) / runs
        return mean, math.sqrt(sum((t - mean) ** 2 for t in times) / (runs - 1) / runs)

    def test_cost_what_the_exponential_says(self):
        # Daly 2006, Eq. 13 without the last checkpoint's cost: each segment of length s takes (1/r + R)(exp(r s) - 1) in the mean,
        # where a failure may also meet the restart: R' = (exp(r R) - 1)/r.
        failures = Failures(rate=1e-3, every=50, cost=2, restart=10)
        machines, segments = 10, 8
        rate = failures.rate * machines
        restart = (math.exp(rate * failures.restart) - 1) / rate

        def expected(length):
            return (math.exp(rate * length) - 1) * (1 / rate + restart)

        total = (segments - 1) * expected(52) + expected(50)
        mean, error = self.mean(segments * failures.every, failures, machines)
        self.assertLess(abs(mean - total), 6 * error)
        without_restart = (segments - 1) * (math.exp(rate * 52) - 1) / rate + (math.exp(rate * 50) - 1) / rate
        self.assertGreater(abs(total - without_restart), 6 * error, "a restart that costs nothing would be seen")

    def test_that_never_come_cost_the_checkpoints(self):
        mean, _ = self.mean(100, Failures(rate=0, every=10, cost=1), 1, runs=2)
        self.assertAlmostEqual(mean, 109)


if __name__ == "__main__":
    unittest.main()
