"""The legform as a chain of rigid bodies: bones cut into segments, and the two blocks of the knee."""
