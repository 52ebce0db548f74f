"""Files from laboratories and finite-element programs, read into recordings and histories. Interprets nothing."""
