"""BSDFs: what is right passes, what is wrong fails, in either arithmetic and by any convention."""

import numpy as np
import pytest
from bsdfs import Lambert, check, cosine_direction

import plumbline


@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_lambert_passes(dtype):
    report = check(Lambert(), dtype=dtype)
    assert report.ok, report


def test_wrong_constant_fails_and_is_named():
    class Twice(Lambert):
        def pdf(self, wo, wi):
            return 2 * super().pdf(wo, wi)

    report = check(Twice(), conserves_energy=False, reciprocal=False)
    assert report.verdict == "fail"
    assert report.cause_kind == "constant", report
    bins = [r.bins for r in report.results if r.kind == "chi_square" and r.verdict == "fail"]
    assert bins and 0 < len(bins[0]) <= 256
    assert "samples than the pdf says" in report._repr_html_()


class Elsewhere:
    """A diffuse reflection by every convention that is not ours: y up, the given direction towards
    the surface and last, pdf per projected solid angle and 0 for what failed, f·|cosθ|."""

    STATED = (
        "y-up",
        "cosine-in-eval",
        "sampled-direction-first",
        "given-points-in",
        "zero-pdf-is-failure",
        "projected-pdf",
        "weight-is-f-cosine",
    )

    def sample(self, arriving, u):
        wi = np.stack(
            [
                np.sqrt(u[:, 0]) * np.cos(2 * np.pi * u[:, 1]),
                np.sqrt(1 - u[:, 0]),
                np.sqrt(u[:, 0]) * np.sin(2 * np.pi * u[:, 1]),
            ],
            axis=-1,
        )
        return wi, self.pdf(wi, arriving), self.eval(wi, arriving)

    def pdf(self, wi, arriving):
        return np.where((wi[:, 1] > 0) & (arriving[:, 1] < 0), 1 / np.pi, 0)

    def eval(self, wi, arriving):
        return 0.5 * self.pdf(wi, arriving) * np.abs(wi[:, 1])


def test_stated_conventions_are_understood():
    report = check(Elsewhere(), conventions=Elsewhere.STATED)
    assert report.ok, report


@pytest.mark.parametrize("left_out", ["cosine-in-eval", "given-points-in"])
def test_a_convention_that_is_not_stated_is_missed(left_out):
    stated = [word for word in Elsewhere.STATED if word != left_out]
    report = check(Elsewhere(), conventions=stated, conserves_energy=False, reciprocal=False)
    assert not report.ok


def test_world_frame_is_around_the_normal():
    normal = np.array([0.6, 0.0, 0.8])
    tangent, bitangent = np.array([0.8, 0.0, -0.6]), np.array([0.0, 1.0, 0.0])
    to_world = np.stack([tangent, bitangent, normal])

    class World(Lambert):
        def sample(self, wo, u):
            wi = cosine_direction(u) @ to_world
            return wi, self.pdf(wo, wi), np.full(len(u), self.albedo), wo @ normal > 0

        def pdf(self, wo, wi):
            return super().pdf(wo @ to_world.T, wi @ to_world.T)

        def eval(self, wo, wi):
            return super().eval(wo @ to_world.T, wi @ to_world.T)

    conventions = "normal:{},{},{}".format(*normal)
    report = check(World(), conventions=conventions, conserves_energy=False, reciprocal=False)
    assert report.ok, report


def test_a_renderers_name_says_all_conventions():
    class Mitsuba(Lambert):
        def eval(self, wo, wi):
            return super().eval(wo, wi) * np.abs(wi[:, 2])

    assert check(Mitsuba(), conventions="mitsuba").ok
    assert not check(Mitsuba(), conventions="pbrt", reciprocal=False).ok
    assert "mitsuba" in plumbline.CONVENTIONS


def test_an_atom_states_its_mass():
    class Mirror:
        def sample(self, wo, u):
            wi = wo * [-1, -1, 1]
            n = len(wo)
            return plumbline.Samples(wi, weight=np.full(n, 0.9), mass=np.ones(n))

        def pdf(self, wo, wi):
            return np.zeros(len(wo))

        eval = pdf

    report = check(Mirror(), conserves_energy=False)
    assert report.ok, report
    assert any(result.kind == "atoms" for result in report.results)


def test_lobes_are_checked_one_by_one():
    class Halves(Lambert):
        def sample(self, wo, u):
            u = np.stack([np.where(u[:, 0] < 0.5, 2 * u[:, 0], 2 * u[:, 0] - 1), u[:, 1]], axis=-1)
            return super().sample(wo, u)

    def wrong(wo, wi):
        return 0.5 * Lambert().pdf(wo, wi)

    for pdf, ok in [(Lambert().pdf, True), (wrong, False)]:
        lobe = plumbline.Lobe(lambda wo: np.full(len(wo), 0.5), Lambert().sample, pdf)
        report = check(Halves(), lobes=[lobe, lobe], conserves_energy=False, reciprocal=False)
        assert report.ok == ok, report


def test_known_albedo_is_held():
    for albedo, ok in [(0.5, True), (0.6, False)]:
        report = check(Lambert(), albedo=lambda wo: np.full(len(wo), albedo), reciprocal=False)
        assert report.ok == ok, report


def test_the_same_seed_gives_the_same_report():
    first, second = (check(Lambert(), conserves_energy=False, reciprocal=False) for _ in range(2))
    assert [r.estimate for r in first.results] == [r.estimate for r in second.results]
