# SPDX-License-Identifier: BSD-3-Clause
"""The server of the page, which accepts requests from this machine only."""

import logging
import re
import webbrowser
from collections.abc import Callable

from bokeh.application import Application
from bokeh.application.handlers.function import FunctionHandler
from bokeh.document import Document
from bokeh.server.server import Server
from bokeh.server.util import bind_sockets
from tornado.web import Application as Routes
from tornado.web import HTTPError, RequestHandler

from pyehl.app.page import Page
from pyehl.app.position import Position
from pyehl.app.uploads import MAX_BYTES
from pyehl.errors import InputError

ADDRESS = "127.0.0.1"
HOSTS = (ADDRESS, "localhost")
"""Names of this machine in a browser; another one is refused, as an attack by DNS rebinding."""
# Lifetime of the session of a closed tab, and interval of the checks [ms]. A shorter lifetime would
# end sessions whose browser still waits to connect, and their pages would be made twice.
UNUSED, LOOK = 30_000, 3000


class _Elsewhere(RequestHandler):
    """Refuses requests with another host name."""

    def prepare(self) -> None:
        raise HTTPError(403, f"the page is only at {' and '.join(HOSTS)}")


def _only_for_hosts(routes: Routes) -> None:
    """Refuse requests of every kind whose Host is not this machine."""
    known = "|".join(map(re.escape, HOSTS))
    routes.add_handlers(rf"(?!(?:{known})$).*", [(r".*", _Elsewhere)])


def make_server(
    start: Position, note: str, port: int = 0, made: Callable[[Page], None] | None = None
) -> Server:
    """Make a server that is already listening; port 0: any free port.

    Each page begins at `start` and shows `note`; `made` is called with it. InputError if the server
    cannot listen at the port.
    """

    def page(document: Document) -> None:
        new = Page(document, start, note)
        if made is not None:
            made(new)

    # no log of requests on the terminal
    logging.getLogger("bokeh").setLevel(logging.ERROR)
    logging.getLogger("tornado").setLevel(logging.ERROR)
    try:
        # only its own origin is allowed, so the port must be known before the server is made
        sockets, result = bind_sockets(ADDRESS, port)
        for socket in sockets:
            socket.close()
        server = Server(
            {"/": Application(FunctionHandler(page))},
            address=ADDRESS,
            port=result,
            # Bokeh also allows the origin that equals the Host header, which is checked first
            allow_websocket_origin=[f"{host}:{result}" for host in HOSTS],
            check_unused_sessions_milliseconds=LOOK,
            unused_session_lifetime_milliseconds=UNUSED,
            websocket_max_message_size=2 * MAX_BYTES,
        )
    except OSError as error:
        raise InputError(
            f"--port {port}: {error.strerror or error}\nexpected: a free port, or none"
        ) from error
    _only_for_hosts(server._tornado)
    return server


def serve(
    start: Position,
    note: str = "",
    *,
    port: int = 0,
    browser: bool = True,
    say: Callable[[str], object] = print,
) -> None:
    """Serve the page until it is interrupted. InputError if it cannot listen at the port."""
    server = make_server(start, note, port)
    address = f"http://{ADDRESS}:{server.port}/"
    say(f"{address}  (Ctrl-C ends it)")
    server.start()
    if browser:
        server.io_loop.add_callback(webbrowser.open, address)
    try:
        server.io_loop.start()
    except KeyboardInterrupt:
        say("ended")
    finally:
        server.stop()
