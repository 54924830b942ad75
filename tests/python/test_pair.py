"""Samplers over every kind of domain."""

import numpy as np
import pytest
from bsdfs import QUICK, cosine_direction

import plumbline


def polar_disk(u):
    radius, phi = np.sqrt(u[:, 0]), 2 * np.pi * u[:, 1]
    return np.stack([radius * np.cos(phi), radius * np.sin(phi)], axis=-1)


def without_root(u):
    return polar_disk(np.stack([u[:, 0] ** 2, u[:, 1]], axis=-1))


def folded(u):
    return np.where(np.sum(u, axis=-1, keepdims=True) > 1, 1 - u, u)


def uniform_sphere(u):
    z, phi = 1 - 2 * u[:, 0], 2 * np.pi * u[:, 1]
    radius = np.sqrt(1 - z * z)
    return np.stack([radius * np.cos(phi), radius * np.sin(phi), z], axis=-1)


def constant(value):
    return lambda x: np.full(len(x), value)


def check(sample, pdf, domain, **options):
    options = {"seed": 3, "effort": QUICK, **options}
    return plumbline.check_pair(sample=sample, pdf=pdf, domain=domain, **options)


RIGHT = {
    "sphere": (uniform_sphere, constant(1 / (4 * np.pi)), "sphere", {}),
    "hemisphere": (cosine_direction, lambda w: w[:, 2] / np.pi, "hemisphere", {}),
    "disk": (polar_disk, constant(1 / np.pi), "disk", {}),
    "large disk": (
        lambda u: 2 * polar_disk(u),
        constant(1 / (4 * np.pi)),
        plumbline.Domain.disk(2),
        {},
    ),
    "square": (lambda u: u, constant(1.0), "unit_square", {}),
    "triangle": (folded, constant(2.0), "triangle", {"many_to_one": True}),
    "interval": (lambda u: np.sqrt(u[:, 0]), lambda x: 2 * x, "interval", {}),
    "discrete": (
        lambda u: np.searchsorted([0.2, 0.5], u[:, 0], side="right"),
        lambda i: np.array([0.2, 0.3, 0.5])[i],
        plumbline.Domain.discrete(3),
        {},
    ),
}


@pytest.mark.parametrize("case", RIGHT)
def test_right_pairs_pass(case):
    sample, pdf, domain, options = RIGHT[case]
    report = check(sample, pdf, domain, **options)
    assert report.ok, report


WRONG = {
    "disk": (without_root, constant(1 / np.pi), "disk"),
    "interval": (lambda u: u[:, 0], lambda x: 2 * x, "interval"),
    "discrete": (
        lambda u: np.searchsorted([0.2, 0.5], u[:, 0], side="right"),
        lambda i: np.array([0.3, 0.2, 0.5])[i],
        plumbline.Domain.discrete(3),
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_wrong_pairs_fail(case):
    sample, pdf, domain = WRONG[case]
    report = check(sample, pdf, domain)
    assert report.verdict == "fail", report


def test_points_of_a_domain_have_its_shape():
    shapes = {}

    def keep(name, x):
        shapes[name] = (x.dtype.name, x.shape[1:])
        return np.ones(len(x))

    check(lambda u: u[:, 0], lambda x: keep("interval", x), "interval", dtype="float32")
    check(lambda u: u, lambda x: keep("square", x), "unit_square")
    check(lambda u: np.zeros(len(u), int), lambda x: keep("one", x), plumbline.Domain.discrete(1))
    assert shapes == {"interval": ("float32", ()), "square": ("float64", (2,)), "one": ("int64", ())}


def test_value_is_held_against_the_weight():
    for factor, ok in [(1.0, True), (1.1, False)]:
        report = check(
            lambda u: (u[:, 0], np.ones(len(u)), factor * np.exp(u[:, 0])),
            constant(1.0),
            "interval",
            value=np.exp,
        )
        assert report.ok == ok, report


def test_lobes_of_a_mixture():
    def sample(u):
        low = u[:, 0] < 0.25
        rest = np.where(low, u[:, 0] / 0.25, (u[:, 0] - 0.25) / 0.75)
        return np.where(low, rest, np.sqrt(rest))

    lobes = [
        plumbline.PairLobe(0.25, lambda u: u[:, 0], constant(1.0), name="flat"),
        plumbline.PairLobe(0.75, lambda u: np.sqrt(u[:, 0]), lambda x: 2 * x, name="rising"),
    ]
    report = check(sample, lambda x: 0.25 + 1.5 * x, "interval", lobes=lobes)
    assert report.ok, report


def test_an_unknown_domain_is_refused():
    with pytest.raises(ValueError, match='domain is "ball", wanted a Domain or one of "interval"'):
        check(uniform_sphere, constant(1.0), "ball")
