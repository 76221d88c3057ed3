"""Looks at the page of a report in headless Chromium: what is drawn against the CSV beside it, what a reader can do, how it prints.

usage: check_page.py STUDY
"""
import base64
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.actions.action_builder import ActionBuilder
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

report = os.path.abspath(os.path.join(sys.argv[1], "report"))
url = "file://" + os.path.join(report, "index.html")
options = Options()
for argument in ("--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--force-device-scale-factor=1"):
    options.add_argument(argument)
options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
home = tempfile.TemporaryDirectory()
options.add_argument("--user-data-dir=" + home.name)
browser = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


def resize(width, height=900):
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", dict(width=width, height=height, deviceScaleFactor=1, mobile=False))


def media(scheme="light", kind="screen"):
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": kind, "features": [{"name": "prefers-color-scheme", "value": scheme}]})


def all_of(what, within=None):
    return (within or browser).find_elements(By.CSS_SELECTOR, what)


def one_of(what, within=None):
    (found,) = all_of(what, within)
    return found


def tip():
    return browser.execute_script("const t = document.getElementById('tip'); return t.hidden ? null : t.textContent")


def middle(element):
    """Brings it into view, once the page has come to rest there; its place in the window."""
    return browser.execute_async_script("""
        const [element, done] = arguments, place = () => { const b = element.getBoundingClientRect(); return [b.x + b.width/2, b.y + b.height/2] };
        element.scrollIntoView({block: 'center'});
        requestAnimationFrame(() => requestAnimationFrame(() => done(place())));""", element)


def point_at(x, y, press=False):
    actions = ActionBuilder(browser, duration=0)
    actions.pointer_action.move_to_location(round(x), round(y))
    if press:
        actions.pointer_action.click()
    actions.perform()


def hover(element):
    point_at(*middle(element))


def click(element):
    point_at(*middle(element), press=True)


# ---- what is drawn is what the CSV has ----

def place(axis, value):
    """Pixels of a value, from what the page says of its axis."""
    kind, low, high, begin, end = axis.split()
    low, high, begin, end = map(float, (low, high, begin, end))
    part = math.log(value / low) / math.log(high / low) if kind == "log" else (value - low) / (high - low)
    return begin + part * (end - begin)


def corners(path):
    x = y = 0.0
    found = []
    for command, rest in re.findall(r"([MLVH])([^MLVH]*)", path):
        number = [float(n) for n in rest.split()]
        x, y = (x, number[0]) if command == "V" else (number[0], y) if command == "H" else number
        found.append((x, y))
    return found


def distance(point, line):
    """Of a point from a polygon of lines."""
    best = math.hypot(point[0] - line[0][0], point[1] - line[0][1])
    for (ax, ay), (bx, by) in zip(line, line[1:]):
        long = (bx - ax)**2 + (by - ay)**2
        t = 0 if long == 0 else min(1, max(0, ((point[0] - ax) * (bx - ax) + (point[1] - ay) * (by - ay)) / long))
        best = min(best, math.hypot(point[0] - ax - t * (bx - ax), point[1] - ay - t * (by - ay)))
    return best


def check_names(panel, rows, drawn):
    """Marks and boxes on an axis of names, in the order of the rows: at the height of their values, nearest to the name that the rows have."""
    places = list(dict.fromkeys(row[3] for row in panel["rows"]))  # the first series has them all in their order
    assert len(drawn) == len(rows)
    for row, (x, *heights) in zip(rows, drawn):
        assert abs(x - place(panel["x"], 1 + places.index(row[3]))) <= abs(place(panel["x"], 0.5) - place(panel["x"], 1)), row
        wanted = [row[6], row[5]] if row[2] == "box" else [row[4]]
        for value, height in zip(wanted, heights):
            assert abs(place(panel["y"], float(value)) - height) < 0.1, row


