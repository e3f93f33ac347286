# SPDX-License-Identifier: BSD-3-Clause
"""Worker processes, of this machine or of a dask scheduler: tasks to rows, as they are finished.

On this machine each worker is an executor of loky of its own: a worker that crashes or is killed
takes its own tasks with it alone. A task whose worker of dask is lost goes to another one: dask
does that, and gives a task up when several workers were lost with it
(``distributed.scheduler.allowed-failures``).
"""

import os
import re
import threading
import time
import uuid
from collections import Counter, deque
from collections.abc import Generator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Future, wait
from typing import Any

from pyehl.errors import EhlError, InputError, InternalError
from pyehl.given import check_kind
from pyehl.studies.tasks import FAILED, Task, execute
from pyehl.types import Row

# A worker has the next task waiting where tasks are shorter than this [s]
SHORT = 0.5
# How often a task may end its worker before it has failed
TRIES = 2
ENVIRONMENT = {
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    # a module in the current folder is not taken for one of a library
    "PYTHONSAFEPATH": "1",
}
# Seconds to wait for the scheduler; seconds between looks for the parent of a worker
PATIENCE, LOOK = 20, 0.2


def processors() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def check_jobs(jobs: int) -> None:
    """Refuse what is no number of worker processes."""
    check_kind(jobs, int, "jobs", "a number of worker processes")
    if jobs < 0:
        raise InputError(f"jobs = {jobs}: expected a number of worker processes")


class Queue:
    """Tasks that wait, the longest first; those that share something stay with one worker."""

    def __init__(self, tasks: Sequence[Task]) -> None:
        self._groups: dict[str, deque[Task]] = {}
        for task in sorted(tasks, key=lambda t: (-t.seconds, t.number)):
            self._groups.setdefault(group_of(task), deque()).append(task)
        self._free = deque(self._groups)
        self._again: deque[Task] = deque()

    def take(self, last: str) -> Task | None:
        """Give the next task to a worker whose last one was of a group; None when none is left."""
        if self._again:
            return self._again.popleft()
        if not self._groups:
            return None
        if last not in self._groups:
            # a new group, or a part of the longest one
            last = (
                self._free.popleft()
                if self._free
                else max(self._groups, key=lambda key: len(self._groups[key]))
            )
        task = self._groups[last].popleft()
        if not self._groups[last]:
            del self._groups[last]
        return task

    def put_back(self, task: Task) -> None:
        """Return a task that its worker has not done."""
        self._again.append(task)


def group_of(task: Task) -> str:
    """Name what a task shares with others."""
    return task.shares or str(task.number)


def _begin(parent: int) -> None:
    """Make a process a worker: Ctrl-C is for its parent alone, without which it ends at once."""
    os.setsid()
    # what a library prints goes to standard error
    os.dup2(2, 1)
    threading.Thread(target=_end_without, args=(parent,), daemon=True).start()


def _end_without(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(LOOK)
    os._exit(0)


class Worker:
    """A worker process and what it has to do."""

    def __init__(self) -> None:
        # it takes long to import
        from loky import ProcessPoolExecutor  # noqa: PLC0415

        self._executor = ProcessPoolExecutor(
            1, initializer=_begin, initargs=(os.getpid(),), env=ENVIRONMENT
        )
        self.tasks: dict[Future[Row], Task] = {}  # in the order in which they are done
        self.works = False  # whether it has finished a task
        self._last = ""

    def feed(self, queue: Queue) -> None:
        """Take the next task, where the ones at hand are short the one behind it too."""
        while len(self.tasks) < 2 and all(task.seconds < SHORT for task in self.tasks.values()):
            task = queue.take(self._last)
            if task is None:
                return
            self._last = group_of(task)
            try:
                self.tasks[self._executor.submit(execute, task)] = task
            except BrokenExecutor as error:
                # it died without a task; `collect` finds out
                broken: Future[Row] = Future()
                broken.set_exception(error)
                self.tasks[broken] = task

    def collect(self) -> tuple[list[tuple[int, Row]], BrokenExecutor | None]:
        """Give the rows that are finished, and why the process has ended if it has."""
        found: list[tuple[int, Row]] = []
        for future in [future for future in self.tasks if future.done()]:
            error = future.exception()
            if isinstance(error, BrokenExecutor):
                return found, error
            task = self.tasks.pop(future)
            found.append((task.number, _failed(error) if error else future.result()))
            self.works = True
        return found, None

    def end(self) -> None:
        """End the process, whatever it does."""
        self._executor.shutdown(kill_workers=True)


def rows(tasks: Sequence[Task], jobs: int) -> Generator[list[tuple[int, Row]]]:
    """Do tasks in `jobs` worker processes; yields rows as they come.

    A task whose worker dies is given to another one once more; then its row reports it. When the
    caller stops early, or an exception is raised in it, the workers end at once. InternalError if
    no worker comes as far as its first row.
    """
    queue, left = Queue(tasks), len(tasks)
    died: Counter[int] = Counter()
    workers: list[Worker] = []
    works = False
    try:
        workers += [Worker() for _ in range(jobs)]
        while left:
            for worker in workers:
                worker.feed(queue)
            wait([f for worker in workers for f in worker.tasks], return_when=FIRST_COMPLETED)
            finished = []
            for k, worker in enumerate(workers):
                found, error = worker.collect()
                finished += found
                works = works or worker.works
                if error is None:
                    continue
                # the first of its tasks was running
                lost, *waiting = worker.tasks.values()
                died[lost.number] += 1
                if not works and died.total() > 2 * jobs:
                    raise InternalError("the worker processes end before they begin") from error
                if died[lost.number] < TRIES:
                    queue.put_back(lost)
                else:
                    finished.append((lost.number, _failed(error)))
                for task in waiting:
                    queue.put_back(task)
                worker.end()
                workers[k] = Worker()
            left -= len(finished)
            if finished:
                yield finished
    finally:
        for worker in workers:
            worker.end()


def _failed(error: BaseException) -> Row:
    """Give the row of a task that has none."""
    message = f"{type(error).__name__}: {error}"
    if isinstance(error, BrokenExecutor):
        found = re.search(r"exit codes of the workers are \{(.*)\}", message)
        cause = f", at last by {found[1]}" if found else f": {message}"
        message = f"its worker process died {TRIES} times{cause}"
    return {"status": FAILED, "message": message, "seconds": None}


def cluster_rows(tasks: Sequence[Task], address: str) -> Generator[list[tuple[int, Row]]]:
    """Do tasks with the workers of a scheduler; yields what has been finished, some at a time.

    When the caller stops early, what has not begun is taken back. InputError if dask.distributed
    is not installed; EhlError if the scheduler does not answer.
    """
    try:
        from distributed import Client, as_completed  # noqa: PLC0415 (an optional extra)
    except ImportError as error:
        raise InputError("a scheduler needs dask: pip install 'pyehl[cluster]'") from error
    try:
        client = Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        raise EhlError(f"the dask scheduler at '{address}' does not answer: {error}") from error
    study = uuid.uuid4().hex
    # dask begins with what comes first
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
    """Give the row of a future of dask; what dask gave up is a row too."""
    if future.status == "finished":
        row: Row = result
        return row
    error = future.exception() if future.status == "error" else None
    return _failed(error or EhlError(f"the task is {future.status}"))
