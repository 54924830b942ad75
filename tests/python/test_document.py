"""docs/adding_a_bsdf_python.md shows what is run and what is printed, and nothing else."""

import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
TUTORIAL = ROOT / "tests/python/tutorial"
DOCUMENT = (ROOT / "docs/adding_a_bsdf_python.md").read_text()


def blocks_of(document):
    """Fenced blocks, each after a line `<!-- from FILE -->`."""
    return re.findall(r"(?:<!-- from (\S+) -->\n)?```[a-z]*\n([^`]*)```\n", document)


def without_numbers(text):
    """What does not depend on the machine, its speed or the directory."""
    text = re.sub(r" in [0-9.e+-]+ s$", "", text, flags=re.MULTILINE)
    text = re.sub(r"[^ \n']*/(?=test_diffuse\.py)", "", text)
    return re.sub(r"-?[0-9][0-9.e+-]*", "#", text)


def run(version):
    path = [str(TUTORIAL / version), *os.environ.get("PYTHONPATH", "").split(os.pathsep)]
    command = [sys.executable, "-B", "-m", "pytest", "-p", "no:cacheprovider", "-q", "-rN"]
    return subprocess.run(
        [*command, "-p", "plumbline.pytest_plugin", str(TUTORIAL / "test_diffuse.py")],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(path), "COLUMNS": "80"},
        capture_output=True,
        text=True,
    )


def test_code_is_what_is_run():
    compared = 0
    for source, text in blocks_of(DOCUMENT):
        assert source, f"no file is named before\n{text}"
        if source != "output":
            assert text in (ROOT / source).read_text(), f"{source} does not hold\n{text}"
            compared += 1
    assert compared == 3


def test_the_wrong_bsdf_fails_with_the_message_shown():
    outcome = run("before")
    assert outcome.returncode == 1, outcome.stdout + outcome.stderr
    (shown,) = [text for source, text in blocks_of(DOCUMENT) if source == "output"]
    printed = without_numbers(outcome.stdout)
    assert without_numbers(shown) in printed, outcome.stdout


def test_the_mended_bsdf_passes():
    outcome = run("after")
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr


def test_the_comparison_sees_a_change():
    assert blocks_of("<!-- from a.py -->\n```python\nx\n```\n") == [("a.py", "x\n")]
    assert without_numbers("off by 3.1e-05 at") == without_numbers("off by 2 at")
    assert without_numbers("jacobian: fail") != without_numbers("jacobian: pass")
