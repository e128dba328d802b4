#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The panel without ROS: its curves, what it answers and what it refuses."""
import contextlib
import http.client
import io
import json
import math
import os
import socket
import struct
import subprocess
import sys
import unittest
import unittest.mock

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from panel_fixture import PANEL, PATIENCE, PanelTestCase, server  # noqa: E402
from codesign_panel import board, nodes  # noqa: E402


class CurvesTest(unittest.TestCase):
    def setUp(self):
        self.curves = board.Curves()

    def add(self, stamp, *positions, names=("elbow", "wrist")):
        self.curves.add("joint_states", stamp, names, ("position", "velocity"), [positions, [0.5] * len(positions)])

    def test_every_point_comes_once_with_the_time_since_the_first_frame(self):
        self.add(100.0, 1.0, 2.0)
        self.add(100.5, 3.0, math.nan)
        points, cursor = self.curves.since(["elbow/position", "wrist/position"], None)
        self.assertEqual(points, {"elbow/position": [[0.0, 1.0], [0.5, 3.0]], "wrist/position": [[0.0, 2.0], [0.5, None]]})
        self.assertEqual(self.curves.since(["elbow/position", "wrist/position"], cursor)[0], {})
        self.add(101.0, 4.0, 5.0)
        self.assertEqual(self.curves.since(["wrist/position"], cursor)[0], {"wrist/position": [[1.0, 5.0]]})
        self.assertEqual(self.curves.names(), ["elbow/position", "elbow/velocity", "wrist/position", "wrist/velocity"])

    def test_a_clock_that_was_set_back_and_other_names_begin_anew(self):
        self.add(100.0, 1.0, 2.0)
        _, cursor = self.curves.since(["elbow/position"], None)
        self.add(1.0, 7.0, 8.0)
        points, then = self.curves.since(["elbow/position"], cursor)
        self.assertEqual(points, {"elbow/position": [[0.0, 7.0]]})
        self.assertNotEqual(then[0], cursor[0])
        self.add(1.1, 9.0, names=("finger",))
        self.assertEqual(self.curves.names(), ["finger/position", "finger/velocity"])

    def test_memory_is_bounded_and_a_late_reader_gets_what_is_kept(self):
        for k in range(board.MOST_FRAMES + 100):
            self.add(float(k), float(k), 0.0)
        points, _ = self.curves.since(["elbow/position"], (0, {"elbow/position": 50}))
        self.assertEqual(len(points["elbow/position"]), board.MOST_FRAMES)
        self.assertEqual(points["elbow/position"][-1][1], board.MOST_FRAMES + 99)

    def test_a_signal_that_two_topics_have_is_one(self):
        self.add(0.0, 1.0, 2.0)
        self.curves.add("signals", 0.0, ["elbow/position", "gravity/energy"], ("",), [[1.0, 3.0]])
        self.assertEqual(self.curves.names(), ["elbow/position", "elbow/velocity", "gravity/energy", "wrist/position", "wrist/velocity"])
        self.assertEqual(self.curves.since(["gravity/energy", "unknown"], None)[0], {"gravity/energy": [[0.0, 3.0]]})


    def test_a_robot_that_is_gone_is_silent(self):
        self.add(0.0, 1.0, 2.0)
        self.curves.add("signals", 0.0, ["energy"], ("",), [[3.0]])
        self.assertEqual(self.curves.silent(False), [], "its last frames are new")
        for track in self.curves._tracks.values():
            track["seen"] -= 2.0 * board.SILENCE
        self.assertEqual(self.curves.silent(True), [], "a run that is paused")
        self.assertEqual(self.curves.silent(False), ["elbow/position", "elbow/velocity", "energy", "wrist/position", "wrist/velocity"])
        self.add(0.1, 1.0, 2.0)
        self.assertEqual(self.curves.silent(True), ["energy"], "of the robot before, whose signals the one of now has not")


