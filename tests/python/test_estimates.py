"""Means, agreement, ratios, proportions and images, each both ways."""

import numpy as np
import pytest

import plumbline

N = 400_000


def uniform(seed=1, n=N):
    return np.random.default_rng(seed).random(n)


def test_mean_of_an_array():
    assert plumbline.check_mean(uniform(), reference=0.5, tolerance=0.02).ok
    assert plumbline.check_mean(uniform(), reference=0.55, tolerance=0.02).verdict == "fail"
    few = plumbline.check_mean(uniform(n=100), reference=0.5, tolerance=0.02)
    assert few.verdict == "inconclusive" and not few.ok


def test_mean_of_a_function_of_how_many_were_drawn():
    asked = []

    def draw(first, count):
        asked.append((first, count))
        return uniform(seed=first, n=count).astype(np.float32)

    assert plumbline.check_mean(draw, reference=0.5, tolerance=0.005).ok
    starts = [first for first, _ in asked]
    assert starts == list(np.cumsum([0] + [count for _, count in asked])[:-1])
    assert max(count for _, count in asked) <= 65536


def test_a_mean_that_is_not_finite_fails():
    samples = uniform()
    samples[100] = np.nan
    report = plumbline.check_mean(samples, reference=0.5, tolerance=0.02)
    assert report.verdict == "fail"
    assert report.results[0].figures["non-finite"] == 1


def test_a_declared_verdict_is_compared():
    report = plumbline.check_mean(uniform(), reference=0.6, tolerance=0.02, expected="fail")
    assert report.as_expected and not report.ok


def test_agreement():
    assert plumbline.check_agreement(uniform(1), 1 - uniform(2), tolerance=0.02).ok
    assert plumbline.check_agreement(uniform(1), uniform(2) ** 2, tolerance=0.02).verdict == "fail"


def test_variance_ratio_of_samples_in_batches():
    a, b = uniform(1).reshape(64, -1), np.sqrt(3) * uniform(2).reshape(64, -1)
    assert plumbline.check_variance_ratio(b, a, at_least=2.8, at_most=3.2).ok
    assert plumbline.check_variance_ratio(b, a, at_most=2.0).verdict == "fail"


def test_variance_ratio_of_statistics():
    a, b = 1 + 0.01 * uniform(1, 64), 2 + 0.01 * uniform(2, 64)
    assert plumbline.check_variance_ratio(b, a, at_least=1.9, at_most=2.1).ok
    with pytest.raises(ValueError):
        plumbline.check_variance_ratio(a, a.reshape(8, 8))
    with pytest.raises(ValueError):
        plumbline.check_variance_ratio(a[:15], b[:15])


def test_proportion():
    assert plumbline.check_proportion(500, 1000, at_least=0.4, at_most=0.6).ok
    assert plumbline.check_proportion(500, 1000, at_most=0.2).verdict == "fail"


@pytest.mark.parametrize("samples", [np.ones((3, 4)), np.ones(0)])
def test_samples_of_a_wrong_shape_are_refused(samples):
    with pytest.raises(ValueError, match="samples has shape"):
        plumbline.check_mean(samples, reference=1)


def test_a_function_that_draws_too_few_is_refused():
    with pytest.raises(ValueError, match=r"returned by samples has shape \(3,\), wanted \(1250,\)"):
        plumbline.check_mean(lambda first, count: np.ones(3), reference=1)


def test_a_tolerance_that_makes_no_sense_is_refused():
    with pytest.raises(ValueError):
        plumbline.check_mean(uniform(), reference=0, tolerance=0.1)


def render(level=1.0, count=64, seed=1, shape=(48, 64, 3)):
    """The mean and the variance of samples that are uniform in [0, 2·level]."""
    samples = 2 * level * np.random.default_rng(seed).random((count, *shape))
    return plumbline.Image(samples.mean(axis=0), samples.var(axis=0, ddof=1), count)


def test_image_against_an_exact_one():
    exact = np.ones((48, 64, 3))
    report = plumbline.check_image(render(), exact, name="flat")
    assert report.ok, report
    assert [r.subject for r in report.results] == ["flat/0", "flat/1", "flat/2"]
    report = plumbline.check_image(render(level=1.1), exact)
    assert report.verdict == "fail"


def test_image_against_another_render():
    assert plumbline.check_image(render(seed=1), render(seed=2)).ok


def test_image_shows_where_it_differs():
    exact = np.ones((64, 64))
    image = render(shape=(64, 64))
    image.mean[:16, 16:32] *= 1.5
    report = plumbline.check_image(image, exact)
    assert report.verdict == "fail"
    tiles = report.images[0].p_map
    edge = report.images[0].tile
    assert tiles.shape == (64 // edge, 64 // edge)
    y, x = np.unravel_index(np.nanargmin(tiles), tiles.shape)
    assert y * edge < 16 and 16 <= x * edge < 32
    assert "<svg" in report._repr_html_()


def test_images_of_wrong_shapes_are_refused():
    with pytest.raises(ValueError, match="variance has shape"):
        plumbline.check_image(plumbline.Image(np.ones((4, 4)), np.ones(4), 1), np.ones((4, 4)))
    with pytest.raises(ValueError, match="differ in size"):
        plumbline.check_image(np.ones((4, 4)), np.ones((4, 5)))
    with pytest.raises(ValueError, match="3 channels, the reference 1"):
        plumbline.check_image(np.ones((4, 4, 3)), np.ones((4, 4)))
