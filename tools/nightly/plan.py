"""Shares a night's time out among its parts."""

import dataclasses

from parts import Effort, Part

# Minutes that are kept for the history and the page, which a night is for.
KEPT = 3


@dataclasses.dataclass(frozen=True)
class Planned:
    part: Part
    effort: Effort | None  # None: there is no time for the least of it
    left: float = 0  # minutes that there were


def share_out(parts, hours):
    """The least effort of every part that still fits, in their order; then more of each, in the same order."""
    left = None if hours is None else 60 * hours - KEPT
    chosen = []
    for part in parts:
        least = part.efforts[0]
        fits = left is None or least.minutes <= left
        chosen.append(Planned(part, least if fits else None, left or 0))
        if left is not None and fits:
            left -= least.minutes
    for i, planned in enumerate(chosen):
        if planned.effort is None:
            continue
        for effort in planned.part.efforts[1:]:
            more = effort.minutes - chosen[i].effort.minutes
            if left is not None and more > left:
                break
            chosen[i] = dataclasses.replace(planned, effort=effort)
            left = None if left is None else left - more
    return chosen


def total(chosen):
    """Minutes."""
    return KEPT + sum(p.effort.minutes for p in chosen if p.effort)


def duration(minutes):
    if minutes < 1:
        return f"{60 * minutes:.0f} s"
    hours, rest = divmod(round(minutes), 60)
    return f"{hours} h {rest:02} min" if hours else f"{rest} min"


def table(chosen):
    """For a person: what will run, and what will not."""
    lines = []
    for planned in chosen:
        if planned.effort:
            lines.append(f"  {planned.part.name:12} {duration(planned.effort.minutes):>12}  {planned.effort.what}: "
                         f"{planned.part.shows}")
        else:
            lines.append(f"  {planned.part.name:12} {'skipped':>12}  {why_skipped(planned.part.efforts[0], planned.left)}")
    return "\n".join(lines)


def why_skipped(effort, left):
    return f"takes {duration(effort.minutes)}, {duration(max(left, 0))} were left"
