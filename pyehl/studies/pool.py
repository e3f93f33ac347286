# SPDX-License-Identifier: BSD-3-Clause
"""Worker processes, of this machine or of a dask scheduler: tasks to rows, as they are finished.

A task whose worker of dask is lost goes to another one: dask does that, and gives a task up when
several workers were lost with it (``distributed.scheduler.allowed-failures``).
"""

import json
import os
import selectors
import signal
import subprocess
import sys
import uuid
from collections import deque
from collections.abc import Generator, Sequence
from typing import Any

from pyehl.errors import EhlError, InputError, InternalError
from pyehl.studies.tasks import FAILED, Task, execute
from pyehl.types import Row

# A worker has the next task waiting where tasks are shorter than this [s]
SHORT = 0.5
# How often a task may end its worker before it has failed
TRIES = 2
ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}
# Seconds to wait for the scheduler
PATIENCE = 20


def processors() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class Queue:
    """Tasks that wait, the longest first; those that share something stay with one worker."""

    def __init__(self, tasks: Sequence[Task]) -> None:
        groups: dict[str, deque[Task]] = {}
        for task in sorted(tasks, key=lambda t: (-t.seconds, t.number)):
            groups.setdefault(task.shares or str(task.number), deque()).append(task)
        self._free = deque(groups)
        self._groups = groups
        self._again: deque[Task] = deque()

    def take(self, last: str) -> Task | None:
        """Give the next task to a worker whose last one shared `last`; None when none is left."""
        if self._again:
            return self._again.popleft()
        if last not in self._groups:
            if self._free:
                last = self._free.popleft()
            elif self._groups:
                # all groups are begun: help with the longest
                last = max(self._groups, key=lambda key: len(self._groups[key]))
            else:
                return None
        group = self._groups[last]
        task = group.popleft()
        if not group:
            del self._groups[last]
        return task

    def put_back(self, task: Task) -> None:
        """Give a task back that its worker has not done."""
        self._again.append(task)


class Worker:
    """A worker process and what it has to do."""

    def __init__(self) -> None:
        # A session of its own: Ctrl-C is for the parent alone, which then ends its workers
        self.process = subprocess.Popen(
            [sys.executable, "-P", "-m", "pyehl.studies.worker"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=os.environ | ONE_THREAD,
            start_new_session=True,
        )
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        self.stdin, self.stdout = self.process.stdin, self.process.stdout
        os.set_blocking(self.stdout.fileno(), False)
        self.tasks: deque[Task] = deque()
        self.last = ""
        self._rest = b""

    def give(self, task: Task) -> None:
        """Send a task."""
        self.tasks.append(task)
        self.last = task.shares or str(task.number)
        try:
            self.stdin.write(json.dumps(task.message()).encode() + b"\n")
            self.stdin.flush()
        except BrokenPipeError:
            pass  # its end is seen when its output ends

    def wants(self) -> bool:
        """Whether it should be given another task."""
        return not self.tasks or (len(self.tasks) == 1 and self.tasks[0].seconds < SHORT)

    def read(self) -> tuple[list[tuple[int, Row]], bool]:
        """Give the rows that have come, and whether the process has ended."""
        ended = False
        while True:
            part = self.stdout.read(1 << 16)
            if part is None:
                break
            if not part:
                ended = True
                break
            self._rest += part
        *lines, self._rest = self._rest.split(b"\n")
        found = []
        for line in lines:
            number, row = json.loads(line)
            self.tasks.popleft()
            found.append((int(number), row))
        return found, ended

    def end(self) -> int:
        """End the process, whatever it does; returns its exit status."""
        self.process.kill()
        status = self.process.wait()
        self.stdout.close()
        try:
            self.stdin.close()
        except BrokenPipeError:
            pass
        return status


def rows(tasks: Sequence[Task], jobs: int) -> Generator[list[tuple[int, Row]]]:
    """Do tasks in `jobs` worker processes (0: as many as processors); yields rows as they come.

    A task whose worker dies is given to another one once more; then its row says so. When the
    caller stops early, or an exception is raised in it, the workers end at once. InternalError if
    no worker comes as far as its first row.
    """
    jobs = jobs or processors()
    crew = _Crew(tasks, jobs)
    left = len(tasks)
    try:
        crew.begin(min(jobs, left))
        while left:
            finished = crew.wait()
            left -= len(finished)
            if finished:
                yield finished
    finally:
        crew.end()


class _Crew:
    """The workers and the tasks that wait for them."""

    def __init__(self, tasks: Sequence[Task], jobs: int) -> None:
        self.waiting = Queue(tasks)
        self.workers: list[Worker] = []
        self.selector = selectors.DefaultSelector()
        self.died: dict[int, int] = {}
        self.most = 2 * jobs
        self.works = False

    def begin(self, count: int) -> None:
        """Start the workers and give each two short tasks or one long."""
        for _ in range(count):
            self._start()
        for _ in range(2):
            for worker in self.workers:
                self._feed(worker)

    def wait(self) -> list[tuple[int, Row]]:
        """Wait for rows; those that have come."""
        finished: list[tuple[int, Row]] = []
        for key, _ in self.selector.select():
            worker: Worker = key.data
            found, ended = worker.read()
            self.works = self.works or bool(found)
            finished += found
            if ended:
                finished += self._bury(worker)
                self._start()
            else:
                while self._feed(worker):
                    pass
        for worker in self.workers:
            if not worker.tasks:
                self._feed(worker)
        return finished

    def end(self) -> None:
        """End all workers, whatever they do."""
        for worker in self.workers:
            worker.end()
        self.selector.close()

    def _start(self) -> None:
        worker = Worker()
        self.workers.append(worker)
        self.selector.register(worker.stdout, selectors.EVENT_READ, worker)

    def _feed(self, worker: Worker) -> bool:
        """Give a worker a task if it wants one; whether it got one."""
        task = self.waiting.take(worker.last) if worker.wants() else None
        if task is not None:
            worker.give(task)
        return task is not None

    def _bury(self, worker: Worker) -> list[tuple[int, Row]]:
        """Give back the tasks of a worker that has died; the row of one it died of too often."""
        self.selector.unregister(worker.stdout)
        self.workers.remove(worker)
        left = list(worker.tasks)
        status = worker.end()
        failed: list[tuple[int, Row]] = []
        if left:
            first = left.pop(0)
            died = self.died[first.number] = self.died.get(first.number, 0) + 1
            if not self.works and sum(self.died.values()) > self.most:
                raise InternalError("the worker processes end before they begin")
            if died < TRIES:
                left.insert(0, first)
            else:
                cause = signal.Signals(-status).name if status < 0 else f"exit status {status}"
                message = f"its worker process died {TRIES} times, at last by {cause}"
                failed = [(first.number, {"status": FAILED, "message": message, "seconds": None})]
        for task in left:
            self.waiting.put_back(task)
        return failed


def _execute(message: dict[str, Any]) -> Row:
    return execute(Task(**message))


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
