# SPDX-License-Identifier: BSD-3-Clause
"""A worker process: tasks come in as lines of JSON, rows go out.

``python -m pyehl.studies.worker``. It ends when its input does, also in the middle of a case: then
nobody is left who would take the row.
"""

import json
import os
import queue
import sys
import threading
from typing import TextIO

from pyehl.studies.tasks import Task, execute


def _read(source: TextIO, tasks: queue.Queue[Task]) -> None:
    """Take tasks in while another one is done, so that none is waited for."""
    for line in source:
        tasks.put(Task(**json.loads(line)))
    os._exit(0)


def main() -> None:
    """Do tasks until there are none."""
    # Rows have standard output for themselves: what a library prints goes to standard error
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    tasks: queue.Queue[Task] = queue.Queue()
    threading.Thread(target=_read, args=(sys.stdin, tasks), daemon=True).start()
    while True:
        task = tasks.get()
        row = execute(task)
        try:
            answers.write(json.dumps([task.number, row]) + "\n")
            answers.flush()
        except BrokenPipeError:
            os._exit(0)


if __name__ == "__main__":
    main()
