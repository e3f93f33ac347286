# SPDX-License-Identifier: BSD-3-Clause
"""The thread of a page: it runs only the newest job; exceptions; its end."""

import threading
import time
from functools import partial

import pytest

from pyehl.app import answers
from pyehl.app.position import from_case
from pyehl.app.worker import JobContext, Worker
from pyehl.case import Case
from pyehl.errors import InputError


def test_worker_computes_only_the_newest_request():
    reported: list[tuple[int, object]] = []
    begun, go = threading.Event(), threading.Event()
    worker = Worker(lambda generation, answer: reported.append((generation, answer)))

    def first(context):
        begun.set()
        assert go.wait(10.0)
        context.answer_with("first")
        if context.wait(5.0):
            context.answer_with("never")

    assert worker.submit(first) == 1
    assert begun.wait(10.0)
    worker.submit(lambda context: context.answer_with("overtaken"))
    last = worker.submit(lambda context: context.answer_with("last"))
    go.set()
    end = time.monotonic() + 10.0
    while len(reported) < 2 and time.monotonic() < end:
        time.sleep(0.01)
    worker.close()
    assert reported == [(1, "first"), (last, "last")]
    assert not worker.alive


def test_worker_reports_an_exception_and_continues():
    reported: list[object] = []
    worker = Worker(lambda generation, answer: reported.append(answer))
    done = threading.Event()

    def bad(context):
        raise InputError("no")

    worker.submit(bad)
    time.sleep(0.1)
    worker.submit(lambda context: done.set())
    assert done.wait(10.0)
    worker.close()
    assert [str(answer) for answer in reported] == ["no"]


@pytest.mark.parametrize("wanted", [JobContext.wanted, JobContext.newest])
def test_closed_worker_stops_a_solver(wanted):
    """Closing a tab stops its computation, on coarse and on fine grids."""
    start, _ = from_case(Case())
    worker = Worker(lambda generation, answer: None)
    began = threading.Event()

    def job(context):
        began.set()
        while wanted(context):
            answers.film(start, 65, partial(wanted, context))

    worker.submit(job)
    assert began.wait(10.0)
    worker.close()
    assert not worker.alive
