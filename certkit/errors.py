"""The tree of errors certkit raises on purpose, and the exit code each one ends a command with.

```
CertkitError                     3   base class, never raised itself
├── InputError                   2   something a user wrote or handed over cannot be used
│   ├── DefinitionError          2   a YAML definition: carries all problems at once, each with its place
│   ├── DataError                2   a measured or FE data file: what, where, what to do
│   └── UsageError               2   a command line that cannot be carried out
└── RunError                     3   a simulation that cannot be trusted or did not finish
    └── MissingPartError         3   a library or font that a report needs is not installed
```

Exit codes follow the contract: 0 pass, 1 fail or conditional, 2 bad definition or usage, 3 run or
numerical error, 4 not evaluated. The verdict codes live in `certkit.grading`; only errors live here.
"""

from __future__ import annotations

from typing import ClassVar, NamedTuple


class CertkitError(Exception):
    """Base of every error that certkit raises on purpose."""

    exit_code: ClassVar[int] = 3


class InputError(CertkitError):
    """Something that a user wrote or handed over cannot be used."""

    exit_code: ClassVar[int] = 2


class Problem(NamedTuple):
    """One thing wrong with a file: where it stands, what it is and what to do about it.

    Parameters
    ----------
    file : str
        The file as the user named it.
    line, column : int
        One-based place in the file; 0 where the file as a whole is meant.
    message : str
        What is wrong, and what to do.
    """

    file: str
    line: int
    column: int
    message: str

    def __str__(self) -> str:
        """Return `file:line:column: message`, without the place where there is none."""
        place = f"{self.file}:{self.line}:{self.column}" if self.line else self.file
        return f"{place}: {self.message}"


class DefinitionError(InputError):
    """A definition file with one or more problems, all reported at once."""

    def __init__(self, problems: list[Problem]) -> None:
        """Keep `problems`, sorted by place."""
        self.problems = sorted(problems)
        super().__init__("\n".join(str(problem) for problem in self.problems))


class DataError(InputError):
    """A data file (measured or finite-element) that cannot be used as it is."""


class UsageError(InputError):
    """A command or call whose arguments do not fit together."""


class OldFormWarning(FutureWarning):
    """An old form of a file, or an old path, that is still read; says what to write instead."""


class TakenAsSaidWarning(UserWarning):
    """A test that was booked as it says, though something speaks against counting on it; says what."""


class LeftOutWarning(UserWarning):
    """A report that was not written, because something that it needs is not installed; says what to do."""


class RunError(CertkitError):
    """A simulation that did not finish or whose numbers cannot be trusted."""

    exit_code: ClassVar[int] = 3


class MissingPartError(RunError):
    """A library or a font that a report needs is not installed; says how to install it."""
