"""Figures that stand alone, for slides and papers: SVG, and PNG made from the same drawing."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Literal, get_args

from certkit.documents.unverified import MARK, is_marked
from certkit.errors import UsageError
from certkit.reporting.charts.channel_history import history_chart, times
from certkit.reporting.charts.error_bars import errors_chart
from certkit.reporting.charts.grid import sheet
from certkit.reporting.charts.lines import energies_chart, lines_chart
from certkit.reporting.charts.motion_frames import frames_chart, key_frames
from certkit.reporting.charts.plane import plane_chart
from certkit.reporting.charts.tables import corridors_table, errors_table
from certkit.reporting.result_view import ordered_channels
from certkit.reporting.svg import FONT, label

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from certkit.documents.result import Result
    from certkit.reporting.svg import Drawing

What = Literal["corridor", "history", "frames", "table", "curve", "errors", "energy"]
WHAT: tuple[str, ...] = get_args(What)
FORMATS = ("svg", "png")


def figure(
    result: Result,
    what: str,
    form: str = "svg",
    *,
    channels: Sequence[str] = (),
    beside: Result | None = None,
) -> bytes:
    """Draw one figure of a result.

    Parameters
    ----------
    result : Result
        The document.
    what : str
        `corridor`: all criteria in their corridors; `history`: channels over time; `frames`: the rig at a few
        instants; `table`: the error table; `errors`: its bars; `curve`: curves of static tests; `energy`:
        energies over time.
    form : {'svg', 'png'}
        SVG for pages, PNG at three pixels to each of the drawing's for slides.
    channels : sequence of str
        For `history` and `curve`: only these channels or criteria; all by default.
    beside : Result, optional
        For `history`: a second result whose curves are laid over; for `frames`: whose pictures stand below.

    Returns
    -------
    bytes
        The file's content.

    Raises
    ------
    UsageError
        When the figure, format or channel is unknown, or the result holds nothing to draw it from.
    """
    if what not in WHAT:
        raise UsageError(f"unknown figure `{what}`; use {', '.join(WHAT)}")
    if form not in FORMATS:
        raise UsageError(f"unknown figure format `{form}`; use {' or '.join(FORMATS)}")
    if beside is not None:
        if what not in {"history", "frames"}:
            raise UsageError(f"`{what}` cannot show two results; `history` and `frames` can")
        drawing = _overlaid(result, beside, channels) if what == "history" else _stacked(result, beside)
    else:
        drawing = _draw(result, what, channels)
    if drawing is None:
        raise UsageError(f"{result.procedure}: the result holds nothing to draw `{what}` from")
    return painted(stamped(drawing) if is_marked(result, beside) else drawing, form)


def stamped(drawing: Drawing) -> Drawing:
    """Return a drawing that says across its top that its document was changed."""
    words = label(4, 11, MARK, font_size=11, font_weight=600, font_family=FONT, fill="#b00020")
    return replace(drawing, body=drawing.body + words)


def painted(drawing: Drawing, form: str) -> bytes:
    """Return a drawing as a file of that format.

    Raises
    ------
    UsageError
        When the format is neither `svg` nor `png`.
    """
    if form not in FORMATS:
        raise UsageError(f"unknown figure format `{form}`; use {' or '.join(FORMATS)}")
    if form == "svg":
        return f"{drawing}\n".encode()
    from certkit.reporting.raster import png  # noqa: PLC0415  # WeasyPrint and PDFium load for PNG alone

    return png(drawing)


def _draw(result: Result, what: str, channels: Sequence[str]) -> Drawing | None:
    painters: dict[str, Callable[[], Drawing | None]] = {
        "corridor": lambda: corridors_table(result),
        "history": lambda: _histories(result, channels),
        "curve": lambda: _curves(result, channels),
        "frames": lambda: frames_chart(result.motion) if result.motion and result.motion.poses else None,
        "energy": lambda: energies_chart(result.energies) if result.energies else None,
        "table": lambda: errors_table(c) if (c := result.comparison) and c.rows else None,
        "errors": lambda: errors_chart(c) if (c := result.comparison) and c.rows else None,
    }
    return painters[what]()


def _stacked(result: Result, beside: Result) -> Drawing | None:
    """Draw the key frames of both, one row each, at the same instants."""
    first, second = result.motion, beside.motion
    if not (first and first.poses and second and second.poses):
        return None
    shared = sum(t <= second.times[-1] + 1e-9 for t in first.times)
    frames = key_frames(
        first.model_copy(update={"poses": first.poses[:shared], "moments": first.moments[:shared]})
    )
    instants = [first.times[frame] for frame in frames]
    nearest = [min(range(len(second.times)), key=lambda i: abs(second.times[i] - t)) for t in instants]
    rows = [frames_chart(first, frames), frames_chart(second, nearest)]
    return sheet(rows, f"{result.title} and {beside.title} at the same instants", columns=1)


def _overlaid(result: Result, beside: Result, channels: Sequence[str]) -> Drawing | None:
    """Draw the channels that both have, over each other."""
    first, second = result.curves, beside.curves
    if first is None or second is None:
        return None
    common = [name for name in ordered_channels(result) if name in second.series]
    _check(channels, common)
    drawn = []
    for name in channels or common:
        here, there = first.series[name], second.series[name]
        lines = [
            (result.procedure, times(first), here.values),
            (
                beside.procedure + (" (2)" if beside.procedure == result.procedure else ""),
                times(second),
                there.values,
            ),
        ]
        drawn.append(lines_chart(lines, name, "ms", here.unit, width=360, height=210))
    if not drawn:
        return None
    return drawn[0] if len(drawn) == 1 else sheet(drawn, f"{result.title} and {beside.title}")


def _histories(result: Result, channels: Sequence[str]) -> Drawing | None:
    curves = result.curves
    if curves is None or curves.count < 2:
        return None
    known = ordered_channels(result)
    _check(channels, list(known))
    chosen = list(channels) or list(known)
    drawings = [history_chart(curves, name, known[name]) for name in chosen]
    return drawings[0] if len(drawings) == 1 else sheet(drawings, f"Time histories of {result.title}")


def _curves(result: Result, channels: Sequence[str]) -> Drawing | None:
    known = {c.id: c for c in result.criteria if c.curve}
    _check(channels, list(known))
    drawings = [plane_chart(c.curve, c.title) for name in (channels or known) if (c := known[name]).curve]
    if not drawings:
        return None
    return drawings[0] if len(drawings) == 1 else sheet(drawings, f"Curves of {result.title}")


def _check(wanted: Sequence[str], known: Sequence[str]) -> None:
    for name in wanted:
        if name not in known:
            raise UsageError(f"there is no `{name}` to draw; there are {', '.join(known) or 'none'}")
