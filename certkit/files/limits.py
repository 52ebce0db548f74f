"""Upper bounds on what is read: far above any real test, far below what could exhaust a machine.

A file's size is known or bounded before its content is unpacked or numbers are made of it, so that a refusal
takes at most 600 MB of memory and ten seconds. docs/security.md lists them.
"""

from __future__ import annotations

MEGABYTE = 1_000_000

MAX_FILE_BYTES = 64 * MEGABYTE
"""Any file that is read: an archive, a PDF. The shipped ones have at most 4 MB."""

MAX_TEXT_BYTES = 32 * MEGABYTE
"""A channel, or a table of channels: 20 channels of 5 s at 20 kHz."""

MAX_LINES = 600_000
"""Of a text file."""

MAX_SAMPLES = 500_000
"""Of a channel: 25 s at 20 kHz, where a test takes 0.2 s."""

MAX_VALUES = 4_000_000
"""Cells of a table."""

MAX_CHANNELS = 500
"""Of a test."""

MAX_HEADER_LINES = 500
"""Above the numbers of a channel."""

MAX_LINE = 4_000
"""Characters of a line in a head; a line of a table may have twenty times as many."""

MAX_CONTAINER_BYTES = 256 * MEGABYTE
"""All files of one test, unpacked."""

MAX_MEMBERS = 5_000
"""Files of one test."""

MAX_COMPRESSION = 200
"""Size over packed size: text of samples packs 3 to 20 times, zip bombs a thousand times."""

MAX_HISTORY_BYTES = 64 * MEGABYTE
"""One file of finite-element histories, unpacked: 800 instants of 20,000 values."""

MAX_DOCUMENT_BYTES = 48 * MEGABYTE
"""A document that certkit wrote; a certificate of a simulated test has 1.5 MB."""

MAX_DOCUMENT_VALUES = 800_000
MAX_DOCUMENT_WORDS = 400_000
"""Commas and opening brackets in a document, all and those with no number behind: it cannot have more values.
Of the latter a mapping counts twice.
A certificate of a simulated test has 130,000. To tell what is wrong with a value takes 600 bytes."""

MAX_CARRIED_VALUES = 700_000
"""Samples of all channels of one test, which its certificate carries: 12 channels of 2.9 s at 20 kHz."""

MAX_KEPT_SAMPLES = 40_000
"""Of a simulated test: 1.6 s as they are usually kept, 16 channels of them a document's values."""

MAX_DEFINITION_BYTES = 2 * MEGABYTE
MAX_DEFINITION_DEPTH = 40
MAX_DEFINITION_VALUES = 200_000
"""Of a YAML file; aliases count with all they stand for."""

MAX_RUNS = 1_000_000
"""Of a study or a fit."""

MAX_SETTINGS = 10_000_000
"""Of a study: its runs times its parameters."""
