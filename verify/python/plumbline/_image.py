"""Images."""

from __future__ import annotations

from dataclasses import dataclass
from typing import List, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._effort import filled, repeatable


@dataclass(frozen=True)
class Image:
    """A render, or an exact answer."""

    mean: ArrayLike
    """(height, width) or (height, width, channels): estimate, or exact value, of each pixel"""
    variance: Optional[ArrayLike] = None
    """the same shape: unbiased, of *one* sample; None: not known, or exact"""
    count: Optional[ArrayLike] = None
    """a number, (height, width), or the shape of `mean`: samples of each pixel; where `variance` is"""

    def layers(self) -> "List[_core.ImageChannel]":
        """A channel each."""
        mean = np.asarray(self.mean)
        if mean.ndim not in (2, 3) or mean.size == 0:
            raise ValueError(
                f"mean has shape {mean.shape}, wanted (height, width) or (height, width, channels)"
            )
        if (self.variance is None) != (self.count is None):
            raise ValueError("variance and count come together")
        layers = [mean, _layer(self.variance, mean, "variance"), _layer(self.count, mean, "count")]
        if mean.ndim == 2:
            return [_core.ImageChannel(*layers)]
        split = [[None if x is None else x[..., c] for x in layers] for c in range(mean.shape[2])]
        return [_core.ImageChannel(*channel) for channel in split]


class ImageReport(_core.Report):
    """A report with what the check of each channel found where."""

    images: List[_core.ImageResult]


def _layer(layer: Optional[ArrayLike], mean: NDArray, name: str) -> Optional[NDArray]:
    if layer is None:
        return None
    array = np.asarray(layer)
    if name == "count" and array.shape == mean.shape[:2] and mean.ndim == 3:
        array = array[..., np.newaxis]
    elif array.shape != mean.shape and not (name == "count" and array.ndim == 0):
        raise ValueError(f"{name} has shape {array.shape}, wanted {mean.shape}")
    return np.broadcast_to(array, mean.shape)


ImageLike = Union[Image, ArrayLike]
"""An :class:`Image`, or its mean alone."""


def _image(image: ImageLike) -> Image:
    return image if isinstance(image, Image) else Image(image)


def check_image(
    image: ImageLike,
    reference: ImageLike,
    *,
    tolerance: float = 0.01,
    name: str = "image",
    rounding_allowance: float = 1e-5,
    non_finite: int = 0,
    expected: str = "pass",
    seed: int = 0,
) -> ImageReport:
    """Holds an image against a reference: the global mean, tiles of 64 to 2 pixels, single pixels.

    Each channel is a check of its own. The mean is proven to be within the tolerance or to differ;
    tiles and pixels can only fail. Noise comes from the variance layers of both; where neither has
    one it is estimated from the residuals in each tile, and single pixels are not judged.

    Args:
        image: an :class:`Image`, or its mean (height, width) or (height, width, channels).
        reference: the same; without a variance it is exact, averaged over each pixel's footprint.
        tolerance: bias of the global mean that a pass allows, relative to the reference's mean.
        name: of the results; with several channels ``name/channel``.
        rounding_allowance: relative, of each pixel.
        non_finite: samples that were not finite: any fails.
        expected: the verdict that each channel must give.
        seed: of the render, for the report.

    Returns:
        a :class:`Report` with `images`: for each channel an :class:`ImageResult` with `p_map`, the
        p-value of each tile (rows, columns), `tile`, its edge [pixels], and `histogram`, the share
        of the p-values in each of 20 equal bins.

    Raises:
        ValueError: for layers of a wrong shape or dtype, or sizes that differ.
    """
    ours, theirs = _image(image).layers(), _image(reference).layers()
    if len(ours) != len(theirs):
        raise ValueError(f"the image has {len(ours)} channels, the reference {len(theirs)}")
    images = []
    for channel, (one, other) in enumerate(zip(ours, theirs)):
        options = filled(
            _core.ImageOptions(),
            subject=name if len(ours) == 1 else f"{name}/{channel}",
            tolerance=tolerance,
            rounding_allowance=rounding_allowance,
            non_finite=non_finite,
            seed=seed,
        )
        options.set_expected(expected)
        images.append(_core.check_image(options, one, other))
    report = ImageReport([image.check for image in images])
    report.images = images
    repeatable(report)
    return report
