#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The page of `codesign report`, of jobs that the program runs here and of files made here. Usage: report_test.py CODESIGN"""
import contextlib
import csv
import html.parser
import json
import math
import os
import re
import resource
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
sys.path.insert(0, os.path.join(ROOT, "test"))
from codesign_report import geometry, numbers, words  # noqa: E402
from patience import PATIENCE  # noqa: E402

PENDULUM = """<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign">
<codesign:parameter name="length" value="0.5" lower="0.3" upper="0.8" unit="m"/>
<codesign:parameter name="grip" value="0.2" lower="0" upper="1" unit="N m"/>
<link name="ground"/>
<link name="bob"><inertial><origin xyz="0 0 -0.5" codesign:xyz="0 0 ${-length}"/><mass value="1"/>
<inertia ixx="0.002" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.002"/></inertial>
<visual><origin xyz="0 0 -0.5" codesign:xyz="0 0 ${-length}"/><geometry><sphere radius="0.05"/></geometry></visual></link>
<joint name="hinge" type="continuous"><parent link="ground"/><child link="bob"/><axis xyz="0 1 0"/>
<limit effort="0.5" velocity="0.5"/><dynamics friction="0.2" codesign:friction="${grip}"/></joint></robot>"""
STUDY = """duration: 0.5
initial_state: {hinge: {position: 0.5}}
controllers: {hold: {type: pid, input: hinge/position, setpoint: 0.0, output: hinge, gains: {p: "${Kp}"}}}
parameters: {length: {tune: true}, Kp: {initial: 1.0, lower: 0.0, upper: 5.0}}
objective: {integral: [{signal: hinge/velocity, reference: -1.0}]}
hardware: {hold: {namespace: hinge_controller/pid}}
optimizer: {algorithm: slsqp, max_evaluations: 60}
"""
ENSEMBLE = """uncertain: {grip: {uniform: [0.1, 0.3]}}
robust: {measure: worst, samples: 8, validate: 4}
multistart: {starts: 3, screen: 6}
"""
PROGRAM = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else "codesign"
VOID = {"meta", "link", "br", "hr", "img", "input"}


class Page(html.parser.HTMLParser):
    """Checks that elements are closed in order, and collects what tests look at."""

    def __init__(self, text):
        super().__init__()
        self.open, self.faults, self.data, self.ids, self.links, self.tags, self.text = [], [], [], [], [], [], ""
        self.seen = []  # the tags that are not folded away
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.tags.append((tag, attributes))
        if "details" not in self.open:
            self.seen.append(tag)
        if "id" in attributes:
            self.ids.append(attributes["id"])
        self.links += [attributes[key] for key in ("href", "src", "data", "action") if key in attributes]
        if tag == "data":
            self.data.append([attributes["value"], ""])
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append((tag, self.getpos()))

    def handle_data(self, data):
        if "script" in self.open or "style" in self.open:
            return
        self.text += data
        if self.open and self.open[-1] == "data":
            self.data[-1][1] += data


def values_in(value):
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [v for item in value for v in values_in(item)]
    return [float(value)] if isinstance(value, (int, float)) and not isinstance(value, bool) else []


def numbers_in(folder):
    """All numbers of the JSON files and tables of a folder."""
    found = set()
    for name in os.listdir(folder):
        path = os.path.join(folder, name)
        if name.endswith(".json"):
            with open(path, encoding="utf-8") as file:
                found |= set(values_in(json.load(file)))
        elif name.endswith(".csv"):
            with open(path, newline="", encoding="utf-8") as file:
                found |= {float(cell) for row in csv.reader(file) for cell in row if re.fullmatch(r"[-+.0-9e]+", cell)}
    return found


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False, **options)


def read(path):
    with open(path, "rb") as file:
        return file.read()


