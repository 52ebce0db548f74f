"""From a recording to a verdict: criteria, corridors, decision rules, and the result document."""
