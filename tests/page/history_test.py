"""The view of a history: what changed, numbers, proofs, parts and seeds over nights."""

import unittest
import urllib.parse

from selenium.webdriver.common.keys import Keys

from browser import PageTest
from sample_results import DRIFT, MISSING, NIGHTS, ODD, STEP

STEPPED = "bsdf_cost/ggx_conductor/sample"
PROOFS = "const chart = Chart.getChart(document.querySelector('#view-history canvas'));"
TOP = "return document.querySelector(arguments[0]).getBoundingClientRect().top"


def address(number):
    return "history/number/" + urllib.parse.quote(number, safe="")


class History(PageTest):
    def setUp(self):
        super().setUp()
        self.go("history")

    def rows(self, part):
        return [row.text for row in self.all(f"[data-part={part}] tbody tr")]

    def card(self, name):
        self.go(address(name))
        return self.wait_for(".pointed .night-card")

    def path(self, card, kind):
        return self.run_script("return arguments[0].querySelector(arguments[1])?.getAttribute('d') ?? ''", card, f"path.{kind}")

    def test_verdict_counts_what_was_found(self):
        self.assertEqual(self.one("#view-history .verdict-line").text, "60 nights: 2 regressions, 1 improvement")
        self.assertIn("40 numbers and 10 checks followed from 2026-01-01 to 2026-03-01", self.one("#view-history .verdict").text)
        tiles = dict(reversed(t.text.split("\n")) for t in self.all("#view-history .tile"))
        self.assertEqual(tiles, {"regressions": "2", "improvements": "1", "checks refuted": "1", "fresh seeds run": "240", "with a failure": "1"})

    def test_first_view_leads_to_what_needs_eyes(self):
        self.go("overview")
        notices = self.all("#view-overview .notice")
        self.assertEqual([n.text for n in notices[:1]], ["60 nights: 2 regressions, 1 improvement, 1 check refuted, 1 of 240 fresh seeds with a failure"])
        notices[0].find_element("css selector", "a").click()
        self.wait_until(lambda: self.view() == "history")

    def test_changes_say_what_since_when_how_large_and_how_sure(self):
        step, drift = self.rows("changes")
        for words in (STEPPED, "regression", "2026-02-10", "14cccccc..14cccccc", "100 → 104 ns", "+4.0 % [+3.0 % … +5.0 %]", "p = 1.0e−6 and 2.0e−5"):
            self.assertIn(words, step)
        for words in ("lambertian", "improvement", "2026-01-21 … 2026-01-30, drift", "07cccccc..10cccccc", "−10 % [−11 % … −9.0 %]"):
            self.assertIn(words, drift)
        tones = [b.get_attribute("class") for b in self.all("[data-part=changes] .badge")]
        self.assertEqual(tones, ["badge fail wrong", "badge pass"])

    def test_counters_that_changed_are_exact(self):
        self.assertEqual(len(self.rows("counters")), 1)
        self.assertIn("1,000,000,000 → 1,000,000,007 rays", self.rows("counters")[0])

    def test_a_change_leads_to_its_plot(self):
        self.one("[data-part=changes] tbody a").click()
        card = self.wait_for(".pointed .night-card")
        self.assertIn(STEPPED, card.text)
        self.wait_until(lambda: 0 < self.run_script(TOP, ".pointed .night-card") < 700)

    def test_a_plot_has_a_gap_its_change_and_its_odd_night(self):
        card = self.card(STEPPED)
        median = self.path(card, "median")
        self.assertEqual(median.count("M"), 2, "a night is missing")
        self.assertIn(f"M{MISSING + 1} ", median)
        self.assertNotIn(f"L{MISSING} ", median)
        self.assertEqual(self.path(card, "spread").count("Z"), 2)
        self.assertEqual(self.path(card, "step.worse"), f"M{STEP - 0.5} 0V100")
        self.assertEqual(self.path(card, "odd"), "")
        depths = [float(point.split(" ")[1]) for point in median.replace("M", "L").split("L")[1:]]
        before, after = depths[:STEP - 1], depths[STEP - 1:]
        self.assertGreater(sum(before) / len(before), sum(after) / len(after) + 20, "a larger number stands higher")
        drift = self.card("bsdf_cost/lambertian/eval").find_element("css selector", "rect.drift.better")
        self.assertEqual([float(drift.get_attribute(a)) for a in ("x", "width")], [DRIFT[0] - 0.5, DRIFT[1] - DRIFT[0] + 1])
        self.assertTrue(self.path(self.card("ray_replay/cornell/shadow rays in packets of sixteen"), "odd").startswith(f"M{ODD} "))

    def test_a_plot_is_read_by_pointer_and_keys(self):
        card = self.card(STEPPED)
        self.assertIn("2026-03-01", card.find_element("css selector", ".reading").text)
        frame = card.find_element("css selector", ".night-frame")
        self.assertIn("regression of +4.0 % since 2026-02-10", frame.get_attribute("aria-label"))
        self.run_script("arguments[0].focus()", frame)
        self.browser.switch_to.active_element.send_keys(Keys.ARROW_DOWN)
        self.assertIn("2026-02-28", card.find_element("css selector", ".reading").text)
        self.run_script("const b = arguments[0].querySelector('svg').getBoundingClientRect(); arguments[0].dispatchEvent("
                        "new PointerEvent('pointermove', {clientX: b.left + b.width * 10.7 / 60.4, clientY: b.top + 5}))", frame)
        self.assertIn("2026-01-11 · 04cccccc: not measured", card.find_element("css selector", ".reading").text)

    def test_every_plot_has_ink(self):
        self.run_script("layOutForPaper()")
        inks = self.run_script("return [...document.querySelectorAll('.night-frame')].map((f) => f.querySelector('.median').getTotalLength())")
        self.run_script("leavePaper()")
        self.assertEqual(len(inks), 40)
        self.assertGreater(min(inks), NIGHTS - 4)

    def test_plots_are_drawn_as_they_come_near(self):
        self.browser.get("about:blank")
        self.resize(380)
        self.browser.get(f"{self.address}#history")
        self.wait_for("[data-part=numbers]")
        self.assertLess(len(self.all(".night-card")), 20)
        self.run_script("document.querySelector('[data-part=numbers] .numbers').lastElementChild.scrollIntoView()")
        self.wait_until(lambda: self.all(".night-place:last-child .night-card"))

    def test_filter_of_numbers(self):
        def count():
            return self.one("[data-part=numbers] .count").text

        self.assertEqual(count(), "40 numbers")
        field = self.one("[data-part=numbers] input")
        field.send_keys("bsdf pdf 2")
        self.wait_until(lambda: count() == "12 of 40 numbers")  # 2, 12, and 20 to 29
        self.go(address(STEPPED))
        self.wait_until(lambda: count() == "40 numbers")
        self.assertEqual(field.get_property("value"), "")
        for kind, found in (("Changed", "3 of"), ("Counted", "7 of"), ("Measured", "33 of"), ("All", "40 ")):
            next(b for b in self.all("[data-part=numbers] .chips button") if b.text == kind).click()
            self.assertTrue(count().startswith(found), count())

    def test_proven_bounds_shrink_until_the_code_changes(self):
        self.wait_until(lambda: self.run_script(f"{PROOFS} return chart !== undefined"))
        axis, largest = self.run_script(f"{PROOFS} return [chart.options.scales.y.type, chart.data.datasets[0].data.map((p) => p.y)]")
        self.assertEqual(axis, "logarithmic")
        self.assertAlmostEqual(largest[0], 2.4)
        self.assertIsNone(largest[MISSING])
        self.assertLess(largest[29], largest[0] / 5)
        self.assertAlmostEqual(largest[30], 2.4, msg="sequences that began again")
        rows = self.rows("sequences")
        self.assertIn("all nights together are 0.004 above the answer", rows[0])
        self.assertIn("44 %", rows[1])

    def test_a_box_shows_a_sequence_in_the_plot(self):
        names = f"{PROOFS} return chart.data.datasets.map((d) => d.label)"
        self.wait_until(lambda: self.run_script(f"{PROOFS} return chart !== undefined"))
        before = self.run_script(names)
        box = next(b for b in self.all("[data-part=sequences] input[type=checkbox]") if not b.is_selected())
        box.click()
        self.assertEqual(len(self.run_script(names)), len(before) + 1)
        box.click()
        self.assertEqual(self.run_script(names), before)

    def test_nights_show_how_their_parts_went(self):
        self.assertEqual(len(self.rows("nights")), 30)
        self.one("[data-part=nights] .more-rows").click()
        rows = self.rows("nights")
        self.assertEqual(len(rows), NIGHTS)
        self.assertIn("2026-03-01", rows[0])
        self.assertIn("75 min, ended", rows[-6])
        self.assertIn("+ local changes", rows[-8])
        self.assertIn("4 seeds, 1 with a failure", rows[-21])
        cells = self.all("[data-part=nights] tbody tr:nth-last-child(6) .cell")
        self.assertEqual([c.get_attribute("aria-label") for c in cells], ["passed", "passed", "timed out"])

    def test_seeds_are_counted_and_a_failure_can_be_repeated(self):
        text = self.one("[data-part=seeds]").text
        self.assertIn("240 times", text)
        self.assertIn("1 run had a failure", text)
        self.assertIn("PLUMBLINE_NIGHTLY=gate PLUMBLINE_SEED=18446744073709551614 ctest --preset release -R '^Sphere\\.Mean/0$'", text)

    def test_tiles_lead_to_their_parts(self):
        self.resize(380)
        for tile in self.all("#view-history .tile"):
            self.run_script("arguments[0].click()", tile)
            part = tile.get_attribute("href").split("/")[-1]
            self.wait_until(lambda: -50 < self.run_script(TOP, f"[data-part={part}]") < 800)

    def test_runs_that_are_not_comparable_stand_apart(self):
        self.run_script("const s = document.querySelector('#view-history select'); s.selectedIndex = 1; s.dispatchEvent(new Event('change'))")
        self.wait_until(lambda: self.one("#view-history .verdict-line").text == "1 night: no number changed")
        self.assertEqual(self.all("[data-part=numbers]"), [])
        self.go(address(STEPPED))
        self.wait_until(lambda: "60 nights" in self.one("#view-history .verdict-line").text)

    def test_what_a_history_can_see_is_shown_where_it_is_known(self):
        self.assertEqual(self.all("[data-part=detection]"), [])
        self.run_script("data.figures.push({...data.figures[0], group: kHistoryFigures, title: 'Detectable size'});"
                        "document.querySelector('#view-history').append(...new HistoryView(data.history).node().filter(Boolean))")
        self.assertIn("Detectable size", self.one("[data-part=detection]").text)