class PausesTest(unittest.TestCase):
    """A run that is paused: its node's diagnostics keep the time before the step, and a factor that counts the pause."""

    def setUp(self):
        self.now = 100.0
        patch = unittest.mock.patch.object(nodes.time, "monotonic", lambda: self.now)
        patch.start()
        self.addCleanup(patch.stop)
        self.nodes = nodes.Nodes.__new__(nodes.Nodes)
        self.nodes._board = board.Board()
        self.nodes.forget_pauses()

    def told(self, wait=1.0, **values):
        """What the board tells after diagnostics with these values, a moment later."""
        self.now += wait
        values = {key.replace("_", " ").replace("real time", "real-time"): value for key, value in values.items()}
        self.nodes.correct(values)
        self.nodes._board.tell("simulation", values=values)
        return values

    def answer(self, what, message):
        self.nodes.note_answer(what, message)
        return self.nodes._board.read("simulation", "values")

    def test_the_time_after_a_step_is_that_of_its_answer(self):
        self.told(time_of_the_run="0.9", waits_for="nothing", real_time_factor="1.0")
        self.assertEqual(self.answer("pause", "paused after t = 1 s")["time of the run"], "1")
        self.assertEqual(self.told(time_of_the_run="0.9", waits_for=nodes.STANDS)["time of the run"], "1")
        self.assertEqual(self.answer("step", "t = 1.25 s")["time of the run"], "1.25")
        self.assertEqual(self.told(0.01, time_of_the_run="0.9", waits_for="nothing")["time of the run"], "0.9", "on its way")
        self.assertEqual(self.told(time_of_the_run="0.9", waits_for=nodes.STANDS)["time of the run"], "1.25")
        self.answer("resume", "continues from t = 1.25 s")
        self.assertEqual(self.told(time_of_the_run="2.25", waits_for="nothing")["time of the run"], "2.25")
        self.assertEqual(self.told(time_of_the_run="2.5", waits_for=nodes.STANDS)["time of the run"], "2.5", "paused by another client")

    def test_the_real_time_factor_does_not_count_the_pause(self):
        self.assertEqual(self.told(waits_for="nothing", real_time_factor="1.0")["real-time factor"], "1.0")
        self.assertNotIn("real-time factor", self.told(waits_for=nodes.STANDS, real_time_factor="1.0"))
        self.answer("resume", "continues from t = 1.25 s")
        self.assertNotIn("real-time factor", self.told(waits_for="nothing", real_time_factor="0.02"))
        self.assertEqual(self.told(2.0, waits_for="nothing", real_time_factor="1.0")["real-time factor"], "1.0")


class TopicsTest(unittest.TestCase):
    def test_set_points_have_the_topics_of_the_node(self):
        # As in command_inbox_test.cc.
        topics = nodes.setpoint_topics(["a b", "1c", "a_b", "_servo", "\u00e9lan", "arm/servo", "~x", "a-b"])
        self.assertEqual(list(topics.values()), [f"{topic}/command" for topic in (
            "a_b", "controller_1c", "a_b_2", "controller__servo", "controller___lan", "arm/servo", "controller__x", "a_b_3")])


