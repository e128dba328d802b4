#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""watch follows the folder of a job without ROS, and its page gets every point once."""
import contextlib
import http.client
import importlib.machinery
import importlib.util
import json
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest
import urllib.error
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from patience import PATIENCE  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
WATCH = ROOT / "scripts" / "watch"
HEADER = "evaluation,iteration,status,objective,best_objective,gradient_norm,length,Kp\n"  # as older jobs have it, without the number of events


def load_script(path):
    sys.dont_write_bytecode = True
    loader = importlib.machinery.SourceFileLoader(path.name, str(path))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(path.name, loader))
    loader.exec_module(module)
    return module


SCRIPT = load_script(WATCH)


class FolderTest(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.addCleanup(self.directory.cleanup)
        self.path = pathlib.Path(self.directory.name)
        self.job = SCRIPT.Job()
        self.folder = SCRIPT.Folder(self.directory.name, self.job)

    def write(self, text, mode="a"):
        with open(self.path / "convergence.csv", mode, encoding="utf-8") as file:
            file.write(text)
        self.folder.read()

    def test_the_number_of_events_is_no_parameter(self):
        self.write(HEADER.replace("gradient_norm,", "gradient_norm,events,") + "1,0,success,4.5,4.5,0.25,7,0.5,1\n")
        shown = self.job.points(0, 0)
        self.assertEqual(shown["names"], ["length", "Kp"])
        self.assertEqual(shown["points"], [[1, 0, 4.5, 4.5, 0.25, [0.5, 1.0]]])

    def test_rows_come_as_they_are_written(self):
        self.folder.read()
        self.assertEqual(self.job.points(0, 0)["points"], [])
        self.write(HEADER)
        self.write("1,0,success,4.5,4.5,0.25,0.5,1\n2,1,assembly_fai")
        first = self.job.points(0, 0)
        self.assertEqual(first["names"], ["length", "Kp"])
        self.assertEqual(first["points"], [[1, 0, 4.5, 4.5, 0.25, [0.5, 1.0]]], "half a row is not read")
        self.write("led,,4.5,,0.75,1\n")
        then = self.job.points(first["generation"], first["next"])
        self.assertEqual((then["from"], then["next"]), (1, 2))
        self.assertEqual(then["points"], [[2, 0, None, 4.5, None, [0.75, 1.0]]], "a failed trial has no objective")
        self.assertEqual(then["done"], 2)

    def test_a_further_job_begins_anew(self):
        self.write(HEADER + "1,0,success,4,4,1,0.5,1\n2,1,success,3,3,1,0.5,1\n")
        before = self.job.points(0, 0)
        (self.path / "convergence.csv").unlink()
        self.write(HEADER + "1,0,success,9,9,1,0.5,1\n", "w")
        after = self.job.points(before["generation"], before["next"])
        self.assertNotEqual(after["generation"], before["generation"])
        self.assertEqual([point[2] for point in after["points"]], [9.0])

    def test_a_row_that_is_damaged_is_named(self):
        for row, words in (("1,0,success,4,4,1,0.5\n", "7 cells, the first line has 8"), ("x,0,success,4,4,1,0.5,1\n", "evaluation: not a number"),
                           ("1,0,success,4,4,1,0.5,1\x00\n", "Kp: not a number"), ("1,0,success,4,,1,0.5,1\n", "best_objective: not a number"),
                           ('1,0,success,4,4,1,0.5,1"x\n', "Kp: not a number"), ("\n", "0 cells")):
            (self.path / "convergence.csv").unlink(missing_ok=True)
            self.folder = SCRIPT.Folder(self.directory.name, self.job)
            self.write(HEADER + "1,0,success,4.5,4.5,0.25,0.5,1\n")
            with self.assertRaises(SCRIPT.BadTable) as caught:
                self.write(row)
            self.assertIn(f"convergence.csv:3: {words}", str(caught.exception))
        (self.path / "convergence.csv").unlink()
        with self.assertRaises(SCRIPT.BadTable) as caught:
            self.write("time,x\n")
        self.assertIn("convergence.csv:1: not the table", str(caught.exception))

    def test_of_many_points_every_second_is_kept(self):
        self.job.begin("long", "optimization", ["x"])
        for k in range(1, 10 * SCRIPT.MOST_POINTS):
            self.job.add(k, 0, k, k, 1.0, [k])
        points = self.job.points(0, 0)["points"]
        self.assertLess(len(points), SCRIPT.MOST_POINTS)
        self.assertGreater(len(points), SCRIPT.MOST_POINTS // 4)
        steps = {b[0] - a[0] for a, b in zip(points, points[1:])}
        self.assertEqual(len(steps), 1, "evenly")

    def test_what_is_repeated_is_one_point_and_what_is_no_number_is_null(self):
        self.job.begin("a", "optimization", ["x"])
        for _ in range(2):
            self.job.add(1, 0, float("nan"), "", float("inf"), [1.0])
        self.job.add(0, 0, 1.0, 1.0, 1.0, [])
        self.assertEqual(self.job.points(0, 0)["points"], [[1, 0, None, None, None, [1.0]]])


class PageTest(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.addCleanup(self.directory.cleanup)
        job = SCRIPT.Job()
        self.server = SCRIPT.make_server(0, job, SCRIPT.Folder(self.directory.name, job))
        thread = threading.Thread(target=self.server.serve_forever)
        thread.start()
        self.addCleanup(self.server.server_close)
        self.addCleanup(thread.join)
        self.addCleanup(self.server.shutdown)

    def get(self, path):
        with urllib.request.urlopen(f"http://127.0.0.1:{self.server.server_address[1]}{path}", timeout=PATIENCE) as reply:
            return reply.read().decode()

    def test_points_and_a_page_that_loads_nothing_from_elsewhere(self):
        pathlib.Path(self.directory.name, "convergence.csv").write_text(HEADER + "1,0,success,4,4,1,0.5,1\n", encoding="utf-8")
        self.assertEqual(json.loads(self.get("/points.json"))["points"], [[1, 0, 4.0, 4.0, 1.0, [0.5, 1.0]]])
        page = self.get("/")
        self.assertIn("points.json", page)
        self.assertNotIn("http", page)

    def test_what_it_does_not_know_is_refused(self):
        for path, code in (("/other", 404), ("/points.json?from=x", 400)):
            with self.assertRaises(urllib.error.HTTPError) as caught:
                self.get(path)
            self.assertEqual(caught.exception.code, code)
            caught.exception.close()

    def test_only_this_machine_can_read_it(self):
        self.assertEqual(self.server.server_address[0], "127.0.0.1")

    def code(self, path, hosts, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.server.server_address[1], timeout=PATIENCE)
        with contextlib.closing(connection):
            connection.putrequest("GET", path, skip_host=True)
            for name, value in [*(("Host", host) for host in hosts), *((name.replace("_", "-"), value) for name, value in headers.items())]:
                connection.putheader(name, value)
            connection.endheaders()
            return connection.getresponse().status

    def test_pages_of_other_sites_are_refused(self):
        """A site can give its own name the address of this machine, and then read what the page may read."""
        port = self.server.server_address[1]
        for path in ("/", "/points.json"):
            for hosts in ([], ["evil.example"], [f"evil.example:{port}"], ["localhost", "localhost"], [f"localhost.evil.example:{port}"]):
                self.assertEqual(self.code(path, hosts), 403, f"{path} {hosts}")
            for host in (f"localhost:{port}", f"127.0.0.1:{port}", "LocalHost:9000"):
                self.assertEqual(self.code(path, [host], Origin=f"http://{host}"), 200, host)
        self.assertEqual(self.code("/points.json", ["localhost"], Origin="http://evil.example"), 403)
        self.assertEqual(self.code("/points.json", ["localhost"], Sec_Fetch_Site="cross-site"), 403)
        self.assertEqual(self.code("/", ["localhost"], Sec_Fetch_Site="cross-site"), 200, "a link to the page")
        self.assertEqual(self.code("http://[", ["localhost"]), 400)


    def test_a_damaged_table_ends_it(self):
        pathlib.Path(self.directory.name, "convergence.csv").write_bytes(HEADER.encode() + b"\xff,0\n")
        with self.assertRaises(urllib.error.HTTPError) as caught:
            self.get("/points.json")
        self.assertEqual(caught.exception.code, 500)
        caught.exception.close()
        self.assertIn("convergence.csv:2: 2 cells", self.server.failure)


class BadInputTest(unittest.TestCase):
    def refusal(self, *arguments):
        reply = subprocess.run([WATCH, *arguments], stderr=subprocess.PIPE, text=True, check=False, timeout=PATIENCE)
        self.assertNotEqual(reply.returncode, 0)
        return reply.stderr

    def test_sentences_for_what_is_wrong(self):
        self.assertIn("no folder /nowhere", self.refusal("/nowhere"))
        self.assertIn("allowed: 0 to 65535", self.refusal("--port", "70000"))
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "convergence.csv").write_text(HEADER + "1,2\n", encoding="utf-8")
            done = subprocess.run([WATCH, folder, "--port", "0"], stderr=subprocess.PIPE, text=True, check=False, timeout=PATIENCE)
            self.assertEqual((done.returncode, done.stderr),
                             (2, f"watch: {folder}/convergence.csv:2: 2 cells, the first line has 8; the table is damaged\n"))
        with tempfile.TemporaryDirectory() as folder:
            job = SCRIPT.Job()
            with SCRIPT.make_server(0, job, None) as taken:
                port = str(taken.server_address[1])
                self.assertIn(f"value: {port}", self.refusal(folder, "--port", port))


if __name__ == "__main__":
    unittest.main()
