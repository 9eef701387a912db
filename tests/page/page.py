"""Drives the page in headless Chromium: edits, runs, cancels, shows an error, moves the filter.

    python3 -m venv target/page && target/page/bin/pip install -r tests/page/requirements.txt
    cargo build --release && target/page/bin/python tests/page/page.py target/release/mist

needs /usr/bin/chromium and /usr/bin/chromedriver (Debian: chromium, chromium-driver). With
`--screenshots DIR` it leaves pictures of every view there.
"""

import argparse
import contextlib
import hashlib
import pathlib
import re
import subprocess
import sys
import tempfile
import time

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select

#: Longest wait for a change of the page, long enough for a loaded machine.
PATIENCE = 60
FLAGS = (
    "--headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
    "--disable-background-networking --disable-component-update --disable-sync "
    "--window-size=1280,1000"
)
LONG = """MODEL = Facet_BRDF_Model
VARIABLES:
  t = 0  incidentangle = t  incidentpol = (1,0,0,0)  rotation = 0
  integrationmode = 2  differential = 3e-6  minsamples = 10
END
VARY: FOR t FROM 0 TO 1 BY 1e-4 END
INTEGRALS: A = HEMI END END
OUTPUTS: 1 r=A END
FILES: results = r.dat listing = r.lst END
"""


class Page:
    """The page of a service, in a browser."""

    def __init__(self, driver, url, screenshots):
        self.driver, self.url, self.screenshots = driver, url, screenshots

    def open(self, fragment=""):
        self.driver.get("about:blank")
        self.driver.get(self.url + fragment)
        self.settle()

    def at(self, name):
        return self.driver.find_element(By.ID, name)

    def wait(self, what, done):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if done():
                return
            time.sleep(0.05)
        raise AssertionError(f"{what}: not within {PATIENCE} s; {self.at('problem').text}")

    def settle(self):
        """Until the view is drawn."""
        self.wait("the view", lambda: self.at("view").get_attribute("aria-busy") == "false")

    def press(self, name):
        self.at(name).click()

    def view(self, name):
        self.press(f"view-{name}")
        self.settle()

    def write(self, program):
        """Enters a program into the editor like typing."""
        script = "arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event('input'))"
        self.driver.execute_script(script, self.at("program"), program)

    def pixels(self, name):
        """Mean of the bytes of a canvas."""
        script = """const c = document.getElementById(arguments[0]);
            const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
            let s = 0; for (const b of d) s += b; return s / d.length;"""
        return self.driver.execute_script(script, name)

    def pixels_of(self, name):
        """As `pixels`, 0 while there is no such canvas."""
        return self.driver.find_elements(By.ID, name) and self.pixels(name)

    def picture(self, name):
        if self.screenshots:
            self.driver.save_screenshot(str(self.screenshots / f"{name}.png"))


def a_parameter_that_is_edited_changes_the_ball(page):
    page.open()
    page.picture("ball")
    before = page.pixels("ball-plain")
    page.at("parameter-sdf.s").send_keys(Keys.CONTROL, "a", Keys.NULL, "0.5", Keys.TAB)
    page.wait("another ball", lambda: page.pixels("ball-plain") not in (0, before))
    assert page.at("parameter-sdf.s").get_attribute("value") == "0.5"


def the_filter_turns_by_its_slider(page):
    page.open()
    page.view("ball")
    seen = [page.pixels("ball-filtered")]
    slider = page.at("filter-angle")
    for _ in range(45):
        slider.send_keys(Keys.ARROW_RIGHT)
    page.wait("a turned filter", lambda: page.pixels("ball-filtered") != seen[0])
    page.picture("filter")


def every_view_draws_something(page):
    page.open()
    for view, found in [("spectrum", "svg .curve"), ("lobe", "svg .curve"), ("hemisphere", "#hemisphere")]:
        page.view(view)
        assert page.driver.find_elements(By.CSS_SELECTOR, f"#view {found}"), view
        page.picture(view)
    assert not page.at("problem").is_displayed()


def another_model_brings_its_own_parameters(page):
    page.open()
    Select(page.at("model")).select_by_value("Lambertian_BRDF_Model")
    page.settle()
    assert page.driver.find_elements(By.ID, "parameter-reflectance")
    assert not page.driver.find_elements(By.ID, "parameter-shadow")


def a_program_runs_and_its_columns_are_drawn(page):
    page.open()
    page.press("tab-program")
    page.press("run")
    page.wait("the run", lambda: page.at("status").text == "Done.")
    page.wait("the table", lambda: page.driver.find_elements(By.ID, "results"))
    assert len(page.driver.find_elements(By.CSS_SELECTOR, "#results tbody tr")) == 82
    page.picture("graph")
    page.view("hemisphere")
    assert page.driver.find_elements(By.ID, "hemisphere"), "the run's samples"
    page.picture("samples")