class RequestsTest(PanelTestCase):
    def test_the_page_loads_nothing_from_elsewhere_and_nobody_frames_it(self):
        code, headers, page = self.ask("GET", "/")
        self.assertEqual(code, 200)
        self.assertNotIn("http", page)
        self.assertNotIn("unsafe", headers["Content-Security-Policy"])
        for part in ("default-src 'none'", "connect-src 'self'", "frame-ancestors 'none'"):
            self.assertIn(part, headers["Content-Security-Policy"])

    def test_only_this_machine_can_read_it(self):
        self.assertEqual(self.server.server_address[0], "127.0.0.1")

    def test_other_hosts_are_refused(self):
        for hosts in (["evil.example"], [f"evil.example:{self.port}"], [f"localhost.evil.example:{self.port}"], [], ["localhost", "localhost"], ["[::1]:80"], [""]):
            for method, path, body in (("GET", "/", None), ("GET", "/events", None), ("GET", "/report.html", None), ("POST", "/do", b'{"do": "pause"}')):
                code, _, _ = self.ask(method, path, body, hosts, Content_Type="application/json")
                self.assertEqual(code, 403, f"{method} {path} {hosts}")
        self.assertEqual(self.nodes.asked, [])

    def test_both_names_of_this_machine_and_the_port_of_a_tunnel_are_answered(self):
        for host in (f"localhost:{self.port}", f"127.0.0.1:{self.port}", "localhost", "LocalHost:9000"):
            code, _, _ = self.ask("POST", "/do", b'{"do": "pause"}', [host], Content_Type="application/json", Origin=f"http://{host}")
            self.assertEqual(code, 200, host)
        self.assertEqual(self.nodes.asked, [("pause", {})] * 4)

    def test_foreign_origins_are_refused(self):
        for origin in ("http://evil.example", "null", f"https://localhost:{self.port}", f"http://localhost:{self.port + 1}", f"http://127.0.0.1:{self.port}", ""):
            self.assertEqual(self.post({"do": "pause"}, Origin=origin)[0], 403, origin)
            self.assertEqual(self.ask("GET", "/events", Origin=origin)[0], 403, origin)
        for site in ("cross-site", "same-site"):
            self.assertEqual(self.post({"do": "pause"}, Sec_Fetch_Site=site)[0], 403)
            self.assertEqual(self.ask("GET", "/events", Sec_Fetch_Site=site)[0], 403)
        self.assertEqual(self.ask("GET", "/", Sec_Fetch_Site="cross-site")[0], 200, "a link to the page does nothing")
        self.assertEqual(self.nodes.asked, [])

    def test_what_a_form_can_send_is_refused(self):
        for kind in ("text/plain", "application/x-www-form-urlencoded", "multipart/form-data", ""):
            code, _, _ = self.ask("POST", "/do", b'{"do": "pause"}', Content_Type=kind)
            self.assertEqual(code, 415, kind)
        for length in (str(server.MOST_BYTES + 1), "-1", "1e3", "", "9" * 5000, "\u00b2"):
            self.assertEqual(self.ask("POST", "/do", b"", Content_Type="application/json", Content_Length=length)[0], 413, length)
        for method in ("PUT", "OPTIONS", "DELETE"):
            self.assertEqual(self.ask(method, "/do")[0], 501)
        self.assertEqual(self.nodes.asked, [])

    def test_a_bad_request_is_answered_with_a_sentence(self):
        for body, sentence in ((b"{", "not JSON"), (b"[" * 60000, "not JSON"), (b"\xff", "not JSON"), (b"[]", "allowed: cancel, effort"), (b'{"do": ["pause"]}', "do: unknown"),
                               (b'{"do": "shutdown"}', "do: unknown"), (b'{"do": "pause", "x": 1}', "pause: wrong fields (value: x, needed: none)"),
                               (b'{"do": "effort", "name": "elbow"}', "needed: name, value"), (b'{"do": "effort", "name": "elbow", "value": NaN}', "finite"),
                               (b'{"do": "effort", "name": "elbow", "value": true}', "finite"), (b'{"do": "effort", "name": 3, "value": 1}', "a name needs"),
                               (b'{"do": "effort", "name": ["x"], "value": 1}', "a name needs"), (b'{"do": "effort", "name": "\\ud800", "value": 1}', "a name needs"),
                               (b'{"do": "effort", "name": "elbow", "value": 1' + 400 * b"0" + b"}", "finite"), (b'{"do": "effort", "name": "elbow", "value": 1e999}', "finite"),
                               (b'{"do": "parameters", "values": [1]}', "finite"), (b'{"do": "parameters", "values": {"length": "1"}}', "finite")):
            code, _, text = self.ask("POST", "/do", body, Content_Type="application/json")
            self.assertEqual(code, 400, body[:80])
            self.assertIn(sentence, json.loads(text)["message"])
        self.assertEqual(self.nodes.asked, [])

    def test_commands_reach_the_nodes_and_their_refusals_the_page(self):
        code, _, text = self.post({"do": "effort", "name": "elbow", "value": 2}, Origin=f"http://localhost:{self.port}", Sec_Fetch_Site="same-origin")
        self.assertEqual((code, json.loads(text)), (200, {"success": True, "message": "effort is done"}))
        _, _, text = self.post({"do": "setpoint", "name": "refused", "value": 0.5})
        self.assertEqual(json.loads(text), {"success": False, "message": "refused: no such joint"})
        self.post({"do": "parameters", "values": {"length": 0.75}})
        self.assertEqual(self.nodes.asked, [("effort", {"name": "elbow", "value": 2}), ("setpoint", {"name": "refused", "value": 0.5}),
                                            ("parameters", {"values": {"length": 0.75}})])

    def test_events_have_the_state_at_each_change_and_the_new_points(self):
        self.frame(0)
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        self.addCleanup(connection.close)
        connection.request("GET", "/events?signal=elbow/friction")
        answer = connection.getresponse()
        self.addCleanup(answer.close)
        self.assertEqual(answer.headers["Content-Type"], "text/event-stream")

        def event():
            lines = []
            while not lines or lines[-1]:
                lines.append(answer.readline().decode().strip())
            if lines[0] == ":":  # a comment, where nothing has happened for a while
                return event()
            return lines[0].partition(": ")[2], json.loads(lines[1].partition(": ")[2]) if len(lines) > 2 else None

        kind, state = event()
        self.assertEqual((kind, state["commands"]["setpoints"], state["simulation"]["answers"]), ("state", {"servo": 0.25}, True))
        self.assertEqual(event(), ("curves", {"generation": 0, "points": {"elbow/friction": [[0.0, -1.0]]}}))
        self.frame(1)
        self.assertEqual(event()[1]["points"]["elbow/friction"][0][0], 0.1)
        self.board.tell("simulation", seen=-math.inf)
        self.assertFalse(event()[1]["simulation"]["answers"])

    def test_a_client_that_closes_the_connection_is_no_fault(self):
        """It leaves no traceback, at whatever place of an answer it goes; a fault of the program does."""
        told = io.StringIO()
        with contextlib.redirect_stderr(told):
            for error in (BrokenPipeError(), ConnectionResetError(), ConnectionAbortedError(), TimeoutError()):
                with contextlib.suppress(OSError):
                    try:
                        raise error
                    finally:
                        self.server.handle_error(None, ("127.0.0.1", 1))
            for path in ("/events", "/"):
                connection = socket.create_connection(("127.0.0.1", self.port), PATIENCE)
                # Closed at once with an RST, so that the answer has no receiver.
                connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
                connection.sendall(f"GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
                connection.close()
            self.assertEqual(self.ask("GET", "/")[0], 200)
            self.assertEqual(told.getvalue(), "")
            with contextlib.suppress(ValueError):
                try:
                    raise ValueError("a fault")
                finally:
                    self.server.handle_error(None, ("127.0.0.1", 1))
        self.assertIn("ValueError: a fault", told.getvalue())

    def test_more_signals_than_a_page_has_curves_and_other_addresses_are_refused(self):
        self.assertEqual(self.ask("GET", "/events?" + "signal=x&" * (server.MOST_CURVES + 1))[0], 400)
        for path in ("/other", "/../panel", "/do"):
            self.assertEqual(self.ask("GET", path)[0], 404)
        self.assertEqual(self.ask("GET", "http://[")[0], 400)
        self.assertEqual(self.ask("POST", "/", b"{}", Content_Type="application/json")[0], 404)

    def test_a_report_that_is_not_there_is_a_sentence(self):
        code, _, text = self.ask("GET", "/report.html")
        self.assertEqual(code, 404)
        self.assertIn("no job with a bag has ended", text)
        self.board.bag = "/nowhere/job.bag"
        code, _, text = self.ask("GET", "/report.html")
        self.assertEqual(code, 404)
        self.assertIn("/nowhere/job.bag: neither a folder nor a bag", text)


class CommandLineTest(unittest.TestCase):
    def refusal(self, *arguments):
        done = subprocess.run([PANEL, *arguments], stderr=subprocess.PIPE, text=True, check=False, timeout=PATIENCE,
                              env={"PATH": "/usr/bin:/bin", "ROS_MASTER_URI": "http://localhost:1", "ROS_ROOT": "/usr/share/ros"})
        self.assertNotEqual(done.returncode, 0)
        return done.stderr

    def test_sentences_for_what_is_wrong(self):
        self.assertIn("value: 70000, allowed: 0 to 65535", self.refusal("--port", "70000"))
        self.assertIn("not a name of a node (value: my node)", self.refusal("--simulation", "my node"))
        self.assertRegex(self.refusal("--port", "0"), "no ROS master is running|it needs ROS")
        with server.make_server(0, None, None) as taken:
            self.assertIn(f"(value: {taken.server_address[1]}, allowed: a free port", self.refusal("--port", str(taken.server_address[1])))


if __name__ == "__main__":
    unittest.main()
