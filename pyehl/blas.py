# SPDX-License-Identifier: BSD-3-Clause
"""Matrix products on one thread, so that results do not depend on the number of threads."""

from collections.abc import Iterator
from contextlib import contextmanager
from threading import Lock

from threadpoolctl import threadpool_limits

_LOCK = Lock()
_limits: list[threadpool_limits] = []
_users = 0


@contextmanager
def one_thread() -> Iterator[None]:
    """Limit BLAS to one thread while any caller is inside the block; also a decorator.

    The order of its sums depends on the threads; the limit applies to the whole process.
    """
    global _users  # noqa: PLW0603
    with _LOCK:
        if _users == 0:
            _limits.append(threadpool_limits(1, user_api="blas"))
        _users += 1
    try:
        yield
    finally:
        with _LOCK:
            _users -= 1
            if _users == 0:
                _limits.pop().restore_original_limits()
