"""The page does what its parts promise: addresses, keys, search, matrix, bins, slider, zoom, copy."""

import unittest
import urllib.parse

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

from browser import PageTest
from sample_results import HOSTILE

FAILING = "check/chi_square/" + urllib.parse.quote("GgxConductor/alpha 1/front 60°/chi_square", safe="")


class Views(PageTest):
    def test_each_view_has_an_address_and_something_to_show(self):
        self.assertGreaterEqual(len(self.views()), 14)
        for name in self.views():
            self.go(name)
            self.assertTrue(self.run_script("return document.querySelector('main > section:not([hidden])').innerText.length > 60"), name)

    def test_back_button_leads_back(self):
        self.go("matrix")
        self.go(FAILING)
        self.browser.back()
        self.wait_until(lambda: self.view() == "matrix")
        self.browser.back()
        self.wait_until(lambda: self.view() == "overview")
        self.browser.forward()
        self.wait_until(lambda: self.view() == "matrix")

    def test_an_address_can_be_opened_directly(self):
        self.browser.get("about:blank")
        self.browser.get(f"{self.address}#{FAILING}")
        self.assertIn("GgxConductor/alpha 1/front 60°", self.wait_for(".check-card").text)

    def test_an_address_that_nobody_knows_shows_the_overview(self):
        for address in ("no-such-view", "%E0%A4%A"):
            self.run_script("location.hash = arguments[0]", address)
            self.wait_until(lambda: self.view() == "overview")

    def test_keys_turn_pages(self):
        body = self.one("body")
        body.send_keys("2")
        self.wait_until(lambda: self.view() == self.views()[1])
        body.send_keys(Keys.ARROW_RIGHT)
        self.wait_until(lambda: self.view() == self.views()[2])
        body.send_keys(Keys.ARROW_LEFT)
        self.wait_until(lambda: self.view() == self.views()[1])

    def test_search_finds_as_one_types_and_escape_leads_back(self):
        self.go("matrix")
        self.one("body").send_keys("/")
        self.browser.switch_to.active_element.send_keys("furnace mis")
        self.wait_until(lambda: self.view() == "find")
        self.wait_until(lambda: "5 found" in self.one("#view-find .results").text)  # a picture, three channels, one of them over nights
        self.assertIn("furnace_sphere/mis 1,1 power=2/red", self.one("#view-find").text)
        self.one("#find").send_keys(" no such word")
        self.wait_until(lambda: "0 found" in self.one("#view-find .results").text)
        self.one("#find").send_keys(Keys.ESCAPE)
        self.wait_until(lambda: self.view() == "matrix")

    def test_search_reaches_every_kind_of_thing(self):
        for words, found in (("two threads", "Bars"), ("mutants", "Figures and tables"), ("tangent", "Faults put in"),
                             ("veach", "Pictures"), ("stability", "Views"), ("unexpected", "Checks"), ("ggx regression", "Numbers over nights"),
                             ("furnace fail", "Checks over nights")):
            self.go("find/" + urllib.parse.quote(words))
            self.assertIn(found, [h.text.split("\n")[0].rstrip("0123456789 ") for h in self.all("#view-find h3")])

    def test_what_is_wrong_stands_in_full_on_the_first_view(self):
        cards = self.all("#view-overview .check-card")
        self.assertEqual(len(cards), 2)
        self.assertIn("observed/expected = 2", cards[0].text)
        self.assertIn(HOSTILE, cards[0].text)
        self.assertEqual(self.all("#broken"), [])
        self.assertEqual(len(cards[0].find_elements("css selector", ".bins")), 3)
        self.assertIn("PLUMBLINE_SEED=7 ctest", cards[0].text)
        self.assertEqual(len(cards[1].find_elements("css selector", ".band")), 1)

    def test_bins_are_drawn_as_they_were_cut_and_can_be_read(self):
        self.go(FAILING)
        ratio = self.all("#view-check .bins")[2].find_elements("css selector", "rect")
        self.assertEqual(len(ratio), 64)
        fills = [(r.get_attribute("class").split()[0], float(r.get_attribute("fill-opacity"))) for r in ratio]
        self.assertEqual(fills[0][0], "more")
        self.assertGreater(fills[0][1], 0.95)
        self.assertEqual(fills[-1][1], 0)
        ActionChains(self.browser).move_to_element(ratio[0]).perform()
        self.wait_until(lambda: "200 observed, 100 ± 0.5 expected, ratio 2" in self.one("#view-check .reading").text)
        worst = self.all("#view-check .bin-maps tbody tr")
        self.assertTrue(worst[0].text.split()[-2] == "2", worst[0].text)

    def test_copy_button_copies_the_command(self):
        self.browser.execute_cdp_cmd("Browser.grantPermissions", {"permissions": ["clipboardReadWrite", "clipboardSanitizedWrite"]})
        self.go(FAILING)
        button = self.one("#view-check .copy")
        button.click()
        self.wait_until(lambda: button.text == "Copied")
        text = self.browser.execute_async_script("navigator.clipboard.readText().then(arguments[0])")
        self.assertEqual(text, "PLUMBLINE_SEED=7 ctest --preset release -R '^A\\.B$'")

    def test_matrix_groups_by_what_things_are(self):
        self.go("matrix")
        groups = [h.text.split("\n")[0] for h in self.all(".matrix-group h3, .matrix-group summary")]
        for group in ("BSDFs", "Lights", "Integrals and MIS weights", "Scenes", "Negative controls"):
            self.assertTrue(any(g.startswith(group) for g in groups), groups)
        things = [t.text for t in self.all(".matrix-group")[0].find_elements("css selector", ".thing th")]
        self.assertTrue(things[0].startswith("GGX conductor"), "what is wrong stands first")
        self.assertTrue(things[1].startswith("Lambertian"), things)
        self.assertFalse(self.all("details.matrix-group")[0].get_property("open"))

    def test_matrix_opens_rows_and_cells(self):
        self.go("matrix")
        self.all(".fold")[1].click()
        rows = [r.text for r in self.all(".matrix .row th")]
        self.assertEqual(rows, ["alpha 0.1 · back", "alpha 0.1 · front", "eta 1/1.5 · back", "eta 1/1.5 · front"])
        cell = self.one(".matrix .row .cell")
        self.assertIn("2 proven; at most 0.16 % off", cell.get_attribute("title"))
        cell.click()
        links = self.all(".cell-list a")
        self.assertEqual([a.text for a in links], [f"Lambertian/alpha 0.1/back {angle}°/jacobian" for angle in (0, 60)])
        links[0].click()
        self.wait_until(lambda: self.view() == "check")
        self.assertIn("Lambertian/alpha 0.1/back 0°", self.one("#view-check .shown").text)

    def test_subjects_are_read_as_what_they_are(self):
        cases = {
            ("GgxDielectric/eta 1/1.5 alpha 0.02/back 60°/integral", "integral"): "BSDFs: GGX dielectric: eta 1/1.5 alpha 0.02 · back",
            ("Mixture/mixture in mixture/front 88/lobe 1", "jacobian_autodiff"): "BSDFs: Mixture: mixture in mixture · front",
            ("ModifiedPhong/n 1/albedo at 60.000000", "mean"): "BSDFs: Modified Phong: n 1",
            ("light/SphereLight/subtends 60°/chi_square", "chi_square"): "Lights: Sphere light: subtends 60°",
            ("light selection/power/1/widest", "mean"): "Lights: Light selection: power · 1 · widest",
            ("warp/square_to_uniform_disk/support", "support"): "Warps and distributions: Square to uniform disk: Square to uniform disk",
            ("bad_gaussian_line/coin flip", "mean"): "Integrals and MIS weights: Bad Gaussian line: coin flip",
            ("furnace_sphere depth 2/mis 1,1 power=2/red", "mean"): "Scenes: Furnace sphere: depth 2 · mis 1,1 power=2",
            ("sidewalk/image/green", "image"): "Scenes: Sidewalk: image",
            ("off default/point_light/mis", "mean"): "Scene parameters: Point light: mis",
            ("halton/net", "net"): "Samplers: Halton: Halton",
            ("calibration/coverage/skewed", "calibration"): "The checks themselves: Calibration: coverage · skewed",
            ("control/lambertian, density without 1/pi/chi_square", "chi_square"):
                "Negative controls: Lambertian, density without 1/pi: Lambertian, density without 1/pi",
            ("my coat/thin/mean", "mean"): "Others: My coat: thin",
        }
        for (subject, check), place in cases.items():
            read = self.run_script("const p = placeOf({subject: arguments[0], check: arguments[1], expected: 'pass'});"
                                   "return [p.kind, p.thing, p.row].join(': ')", subject, check)
            self.assertEqual(read, place, subject)
        self.assertEqual(self.run_script("return placeOf({subject: 'Lambertian/x', check: 'mean', expected: 'fail'}).kind"),
                         "Negative controls")

    def test_wrong_cell_is_shown_as_wrong(self):
        self.go("matrix")
        wrong = self.all(".matrix .thing .cell.wrong")
        self.assertEqual(len(wrong), 2)
        self.assertIn("1 not the verdict it should give", wrong[0].get_attribute("title"))

    def test_filter_of_checks(self):
        self.go("checks/unexpected")
        self.assertIn("2 of", self.one("#view-checks .count").text)
        self.go("checks/all")
        self.one("#view-checks input").send_keys("furnace green")
        self.wait_until(lambda: "3 of" in self.one("#view-checks .count").text)

    def test_an_address_of_a_scene_leads_to_it(self):
        scenes = self.run_script("return [...new Set(data.images.map((i) => i.group))].sort()")
        self.resize(380)
        for scene in scenes:
            self.go("overview")
            self.go("images/" + urllib.parse.quote(scene, safe=""))
            top = "return document.querySelector(`[data-scene=\"${CSS.escape(arguments[0])}\"]`).getBoundingClientRect().top"
            self.wait_until(lambda: -50 < self.run_script(top, scene) < 450)

    def test_a_view_is_found_where_it_was_left(self):
        self.resize(380)
        self.run_script("scrollTo(0, 700)")
        self.go("matrix")
        self.assertEqual(self.run_script("return scrollY"), 0)
        self.browser.back()
        self.wait_until(lambda: self.view() == "overview")
        self.wait_until(lambda: self.run_script("return scrollY") == 700)

    def test_slider_zoom_and_choice_of_pictures(self):
        self.go("images/furnace_sphere")
        self.wait_for("[data-scene=furnace_sphere] .stack canvas.over")
        scene = self.one("[data-scene=furnace_sphere]")
        self.assertIn("L = ", scene.text, "the closed form")
        self.assertIn("mis 1,1 power=2/red", scene.text, "what was proven")
        over = scene.find_element("css selector", "canvas.over")

        def clip():
            return self.run_script("return arguments[0].style.clipPath", over)

        self.wait_until(lambda: "50%" in clip())
        self.run_script("const s = arguments[0]; s.value = 20; s.dispatchEvent(new Event('input'))", scene.find_element("css selector", ".split"))
        self.assertIn("20%", clip())
        width = self.run_script("return arguments[0].clientWidth", over)
        scene.find_elements("css selector", ".controls button")[2].click()
        self.assertAlmostEqual(self.run_script("return arguments[0].clientWidth", over), 4 * width, delta=4)
        ActionChains(self.browser).move_to_element(scene.find_element("css selector", ".window")).perform()
        self.wait_until(lambda: "   |   " in self.run_script("return arguments[0].textContent", scene.find_element("css selector", ".value")))

    def test_pixels_have_the_mean_that_the_renderer_recorded(self):
        means = self.browser.execute_async_script("""
          const done = arguments[0];
          Promise.all(data.images.map(async (image) => {
            const floats = await floatsOf(image);
            const record = data.renders.find((r) => r.scene === image.group && image.name.startsWith(r.strategy));
            return [0, 1, 2].map((c) => floats.filter((_, i) => i % 3 === c).reduce((a, b) => a + b, 0) * 3 / floats.length / record.mean[c]);
          })).then(done)""")
        self.assertEqual(len(means), 4)
        for ratio in (r for image in means for r in image):
            self.assertAlmostEqual(ratio, 1, delta=2**-8, msg="each value is rounded by as much at most")

    def test_console_is_heard(self):
        self.run_script("console.warn('heard')")
        self.assertEqual(len(self.console()), 1)


if __name__ == "__main__":
    unittest.main()
