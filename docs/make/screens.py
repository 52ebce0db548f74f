"""Pictures of pages: the HTML report in Chromium, the PDF by PDFium, the terminal by rich."""

from __future__ import annotations

import io
import os
import pty
import re
import shlex
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from PIL import Image

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import ConsoleMessage

CHROMIUM = Path("/usr/bin/chromium")
COLUMNS = 100
COLOURS = 128


@dataclass(frozen=True)
class Screen:
    """How a page is looked at.

    Parameters
    ----------
    page : str
        File, seen from the folder of the runs.
    width, height : int
        Of the window, in CSS pixels.
    dark : bool
        What the reader's system asks for.
    at : float
        Where the moving picture is put, ms after contact; nothing is moved when negative.
    scroll : str
        Selector of what is brought to the top; the page's top when empty.
    part : str
        Selector of what alone is shown; the window when empty.
    style : str
        CSS for the picture alone.
    """

    page: str
    width: int = 1200
    height: int = 900
    dark: bool = False
    at: float = -1.0
    scroll: str = ""
    part: str = ""
    style: str = ""


def photograph(screens: dict[str, Screen], runs: Path, folder: Path) -> list[Path]:
    """Take pictures of pages with Debian's Chromium.

    Raises
    ------
    RuntimeError
        When a page says something on its console.
    """
    from playwright.sync_api import sync_playwright  # noqa: PLC0415  # only for pictures

    written = []
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=str(CHROMIUM), args=["--no-sandbox"])
        for name, screen in screens.items():
            context = browser.new_context(
                viewport={"width": screen.width, "height": screen.height},
                color_scheme="dark" if screen.dark else "light",
                device_scale_factor=1.5 if screen.width > 600 else 2,
                bypass_csp=bool(screen.style),  # the page itself lets no style in
            )
            page = context.new_page()
            said: list[str] = []
            page.on("console", _keeper(said))
            page.goto((runs / screen.page).as_uri())
            if screen.at >= 0:
                page.locator("[data-scrub]").first.evaluate(
                    "(s, v) => { s.value = v; s.dispatchEvent(new Event('input')); }", screen.at
                )
            if screen.scroll:
                page.locator(screen.scroll).first.evaluate(
                    "e => e.scrollIntoView({behavior: 'instant', block: 'start'})"
                )
            if screen.style:
                page.add_style_tag(content=screen.style)
            picture = page.locator(screen.part).first.screenshot() if screen.part else page.screenshot()
            context.close()
            if said:
                raise RuntimeError(f"{screen.page}: {said[0]}")
            written.append(small(picture, folder / f"{name}.png"))
        browser.close()
    return written


def _keeper(said: list[str]) -> Callable[[ConsoleMessage], None]:
    return lambda message: said.append(message.text)


def leaf(pdf: Path, number: int, target: Path) -> Path:
    """Draw one page of a PDF; pages count from 1."""
    import pypdfium2  # noqa: PLC0415  # only for pictures

    document = pypdfium2.PdfDocument(pdf)
    image = document[number - 1].render(scale=1.4).to_pil()
    buffer = io.BytesIO()
    image.save(buffer, "PNG")
    document.close()
    return small(buffer.getvalue(), target)


def small(picture: bytes, target: Path) -> Path:
    """Write a PNG with as many colours as drawings need."""
    with Image.open(io.BytesIO(picture)) as image:
        few = image.convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE)
        few.save(target, "PNG", optimize=True)
    return target


def terminal(command: str, runs: Path, target: Path) -> Path:
    """Draw what a terminal of 100 columns shows of a command."""
    from rich.console import Console  # noqa: PLC0415  # only for pictures
    from rich.text import Text  # noqa: PLC0415  # likewise

    shown = Text.from_ansi(f"$ {command}\n" + _on_a_terminal(command, runs))
    console = Console(record=True, width=COLUMNS, file=io.StringIO(), force_terminal=True)
    console.print(shown)
    drawn = console.export_svg(title="certkit", unique_id="certkit")
    # rich names a font on another host; the reader's own monospace font does as well.
    drawn = re.sub(r"@font-face \{.*?\}\s*", "", drawn, flags=re.DOTALL)
    drawn = re.sub(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', r'\g<0> width="\1" height="\2"', drawn, count=1)
    target.write_text(drawn)
    return target


def _on_a_terminal(command: str, runs: Path) -> str:
    """Run a command whose standard output is a terminal; whatever its exit code, return what it shows."""
    reader, writer = pty.openpty()
    environment = {**os.environ, "COLUMNS": str(COLUMNS), "TERM": "xterm-256color"}
    environment.pop("NO_COLOR", None)
    done = subprocess.Popen(  # noqa: S603  # our own command
        [sys.executable, "-m", *shlex.split(command)],
        cwd=runs,
        stdout=writer,
        stderr=subprocess.DEVNULL,
        env=environment,
    )
    os.close(writer)
    shown = b""
    while True:
        try:
            piece = os.read(reader, 65536)
        except OSError:  # how Linux says that nobody writes any more
            break
        if not piece:
            break
        shown += piece
    os.close(reader)
    done.wait()
    return shown.decode().replace("\r\n", "\n").rstrip() + "\n"
