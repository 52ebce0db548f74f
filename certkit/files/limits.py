"""Upper bounds on what is read: far above any real test, far below what could exhaust a machine.

A file's size is known or bounded before its content is unpacked or numbers are made of it, so that a refusal
takes little time and memory. docs/security.md lists these bounds; a test keeps the two alike.
"""

from __future__ import annotations

MEGABYTE = 1_000_000

MAX_FILE_BYTES = 64 * MEGABYTE
"""One file of a test: a channel, a table; a vehicle test of 40 channels at 20 kHz takes 3 MB a second."""

MAX_CONTAINER_BYTES = 256 * MEGABYTE
"""All files of one test, unpacked."""

MAX_MEMBERS = 5_000
"""Files of one test."""

MAX_COMPRESSION = 200
"""Size over packed size: text of samples packs 3 to 20 times, zip bombs a thousand times."""

MAX_SAMPLES = 1_000_000
"""Of one channel: 50 s at 20 kHz, where a test takes 0.2 s."""

MAX_VALUES = 8_000_000
"""Cells of a table."""

MAX_CHANNELS = 500
MAX_HEADER_LINES = 500

MAX_LINE = 4_000
"""Characters of a line in a head; a line of a table may have twenty times as many."""

MAX_HISTORY_BYTES = 256 * MEGABYTE
"""One file of finite-element histories, unpacked."""

MAX_DOCUMENT_BYTES = 200 * MEGABYTE
"""A document that certkit wrote."""

MAX_DEFINITION_BYTES = 2 * MEGABYTE
MAX_DEFINITION_DEPTH = 40
MAX_DEFINITION_VALUES = 200_000
"""Of a YAML file; aliases count with all they stand for."""

MAX_RUNS = 1_000_000
"""Of a study; a larger one is split by hand, see docs/how-to/study.md."""
