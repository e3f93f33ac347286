# SPDX-License-Identifier: BSD-3-Clause
"""Worker processes, of this machine or of a dask scheduler, which turn tasks into rows.

On this machine each worker is its own loky executor: a worker that crashes or is killed takes only
its own tasks with it. dask gives a task whose worker died to another one, and abandons a task after
several such deaths (``distributed.scheduler.allowed-failures``).
"""

from __future__ import annotations

import atexit
import os
import re
import threading
import time
import uuid
from collections import Counter, deque
from collections.abc import Generator, Iterable, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Future, wait
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from pyehl.errors import EhlError, InputError, InternalError
from pyehl.given import check_kind
from pyehl.studies.tasks import FAILED, Task, execute, execute_all
from pyehl.types import Row

if TYPE_CHECKING:
    from loky import ProcessPoolExecutor

# Maximum number of tasks that a worker gets at once, and total time above which it gets no more [s]
MAX_TASKS, SHORT = 64, 0.1
# Number of workers that may die with a task before it has failed
TRIES = 2
ENVIRONMENT = {
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    # no imports from the current folder
    "PYTHONSAFEPATH": "1",
}
# Seconds to wait for the scheduler; seconds between checks that the parent of a worker is alive;
# seconds that a worker waits for the next study
CONNECT_TIMEOUT, CHECK_INTERVAL, IDLE_TIMEOUT = 20, 0.2, 10


def processors() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def check_jobs(jobs: int) -> None:
    """Refuse an invalid number of worker processes; 0 stands for the number of processors."""
    check_kind(jobs, int, "jobs", "a number of worker processes")
    if jobs < 0:
        raise InputError(f"jobs = {jobs}: expected a number of worker processes")


class Queue:
    """Waiting tasks, the longest first; those that share work form a group, for one worker.

    When every group has a worker, an idle one takes from that with the most tasks.
    """

    def __init__(self, tasks: Sequence[Task]) -> None:
        self._groups: dict[str, deque[Task]] = {}
        for task in sorted(tasks, key=lambda t: (-t.seconds, t.number)):
            self._groups.setdefault(group_of(task), deque()).append(task)
        self._free = deque(self._groups)
        self._again: deque[Task] = deque()

    def take(self, last: str) -> list[Task]:
        """Give a task, or some short ones, to a worker whose last task was in the group `last`.

        Empty if no task waits.
        """
        if self._again:
            return [self._again.popleft()]
        result: list[Task] = []
        while self._groups and len(result) < MAX_TASKS and sum(t.seconds for t in result) < SHORT:
            if last not in self._groups:
                # a new group, or part of that with the most tasks
                last = (
                    self._free.popleft()
                    if self._free
                    else max(self._groups, key=lambda key: len(self._groups[key]))
                )
            result.append(self._groups[last].popleft())
            if not self._groups[last]:
                del self._groups[last]
        return result

    def put_back(self, tasks: Iterable[Task]) -> None:
        """Return unfinished tasks; from now on each is given alone."""
        self._again += tasks


def group_of(task: Task) -> str:
    """Name the group of tasks that share work."""
    return task.shares or str(task.number)


def _begin(parent: int) -> None:
    """Make a process a worker: it ignores Ctrl-C, and ends when its parent has died."""
    os.setsid()
    # prints of libraries go to standard error
    os.dup2(2, 1)
    threading.Thread(target=_end_without, args=(parent,), daemon=True).start()
    # end at once: the parent waits for an idle worker, which has nothing to clean up
    atexit.register(os._exit, 0)


def _end_without(parent: int) -> None:
    """Wait until the parent has died, then end this process."""
    while os.getppid() == parent:
        time.sleep(CHECK_INTERVAL)
    os._exit(0)


def rows(tasks: Sequence[Task], jobs: int) -> Generator[list[tuple[int, Row]]]:
    """Run tasks in `jobs` worker processes; yields rows as they are finished.

    Workers of a study that has just ended are reused: starting one takes longer than a task. A task
    whose worker dies is given to another one once; after a second death its row reports it. If the
    caller stops early or raises an exception, the workers end at once. InternalError if no worker
    reaches its first row.
    """
    queue = Queue(tasks)
    died: Counter[int] = Counter()
    deaths, works = 0, False
    executors: list[ProcessPoolExecutor] = []
    running: dict[Future[list[Row]], tuple[int, list[Task]]] = {}
    groups, idle = [""] * jobs, list(range(jobs))
    try:
        executors += [_spare() for _ in range(jobs)]
        while True:
            while idle and (some := queue.take(groups[idle[-1]])):
                k = idle.pop()
                groups[k] = group_of(some[-1])
                running[_submit(executors[k], some)] = k, some
            if not running:
                for executor in executors:
                    _keep(executor)
                executors.clear()
                return
            finished: list[tuple[int, Row]] = []
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                k, some = running.pop(future)
                idle.append(k)
                error = future.exception()
                if error is None:
                    works = True
                    finished += zip((t.number for t in some), future.result(), strict=True)
                elif isinstance(error, BrokenExecutor):
                    deaths += 1
                    if not works and deaths > 2 * jobs:
                        raise InternalError("the worker processes end while they start") from error
                    executors[k].shutdown(kill_workers=True)
                    executors[k] = _executor()
                    # several tasks are then given one by one, which finds the faulty one
                    died.update(t.number for t in some if len(some) == 1)
                    failed = [t for t in some if died[t.number] >= TRIES]
                    finished += [(t.number, _failed(error)) for t in failed]
                    queue.put_back(t for t in some if t not in failed)
                else:
                    finished += [(t.number, _failed(error)) for t in some]
            if finished:
                yield finished
    finally:
        for executor in executors:
            executor.shutdown(kill_workers=True)


