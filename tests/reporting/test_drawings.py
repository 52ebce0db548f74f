from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support import synthetic_result
from support.synthetic_result import parsed

from certkit.documents.result import CriterionResult, Front, Histories, Result, Series
from certkit.errors import UsageError
from certkit.reporting import palette
from certkit.reporting.charts.channel_history import history_chart
from certkit.reporting.charts.grid import side_by_side
from certkit.reporting.charts.lines import lines_chart
from certkit.reporting.charts.motion_frames import key_frames
from certkit.reporting.charts.position import position_bar
from certkit.reporting.figure_list import FIGURES
from certkit.reporting.figures import figure
from certkit.reporting.scales import Scale, span, thinned, ticks
from certkit.reporting.svg import Drawing
from certkit.reporting.vehicle_front_view import front_view

SVG = "{http://www.w3.org/2000/svg}"


def luminance(colour: str) -> float:
    channels = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


@pytest.mark.parametrize("colour", [*palette.VERDICT.values(), palette.INK, palette.MUTED, palette.ACCENT])
def test_text_colours_stand_out_from_paper(colour: str):
    assert 1.05 / (luminance(colour) + 0.05) >= 4.5


@pytest.mark.parametrize("pen", palette.PENS)
def test_curves_stand_out_from_paper(pen: palette.Pen):
    assert 1.05 / (luminance(pen.colour) + 0.05) >= 3.0


def test_pens_differ_without_their_colours():
    assert len({pen.dash for pen in palette.PENS}) == len(palette.PENS)


def test_no_two_lines_of_a_chart_look_alike():
    names = [f"group {k}" for k in range(40)]
    drawn = lines_chart([(name, [0.0, 1.0], [0.0, 1.0]) for name in names], "Momentum", "ms", "N·s")
    keys = [e for e in parsed(drawn).iter() if e.tag.endswith("line") and "curve" in e.get("class", "")]
    worn = {(key.get("stroke"), key.get("stroke-dasharray")) for key in keys}
    assert len(worn) == len(keys) == len(names)


def test_a_face_is_not_taken_for_the_gauge_of_its_name():
    series = {name: Series(title=name, unit="N", values=(0.0, 1.0)) for name in ("F1", "H1", "MCL")}
    histories = Histories(start=0.0, interval=0.001, count=2, series=series)
    energies = {"F1": 3.0, "H1": 2.0}
    seen = front_view(
        Front(contact=histories, displacement=histories, springs={}, received=energies, absorbed={})
    )
    assert seen is not None
    assert "face F1, H1, face MCL" in seen.contact.title
    assert "face F1, H1, face MCL" in seen.displacement.title
    assert seen.received == [("face F1", 3.0), ("H1", 2.0)]


def test_moments_of_either_sign_grow_darker_with_their_size():
    for side in (-1, 1):
        shades = [luminance(palette.diverging(side * step / 10)) for step in range(11)]
        assert shades == sorted(shades, reverse=True)


@given(low=st.floats(-1e6, 1e6), size=st.floats(1e-6, 1e6))
def test_ticks_are_few_and_inside(low: float, size: float):
    high = low + size
    if high - low < 1e-9 * max(abs(low), abs(high)):
        return
    found = ticks(low, high, 6)
    assert len(found) <= 7
    slack = 1e-6 * (high - low) + 1e-9 * max(abs(low), abs(high))
    assert all(low - slack <= value <= high + slack for value in found)


def test_a_span_is_never_empty():
    assert span([3.0, 3.0])[0] < 3.0 < span([3.0, 3.0])[1]
    assert span([])[0] < span([])[1]


@given(st.lists(st.floats(-1e3, 1e3), min_size=2, max_size=2000))
def test_thinning_keeps_the_extremes(values: list[float]):
    points = [(float(i), v) for i, v in enumerate(values)]
    kept = thinned(points, 100)
    assert len(kept) <= 202
    assert max(p[1] for p in kept) == max(values)
    assert min(p[1] for p in kept) == min(values)
    assert kept == sorted(kept, key=lambda p: p[0])


def pointer(row: CriterionResult) -> float:
    root = parsed(position_bar(row, 1))
    heads = [e for e in root.iter(f"{SVG}path") if (e.get("class") or "").startswith("v-")]
    return float(re.match(r"M(-?[\d.]+)", heads[0].get("d")).group(1))


@pytest.mark.parametrize("value", [236.0, 253.5, 271.0])
def test_the_bar_shows_a_value_inside_its_corridor_between_the_limits(value: float):
    row = CriterionResult(
        id="T1", title="", value=value, unit="N·m", lower=235, upper=272, margin=1, verdict="pass"
    )
    root = parsed(position_bar(row, 1))
    limits = sorted(float(e.get("x1")) for e in root.iter(f"{SVG}line") if e.get("class") == "limit")
    assert limits[0] <= pointer(row) <= limits[1]


def test_the_bar_shows_a_value_far_outside_as_an_arrow_at_its_end():
    row = CriterionResult(
        id="T1", title="", value=900, unit="N·m", lower=235, upper=272, margin=-628, verdict="fail"
    )
    assert pointer(row) > 140


def test_a_missing_value_has_no_bar():
    row = CriterionResult(
        id="T1", title="", value=None, unit="N·m", lower=235, upper=272, verdict="not evaluated"
    )
    assert position_bar(row, 1) is None


