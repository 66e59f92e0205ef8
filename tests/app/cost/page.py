#!/usr/bin/python3
"""Tests cost.html in headless Chromium: page.py MAKE_PAGE.

MAKE_PAGE writes the page of a made-up report. Expected values come from the file's own HTML, read
by Python's parser, and never from the page's scripts. Exits with code 77 (skipped) if Chromium,
its driver, Selenium or pdftotext is missing.
"""
import base64
import csv
import html.parser
import io
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
try:
    from selenium import webdriver
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    print("skipped: python3-selenium is missing")
    sys.exit(SKIPPED)
for program in ("chromium", "chromedriver", "pdftotext"):
    if not shutil.which(program):
        print(f"skipped: {program} is missing (Debian: chromium, chromium-driver, poppler-utils)")
        sys.exit(SKIPPED)

failures = 0


def check(what, passed, found=""):
    """Counts and prints a failure."""
    global failures
    if not passed:
        failures += 1
        print(f"page.py: {what}: {found}"[:2000])


class Tables(html.parser.HTMLParser):
    """Reads the tables of a page: id -> {"head": [text], "rows": [(attributes, [text])]}."""

    def __init__(self, text):
        super().__init__()
        self.tables, self.table, self.cell = {}, None, None
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        if tag == "table":
            self.table = self.tables[attrs["id"]] = {"head": [], "rows": []}
        elif tag == "tr" and self.table is not None:
            self.line = []
            self.table["rows"].append((attrs, self.line))
        elif tag in ("th", "td"):
            self.cell = []

    def handle_endtag(self, tag):
        if tag in ("th", "td"):
            self.line.append(" ".join("".join(self.cell).split()))
            self.cell = None
        elif tag == "thead":
            self.table["head"] = self.table["rows"].pop()[1]
        elif tag == "table":
            self.table = None

    def handle_data(self, data):
        if self.cell is not None:
            self.cell.append(data)


def start():
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    service = webdriver.chrome.service.Service(shutil.which("chromedriver"))
    return webdriver.Chrome(service=service, options=options)


def open_page(browser, url, width, scheme="light", motion="no-preference", scripts=True):
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False})
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [
        {"name": "prefers-color-scheme", "value": scheme},
        {"name": "prefers-reduced-motion", "value": motion}]})
    browser.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": not scripts})
    browser.get(url)


def rows_shown(browser, table):
    """Returns the texts of the rows that are not filtered out, in the order shown."""
    return browser.execute_script("""
        return [...document.querySelectorAll(`#${arguments[0]} tbody tr`)]
            .filter((row) => !row.hidden)
            .map((row) => [...row.cells].map((cell) => cell.textContent.trim().replace(/\\s+/g, ' ')));
        """, table)


def press(browser, *keys):
    webdriver.ActionChains(browser).send_keys(*keys).perform()


# --- layout ----------------------------------------------------------------------------------------

def check_layout(browser, url):
    for width in (1280, 480):
        open_page(browser, url, width)
        browser.execute_script("document.querySelectorAll('details').forEach((d) => d.open = true)")
        found = browser.execute_script("return document.documentElement.scrollWidth")
        check(f"the page is no wider than {width} pixels", found <= width, found)
    sticky = browser.execute_script("""
        const box = document.querySelector('#work-counters').closest('.scroll');
        const before = box.querySelector('tbody th').getBoundingClientRect().left;
        box.scrollLeft = 300;
        return [box.scrollLeft, before, box.querySelector('tbody th').getBoundingClientRect().left];
        """)
    check("a wide table scrolls in its box", sticky[0] == 300, sticky)
    check("its first column stays", sticky[1] == sticky[2], sticky)


def check_images(browser, url, count):
    open_page(browser, url, 1280)
    sizes = browser.execute_async_script("""
        const done = arguments[0];
        const images = [...document.images];
        Promise.allSettled(images.map((i) => i.decode())).then(() =>
            done(images.map((i) => [i.naturalWidth, i.naturalHeight, i.dataset.part])));
        """)
    check("all pictures are in the page", len(sizes) == count, len(sizes))
    expected = {"crop": [24, 24], "map": [24, 24], "frame": [64, 48]}
    check("all pictures can be decoded", all(expected[s[2]] == s[:2] for s in sizes), sizes)


