#!/usr/bin/env python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Measures this package and others at the same error of the same tasks, in one run; prints tables.

Usage: race.py [--markdown] [--folder FOLDER] [--rounds N] [--limit SECONDS] [TASK...]. Called by `tools/benchmark peers`, after the build.
FOLDER (build/peers) gets a virtual environment with the others from PyPI, the models, and with --markdown tables.md, the tables for the
documents. Without PyPI it says so and measures the rest.
Ctrl-C ends the sweeps; the tables then have the tasks that are done.

Each program is a process of its own that answers requests. First, each of its methods goes from loose settings to tight ones; then the settings
that the result needs are measured again, in rounds over all programs, and the least processor time counts. A run longer than --limit ends a method.
"""
import argparse
import os
import pathlib
import platform
import queue
import subprocess
import sys
import threading
import time

import codes
import table

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PATIENCE = 900.0  # s of wall time for an answer; set-up, such as compiling, is included
ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}


class Failed(Exception):
    """A program that gives no answer."""


class Program:
    """A process that answers requests; it starts again if it died."""

    def __init__(self, command, place):
        self.command, self.place, self.process, self.lines = command, place, None, None
        self.greeting = self.start()

    def start(self):
        self.process = subprocess.Popen(self.command, cwd=self.place, env={**os.environ, **ONE_THREAD}, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL, text=True, start_new_session=True)
        self.lines = queue.Queue()

        def read(lines=self.lines, stream=self.process.stdout):
            for line in stream:
                lines.put(line)
            lines.put("no the program ended\n")
        threading.Thread(target=read, daemon=True).start()
        return self.answer()

    def answer(self):
        try:
            line = self.lines.get(timeout=PATIENCE)
        except queue.Empty:
            self.stop()
            raise Failed(f"no answer within {PATIENCE:.0f} s") from None
        word, _, rest = line.strip().partition(" ")
        if word == "no":
            raise Failed(rest)
        return rest

    def ask(self, task, method, setting):
        """(steps, seconds, values)"""
        if self.process.poll() is not None:
            self.start()
        self.process.stdin.write(f"{task}\t{method}\t{setting!r}\n")
        self.process.stdin.flush()
        numbers = [float(word) for word in self.answer().split()]
        return numbers[0], numbers[1], numbers[2:]

    def stop(self):
        self.process.kill()
        self.process.wait()


def install(folder, packages):
    """The packages in the virtual environment of `folder`. @returns its python, and the last line of pip of each package that cannot be installed"""
    environment = folder / "venv"
    python = environment / "bin" / "python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", str(environment)], check=True)

    def pip(*names):
        done = subprocess.run([str(python), "-m", "pip", "install", "--quiet", "--retries", "1", "--timeout", "30", *names], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)
        return "" if done.returncode == 0 else (done.stdout.strip().splitlines() or ["pip failed"])[-1]
    if not pip(*packages):
        return python, {}
    return python, {package: reason for package in packages if (reason := pip(package))}


def compile_pinocchio(python, folder):
    """pinocchio_run, against the headers and libraries of the package `pin`."""
    prefix = subprocess.run([str(python), "-c", "import cmeel, pathlib; print(pathlib.Path(cmeel.__file__).parent.parent / 'cmeel.prefix')"],
                            stdout=subprocess.PIPE, text=True, check=True).stdout.strip()
    program, source = folder / "pinocchio_run", HERE / "pinocchio_run.cc"
    if program.exists() and program.stat().st_mtime > source.stat().st_mtime:
        return program
    # Options that change how Eigen lays out its matrices, such as -march=native, do not go with the package, which is built for any x86-64.
    command = ["g++", "-std=c++17", "-O2", "-DNDEBUG", "-DPINOCCHIO_ENABLE_TEMPLATE_INSTANTIATION", f"-I{ROOT}", "-isystem", f"{prefix}/include",
               "-isystem", "/usr/include/eigen3", "-DBOOST_MPL_LIMIT_LIST_SIZE=30", "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30",
               "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS", "-DBOOST_FUSION_INVOKE_MAX_ARITY=12", "-o", str(program), str(source), f"-L{prefix}/lib",
               f"-Wl,-rpath,{prefix}/lib", "-lpinocchio_parsers", "-lpinocchio_default", "-lsundials_cvode", "-lsundials_nvecserial",
               "-lsundials_sunmatrixdense", "-lsundials_sunlinsoldense"]
    subprocess.run(command, check=True)
    return program


def version_of(code):
    """Of this package, or of a package of Debian, which `source` names last."""
    if code.name == codes.OWN:
        return (ROOT / "package.xml").read_text(encoding="utf-8").split("<version>")[1].split("<")[0].strip()
    done = subprocess.run(["dpkg-query", "--show", "--showformat=${Version}", code.source.split()[-1]], stdout=subprocess.PIPE, text=True, check=False)
    return done.stdout or "-"


def start_programs(folder, python, failed):
    """The programs by name, their versions, and why others do not run."""
    own = Program([str(ROOT / "build/benchmark/peer_program"), str(folder)], ROOT)
    programs, versions, silent = {}, {}, {}
    for code in codes.CODES:
        missing = [failed[package] for package in code.packages if package in failed]
        try:
            if missing:
                raise Failed("not installed")
            if not code.module:
                programs[code.name] = own
            elif code.module == "pinocchio_run":
                programs[code.name] = Program([str(compile_pinocchio(python, folder)), str(folder)], folder)
            else:
                programs[code.name] = Program([str(python), str(HERE / "worker.py"), code.module, str(folder)], folder)
            versions[code.name] = programs[code.name].greeting or version_of(code)
        except (Failed, OSError, subprocess.CalledProcessError) as error:
            silent[code.name] = str(error)
    return programs, versions, silent


def sweep(program, task, method, settings, reference, limit):
    """Points from loose to tight, until the tightest error is reached twice, and the last reason for a failure."""
    points, reason = [], "the error is not reached"
    good = 0
    for setting in settings:
        try:
            steps, seconds, values = program.ask(task.name, method, setting)
            points.append(table.Point(setting, table.difference(values, reference), steps, seconds))
        except Failed as failure:
            points.append(table.Point(setting, float("inf"), 0.0, float("inf")))
            reason = str(failure)
            if reason == "the program ended" or reason.startswith("no answer") or len(points) - good > 8:
                break
            continue
        good = good + 1 if points[-1].error <= min(task.errors) else 0
        if good == 2 or points[-1].seconds > limit:
            break
    return points, reason


class Race:
    """One task: sweeps of all methods of all programs, then rounds over the settings that matter."""

    def __init__(self, task, programs, silent, limit):
        self.task, self.programs = task, programs
        self.points, self.reasons, self.best = {}, dict(silent), {}
        own = programs[codes.OWN]
        self.reference = [1.0] * 5 if task.reference is None else own.ask(task.name, *task.reference)[2]
        for code in codes.CODES:
            if task.name in code.cannot:
                self.reasons[code.name] = code.cannot[task.name]
            elif code.name in programs:
                self.sweep(code, limit)

    def sweep(self, code, limit):
        for method, settings in code.methods.get(self.task.name, []):
            begin = time.monotonic()
            points, reason = sweep(self.programs[code.name], self.task, method, settings, self.reference, limit)
            self.points[code.name, method] = points
            least = min((point.error for point in points), default=float("inf"))
            print(f"# {self.task.name}: {code.name}, {method}: {len(points)} settings, least error {least:.1g}, {time.monotonic() - begin:.0f} s"
                  + (f" ({reason})" if least == float("inf") else ""), file=sys.stderr, flush=True)
            if least == float("inf"):
                self.reasons.setdefault(code.name, reason)
        for error in self.task.errors:
            found = [(table.at_error(points, error), method) for (name, method), points in self.points.items() if name == code.name]
            found = [(point, method) for point, method in found if point is not None]
            if found:
                self.best[code.name, error] = min(found, key=lambda pair: pair[0].seconds)[1]

    def measure_again(self):
        """One round: every setting that a result needs, program after program."""
        done = set()
        for (name, error), method in self.best.items():
            for point in table.bracket(self.points[name, method], error):
                if point is None or point.seconds == float("inf") or (name, method, point.setting) in done:
                    continue
                done.add((name, method, point.setting))
                try:
                    point.seconds = min(point.seconds, self.programs[name].ask(self.task.name, method, point.setting)[1])
                except Failed:
                    pass

    def result(self, name, error):
        method = self.best.get((name, error))
        return (None, None) if method is None else (table.at_error(self.points[name, method], error), method)

    def reason(self, name, error):
        if name in self.reasons:
            return self.reasons[name]
        errors = [point.error for (code, _), points in self.points.items() if code == name for point in points]
        return f"least error {min(errors):.0e}" if errors and min(errors) > error else "-"


def tables_of(races):
    """The table of times, and that of settings."""
    others = [code.name for code in codes.CODES if code.name != codes.OWN]
    times, settings = [], []
    for race in races:
        for error in race.task.errors:
            results = {name: race.result(name, error) for name in [codes.OWN] + others}
            seconds = {name: point.seconds if point else None for name, (point, _) in results.items()}
            reasons = {name: race.reason(name, error) for name in results}
            times.append([race.task.title, f"{error:.0e}"] + table.row_of_times(seconds, codes.OWN, others, reasons))
            for name, (point, method) in results.items():
                if point:
                    settings.append([race.task.name, f"{error:.0e}", name, method, f"{point.setting:.1e}", f"{point.steps:.0f}", table.milliseconds(point.seconds)])
    return ((["task", "error", codes.OWN] + others + ["fastest"], times),
            (["task", "error", "program", "method", "tolerance or step", "steps", "processor time"], settings))


def processor():
    names = [line.split(":", 1)[1].strip() for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines() if line.startswith("model name")]
    return names[0] if names else platform.machine()


def versions_table(versions, silent):
    rows = [[code.name, versions.get(code.name, silent.get(code.name, "-")), code.source, code.call] for code in codes.CODES]
    return ["program", "version", "source", "how it is called"], rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--markdown", action="store_true")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build" / "peers")
    parser.add_argument("--rounds", type=int, default=4)
    parser.add_argument("--limit", type=float, default=20.0)
    parser.add_argument("task", nargs="*", choices=[task.name for task in codes.TASKS] + [[]])
    arguments = parser.parse_args()
    arguments.folder = arguments.folder.resolve()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    python, failed = install(arguments.folder, [package for code in codes.CODES for package in code.packages])
    missing = [code.name for code in codes.CODES if any(package in failed for package in code.packages)]
    if missing:
        print(table.unmeasured_sentence(missing))
    programs, versions, silent = start_programs(arguments.folder, python, failed)
    load = [os.getloadavg()[0]]
    races = []
    try:
        for task in codes.TASKS:
            if not arguments.task or task.name in arguments.task:
                races.append(Race(task, programs, silent, arguments.limit))
    except KeyboardInterrupt:
        print(f"# ended after {len(races)} tasks", file=sys.stderr)
    for _ in range(arguments.rounds):
        for race in races:
            race.measure_again()
        load.append(os.getloadavg()[0])
    times, settings = tables_of(races)
    run = [[time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime()), f"{processor()}, {os.cpu_count()} cores", f"{min(load):.1f} to {max(load):.1f}",
            str(arguments.rounds)]]
    tables = (("peers_brief", "Times of ours", table.brief_of_times(*times)), ("peers", "Processor time at the same error", times), ("peers_settings", "Best settings", settings),
              ("peers_versions", "Programs", versions_table(versions, silent)),
              ("peers_run", "The run", (["date", "machine", "load average", "rounds"], run)))
    if arguments.markdown:
        text = "\n".join(table.to_markdown(name, columns, rows) for name, _, (columns, rows) in tables)
        (arguments.folder / "tables.md").write_text(text, encoding="utf-8")
        print(text, flush=True)
    else:
        print("\n".join(table.to_text(title, columns, rows) for _, title, (columns, rows) in tables), flush=True)
    for program in programs.values():
        program.stop()


if __name__ == "__main__":
    main()
