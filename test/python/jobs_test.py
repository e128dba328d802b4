#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Optimizations and identifications from Python: the results of the command line, progress, cancelling, threads, files."""
import concurrent.futures
import os
import tempfile
import threading
import unittest

import numpy as np

from fixture import ARM, Asked, FIT, FREE, LONG, PENDULUM, SWING, command_line, recorded

import mechanism_codesign as codesign


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.model, self.study = self.written("model.urdf", PENDULUM), self.written("study.yaml", SWING)

    def path(self, name):
        return os.path.join(self.folder, name)

    def written(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)


class Optimization(Files):
    def test_it_is_that_of_the_command_line(self):
        trials, line = [], command_line("optimize", self.model, self.study, "--output", self.path("line"))
        result = codesign.Problem(self.model, self.study).optimize(progress=trials.append)
        self.assertTrue(result.status.ok)
        same = set(line) - {"cpu_seconds", "setup_seconds"}
        for record in (result.record, line):
            record.get("differences", {}).pop("cpu_seconds", None)
        self.assertEqual({key: result.record[key] for key in same}, {key: line[key] for key in same})
        self.assertEqual((result.rho.tolist(), result.objective), ([line["parameters"]["length"]], line["objective"]))
        searched = [trial for trial in trials if isinstance(trial, codesign.Trial)]
        self.assertEqual([trial.evaluation for trial in searched], list(range(1, line["evaluations"] + 1)))
        self.assertEqual(str(searched[0])[:18], "trial 1: objective")
        self.assertEqual(searched[0].parameters, {"length": 0.5})
        self.assertEqual(result.best_objectives.tolist(), [trial.best_objective for trial in searched])

    def test_it_writes_the_files_of_the_command_line(self):
        command_line("optimize", self.model, self.study, "--output", self.path("line"))
        result = codesign.Problem(self.model, self.study).optimize()
        result.write(self.path("new/job"))
        names = set(os.listdir(self.path("line"))) - {"journal.jsonl"}
        self.assertEqual(set(os.listdir(self.path("new/job"))), names)
        for name in names - {"result.json", "details.json"}:
            self.assertEqual(self.text(f"new/job/{name}"), self.text(f"line/{name}"), name)
        again = command_line("gradient", self.path("new/job/tuned.urdf"), self.path("new/job/job_study.yaml"), "--result", self.path("new/job/result.json"))
        self.assertAlmostEqual(again["objective"], result.objective, delta=1e-12)
        page = result.report(self.path("page.html"))
        self.assertIn("pendulum", page)
        self.assertEqual(self.text("page.html"), page)
        result = codesign.Problem(PENDULUM, SWING).optimize()
        self.assertIn("<svg", result.report())
        self.assertIn(f"{result.termination} after {result.record['iterations']} iterations", str(result))
        self.assertIn("stationary to ", str(result))

    def text(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def test_it_replaces_no_file_that_is_read(self):
        self.model = self.written("tuned.urdf", PENDULUM)
        result = codesign.Problem(self.model, self.study).optimize()
        with self.assertRaisesRegex(codesign.InputError, "would replace this file"):
            result.write(self.folder)
        self.assertEqual(self.text("tuned.urdf"), PENDULUM)
        with self.assertRaises(codesign.InputError):
            result.write(self.model)
        with self.assertRaisesRegex(codesign.OutputError, "cannot be written"):
            result.report(self.path("nowhere/page.html"))

    def test_a_start_that_cannot_be_evaluated_is_a_status(self):
        result = codesign.Problem(PENDULUM, SWING + "solver: {maximum_steps: 20}\n").optimize()
        self.assertEqual(result.status.code, "too_many_steps")
        self.assertIsNone(result.objective)
        with self.assertRaises(codesign.ComputationError):
            result.write(self.path("job"))
        self.assertFalse(os.path.exists(self.path("job")))

    def test_an_event_ends_it_with_the_best_point(self):
        event = Asked()

        def progress(trial):
            if isinstance(trial, codesign.Trial) and trial.evaluation == 3:
                event.set_and_seen()

        result = codesign.Problem(PENDULUM, SWING).optimize(progress, event)
        self.assertEqual((result.status.code, result.termination), ("cancelled", "cancelled"))
        self.assertLess(result.objective, result.initial_objective)
        with self.assertRaisesRegex(TypeError, "is_set"):
            codesign.Problem(PENDULUM, SWING).optimize(cancel=True)

    def test_an_event_ends_a_long_evaluation(self):
        event = threading.Event()
        timer = threading.Timer(0.3, event.set)
        timer.start()
        self.addCleanup(timer.join)
        self.assertEqual(codesign.Problem(FREE, LONG).optimize(cancel=event).status.code, "cancelled")

    def test_an_exception_of_progress_ends_it(self):
        for study in (SWING, SWING + "multistart: {starts: 4}\nengine: {type: threads, workers: 2}\n"):
            calls = []

            def progress(trial, calls=calls):
                calls.append(trial)
                raise ZeroDivisionError("mine")

            with self.assertRaisesRegex(ZeroDivisionError, "mine"):
                codesign.Problem(PENDULUM, study).optimize(progress)
            self.assertGreater(len(calls), 0)

    def test_an_event_that_cannot_be_asked_ends_it_with_its_exception(self):
        class Event:
            answer = "no"

            def is_set(self):
                return self.answer

        event = Event()
        problem = codesign.Problem(FREE, LONG)
        self.assertEqual(problem.optimize(cancel=event).status.code, "cancelled", "a string is true")
        event.answer = np.array([0, 1])
        with self.assertRaisesRegex(ValueError, "ambiguous"):
            problem.optimize(cancel=event)

        def fail():
            raise ZeroDivisionError("mine")

        event.is_set = fail
        with self.assertRaisesRegex(ZeroDivisionError, "mine"):
            problem.optimize(cancel=event)

    def test_a_search_inside_progress_ends_alone(self):
        problem, ends = codesign.Problem(PENDULUM, SWING), []

        def fail(trial):
            raise ZeroDivisionError("mine")

        def progress(trial):
            event = Asked()
            ends.append(problem.optimize(lambda trial: event.set_and_seen(), event).status.code)
            try:
                problem.optimize(fail)
            except ZeroDivisionError as error:
                ends.append(str(error))

        self.assertEqual(problem.optimize(progress).status.code, problem.optimize().status.code)
        self.assertEqual(set(ends), {"cancelled", "mine"})

    def test_nothing_to_tune(self):
        with self.assertRaisesRegex(codesign.InputError, "tune"):
            codesign.Problem(PENDULUM, SWING.replace("parameters: {length: {}}\n", "")).optimize()


class Threads(unittest.TestCase):
    def test_problems_and_one_problem_in_threads(self):
        designs = np.linspace(0.35, 0.75, 24)
        problem = codesign.Problem(PENDULUM, SWING)
        expected = [(value, gradient.tolist()) for value, gradient in (problem.gradient([x]) for x in designs)]
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            shared = list(pool.map(lambda x: problem.gradient([x]), designs))
            own = list(pool.map(lambda x: codesign.Problem(PENDULUM, SWING).gradient([x]), designs[:8]))
        self.assertEqual([(value, gradient.tolist()) for value, gradient in shared], expected)
        self.assertEqual([(value, gradient.tolist()) for value, gradient in own], expected[:8])

    def test_other_threads_go_on(self):
        """The lock of Python is free while the library computes."""
        event, counted = threading.Event(), []

        def count():
            while not event.is_set():
                counted.append(len(counted))
                if len(counted) == 1000:
                    event.set()  # which ends the search
                os.sched_yield()

        thread = threading.Thread(target=count)
        thread.start()
        self.assertEqual(codesign.Problem(FREE, LONG).optimize(cancel=event).status.code, "cancelled")
        thread.join()


class Identification(Files):
    def test_arrays_give_the_numbers_of_the_equation(self):
        t, q, effort = recorded()
        trials = []
        fit = codesign.Problem(ARM, FIT).identify(t, q, effort, progress=trials.append)
        self.assertTrue(fit.status.ok, fit.status)
        self.assertAlmostEqual(fit.numbers["mass"].value, 2.0, delta=1e-3)
        self.assertAlmostEqual(fit.numbers["viscous"].value, 0.7, delta=1e-3)
        self.assertEqual(fit.parameters["mass"], fit.numbers["mass"].value)
        self.assertTrue(fit.numbers["mass"].determined)
        low, high = fit.numbers["mass"].interval
        self.assertLess(low, high)
        self.assertEqual(fit.covariance.shape, (2, 2))
        self.assertAlmostEqual(fit.covariance[0, 0], fit.numbers["mass"].deviation ** 2, delta=1e-12)
        self.assertEqual(fit.recorded["shoulder"].shape, fit.time.shape)
        self.assertGreater(len(trials), 1)
        self.assertIn("cost", str(trials[0]))
        self.assertGreater(trials[0].rms["shoulder"], trials[-1].rms["shoulder"])

    def test_arrays_give_what_a_file_gives(self):
        t, q, effort = recorded()
        keys = "filter: {cutoff: 20}, joints: {shoulder: {offset: {}}}"
        table = np.column_stack([t, q, effort])
        np.savetxt(self.path("run.csv"), table, delimiter=",", header="time,shoulder/position,shoulder/effort", comments="", fmt="%.17g")
        model, study = self.written("arm.urdf", ARM), self.written("fit.yaml", FIT + f"identify: {{data: [{{csv: run.csv}}], {keys}}}\n")
        line = command_line("identify", model, study, "--output", self.path("line"))
        from_file = codesign.Problem(model, study).identify()
        for given in ((q, effort), (q[:, np.newaxis], effort[:, np.newaxis]), ({"shoulder": q}, {"shoulder": list(effort)})):
            fit = codesign.Problem(ARM, FIT + f"identify: {{{keys}}}\n").identify(t, *given)
            for found in (fit, from_file):
                self.assertEqual({name: number.value for name, number in found.numbers.items()},
                                 {name: number["value"] for name, number in line["identified"].items()})
        from_file.write(self.path("job"))
        self.assertEqual(set(os.listdir(self.path("job"))), {n for n in os.listdir(self.path("line")) if not n.endswith(".bag")})
        self.assertIn("mass", from_file.report())

    def test_a_model_is_judged_without_a_fit(self):
        t, q, effort = recorded()
        problem = codesign.Problem(ARM, FIT)
        fit, judged = problem.identify(t, q, effort), problem.identify(t, q, effort, evaluate=True)
        self.assertTrue(judged.status.ok)
        self.assertEqual((judged.termination, judged.numbers), ("evaluated", {}))
        self.assertEqual(judged.record["data"]["joints"]["shoulder"]["rms"], fit.record["data"]["joints"]["shoulder"]["start_rms"])
        residuals = judged.computed["shoulder"] - judged.recorded["shoulder"]
        self.assertAlmostEqual(np.sqrt(np.mean(residuals ** 2)), judged.record["data"]["joints"]["shoulder"]["rms"], delta=1e-12)
        comparison = fit.against(judged)
        self.assertLess(comparison["criterion"], 0.0)
        self.assertEqual((comparison["nested"], comparison["degrees"], comparison["larger"]), (True, 2, "here"))
        judged.write(self.path("judged"))
        self.assertEqual(set(os.listdir(self.path("judged"))), {"identification.json", "residuals.csv", "job_study.yaml"})
        again = fit.against(os.path.join(self.path("judged"), "identification.json"))
        self.assertEqual(again["criterion"], comparison["criterion"])
        with self.assertRaises(codesign.InputError):
            fit.against(self.written("other.json", "{}"))

    def test_the_columns_of_a_table_go_by_their_names(self):
        class Frame:
            """As a pandas.DataFrame."""

            def __init__(self, **columns):
                self._columns, self.columns = columns, list(columns)

            def __getitem__(self, name):
                return self._columns[name]

            def __array__(self, *_arguments, **_options):
                return np.column_stack(list(self._columns.values()))

        t, q, effort = recorded()
        model = ARM.replace("</robot>", """<link name="tip"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
          <joint name="free" type="continuous"><parent link="ground"/><child link="tip"/><axis xyz="1 0 0"/></joint></robot>""")
        fit = codesign.Problem(model, FIT).identify(t, Frame(free=0.0 * q, shoulder=q), Frame(free=0.0 * q, shoulder=effort))
        self.assertAlmostEqual(fit.numbers["mass"].value, 2.0, delta=1e-3)

    def test_bad_arrays(self):
        problem = codesign.Problem(ARM, FIT)
        t, q, effort = recorded()
        with self.assertRaisesRegex(codesign.InputError, r"arrays: shoulder/position: .*value: 400, allowed: 401"):
            problem.identify(t, q[1:], effort)
        with self.assertRaisesRegex(ValueError, r"position has the shape \(401, 2\): \(n, 1\).*shoulder"):
            problem.identify(t, np.column_stack([q, q]), effort)
        with self.assertRaisesRegex(codesign.InputError, r"jumps back .*sample 101"):
            problem.identify(np.concatenate([t[:100], t[:301]]), q, effort)
        bad = q.copy()
        bad[7] = np.nan
        with self.assertRaisesRegex(codesign.InputError, r"position of shoulder is not a finite number \(sample 8"):
            problem.identify(t, bad, effort)
        with self.assertRaisesRegex(codesign.InputError, "shoulde"):
            problem.identify(t, {"shoulde": q}, {"shoulde": effort})
        with self.assertRaisesRegex(TypeError, "times"):
            problem.identify(position=q, effort=effort)
        masked = np.ma.masked_greater(q, 0.5)
        for given, words in (((t.astype("timedelta64[s]"), q, effort), "time has the type timedelta64"), ((t.astype("datetime64[s]"), q, effort), "datetime64"),
                             ((t, masked, effort), "position has masked values"), ((t, {"shoulder": masked}, effort), "position has masked values"),
                             ((t, q[:, np.newaxis] + 0j, effort), "position has the type complex128"), ((t, {1: q}, effort), "joints needs names, not 1")):
            with self.assertRaisesRegex(TypeError, words):
                problem.identify(*given)
        with self.assertRaisesRegex(codesign.InputError, "no recordings"):
            problem.identify()
        with self.assertRaisesRegex(codesign.InputError, "tune"):
            codesign.Problem(ARM, "duration: 1.0\n").identify(t, q, effort)

    def test_what_is_not_determined_is_a_status(self):
        t, q, effort = recorded()
        model = ARM.replace('damping="0.1" codesign:damping="${viscous}"', 'damping="0.2" codesign:damping="${viscous + other}"')
        model = model.replace('<link name="ground"/>', '<codesign:parameter name="other" value="0.1" lower="0" upper="5"/><link name="ground"/>')
        fit = codesign.Problem(model, "duration: 4.0\nparameters: {mass: {}, viscous: {}, other: {}}\n").identify(t, q, effort)
        self.assertEqual(fit.status.code, "not_identifiable")
        self.assertFalse(fit.numbers["other"].determined)


if __name__ == "__main__":
    unittest.main()
