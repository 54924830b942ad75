"""What samplers return, and the types of the functions that checks take."""

from __future__ import annotations

from typing import Callable, NamedTuple, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating]
"""Real numbers: float64, or float32 where dtype says so."""


class Samples(NamedTuple):
    """n samples. A plain tuple of these, or of the first of them, or the points alone will do.

    Where a record states nothing about something, that is None and not checked.
    """

    points: Array
    """wi (n, 3) of a BSDF; of other pairs points of the domain, (n, 3), (n, 2) or (n,)"""
    pdf: Optional[Array] = None
    """(n,), the density that the record states; per steradian for directions"""
    weight: Optional[Array] = None
    """(n,) or (n, channels), f·|cosθ|/pdf [1] unless a convention says otherwise"""
    accepted: Optional[NDArray[np.bool_]] = None
    """(n,); False: the sample was rejected, and nothing else in its row counts. None: all are accepted"""
    mass: Optional[Array] = None
    """(n,), > 0: an atom (mirror, point light) that was chosen with this probability [1], 0: a density"""


Sampled = Union[Samples, Tuple[Optional[NDArray], ...], NDArray]
"""What a sampler may return."""

BsdfSampler = Callable[[Array, Array], Sampled]
"""wo (n, 3), u (n, numbers) in [0, 1) to :class:`Samples`"""
BsdfFunction = Callable[[Array, Array], Array]
"""wo (n, 3), wi (n, 3) to (n,), or where colours are understood (n, channels)"""
Sampler = Callable[[Array], Sampled]
"""u (n, numbers) in [0, 1) to :class:`Samples`"""
PointFunction = Callable[[NDArray], Array]
"""points (n, 3), (n, 2) or (n,) to (n,), or where colours are understood (n, channels)"""
