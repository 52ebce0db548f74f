"""`python -m benchmarks`: measure what the project promises about speed, in one run on one machine.

Ratios say something on any machine; absolute times only beside the reference loop, which states how fast
this one is.
"""

from __future__ import annotations

import argparse
import json
import platform
import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

import before  # noqa: E402  # the folder is found first
import chain  # noqa: E402  # the folder is found first
import growth  # noqa: E402  # the folder is found first
import many  # noqa: E402  # the folder is found first
import measured  # noqa: E402  # the folder is found first
import reports  # noqa: E402  # the folder is found first
import shell  # noqa: E402  # the folder is found first
from clock import Row, reference_loop  # noqa: E402  # likewise

PARTS = {
    "chain": chain.rows,
    "shell": shell.rows,
    "many": many.rows,
    "growth": growth.rows,
    "measured": measured.rows,
    "reports": reports.rows,
    "before": before.rows,
}


def main() -> None:
    """Run all parts, or the ones that are named, and print one table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("parts", nargs="*", help=f"some of: {', '.join(PARTS)}; all by default")
    parser.add_argument("--json", type=Path, help="also write the rows to this file")
    chosen = parser.parse_args()
    unknown = sorted(set(chosen.parts) - set(PARTS))
    if unknown:
        parser.error(f"there is no part `{unknown[0]}`; there are {', '.join(PARTS)}")
    print(
        f"{platform.machine()}, Python {platform.python_version()}, reference loop {reference_loop():.3f} s"
    )
    rows: list[Row] = []
    for name in chosen.parts or PARTS:
        for row in PARTS[name]():
            rows.append(row)
            print(row.line, flush=True)
    if chosen.json:
        data = {"reference_loop_seconds": reference_loop(), "rows": [row.__dict__ for row in rows]}
        chosen.json.write_text(json.dumps(data, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")
    missed = [row for row in rows if row.kept is False]
    print(f"{len(rows)} figures, {len(missed)} outside what is promised")


if __name__ == "__main__":
    main()
