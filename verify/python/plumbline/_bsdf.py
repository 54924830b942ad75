"""BSDFs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Callable, Mapping, Optional, Sequence, Tuple

from numpy.typing import DTypeLike

from . import _core
from ._effort import Effort, checked_numbers, filled, is_single, needs, repeatable
from ._samples import Array, BsdfFunction, BsdfSampler


@dataclass(frozen=True)
class Lobe:
    """A lobe of a BSDF that chooses one with a probability: pdf = Σ probability · lobe pdf."""

    probability: Callable[[Array], Array]
    """wo (n, 3) to (n,) [1]"""
    sample: BsdfSampler
    """from this lobe alone"""
    pdf: BsdfFunction
    """of this lobe alone [1/sr]"""
    numbers: int = 2
    """random numbers that `sample` takes"""


def check_bsdf(
    name: str = "bsdf",
    *,
    sample: BsdfSampler,
    pdf: BsdfFunction,
    eval: BsdfFunction,
    numbers: int = 2,
    dtype: DTypeLike = "float64",
    lobes: Sequence[Lobe] = (),
    frame: str = "z-up",
    normal: Tuple[float, float, float] = (0.0, 0.0, 1.0),
    cosine_in_eval: bool = False,
    sampled_direction_first: bool = False,
    given_points_in: bool = False,
    zero_pdf_is_failure: bool = False,
    projected_pdf: bool = False,
    weight: str = "throughput",
    angles: Sequence[float] = (0, 60, 80, 88, 89.9),
    random_directions: int = 1,
    front: bool = True,
    back: bool = True,
    eta: float = 1.0,
    reciprocal: bool = True,
    conserves_energy: bool = True,
    energy_tolerance: float = 1e-3,
    albedo: Optional[Callable[[Array], Array]] = None,
    suspects: Optional[Mapping[str, BsdfFunction]] = None,
    seed: int = 1,
    effort: Effort = Effort(),
) -> _core.Report:
    """The whole battery on a BSDF.

    From each direction: the record and the weight pointwise, support, Jacobian, integral, chi-square,
    albedo, atoms; and reciprocity. On failure the report names the one cause that explains all of
    it, or none. Functions get arrays of up to 65,536 rows and must answer row by row; what they
    raise comes through.

    Args:
        name: of the results, ``name/face angle/check``.
        sample: wo (n, 3) and u (n, numbers) uniform in [0, 1) to ``(wi, pdf, weight, accepted,
            mass)``, or to the first of these, see :class:`Samples`. wi (n, 3) is unit.
        pdf: wo (n, 3), wi (n, 3) to (n,), per steradian [1/sr].
        eval: wo (n, 3), wi (n, 3) to f (n,) or (n, channels) [1/sr], without the cosine.
        numbers: random numbers that `sample` takes, 1 to 3. With three the Jacobian is that of the
            lobes, or skipped visibly.
        dtype: float32 or float64, the arithmetic of the functions: what arrays they get and how
            closely they can be expected to agree. They may return more, not less.
        lobes: of a mixture that exposes them; each is then checked as if it were the whole.
        frame: ``"z-up"``, ``"y-up"`` (local frames), or ``"world"``, around `normal`.
        normal: unit, for ``frame="world"``.
        cosine_in_eval: `eval` returns f·|cosθi| instead of f.
        sampled_direction_first: `eval` and `pdf` take (wi, wo).
        given_points_in: wo points towards the surface, like a ray that arrives.
        zero_pdf_is_failure: a pdf of 0 means that the sample failed.
        projected_pdf: the pdf is per projected solid angle, pdf_w = pdf·|cosθi|.
        weight: what the weight is: ``"throughput"`` (f·|cosθi|/pdf), ``"f"``, ``"f-cosine"``
            (f·|cosθi|), or ``"unused"`` (not checked).
        angles: from the normal [degrees], looked at from both faces at a random azimuth.
        random_directions: more for each face, uniform on the hemisphere.
        front: whether to look from the side of the normal.
        back: whether to look from the other.
        eta: refractive index below the surface over that above, for radiance BSDFs.
        reciprocal: f(wo, wi)/η_o² = f(wi, wo)/η_i² holds.
        conserves_energy: the albedo is at most 1 for every wo and channel.
        energy_tolerance: of the albedo [1].
        albedo: the known directional albedo of the first channel, atoms included: wo (n, 3), in the
            z-up frame whatever `frame` says, to (n,) [1].
        suspects: factors that a wrong pdf may have lost or gained, for the diagnosis: wo (n, 3), wi
            (n, 3), in the z-up frame, to (n,).
        seed: of the random numbers; the same gives the same report.
        effort: how hard to look.

    Raises:
        ValueError: for an array of a wrong shape or dtype, with the function and what was wanted.
    """
    needs(sample=sample, pdf=pdf, eval=eval)
    single = is_single(dtype)
    bsdf = _core.Bsdf(sample, pdf, eval, checked_numbers(numbers), single)
    for lobe in lobes:
        needs(probability=lobe.probability, sample=lobe.sample, pdf=lobe.pdf)
        bsdf.add_lobe(lobe.probability, lobe.sample, lobe.pdf, checked_numbers(lobe.numbers))
    conventions = filled(
        _core.BsdfConventions(),
        cosine_in_eval=cosine_in_eval,
        sampled_direction_first=sampled_direction_first,
        given_points_in=given_points_in,
        normal=normal,
        zero_pdf_is_failure=zero_pdf_is_failure,
        projected_pdf=projected_pdf,
    )
    conventions.set_frame(frame)
    conventions.set_weight(weight)
    options = filled(
        _core.BsdfOptions(),
        contract=effort.contract(seed),
        angles=list(angles),
        random_directions=random_directions,
        front=front,
        back=back,
        eta=eta,
        reciprocal=reciprocal,
        conserves_energy=conserves_energy,
        energy_tolerance=energy_tolerance,
    )
    if albedo is not None:
        options.set_albedo(albedo, single)
    for suspect, value in (suspects or {}).items():
        options.add_suspect(suspect, value, single)
    return repeatable(_core.check_bsdf(name, bsdf, conventions, options))