def check_drawing(svg, rows):
    """Every mark, box and line of a drawing, panel by panel, against the rows of the CSV."""
    panels = browser.execute_script("""return [...arguments[0].querySelectorAll('.panel[data-y]')].map(panel => ({x: panel.dataset.x, y: panel.dataset.y,
        series: [...panel.querySelectorAll('.series')].map(s => ({marks: [...s.querySelectorAll('.mark')].map(m => m.getAttribute('d')),
            boxes: [...s.querySelectorAll('.area')].map(b => b.getAttribute('d')), bars: s.querySelectorAll('.bar').length, lines: [...s.querySelectorAll('.line')].map(l => l.getAttribute('d'))}))}))""", svg)
    left = list(rows)
    for number, panel in enumerate(panels, 1):
        panel["rows"], named = list(left), panel["x"].startswith("names")
        for series in panel["series"]:
            if named and series["boxes"]:
                of = [row for row in left if row[2] == "box"]
                left = left[len(of):]
                check_names(panel, [row for row in of if row[5]], [[x + 8, top, bottom] for x, top, _, bottom, _ in
                                                                  ([float(n) for n in re.findall(r"-?[\d.]+", box)] for box in series["boxes"])])
                continue
            if not series["marks"] and not series["lines"]:
                continue
            name, kind = left[0][1:3]
            of = []
            while left and left[0][:3] == [str(number), name, kind] and (kind == "mark" or not of or len(series["lines"]) == 1):
                of.append(left.pop(0))
                if kind != "mark" and left and not named and float(left[0][3]) < float(of[-1][3]):
                    break  # the next series of no name begins
                if kind == "mark" and len(of) == len(series["marks"]):
                    break
            if named:
                drawn = [[float(n) for n in re.findall(r"-?[\d.]+", mark)[:2]] for mark in series["marks"]]
                assert not drawn or series["bars"] == sum(row[5] != "" for row in of)
                check_names(panel, of if drawn else [], drawn)
                for line in series["lines"]:
                    assert all(abs(y - place(panel["y"], float(of[0][4]))) < 0.1 for _, y in corners(line)), of
                continue
            spots = [(place(panel["x"], float(row[3])), place(panel["y"], float(row[4]))) for row in of]
            if kind == "mark":
                assert len(series["marks"]) == len(of) and not series["lines"]
                assert series["bars"] == sum(row[5] != "" for row in of)
                for spot, mark in zip(spots, series["marks"]):
                    drawn = [float(n) for n in re.findall(r"-?[\d.]+", mark)[:2]]
                    assert math.dist(spot, drawn) < 0.1, (spot, drawn)  # coordinates to 0.05
            else:
                assert len(series["lines"]) == 1 and not series["marks"]
                line = corners(series["lines"][0])
                assert math.dist(line[0], spots[0]) < 0.1
                assert max(distance(spot, line) for spot in spots) < 0.8, name  # vertices nearer than half a pixel are left out
    assert not left, left[:3]


def check_figures():
    charts = 0
    for figure in all_of("figure:not(.pictures *)"):
        name = figure.get_attribute("id")
        drawings = all_of("svg", figure)
        assert drawings
        links = {a.text: a.get_attribute("href") for a in all_of("figcaption a", figure)}
        assert "SVG" in links and "CSV" in links, (name, links)
        rows = list(csv.reader(open(os.path.join(report, name + ".csv"), encoding="utf-8")))
        assert len(rows) > 1
        if all_of(".pictures", figure):  # an interface a line; rings and periodic bars
            broken = sum(math.isfinite(float(row[-1] or "nan")) for row in rows[1:])
            words = [text.get_attribute("textContent") for text in all_of("text", drawings[-1])]
            assert any(re.search(rf": {broken} fragments?( |$)", word) for word in words), (broken, words)
            continue
        if rows[0][:3] != ["panel", "series", "kind"]:
            assert len(all_of(".band", figure)) == len(rows) - 1  # a crack pattern
            continue
        charts += 1
        assert re.search(r"\[.+\]|/", rows[0][3] + rows[0][4])
        for svg in drawings:
            check_drawing(svg, rows[1:])
    return charts


# ---- what a reader can do ----

def pressed(figure, key):
    """aria-pressed of the entries of this series, whether each of its drawings is seen, and the same of all other series."""
    return browser.execute_script("""
        const [figure, key] = arguments, of = `[data-key="${key}"]`, seen = what =>
          [...figure.querySelectorAll(what)].map(s => getComputedStyle(s).display !== 'none');
        return [[...figure.querySelectorAll('.entry' + of)].map(e => e.getAttribute('aria-pressed')), seen('.series' + of),
                seen(`.series:not(${of})`)]""", figure, key)


