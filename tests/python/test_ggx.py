"""A rough mirror: a sampler that rejects."""

import numpy as np
from bsdfs import Ggx, check


def test_ggx_passes():
    report = check(Ggx())
    assert report.ok, report


def test_ggx_without_masking_fails():
    class Unmasked(Ggx):
        """Its weight leaves out what the surface hides from the light."""

        def sample(self, wo, u):
            wi, pdf, weight, accepted = super().sample(wo, u)
            return wi, pdf, np.ones_like(weight), accepted

    report = check(Unmasked(), conserves_energy=False, reciprocal=False)
    failed = {result.kind for result in report.results if result.verdict == "fail"}
    assert failed == {"weight"}, report
