"""What people see of a report."""

import datetime

import numpy as np
import pytest

import plumbline


def failing():
    return plumbline.check_mean(np.full(30_000, 0.6), reference=0.5, name="<b>mean</b>")


def test_a_report_in_an_assertion_shows_its_summary():
    with pytest.raises(AssertionError) as caught:
        report = failing()
        assert report.ok, report
    assert "<Report: <b>mean</b>: mean check gives fail, expected pass>" in str(caught.value)
    assert "mean check gives fail, expected pass" in str(failing())
    assert str(failing()) == failing().summary()


def test_the_summary_says_how_pytest_repeats_the_test():
    assert failing().replay.endswith("test_the_summary_says_how_pytest_repeats_the_test'")


def test_results_say_what_was_found():
    (result,) = failing().results
    assert result.kind == "mean" and result.verdict == "fail" and result.expected == "pass"
    assert result.estimate == pytest.approx(0.6) and result.reference == 0.5
    assert result.bound >= 0.1 and result.samples > 0 and result.interval is not None
    assert result.reason and not result.ok
    assert "mean check gives fail" in str(result)


def test_reports_can_be_put_together():
    report = plumbline.check_mean(np.full(30_000, 0.5), reference=0.5)
    assert report.ok
    report.append(failing())
    assert len(report.results) == 2 and report.verdict == "fail"
    assert not plumbline.Report().ok


def test_html_is_escaped_and_says_the_verdict():
    html = failing()._repr_html_()
    assert "<b>mean</b>" not in html and "&lt;b&gt;mean&lt;/b&gt;" in html
    assert "fail" in html


def test_type_stubs_name_what_is_there():
    import ast
    from pathlib import Path

    from plumbline import _core

    tree = ast.parse((Path(plumbline.__file__).parent / "_core.pyi").read_text())
    missing = []
    for node in tree.body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and not hasattr(_core, node.name):
            missing.append(node.name)
        if isinstance(node, ast.ClassDef):
            names = [n.name for n in node.body if isinstance(n, ast.FunctionDef)]
            names += [n.target.id for n in node.body if isinstance(n, ast.AnnAssign)]
            missing += [
                f"{node.name}.{name}"
                for name in names
                if not hasattr(getattr(_core, node.name, None), name)
            ]
    assert not missing
    stubbed = {node.name for node in tree.body if hasattr(node, "name")}
    stubbed |= {node.target.id for node in tree.body if isinstance(node, ast.AnnAssign)}
    assert {name for name in vars(_core) if not name.startswith("_")} <= stubbed


def test_a_known_failure_is_waived():
    report = plumbline.check_mean(np.full(30_000, 0.6), reference=0.5, name="a/mean")
    assert not report
    until = datetime.date(2999, 1, 31)
    waived = plumbline.waive(report, [plumbline.Waiver("a/*", "known", until)])
    assert waived and waived.results[0].waived == "known (until 2999-01-31)"
    expired = plumbline.waive(report, [plumbline.Waiver("a/*", "known", datetime.date(2020, 1, 1))])
    assert not expired and expired.results[-1].subject == "waiver/a/*"
