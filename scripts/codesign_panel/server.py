# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The page on localhost: who is answered, and what."""
import base64
import functools
import hashlib
import http.server
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import time
import urllib.parse

from .local import LocalServer, refusal
from .requests import Refused, read_request

SCRIPTS = pathlib.Path(__file__).resolve().parent.parent
PAGE = SCRIPTS / "panel.html"
MOST_CURVES = 12  # of one page
MOST_BYTES = 65536  # of a request
PERIOD = 0.1  # [s] between two events of a page


def make_report(bag):
    """The page of `codesign report`. Raises Refused."""
    if not bag:
        raise Refused("no job with a bag has ended by its action since this program began")
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "report.html")
        done = subprocess.run([sys.executable, str(SCRIPTS / "report"), bag, "-o", path], stderr=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            raise Refused(done.stderr.strip())
        return pathlib.Path(path).read_bytes()


def policy(page):
    """The Content-Security-Policy of the page: its own style and script, and requests to this program alone."""
    def digest(tag):
        text = re.search(rf"<{tag}>(.*?)</{tag}>", page, re.DOTALL).group(1)
        return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"
    return (f"default-src 'none'; style-src {digest('style')}; script-src {digest('script')}; connect-src 'self'; img-src data:; "
            "base-uri 'none'; form-action 'none'; frame-ancestors 'none'")


class Handler(http.server.BaseHTTPRequestHandler):
    timeout = 60  # [s] of a connection that neither takes nor sends anything

    def __init__(self, board, nodes, *arguments):
        self._board, self._nodes = board, nodes
        super().__init__(*arguments)

    def do_GET(self):  # noqa: N802, the name that the base class calls
        why = refusal(self.headers, self.path)
        if why:
            self.send_error(403, why)
            return
        try:
            address = urllib.parse.urlparse(self.path)
        except ValueError:  # no address
            self.send_error(400)
            return
        if address.path == "/":
            page = PAGE.read_text(encoding="utf-8")
            self.reply("text/html; charset=utf-8", page.encode(), policy(page))
        elif address.path == "/events":
            self.stream(urllib.parse.parse_qs(address.query).get("signal", []))
        elif address.path == "/report.html":
            try:
                self.reply("text/html; charset=utf-8", make_report(self._board.bag), "sandbox; frame-ancestors 'none'")
            except Refused as error:
                self.send_error(404, "no report", str(error))
        else:
            self.send_error(404)

    def do_POST(self):  # noqa: N802
        length = self.headers.get("Content-Length", "")
        is_short = re.fullmatch("0*[0-9]{1,9}", length) and int(length[-9:]) <= MOST_BYTES
        content = self.rfile.read(int(length[-9:])) if is_short else None
        why = refusal(self.headers, self.path)
        if why:
            self.send_error(403, why)
        elif self.path != "/do":
            self.send_error(404)
        # A form of another site cannot send this kind without being asked for its origin first.
        elif self.headers.get_content_type() != "application/json":
            self.send_error(415, "Content-Type: application/json is needed")
        elif content is None:
            self.send_error(413, f"Content-Length: at most {MOST_BYTES} bytes")
        else:
            self.obey(content)

    def obey(self, content):
        try:
            what, fields = read_request(content)
        except Refused as error:
            self.reply("application/json", json.dumps({"success": False, "message": str(error)}).encode(), code=400)
            return
        try:
            answer = {"success": True, "message": self._nodes.do(what, fields)}
        except Refused as error:
            answer = {"success": False, "message": str(error)}
        self.reply("application/json", json.dumps(answer).encode())

    def start_reply(self, kind, policy_=None, code=200):
        self.send_response(code)
        self.send_header("Content-Type", kind)
        self.send_header("Cache-Control", "no-store")
        self.send_header("X-Content-Type-Options", "nosniff")
        self.send_header("Cross-Origin-Resource-Policy", "same-origin")
        if policy_:
            self.send_header("Content-Security-Policy", policy_)

    def reply(self, kind, content, policy_=None, code=200):
        self.start_reply(kind, policy_, code)
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)

    def stream(self, names):
        """Server-sent events: the state at each change, and the new points of these signals."""
        if len(names) > MOST_CURVES:
            self.send_error(400, f"at most {MOST_CURVES} signals")
            return
        self.start_reply("text/event-stream")
        self.end_headers()
        told, cursor, last = None, None, time.monotonic()
        try:
            while not self.server.has_ended.is_set():
                state, events = self._board.text(), ""
                if state != told:
                    told, events = state, f"event: state\ndata: {state}\n\n"
                points, cursor = self._board.curves.since(names, cursor)
                if points:
                    events += "event: curves\ndata: " + json.dumps({"generation": cursor[0], "points": points}, allow_nan=False) + "\n\n"
                # A comment shows whether the page is still there.
                if events or time.monotonic() - last > 2.0:
                    last = time.monotonic()
                    self.wfile.write((events or ":\n\n").encode())
                self.server.has_ended.wait(PERIOD)
        except OSError:  # the page is closed
            pass

    def log_message(self, *arguments):
        pass


def make_server(port, board, nodes):
    """Raises OSError for a port that is taken."""
    server = LocalServer(port, functools.partial(Handler, board, nodes))
    server.has_ended = threading.Event()
    return server
