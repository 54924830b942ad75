"""Nothing is cut, overlaps or stays blank, in any view, at three widths and in both colour schemes."""

import unittest

from browser import PageTest

# Pieces of text that stick out of what may not be scrolled, or lie on one another.
FAULTS = """
const scrolls = (e) => e && (['auto', 'scroll'].includes(getComputedStyle(e).overflowX) || scrolls(e.parentElement));
const shown = (e) => e.checkVisibility() && !e.closest('option, select, .ticks, .chart');
const inView = (box, e) => {  // what is scrolled out of its own window is seen nowhere else
  if (!e) return true;
  const window = e.getBoundingClientRect();
  const cut = getComputedStyle(e).overflowX !== 'visible' &&
    (box.right < window.left || box.left > window.right || box.bottom < window.top + 2 || box.top > window.bottom - 2);
  return !cut && inView(box, e.parentElement);
};
const texts = [];
const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
while (walker.nextNode()) {
  const node = walker.currentNode;
  const parent = node.parentElement;
  if (!node.data.trim() || !shown(parent) || parent.closest('script, style, noscript')) continue;
  const range = document.createRange();
  range.selectNodeContents(node);
  for (const box of range.getClientRects()) {
    if (box.width > 0 && box.height > 0 && inView(box, parent)) texts.push({box, parent, text: node.data.trim().slice(0, 60)});
  }
}
const faults = [];
const width = document.documentElement.clientWidth;
if (document.documentElement.scrollWidth > width) faults.push(`the page is ${document.documentElement.scrollWidth} wide`);
for (const {box, parent, text} of texts) {
  if ((box.left < -1 || box.right > width + 1) && !scrolls(parent)) faults.push(`cut: ${text}`);
}
const inside = texts.filter((t) => !t.parent.closest('aside'));  // which stays while the rest scrolls
for (let i = 0; i < inside.length; ++i) {
  for (let j = i + 1; j < inside.length; ++j) {
    const [a, b] = [inside[i].box, inside[j].box];
    const across = Math.min(a.right, b.right) - Math.max(a.left, b.left);
    const down = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
    if (across > 2 && down > 4) faults.push(`overlap: ${inside[i].text} / ${inside[j].text}`);
  }
}
return faults.slice(0, 5);
"""

# Canvases of the view shown that hold one colour only.
BLANK = """
return [...document.querySelectorAll('main > section:not([hidden]) canvas')].filter((canvas) => {
  const pixels = new Uint32Array(canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer);
  return pixels.every((p) => p === pixels[0]);
}).map((canvas) => canvas.getAttribute('aria-label'));
"""


class Layout(PageTest):
    def look_at_all(self, width, dark):
        self.resize(width, dark)
        for name in [*self.views(), "find/e"]:
            with self.subTest(view=name, width=width, dark=dark):
                self.go(name)
                self.wait_until(lambda: self.run_script(BLANK) == [])
                self.assertEqual(self.run_script(FAULTS), [])

    def test_phone(self):
        self.look_at_all(380, dark=False)

    def test_tablet(self):
        self.look_at_all(800, dark=True)

    def test_wide_screen(self):
        self.look_at_all(1600, dark=False)

    def test_plots_keep_their_ink_in_the_dark(self):
        self.go("speed")
        light = self.run_script("return document.querySelector('#view-speed canvas').toDataURL()")
        self.resize(1600, dark=True)
        self.wait_until(lambda: self.run_script("return document.querySelector('#view-speed canvas').toDataURL()") != light)
        self.assertEqual(self.run_script(BLANK), [])

    def canvases(self):
        count = 0
        for name in self.views():
            self.go(name)
            count += self.run_script("return document.querySelectorAll('main > section:not([hidden]) canvas').length")
        return count

    def test_views_that_hold_canvases_were_looked_at(self):
        # Two scenes, curves, a figure; a busy machine may still be at them the first time.
        self.wait_until(lambda: self.canvases() >= 6)

    def test_faults_are_seen(self):
        add = "const p = document.createElement('p'); p.textContent = 'put in'; p.style = arguments[0]; document.querySelector('main > section').prepend(p)"
        self.run_script(add, "position:relative; left:-400px; white-space:nowrap")
        self.assertIn("cut: put in", self.run_script(FAULTS))
        self.run_script("document.querySelector('main > section > p').style = 'position:absolute'")
        self.assertTrue(any(f.startswith("overlap: put in") for f in self.run_script(FAULTS)))
        self.run_script("document.querySelector('main > section > p').style = 'width:3000px'")
        self.assertTrue(any("wide" in f for f in self.run_script(FAULTS)))

    def test_a_blank_canvas_is_seen(self):
        self.run_script("document.querySelector('main > section').append(document.createElement('canvas'))")
        self.assertEqual(len(self.run_script(BLANK)), 1)


if __name__ == "__main__":
    unittest.main()
