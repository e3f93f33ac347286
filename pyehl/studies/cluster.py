# SPDX-License-Identifier: BSD-3-Clause
"""The workers of a dask scheduler: tasks to rows, on as many machines as it has.

A task whose worker is lost goes to another one: dask does that, and gives a task up when several
workers were lost with it (``distributed.scheduler.allowed-failures``).
"""

import uuid
from collections.abc import Generator, Sequence
from typing import Any

from pyehl.errors import EhlError, InputError
from pyehl.studies.tasks import FAILED, Task, execute
from pyehl.types import Row

# Seconds to wait for the scheduler
PATIENCE = 20


def _execute(message: dict[str, Any]) -> Row:
    return execute(Task(**message))


def rows(tasks: Sequence[Task], address: str) -> Generator[list[tuple[int, Row]]]:
    """Do tasks with the workers of a scheduler; yields what has been finished, some at a time.

    When the caller stops early, what has not begun is taken back. InputError if dask.distributed
    is not installed; EhlError if the scheduler does not answer.
    """
    try:
        from distributed import Client, as_completed  # noqa: PLC0415 (an optional extra)
    except ImportError as error:
        raise InputError("--scheduler needs dask: pip install 'pyehl[cluster]'") from error
    try:
        client = Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        raise EhlError(f"the dask scheduler at '{address}' does not answer: {error}") from error
    study = uuid.uuid4().hex
    # dask begins with what comes first
    ordered = sorted(tasks, key=lambda task: (-task.seconds, task.shares, task.number))
    with client:
        futures = client.map(
            _execute,
            [task.message() for task in ordered],
            key=[f"pyehl-{study}-{task.number}" for task in ordered],
            pure=False,
        )
        numbers = {future.key: task.number for future, task in zip(futures, ordered, strict=True)}
        try:
            done = as_completed(futures, loop=client.loop, with_results=True, raise_errors=False)
            for batch in done.batches():
                yield [(numbers[future.key], _row(future, result)) for future, result in batch]
        finally:
            client.cancel(futures)


def _row(future: Any, result: Any) -> Row:  # noqa: ANN401 (types of an optional extra)
    """Give the row of a future; what dask gave up is a row too."""
    if future.status == "finished":
        row: Row = result
        return row
    error = future.exception() if future.status == "error" else None
    message = f"{type(error).__name__}: {error}" if error else f"the task is {future.status}"
    return {"status": FAILED, "message": message, "seconds": None}