def check_toggles(figure):
    svg = [svg for svg in all_of("svg", figure) if svg.is_displayed()][0]
    entries = all_of(".entry", svg)
    for i, entry in enumerate(entries):
        key = entry.get_attribute("data-key")
        assert entry.get_attribute("role") == "button" and entry.get_attribute("tabindex") == "0"
        before = pressed(figure, key)
        assert set(before[0]) == {"true"} and before[1] and set(before[1]) == {True}
        for press in (click, lambda e: e.send_keys(Keys.ENTER), lambda e: e.send_keys(Keys.SPACE)) if i == 0 else (click,):
            press(entry)
            assert pressed(figure, key) == [["false"] * len(before[0]), [False] * len(before[1]), before[2]]
            press(entry)
            assert pressed(figure, key) == before


def seen(figure):
    return browser.execute_script("""return [...arguments[0].querySelectorAll('.drawing')].filter(d => getComputedStyle(d).display !== 'none')
        .map(d => d.classList[1])""", figure)


def check_axes(figure):
    choices = [choice.get_attribute("class").split()[1] for choice in all_of("input.axes", figure)]
    assert seen(figure) == ["own"]
    for choice in choices[1:] + ["own"]:
        click(one_of(f"input.{choice} + label", figure))
        assert seen(figure) == [choice]
        svg = one_of(f".drawing.{choice} svg", figure)
        assert svg.size["width"] > 200
        panel = all_of(".panel[data-y]", svg)[0]
        kinds = [panel.get_attribute("data-" + axis).split()[0] for axis in "xy"]
        assert kinds == {"own": ["log", "log"], "semilog": ["linear", "log"], "linear": ["linear", "linear"]}[choice]
    one_of("input.own", figure).send_keys(Keys.ARROW_RIGHT)
    assert seen(figure) == [choices[1]]
    one_of(f"input.{choices[1]}", figure).send_keys(Keys.ARROW_LEFT)
    assert seen(figure) == ["own"]


def check_values(figure):
    rows = list(csv.DictReader(open(os.path.join(report, figure.get_attribute("id") + ".csv"), encoding="utf-8")))
    svg = [svg for svg in all_of("svg", figure) if svg.is_displayed()][0]
    marks = all_of(".mark", svg)
    if marks:
        wanted = [row for row in rows if row["kind"] == "mark"]
        covered = 0
        for mark, row in zip(marks, wanted):
            at = [round(place) for place in middle(mark)]  # whole pixels, as the pointer's
            point_at(*at)
            if sys.argv[1] == "factors" and not browser.execute_script("return document.elementFromPoint(...arguments[0]) === arguments[1]", at, mark):
                covered += 1  # sizes of several series are the same by a law
                continue
            x, y = list(row.values())[3:5]
            numbers = [float(n.replace("−", "-")) for n in re.findall(r": (-?[\d.]+(?:e-?\d+)?)", tip())]
            named = not re.fullmatch(r"-?[\d.]+(?:e[-+]?\d+)?", x)
            assert f": {x}\n" in tip() if named else math.isclose(numbers.pop(0), float(x), rel_tol=6e-4), (tip(), row)
            assert math.isclose(numbers[0], float(y), rel_tol=6e-4, abs_tol=1e-12), (tip(), row)
            assert not all_of(":scope > title", mark)  # the browser's own would cover it
        assert covered <= len(marks) / 2  # of two series one lies above
        hover(one_of("h1"))
        assert tip() is None
        browser.execute_script("arguments[0].focus()", marks[0])
        first = tip()
        assert first and [mark.get_attribute("tabindex") for mark in marks] == ["0"] + ["-1"] * (len(marks) - 1)
        if len(marks) > 1:
            marks[0].send_keys(Keys.ARROW_RIGHT)
            assert tip() and tip() != first and browser.switch_to.active_element == marks[1]
        browser.switch_to.active_element.send_keys(Keys.ESCAPE)
        assert tip() is None
        return
    middle(svg)
    point_at(*browser.execute_script("""const line = arguments[0].querySelector('.series .line'), p = line.getPointAtLength(line.getTotalLength() / 2)
        .matrixTransform(line.getScreenCTM()); return [p.x, p.y]""", svg))
    assert tip() and len(re.findall(r": -?[\d.]", tip())) == 2, tip()
    assert all_of(".spot", svg)
    hover(one_of("h1"))
    assert tip() is None


# ---- how it looks ----

