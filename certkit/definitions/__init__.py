"""Typed definition documents, the reader that reports every error at once, and the library that finds them."""
