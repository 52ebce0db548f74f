"""Damages of a line of text, whatever it says: emptied, garbled, doubled, lost, grown, spoilt."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

Line = "str"

_NUMBER = re.compile(r"\d+(?:[.,]\d+)?")


def _value(line: str, change: Callable[[str], str]) -> str:
    """Change what stands behind the first colon."""
    head, colon, value = line.partition(":")
    return f"{head}{colon}{change(value)}" if colon else change(line)


def _number(line: str, change: Callable[[str], str]) -> str:
    """Change the last number of a line."""
    found = list(_NUMBER.finditer(line))
    if not found:
        return line
    match = found[-1]
    return line[: match.start()] + change(match.group()) + line[match.end() :]


MODES: dict[str, Callable[[str], str]] = {
    "emptied": lambda line: _value(line, lambda _: ""),
    "garbled": lambda line: _value(line, lambda _: "xyzzy"),
    "a question mark": lambda line: _value(line, lambda value: f"{value}?"),
    "half of it": lambda line: line[: len(line) // 2],
    "an endless value": lambda line: _value(line, lambda value: value + "x" * 100_000),
    "a control character": lambda line: _value(line, lambda value: f"{value}\x13"),
    "a zero byte": lambda line: _value(line, lambda value: f"{value}\0"),
    "a turned direction": lambda line: _value(line, lambda value: f"\u202e{value}"),
    "another encoding": lambda line: _value(line, lambda value: f"{value}\udcfc"),
    "ten times the number": lambda line: _number(
        line,
        lambda number: (
            f"{number}0"
            if "." not in number and "," not in number
            else number.replace(".", "").replace(",", "")
        ),
    ),
    "minus the number": lambda line: _number(line, lambda number: f"-{number}"),
    "no number": lambda line: _number(line, lambda _: "nan"),
    "an infinite number": lambda line: _number(line, lambda _: "1e999"),
    "a comma in the number": lambda line: _number(line, lambda number: f"{number},5"),
}
"""What is done to one line."""


def line_damages(text: str, lines: Iterator[int] | range) -> Iterator[tuple[str, str, str]]:
    """Yield (kind, words, damaged text) for each of the lines and each mode that changes it."""
    rows = text.split("\n")
    for index in lines:
        where = f"line {index + 1}"
        for mode, change in MODES.items():
            changed = change(rows[index])
            if changed != rows[index]:
                yield (
                    "text field",
                    f"{where}: {mode}",
                    "\n".join([*rows[:index], changed, *rows[index + 1 :]]),
                )
        yield "text field", f"{where}: lost", "\n".join([*rows[:index], *rows[index + 1 :]])
        yield "conflicting words", f"{where}: twice", "\n".join([*rows[:index], rows[index], *rows[index:]])
        other = _number(
            _value(rows[index], lambda value: value if _NUMBER.search(value) else " other"), lambda n: f"{n}7"
        )
        if other != rows[index]:
            yield (
                "conflicting words",
                f"{where}: again with another value",
                "\n".join([*rows[: index + 1], other, *rows[index + 1 :]]),
            )
        yield (
            "truncated",
            f"ends in {where}",
            "\n".join([*rows[:index], rows[index][: len(rows[index]) // 2]]),
        )


def encoded(text: str) -> bytes:
    """Return the bytes of a text, in which a lone surrogate stands for a byte of another encoding."""
    return text.encode("utf-8", "surrogateescape")
