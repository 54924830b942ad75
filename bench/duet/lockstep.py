"""Two workers in lock step: both start each slice together, on cores that they exchange after each."""

import os
import pathlib
import select
import subprocess

# Shorter than what the system gives a process at a time: most slices are not interrupted, and medians do not see the others.
SLICE_SECONDS = 0.001
# Of one launch that count, even, so that each side has been on each core as often: these, or fewer where one is long.
SLICES, LEAST_SLICES, LAUNCH_SECONDS = 64, 8, 0.1
ANSWER_SECONDS = 60  # a worker that says nothing for so long has died


class WorkerError(Exception):
    pass


def siblings(core):
    path = pathlib.Path(f"/sys/devices/system/cpu/cpu{core}/topology/thread_siblings_list")
    try:
        return path.read_text().strip()
    except OSError:
        return str(core)


def choose_cores():
    """Two that this process may use, not threads of one core where there are others; or one."""
    allowed = sorted(os.sched_getaffinity(0))
    for other in allowed[1:]:
        if siblings(other) != siblings(allowed[0]):
            return [allowed[0], other]
    return allowed[:2]


class Worker:
    def __init__(self, command, part):
        self.name = " ".join(map(str, command))
        self.process = subprocess.Popen([*command, "play", part], stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0)
        self.unread = b""
        if self.answer() != "ready":
            raise WorkerError(f"{self.name} is no worker of a duet")

    def answer(self):
        while b"\n" not in self.unread:
            if not select.select([self.process.stdout], [], [], ANSWER_SECONDS)[0]:
                raise WorkerError(f"{self.name} has said nothing for {ANSWER_SECONDS} s")
            more = os.read(self.process.stdout.fileno(), 4096)
            if not more:
                raise WorkerError(f"{self.name} ended with {self.process.wait()}")
            self.unread += more
        line, self.unread = self.unread.split(b"\n", 1)
        return line.decode()

    def move_to(self, core):
        os.sched_setaffinity(self.process.pid, {core})

    def go(self, units):
        try:
            self.process.stdin.write(f"go {units}\n".encode())
        except BrokenPipeError:
            raise WorkerError(f"{self.name} ended with {self.process.wait()}") from None

    def time(self, units):
        """Seconds of processor time that so many units take."""
        self.go(units)
        return float(self.answer())

    def end(self):
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()


def work_of_a_launch(command, part):
    """How many units take about SLICE_SECONDS, and how many slices a launch has; the same for both sides."""
    worker, units = Worker(command, part), 1
    try:
        while worker.time(units) < SLICE_SECONDS / 2 and units < 1 << 30:
            units *= 2
        unit = max(worker.time(units) / units, 1e-9)
        units = max(1, round(SLICE_SECONDS / unit))
        slices = round(LAUNCH_SECONDS / (units * unit) / 2) * 2
        return units, min(max(slices, LEAST_SLICES), SLICES)
    finally:
        worker.end()


def play_slice(sides, units, cores, swapped):
    """Seconds of the two sides, at the same time where there are two cores, else one after the other."""
    order = sides[::-1] if swapped else sides
    if len(cores) < 2:
        seconds = [side.time(units) for side in order]
    else:
        for side, core in zip(order, cores):
            side.move_to(core)
        for side in order:
            side.go(units)
        seconds = [float(side.answer()) for side in order]
    return seconds[::-1] if swapped else seconds


def launch(commands, part, units, slices, cores):
    """Pairs of seconds (a, b) of new processes: where their memory lies is part of what scatters."""
    sides = []
    try:
        for command in commands:
            sides.append(Worker(command, part))
        play_slice(sides, units, cores, False)  # caches and branch predictors are cold
        return [play_slice(sides, units, cores, i % 2 == 1) for i in range(slices)]
    finally:
        for side in sides:
            side.end()
