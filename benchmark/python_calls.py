#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What a call from Python costs beside the same call in C++, on a pendulum whose run has two steps, and how soon calls end by Ctrl-C.
Usage: benchmark/python_calls.py [DEVEL] [costs | interruptions]

DEVEL is the devel space, devel/ by default. costs: the mean of the least twentieth of the times of 4000 calls, in us. interruptions: the longest
time from SIGINT, or from the event, to the end of the call, of several of them spread over a long call, in s, and the processor time until then. Without a
word both.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
CALLS = 4000
AFTER = [0.05 * k for k in range(1, 41)]  # [s]
MODEL = """<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign"><codesign:parameter name="m" value="1" lower="0.5" upper="2"/>
<link name="ground"/><link name="rod"><inertial><origin xyz="0 0 -0.2"/><mass value="1" codesign:value="${m}"/>
<inertia ixx="0.04" ixy="0" ixz="0" iyy="0.04" iyz="0" izz="0.004"/></inertial></link>
<joint name="hinge" type="continuous"><parent link="ground"/><child link="rod"/><axis xyz="0 1 0"/></joint></robot>"""
STUDY = "duration: 0.002\nparameters: {m: {}}\nobjective: {integral: [{signal: hinge/position}]}\n"
# By the name of the method what it is in C++, at a design.
CPP = {
    "objective": "evaluator.evaluate(rho, Derivatives::kNone).status",
    "gradient": "evaluator.evaluate(rho, Derivatives::kGradient).status",
    "adjoint": "adjoint.evaluate(rho, Derivatives::kGradient).status",
    "residuals": "evaluator.evaluate(rho, Derivatives::kGaussNewton).status",
    "jacobian": "evaluator.evaluate(rho, Derivatives::kGaussNewton).status",
    "simulate": "run(problem, rho[0])",
}
PROGRAM = """#include <mechanism_codesign/gradient.h>
#include <mechanism_codesign/simulation.h>
#include <chrono>
#include <functional>
#include <iostream>
#include <map>
using namespace codesign;
Status run(const Problem& problem, double m) {
  Simulation simulation(problem, problem.parameters({{"m", m}}), {SIGNALS});
  std::vector<double> table;
  return simulate(&simulation, problem.duration(), 101, [&table](const Frame& frame) {
    table.push_back(frame.time);
    table.insert(table.end(), frame.signals.begin(), frame.signals.end());
    return true;
  });
}
int main(int, char** files) {
  const Problem problem = load_problem(read_source(files[1]), {}, read_source(files[2]));
  const Problem with_adjoint = load_problem(read_source(files[1]), {}, read_source(files[3]));
  Evaluator evaluator(problem), adjoint(with_adjoint);
  const std::map<std::string, std::function<Status(const Eigen::VectorXd&)>> calls = {CALLS};
  const auto& call = calls.at(files[4]);
  for (int k = 0; k < COUNT; ++k) {
    Eigen::VectorXd rho = problem.start();
    rho[0] += 1e-3 * (k % 2);
    const auto begin = std::chrono::steady_clock::now();
    if (!call(rho).ok()) return 1;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    std::cout << spent.count() << '\\n';
  }
}
"""


def least(times):
    """Of many calls the fastest are those that nothing else disturbed [us]."""
    fastest = sorted(times)[:CALLS // 20]
    return 1e6 * sum(fastest) / len(fastest)


def python_times(problem, name):
    """At two designs in turn: residuals() and jacobian() remember the last one."""
    times, call = [], getattr(problem, name)
    points = [problem.start, problem.start + 1e-3]
    for k in range(CALLS):
        begin = time.perf_counter()
        call(points[k % 2])
        times.append(time.perf_counter() - begin)
    return times


def cpp_program(devel, folder, signals):
    source, program = folder / "calls.cc", folder / "calls"
    names = ", ".join(f'"{signal}"' for signal in signals)
    calls = ", ".join(f'{{"{name}", [&](const auto& rho) {{ return {call}; }}}}' for name, call in CPP.items())
    source.write_text(PROGRAM.replace("SIGNALS", names).replace("COUNT", str(CALLS)).replace("CALLS", calls))
    subprocess.run(["g++", "-O2", "-std=c++17", f"-I{ROOT / 'include'}", "-isystem", "/usr/include/eigen3", source, "-o", program,
                    f"-L{devel / 'lib'}", "-lcodesign_core", f"-Wl,-rpath,{devel / 'lib'}"], check=True)
    return [program, folder / "pendulum.urdf", folder / "study.yaml", folder / "adjoint.yaml"]


def cpp_times(program, name):
    done = subprocess.run([*program, name], stdout=subprocess.PIPE, text=True, check=True)
    return [float(line) for line in done.stdout.split()]


def costs(devel):
    import mechanism_codesign  # pylint: disable=import-error,import-outside-toplevel
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        for name, text in (("pendulum.urdf", MODEL), ("study.yaml", STUDY), ("adjoint.yaml", STUDY + "solver: {gradient: adjoint}\n")):
            (folder / name).write_text(text)
        problem = mechanism_codesign.Problem(folder / "pendulum.urdf", folder / "study.yaml")
        program = cpp_program(devel, folder, problem.signals)
        for name in CPP:
            python, native = least(python_times(problem, name)), least(cpp_times(program, name))
            print(f"{name + '()':12} Python {python:.1f} us, C++ {native:.1f} us, {python - native:.1f} us more", flush=True)


def interruptions(devel):
    os.environ["CODESIGN"] = os.fspath(devel / "lib/mechanism_codesign/codesign")
    sys.path.insert(0, os.fspath(ROOT / "test/python"))
    from interruption import CALLS as LONG_CALLS, WITH_EVENT, latency  # pylint: disable=import-error,import-outside-toplevel
    for call in LONG_CALLS:
        for by_event in (False, True) if call in WITH_EVENT else (False,):
            measured = [latency(call, after, by_event) for after in AFTER]
            ends, seconds, of_processor = (set(column) for column in zip(*measured))
            print(f"{call:12} {'event ' if by_event else 'SIGINT'} {max(seconds):.3f} s, of the processor {max(of_processor):.2f} s; {', '.join(sorted(ends))}", flush=True)


def main():
    words = [word for word in sys.argv[1:] if word in ("costs", "interruptions")]
    folders = [word for word in sys.argv[1:] if word not in words]
    devel = pathlib.Path(folders[0] if folders else ROOT / "devel").resolve()
    package = os.fspath(devel / "lib/python3/dist-packages")
    sys.path.insert(0, package)
    os.environ["PYTHONPATH"] = package
    for work in (costs, interruptions):
        if not words or work.__name__ in words:
            work(devel)


if __name__ == "__main__":
    main()
