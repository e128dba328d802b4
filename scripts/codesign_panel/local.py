# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Servers of pages on this machine alone: those of `panel` and of `watch`."""
import http.server
import re
import sys

HOSTS = ("localhost", "127.0.0.1")


def refusal(headers, path):
    """Why a request is not answered, or None. A page of another site reaches this machine under a name of its own (Host), or says where it
    is from (Origin, Sec-Fetch-Site)."""
    hosts = headers.get_all("Host", [])
    if len(hosts) != 1 or not re.fullmatch("(" + "|".join(map(re.escape, HOSTS)) + r")(:\d+)?", hosts[0], re.IGNORECASE):
        return "Host: only localhost and 127.0.0.1 are answered"
    origins = headers.get_all("Origin", [])
    if any(origin.lower() != f"http://{hosts[0].lower()}" for origin in origins):
        return "Origin: pages of other origins are not answered"
    # A link from elsewhere may open the page, which has no effect.
    if path != "/" and headers.get("Sec-Fetch-Site", "none") not in ("none", "same-origin"):
        return "Sec-Fetch-Site: pages of other origins are not answered"
    return None


class LocalServer(http.server.ThreadingHTTPServer):
    """Raises OSError for a port that is taken."""

    def __init__(self, port, handler):
        super().__init__(("127.0.0.1", port), handler)

    def handle_error(self, request, client_address):
        """A browser may close a connection at any time, which is no fault of this program."""
        if not isinstance(sys.exc_info()[1], (ConnectionError, TimeoutError)):
            super().handle_error(request, client_address)