def check_widths():
    for scheme in ("light", "dark"):
        media(scheme)
        paper = one_of("body").value_of_css_property("background-color")
        ink = browser.execute_script("return getComputedStyle(document.querySelector('.chart text')).fill")
        bright = [sum(map(int, re.findall(r"\d+", colour)[:3])) for colour in (paper, ink)]
        assert (bright[0] > 600 and bright[1] < 200) == (scheme == "light") and (bright[0] < 200 and bright[1] > 600) == (scheme == "dark")
        for width in (360, 1600):
            resize(width)
            wide = browser.execute_script("return document.documentElement.scrollWidth")
            assert wide <= width, (scheme, width, wide)
            outside = browser.execute_script("""return [...document.querySelectorAll('figure, figure svg, .scroll, dl, p, nav')].filter(e => {
                if (e.closest('.multiples')) return false; /* scrolled within */
                const b = e.getBoundingClientRect(); return b.left < 0 || b.right > innerWidth + 0.5 }).map(e => e.outerHTML.slice(0, 80))""")
            assert not outside, (width, outside)
            many = browser.execute_script("return [...document.querySelectorAll('.multiples svg')].map(e => e.getBoundingClientRect().width).filter(w => w)")
            assert min(many, default=600) >= 600, (width, many)  # small multiples are scrolled, not shrunk
    media()
    resize(1600)


def overlaps():
    """Texts of a drawing that cover each other."""
    return browser.execute_script("""
        const bad = [];
        for (const svg of document.querySelectorAll('figure svg.chart')) {
          if (!svg.getBoundingClientRect().width) continue;
          const boxes = [...svg.querySelectorAll('text')].map(t => [t.textContent, t.getBoundingClientRect()]);
          const all = svg.getBoundingClientRect();
          boxes.forEach(([a, p], i) => {
            if (p.left < all.left - 1 || p.right > all.right + 1) bad.push(['outside', a]);
            for (const [b, q] of boxes.slice(i + 1))
              if (p.left + 1 < q.right && q.left + 1 < p.right && p.top + 4 < q.bottom && q.top + 4 < p.bottom) bad.push([a, b]);
          });
        }
        return bad;""")


def check_print(figures, tables):
    media(kind="print")
    resize(703)  # of a page of A4 without its margins
    for table in all_of("table"):
        box = table.rect
        assert box["x"] + box["width"] <= 703, "a table is cut when printed"
    media(kind="")
    browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    data = base64.b64decode(browser.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True, "printBackground": True})["data"])
    path = os.path.join(home.name, "page.pdf")
    open(path, "wb").write(data)
    said = subprocess.run(["pdfinfo", path], check=True, capture_output=True, text=True).stdout
    pages = int(re.search(r"Pages: +(\d+)", said).group(1))
    text = subprocess.run(["pdftotext", "-layout", path, "-"], check=True, capture_output=True, text=True).stdout
    media()
    resize(1600)
    assert 0 < pages <= figures
    assert "Contents" not in text and "linear axes" not in text  # what is for a screen alone
    for k in range(1, figures + 1):
        assert f"Figure {k}." in text
    for k in range(1, tables + 1):
        assert f"Table {k}." in text
    return pages


def check_rows():
    """Rows of six pictures, each with a link to its film: the films."""
    rows = all_of(".pictures")
    for row in rows:
        assert len(row.find_elements(By.XPATH, "./figure")) == 6
    films = [a.get_attribute("href") for a in all_of(".film a")]
    assert len(films) == len(rows)
    return [film[len("file://"):] for film in films]


def check_film(path, values):
    """A film: drawn at every instant, in every colour, as wide as the window."""
    browser.get("file://" + path)
    canvas = one_of("canvas")
    shown = lambda: int(canvas.get_attribute("data-drawn") or -1)
    pixels = lambda: browser.execute_script("return arguments[0].toDataURL()", canvas)
    play, slider = all_of("button")[0], all_of("input[type=range]")[0]
    last = int(slider.get_attribute("max"))
    wait = lambda wanted: WebDriverWait(browser, 30).until(lambda _: shown() == wanted)
    wait(last)
    assert float(all_of("input[type=range]")[1].get_attribute("value")) > 0  # fragments of these bodies hardly part: enlarged
    seen = {pixels()}

    def differs():
        """The next drawing is like none before."""
        WebDriverWait(browser, 30).until(lambda _: pixels() not in seen)
        seen.add(pixels())

    slider.send_keys(Keys.HOME)
    wait(0)
    assert "at 0 s: 1 fragment" in canvas.get_attribute("aria-label"), canvas.get_attribute("aria-label")
    differs()
    click(play)
    WebDriverWait(browser, 60).until(lambda _: shown() == last and play.text == "Play")
    for value in values:
        all_of(f"option[value={value}]")[0].click()
        differs()
    for _ in "motion", "apart":
        all_of("input[type=range]")[1 + (_ == "apart")].send_keys(Keys.END)
        differs()
    canvas.send_keys(Keys.ARROW_LEFT)
    differs()
    media("dark")
    differs()
    media()
    resize(400)
    WebDriverWait(browser, 30).until(lambda _: browser.execute_script("return document.documentElement.scrollWidth") <= 400)
    resize(1200)


