"""The page of the result document and of the other documents that certkit writes, from their schemas."""

from __future__ import annotations

from certkit.documents.comparison import ComparisonDocument
from certkit.documents.result import Result
from docs.make.markdown import page
from docs.make.schema import described

HEAD = """\
# The result document

Each run and each graded test writes `result.json`, and all reports are made from it alone. Fields may be
added; none changes its meaning. A value stands in the unit that is named beside it; times are in seconds
after first contact. `solver_seconds` is the only entry that depends on the machine, and is left out of the
certificate's id and of comparisons. Its JSON Schema:

```console
$ certkit schema result
```"""

COMPARISON = """\
## comparison.json { #comparison }

What `certkit compare` writes."""


def result() -> str:
    """Return the page."""
    return page(
        HEAD,
        "## result.json { #result }",
        described(Result.model_json_schema(by_alias=True), "result", depth=3),
        COMPARISON,
        described(ComparisonDocument.model_json_schema(by_alias=True), "comparison", depth=3),
    )
