#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What a call from Python costs beside the same call in C++, on a pendulum whose run has two steps. Usage: benchmark/python_calls.py [DEVEL]

DEVEL is the devel space, devel/ by default. Prints the mean of the least twentieth of the times of 4000 calls, in us.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
CALLS = 4000
MODEL = """<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign"><codesign:parameter name="m" value="1" lower="0.5" upper="2"/>
<link name="ground"/><link name="rod"><inertial><origin xyz="0 0 -0.2"/><mass value="1" codesign:value="${m}"/>
<inertia ixx="0.04" ixy="0" ixz="0" iyy="0.04" iyz="0" izz="0.004"/></inertial></link>
<joint name="hinge" type="continuous"><parent link="ground"/><child link="rod"/><axis xyz="0 1 0"/></joint></robot>"""
STUDY = "duration: 0.002\nparameters: {m: {}}\nobjective: {integral: [{signal: hinge/position}]}\n"
PROGRAM = """#include <mechanism_codesign/gradient.h>
#include <chrono>
#include <iostream>
int main(int, char** files) {
  using namespace codesign;
  const Problem problem = load_problem(read_source(files[1]), {}, read_source(files[2]));
  Evaluator evaluator(problem);
  for (int k = 0; k < %d; ++k) {
    const auto begin = std::chrono::steady_clock::now();
    const Evaluation evaluation = evaluator.evaluate(problem.start(), DERIVATIVES);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    if (!evaluation.status.ok()) return 1;
    std::cout << spent.count() << '\\n';
  }
}
""" % CALLS


def least(times):
    """Of many calls the fastest are those that nothing else disturbed [us]."""
    fastest = sorted(times)[:CALLS // 20]
    return 1e6 * sum(fastest) / len(fastest)


def python_times(call):
    times = []
    for _ in range(CALLS):
        begin = time.perf_counter()
        call()
        times.append(time.perf_counter() - begin)
    return times


def cpp_times(devel, folder, files, derivatives):
    source, program = folder / "calls.cc", folder / "calls"
    source.write_text(PROGRAM.replace("DERIVATIVES", derivatives))
    subprocess.run(["g++", "-O2", "-std=c++17", f"-I{ROOT / 'include'}", "-isystem", "/usr/include/eigen3", source, "-o", program,
                    f"-L{devel / 'lib'}", "-lcodesign_core", f"-Wl,-rpath,{devel / 'lib'}"], check=True)
    done = subprocess.run([program, *files], stdout=subprocess.PIPE, text=True, check=True)
    return [float(line) for line in done.stdout.split()]


def main():
    devel = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "devel").resolve()
    sys.path.insert(0, os.fspath(devel / "lib/python3/dist-packages"))
    import mechanism_codesign  # pylint: disable=import-error,import-outside-toplevel
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        files = [folder / "pendulum.urdf", folder / "study.yaml"]
        for file, text in zip(files, (MODEL, STUDY)):
            file.write_text(text)
        problem = mechanism_codesign.Problem(*map(os.fspath, files))
        for name, call, derivatives in (("gradient()", problem.gradient, "true"), ("objective()", problem.objective, "false")):
            print(f"{name:12} Python {least(python_times(lambda: call(problem.start))):.1f} us, C++ {least(cpp_times(devel, folder, files, derivatives)):.1f} us")


if __name__ == "__main__":
    main()
