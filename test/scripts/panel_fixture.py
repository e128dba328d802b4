# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The panel without ROS, for its tests: a fake takes the place of the nodes."""
import contextlib
import http.client
import json
import math
import pathlib
import sys
import threading
import time
import unittest

sys.dont_write_bytecode = True
PANEL = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "panel"
sys.path[:0] = [str(PANEL.parent), str(pathlib.Path(__file__).resolve().parents[1])]
from codesign_panel import server  # noqa: E402
from codesign_panel.board import Board  # noqa: E402
from codesign_panel.requests import Refused  # noqa: E402
from patience import PATIENCE  # noqa: E402

LONG_NAME = "a_controller_of_the_left_" + "shoulder_" * 8


class FakeNodes:
    """Takes what a page asks for; refuses what has the name `refused`."""

    def __init__(self):
        self.asked = []

    def do(self, what, fields):
        self.asked.append((what, fields))
        if fields.get("name") == "refused":
            raise Refused("refused: no such joint")
        return f"{what} is done"


class PanelTestCase(unittest.TestCase):
    """A panel with fake nodes, as it is while a simulation runs."""

    def setUp(self):
        self.board, self.nodes = Board(), FakeNodes()
        self.server = server.make_server(0, self.board, self.nodes)
        self.port = self.server.server_address[1]
        thread = threading.Thread(target=self.server.serve_forever, kwargs={"poll_interval": 0.02})
        thread.start()
        self.addCleanup(self.server.server_close)
        self.addCleanup(thread.join)
        self.addCleanup(self.server.shutdown)
        self.addCleanup(self.server.has_ended.set)
        for node in ("simulation", "optimization"):
            self.board.tell(node, name=f"/{node}", seen=time.monotonic() + 1e6, message=f"running {node}", values={"robot": "arm"})
        self.board.tell("parameters", values={"length": 0.5, LONG_NAME: 2.0}, described=[
            {"name": "length", "label": "length [m]", "min": 0.0, "max": 1.0, "initial": 0.4},
            {"name": LONG_NAME, "label": LONG_NAME, "min": None, "max": None, "initial": 2.0}])
        self.board.tell("commands", efforts={"elbow": 0.0}, controllers=["servo", LONG_NAME], setpoints={"servo": 0.25})

    def frame(self, k):
        self.board.curves.add("joint_states", 0.1 * k, ["elbow", LONG_NAME], ("position",), [[math.sin(0.1 * k), k]])
        self.board.curves.add("joint_friction", 0.1 * k, ["elbow"], ("friction",), [[-math.cos(0.1 * k)]])

    def ask(self, method, path, body=None, hosts=None, **headers):
        """Code, headers and text of an answer. `hosts`: the Host headers, by default the right one; headers with _ for -."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        with contextlib.closing(connection):
            connection.putrequest(method, path, skip_host=True)
            for host in [f"localhost:{self.port}"] if hosts is None else hosts:
                connection.putheader("Host", host)
            if body is not None and "Content_Length" not in headers:
                connection.putheader("Content-Length", str(len(body)))
            for name, value in headers.items():
                connection.putheader(name.replace("_", "-"), value)
            connection.endheaders(body)
            answer = connection.getresponse()
            return answer.status, answer.headers, answer.read().decode()

    def post(self, request, **headers):
        return self.ask("POST", "/do", json.dumps(request).encode(), Content_Type="application/json", **headers)
