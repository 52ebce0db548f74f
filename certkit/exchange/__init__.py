"""Files ↔ recordings: ISO-MME, CSV, LS-DYNA, OpenRadioss. Checks and converts, interprets nothing."""
