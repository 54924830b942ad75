"""axe-core finds nothing serious in any view, in either colour scheme, on a wide screen and on a phone."""

import os
import pathlib
import unittest

from browser import PageTest

SERIOUS = """
const done = arguments[arguments.length - 1];
axe.run(document, {resultTypes: ['violations']}).then(({violations}) => done(violations
  .filter(({impact}) => impact === 'serious' || impact === 'critical')
  .map(({id, nodes}) => `${id}: ${nodes.length} times, first ${nodes[0].html}`)), (error) => done([String(error)]));
"""
CHECK = "check/mean/light%2FSphereLight%2Ffar"


class Accessibility(PageTest):
    def setUp(self):
        super().setUp()
        self.run_script(pathlib.Path(os.environ["AXE"]).read_text(encoding="utf-8"))

    def serious(self):
        return self.browser.execute_async_script(SERIOUS)

    def look_at_all(self, width, dark):
        self.resize(width, dark)
        for name in [*self.views(), CHECK, "find/e"]:
            with self.subTest(view=name, width=width, dark=dark):
                self.go(name)
                self.assertEqual(self.serious(), [])

    def test_wide_and_light(self):
        self.look_at_all(1600, dark=False)

    def test_narrow_and_dark(self):
        self.look_at_all(380, dark=True)

    def test_what_a_row_and_a_cell_open(self):
        for view, button in (("matrix", ".fold"), ("matrix", ".matrix .cell"), ("checks", ".check button"), ("stability", ".check button"),
                             ("causes", ".check button")):
            with self.subTest(view=view, button=button):
                self.go(view)
                self.one(f"#view-{view} {button}").click()
                self.assertEqual(self.serious(), [])

    def test_faults_are_seen(self):
        add = "document.querySelector('main > section').append(element(...arguments))"
        self.run_script(add, "button", {"type": "button"})
        self.run_script(add, "p", {"style": "color: #ccc; background: #fff"}, "faint")
        self.assertEqual({fault.split(":")[0] for fault in self.serious()}, {"button-name", "color-contrast"})


if __name__ == "__main__":
    unittest.main()
