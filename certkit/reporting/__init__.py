"""Reports of a result document: for people and for machines. Nothing here computes a verdict, filters or measures."""