def processor_time_of_children():
    """Seconds, which other load hardly changes."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.pages = {}
        for name, text in (("arm.urdf", PENDULUM), ("arm.yaml", STUDY), ("many.yaml", STUDY + ENSEMBLE)):
            with open(cls.path(name), "w", encoding="utf-8") as file:
                file.write(text)
        for study, job in (("arm.yaml", "job"), ("many.yaml", "many")):
            done = run("optimize", cls.path("arm.urdf"), cls.path(study), "--output", cls.path(job))
            if done.returncode != 0:
                raise RuntimeError(done.stderr)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    @classmethod
    def path(cls, *names):
        return os.path.join(cls.scratch.name, *names)

    def page_of(self, job):
        """The page of a job, made once, as most tests look at the same two."""
        if job not in self.pages:
            self.pages[job] = self.made_page(job)
        return self.pages[job]

    def made_page(self, job):
        """The page, made by the program as a user makes it, and checked for what holds for all pages."""
        before = processor_time_of_children()
        done = run("report", self.path(job), "-o", self.path("page.html"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(processor_time_of_children() - before, 5.0)
        self.assertEqual(done.stdout + done.stderr, "")
        with open(self.path("page.html"), encoding="utf-8") as file:
            text = file.read()
        self.assertLess(len(text.encode()), 2_000_000)
        page = Page(text)
        self.assertEqual(page.faults, [])
        self.assertEqual(page.open, [])
        self.assertEqual(len(page.ids), len(set(page.ids)))
        self.assertEqual([link for link in page.links if not (link.startswith("#") and link[1:] in page.ids)], [], "a page needs no network")
        self.assertNotIn("@import", text)
        self.assertNotIn("url(", text)
        for tag, attributes in page.tags:
            if tag == "svg":
                is_described = attributes.get("role") == "img" and attributes.get("aria-label")
                self.assertTrue(attributes.get("aria-hidden") == "true" or is_described, attributes)
            if tag == "th":
                self.assertIn(attributes.get("scope"), ("row", "col"))
        return text, page

    def check_numbers(self, job, page):
        known = numbers_in(self.path(job))
        self.assertGreater(len(page.data), 40)
        for value, shown in page.data:
            self.assertIn(float(value), known, f"{value} is in no file of the job")
            rounded = float(shown.replace(numbers.MINUS, "-"))
            self.assertLessEqual(abs(rounded - float(value)), 0.006 * abs(float(value)), f"{value} is shown as {shown}")

    def test_every_number_is_one_of_the_job(self):
        for job in ("job", "many"):
            _, page = self.page_of(job)
            self.check_numbers(job, page)

    def test_what_a_reader_looks_for(self):
        text, page = self.page_of("job")
        with open(self.path("job", "result.json"), encoding="utf-8") as file:
            result = json.load(file)
        for value in (result["objective"], result["initial_objective"], *result["parameters"].values(), *result["gradient"].values()):
            self.assertIn(repr(value), [value for value, _ in page.data])
        self.assertIn(words.termination(result["termination"]), page.text)
        self.assertIn("hinge_controller", page.text)
        self.assertIn("on lower bound", page.text)
        self.assertIn("exceeds its velocity limit", page.text)
        for section in ("asked", "result", "mechanism", "convergence", "friction", "signals", "peaks", "trust", "repeat"):
            self.assertIn(section, page.ids)
        embedded = re.search(r'<script type="application/json" id="result-json">(.*?)</script>', text, re.DOTALL).group(1)
        self.assertEqual(json.loads(embedded), result)

    def test_events_are_ticks_and_rows(self):
        with open(self.path("switched.yaml"), "w", encoding="utf-8") as file:
            file.write(STUDY + 'loads: [{joint: hinge, effort: "${t < 0.2 ? 0 : 0.01}"}, {joint: hinge, effort: "${0.001*floor(10*t)}"}]\n')
        done = run("optimize", self.path("arm.urdf"), self.path("switched.yaml"), "--output", self.path("switched"))
        self.assertEqual(done.returncode, 0, done.stderr)
        text, page = self.made_page("switched")
        self.check_numbers("switched", page)
        marks = [attributes for tag, attributes in page.tags if tag == "path" and attributes.get("class") in ("tuned mark", "initial mark")]
        self.assertGreater(len(marks), 0)
        self.assertEqual(len(marks), 2 * text.count(">time [s]</text>"), "both designs in each chart over the time")
        self.assertEqual({attributes["d"].count("M") for attributes in marks}, {4}, "0.1, 0.2 (of both loads), 0.3 and 0.4 s")
        self.assertIn("t < 0.2", page.text)
        self.assertIn("Events per run", page.text)
        self.assertNotIn(" mark\"", self.page_of("job")[0])

    def test_the_commands_of_the_page_repeat_the_job(self):
        _, page = self.page_of("job")
        command = next(line for line in page.text.splitlines() if "gradient tuned.urdf" in line)
        command = command.replace("codesign gradient", f"{PROGRAM} gradient")
        done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=True)
        with open(self.path("job", "result.json"), encoding="utf-8") as file:
            objective = json.load(file)["objective"]
        self.assertLessEqual(abs(json.loads(done.stdout)["objective"] - objective), 1e-12 * objective)

    def test_the_commands_name_the_folder_wherever_the_page_was_made(self):
        done = run("report", "job", "-o", "relative.html", cwd=self.path())
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("relative.html"), encoding="utf-8") as file:
            commands = re.findall(r"<pre>(cd [^<]*?) &amp;&amp;", file.read())
        self.assertEqual(set(commands), {"cd " + os.path.realpath(self.path("job"))})

    def test_parameters_that_are_tuned_come_first(self):
        text, _ = self.page_of("job")
        rows = re.findall(r'<tr><th scope="row">(length|grip|Kp)</th>', text)
        self.assertEqual(rows[:3], ["length", "Kp", "grip"])

    def test_each_cell_has_the_name_of_its_column_for_narrow_pages(self):
        text, _ = self.page_of("job")
        tables = [table for table in re.findall(r"<table>.*?</table>", text, flags=re.DOTALL) if "<td" in table]
        self.assertGreater(len(tables), 4)
        for table in tables:
            heads = re.findall(r'<th scope="col"[^>]*>(.*?)</th>', table)
            for row in re.findall(r'<tr><th scope="row">.*?</tr>', table, flags=re.DOTALL):
                self.assertEqual(re.findall(r'<td[^>]* data-label="([^"]*)"', row), heads[1:])

    def test_starts_and_samples(self):
        _, page = self.page_of("many")
        self.assertIn("starts", page.ids)
        self.assertIn("samples", page.ids)
        self.assertIn("Objective over grip", page.text)
        self.assertIn("fresh samples", page.text)
        self.assertIn("{samples: 8", page.text.replace("measure: worst, ", ""))

    def test_an_identification(self):
        folder = self.path("fit")
        os.makedirs(folder)
        fit = {"version": "1", "termination": "success", "evaluations": 5, "failed_evaluations": 0, "iterations": 4, "cpu_seconds": 0.5,
               "identified": {"mu": {"value": 0.125, "start": 0.25, "unit": "", "determined": True, "on_bound": False, "deviation": 0.03125,
                                     "interval": [0.0625, 0.1875]},
                              "<b>": {"value": 2.5, "start": 2.25, "unit": "kg", "determined": False, "on_bound": False, "deviation": None,
                                      "interval": [None, None]}},
               "undetermined": ["mass & inertia appear only as a sum"], "level": 0.95, "noise": "correlated", "names": ["mu", "<b>"],
               "correlation": [[1.0, None], [None, None]], "warnings": [],
               "data": {"samples": 3, "joints": {"hinge": {"recorded_rms": 3.5, "start_rms": 1.5, "rms": 0.75, "worst": 1.25,
                                                           "whiteness": {"probability": 0.5}}}}}
        with open(os.path.join(folder, "identification.json"), "w", encoding="utf-8") as file:
            json.dump(fit, file)
        with open(os.path.join(folder, "residuals.csv"), "w", encoding="utf-8") as file:
            file.write("set,recording,time,hinge/recorded,hinge/computed\ndata,1,0,1,1.5\ndata,1,0.1,2,1.75\nholdout,1,0,3,2.5\n")
        _, page = self.made_page("fit")
        self.assertNotIn("asked", page.ids)
        with open(os.path.join(folder, "job_study.yaml"), "w", encoding="utf-8") as file:
            file.write("identify:\n  data: [{csv: bench.csv}, {csv: more.csv, to: 4.5}]\n  residual: motion\n  segment: 0.75\n"
                       "parameters: {mu: {upper: 0.5}}\n")
        text, page = self.made_page("fit")
        self.assertIn("asked", page.ids)
        for words in ("data[1]", "{csv: more.csv, to: 4.5}", "residual", "0.75", "{mu: {upper: 0.5}}", "Fit the model to these recordings",
                      "codesign simulate identified.urdf job_study.yaml"):
            self.assertIn(words, page.text)
        self.assertIn("mass & inertia appear only as a sum", page.text)
        self.assertIn("&lt;b&gt;", text)
        self.assertNotIn("<b>", text.split("result-json")[0])
        self.assertIn("the data do not tell it", page.text)
        self.assertIn("hinge, holdout recording 1", page.text)
        self.assertIn("0.0625", [value for value, _ in page.data])
        # The optimization node writes the same files beside its bag.
        bag = self.path("arm_1.bag")
        for name in ("identification.json", "residuals.csv", "job_study.yaml"):
            shutil.copy(os.path.join(folder, name), self.path("arm_1." + name))
        with open(bag, "wb"):
            pass
        _, of_node = self.made_page("arm_1.bag")
        self.assertIn("hinge, holdout recording 1", of_node.text)
        self.assertIn("codesign simulate arm_1.identified.urdf arm_1.job_study.yaml --result arm_1.identification.json", of_node.text)
        self.assertIn(f"replay.launch bag:={bag}", of_node.text)

    def test_a_large_job_stays_small(self):
        folder = self.path("large")
        os.makedirs(folder)
        signals = [f"joint_{k}/velocity" for k in range(600)]
        with open(os.path.join(folder, "result.json"), "w", encoding="utf-8") as file:
            json.dump({"objective": 1.0, "gradient": {}, "termination": "success", "evaluations": 1}, file)
        for side in ("initial", "tuned"):
            with open(os.path.join(folder, side + ".csv"), "w", encoding="utf-8") as file:
                file.write(",".join(["time", *signals]) + "\n")
                for row in range(501):
                    file.write(",".join(f"{math.sin(0.1 * row * (k + 1)):.17g}" if k else str(row) for k in range(601)) + "\n")
        self.made_page("large")

    def test_what_decides_is_seen_and_the_rest_is_folded(self):
        """A robot of thirty joints, of which the objective reads one: its curve, and none of the others, is seen at once."""
        folder = self.path("folded")
        os.makedirs(folder)
        names = [f"joint_{k}/{quantity}" for k in range(30) for quantity in ("position", "velocity")]
        stop = {"joint": "joint_7", "number": "stop width", "unit": "rad"}
        files = {"result.json": json.dumps({"objective": 1.0, "gradient": {"g1": 0.0}, "termination": "success", "evaluations": 1,
                                            "warnings": [{"code": "a_code", "message": "a doubt"}]}),
                 "details.json": json.dumps({"parameters": [{"name": f"g{k}", "initial": 1.0, "value": 2.0, "lower": 0.0, "upper": 3.0, "unit": "", "tuned": k < 2}
                                                            for k in range(40)],
                                             "initial": {"machine_numbers": [{**stop, "value": 0.0123}]},
                                             "tuned": {"machine_numbers": [{**stop, "value": 0.0456}]}}),
                 "job_study.yaml": "duration: 1\nobjective: {terminal: [{signal: joint_7/position}]}\n",
                 "tuned.csv": ",".join(["time", *names]) + "\n" + "".join(",".join([str(t), *("1.5" for _ in names)]) + "\n" for t in (0, 1))}
        for name, text in files.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        text, page = self.made_page("folded")
        self.assertEqual(page.seen.count("figure"), 1)
        self.assertEqual([tag for tag, _ in page.tags].count("figure"), 60)
        self.assertEqual(text.count("<details>"), page.seen.count("details"), "nothing is folded twice")
        self.assertIn("38 parameters that were not tuned", page.text)
        self.assertIn("Numbers that follow the machine: 1", page.text)
        for value in ("0.0123", "0.0456"):
            self.assertIn([value, value], page.data)
            self.assertLess(text.index("stop width"), text.index(value))
        self.assertLess(page.seen.count("tr"), 12)
        self.assertLess(text.index("a doubt"), text.index('aria-label="Tuned parameters"'), "doubts come first")

    def test_links_without_shapes_are_the_sticks_of_viewers(self):
        """In every shipped model: what `codesign urdf --sticks` gives rviz, apart from sticks to springs, of which rviz has none."""
        models = [os.path.join(ROOT, "urdf", name) for name in sorted(os.listdir(os.path.join(ROOT, "urdf"))) if name.endswith(".urdf")]
        compared = 0
        for model in models:
            plain, sticks = (run("urdf", model, *options) for options in ((), ("--sticks",)))
            self.assertEqual(plain.returncode + sticks.returncode, 0, plain.stderr + sticks.stderr)
            ours, theirs = geometry.Robot(plain.stdout), geometry.Robot(sticks.stdout)
            springs = set(re.findall(r'link="([^"]*)"', "".join(re.findall(r"<codesign:spring_damper.*?</codesign:spring_damper>", plain.stdout, re.DOTALL))))
            for name in set(ours.solids) - springs:
                pairs = [[sorted(point for solid in robot.solids[name] for point in solid.points)] for robot in (ours, theirs)]
                self.assertEqual(*map(len, pairs[0] + pairs[1]), f"{model}: {name}")
                compared += any(solid.is_stick for solid in ours.solids[name])
                for one, other in zip(pairs[0][0], pairs[1][0]):
                    self.assertLess(math.dist(one, other), 1e-6, f"{model}: {name}")
        self.assertGreaterEqual(compared, 10)

    def test_a_study_of_postures(self):
        """Its page speaks of postures, shows the path and where it should be, and nothing that is zero."""
        case = [os.path.join(ROOT, folder, "four_bar_path" + end) for folder, end in (("urdf", ".urdf"), ("config", ".yaml"))]
        done = run("optimize", *case, "--quiet", "--output", self.path("postures"))
        self.assertEqual(done.returncode, 0, done.stderr)
        text, page = self.made_page("postures")
        for words in ("18 postures, given by the position of crank_joint", "Minimize the sum of these terms", "sum over the postures of weight",
                      "[0.5, 0.4, 0.3, 0.2,", "the path of pen", "the tuned postures as a table"):
            self.assertIn(words, page.text)
        for words in ("time [s]", "at [s]", "Runs of", "over the run", "energy balance"):
            self.assertNotIn(words, text.split("result-json")[0], words)
        self.assertEqual(text.count(">posture</text>"), 4, "position of two joints, and two coordinates of the pen")
        pictures = re.findall(r'<g class="mechanism">.*?</g>', text, re.DOTALL)
        for picture in pictures:
            (path,) = re.findall(r'<path class="trace" d="([^"]*)"', picture)
            self.assertEqual(len(re.findall("[ML]", path)), 18)
            self.assertEqual(picture.count('class="target mark"'), 18)
        (after,) = re.findall(r'<path class="trace" d="([^"]*)"', pictures[1])
        wanted = re.findall(r'<path class="target mark" d="M([0-9.]+) ([0-9.]+)', pictures[1])
        for (x, y), (wanted_x, wanted_y) in zip(re.findall(r"[ML]([0-9.]+) ([0-9.]+)", after), wanted):
            self.assertLess(abs(float(x) - float(wanted_x) - 4.0) + abs(float(y) - float(wanted_y)), 8.0, "the tuned path passes the crosses")
        self.assertIn("Zero throughout, and not drawn: crank_joint/velocity", page.text)
        self.assertNotRegex(text, "<figcaption>mechanism/")

    def page_of_efforts(self, name, study):
        for suffix, text in ((".urdf", PENDULUM), (".yaml", study)):
            with open(self.path(name + suffix), "w", encoding="utf-8") as file:
                file.write(text)
        done = run("efforts", self.path(name + ".urdf"), self.path(name + ".yaml"), "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path(name + ".json"), "w", encoding="utf-8") as file:
            file.write(done.stdout)
        shown = run("report", self.path(name + ".json"), "-o", self.path(name + ".html"))
        self.assertEqual(shown.returncode, 0, shown.stderr)
        page = Page(read(self.path(name + ".html")).decode())
        self.assertEqual(page.faults + page.open, [])
        return page, json.loads(done.stdout)

    def test_efforts_are_curves_along_a_motion_and_maps_over_postures(self):
        page, efforts = self.page_of_efforts("along", STUDY)
        self.assertIn(numbers.short(efforts["joints"]["hinge"]["effort"]["value"], 6), page.text)
        self.assertEqual([tag for tag, _ in page.tags].count("figure"), 3, "effort, velocity, friction")
        page, efforts = self.page_of_efforts("over", "duration: 1\nefforts: {grid: {hinge: {from: -1, to: 1, count: 21}}}\n")
        self.assertIn("Statics in 21 postures of hinge", page.text)
        self.assertEqual([tag for tag, _ in page.tags].count("figure"), 1)
        # A map has a cell for each posture.
        efforts["series"] = {"hinge/position": [0.0, 0.0, 1.0, 1.0], "slide/position": [0.0, 2.0, 0.0, 2.0], "hinge/effort": [1.0, -2.0, 4.0, None],
                             "hinge/holding": [0.0, 0.0, 0.0, None]}
        efforts["joints"]["slide"] = efforts["joints"]["hinge"]
        with open(self.path("map.json"), "w", encoding="utf-8") as file:
            json.dump(efforts, file)
        self.assertEqual(run("report", self.path("map.json"), "-o", self.path("map.html")).returncode, 0)
        cells = re.findall(r'<rect class="cell (\w+)" fill-opacity="([0-9.]+)"[^>]*><title>([^<]*)<', read(self.path("map.html")).decode())
        self.assertEqual(cells[:4], [("plus", "0.250", "hinge 0, slide 0: 1"), ("plus", "1.000", "hinge 1, slide 0: 4"),
                                     ("minus", "0.500", "hinge 0, slide 2: \u22122"), ("unknown", "0.150", "hinge 1, slide 2: not known")])

    def test_what_is_refused(self):
        os.makedirs(self.path("empty"))
        with open(self.path("alone.bag"), "w", encoding="utf-8") as file:
            file.write("")
        os.makedirs(self.path("broken"))
        with open(self.path("broken", "result.json"), "w", encoding="utf-8") as file:
            file.write("{")
        for job, sentence in (("lost", "neither a folder nor a bag"), ("empty", "no result.json"), ("alone.bag", "is not beside the bag"),
                              ("broken", "not JSON")):
            done = run("report", self.path(job))
            self.assertEqual(done.returncode, 2, job)
            self.assertIn(sentence, done.stderr)
        done = run("report", self.path("job", "result.json"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("no output of codesign efforts --json", done.stderr)
        done = run("report", self.path("job"), "-o", self.path("no", "such", "folder.html"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot be written", done.stderr)
        self.assertEqual(run("report").returncode, 2)
        self.assertIn("DIR|BAG", run("report", "--help").stdout)

    def test_a_page_replaces_no_file_of_its_job(self):
        os.symlink(self.path("job", "tuned.urdf"), self.path("link"))
        names = [self.path("job", name) for name in ("result.json", "tuned.urdf", "convergence.csv", "journal.jsonl")]
        for output in names + [self.path("link")]:
            before = read(output)
            done = run("report", self.path("job"), "-o", output)
            self.assertEqual(done.returncode, 2, output)
            self.assertIn(f"{output}: the page would replace this file of the job", done.stderr)
            self.assertEqual(read(output), before)
        for _ in range(2):
            self.assertEqual(run("report", self.path("job"), "-o", self.path("job", "report.html")).returncode, 0, "a page replaces an earlier page")
        os.remove(self.path("job", "report.html"))

    def test_devices_and_links_stay_and_nothing_begun_remains(self):
        """As root a device that was replaced is lost to the whole machine, so that all of it happens in a folder of its own."""
        folder = self.path("outputs")
        os.makedirs(folder)
        fifo, link, leads_to, device, page = (os.path.join(folder, name) for name in ("fifo", "link", "leads_to", "device", "page.html"))
        os.mkfifo(fifo)
        reader = subprocess.Popen(["cat", fifo], stdout=subprocess.PIPE)
        self.assertEqual(run("report", self.path("job"), "-o", fifo).returncode, 0)
        self.assertIn(b"</html>", reader.communicate(timeout=PATIENCE)[0])
        self.assertTrue(stat.S_ISFIFO(os.lstat(fifo).st_mode))
        os.symlink(leads_to, link)
        for before in (None, "of before"):
            if before:
                with open(leads_to, "w", encoding="utf-8") as file:
                    file.write(before)
                os.chmod(leads_to, 0o640)
            self.assertEqual(run("report", self.path("job"), "-o", link).returncode, 0)
            self.assertIn(b"</html>", read(leads_to))
            self.assertTrue(os.path.islink(link))
        self.assertEqual(stat.S_IMODE(os.stat(leads_to).st_mode), 0o640)
        with contextlib.suppress(PermissionError):  # only root makes devices, and not in every container
            os.mknod(device, 0o666 | stat.S_IFCHR, os.makedev(1, 3))  # as /dev/null
            run("report", self.path("job"), "-o", device)
            self.assertTrue(stat.S_ISCHR(os.lstat(device).st_mode))
            os.remove(device)
        self.assertIn("</html>", run("report", self.path("job"), "-o", "/dev/stdout").stdout)
        done = run("report", self.path("job"), "-o", folder)
        self.assertEqual((done.returncode, done.stderr), (1, f"codesign report: {folder}: cannot be written: Is a directory\n"))
        # A disk that is full after 2000 bytes: the page of before stays, and no part of the new one.
        with open(page, "w", encoding="utf-8") as file:
            file.write("of before")
        names = sorted(os.listdir(folder))
        done = run("report", self.path("job"), "-o", page, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000)))
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"codesign report: {page}: cannot be written: ", done.stderr)
        self.assertEqual((read(page), sorted(os.listdir(folder))), (b"of before", names))

    def test_damaged_files_are_named(self):
        shutil.copytree(self.path("job"), self.path("damaged"))
        whole = {name: read(self.path("damaged", name)) for name in ("tuned.urdf", "tuned.csv", "details.json", "result.json")}
        lines = whole["tuned.csv"].splitlines(keepends=True)
        cases = {"tuned.urdf": ((whole["tuned.urdf"][:300], "tuned.urdf:"), (b"", "tuned.urdf:1:"),
                                (b"<robot name='a'><joint name='b'/></robot>", "tuned.urdf: not a model in URDF")),
                 "tuned.csv": ((b"".join(lines[:3]) + lines[3][:20] + b"\n", "tuned.csv:4: "), (b"".join(lines[:3]) + b"\xff\n", "tuned.csv:4: "),
                               (lines[0] + b"1" * 200000, "tuned.csv:2: not a table")),
                 "details.json": ((b"[" * 100000, "details.json: not JSON"), (b'{"tuned": 3, "parameters": 4}', "a file of this job is damaged")),
                 "result.json": ((whole["result.json"][:50], "not JSON from column "), (b'{"a": 1,\n "b" 2}', "result.json:2: not JSON from column 6 on"), (b'{"objective": "x", "gradient": 1}', "is damaged"))}
        for name, damages in cases.items():
            for content, words in damages:
                with open(self.path("damaged", name), "wb") as file:
                    file.write(content)
                done = run("report", self.path("damaged"), "-o", self.path("damaged.html"))
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(words, done.stderr)
                self.assertNotRegex(done.stderr, r"Traceback|Error|Errno|Expecting|codec|: line \d+, column", "in words of its own")
            with open(self.path("damaged", name), "wb") as file:
                file.write(whole[name])

    def test_a_folder_need_not_be_utf_8(self):
        folder = os.path.join(os.fsencode(self.path("folders")), b"gr\xfc\xdfe")
        shutil.copytree(self.path("job"), os.fsdecode(folder))
        done = run("report", os.fsdecode(folder), "-o", os.path.join(os.fsdecode(folder), "page.html"))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page = read(os.path.join(folder, b"page.html")).decode("utf-8")
        self.assertIn(r"/gr\xfc\xdfe", html.unescape(page), "a word that bash takes for these bytes")
        missing = subprocess.run([PROGRAM, "report", os.path.join(folder, b"none")], capture_output=True, check=False)
        self.assertEqual(missing.returncode, 2)
        self.assertIn(b"gr\xfc\xdfe/none: neither a folder", missing.stderr)

    def test_every_termination_has_words(self):
        sources = ("optimization/algorithm.cc", "optimization/levenberg_marquardt.cc", "identification/fit/residual_fit.cc")
        found = set()
        for source in sources:
            with open(os.path.join(ROOT, "src", source), encoding="utf-8") as file:
                found |= set(re.findall(r'return "([a-z_]+)";', file.read()))
        self.assertIn("objective_tolerance_reached", found)
        self.assertEqual(found - set(words.TERMINATIONS), set())
        self.assertIn("moon phase", words.termination("moon_phase"))

    def test_how_stationary_the_point_is(self):
        result = {"termination": "success", "stationarity": 3e-6, "slope": 1e-6, "initial_slope": 10.0}
        self.assertEqual(words.stationarity(result), "Stationary to 3e-06.")
        result.update(termination="stopped_early", slope=4.0, stationarity=0.5)
        self.assertEqual(words.stationarity(result), "Stopped early: the slope is 0.4 of the start's, stationary to 0.5 only.")
        self.assertEqual(words.stationarity({}), "", "of an older result")
        self.assertIn("stopped_early", words.TERMINATIONS)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