def a_mistake_is_marked_at_its_line(page):
    page.open()
    page.press("tab-program")
    page.write(LONG.replace("Facet_BRDF_Model", "Facet_BRDF_Modle"))
    page.press("run")
    page.wait("the refusal", lambda: page.driver.find_elements(By.CSS_SELECTOR, ".marks button"))
    told = page.driver.find_element(By.CSS_SELECTOR, ".marks button")
    assert told.text.startswith("1:9 ") and "Facet_BRDF_Model" in told.text, told.text
    assert page.driver.find_element(By.CSS_SELECTOR, ".editor .wrong").text == "1"
    page.picture("mistake")


def a_mistake_is_marked_while_typing(page):
    page.open()
    page.press("tab-program")
    page.view("graph")
    page.write(LONG.replace("incidentpol = (1,0,0,0)", "incidentpol = (1,0,0,"))
    page.wait("the mark", lambda: page.driver.find_elements(By.CSS_SELECTOR, ".marks button"))
    assert page.driver.find_element(By.CSS_SELECTOR, ".editor .wrong").text == "3"
    page.picture("typing")
    page.write(LONG)
    page.wait("no mark", lambda: not page.driver.find_elements(By.CSS_SELECTOR, ".marks button"))


def a_long_run_is_cancelled(page):
    page.open()
    page.press("tab-program")
    page.write(LONG)
    page.press("run")
    page.wait("the start", lambda: page.at("status").text.startswith("running"))
    page.press("cancel")
    page.wait("the end", lambda: page.at("status").text == "Cancelled.")


def a_link_carries_the_state(page):
    page.open()
    Select(page.at("model")).select_by_value("Lambertian_BRDF_Model")
    page.view("spectrum")
    shared = page.driver.current_url
    page.open("#" + shared.split("#", 1)[1])
    assert Select(page.at("model")).first_selected_option.text == "Lambertian_BRDF_Model"
    assert page.at("view-spectrum").get_attribute("aria-selected") == "true"


def tabs_are_chosen_with_the_arrow_keys(page):
    page.open()
    page.at("view-ball").send_keys(Keys.ARROW_RIGHT)
    page.settle()
    assert page.at("view-spectrum").get_attribute("aria-selected") == "true"
    page.press("theme")
    page.picture("other-theme")


def a_service_with_keys_opens_with_a_key(page):
    page.driver.get(page.url)
    page.wait("the refusal", lambda: "key" in page.at("problem").text)
    page.at("key").send_keys("k", Keys.TAB)
    page.wait("the view", lambda: page.pixels_of("ball-plain"))
    assert not page.at("problem").is_displayed()
    page.press("share")
    assert "key" not in page.driver.current_url


TESTS = [
    a_parameter_that_is_edited_changes_the_ball,
    the_filter_turns_by_its_slider,
    every_view_draws_something,
    another_model_brings_its_own_parameters,
    a_program_runs_and_its_columns_are_drawn,
    a_mistake_is_marked_at_its_line,
    a_mistake_is_marked_while_typing,
    a_long_run_is_cancelled,
    a_link_carries_the_state,
    tabs_are_chosen_with_the_arrow_keys,
]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("mist", help="the binary")
    parser.add_argument("--screenshots", type=pathlib.Path, metavar="DIR")
    given = parser.parse_args()
    if given.screenshots:
        given.screenshots.mkdir(parents=True, exist_ok=True)
    options = webdriver.ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    for flag in FLAGS.split():
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service("/usr/bin/chromedriver"))
    with tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as stack:
        stack.callback(driver.quit)
        keys = pathlib.Path(folder, "keys")
        keys.write_text(f"all read,run {hashlib.sha256(b'k').hexdigest()}\n")
        for more, tests in [([], TESTS), (["--keys", str(keys)], [a_service_with_keys_opens_with_a_key])]:
            server = stack.enter_context(running([given.mist, "serve", "--listen", "127.0.0.1:0", *more]))
            page = Page(driver, address(server), given.screenshots)
            for test in tests:
                test(page)
                print("ok", test.__name__.replace("_", " "), flush=True)
        # A refused program is an answer with status 422, one without a key 401: the log has them too.
        errors = [e for e in driver.get_log("browser") if e["level"] == "SEVERE"]
        errors = [e for e in errors if not re.search("status of (422|401)", e["message"])]
        assert not errors, errors
    print(f"{len(TESTS) + 1} passed")


@contextlib.contextmanager
def running(command):
    """A process that ends with the block."""
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        try:
            yield process
        finally:
            process.terminate()


def address(server):
    """The address that the server prints."""
    for line in server.stdout:
        if found := re.search(r"http://[0-9.]+:\d+", line):
            return found.group() + "/"
    sys.exit("the server ended without listening")


if __name__ == "__main__":
    main()
