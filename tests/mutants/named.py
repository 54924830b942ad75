"""Bugs that renderers and their test harnesses really had, as faults of this tree (named.json).

A place names a file and the text that is changed, an expression unless `statement` says otherwise; where the text
stands more than once, `within` holds a piece that stands once. With `before` the new text is put before a statement
that stays.
"""

import json
import pathlib

from schemata import Mutant

LIST = pathlib.Path(__file__).resolve().parent / "named.json"


class OutOfDate(Exception):
    """The text of a bug is not where it should be."""


def find_once(text, part, where):
    found = text.count(part)
    if found != 1:
        raise OutOfDate(f"{where}: stands there {found} times, not once: bring the bug up to date\n    {part}")
    return text.index(part)


def is_in_constexpr(text, start):
    """Whether a place is in the body of the last function before it that says constexpr."""
    head, depth = text[:start].rfind("constexpr"), 0
    for sign in text[head:start] if head >= 0 else "":
        depth += (sign == "{") - (sign == "}")
        if sign == "}" and depth == 0:
            return False
    return depth > 0


def places_of(bug, root):
    """The mutants that are one bug.

    @raises OutOfDate: a text is not found, or more than once
    """
    result = []
    for place in bug["places"]:
        path = pathlib.Path(root) / place["file"]
        where = f'{bug["id"]}, {place["file"]}'
        if not path.exists():
            raise OutOfDate(f"{where}: there is no such file: bring the bug up to date")
        text = path.read_text()
        start = 0
        if "within" in place:
            start = find_once(text, place["within"], where)
            start += find_once(place["within"], place["find"], where + ", within its context")
        else:
            start = find_once(text, place["find"], where)
        bytes_before = len(text[:start].encode())
        result.append(Mutant(file=str(path), start=bytes_before, end=bytes_before + len(place["find"].encode()),
                             line=text.count("\n", 0, start) + 1, operator=bug["id"], find=place["find"],
                             replace=place["replace"], statement=place.get("statement", False),
                             before=place.get("before", False), constexpr=is_in_constexpr(text, start)))
    return result


def bugs():
    return json.loads(LIST.read_text())
