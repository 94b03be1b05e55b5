"""Opens pages of `linkproof run --html` in headless Chromium: check.py LINKPROOF CHROMIUM DIRECTORY some|everything SCENARIO...

Every page is checked for console messages and network requests; for positions of links, loads and plans against the output
of `linkproof`; for keyboard, pointer and printing; and for names of visible elements, contrast and overflow.
Screenshots at three widths, light and dark, go to DIRECTORY.
"""

import csv
import io
import json
import math
import subprocess
import sys
from pathlib import Path

from playwright.sync_api import Error, sync_playwright

from contents import check_loads, check_plans
from wrong import GO_TO, WITHIN, Wrong, need

WIDTHS = [360, 900, 1600]
MOST_BYTES = 3_000_000
# Transforms of all drawn links of a side.
READ = """
(side) => [...document.querySelectorAll(`#picture .${side} [data-link]`)].map((part) => ({
    link: Number(part.dataset.link), matrix: part.getAttribute('transform').match(/-?[\\d.]+(?:e[-+]?\\d+)?/g).map(Number),
    hidden: part.classList.contains('hidden'),
}))
"""
UNNAMED = """
() => [...document.querySelectorAll('svg, input, select, button')].filter((own) => own.getAttribute('aria-hidden') !== 'true'
    && !own.getAttribute('aria-label') && !own.getAttribute('aria-labelledby') && !own.closest('label')
    && !own.textContent.trim()).map((own) => own.outerHTML.slice(0, 120))
"""
TOO_WIDE = "() => document.documentElement.scrollWidth - document.documentElement.clientWidth"


# Texts whose contrast to their background is below the minimum of WCAG 2, level AA.
PALE = """
() => {
    const parts = (colour) => (colour.match(/[\\d.]+/g) || []).map(Number);
    const light = ([r, g, b]) => [r, g, b].map((own) => own / 255)
        .map((own) => (own <= 0.04045 ? own / 12.92 : ((own + 0.055) / 1.055) ** 2.4))
        .reduce((sum, own, k) => sum + own * [0.2126, 0.7152, 0.0722][k], 0);
    const behind = (own) => {
        for (let at = own; at !== null; at = at.parentElement) {
            const found = parts(getComputedStyle(at).backgroundColor);
            if (found.length === 3 || found[3] === 1) return found;
        }
        return [255, 255, 255];
    };
    const found = [];
    for (const own of document.querySelectorAll('body *')) {
        if (!own.checkVisibility() || ![...own.childNodes].some((child) => child.nodeType === 3 && child.data.trim())) continue;
        if (own.closest('noscript, script, style, title, option')) continue;
        const style = getComputedStyle(own);
        const pair = [light(parts(own instanceof SVGElement ? style.fill : style.color)), light(behind(own))].sort((a, b) => b - a);
        const ratio = (pair[0] + 0.05) / (pair[1] + 0.05);
        const size = parseFloat(style.fontSize);
        const least = size >= 24 || (size >= 18.66 && style.fontWeight >= 700) ? 3 : 4.5;
        if (ratio < least) found.push(`${ratio.toFixed(2)} : 1 in "${own.textContent.trim().slice(0, 40)}"`);
    }
    return found.slice(0, 5);
}
"""


def solution(linkproof, scenario):
    """Rows of the solution by time, as printed."""
    told = subprocess.run([linkproof, "solve", scenario, "--with", "assur", "--csv", "-"], check=True, capture_output=True, text=True)
    return {float(row["t_s"]): row for row in csv.DictReader(io.StringIO(told.stdout))}


def places(parts, motion):
    """Link by link: angle, and world coordinates of the mass centre (m)."""
    found = {}
    for part in parts:
        if part["link"] == 0:
            continue
        a, b, c, d, e, f = part["matrix"]
        need(abs(a + d) < 1e-12 and abs(b - c) < 1e-12, "a link is stretched")
        x, y = motion["links"][part["link"] - 1]["centre"]
        unit = motion["unit"]
        found[part["link"]] = (math.atan2(-b, a), e * unit + a * x + b * y, -(f * unit + b * x - a * y))
    return found


