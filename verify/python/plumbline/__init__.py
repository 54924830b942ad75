"""Does sampling code do what it says?

Plumbline's checks for functions of NumPy arrays: BSDFs, lights, warps, estimates, images. Each check
returns a :class:`Report`; a pass is a proof with a stated bound, a fail is a proof of a difference,
everything else is inconclusive::

    report = plumbline.check_bsdf("lambert", sample=sample, pdf=pdf, eval=f)
    assert report.ok, report

Directions are unit vectors that point away from the surface, in the local frame with z the normal,
unless a convention says otherwise. A density names its measure: of directions it is per steradian.
"""

from ._bsdf import Lobe, check_bsdf
from ._core import CONVENTIONS, CheckResult, Domain, ImageResult, Report
from ._effort import Effort
from ._estimates import check_agreement, check_mean, check_proportion, check_variance_ratio
from ._html import html_of_report
from ._image import Image, ImageReport, check_image
from ._pair import PairLobe, check_pair
from ._samples import Samples
from ._waivers import Waiver, waive

Report._repr_html_ = html_of_report  # type: ignore[attr-defined, method-assign]

__all__ = [
    "CONVENTIONS",
    "CheckResult",
    "Domain",
    "Effort",
    "Image",
    "ImageReport",
    "ImageResult",
    "Lobe",
    "PairLobe",
    "Report",
    "Samples",
    "Waiver",
    "check_agreement",
    "check_bsdf",
    "check_image",
    "check_mean",
    "check_pair",
    "check_proportion",
    "check_variance_ratio",
    "waive",
]
