# SPDX-License-Identifier: BSD-3-Clause
"""Many tabs at once: a script for an otherwise idle machine.

    python tests/app/tabs.py [TABS]

Many tabs request the page of `pyehl app` and open its socket at the same time, as browsers do.
Prints when the last one had both; exit status 1 if that took more than 20 s.
"""

import asyncio
import re
import subprocess
import sys
import time

from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.websocket import websocket_connect

ALLOWED, TIMEOUT = 20.0, 300.0
"""Seconds until all tabs are open, and until the script gives up."""


async def tab(address: str, began: float) -> tuple[float, float]:
    """Give the seconds until a tab has its page, and its socket."""
    waits = {"request_timeout": TIMEOUT, "connect_timeout": TIMEOUT}
    answer = await AsyncHTTPClient().fetch(HTTPRequest(address, **waits))
    page = time.perf_counter() - began
    match = re.search(r'"token":"([^"]+)"', answer.body.decode())
    assert match is not None
    protocols = ["bokeh", match[1]]
    headers = {"Origin": address.rstrip("/")}
    request = HTTPRequest(f"ws{address.removeprefix('http')}ws", headers=headers, **waits)
    socket = await websocket_connect(request, subprotocols=protocols)
    await socket.read_message()
    return page, time.perf_counter() - began


async def opened(address: str, count: int) -> list[tuple[float, float]]:
    """Open the tabs."""
    AsyncHTTPClient.configure(None, max_clients=count)
    began = time.perf_counter()
    return await asyncio.gather(*(tab(address, began) for _ in range(count)))


def main() -> int:
    """Serve the page, and open the tabs."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 30
    command = [sys.executable, "-m", "pyehl", "app", "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        try:
            match = re.match(r"http\S+", server.stdout.readline() if server.stdout else "")
            assert match is not None
            times = asyncio.run(opened(match[0], count))
        finally:
            server.terminate()
    pages, sockets = (max(column) for column in zip(*times, strict=True))
    print(f"{count} tabs: the last page after {pages:.1f} s, the last socket after {sockets:.1f} s")
    return int(sockets > ALLOWED)


if __name__ == "__main__":
    sys.exit(main())
