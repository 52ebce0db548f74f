"""Typed definition documents, the reader that reports all errors at once, the library that finds them."""
