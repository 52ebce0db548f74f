"""Tasks that begin an event loop of their own, carried out where none runs yet."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable


Made = TypeVar("Made")


def in_own_thread(task: Callable[..., Made], *arguments: object, **options: object) -> Made:
    """Call a task in a thread of its own and wait for it.

    pyHanko signs and checks within `asyncio.run`, which a thread in which a loop runs refuses: that of a
    notebook, or of a service.
    """
    with ThreadPoolExecutor(1) as apart:
        return apart.submit(task, *arguments, **options).result()