def check_motion(tab, data, rows):
    """The slider moves links to the coordinates of the solution."""
    if "motion" not in data:
        return 0.0
    motion = data["motion"]
    time = tab.evaluate("() => [...time]")
    count = len(time)
    tried = sorted({0, 1 % count, count // 7, count // 3, count // 2, 5 * count // 6, count - 1})
    worst, met = 0.0, 0
    for row in tried:
        tab.evaluate(GO_TO, row)
        sides = [places(tab.evaluate(READ, side), motion) for side in ["reference", "engine"]]
        right = rows.get(time[row])
        for number, link in enumerate(motion["links"], 1):
            angle, x, y = sides[0][number]
            if right is not None:
                met += 1
                name = link["name"]
                off = [float(right[f"link.{name}.{axis}_m"]) - own for axis, own in [("x", x), ("y", y)]]
                turn = math.remainder(float(right[f"link.{name}.angle_rad"]) - angle, math.tau)
                worst = max(worst, math.hypot(*off) / motion["size"], abs(turn))
            if number in sides[1] and data["engines"][0]["channels"][link["at"][1]].get("max") is not None:
                allowed = sum(data["engines"][0]["channels"][own]["max"] for own in link["at"][1:]) + WITHIN * motion["size"]
                need(math.hypot(sides[1][number][1] - x, sides[1][number][2] - y) <= allowed, f"the engine is off at row {row}")
    need(not rows or met >= len(motion["links"]) * min(4, len(tried)), "the solution has other instants")
    need(worst <= WITHIN, f"links are off by {worst:.1e} of the size")
    return worst


def check_keys(tab, count):
    """Checks that the page works without a mouse."""
    at = lambda: int(tab.evaluate("() => document.getElementById('slider').value"))
    tab.evaluate("() => document.activeElement.blur()")
    for key, row in [("Home", 0), ("ArrowRight", min(1, count - 1)), ("ArrowLeft", 0), ("End", count - 1), ("Home", 0), ("Shift+ArrowRight", min(10, count - 1))]:
        tab.keyboard.press(key)
        need(at() == row, f"{key} shows row {at()}, not {row}")
    playing = lambda: tab.evaluate("() => document.getElementById('play').getAttribute('aria-pressed')")
    if count > 1:
        tab.keyboard.press("Space")
        need(playing() == "true", "Space does not play")
        tab.wait_for_timeout(300)
        need(at() != min(10, count - 1) or count < 60, "the picture does not move while it plays")
        tab.keyboard.press("Space")
        need(playing() == "false", "Space does not stop")
    if not tab.locator("#picture").count():
        return
    if tab.locator("#show-loads").count():
        tab.keyboard.press("f")
        need(not tab.locator("#loads").is_visible(), "F does not hide loads")
        tab.keyboard.press("f")
    named = "() => document.querySelector('#picture').classList.contains('no-names')"
    tab.keyboard.press("n")
    need(tab.evaluate(named), "N does not hide names")
    tab.keyboard.press("n")
    # From the top of the page, the tab key reaches the first control.
    tab.evaluate("() => document.activeElement.blur()")
    tab.keyboard.press("Tab")
    # The block about a wrong formula lies above the picture; it scrolls, so the tab key reaches it first.
    while tab.evaluate("() => document.activeElement.matches('#why pre')"):
        tab.keyboard.press("Tab")
    for own in ["play", "back", "on", "slider", "speed", "loop"]:
        at = tab.evaluate("() => document.activeElement.id")
        need(at == own, f"the tab key reaches {at} instead of {own}")
        tab.keyboard.press("Tab")


def check_pointer(tab, count):
    """Checks that a click on a chart selects the instant, and that the values under the pointer are shown."""
    if count < 10:
        return
    # Charts are drawn when they come near the window.
    tab.locator("#charts .card").first.scroll_into_view_if_needed()
    chart = tab.locator("#charts svg").first
    chart.scroll_into_view_if_needed()
    box = chart.bounding_box()
    tab.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 0.3 * box["height"])
    read = chart.locator("xpath=following-sibling::p").inner_text()
    need(": " in read, f"a chart shows no value under the pointer: {read}")
    tab.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 0.3 * box["height"])
    row = int(tab.evaluate("() => document.getElementById('slider').value"))
    need(0.05 * count < row < 0.95 * count, f"a click on a chart goes to row {row} of {count}")
    cursor = float(chart.locator(".cursor").get_attribute("x1")) / 340
    need(abs(cursor - 0.5) < 0.1, "the cursor of a chart is not at the instant")


