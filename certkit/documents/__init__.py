"""What certkit writes: each result, comparison, extraction, study and logbook overview is a document here."""