def check_pdfs():
    """Vectors of the size of the drawing, with its words."""
    names = [name for name in sorted(os.listdir(report)) if name.endswith(".pdf")]
    linked = {os.path.basename(a.get_attribute("href")) for a in all_of("figcaption a") if a.text == "PDF"}
    assert set(names) == linked
    for name in names:
        path = os.path.join(report, name)
        drawing = xml.parse(path[:-4] + ".svg").getroot()
        said = subprocess.run(["pdfinfo", path], check=True, capture_output=True, text=True).stdout
        size = re.search(r"Page size: +([\d.]+) x ([\d.]+)", said).groups()
        assert [float(s) for s in size] == [0.75 * float(drawing.get(side)) for side in ("width", "height")]
        images = subprocess.run(["pdfimages", "-list", path], check=True, capture_output=True, text=True).stdout
        assert len(images.splitlines()) == 2, "a picture of pixels in " + name
        words = subprocess.run(["pdftotext", path, "-"], check=True, capture_output=True, text=True).stdout
        for text in drawing.iter("{http://www.w3.org/2000/svg}text"):
            if re.fullmatch(r"[a-z ]+", text.text):
                assert all(word in words for word in text.text.split()), (name, text.text)
        assert "CreationDate" not in said
    return len(names)


try:
    resize(1600)
    media()
    browser.get(url)
    figures, tables = len(all_of("figure:not(.pictures *)")), len(all_of("table"))
    captions = [caption.text for caption in all_of("figcaption:not(.pictures *)")]
    of_four = bool(all_of("#converge-count"))  # studies: the figures name their folder, which is no campaign
    for k, caption in enumerate(captions, 1):
        assert caption.startswith(f"Figure {k}. ") and (", campaign " in caption) != of_four, caption
        assert not of_four or re.search(r"\. converged, fracas [0-9]", caption), caption
    ids = browser.execute_script("return [...document.querySelectorAll('[id]')].map(e => e.id)")
    assert len(ids) == len(set(ids)), sorted(i for i in ids if ids.count(i) > 1)
    for link in all_of("a"):
        target = link.get_attribute("href")
        if "#" in target:
            assert target.split("#")[1] in ids, target
    source = open(os.path.join(report, "index.html"), encoding="utf-8").read()
    for tag in ("style", "script"):
        assert len(re.search(f"<{tag}>(.*?)</{tag}>", source, re.S).group(1)) < 32 << 10
    charts = check_figures()
    assert charts >= 4
    assert not overlaps(), overlaps()
    converged = [f"converge-{name}" for name in ("count", "size", "dissipated", "onset_time")]
    for name in converged if all_of("#converge-count") else ("size-against-rate", "size-against-rate-normalised", "sizes", "sizes-point-1", "energies-point-0"):
        figure = browser.find_element(By.ID, name)
        check_toggles(figure)
        check_values(figure)
        if all_of("input.axes", figure):
            check_axes(figure)
    check_widths()
    films = check_rows()
    assert len(films) == {"rates": 0, "rings": 2, "factors": 0, "converged": 0}[sys.argv[1]], films
    pages = check_print(figures, tables)
    pdfs = check_pdfs()
    errors = browser.get_log("browser")
    assert not errors, errors
    asked = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
    asked = [message["params"]["request"]["url"] for message in asked if message["method"] == "Network.requestWillBeSent"]
    asked = asked[asked.index(url):]  # before it, the browser's own first page
    assert all(address == url or address.startswith("data:") for address in asked), asked
    computed = os.path.abspath(os.path.join(sys.argv[1], "film.html"))
    for film, values in [(computed, ("speed", "stress"))] * os.path.exists(computed) + [(one, ("speed",)) for one in films[:1]]:
        check_film(film, values)
        errors = browser.get_log("browser")
        assert not errors, errors
finally:
    browser.quit()
    home.cleanup()
print(f"{sys.argv[1]}: {figures} figures, of these {charts} charts, {tables} tables, {pages} printed pages, {pdfs} PDFs")
