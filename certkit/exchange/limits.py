"""Upper bounds on what certkit reads: far above any real test, far below what could exhaust a machine."""

from __future__ import annotations

MEGABYTE = 1_000_000

MAX_FILE_BYTES = 256 * MEGABYTE
MAX_CONTAINER_BYTES = 1_000 * MEGABYTE
MAX_MEMBERS = 5_000
MAX_COMPRESSION = 200  # text of samples packs about 3 to 20 times; zip bombs pack a thousand times
MAX_HEADER_LINES = 500
MAX_LINE = 4_000
MAX_CHANNELS = 500
MAX_SAMPLES = 5_000_000