def check_play(browser, path):
    """Checks that the page plays in a loop, unless the browser requests reduced motion."""
    tab = browser.new_page(reduced_motion="no-preference")
    tab.goto(path.as_uri())
    at = lambda: tab.evaluate("() => shown.time")
    need(tab.locator("#play").get_attribute("aria-pressed") == "true", "the page does not play by itself")
    tab.evaluate("() => goToTime(time[last] - 1e-3 * duration)")
    tab.wait_for_timeout(500)
    need(at() < tab.evaluate("() => time[0] + 0.9 * duration"), "the page does not begin again at the end")
    need("1 :" in tab.locator("#speed option:checked").inner_text(), "the page does not state that the motion is slow")
    tab.close()


def check_page(browser, linkproof, scenario, path, rows, pictures):
    size = path.stat().st_size
    need(size < MOST_BYTES, f"{size} bytes")
    need("</script><b>" not in path.read_text(), "a name has become markup")
    said = []
    context = browser.new_context(viewport={"width": 800, "height": 1100}, reduced_motion="reduce", offline=True)
    tab = context.new_page()
    tab.on("console", lambda message: said.append(f"console: {message.text}"))
    tab.on("pageerror", lambda error: said.append(f"error: {error}"))
    tab.on("request", lambda request: said.append(f"request: {request.url[:100]}")
           if request.url != path.as_uri() and not request.url.startswith("data:") else None)
    tab.goto(path.as_uri())
    data = json.loads(tab.evaluate("() => document.getElementById('data').textContent"))
    need(tab.locator("#play").get_attribute("aria-pressed") == "false", "the page plays although reduced motion is requested")
    agrees = tab.locator("#verdict .agree").count() == 1
    need(agrees == (tab.locator("#why p").count() == 0), "the head of the page does not give the reasons")
    worst = check_motion(tab, data, rows)
    if rows:
        check_loads(tab, data, scenario, rows)
        check_plans(tab, data, linkproof, scenario)
    check_keys(tab, tab.evaluate("() => time.length"))
    need(len(data["channels"]) == tab.locator("#charts .card").count(), "a channel has no card")
    check_pointer(tab, tab.evaluate("() => time.length"))
    tab.locator("#open-all").click()
    for step in range(60):
        tab.evaluate(f"() => window.scrollTo(0, {step} * 900)")
    tab.wait_for_timeout(50)
    tab.evaluate("() => window.scrollTo(0, 0)")
    tab.wait_for_timeout(50)
    tab.evaluate(GO_TO, tab.evaluate("() => time.length") // 3)
    need(tab.pdf()[:4] == b"%PDF", "the page cannot be printed")
    told = tab.evaluate("() => [...document.querySelectorAll('#plan-list .card > .numbers')].map((own) => own.textContent === atInstant())")
    need(all(told), "plans are printed at another instant")
    drawn = tab.locator("#charts svg").count()
    need(drawn == len(data["channels"]), f"{drawn} of {len(data['channels'])} channels are drawn when printed")
    unnamed = tab.evaluate(UNNAMED)
    need(not unnamed, f"visible elements without a name: {unnamed}")
    for own in ["#engine", "#magnify", "#over"]:
        if tab.locator(own).count():
            for index in reversed(range(tab.locator(f"{own} option").count())):
                tab.locator(own).select_option(index=index)
    context.close()
    for scheme in ["light", "dark"] if pictures else []:
        for width in WIDTHS:
            context = browser.new_context(viewport={"width": width, "height": 1500}, color_scheme=scheme, reduced_motion="reduce")
            tab = context.new_page()
            tab.goto(path.as_uri())
            tab.evaluate(GO_TO, max(1, len(rows or []) // 5))
            wide = tab.evaluate(TOO_WIDE)
            need(wide <= 0, f"in a window of {width} pixels, the page is {wide} pixels too wide")
            pale = tab.evaluate(PALE) if width == WIDTHS[0] else []
            need(not pale, f"too pale ({scheme}): {'; '.join(pale)}")
            tab.screenshot(path=path.with_name(f"{path.stem}-{width}-{scheme}.png"))
            context.close()
    need(not said, "; ".join(said[:5]))
    return size, worst


def chain(dyads):
    """A crank and a chain of dyads."""
    ends = lambda of: "\n".join(f"{name} = {{ x_mm = {x}, y_mm = {y} }}" for name, x, y in of)
    links = {"crank": [("O", 0, 0), ("B0", 30, 0)]}
    joints = [("O", "ground", "crank")]
    before = "crank"
    for k in range(1, dyads + 1):
        links[f"rod_{k}"] = [(f"B{k - 1}", 0, 0), (f"A{k}", 125, 0)]
        links[f"lever_{k}"] = [(f"G{k}", 0, 0), (f"A{k}", 100, 0), (f"B{k}", 90, 8)]
        joints += [(f"B{k - 1}", before, f"rod_{k}"), (f"A{k}", f"rod_{k}", f"lever_{k}"), (f"G{k}", "ground", f"lever_{k}")]
        before = f"lever_{k}"
    text = 'format = 1\nname = "chain"\ntitle = "Dyads behind each other"\n[ground.points]\n'
    text += ends([("O", 0, 0)] + [(f"G{k}", 120 * k, -60) for k in range(1, dyads + 1)])
    for name, points in links.items():
        text += f"\n[links.{name}]\nmass_kg = 0.5\ninertia_kg_m2 = 0.001\nmass_centre = {{ x_mm = 40, y_mm = 0 }}\n[links.{name}.points]\n{ends(points)}"
    for name, first, second in joints:
        text += f'\n[[joints]]\nname = "{name}"\ntype = "revolute"\nlinks = ["{first}", "{second}"]'
    text += '\n[drive]\njoint = "O"\nspeed_rpm = 60\n[gravity]\nx_m_s2 = 0\ny_m_s2 = -9.81\n[start]\ncrank_deg = 90'
    for k in range(1, dyads + 1):
        text += f'\n[[start.groups]]\nlinks = ["rod_{k}", "lever_{k}"]\nmode = "left"'
    return text + "\n[grid]\nfrom_deg = 90\nto_deg = 450\nstep_deg = 2\n"


def special(scenarios, directory):
    """Runs whose pages differ in kind: scenario, name of the page, options."""
    at = lambda name: str(scenarios / f"{name}.toml")
    hostile = directory / "hostile.toml"
    # Names of links are single words, but titles, names of published numbers and comments may be any text.
    bad = "</script><b>&'<!-- <script>console.log(1)</script>"
    text = Path(at("pendulum")).read_text()
    formulas = Path(at("formulas/slider_crank_centric")).read_text()
    wrong_formula = directory / "wrong_formula.toml"
    wrong_formula.write_text(formulas.replace('"r*cos(phi) + sqrt', '"r*cos(phi) - sqrt'))
    wrong_number = directory / "wrong_number.toml"
    wrong_number.write_text(Path(at("crank_rocker")).read_text().replace("value = -2879.36879", "value = -2978.36879"))
    many_links = directory / "many_links.toml"
    many_links.write_text(chain(11))
    hostile.write_text(f"# {bad}\n" + text.replace('title = "', f'title = "{bad}').replace('name = "Newton', f'name = "{bad}Newton'))
    return [
        (at("crank_rocker"), "disagrees", ["--tolerance-scale", "1e-3"]),
        (at("crank_rocker"), "inconclusive", ["--dt", "0.02"]),
        (at("crank_rocker"), "several_engines", ["--engine", "rapier", "--engine", "impulse"]),
        (at("crank_rocker"), "positions_only", ["--only", "positions"]),
        (at("crank_rocker"), "without_places", ["--only", "joint.B"]),
        (at("crank_rocker"), "one_instant", ["--times", "0.1"]),
        (at("crank_rocker"), "long", ["--times", "0:4.6:0.0002"]),
        (str(hostile), "hostile", []),
        (str(wrong_formula), "wrong_formula", []),
        (str(wrong_number), "wrong_number", []),
        (str(many_links), "many_links", []),
    ]


def main():
    linkproof, chromium, directory = sys.argv[1], sys.argv[2], Path(sys.argv[3]).resolve()
    cases = [(scenario, Path(scenario).stem, []) for scenario in sys.argv[5:]]
    if sys.argv[4] == "everything":
        cases += special(Path(cases[0][0]).parent, directory)
    failed = 0
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        for scenario, name, options in cases:
            path = directory / f"{name}.html"
            try:
                made = subprocess.run([linkproof, "run", scenario, "--no-record", "--quiet", "--html", path, *options], capture_output=True, text=True)
                need(made.returncode in (0, 1, 3), made.stderr)
                rows = solution(linkproof, scenario) if not options else {}
                size, worst = check_page(browser, linkproof, scenario, path, rows, True)
                if name == "crank_rocker":
                    check_play(browser, path)
                print(f"{name:24} {size / 1e6:6.2f} MB" + (f"  links within {worst:.1e} of the size" if rows else ""), flush=True)
            except (Wrong, Error) as wrong:
                print(f"{name:24} WRONG: {wrong}", flush=True)
                failed += 1
        browser.close()
    return 1 if failed else 0


sys.exit(main())
