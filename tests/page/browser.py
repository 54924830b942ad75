"""A browser without a window, and what the tests of the page ask of it."""

import os
import tempfile
import unittest

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

import sample_results

WAIT_SECONDS = 60  # for what never comes; a page that works is there in a blink


def open_browser():
    options = Options()
    options.binary_location = os.environ["CHROMIUM"]
    for argument in ("--headless=new", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars", "--no-first-run",
                     "--host-resolver-rules=MAP * ~NOTFOUND"):  # no network
        options.add_argument(argument)
    if os.geteuid() == 0:
        options.add_argument("--no-sandbox")  # chromium refuses root otherwise
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(os.environ["CHROMEDRIVER"]), options=options)


class PageTest(unittest.TestCase):
    """Each test gets the page afresh; whatever the console says fails it."""

    NIGHTS = True  # whether the results hold a history

    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        cls.address = sample_results.make_page(cls.directory.name, cls.NIGHTS).as_uri()
        cls.browser = open_browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.directory.cleanup()

    def setUp(self):
        self.resize(1600)
        self.browser.get("about:blank")
        self.browser.get(self.address)
        self.wait_for(".verdict-line")

    def tearDown(self):
        self.assertEqual(self.console(), [])

    def console(self):
        return [entry["message"] for entry in self.browser.get_log("browser")]

    def resize(self, width, dark=False):
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                     {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False})
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [scheme]})

    def run_script(self, script, *arguments):
        return self.browser.execute_script(script, *arguments)

    def all(self, selector):
        return self.browser.find_elements(By.CSS_SELECTOR, selector)

    def one(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def wait_until(self, condition):
        return WebDriverWait(self.browser, WAIT_SECONDS, poll_frequency=0.02).until(lambda _: condition())

    def wait_for(self, selector):
        return self.wait_until(lambda: [e for e in self.all(selector) if e.is_displayed()])[0]

    def view(self):
        return self.run_script("return document.querySelector('main > section:not([hidden])').id.replace('view-', '')")

    def go(self, address):
        self.run_script("location.hash = arguments[0]", address)
        name = address.split("/")[0]
        self.wait_until(lambda: self.view() == name)

    def views(self):
        return self.run_script("return [...document.querySelectorAll('#contents a')].map((a) => a.hash.slice(1))")
