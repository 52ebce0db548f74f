"""`python -m certkit` is the command `certkit`."""

from certkit.cli import main

main()
