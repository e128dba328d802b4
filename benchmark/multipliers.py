#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The multipliers of the certificate of an optimum, least_multipliers(), beside a non-negative least squares, scipy.optimize.nnls. Usage: benchmark/multipliers.py [DEVEL] [MOST]

DEVEL is the devel space, devel/ by default; NNLS gets problems of at most MOST rows, by default 1000. Problems of n variables and k rows, bounds of the variables and one equality
among them. few: most rows are 0.001 to 1 of their length away, some 1e-9 to 1e-6. many: 1e-9 to 1 alike. signal: instants of a signal that touches its bound n/2 times. Prints the
processor time, by how much the residual s is larger than that of the other one, in |g|, and the worst violation of the conditions of the minimum, in |a| |g|. Needs python3-scipy.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
import scipy.optimize

ROOT = pathlib.Path(__file__).resolve().parent.parent
SIZES = ((5, 100), (40, 200), (5, 1000), (40, 1000), (5, 10000), (40, 10000))
# Reads size, rows, repetitions and g; of each row kind (1: equality, 2: bound), d and a. Writes the least time, the number of matrices and c.
PROGRAM = """#include <algorithm>
#include <ctime>
#include <fstream>
#include <optimization/near_multipliers.h>
using namespace codesign;
double now() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}
int main(int, char** files) {
  std::ifstream in(files[1], std::ios::binary);
  const auto get = [&in] { double x = 0.0; in.read(reinterpret_cast<char*>(&x), sizeof x); return x; };
  const auto size = static_cast<int>(get()), rows = static_cast<int>(get()), repetitions = static_cast<int>(get());
  Eigen::VectorXd gradient(size);
  for (double& x : gradient) x = get();
  std::vector<Holder> holders(static_cast<std::size_t>(rows));
  for (Holder& holder : holders) {
    const double kind = get();
    holder.any_sign = kind == 1.0;
    holder.is_bound = kind == 2.0;
    holder.distance = get();
    Eigen::VectorXd a(size);
    for (double& x : a) x = get();
    for (int i = 0; holder.is_bound && i < size; ++i)
      if (a[i] != 0.0) holder.others.emplace_back(i, a[i]);
    if (!holder.is_bound) holder.leading = a;
  }
  double least = 1e9;
  Multipliers found;
  for (int k = 0; k < repetitions; ++k) {
    const double begin = now();
    found = least_multipliers(gradient, holders, nullptr);
    least = std::min(least, now() - begin);
  }
  std::ofstream out(files[2], std::ios::binary);
  const auto put = [&out](double x) { out.write(reinterpret_cast<const char*>(&x), sizeof x); };
  put(least);
  put(found.factorizations);
  for (const double c : found.values) put(c);
}
"""


