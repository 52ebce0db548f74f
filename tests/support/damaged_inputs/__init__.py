"""Damaged input files, made by the hundred, and an oracle that knows which damage changes a graded value.

`corpus(seed)` makes the variants, `judged(variant, folder)` tries one. The numbers of a seed stand in
docs/reliability.md, written by `python -m docs.make reliability`.
"""
