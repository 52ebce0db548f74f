"""What several tests need: oracles, made-up recordings and results, and the command as people run it."""