def problem(kind, n, k, seed):
    """g, the rows a, their distances d and their kinds."""
    random = np.random.default_rng(seed)
    g, bounds = random.standard_normal(n), 2 * n if k > 4 * n else n
    m = k - bounds - 1
    if kind == "signal":
        time_of, weights, phases = np.linspace(0.0, 1.0, m), random.standard_normal((n, 6, 1)), random.uniform(0.0, 2.0 * np.pi, (n, 6, 1))
        a = np.sum(weights * np.cos(2.0 * np.pi * np.arange(1, 7).reshape(6, 1) * time_of + phases), axis=1).T
        d = 0.5 * np.sin(np.pi * (n // 2) * time_of + 0.7)**2 + 10.0**random.uniform(-9.0, -7.0)
    else:
        a = random.standard_normal((m, n))
        shares = random.uniform(-9.0 if kind == "many" else -3.0, 0.0, m)
        if kind == "few":
            near = random.permutation(m)[:min(m // 4, 2 * n)]
            shares[near] = random.uniform(-9.0, -6.0, near.size)
        d = 10.0**shares * np.linalg.norm(a, axis=1)
    of_bounds = random.uniform(0.1, 0.9, bounds)
    of_bounds[random.permutation(n)[:n // 5 + 1]] = 0.0
    a = np.vstack([a, random.standard_normal((1, n)), np.eye(n), -np.eye(n)[:bounds - n]])
    return g, a, np.concatenate([d, [0.0], of_bounds]), np.concatenate([np.zeros(m), [1.0], np.full(bounds, 2.0)])


def by_program(program, folder, g, a, d, kinds):
    """Time, number of matrices, c."""
    np.concatenate([[g.size, d.size, 3.0], g, np.hstack([kinds[:, None], d[:, None], a]).ravel()]).tofile(folder / "in")
    subprocess.run([program, folder / "in", folder / "out"], check=True)
    numbers = np.fromfile(folder / "out")
    return numbers[0], int(numbers[1]), numbers[2:]


def by_nnls(g, a, d, kinds):
    """Time and c: the columns are (a, d), of an equality also their opposite."""
    equal = kinds == 1.0
    begin = time.process_time()
    columns = np.vstack([np.hstack([a.T, -a[equal].T]), np.diag(np.concatenate([d, d[equal]]))])
    found, _ = scipy.optimize.nnls(columns, np.concatenate([g, np.zeros(columns.shape[1])]), maxiter=100 * d.size)
    c = found[:d.size].copy()
    c[equal] -= found[d.size:]
    return time.process_time() - begin, c


def judged(g, a, d, kinds, c):
    """s / |g|, and the worst violation of the conditions, in extended precision."""
    wide = np.longdouble
    c, d, a, size = c.astype(wide), d.astype(wide), a.astype(wide), np.linalg.norm(g)
    rest = g.astype(wide) - a.T @ c
    slopes = (c * d**2 - a @ rest) / (np.sqrt(np.sum(a * a, axis=1)) * size)
    free = (kinds == 1.0) | (c > 0.0)
    return float(np.sqrt(rest @ rest + np.sum((c * d)**2)) / size), float(max(np.max(np.abs(slopes[free]), initial=0.0), np.max(-slopes[~free], initial=0.0)))


def main():
    words = sys.argv[1:]
    devel = pathlib.Path(words.pop(0) if words and os.path.isdir(words[0]) else ROOT / "devel").resolve()
    if len(words) > 1 or not all(word.isdigit() for word in words):
        sys.exit(__doc__)
    most = int(words[0]) if words else 1000
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        (folder / "program.cc").write_text(PROGRAM, encoding="utf-8")
        subprocess.run(["g++", "-O2", "-std=c++17", f"-I{ROOT / 'src'}", f"-I{ROOT / 'include'}", "-isystem", "/usr/include/eigen3", folder / "program.cc",
                        "-o", folder / "program", f"-L{devel / 'lib'}", "-lcodesign_core", f"-Wl,-rpath,{devel / 'lib'}"], check=True)
        print("| rows | n | k | ms | of NNLS | matrices | s larger | of NNLS | conditions | of NNLS |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|")
        for kind in ("few", "many", "signal"):
            for n, k in SIZES:
                rows = problem(kind, n, k, 1)
                seconds, matrices, c = by_program(folder / "program", folder, *rows)
                s, violation = judged(*rows, c)
                of_nnls = ["-"] * 3
                larger = "-"
                if k <= most:
                    other_seconds, other = by_nnls(*rows)
                    other_s, other_violation = judged(*rows, other)
                    larger = f"{max(0.0, s - other_s):.0e}"
                    of_nnls = [f"{1e3 * other_seconds:.0f}", f"{max(0.0, other_s - s):.0e}", f"{other_violation:.0e}"]
                print(f"| {kind} | {n} | {k} | {1e3 * seconds:.3g} | {of_nnls[0]} | {matrices} | {larger} | {of_nnls[1]} | {violation:.0e} | {of_nnls[2]} |", flush=True)


if __name__ == "__main__":
    main()
