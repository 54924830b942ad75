"""BSDFs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Callable, Mapping, Optional, Sequence, Union

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
    conventions: Union[str, Sequence[str]] = (),
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
    it, or none. Functions get arrays of up to 8,192 rows and must answer row by row; what they
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
        conventions: where the functions write things down otherwise, words of
            `plumbline.CONVENTIONS`: a renderer's name, which says all (``"mitsuba"``), before single
            ones (``"y-up"``), and ``"normal:X,Y,Z"`` for directions in world space around that
            normal.
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
        ValueError: for an array of a wrong shape or dtype, with the function and what was wanted;
            for a convention that is not known.
    """
    needs(sample=sample, pdf=pdf, eval=eval)
    single = is_single(dtype)
    bsdf = _core.Bsdf(sample, pdf, eval, checked_numbers(numbers), single)
    for lobe in lobes:
        needs(probability=lobe.probability, sample=lobe.sample, pdf=lobe.pdf)
        bsdf.add_lobe(lobe.probability, lobe.sample, lobe.pdf, checked_numbers(lobe.numbers))
    words = [conventions] if isinstance(conventions, str) else list(conventions)
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
    return repeatable(_core.check_bsdf(name, bsdf, words, options))
