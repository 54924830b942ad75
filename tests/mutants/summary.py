"""What the page shows of a score: tables in the format that `plumbline report` reads."""

import json
import math
import statistics

GROUP = "Faults put in"


def interval(seen, of):
    """Wilson's 95 % interval of a proportion, as text."""
    if of == 0:
        return "–"
    z, p = 1.959964, seen / of
    middle = (p + z * z / (2 * of)) / (1 + z * z / of)
    half = z * math.sqrt(p * (1 - p) / of + z * z / (4 * of * of)) / (1 + z * z / of)
    return f"{max(middle - half, 0):.3f} … {min(middle + half, 1):.3f}"


def is_equivalent(record, known):
    """Whether a survivor changes nothing: known to, or no picture of the covering array is another one."""
    if record["killed"]:
        return False
    return (record["file"], record.get("text"), record.get("fault")) in known or record.get("pictures_differ") is False


def set_of(record):
    if "name" in record:
        return f'named, {record["changes"]}'
    return f'mechanical, {record["file"].split("/")[0]}'


def set_row(title, records, known):
    equal = [r for r in records if is_equivalent(r, known)]
    others = [r for r in records if not is_equivalent(r, known)]
    seen = [r for r in others if r["killed"]]
    seconds = f'{statistics.median(r["seconds"] for r in seen):.1f}' if seen else "–"
    score = f"{len(seen) / len(others):.3f}" if others else "–"
    return [title, str(len(records)), str(len(equal)), str(len(seen)), score, interval(len(seen), len(others)),
            seconds, str(len(others) - len(seen))]


def table(title, caption, columns, rows):
    return {"format": "plumbline.table/1", "group": GROUP, "title": title, "caption": caption, "columns": columns,
            "rows": rows}


def place_of(record):
    return f'{record["file"]}:{record["line"]}'


def tables(records, known):
    """The score of each set, the named bugs one by one, and what nobody saw."""
    sets = {}
    for record in records:
        sets.setdefault(set_of(record), []).append(record)
    yield table(
        "Score of the gate",
        "Faults put into a copy of the sources, one at a time: how many some test of the gate sees. Equivalent ones "
        "change nothing. Seconds: of tests until the first that fails, the median.",
        ["Set", "Faults", "Equivalent", "Seen", "Share", "95 %", "Seconds", "Not seen"],
        [set_row(name, sets[name], known) for name in sorted(sets)])
    bugs = [r for r in records if "name" in r]
    yield table(
        "Named bugs", "Bugs that renderers and their harnesses had, and the first test that sees each.",
        ["Bug", "Like", "Part", "Changes", "Seen by", "Check", "Samples", "Seconds", "Cause named"],
        [[r["name"], r["like"], r["part"], r["changes"], r["by"] or "nothing", r["check"] or "–",
          f'{r["samples"]:,}' if r["samples"] else "–", f'{r["seconds"]:.1f}', r["cause"] or "–"] for r in bugs])
    survivors = [r for r in records if not r["killed"] and not is_equivalent(r, known)]
    yield table(
        "Not seen", "Faults that no test of the gate sees, and that are not known to change nothing.",
        ["Where", "Fault", "Tests that reach it", "All run"],
        [[place_of(r), r.get("name") or r["fault"], str(r["tests"]), "yes" if r["exhausted"] else "no"]
         for r in survivors])


def write(records, known, path):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("".join(json.dumps(t, ensure_ascii=False) + "\n" for t in tables(records, known)))


def print_score(records, known):
    for row in next(iter(tables(records, known)))["rows"]:
        print(f"{row[0]:24s} {row[3]:>4s} of {int(row[1]) - int(row[2]):4d} seen, {row[4]} ({row[5]}), median {row[6]} s, "
              f"{row[2]} equivalent of {row[1]}")
