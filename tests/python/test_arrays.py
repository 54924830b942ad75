"""What crosses the border: shapes, dtypes, exceptions."""

import numpy as np
import pytest
from bsdfs import ONE_VIEW, Lambert, check

import plumbline


class Changed(Lambert):
    """A diffuse reflection with one of its functions replaced."""

    def __init__(self, **functions):
        super().__init__()
        self.__dict__.update(functions)


def wrong_sample(change):
    """`sample` with its tuple changed."""
    return lambda wo, u: change(*Lambert().sample(wo, u))


REFUSED = {
    "pdf returned by sample has shape": wrong_sample(lambda wi, pdf, w, a: (wi, pdf[:, None], w, a)),
    "points returned by sample has shape": wrong_sample(lambda wi, pdf, w, a: (wi[:, :2], pdf, w, a)),
    "weight returned by sample has shape": wrong_sample(lambda wi, pdf, w, a: (wi, pdf, w[:0], a)),
    "accepted returned by sample has dtype float64, wanted bool": wrong_sample(
        lambda wi, pdf, w, a: (wi, pdf, w, pdf)
    ),
    "mass returned by sample has dtype complex128, wanted real": wrong_sample(
        lambda wi, pdf, w, a: (wi, pdf, w, a, pdf + 0j)
    ),
    "returned a tuple of 6, wanted": wrong_sample(lambda wi, pdf, w, a: (wi, pdf, w, a, None, None)),
    "returned by sample is a NoneType, not an array": lambda wo, u: None,
    "points returned by sample has dtype float32, wanted float64": wrong_sample(
        lambda wi, pdf, w, a: (wi.astype(np.float32), pdf, w, a)
    ),
}


@pytest.mark.parametrize("message", REFUSED)
def test_what_sample_gives_wrongly_is_refused_by_name(message):
    with pytest.raises(ValueError, match=message):
        check(Changed(sample=REFUSED[message]))


@pytest.mark.parametrize("function", ["pdf", "eval"])
def test_a_number_for_an_array_is_refused(function):
    message = rf"the array returned by {function} has shape \(\), wanted \(\d+,\)"
    functions = dict(sample=Lambert().sample, pdf=Lambert().pdf, eval=Lambert().eval)
    functions[function] = lambda wo, wi: 0.3
    with pytest.raises(ValueError, match=message):
        plumbline.check_bsdf(**functions, **ONE_VIEW)


def test_arrays_have_the_shapes_and_dtypes_that_are_promised():
    seen = set()

    class Seen(Lambert):
        def sample(self, wo, u):
            seen.add(("sample", wo.dtype.name, wo.shape[1:], u.dtype.name, u.shape[1:]))
            assert len(wo) == len(u) and np.all((u >= 0) & (u < 1))
            return super().sample(wo, u)

        def pdf(self, wo, wi):
            seen.add(("pdf", wo.dtype.name, wo.shape[1:], wi.dtype.name, wi.shape[1:]))
            return super().pdf(wo, wi)

    assert check(Seen(), dtype=np.float32, numbers=3, conserves_energy=False, reciprocal=False).ok
    assert seen == {
        ("sample", "float32", (3,), "float32", (3,)),
        ("pdf", "float32", (3,), "float32", (3,)),
    }


def test_any_layout_of_an_array_is_read():
    class Odd(Lambert):
        def sample(self, wo, u):
            wi, pdf, weight, accepted = super().sample(wo, u)
            big_endian = pdf.astype(">f8")
            weight = np.stack([weight] * 3, axis=-1)
            return np.asfortranarray(wi), np.repeat(big_endian, 2)[::2], weight, accepted

        def eval(self, wo, wi):
            return np.broadcast_to(super().eval(wo, wi), (3, len(wi))).T

    report = check(Odd(), conserves_energy=False)
    assert report.ok, report


def test_an_array_that_is_kept_keeps_its_values():
    kept = []

    class Keeps(Lambert):
        def pdf(self, wo, wi):
            if len(kept) < 50:
                kept.append((wi, wi.copy()))
            return super().pdf(wo, wi)

    check(Keeps(), conserves_energy=False, reciprocal=False)
    assert all(np.array_equal(wi, copy) for wi, copy in kept)


@pytest.mark.parametrize("function", ["sample", "pdf", "eval"])
@pytest.mark.parametrize("error", [ZeroDivisionError, KeyboardInterrupt])
def test_exceptions_come_through(function, error):
    raised = error("of the user")

    def raises(*arrays):
        raise raised

    with pytest.raises(error) as caught:
        check(Changed(**{function: raises}))
    assert caught.value is raised


def test_an_interrupt_is_heard_where_no_python_runs():
    import _thread

    answered = []

    class Stops(Lambert):
        def pdf(self, wo, wi):
            if len(answered) == 10:
                _thread.interrupt_main()
            answered.append(len(wi))
            return super().pdf(wo, wi)

    with pytest.raises(KeyboardInterrupt):
        check(Stops())


@pytest.mark.parametrize(
    "options, error",
    [
        (dict(numbers=4), ValueError),
        (dict(dtype="float16"), ValueError),
        (dict(conventions="x-up"), ValueError),
        (dict(conventions=["y-up", "mitsuba"]), ValueError),
        (dict(eta="glass"), TypeError),
        (dict(albedo=lambda wo: 0.5), ValueError),
    ],
)
def test_options_that_make_no_sense_are_refused(options, error):
    with pytest.raises(error):
        check(Lambert(), **options)


def test_what_cannot_be_called_is_refused():
    with pytest.raises(TypeError, match="pdf is a float"):
        plumbline.check_bsdf(sample=Lambert().sample, pdf=0.3, eval=Lambert().eval)
