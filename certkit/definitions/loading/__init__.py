"""How definitions are found and read: YAML reader, search path, validation, and the messages they give."""
