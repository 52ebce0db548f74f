"""Reports of documents, for people and for machines. Nothing here computes a verdict or measures."""
