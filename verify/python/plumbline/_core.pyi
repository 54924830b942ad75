from typing import Callable, Dict, List, Optional, Sequence, Tuple

from numpy.typing import NDArray

class CheckResult:
    """The outcome of one check. What a kind of check has no use for is None or empty."""

    kind: str
    """what was looked at: "chi_square", "jacobian", "mean" """
    subject: str
    """what was checked, coarse to fine: "lambert/front 30°/integral" """
    verdict: str
    """"pass", "fail" or "inconclusive" """
    expected: str
    """the verdict that the check must give"""
    estimate: Optional[float]
    """in units of the quantity"""
    reference: Optional[float]
    """the known answer, same units"""
    tolerance: Optional[float]
    """largest |bias| that a pass allows, same units"""
    bound: Optional[float]
    """proven: |bias| <= bound with 99.9 % confidence"""
    detectable: Optional[float]
    """smallest effect that fails with 99 % probability"""
    p_value: Optional[float]
    interval: Optional[Tuple[float, float]]
    """99.9 % confidence interval of `estimate`"""
    samples: int
    seconds: float
    leaned_on: str
    reason: str
    advice: str
    bins: List[Tuple[float, float, float, float, float, float, float]]
    """what a chi-square test that failed has counted: ends in x and in y of a bin in the square of
    the domain's chart, samples expected, their standard error, samples observed"""
    waived: str
    """why a failure is put up with; empty: it is not"""
    diagnosis: str
    cause: Optional[str]
    """the diagnosis in a word: "half-vector Jacobian" """
    seed: int
    replay: str
    figures: Dict[str, float]
    """further numbers by name: "chi-square", "bins", "rejected share" """
    ok: bool
    """a pass, and nothing else"""
    as_expected: bool

class Report:
    """What several checks found. As a string: what a person acts on."""

    ok: bool
    """Everything passes that was not skipped, which a check declares. A fail is never ok; nor is a
    report without results. What the report is as a bool, too."""
    as_expected: bool
    """Every result is what its check declares, and there is one."""
    verdict: str
    """"fail" if anything fails; "pass" if it is ok and something passes; else "inconclusive" """
    results: List[CheckResult]
    cause: str
    """what is likely wrong, where one cause explains what was seen; else empty"""
    second_cause: str
    cause_kind: Optional[str]
    """the cause in a word: "half-vector Jacobian" """
    replay: str
    """one command that repeats all"""
    def __init__(self, results: Sequence[CheckResult] = ...) -> None: ...
    def append(self, other: Report) -> None: ...
    def summary(self) -> str: ...
    def __bool__(self) -> bool: ...

class ImageResult:
    check: CheckResult
    tile: int
    """edge of the tiles of `p_map` [pixels]"""
    p_map: NDArray
    """(rows, columns): p-value of each tile; NaN where nothing can be said"""
    histogram: List[float]
    """share of the p-values in each of 20 equal bins"""

class Domain:
    """Where a sampling pair lives, with the measure of its pdf."""

    name: str
    dimension: int
    @staticmethod
    def interval(low: float = 0.0, high: float = 1.0) -> Domain: ...
    @staticmethod
    def discrete(size: int) -> Domain: ...
    @staticmethod
    def unit_square() -> Domain: ...
    @staticmethod
    def disk(radius: float = 1.0) -> Domain: ...
    @staticmethod
    def triangle() -> Domain: ...
    @staticmethod
    def sphere() -> Domain: ...
    @staticmethod
    def hemisphere(upper: bool = True) -> Domain: ...
    @staticmethod
    def equirectangular(
        columns: int,
        rows: int,
        up: Tuple[float, float, float] = ...,
        start: Tuple[float, float, float] = ...,
    ) -> Domain: ...
    @staticmethod
    def octahedral(pixels_per_side: int) -> Domain: ...
    def with_breaks(self, first: Sequence[float], second: Sequence[float] = ...) -> Domain: ...

class ContractOptions:
    seed: int
    points: int
    jacobian_points: int
    mass_tolerance: Optional[float]
    evaluations: int
    first_look: int
    samples: int
    finest_bins: int
    deviation: float

class PairLobe:
    def __init__(
        self,
        domain: Domain,
        name: str,
        probability: float,
        sample: Callable,
        pdf: Callable,
        numbers: int,
        single: bool,
    ) -> None: ...

class SamplingPair:
    many_to_one: bool
    def __init__(
        self,
        name: str,
        domain: Domain,
        sample: Callable,
        pdf: Callable,
        value: Optional[Callable],
        numbers: int,
        single: bool,
    ) -> None: ...
    def add_lobe(self, lobe: PairLobe) -> None: ...
    def add_atom(self, x: Tuple[float, float, float], mass: float) -> None: ...
    def add_suspect(self, name: str, value: Callable) -> None: ...

class BsdfOptions:
    contract: ContractOptions
    angles: List[float]
    random_directions: int
    front: bool
    back: bool
    eta: float
    reciprocal: bool
    conserves_energy: bool
    energy_tolerance: float
    def set_albedo(self, albedo: Callable, single: bool) -> None: ...
    def add_suspect(self, name: str, value: Callable, single: bool) -> None: ...

class Bsdf:
    def __init__(
        self, sample: Callable, pdf: Callable, eval: Callable, numbers: int, single: bool
    ) -> None: ...
    def add_lobe(
        self, probability: Callable, sample: Callable, pdf: Callable, numbers: int
    ) -> None: ...

class MeanOptions:
    subject: str
    seed: int
    reference: float
    tolerance: float
    relative: bool
    rounding_allowance: float
    exact_variance: Optional[float]
    n0: int
    max_samples: int
    def set_expected(self, word: str) -> None: ...

class VarianceRatioOptions:
    subject: str
    seed: int
    at_least: Optional[float]
    at_most: Optional[float]
    def set_expected(self, word: str) -> None: ...

class ProportionOptions:
    subject: str
    seed: int
    at_least: float
    at_most: float
    def set_expected(self, word: str) -> None: ...

class ImageOptions:
    subject: str
    seed: int
    tolerance: float
    rounding_allowance: float
    non_finite: int
    def set_expected(self, word: str) -> None: ...

class ImageChannel:
    def __init__(
        self, mean: NDArray, variance: Optional[NDArray], count: Optional[NDArray]
    ) -> None: ...

def waive(report: Report, waivers: Sequence[Tuple[str, str, str]]) -> Report: ...

CONVENTIONS: Dict[str, str]

def check_pair(pair: SamplingPair, options: ContractOptions) -> Report: ...
def check_bsdf(
    name: str, bsdf: Bsdf, conventions: Sequence[str], options: BsdfOptions
) -> Report: ...
def check_mean(options: MeanOptions, samples: object) -> CheckResult: ...
def check_agreement(options: MeanOptions, a: object, b: object) -> CheckResult: ...
def check_variance_ratio(options: VarianceRatioOptions, a: NDArray, b: NDArray) -> CheckResult: ...
def check_proportion(options: ProportionOptions, hits: int, trials: int) -> CheckResult: ...
def check_image(
    options: ImageOptions, image: ImageChannel, reference: ImageChannel
) -> ImageResult: ...
