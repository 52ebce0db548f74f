"""Sentences of `certkit verify`: one for each code of a check's reason."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

VERIFICATION_WORDS: Mapping[str, str] = MappingProxyType(
    {
        # The document.
        "id-differs": "its content was changed: it says {said}, its content makes {made}",
        "bytes-differ": "are not as certkit writes them",
        "words-differ": "are not those of its coded reasons",
        "input-changed": "was changed: its hash is another",
        "table-differs": "differ from the document's channels",
        "rendering-differs": "is not what result.json renders to; one of both was changed",
        "made-by-another-version": "made by certkit {version}; this is {now}, which writes it otherwise",
        "simulated-parts-in-measured-test": "a test evaluation has {parts} of a simulation",
        "recording-not-named": "a test evaluation names no recording that it was made from",
        "not-compared": "for people to work on; not compared with the document",
        # A campaign.
        "not-judgeable": "{error}",
        "judged-otherwise": "`{place}` is {said}; judged again it is {made}",
        "point-result-missing": "the result is not beside the campaign",
        "point-result-differs": "is result {made}; the campaign names {said}",
        "point-value-differs": "the campaign says {said}; the result says {made}",
        # Grading.
        "not-gradable": "{error}",
        "verdict-differs": "it said {said}; graded again it is {made}",
        "graded-again": "{verdict}",
        "value-differs": "it said {said:.6g} {unit}; graded again it is {made:.6g}",
        "corridor-differs": "its corridor is another",
        "criterion-unknown": "is not among the procedure's criteria",
        "criterion-left-out": "is asked for by the procedure and not in the document",
        "field-differs": "`{place}` is {said}; graded again it is {made}",
        "note-missing": "the document lacks: {note}",
        "notes-from-recording": "{count} notes can only come from the recording's files, such as: {note}",
        "fits-not-known": "`{place}` depends on a fit of the model that is not shipped",
        "words-of-another-version": "`{place}` is worded otherwise by certkit {version}",
        "gate-other-figure": "holds {said} against its limit where the run's figure is {made}",
        "gate-contradicts": "`{title}`: {value:.4g} against {limit:.4g} {unit} is called {verdict}",
        # Reproduction.
        "quick": "left out by --quick",
        "not-simulated-here": "graded from a recording; there is nothing to simulate",
        "simulation-fails": "cannot be simulated again: {error}",
        "reproduced": "simulated again from its carried inputs: the same",
        "reproduction-differs": "`{place}` is {said}; simulated again it is {made}",
        "other-version-computes": "certkit {version} made it; {now} computes `{place}` as {made}, not {said}",
        "family-not-run": "the spread over the family is not simulated again",
        # Sources.
        "source-same": "the recording that it was made from",
        "source-differs": "`{name}` is not what the certificate was made from: its hash is another",
        "source-unknown": "none of its files is among those that the certificate was made from",
        "source-missing": "not among the data: {names}",
        "sources-not-given": "name the recording behind the certificate to compare it with its hashes",
        "source-unreadable": "cannot be compared: {error}",
        "condition-of-source-differs": "{condition} is {said}; its files tell {made} (SI)",
        "channels-of-source-differ": "channel {channel} is not what the recording holds",
        "as-shipped": "as certkit ships it",
        "look-alike-name": "not the shipped `{name}`, though its name looks like it",
        "limits-differ": "is not the shipped one of its name: {place} is {said}, shipped is {made}",
        "text-differs": "the text differs from the shipped one of its name; the numbers are the same",
        "definition-of-ones-own": "not the shipped one of its name: {place} is {said}, shipped is {made}",
        "definition-of-another-version": "not as it is shipped today: {place} is {said}, shipped is {made}",
        "claims-to-be-shipped": "says that it is the shipped one: {place} is {said}, shipped is {made}",
        # Attachments.
        "attached-not-listed": "is attached, but not in the manifest",
        "listed-not-attached": "is in the manifest, but not attached",
        "attachment-changed": "was changed since the certificate was made",
        "attachment-differs": "is not what the attached result.json carries",
        "other-certificate": "certifies {ids}",
        "ids-differ": "the manifest names {said}, the attached documents are {made}",
        # The PDF file.
        "bytes-appended": "{count} bytes follow its end; no program that only reads it writes there",
        "bytes-before": "other bytes stand before its beginning",
        "words-added": "says `{words}` outside its pages, which certkit does not write there",
        "update-appended": "was written to {count} times after it was made, without a signature over it",
        "file-structure-holds": "nothing was appended, painted over or hidden in it",
        "signature-update": "what was appended is the signature alone",
        "annotation": "page {page} has a {kind} laid over it",
        "form-field": "page {page} has a form field",
        "active-content": "it contains {key}, which no certificate has",
        "pages-changed-by-update": "what was appended changes page {page}",
        "pages-added-by-update": "what was appended makes {now} pages of {before}",
        # Pages.
        "pages-same-bytes": "byte for byte what the attached documents render to",
        "pages-same-look": "text and pictures of every page are what the attached documents render to",
        "pages-rewritten": (
            "text and pictures are as they should be, but the file is not byte for byte what this "
            "WeasyPrint writes: another program wrote it, or packed it otherwise"
        ),
        "page-count": "has {said} pages; the attached documents make {made}",
        "page-size": "page {page} has another size than the attached documents make",
        "page-blank": "page {page} is blank",
        "page-foreign": "page {page} bears none of the certificate's ids",
        "page-text": "page {page} says `{said}` where the attached documents make `{made}`",
        "page-picture": "page {page} looks otherwise than the attached documents make it, near {place}",
        "page-picture-other-engine": (
            "page {page} looks otherwise than here, near {place}; WeasyPrint {version} made it"
        ),
        "pages-of-another-version": (
            "certkit {version} made them; this is {now}, which lays them out otherwise: install that "
            "version to check them"
        ),
        "pages-not-renderable": "cannot be rendered here: {error}",
        # A legform's certificate, and reports that were replaced.
        "certificate-refused": "{error}",
        "replaced-by": (
            "was replaced by {number}, revision {revision} ({id}), issued on {issued}; reason: {reason}; "
            "changed: {changes}"
        ),
        # The signature.
        "unsigned": "there is none",
        "unsigned-though-trust": "there is none, and --trust asks for one",
        "signature-extra-missing": "there is one, and looking at it needs `pip install 'certkit[signature]'`",
        "signature-broken": "{signer}: what was signed has been changed",
        "signature-invalid": "{signer}: was not made with the key of its certificate",
        "signature-unreadable": "cannot be read: {error}",
        "signature-partial": "{signer}: does not cover the whole file",
        "signature-modified": "{signer}: the file was changed after it was signed",
        "signature-not-trusted": "{signer}: is not trusted by a root of --trust",
        "signature-by": "signed by {signer}; whether that is who it says, nobody vouches for (--trust FILE)",
        "signature-trusted": "signed by {signer}, vouched for by {root}",
        "trust-unreadable": "{error}",
    }
)


def verification_words(code: str, parameters: Mapping[str, object]) -> str:
    """Return the sentence of a code."""
    return VERIFICATION_WORDS[code].format(**parameters)


LIMITS = (
    "A recording that was invented before it was signed stays invented: verify says that nothing was "
    "changed, not that the test took place."
)
"""What no verification can show; the last line of each."""
