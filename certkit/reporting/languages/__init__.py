"""The languages of reports: one file each, named by its code (ISO 639-1), found by being here.

A language has `NAME`, `VERDICTS` (by the document's verdict word), `WORDS` (fixed words of the reports, by
the English ones) and `REASONS` (a sentence for each code). What it lacks is said in English.
"""