def test_the_peak_is_marked_where_the_criterion_says(pendulum: Result):
    criterion = pendulum.criteria[0]
    root = parsed(history_chart(pendulum.curves, "T1", criterion))
    peak = next(e for e in root.iter(f"{SVG}circle") if "peak" in e.get("class"))
    end = (pendulum.curves.count - 1) * pendulum.curves.interval
    assert float(peak.get("cx")) == pytest.approx(Scale(0, end, 46, 346)(criterion.time), abs=0.1)


def test_a_largest_magnitude_below_zero_is_marked_below_zero_with_its_corridor_there():
    document = synthetic_result.document()
    series = document["curves"]["series"]["T1"]
    series["values"] = [-v for v in series["values"]]
    result = Result.model_validate(document)
    root = parsed(history_chart(result.curves, "T1", result.criteria[0]))
    peak = float(next(e for e in root.iter(f"{SVG}circle") if "peak" in e.get("class")).get("cy"))
    zero = next(
        float(e.get("y1"))
        for e in root.iter(f"{SVG}line")
        if e.get("class") == "zero" and e.get("y1") == e.get("y2")
    )
    edges = sorted(float(e.get("y1")) for e in root.iter(f"{SVG}line") if e.get("class") == "limit")
    assert zero < edges[0] <= peak <= edges[1]


def test_key_frames_begin_at_the_start_and_show_the_largest_moment(pendulum: Result):
    frames = key_frames(pendulum.motion)
    sizes = [max(abs(v) for v in row) for row in pendulum.motion.moments]
    assert frames[0] == 0
    assert sizes.index(max(sizes)) in frames
    assert len(frames) <= 6


@pytest.mark.parametrize("what", [name for name in FIGURES["certkit-result/1"] if name != "curve"])
def test_each_figure_is_a_picture_with_words_for_those_who_cannot_see_it(pendulum: Result, what: str):
    root = parsed(figure(pendulum, what))
    assert root.get("role") == "img"
    assert root.get("aria-label")
    assert root.find(f"{SVG}title").text


def test_static_curves_show_their_polygon_or_say_that_none_is_known(bending: Result):
    drawn = figure(bending, "curve").decode()
    assert "corridor limit" in drawn
    assert "no corridor known" in drawn


def test_one_channel_can_be_drawn_alone(pendulum: Result):
    assert b"MCL" not in figure(pendulum, "history", channels=["T1"])


@pytest.mark.parametrize(
    ("what", "form", "channels", "words"),
    [
        ("pie", "svg", (), "unknown figure `pie`"),
        ("history", "gif", (), "unknown figure format `gif`"),
        ("history", "svg", ("T9",), "there is no `T9`"),
        ("curve", "svg", (), "nothing to draw"),
    ],
)
def test_what_cannot_be_drawn_is_said(
    pendulum: Result, what: str, form: str, channels: tuple[str, ...], words: str
):
    with pytest.raises(UsageError, match=words):
        figure(pendulum, what, form, channels=channels)


def test_a_png_is_three_times_the_drawing(pendulum: Result):
    content = figure(pendulum, "history", "png", channels=["T1"])
    assert content.startswith(b"\x89PNG")
    assert int.from_bytes(content[16:20], "big") == pytest.approx(3 * 360, abs=4)


def test_two_results_can_be_laid_over_each_other(pendulum: Result, measured: Result) -> None:
    root = parsed(figure(pendulum, "history", channels=["T1"], beside=measured))
    assert len([e for e in root.iter(f"{SVG}path") if "curve" in (e.get("class") or "")]) == 2


def test_the_rig_names_each_part_once_and_has_a_scale(pendulum: Result) -> None:
    root = parsed(figure(pendulum, "rig"))
    words = [text.text for text in root.iter(f"{SVG}text")]
    assert words.count("tibia") == words.count("femur") == words.count("stopper") == words.count("hinge") == 1
    assert any(word.endswith(" mm") for word in words if word)


def test_frames_of_two_results_stand_at_the_same_instants(pendulum: Result, bending: Result) -> None:
    root = parsed(figure(pendulum, "frames", beside=bending))
    rows = root.findall(f"{SVG}svg")
    assert len(rows) == 2
    assert len({len(row.findall(f"{SVG}g")) for row in rows}) == 1


def test_only_figures_with_a_time_axis_take_a_second_result(pendulum: Result) -> None:
    with pytest.raises(UsageError, match="cannot show two results"):
        figure(pendulum, "table", beside=pendulum)


def test_a_drawing_placed_in_another_keeps_its_size():
    small = Drawing(30.0, 20.0, "", "small & round")
    first, second = parsed(side_by_side([small, small], "two")).findall("{*}svg")
    assert [(e.get("width"), e.get("height"), e.get("y")) for e in (first, second)] == [("30", "20", "0")] * 2
    assert float(second.get("x")) >= float(first.get("x")) + 30.0
    assert first.get("aria-label") == "small & round"


def test_keys_in_japanese_stand_beside_their_title_and_not_on_it() -> None:
    def first_key(title: str) -> float:
        drawn = parsed(str(lines_chart([("run", [0, 1], [0, 1])], title, "ms", "N")))
        return min(
            float(e.get("x1") or 0) for e in drawn.iter() if e.get("stroke-width") == "2" and e.get("x1")
        )

    assert first_key("脛骨モーメント 4") > 6 + 11 * 7
    assert first_key("abcdefghi") == pytest.approx(6 + 6.6 * 9 + 18)
