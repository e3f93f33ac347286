# SPDX-License-Identifier: BSD-3-Clause
"""What several cases share is made once in a process."""

from __future__ import annotations

import threading
import time
from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

__all__ = ["Kept", "saved_seconds"]

T = TypeVar("T")

_ALL: list[Kept] = []


class Kept(Generic[T]):
    """The last few results of something that takes long, by what they were made of.

    Parameters
    ----------
    most
        How many are kept.

    Attributes
    ----------
    saved
        Seconds that were not spent on making them again.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._items: OrderedDict[Hashable, tuple[T, float]] = OrderedDict()
        self._lock = threading.Lock()
        self.saved = 0.0
        _ALL.append(self)

    def get(self, name: Hashable, make: Callable[[], T]) -> T:
        """Give what belongs to a name, made now if it is not there; nobody may change it."""
        with self._lock:
            if name in self._items:
                self._items.move_to_end(name)
                item, seconds = self._items[name]
                self.saved += seconds
                return item
        began = time.perf_counter()
        item = make()
        with self._lock:
            self._items[name] = item, time.perf_counter() - began
            while len(self._items) > self._most:
                self._items.popitem(last=False)
        return item

    def clear(self) -> None:
        """Keep nothing of what was made so far."""
        with self._lock:
            self._items.clear()


def saved_seconds() -> float:
    """Seconds that all that is kept in this process has saved so far."""
    return sum(kept.saved for kept in _ALL)
