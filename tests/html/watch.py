"""Uses the page of `linkproof watch` in headless Chromium: watch.py LINKPROOF CHROMIUM DIRECTORY

A file is edited, broken, mended, saved thirty times in a row, deleted and restored; numbers are changed on the page by the
text, by a slider and by dragging a point, and kept. Foreign origins, hosts and addresses without the word are refused.
Prints the time from saving a file to the new picture, and to the verdict. Screenshots go to DIRECTORY.
"""

import contextlib
import http.client
import json
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from urllib.parse import urlsplit

from playwright.sync_api import sync_playwright

TOP = Path(__file__).resolve().parent.parent.parent
SAVES = 30
# Only a standstill takes this long (ms), even on a slow machine.
PATIENCE = 60_000


def need(holds, what):
    if not holds:
        sys.exit(f"watch: {what}")


@contextlib.contextmanager
def watched(linkproof, file):
    """The address of a running page."""
    child = subprocess.Popen([linkproof, "watch", file], stdout=subprocess.PIPE, text=True)
    try:
        found = re.search(r"http://127\.0\.0\.1:\d+/[0-9a-f]{32}/", child.stdout.readline())
        need(found, "no address is printed")
        yield found.group()
    finally:
        child.kill()
        child.wait()


def asked(address, path, method="GET", body=None, **headers):
    """Status of a request to the server, with these headers."""
    parts = urlsplit(address)
    connection = http.client.HTTPConnection(parts.hostname, parts.port, timeout=30)
    connection.request(method, path, body, headers)
    return connection.getresponse().status


def refuses_strangers(address):
    parts = urlsplit(address)
    ours, path = f"http://{parts.netloc}", parts.path
    need(asked(address, path) == 200, "the page is not served")
    need(asked(address, path, Origin="http://evil.example") == 403, "a foreign origin is served")
    need(asked(address, path, Host="evil.example") == 403, "a foreign host is served")
    need(asked(address, "/" + "0" * 32 + "/") == 404, "the page is served without its word")
    draft = json.dumps({"text": "x"})
    need(asked(address, path + "draft", "POST", draft) == 403, "a change without an origin is taken")
    need(asked(address, path + "draft", "POST", draft, Origin="null") == 403, "a change from a foreign origin is taken")
    need(asked(address, path + "keep", "POST", "no json", Origin=ours) == 400, "a body without JSON is taken")
    need(asked(address, path + "no/such", "GET") == 404, "an unknown address is served")


class Page:
    """The page in the browser."""

    def __init__(self, browser, address):
        self.page = browser.new_page(viewport={"width": 1500, "height": 900})
        self.faults = []
        self.page.on("console", lambda message: self.faults.append(message.text))
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.goto(address)

    def status(self, words):
        """Waits until the status begins with these words, and the page of a verdict is there."""
        wanted = "(words) => document.getElementById('status').textContent.startsWith(words) && !['moving', 'solved', 'proven'].includes(state.stage)"
        self.page.wait_for_function(wanted, arg=words, timeout=PATIENCE)

    def shown(self, stages, since):
        """Waits for a picture of one of these stages that became visible after the time `since` (s), and returns its delay (s)."""
        wanted = "([stages, since]) => (window.linkproofShown.find((own) => stages.includes(own.stage) && own.at > since) || {}).at"
        return self.page.wait_for_function(wanted, arg=[stages, since * 1e3], timeout=PATIENCE).json_value() / 1e3 - since

    def text(self):
        return self.page.evaluate("document.getElementById('text').value")

    def frame(self):
        """The visible page of the mechanism."""
        return self.page.query_selector("iframe").content_frame()


