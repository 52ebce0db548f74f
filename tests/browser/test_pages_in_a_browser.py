from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from playwright.sync_api import Browser, Page

pytestmark = pytest.mark.browser

PAGES = ["pendulum", "static", "measured", "suite", "campaign", "extraction"]


class Watched:
    """A page with what it said on its console and what it asked for."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.said: list[str] = []
        self.asked: list[str] = []
        page.on("console", lambda message: self.said.append(message.text))
        page.on("pageerror", lambda error: self.said.append(str(error)))
        page.on("request", lambda request: self.asked.append(request.url))


def opened(browser: Browser, folder: Path, name: str, **context: Any) -> Watched:  # noqa: ANN401  # Playwright's options
    options = {"viewport": {"width": 1280, "height": 900}} | context
    watched = Watched(browser.new_context(**options).new_page())
    watched.page.goto((folder / f"{name}.html").as_uri())
    return watched


@pytest.fixture
def pendulum(browser: Browser, folder: Path) -> Iterator[Page]:
    watched = opened(browser, folder, "pendulum")
    yield watched.page
    assert watched.said == []
    watched.page.context.close()


def scrub(page: Page, milliseconds: float) -> None:
    slider = page.locator("[data-scrub]")
    slider.evaluate("(s, v) => { s.value = v; s.dispatchEvent(new Event('input')); }", milliseconds)


def shown(page: Page, gauge: str) -> float:
    return float(page.locator(f'[data-gauge="{gauge}"]').inner_text().replace("−", "-"))


@pytest.mark.parametrize("name", PAGES)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_page_opens_from_a_file_in_silence(browser: Browser, folder: Path, name: str, scheme: str) -> None:
    watched = opened(browser, folder, name, color_scheme=scheme)
    watched.page.wait_for_timeout(100)
    assert watched.said == []
    assert [url for url in watched.asked if not url.startswith("data:")] == [
        (folder / f"{name}.html").as_uri()
    ]
    watched.page.context.close()


def test_play_moves_the_leg(pendulum: Page) -> None:
    bone = pendulum.locator("[data-stage] path").last
    before = bone.get_attribute("transform")
    pendulum.get_by_role("button", name="Play").click()
    pendulum.wait_for_function(
        "b => document.querySelector('[data-stage] path:last-child').getAttribute('transform') !== b",
        arg=before,
    )
    pendulum.get_by_role("button", name="Pause").click()
    paused = bone.get_attribute("transform")
    pendulum.wait_for_timeout(150)
    assert bone.get_attribute("transform") == paused


@pytest.mark.parametrize("sample", [0, 25, 57, 150, 499])
def test_scrubbing_sets_the_gauges_to_the_values_of_the_document(pendulum: Page, sample: int) -> None:
    from support import synthetic_result  # noqa: PLC0415  # its folder is on the path only in a session

    curves = synthetic_result.result().curves
    assert curves
    # The slider ends with the motion, the curves go on: those are reached by a click on a curve.
    time = min(curves.start + sample * curves.interval, 0.08)
    scrub(pendulum, time * 1e3)
    index = round(time / curves.interval)
    for name, decimals in (("T1", 1), ("T4", 1), ("MCL", 2), ("contact force", 0)):
        assert shown(pendulum, name) == pytest.approx(
            curves.series[name].values[index], abs=0.51 * 10.0**-decimals
        )


def test_a_click_on_a_criterion_shows_its_curve_with_its_peak_marked(pendulum: Page) -> None:
    pendulum.get_by_role("link", name="T1", exact=True).click()
    figure = pendulum.locator("#pendulum-chart-T1")
    assert figure.evaluate("f => f === document.activeElement")
    assert "selected" in (figure.get_attribute("class") or "")
    pendulum.wait_for_function(
        "() => { const r = document.querySelector('#pendulum-chart-T1').getBoundingClientRect();"
        "return r.top >= 0 && r.bottom <= innerHeight; }"
    )
    assert figure.locator(".peak").is_visible()
    assert "253.4 N·m at 23.1 ms" in figure.inner_text()
    assert shown(pendulum, "T1") == pytest.approx(253.4, abs=1.0)


def test_a_drag_across_a_curve_zooms_all_curves(pendulum: Page) -> None:
    box = pendulum.locator("#pendulum-chart-T2 svg").bounding_box()
    assert box
    before = pendulum.locator("#pendulum-chart-T1 .xticks").text_content()
    pendulum.locator("#pendulum-chart-T2").scroll_into_view_if_needed()
    box = pendulum.locator("#pendulum-chart-T2 svg").bounding_box()
    assert box
    y = box["y"] + box["height"] / 2
    pendulum.mouse.move(box["x"] + box["width"] * 0.2, y)
    pendulum.mouse.down()
    pendulum.mouse.move(box["x"] + box["width"] * 0.4, y, steps=4)
    pendulum.mouse.up()
    assert pendulum.locator("#pendulum-chart-T1 .xticks").text_content() != before
    pendulum.get_by_role("button", name="Whole test").click()
    assert pendulum.locator("#pendulum-chart-T1 .xticks").text_content() == before


def test_arrow_keys_on_a_curve_move_the_picture(pendulum: Page) -> None:
    pendulum.locator("#pendulum-chart-T1").focus()
    before = float(pendulum.locator("[data-time]").inner_text())
    for _ in range(5):
        pendulum.keyboard.press("ArrowRight")
    assert float(pendulum.locator("[data-time]").inner_text()) > before


def test_the_tab_key_reaches_everything_one_can_use(pendulum: Page) -> None:
    wanted = pendulum.evaluate(
        "() => { const usable = 'a[href], button, input, select, summary, [tabindex=\"0\"]';"
        "const all = [...document.querySelectorAll(usable)]"
        ".filter(e => e.checkVisibility()); all.forEach((e, i) => e.dataset.reach = i); return all.length; }"
    )
    reached = set()
    for _ in range(wanted + 5):
        pendulum.keyboard.press("Tab")
        reached.add(pendulum.evaluate("() => document.activeElement.dataset.reach"))
    assert {str(number) for number in range(wanted)} <= reached


def test_the_colours_can_be_switched(pendulum: Page) -> None:
    paper = "() => getComputedStyle(document.body).backgroundColor"
    light = pendulum.evaluate(paper)
    pendulum.get_by_role("button", name="Switch to dark colours").click()
    assert pendulum.evaluate(paper) != light
    pendulum.get_by_role("button", name="Switch to light colours").click()
    assert pendulum.evaluate(paper) == light


def test_without_scripts_the_key_frames_and_curves_are_there(browser: Browser, folder: Path) -> None:
    page = opened(browser, folder, "pendulum", java_script_enabled=False).page
    assert page.locator("[data-stills]").is_visible()
    assert not page.locator("[data-player]").is_visible()
    assert page.locator("#pendulum-chart-T1 svg").is_visible()
    page.context.close()


@pytest.mark.parametrize("name", PAGES)
def test_a_phone_shows_the_page_without_scrolling_sideways(browser: Browser, folder: Path, name: str) -> None:
    page = opened(browser, folder, name, viewport={"width": 390, "height": 844}).page
    assert page.evaluate("() => document.documentElement.scrollWidth <= innerWidth")
    page.context.close()


@pytest.mark.parametrize("name", PAGES)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_that_shuts_people_out(
    browser: Browser, folder: Path, name: str, scheme: str
) -> None:
    axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="axe is not installed")
    page = opened(browser, folder, name, color_scheme=scheme, bypass_csp=True).page
    page.evaluate("() => document.querySelectorAll('details').forEach(d => d.open = true)")
    found = axe.Axe().run(page).response["violations"]
    assert [(v["id"], v["nodes"][0]["html"][:120]) for v in found] == []
    page.context.close()


def test_a_click_on_an_impact_point_leads_to_what_is_known_of_it(browser: Browser, folder: Path) -> None:
    page = opened(browser, folder, "campaign").page
    page.locator("svg a.point").nth(2).click()
    page.wait_for_function(
        "() => { const r = document.querySelector('.card:target').getBoundingClientRect();"
        "return r.top >= 0 && r.bottom <= innerHeight; }"
    )
    assert page.locator(".card:target h3").inner_text().startswith("L0")
    page.context.close()


def test_paper_shows_key_frames_and_no_controls(pendulum: Page) -> None:
    pendulum.emulate_media(media="print")
    assert pendulum.locator("[data-stills]").is_visible()
    assert not pendulum.locator("[data-player]").is_visible()
    assert not pendulum.locator("[data-tools]").is_visible()
    assert pendulum.locator("button:visible").count() == 0


def test_run_and_model_move_together_and_lie_over_each_other_when_asked(
    browser: Browser, folder: Path
) -> None:
    watched = opened(browser, folder, "extraction")
    page = watched.page
    lines = page.locator('[data-line="F2"]')
    before = [lines.nth(k).get_attribute("d") for k in range(lines.count())]
    page.locator("[data-scrub]").focus()
    page.keyboard.press("PageUp")
    assert all(lines.nth(k).get_attribute("d") != before[k] for k in range(lines.count()))
    assert float(page.locator("[data-time]").inner_text()) > 0
    both = page.get_by_role("img", name="one over the other")
    assert not both.is_visible()
    page.get_by_role("button", name="One over the other").click()
    assert both.is_visible()
    assert watched.said == []
    page.context.close()


def test_who_asks_for_less_motion_sees_a_few_instants(browser: Browser, folder: Path) -> None:
    page = opened(browser, folder, "extraction", reduced_motion="reduce").page
    page.evaluate(
        "() => { window.seen = new Set(); const line = document.querySelector('[data-line=leg]');"
        "const see = () => window.seen.add(line.getAttribute('d'));"
        "new MutationObserver(see).observe(line, {attributes: true}); }"
    )
    page.locator("[data-speed]").select_option("4")
    page.get_by_role("button", name="Play").click()
    page.wait_for_function("() => document.querySelector('[data-play]').textContent.includes('Play')")
    assert 3 <= page.evaluate("() => window.seen.size") <= 10
    page.context.close()


def test_a_click_on_a_channel_of_run_and_model_moves_the_picture_there(
    browser: Browser, folder: Path
) -> None:
    page = opened(browser, folder, "extraction").page
    chart = page.locator("[data-timed] svg", has_text="Tibia moment 1").first
    middle = chart.evaluate("s => s.getBoundingClientRect().width / 2")
    chart.click(position={"x": middle, "y": 60})
    time = float(page.locator("[data-time]").inner_text())
    assert time == pytest.approx(20.0, abs=1.0)
    cursors = page.locator("[data-timed] .cursor")
    places = {cursors.nth(k).get_attribute("x1") for k in range(cursors.count())}
    assert cursors.count() > 5
    assert max(float(x or 0) for x in places) == pytest.approx(180, abs=8)
    page.context.close()


def test_no_reading_covers_a_peak(browser: Browser, tmp_path: Path) -> None:
    from certkit import run  # noqa: PLC0415  # the browser tests alone need it
    from certkit.reporting.html_report import page  # noqa: PLC0415  # likewise
    from certkit.reporting.result_view import view  # noqa: PLC0415  # likewise

    (tmp_path / "knee.html").write_text(page(view(run("static-knee", refine=False))))
    watched = opened(browser, tmp_path, "knee")
    boxes = watched.page.evaluate(
        "() => [...document.querySelectorAll('[data-channel]')].map((f) => ['.readout', '.peak'].map((s) => {"
        "const e = f.querySelector(s); if (!e) return null; const r = e.getBoundingClientRect();"
        "return [r.left, r.right, r.top, r.bottom]; })).filter((pair) => pair.every(Boolean))"
    )
    assert len(boxes) > 2
    for reading, peak in boxes:
        across = reading[0] < peak[1] and peak[0] < reading[1]
        assert not (across and reading[2] < peak[3] and peak[2] < reading[3])
    watched.page.context.close()


def test_the_rig_is_drawn_at_the_size_of_the_other_drawings_and_fits_a_window(
    browser: Browser, tmp_path: Path
) -> None:
    from certkit import run  # noqa: PLC0415  # the browser tests alone need it
    from certkit.reporting.html_report import page  # noqa: PLC0415  # likewise
    from certkit.reporting.result_view import view  # noqa: PLC0415  # likewise

    for name in ("vehicle", "static-knee"):
        (tmp_path / f"{name}.html").write_text(page(view(run(name, refine=False))))
        watched = opened(browser, tmp_path, name)
        rig = watched.page.locator(".rig svg")
        wide, drawn = rig.evaluate("e => [e.getBoundingClientRect().width, e.viewBox.baseVal.width]")
        assert wide == pytest.approx(drawn, rel=0.01)
        assert rig.evaluate("e => e.getBoundingClientRect().height") < 600
        watched.page.context.close()
