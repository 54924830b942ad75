"""Shows in full the reports of a test that fails; an assertion's message is cut short by pytest.

Found by pytest where the package is installed; else a conftest.py says
``pytest_plugins = ["plumbline.pytest_plugin"]``.
"""

from __future__ import annotations

from typing import Any, Generator

import pytest

from ._effort import OF_TEST


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup() -> None:
    """Forgets the reports of the test before."""
    OF_TEST.clear()


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(call: Any) -> Generator[None, Any, None]:
    """Adds a section for each report that is not ok."""
    outcome = yield
    test = outcome.get_result()
    if call.when == "call" and test.failed:
        test.sections += [("plumbline", str(report)) for report in OF_TEST if not report.ok]
