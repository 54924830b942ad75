"""A report as a notebook shows it, in light and in dark."""

from __future__ import annotations

import math
from html import escape
from typing import List, Optional

from . import _core

# Tints that let the page's own text and background through.
_TINT = {
    "pass": "rgba(46, 160, 67, 0.25)",
    "fail": "rgba(218, 54, 51, 0.35)",
    "inconclusive": "rgba(187, 128, 9, 0.25)",
}
_CELL = "padding: 0.15em 0.6em; text-align: left; vertical-align: top; color: inherit"
_LOW, _HIGH = 1e-10, 1e-2  # p-values between which a tile's tint grows


def _number(value: Optional[float]) -> str:
    return "" if value is None else f"{value:.6g}"


def _row(result: _core.CheckResult) -> str:
    verdict = result.verdict if result.as_expected else f"{result.verdict}, not {result.expected}"
    cells = [
        escape(result.subject),
        escape(verdict),
        _number(result.estimate),
        _number(result.reference),
        _number(result.bound),
        _number(result.tolerance),
        escape(result.reason),
    ]
    tint = f"background: {_TINT[result.verdict]}"
    styles = [_CELL, f"{_CELL}; {tint}"] + [_CELL] * (len(cells) - 2)
    return "<tr>" + "".join(f'<td style="{s}">{c}</td>' for s, c in zip(styles, cells)) + "</tr>"


def _table(results: List[_core.CheckResult]) -> str:
    titles = ["check", "verdict", "estimate", "against", "|bias| ≤", "tolerance", "why"]
    head = "".join(f'<th style="{_CELL}">{escape(title)}</th>' for title in titles)
    rows = "".join(_row(result) for result in results)
    return f'<table style="border-collapse: collapse"><tr>{head}</tr>{rows}</table>'


def _tile(p: float) -> float:
    """How much of the colour of a fail a tile gets: none from 1e-2 up, all from 1e-10 down."""
    if math.isnan(p) or p >= _HIGH:
        return 0.0
    return min(1.0, math.log(_HIGH / max(p, 1e-300)) / math.log(_HIGH / _LOW))


def _bins(result: _core.CheckResult) -> str:
    """The bins of a chi-square test in the square of the domain's chart: redder the more samples a
    bin holds than the pdf says, bluer the fewer, in full at twice and half as many."""
    if not result.bins:
        return ""
    size = 256
    squares = []
    for x0, x1, y0, y1, expected, _, observed in result.bins:
        ratio = math.log2((observed + 0.5) / (expected + 0.5))
        colour = "218, 54, 51" if ratio > 0 else "47, 129, 247"
        squares.append(
            f'<rect x="{size * x0:.3f}" y="{size * (1 - y1):.3f}" width="{size * (x1 - x0):.3f}" '
            f'height="{size * (y1 - y0):.3f}" fill="rgb({colour})" fill-opacity="{min(1, abs(ratio)):.3f}">'
            f"<title>{observed:.0f} samples, {expected:.6g} expected</title></rect>"
        )
    return (
        f'<figure style="display: inline-block; margin: 0.5em"><svg width="{size}" height="{size}" '
        f'style="border: 1px solid currentColor">{"".join(squares)}</svg>'
        f"<figcaption>{escape(result.subject)}: more samples than the pdf says red, fewer blue</figcaption></figure>"
    )


def _worst_bins(results: List[_core.CheckResult]) -> List[str]:
    """Of the failing check whose bins are furthest off: others mostly share its cause."""
    failing = [r for r in results if r.verdict == "fail" and r.bins]
    if not failing:
        return []
    return [_bins(min(failing, key=lambda r: 1.0 if r.p_value is None else r.p_value))]


def _map(image: _core.ImageResult) -> str:
    """Where the image differs: a square for each tile, redder where its p-value is smaller."""
    tiles = image.p_map
    rows, columns = tiles.shape
    if tiles.size == 0:
        return ""
    size = max(2, min(16, 512 // max(columns, rows)))
    squares = "".join(
        f'<rect x="{x * size}" y="{y * size}" width="{size}" height="{size}" '
        f'fill="rgb(218, 54, 51)" fill-opacity="{_tile(tiles[y, x]):.2f}"/>'
        for y in range(rows)
        for x in range(columns)
        if _tile(tiles[y, x]) > 0
    )
    title = f"p-values of tiles of {image.tile} pixels, red below {_HIGH:g}"
    return (
        f'<figure style="display: inline-block; margin: 0.5em"><svg width="{columns * size}" '
        f'height="{rows * size}" style="border: 1px solid currentColor">{squares}</svg>'
        f"<figcaption>{escape(image.check.subject)}: {title}</figcaption></figure>"
    )


def html_of_report(report: _core.Report) -> str:
    """The verdict, the likely cause, what is not as it should be, and the rest folded."""
    odd = [r for r in report.results if not r.as_expected or r.verdict == "fail"]
    rest = [r for r in report.results if r.as_expected and r.verdict != "fail"]
    parts = [
        f'<p><b style="padding: 0.1em 0.5em; background: {_TINT[report.verdict]}">'
        f"{report.verdict}</b> {len(rest)} of {len(report.results)} checks as expected</p>"
    ]
    if report.cause:
        parts.append(f"<p><b>likely cause</b>: {escape(report.cause)}</p>")
    if report.second_cause:
        parts.append(f"<p><b>or</b>: {escape(report.second_cause)}</p>")
    if odd:
        parts.append(_table(odd))
    if rest:
        parts.append(f"<details><summary>{len(rest)} others</summary>{_table(rest)}</details>")
    parts += _worst_bins(odd)
    parts += [_map(image) for image in getattr(report, "images", [])]
    return f"<div>{''.join(parts)}</div>"
