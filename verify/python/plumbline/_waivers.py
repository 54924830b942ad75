"""Known failures."""

from __future__ import annotations

import datetime
from dataclasses import dataclass
from typing import Sequence

from . import _core


@dataclass(frozen=True)
class Waiver:
    """A check that is known not to pass, in place of one that is commented out."""

    check: str
    """its subject, ``"coat/front 80°/energy"``; ``*`` stands for anything in between"""
    reason: str
    """why that is put up with, one sentence"""
    until: datetime.date
    """the last day on which it holds [UTC]"""


def waive(report: _core.Report, waivers: Sequence[Waiver]) -> _core.Report:
    """The report with known failures counted as skipped.

    A waiver that has expired, names no check, or names only checks that pass adds a failing result
    of its own, ``waiver/`` and what it names.

    Raises:
        ValueError: for a waiver without a check or a reason.
    """
    return _core.waive(report, [(w.check, w.reason, w.until.isoformat()) for w in waivers])
