"""Read a container with pyisomme and print what it sees as JSON.

Runs in an environment of its own with nothing but pyisomme (800 MB, and a numpy older than ours):
`python pyisomme_check.py CONTAINER`.
"""

from __future__ import annotations

import json
import sys

import pyisomme

test = pyisomme.Isomme().read(sys.argv[1])
seen = {}
for channel in test.channels:
    data = channel.data
    seen[str(channel.code)] = {
        "unit": str(channel.unit),
        "count": len(data),
        "first": float(data.index[0]),
        "last": float(data.index[-1]),
        "values": [float(v) for v in data.iloc[:, 0]],
    }
json.dump(seen, sys.stdout)