class Duets(PageTest):
    def setUp(self):
        super().setUp()
        self.go("duets")

    def rows(self):
        return [row.text for row in self.all("#view-duets tbody tr")]

    def test_what_was_compared_and_what_is_slower_is_said(self):
        self.assertEqual(self.one("#view-duets .verdict-line").text, "1 part of 4 slower")
        self.assertIn("From abababab to cdcdcdcd + local changes; intervals hold with 99 % for all parts together", self.one("#view-duets .verdict").text)
        self.assertEqual([b.text for b in self.all("#view-duets .badge")], ["slower", "no change", "undecided", "not timed"])
        self.assertIn("1.0310 [1.0270 … 1.0350] 16", self.rows()[0])

    def test_counters_that_differ_are_exact(self):
        self.assertIn("rays 1,000 → 1,010 (+1.0 %); results differ", self.rows()[3])
        self.assertTrue(all("the same" in row for row in self.rows()[:3]))

    def test_intervals_are_drawn_on_one_axis(self):
        box = "return [...document.querySelectorAll('#view-duets .duet')].map((svg) => svg.querySelector(arguments[0]).getBBox()).map((b) => [b.x, b.width])"
        (x, slower), (_, quiet), (_, wide) = self.run_script(box, ".interval")
        self.assertGreater(wide, 10 * slower)
        self.assertLess(quiet, slower)
        margin, width = self.run_script(box, ".margin")[0]
        self.assertGreater(x, margin + width, "slower lies beyond what says nothing")
        self.assertAlmostEqual(margin + width / 2, 50, delta=0.01)
        self.assertEqual(self.one("#view-duets .duet").get_attribute("aria-label"), "1.0310 [1.0270 … 1.0350]")

    def test_first_view_leads_to_them(self):
        self.go("overview")
        notice = self.all("#view-overview .notice")[-1]
        self.assertEqual(notice.text, "1 part slower than before: bsdf-sample/ggx_conductor")
        notice.find_element("css selector", "a").click()
        self.wait_until(lambda: self.view() == "duets")


class NoHistory(PageTest):
    NIGHTS = False

    def test_only_the_address_says_how_a_history_comes_to_be(self):
        self.assertNotIn("history", self.views())
        self.assertNotIn("duets", self.views())
        self.go("history")
        self.assertIn("./run nightly --history FILE", self.one("#view-history").text)
        self.assertEqual(self.all("#view-history .verdict"), [])


if __name__ == "__main__":
    unittest.main()
