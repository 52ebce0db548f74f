"""The page of the result document and of the other documents that certkit writes, from their schemas."""

from __future__ import annotations

from certkit.documents.document_kinds import DOCUMENTS, document_class
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
```

Why something is as it is stands there twice: as a code with its parameters, which programs compare
(`coded_reason`, `coded_remarks`, `coded_notes`, `coded_title`, `coded_decision_rule`), and in English words
beside it (`reason`, `remarks` and so on; also `text` of each code). The id covers codes and parameters, not
the words: it is the same in every language (`--language de`). Words that a user wrote are a code as well,
`words`, with the text as its parameter. `certkit verify` checks that the words are those of the codes. In a
document without codes, as certkit 0.1 wrote it, the id covers the words.
"""

OTHERS = """\
The other documents have the same idiom: a schema, an id over their content, seven digits a number; `certkit
schema`, `certkit report` and `certkit verify` take them too."""


def result() -> str:
    """Return the page."""
    parts = [HEAD]
    for word in DOCUMENTS:
        kind = document_class(word)
        parts.append(f"## {kind.file_name} {{ #{word} }}")
        if word != "result":
            parts.append(f"What `{kind.made_by}` writes; its schema is `certkit schema {word}`.")
        parts.append(described(kind.model_json_schema(by_alias=True), word, depth=3))
        if word == "result":
            parts.append(OTHERS)
    return page(*parts)
