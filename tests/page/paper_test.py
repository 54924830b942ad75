"""On paper stand all views one after the other, drawn, in light colours."""

import base64
import pathlib
import shutil
import subprocess
import unittest

from browser import PageTest
from layout_test import BLANK

# What a sheet gets: noted when everything has been laid out for it.
NOTE = """
addEventListener('beforeprint', () => {
  const titles = [...document.querySelectorAll('main > section > .section-head h2')].filter((h) => h.checkVisibility());
  window.noted = {
    titles: titles.map((h) => h.textContent),
    canvases: document.querySelectorAll('main canvas').length,
    undrawn: [...document.querySelectorAll('.plot canvas')].filter((c) => !Chart.getChart(c)).length,
    cards: document.querySelectorAll('.night-card').length,
    ink: getComputedStyle(document.querySelector('main h2')).color,
    axis: Chart.getChart(document.querySelector('#view-speed canvas')).options.scales.x.title.color,
  };
});
"""
TITLES = "return listedViews().map((view) => view.title)"


class Paper(PageTest):
    def print_page(self):
        self.run_script(NOTE)
        self.wait_until(lambda: self.run_script("return data.images.every((image) => image.floats)"))
        pdf = base64.b64decode(self.browser.execute_cdp_cmd("Page.printToPDF", {"printBackground": True})["data"])
        self.assertTrue(pdf.startswith(b"%PDF"))
        return pdf, self.run_script("return window.noted")

    def test_all_views_stand_one_after_the_other_whichever_is_open(self):
        for name in ("overview", "bars"):
            self.go(name)
            pdf, noted = self.print_page()
            self.assertEqual(noted["titles"], self.run_script(TITLES))
            self.assertEqual(self.view(), name, "the screen is as it was")
            self.assertEqual(self.run_script("return document.querySelectorAll('main > section:not([hidden])').length"), 1)
        self.assertGreater(len(pdf), 100_000, "an empty sheet has 1 kB")

    @unittest.skipUnless(shutil.which("pdftotext"), "pdftotext is missing (Debian: poppler-utils)")
    def test_text_of_each_view_is_on_the_sheets(self):
        file = pathlib.Path(self.directory.name) / "page.pdf"
        file.write_bytes(self.print_page()[0])
        text = subprocess.run(["pdftotext", str(file), "-"], check=True, stdout=subprocess.PIPE).stdout.decode()
        text = " ".join(text.split())
        for title in self.run_script(TITLES):
            self.assertIn(title, text)
        for words in ("observed/expected = 2", "bsdf_cost/bsdf 29/pdf", "Two threads over one", "tangent frame", "PLUMBLINE_SEED=18446744073709551614"):
            self.assertIn(words, text)

    def test_everything_is_drawn(self):
        noted = self.print_page()[1]
        self.assertEqual(noted["undrawn"], 0)
        self.assertEqual(noted["cards"], 40, "all numbers over nights, not only those near the window")
        self.assertGreaterEqual(noted["canvases"], 9, "three pairs of pictures, curves, a figure, bounds")
        self.assertEqual(self.run_script(BLANK), [])

    def test_paper_is_light_in_a_dark_browser_too(self):
        self.resize(1600, dark=True)
        self.go("speed")
        axis = "return Chart.getChart(document.querySelector('#view-speed canvas')).options.scales.x.title.color"
        self.assertEqual(self.run_script(axis), "#9aa4ae")
        noted = self.print_page()[1]
        self.assertEqual(noted["axis"], "#636b74")
        self.assertEqual(noted["ink"], "rgb(28, 33, 39)")
        self.wait_until(lambda: self.run_script(axis) == "#9aa4ae")

    def test_a_check_that_is_open_is_printed_too(self):
        self.go("check/mean/light%2FSphereLight%2Ffar")
        self.assertIn("Check", self.print_page()[1]["titles"])


if __name__ == "__main__":
    unittest.main()