def _executor() -> ProcessPoolExecutor:
    from loky import ProcessPoolExecutor  # noqa: PLC0415 (slow to import)

    return ProcessPoolExecutor(1, initializer=_begin, initargs=(os.getpid(),), env=ENVIRONMENT)


# executors without a task
_spares: deque[ProcessPoolExecutor] = deque()
# a forked process has its own workers
os.register_at_fork(after_in_child=_spares.clear)


def _keep(executor: ProcessPoolExecutor) -> None:
    """Keep an executor for the next study, for `IDLE_TIMEOUT` seconds.

    The timeout of loky is not used: with it, loky does not notice the death of a worker that
    replaced another one.
    """

    def end() -> None:
        # another study may have taken it
        with suppress(ValueError):
            _spares.remove(executor)
            executor.shutdown(kill_workers=True)

    _spares.append(executor)
    timer = threading.Timer(IDLE_TIMEOUT, end)
    timer.daemon = True
    timer.start()


@atexit.register
def _end_spares() -> None:
    while _spares:
        _spares.popleft().shutdown(kill_workers=True)


def _spare() -> ProcessPoolExecutor:
    try:
        return _spares.pop()
    except IndexError:
        return _executor()


def _submit(executor: ProcessPoolExecutor, tasks: list[Task]) -> Future[list[Row]]:
    try:
        # a spare executor is in the folder of an earlier study
        future: Future[list[Row]] = executor.submit(execute_all, tasks, os.getcwd())
    except BrokenExecutor as error:
        # its worker died without a task
        future = Future()
        future.set_exception(error)
    return future


def _failed(error: BaseException) -> Row:
    """Make the row of a task that failed."""
    message = f"{type(error).__name__}: {error}"
    if isinstance(error, BrokenExecutor):
        match = re.search(r"exit codes of the workers are \{(.*)\}", message)
        cause = f", at last by {match[1]}" if match else f": {message}"
        message = f"its worker process died {TRIES} times{cause}"
    return {"status": FAILED, "message": message, "seconds": None}


def cluster_rows(tasks: Sequence[Task], address: str) -> Generator[list[tuple[int, Row]]]:
    """Run tasks with the workers of a scheduler; yields rows as they are finished.

    If the caller stops early, tasks that have not begun are cancelled. InputError if
    dask.distributed is not installed; EhlError if the scheduler does not answer.
    """
    try:
        from distributed import Client, as_completed  # noqa: PLC0415 (an optional extra)
    except ImportError as error:
        raise InputError("a scheduler needs dask: pip install 'pyehl[cluster]'") from error
    try:
        client = Client(address, timeout=CONNECT_TIMEOUT, set_as_default=False)
    except (OSError, ValueError) as error:
        raise EhlError(f"the dask scheduler at '{address}' does not answer: {error}") from error
    study = uuid.uuid4().hex
    # dask starts the first tasks first
    ordered = sorted(tasks, key=lambda task: (-task.seconds, task.shares, task.number))
    with client:
        keys = [f"pyehl-{study}-{task.number}" for task in ordered]
        futures = client.map(execute, ordered, key=keys, pure=False)
        numbers = {future.key: task.number for future, task in zip(futures, ordered, strict=True)}
        try:
            done = as_completed(futures, loop=client.loop, with_results=True, raise_errors=False)
            for batch in done.batches():
                yield [(numbers[future.key], _row(future, result)) for future, result in batch]
        finally:
            client.cancel(futures)


def _row(future: Any, result: Any) -> Row:  # noqa: ANN401 (types of an optional extra)
    """Give the row of a dask future, also of an abandoned task."""
    if future.status == "finished":
        row: Row = result
        return row
    error = future.exception() if future.status == "error" else None
    return _failed(error or EhlError(f"the task is {future.status}"))