def main(linkproof, chromium, directory):
    pictures = Path(directory)
    with tempfile.TemporaryDirectory() as place, sync_playwright() as play:
        browser = play.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        subprocess.run([linkproof, "new", "four-bar"], cwd=place, check=True, capture_output=True)
        file = Path(place, "four_bar.toml")
        given = file.read_text()
        with watched(linkproof, file) as address:
            refuses_strangers(address)
            page = Page(browser, address)
            page.status("AGREE")
            page.page.screenshot(path=pictures / "watch.png")
            need(page.text() == given, "the text is not that of the file")
            # The page shows a mistake in the file at its line, with advice; then the file is corrected.
            file.write_text(given.replace("crank_mm = 40", "crank_mm = forty"))
            page.status("1 mistake")
            line = 1 + given[: given.index("crank_mm = 40")].count("\n")
            need(page.page.text_content("#lines .wrong").strip() == str(line), "the wrong line is not marked")
            need(f"line {line}: " in page.page.text_content("#errors"), "the mistake has no line")
            need(page.page.query_selector("#right.stale"), "an old verdict is shown beside a mistake")
            page.page.screenshot(path=pictures / "watch_mistake.png")
            file.write_text(given)
            page.status("AGREE")
            # The text is changed on the page; the file stays unchanged until the draft is kept.
            page.page.fill("#text", given.replace("rocker_mm = 80", "rocker_mm = 85"))
            page.page.wait_for_function("() => document.querySelector('input[name=rocker_mm]').value === '85'", timeout=PATIENCE)
            need(file.read_text() == given, "a draft was written to the file")
            page.page.evaluate("const own = document.querySelector('input[name=crank_mm]'); own.value = 35; own.dispatchEvent(new Event('input'))")
            page.page.wait_for_function("() => document.getElementById('text').value.includes('crank_mm = 35 ')", timeout=PATIENCE)
            page.status("AGREE")
            # The next page shows what was set on the page before: boxes, and open groups of channels.
            page.frame().click("#show-names")
            page.frame().evaluate("document.querySelectorAll('#charts > details')[2].open = true")
            page.page.fill("#text", page.text() + "# a comment\n")
            page.page.wait_for_function("() => document.getElementById('frame').contentDocument.body.textContent.includes('# a comment')", timeout=PATIENCE)
            page.status("AGREE")
            need(not page.frame().is_checked("#show-names"), "a box is reset by the next page")
            need(page.frame().evaluate("document.querySelectorAll('#charts > details')[2].open"), "a group of channels is closed by the next page")
            # Joint B is dragged while the mechanism stands.
            frame = page.frame()
            if frame.get_attribute("#play", "aria-pressed") == "true":
                frame.click("#play")
            frame.press("body", "Home")
            before = page.text()
            joint = frame.query_selector("#joints circle:has(title:text-matches('^joint B,'))")
            joint.scroll_into_view_if_needed()
            box = joint.bounding_box()
            x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
            page.page.mouse.move(x, y)
            page.page.mouse.down()
            page.page.mouse.move(x + 15, y - 10, steps=4)
            page.page.mouse.up()
            page.page.wait_for_function("(before) => document.getElementById('text').value !== before", arg=before, timeout=PATIENCE)
            moved = page.text()
            changed = [new for old, new in zip(before.splitlines(), moved.splitlines()) if old != new]
            need({line.split("_mm")[0] for line in changed} == {"coupler", "rocker"}, f"dragging B changed {changed}")
            need(file.read_text() == given, "dragging wrote to the file")
            page.status("AGREE")
            page.page.click("#keep")
            page.page.wait_for_function("() => document.getElementById('keep').disabled", timeout=PATIENCE)
            need(file.read_text() == moved, "the kept text is not that of the page")
            # Saves in a row: the last one is shown.
            for number in range(SAVES):
                file.write_text(given.replace("crank_mm = 40", f"crank_mm = {30 + number / 4}"))
                time.sleep(0.02)
            page.page.wait_for_function("() => document.getElementById('text').value.includes('crank_mm = 37.25 ')", timeout=PATIENCE)
            page.status("AGREE")
            need(page.frame().evaluate("document.querySelector('#settings pre').textContent.includes('crank_mm = 37.25 ')"), "an old page is shown")
            # The file deleted, and another one in its place.
            file.unlink()
            page.status("the file is missing")
            shutil.copy(TOP / "scenarios/quick_return.toml", file)
            page.status("AGREE")
            need("quick_return" in page.text(), "the new file is not shown")
            # An edit on the page is not replaced by the file.
            page.page.evaluate("document.getElementById('text').value += '# mine\\n'; document.getElementById('text').dispatchEvent(new Event('input'))")
            file.write_text(given)
            page.page.wait_for_function("() => !document.getElementById('reload').hidden", timeout=PATIENCE)
            need(page.text().endswith("# mine\n"), "an edit is lost")
            page.page.click("#reload")
            page.page.wait_for_function("() => document.getElementById('text').value.includes('rocker_mm = 80')", timeout=PATIENCE)
            need(not page.faults, f"messages of the browser: {page.faults[:3]}")
            # A second file has its own page.
            with watched(linkproof, TOP / "scenarios/slider_crank_friction.toml") as other:
                second = Page(browser, other)
                second.page.wait_for_function("() => document.getElementById('text').value.includes('slider_crank_friction')", timeout=PATIENCE)
                need("rocker_mm" in page.text(), "two files are mixed up")
                second.page.close()
            page.page.close()
        # Times from saving to the picture and to the verdict.
        shutil.copytree(TOP / "scenarios", Path(place, "scenarios"))
        file = Path(place, "scenarios/ov7_base.toml")
        given = file.read_text()
        with watched(linkproof, file) as address:
            page = Page(browser, address)
            page.status("AGREE")
            times = {"moving solved proven judged": [], "proven judged": []}
            for number in range(11):
                since = time.time()
                file.write_text(given + f"# {number}\n")
                for stages, all_times in times.items():
                    all_times.append(page.shown(stages.split(), since))
                time.sleep(0.2)
            page.page.screenshot(path=pictures / "watch_ov7_base.png")
            need(not page.faults, f"messages of the browser: {page.faults[:3]}")
            for what, all_times in zip(["the new picture", "the verdict"], times.values()):
                print(f"watch: ov7_base from saving to {what}: median {1e3 * statistics.median(all_times):.0f} ms")
        browser.close()
    print("watch: edit, mistake, slider, drag, keep, 30 saves, missing file, two files and strangers pass")


main(*sys.argv[1:])
