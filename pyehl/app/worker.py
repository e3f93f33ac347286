# SPDX-License-Identifier: BSD-3-Clause
"""One thread that computes for one page: only the newest job, never two at a time.

Each job gets an increasing number, its generation, which its answers carry, so that the page can
ignore an answer older than the one shown.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

# Time for which a superseded job may continue [s], so that results appear while a control moves
# without a pause
GRACE = 0.4


class JobContext:
    """Context of a job: whether it is still needed, and where to report."""

    def __init__(self, worker: Worker, generation: int) -> None:
        self._worker, self.generation = worker, generation
        self._began = time.monotonic()

    def newest(self) -> bool:
        """Whether no newer job was submitted, and the worker is not closed."""
        return not self._worker.closed and self._worker.generation == self.generation

    def wanted(self) -> bool:
        """Whether an answer is still useful: the job is the newest, or has just begun."""
        if self.newest():
            return True
        return not self._worker.closed and time.monotonic() - self._began < GRACE

    def wait(self, seconds: float) -> bool:
        """Wait until `seconds` after its beginning; whether the job is still the newest one."""
        left = seconds - (time.monotonic() - self._began)
        return self._worker.wait(self.generation, max(0.0, left))

    def answer_with(self, answer: Any) -> None:  # noqa: ANN401 (of any kind)
        """Deliver an answer."""
        if not self._worker.closed:
            self._worker.deliver(self.generation, answer)


Job = Callable[[JobContext], None]


class Worker:
    """A thread with a queue of one job, the newest, which replaces an older one.

    `deliver` is called in this thread with the generation and an answer; a job that raises is
    answered with the exception.
    """

    def __init__(self, deliver: Callable[[int, Any], None], name: str = "pyehl") -> None:
        self.deliver = deliver
        self.generation = 0
        self.closed = False
        self._job: Job | None = None
        self._changed = threading.Condition()
        self._thread = threading.Thread(target=self._work, name=name, daemon=True)
        self._thread.start()

    def submit(self, job: Job) -> int:
        """Submit a job in place of a waiting one; returns its generation."""
        with self._changed:
            self.generation += 1
            self._job = job
            self._changed.notify_all()
            return self.generation

    def wait(self, generation: int, seconds: float) -> bool:
        """Wait for `seconds`, or until there is a newer job; whether there is none."""
        with self._changed:
            self._changed.wait_for(
                lambda: self.closed or self.generation != generation, timeout=seconds
            )
            return not self.closed and self.generation == generation

    def close(self) -> None:
        """End the thread after the present cycle of a film, or after a prediction or a download."""
        with self._changed:
            self.closed = True
            self._job = None
            self._changed.notify_all()
        if threading.current_thread() is not self._thread:
            self._thread.join()

    @property
    def alive(self) -> bool:
        """Whether the thread runs."""
        return self._thread.is_alive()

    def _work(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self.closed or self._job is not None)
                if self.closed or self._job is None:
                    return
                job, self._job = self._job, None
                context = JobContext(self, self.generation)
            try:
                job(context)
            except Exception as error:
                context.answer_with(error)
