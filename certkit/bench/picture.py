"""From the mechanics room's motion to the result document's: the same picture, in words and lists."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.result import Motion, Shape

if TYPE_CHECKING:
    from certkit.mechanics import Figure as MovingFigure
    from certkit.mechanics import RecordedMotion


def picture(film: RecordedMotion) -> Motion:
    """Write a film down for the result document; coordinates in metres, rounded by the document itself."""
    return Motion(
        times=film.times.tolist(),
        shapes=[_shape(figure) for figure in film.figures],
        poses=film.poses.tolist(),
        joints=list(film.joints),
        moments=film.moments.tolist(),
        scene=[_shape(figure) for figure in film.scene],
    )


def _shape(figure: MovingFigure) -> Shape:
    return Shape(name=figure.name, kind=figure.kind, outline=list(figure.outline))