CONTRAST = """
    const channel = (c) => (c /= 255, c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
    const light = (rgb) => 0.2126 * channel(rgb[0]) + 0.7152 * channel(rgb[1]) + 0.0722 * channel(rgb[2]);
    const parse = (text) => text.match(/[\\d.]+/g).map(Number);
    const backOf = (e) => {
        for (; e; e = e.parentElement) {
            const c = parse(getComputedStyle(e).backgroundColor);
            if (c.length < 4 || c[3] > 0) { return c; }
        }
    };
    return [...document.querySelectorAll('body *')].filter((e) => e.checkVisibility() &&
        [...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim())).map((e) => {
        const style = getComputedStyle(e);
        const ink = parse(e instanceof SVGElement ? style.fill : style.color);
        const a = light(ink), b = light(backOf(e));
        return [(Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05), `${e.tagName}.${e.getAttribute('class')}`];
    }).sort((x, y) => x[0] - y[0])[0];
"""


def check_contrast(browser, url):
    for scheme in ("light", "dark"):
        open_page(browser, url, 1280, scheme)
        browser.execute_script("document.querySelector('details').open = true")
        browser.find_element(By.CSS_SELECTOR, ".table tr[data-row] .open").click()
        least = browser.execute_script(CONTRAST)
        check(f"texts have a contrast of at least 4.5 ({scheme})", least[0] >= 4.5, least)


# --- tables ----------------------------------------------------------------------------------------

def number_of(text):
    found = re.match(r"[-+]?[\d.]+", text)
    return float(found.group()) if found else None


def sorted_rows(table, column, reverse):
    """Rows without a number come last in both directions; equal rows keep their order."""
    cells = [cells for _, cells in table["rows"]]
    known = [c for c in cells if number_of(c[column]) is not None]
    known.sort(key=lambda c: number_of(c[column]), reverse=reverse)
    return known + [c for c in cells if number_of(c[column]) is None]


def check_sorting(browser, url, tables):
    open_page(browser, url, 1280)
    browser.execute_script("document.querySelector('details').open = true")
    for name, title in (("combinations", "FLIP"), ("combinations", "mean ms")):
        table = tables[name]
        column = table["head"].index(title)
        path = f"#{name} thead th:nth-child({column + 1})"
        original = [cells for _, cells in table["rows"]]
        for state, expected in (("ascending", sorted_rows(table, column, False)),
                                ("descending", sorted_rows(table, column, True)), (None, original)):
            browser.find_element(By.CSS_SELECTOR, path + " button").click()
            header = browser.find_element(By.CSS_SELECTOR, path)
            check(f"aria-sort of {name}", header.get_attribute("aria-sort") == state, state)
            check(f"{name} sorted by {title}, {state}", rows_shown(browser, name) == expected)


def check_filter(browser, url, table):
    open_page(browser, url, 1280)
    browser.execute_script("document.querySelector('details').open = true")
    box = browser.find_element(By.XPATH, "//table[@id='combinations']/ancestor::*[@class='table']")
    names = [s.get_attribute("name") for s in box.find_elements(By.TAG_NAME, "select")]
    check("there is a filter for each setting that varies", names == ["aa", "af", "miplod"], names)
    box.find_element(By.CSS_SELECTOR, "select[name=aa] option[value='4']").click()
    expected = [cells for attrs, cells in table["rows"] if "aa=4," in attrs["data-settings"]]
    check("the filter of a setting", rows_shown(browser, "combinations") == expected)
    pale = len(browser.find_elements(By.CSS_SELECTOR, ".point.dim"))
    check("other points are pale", pale == len(table["rows"]) - len(expected), pale)
    box.find_element(By.CSS_SELECTOR, "input[type=search]").send_keys("af=16 miplod")
    expected = [cells for cells in expected if "af=16" in cells[0] and "miplod" in cells[0]]
    check("the filter of texts", rows_shown(browser, "combinations") == expected and expected)
    check_csv(browser, box, table["head"], expected)


def check_csv(browser, box, head, rows):
    """What is saved is what is shown."""
    browser.execute_script("""
        const make = URL.createObjectURL;
        URL.createObjectURL = (blob) => {
            blob.text().then((text) => { window.savedText = text; });
            return make.call(URL, blob);
        };""")
    box.find_element(By.CSS_SELECTOR, ".save").click()
    time.sleep(0.3)
    text = browser.execute_script("return window.savedText")
    found = list(csv.reader(io.StringIO(text or "")))
    check("the CSV has what the table shows", found == [head] + rows, found)


# --- keyboard --------------------------------------------------------------------------------------

