#!/usr/bin/python3
"""What one unit of each part's work comes to in this build, for the history: a counter a line (plumbline.counter/1).

The same numbers as `./run compare-runs --counters` shows of two revisions, but the hash of the results."""

import json
import pathlib
import sys

import compare_runs
import lockstep
import revisions

WORKER = revisions.ROOT / "build/release/bench/duet/plumbline_duet_worker"

# A file that is written has the number of its process in its name, whose length is in what the heap gives.
NOT_THE_SAME = {("image-file", "heap_bytes")}


def records(worker, parts):
    """Of one part after the other, so that a night that ends has what it counted."""
    for part in parts:
        for name, value in compare_runs.counters(worker, part).items():
            if name in compare_runs.COUNTED and (part, name) not in NOT_THE_SAME:
                yield {"format": "plumbline.counter/1", "name": f"duet/{part}/{name}", "unit": name.replace("_", " "), "value": value}


def main(words, worker=(str(WORKER),)):
    if len(words) != 1:
        print("usage: count_parts.py FILE.jsonl", file=sys.stderr)
        return 2
    path = pathlib.Path(words[0])
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w") as lines:
        for record in records(list(worker), compare_runs.output_of([*worker, "parts"]).split()):
            lines.write(json.dumps(record) + "\n")
            lines.flush()
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except lockstep.WorkerError as error:
        print(f"count_parts: {error}", file=sys.stderr)
        sys.exit(2)
