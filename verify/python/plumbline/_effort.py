"""What checks have in common: how hard they look, and how they are repeated."""

from __future__ import annotations

import os
from collections import deque
from dataclasses import dataclass, fields
from typing import Any, Deque, Optional, TypeVar

import numpy as np
from numpy.typing import DTypeLike

from . import _core

Options = TypeVar("Options")

OF_TEST: Deque[_core.Report] = deque(maxlen=100)
"""Reports that the running test of pytest made, for `pytest_plugin`."""


@dataclass(frozen=True)
class Effort:
    """How hard a sampling pair, or a BSDF from each direction, is looked at."""

    points: int = 10_000
    """of the pointwise checks"""
    jacobian_points: int = 2_000
    """of the Jacobian, at most"""
    mass_tolerance: Optional[float] = None
    """|∫pdf + atoms + rejected share - 1| that a pass allows; None: 5e-5 where the integral is known
    that well, else 1e-3"""
    evaluations: int = 4_000_000
    """of the pdf, at most, to integrate it"""
    first_look: int = 100_000
    """samples that chi-square looks at first"""
    samples: int = 1_000_000
    """samples at its last look"""
    finest_bins: int = 4096
    """of about equal expected mass"""
    deviation: float = 0.0125
    """relative, of the samples' density from the pdf, root mean square over 64 bins, that a pass allows"""

    def contract(self, seed: int) -> _core.ContractOptions:
        """The same for the compiled part."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        return filled(_core.ContractOptions(), seed=seed, **values)


def filled(options: Options, **values: Any) -> Options:
    """Options of the compiled part with values put in, which are checked for their type there."""
    for name, value in values.items():
        try:
            setattr(options, name, value)
        except TypeError:
            raise TypeError(f"{name} = {value!r} has a type that is not understood") from None
    return options


def is_single(dtype: DTypeLike) -> bool:
    """Whether the code under test calculates in float32.

    Raises ValueError for anything but float32 and float64.
    """
    kind = np.dtype(dtype)
    if kind not in (np.dtype(np.float32), np.dtype(np.float64)):
        raise ValueError(f"dtype is {kind}, wanted float32 or float64")
    return kind == np.float32


def checked_numbers(numbers: int) -> int:
    """How many random numbers a sampler takes."""
    if numbers not in (1, 2, 3):
        raise ValueError(f"numbers is {numbers}, wanted 1, 2 or 3")
    return numbers


def needs(**functions: Any) -> None:
    """Raises TypeError for what cannot be called."""
    for name, function in functions.items():
        if not callable(function):
            raise TypeError(f"{name} is a {type(function).__name__}, wanted a function of arrays")


def repeatable(report: _core.Report) -> _core.Report:
    """Says how pytest repeats the test that runs, if it does, and remembers the report for it."""
    test = os.environ.get("PYTEST_CURRENT_TEST", "")
    if test:
        report.replay = f"python3 -m pytest '{test.rpartition(' ')[0]}'"
        OF_TEST.append(report)
    return report