# Number of keyboard stops: what can be reached with the Tab key and is visible.
STOPS = """
    return [...document.querySelectorAll('a[href], button, input, select, summary, [tabindex]')]
        .filter((e) => e.checkVisibility() && e.tabIndex >= 0 && !e.closest('dialog')).length;
"""


def check_tab_reaches_all(browser, url):
    open_page(browser, url, 1280)
    expected = browser.execute_script(STOPS)
    reached = 0
    unseen = []
    for _ in range(expected + 5):
        press(browser, Keys.TAB)
        state = browser.execute_script("""
            const e = document.activeElement;
            if (e === document.body || e.dataset.reached) { return null; }
            e.dataset.reached = 1;
            const style = getComputedStyle(e);
            const seen = style.outlineStyle !== 'none' || style.strokeWidth === '5px' ||
                e.querySelector('.bar-back') !== null;
            return [seen, e.outerHTML.slice(0, 80)];
            """)
        if state is None:
            break
        reached += 1
        if not state[0]:
            unseen.append(state[1])
    check("the Tab key reaches all controls", reached == expected, f"{reached} of {expected}")
    check("the focus can be seen", not unseen, unseen)


def focus_point(browser):
    browser.execute_script("document.querySelector('.plot .point[tabindex=\"0\"]').focus()")
    return browser.switch_to.active_element


# Compares the canvas left and right of the wipe with the pictures in the page.
WIPE = """
    const [row, set] = arguments;
    const pixels = (source) => {
        const c = document.createElement('canvas');
        c.width = source.naturalWidth ?? source.width;
        c.height = source.naturalHeight ?? source.height;
        const context = c.getContext('2d');
        context.drawImage(source, 0, 0);
        return context.getImageData(0, 0, c.width, c.height);
    };
    const image = (figure) => figure.querySelector('img[data-part="crop"]');
    const truth = pixels(image(document.querySelector(`figure.truth[data-set="${set}"]`)));
    const picture = pixels(image(document.querySelector(`figure[data-set="${set}"][data-row="${row}"]`)));
    const shown = pixels(document.querySelector('dialog canvas'));
    const share = document.querySelector('.wipe').getAttribute('aria-valuenow') / 100;
    const edge = Math.round(share * shown.width);
    for (let i = 0; i < shown.data.length; i++) {
        const from = (i / 4 | 0) % shown.width < edge ? truth : picture;
        if (shown.data[i] !== from.data[i]) {
            return `pixel ${i / 4 | 0} differs, edge ${edge}`;
        }
    }
    return '';
"""


def check_viewer(browser, url):
    open_page(browser, url, 1280)
    focus_point(browser)
    first = browser.switch_to.active_element
    press(browser, Keys.ARROW_RIGHT)
    check("an arrow key goes to the next point", browser.switch_to.active_element != first)
    press(browser, Keys.HOME)
    point = browser.switch_to.active_element
    row = point.get_attribute("data-row")
    tip = browser.find_element(By.CSS_SELECTOR, ".tip").text
    check("the focus names the point", re.search(r"ms \(.*to.*FLIP.*PSNR", tip, re.S), tip)
    lit = browser.find_elements(By.CSS_SELECTOR, f"#pareto-front tr.lit[data-row='{row}']")
    check("the point's row of the table is marked", len(lit) == 1)
    press(browser, Keys.ENTER)
    dialog = browser.find_element(By.TAG_NAME, "dialog")
    check("the Enter key opens the viewer", dialog.is_displayed())
    time.sleep(0.2)
    wipe = browser.find_element(By.CSS_SELECTOR, ".wipe")
    before = int(wipe.get_attribute("aria-valuenow"))
    check("the wipe is drawn", browser.execute_script(WIPE, row, "front") == "",
          browser.execute_script(WIPE, row, "front"))
    press(browser, *[Keys.ARROW_RIGHT] * 5)
    after = int(wipe.get_attribute("aria-valuenow"))
    check("the arrow keys move the wipe", after == before + 10, f"{before} {after}")
    check("the moved wipe is drawn", browser.execute_script(WIPE, row, "front") == "",
          browser.execute_script(WIPE, row, "front"))
    check_modes(browser)
    check_part(browser)
    press(browser, Keys.ESCAPE)
    check("the Escape key closes the viewer", not dialog.is_displayed())
    check("the focus returns", browser.switch_to.active_element == point)


