"""Lights, warps, maps, phase functions: a sampler with its density over a domain."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from . import _core
from ._effort import Effort, checked_numbers, is_single, needs, repeatable
from ._samples import PointFunction, Sampler

_NAMED = {
    "interval": _core.Domain.interval,
    "unit_square": _core.Domain.unit_square,
    "disk": _core.Domain.disk,
    "triangle": _core.Domain.triangle,
    "sphere": _core.Domain.sphere,
    "hemisphere": _core.Domain.hemisphere,
}


@dataclass(frozen=True)
class PairLobe:
    """A lobe of a sampler that chooses one with a probability: pdf = Σ probability · lobe pdf."""

    probability: float
    """[1]"""
    sample: Sampler
    """from this lobe alone, by as many numbers as the domain has dimensions"""
    pdf: PointFunction
    """of this lobe alone, in the measure of the domain"""
    name: str = ""


def domain_of(domain: Union[str, _core.Domain]) -> _core.Domain:
    """A domain, or the one that a word stands for."""
    if isinstance(domain, _core.Domain):
        return domain
    if domain not in _NAMED:
        known = ", ".join(f'"{name}"' for name in _NAMED)
        raise ValueError(f'domain is "{domain}", wanted a Domain or one of {known}')
    return _NAMED[domain]()


def _triple(point: ArrayLike) -> Tuple[float, float, float]:
    values = np.atleast_1d(np.asarray(point, dtype=float))
    if values.ndim != 1 or values.size > 3:
        raise ValueError(f"an atom's point has shape {values.shape}, wanted (1,), (2,) or (3,)")
    padded = np.zeros(3)
    padded[: values.size] = values
    return (float(padded[0]), float(padded[1]), float(padded[2]))


def check_pair(
    name: str = "pair",
    *,
    sample: Sampler,
    pdf: PointFunction,
    domain: Union[str, _core.Domain] = "sphere",
    value: Optional[PointFunction] = None,
    numbers: Optional[int] = None,
    dtype: DTypeLike = "float64",
    lobes: Sequence[PairLobe] = (),
    many_to_one: bool = False,
    atoms: Sequence[Tuple[ArrayLike, float]] = (),
    suspects: Optional[Mapping[str, PointFunction]] = None,
    seed: int = 1,
    effort: Effort = Effort(),
) -> _core.Report:
    """The whole battery on a sampler with its density.

    The record pointwise, support, Jacobian, integral, chi-square. Points are (n, 3) for directions,
    (n, 2) for disk, triangle and square, (n,) for intervals and, as int64, for discrete domains.

    Args:
        name: of the results, ``name/check``.
        sample: u (n, numbers) uniform in [0, 1) to ``(points, pdf, weight, accepted, mass)``, or
            to the first of these, see :class:`Samples`.
        pdf: points to (n,), in the measure of the domain: 1/sr for directions, per area, per unit,
            or a probability.
        domain: ``"sphere"``, ``"hemisphere"``, ``"disk"``, ``"triangle"``, ``"unit_square"``,
            ``"interval"`` ([0, 1]), or a :class:`Domain`.
        value: what weight · pdf must equal, points to (n,) or (n, channels); None: there is no weight.
        numbers: random numbers that `sample` takes, 1 to 3; None: as many as the domain has
            dimensions, and one for a discrete domain.
        dtype: float32 or float64, the arithmetic of the functions.
        lobes: of a mixture; each is then checked as if it were the whole.
        many_to_one: several u lead to the same point: the Jacobian is followed branch by branch or
            skipped visibly.
        atoms: points with a probability that are known beforehand: (point, mass).
        suspects: factors that a wrong pdf may have lost or gained, for the diagnosis: points to (n,).
        seed: of the random numbers; the same gives the same report.
        effort: how hard to look.

    Raises:
        ValueError: for an array of a wrong shape or dtype, with the function and what was wanted.
    """
    needs(sample=sample, pdf=pdf)
    where, single = domain_of(domain), is_single(dtype)
    natural = max(1, where.dimension)
    taken = checked_numbers(natural if numbers is None else numbers)
    pair = _core.SamplingPair(name, where, sample, pdf, value, taken, single)
    pair.many_to_one = many_to_one
    for index, lobe in enumerate(lobes):
        needs(sample=lobe.sample, pdf=lobe.pdf)
        title = lobe.name or f"lobe {index}"
        pair.add_lobe(
            _core.PairLobe(where, title, lobe.probability, lobe.sample, lobe.pdf, natural, single)
        )
    for point, mass in atoms:
        pair.add_atom(_triple(point), mass)
    for suspect, factor in (suspects or {}).items():
        pair.add_suspect(suspect, factor)
    return repeatable(_core.check_pair(pair, effort.contract(seed)))
