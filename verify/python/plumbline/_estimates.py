"""Means, agreement of two estimates, ratios of variances, proportions."""

from __future__ import annotations

from typing import Callable, Optional, Union

from numpy.typing import ArrayLike, NDArray
import numpy as np

from . import _core
from ._effort import filled, repeatable
from ._samples import Array

DrawSamples = Union[NDArray, Callable[[int, int], Array]]
"""Independent samples (n,), or a function that draws them: (first, count) to (count,), where `first`
is how many were drawn before."""


def _samples(samples: DrawSamples, name: str) -> Union[NDArray, Callable[[int, int], Array]]:
    if callable(samples):
        return samples
    array = np.asarray(samples)
    if array.ndim != 1 or array.size == 0:
        raise ValueError(f"{name} has shape {array.shape}, wanted (n,)")
    return array


def _mean_options(expected: str, **values: object) -> _core.MeanOptions:
    options = filled(_core.MeanOptions(), **values)
    options.set_expected(expected)
    return options


def check_mean(
    samples: DrawSamples,
    *,
    reference: float,
    tolerance: float = 0.005,
    relative: bool = True,
    name: str = "mean",
    rounding_allowance: float = 1e-5,
    exact_variance: Optional[float] = None,
    n0: int = 1250,
    max_samples: int = 1 << 26,
    expected: str = "pass",
    seed: int = 0,
) -> _core.Report:
    """Shows that the mean of an estimator is what it should be, or that it is not.

    Looks at growing numbers of samples: passes when |bias| <= tolerance is proven with 99.9 %
    confidence, fails when bias != 0 is proven, else stays inconclusive, with the bound proven.

    Args:
        samples: independent samples (n,), of which only as many are looked at as a verdict needs,
            or a function (first, count) to (count,) that draws them. One that is not finite fails.
        reference: the known answer, in the units of the samples.
        tolerance: largest |bias| that a pass allows; relative to |reference|, or in its units.
        relative: whether `tolerance` and `rounding_allowance` are; not where the reference is 0.
        name: of the result.
        rounding_allowance: a bias proven to exceed it fails, also below the tolerance.
        exact_variance: of one sample, where a closed form gives it [units²].
        n0: samples at the first look.
        max_samples: where it stays undecided.
        expected: the verdict it must give: ``"pass"``, ``"fail"`` or ``"inconclusive"``.
        seed: of the samples, for the report.

    Raises:
        ValueError: for samples of a wrong shape or dtype, a tolerance or a cap that makes no sense.
    """
    options = _mean_options(
        expected,
        subject=name,
        reference=reference,
        tolerance=tolerance,
        relative=relative,
        rounding_allowance=rounding_allowance,
        exact_variance=exact_variance,
        n0=n0,
        max_samples=max_samples,
        seed=seed,
    )
    result = _core.check_mean(options, _samples(samples, "samples"))
    return repeatable(_core.Report([result]))


def check_agreement(
    a: DrawSamples,
    b: DrawSamples,
    *,
    tolerance: float = 0.005,
    relative: bool = True,
    difference: float = 0.0,
    name: str = "agreement",
    rounding_allowance: float = 1e-5,
    n0: int = 1250,
    max_samples: int = 1 << 26,
    expected: str = "pass",
    seed: int = 0,
) -> _core.Report:
    """Shows that two estimators have the same mean, or that they have not.

    Args:
        a: independent samples (n,), or a function (first, count) to (count,) that draws them.
        b: the same of the other; independent of a.
        tolerance: largest |difference of means| that a pass allows; relative to the mean of both.
        relative: whether `tolerance` and `rounding_allowance` are, or in the units of the samples.
        difference: a - b that is expected, in the units of the samples.
        name: of the result.
        rounding_allowance: a difference proven to exceed it fails, also below the tolerance.
        n0: samples of each at the first look.
        max_samples: of each, where it stays undecided.
        expected: the verdict it must give.
        seed: of the samples, for the report.

    Raises:
        ValueError: for samples of a wrong shape or dtype, or a tolerance that makes no sense.
    """
    options = _mean_options(
        expected,
        subject=name,
        reference=difference,
        tolerance=tolerance,
        relative=relative,
        rounding_allowance=rounding_allowance,
        n0=n0,
        max_samples=max_samples,
        seed=seed,
    )
    result = _core.check_agreement(options, _samples(a, "a"), _samples(b, "b"))
    return repeatable(_core.Report([result]))


def check_variance_ratio(
    a: ArrayLike,
    b: ArrayLike,
    *,
    at_least: Optional[float] = None,
    at_most: Optional[float] = None,
    name: str = "variance ratio",
    expected: str = "pass",
    seed: int = 0,
) -> _core.Report:
    """Shows that variance(a)/variance(b) keeps a claim, or that it does not.

    Args:
        a: samples (batches, samples per batch), or one non-negative statistic (batches,) for each
            batch: a mean variance over pixels, a mean squared error. At least 16 batches.
        b: the same of the other. Batches with the same index may share their random numbers.
        at_least: the claim ratio >= this; without a claim the ratio is measured.
        at_most: the claim ratio <= this.
        name: of the result.
        expected: the verdict it must give.
        seed: of the samples, for the report.

    Raises:
        ValueError: for fewer than 16 batches, unequally many, or a wrong shape or dtype.
    """
    options = filled(
        _core.VarianceRatioOptions(), subject=name, at_least=at_least, at_most=at_most, seed=seed
    )
    options.set_expected(expected)
    result = _core.check_variance_ratio(options, np.asarray(a), np.asarray(b))
    return repeatable(_core.Report([result]))


def check_proportion(
    hits: int,
    trials: int,
    *,
    at_least: float = 0.0,
    at_most: float = 1.0,
    name: str = "proportion",
    expected: str = "pass",
    seed: int = 0,
) -> _core.Report:
    """Shows that a probability keeps a claim, or that it does not.

    Args:
        hits: how often it happened.
        trials: of how many independent trials.
        at_least: the claim probability >= this.
        at_most: the claim probability <= this.
        name: of the result.
        expected: the verdict it must give.
        seed: of the trials, for the report.

    Raises:
        ValueError: for counts or a claim that make no sense.
    """
    options = filled(
        _core.ProportionOptions(), subject=name, at_least=at_least, at_most=at_most, seed=seed
    )
    options.set_expected(expected)
    return repeatable(_core.Report([_core.check_proportion(options, hits, trials)]))