def check_modes(browser):
    pressed = lambda: browser.find_element(By.CSS_SELECTOR, "[aria-pressed=true]").text
    for key, mode in (("d", "difference"), ("f", "FLIP map"), ("w", "wipe"), ("b", "blink")):
        press(browser, key)
        check(f"the key {key}", pressed() == mode, pressed())
    seen = set()
    for _ in range(20):
        seen.add(browser.find_element(By.CSS_SELECTOR, ".tag.left").text)
        time.sleep(0.05)
    check("the pictures alternate", "truth" in seen and len(seen) == 2, seen)
    press(browser, "8")
    width = browser.execute_script("return document.querySelector('dialog canvas').clientWidth")
    check("the key 8 zooms", width == 8 * 24, width)
    press(browser, "w")


def check_part(browser):
    browser.find_element(By.CSS_SELECTOR, "[data-do=part]").click()
    size = browser.execute_script("const c = document.querySelector('dialog canvas'); return [c.width, c.height]")
    check("the whole frame is shown", size == [64, 48], size)


def check_rest(browser, url):
    """Who asks for less motion gets no blinking: each press of the key changes the picture."""
    open_page(browser, url, 1280, motion="reduce")
    focus_point(browser)
    press(browser, Keys.HOME, Keys.ENTER, "b")
    tag = lambda: browser.find_element(By.CSS_SELECTOR, ".tag.left").text
    first = tag()
    time.sleep(0.6)
    check("nothing blinks with reduced motion", tag() == first)
    press(browser, "b")
    check("the key shows the other picture", tag() != first)


def check_marks(browser, url):
    """A row under the pointer marks its point."""
    open_page(browser, url, 1280)
    row = browser.find_element(By.CSS_SELECTOR, "#pareto-front tbody tr")
    webdriver.ActionChains(browser).move_to_element(row).perform()
    number = row.get_attribute("data-row")
    lit = browser.find_elements(By.CSS_SELECTOR, f"[data-set=front] .point.lit[data-row='{number}']")
    check("the row under the pointer marks its point", len(lit) == 1, len(lit))


# --- paper -----------------------------------------------------------------------------------------

def words_of_pdf(browser, folder):
    """Returns how often each word is on a page, wholly inside it."""
    options = {"preferCSSPageSize": True, "printBackground": False}
    pdf = base64.b64decode(browser.execute_cdp_cmd("Page.printToPDF", options)["data"])
    file = os.path.join(folder, "page.pdf")
    with open(file, "wb") as out:
        out.write(pdf)
    text = subprocess.run(["pdftotext", "-bbox", file, "-"], check=True, capture_output=True,
                          text=True).stdout
    count = {}
    width = height = 0.0
    for page, word in re.findall(r"<page ([^>]*)>|<word ([^<]*)</word>", text):
        values = dict(re.findall(r'(\w+)="([\d.-]+)"', page or word))
        if page:
            width, height = float(values["width"]), float(values["height"])
        elif (float(values["xMin"]) >= 0.0 and float(values["xMax"]) <= width and
              float(values["yMin"]) >= 0.0 and float(values["yMax"]) <= height):
            name = html.unescape(word.split(">", 1)[1])
            count[name] = count.get(name, 0) + 1
    return count


def check_paper(browser, url, tables, folder):
    for scripts in (True, False):
        open_page(browser, url, 1280, scripts=scripts)
        found = words_of_pdf(browser, folder)
        expected = {}
        for table in tables.values():
            for cells in [table["head"]] + [cells for _, cells in table["rows"]]:
                for word in " ".join(cells).split():
                    expected[word] = expected.get(word, 0) + 1
        missing = {w: (found.get(w, 0), n) for w, n in expected.items() if found.get(w, 0) < n}
        check(f"paper has every column of every table (scripts: {scripts})", not missing, missing)


def main():
    folder = tempfile.mkdtemp()
    file = os.path.join(folder, "cost.html")
    url = "file://" + file
    try:
        subprocess.run([sys.argv[1], file], check=True)
        with open(file, encoding="utf-8") as page:
            text = page.read()
        tables = Tables(text).tables
        browser = start()
        try:
            check_layout(browser, url)
            check_images(browser, url, text.count("<img "))
            check_contrast(browser, url)
            check_sorting(browser, url, tables)
            check_filter(browser, url, tables["combinations"])
            check_marks(browser, url)
            check_viewer(browser, url)
            check_rest(browser, url)
            check_tab_reaches_all(browser, url)
            check_paper(browser, url, tables, folder)
            log = browser.get_log("browser")
            check("the scripts run without an error", not log, json.dumps(log))
        finally:
            browser.quit()
    finally:
        shutil.rmtree(folder)
    return 1 if failures else 0


sys.exit(main())
