#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The ranks of this program beside mpi4py.futures and Dask, which evaluate a pickled Problem: speed, and a killed worker. Usage: benchmark/task_farms.py [DEVEL] [speed | kill]

DEVEL is the devel space, devel/ by default. mpi4py and Dask are Debian's python3-mpi4py and python3-distributed; one that is not installed is left out. All evaluate the
objective and gradient of the slider-crank at as many widths of the slider, in two processes that compute; beside them the program with one thread and with two, and a loop in
Python. speed: medians, from the difference between two numbers of evaluations; the processor time is that of all processes. kill: a worker gets SIGKILL after 20 of 100
evaluations. Without a word both.
"""
import importlib.util
import json
import math
import os
import pathlib
import resource
import signal
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
MODEL = ROOT / "urdf/slider_crank.urdf"
WIDTHS = (0.02, 0.03)
FARMS = {"mpi4py": "mpi4py", "dask": "distributed"}
REPETITIONS = 5
KILL_AFTER = 20  # evaluations
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
           "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe"}


def study_text(duration, more):
    """The shipped study with another duration, the slider's width not tuned."""
    text = (ROOT / "config/slider_crank.yaml").read_text(encoding="utf-8")
    for old, new in (("duration: 2.0", f"duration: {duration}"), ("slider_width: {tune: true}", "slider_width: {tune: false}")):
        assert old in text, old
        text = text.replace(old, new)
    return text + more


def samples(count):
    return f"uncertain: {{slider_width: {{uniform: [{WIDTHS[0]}, {WIDTHS[1]}]}}}}\nrobust: {{measure: mean, samples: {count}}}\n"


# What a worker of a farm holds: the problem, unpickled once per process.
PROBLEM = None


def keep(problem):
    global PROBLEM  # pylint: disable=global-statement
    PROBLEM = problem


def evaluate(width):
    value, gradient = PROBLEM.gradient(slider_width=width)
    return os.getpid(), value, gradient


class Alone:
    """A loop in this process."""

    def __init__(self, problem, workers):
        del workers
        keep(problem)

    def results(self, widths):
        return map(evaluate, widths)

    def end(self):
        pass


class Mpi4py:
    """On the ranks of mpirun -n WORKERS+1 python3 -m mpi4py.futures, or on processes that MPI starts."""

    def __init__(self, problem, workers):
        from mpi4py.futures import MPIPoolExecutor  # pylint: disable=import-error,import-outside-toplevel
        self.pool = MPIPoolExecutor(max_workers=workers, initializer=keep, initargs=(problem,))

    def results(self, widths):
        return self.pool.map(evaluate, widths, unordered=True)

    def end(self):
        self.pool.shutdown(cancel_futures=True)


class Dask:
    """A scheduler in this process, and workers on this machine."""

    def __init__(self, problem, workers):
        from distributed import Client, LocalCluster, WorkerPlugin, as_completed  # pylint: disable=import-error,import-outside-toplevel

        class Keeper(WorkerPlugin):
            """Also of workers that are started again."""

            def setup(self, worker):
                del worker
                import task_farms  # pylint: disable=import-error,import-outside-toplevel
                task_farms.keep(problem)

        self.cluster = LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None)
        self.client, self.as_completed = Client(self.cluster), as_completed
        self.client.register_worker_plugin(Keeper())

    def results(self, widths):
        import task_farms  # pylint: disable=import-error,import-outside-toplevel
        futures = self.client.map(task_farms.evaluate, widths, pure=False)
        return (result for _, result in self.as_completed(futures, with_results=True))

    def end(self):
        self.client.close()
        self.cluster.close()


def run_farm(name, study, count, what):
    """In a process of its own: `count` evaluations. Prints how many have a result, and the sum of the objectives, which no order changes."""
    import mechanism_codesign  # pylint: disable=import-error,import-outside-toplevel
    problem = mechanism_codesign.Problem(MODEL, study)
    farm = {"alone": Alone, "mpi4py": Mpi4py, "dask": Dask}[name](problem, 2)
    widths = [WIDTHS[0] + (k + 0.5) / count * (WIDTHS[1] - WIDTHS[0]) for k in range(count)]
    values = []
    for pid, value, _ in farm.results(widths):
        values.append(value)
        if what == "kill" and len(values) == KILL_AFTER:
            print("killed", time.time(), flush=True)
            os.kill(pid, signal.SIGKILL)
    farm.end()
    print(len(values), math.fsum(values), flush=True)


def words_of(farm, devel, study, count, what):
    """The command of a farm with two processes that compute."""
    program = devel / "lib/mechanism_codesign/codesign"
    own = [sys.executable, __file__, "--farm", farm, study, str(count), what]
    if farm == "ranks":
        return ["mpirun", "-n", "2", program, "gradient", MODEL, study, "--json", "--quiet"]
    if farm in ("serial", "threads"):
        return [program, "gradient", MODEL, study, "--json", "--quiet"]
    if farm == "mpi4py":
        return ["mpirun", "-n", "3", sys.executable, "-m", "mpi4py.futures", *own[1:]]
    return own


def environment(devel):
    paths = [devel / "lib/python3/dist-packages", ROOT / "benchmark"]
    return {**os.environ, **AS_ROOT, "PYTHONPATH": os.pathsep.join(map(os.fspath, paths))}


def seconds_of(words, variables):
    """Time and processor time of a job with all its processes."""
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run(words, env=variables, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    wall, after = time.perf_counter() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}: {done.stderr}")
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def speed(devel, folder, farms):
    print("| duration of a run [s] | by | evaluations per s | processor time per evaluation [ms] | beginning and end [s] |\n|---|---|---:|---:|---:|")
    for duration, few, many in ((2.0, 40, 240), (0.001, 2000, 12000)):
        rows = {farm: [] for farm in farms}
        for _ in range(REPETITIONS):
            for farm in farms:
                times = []
                for count in (few, many):
                    study = folder / f"study_{count}.yaml"
                    more = samples(count) if farm in ("serial", "ranks", "threads") else ""
                    study.write_text(study_text(duration, more + ("engine: {type: serial}\n" if farm == "serial" else "")), encoding="utf-8")
                    times.append(seconds_of(words_of(farm, devel, study, count, "speed"), environment(devel)))
                wall, cpu = ((b - a) / (many - few) for a, b in zip(*times))
                rows[farm].append((wall, cpu, times[0][0] - few * wall))
        for farm, measured in rows.items():
            wall, cpu, rest = (statistics.median(column) for column in zip(*measured))
            print(f"| {duration} | {farm} | {1.0 / wall:.3g} | {1e3 * cpu:.3g} | {rest:.2f} |", flush=True)


def ranks_of(folder):
    """Process by rank of the job that writes into a folder."""
    found = {}
    for entry in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words, variables = (entry / "cmdline").read_bytes(), (entry / "environ").read_bytes().decode(errors="replace").split("\0")
        except OSError:
            continue
        rank = next((text.split("=")[1] for text in variables if text.startswith("OMPI_COMM_WORLD_RANK=")), None)
        if rank is not None and os.fsencode(folder) in words:
            found[int(rank)] = int(entry.name)
    return found


def lines_of(path):
    return path.read_bytes().count(b"\n") if path.exists() else 0


def start_job(devel, folder, duration, samples_of_job, option="--output"):
    """This program's optimization on three ranks, with a journal."""
    study = folder / "job.yaml"
    if option == "--output":
        study.write_text(study_text(duration, samples(samples_of_job)), encoding="utf-8")
    words = ["mpirun", "-n", "3", devel / "lib/mechanism_codesign/codesign", "optimize", MODEL, study, option, folder / "job", "--quiet"]
    return subprocess.Popen(words, env=environment(devel), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def kill_rank(devel, folder):
    job, journal = start_job(devel, folder, 2.0, 100), folder / "job/journal.jsonl"
    while lines_of(journal) <= KILL_AFTER:
        time.sleep(0.01)
    before = lines_of(journal) - 1
    os.kill(ranks_of(folder / "job")[2], signal.SIGKILL)
    begin = time.time()
    job.wait()
    ended = time.time() - begin
    error = json.loads((folder / "job/result.json").read_text(encoding="utf-8"))["error"]
    kept = lines_of(journal) - 1
    print(f"ranks: {before} evaluations when rank 2 was killed; ended {ended:.1f} s later with {error['code']}, exit code {job.returncode}, {kept} evaluations kept")
    job.stderr.close()
    job = start_job(devel, folder, 2.0, 100, "--resume")
    job.communicate()
    print(f"ranks: resumed, exit code {job.returncode}, {lines_of(journal) - 1} evaluations in the journal")


def kill_worker(devel, folder, farm):
    study = folder / "study.yaml"
    study.write_text(study_text(2.0, ""), encoding="utf-8")
    done = subprocess.Popen(words_of(farm, devel, study, 100, "kill"), env=environment(devel), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        output = done.communicate(timeout=60)[0]
    except subprocess.TimeoutExpired:
        done.send_signal(signal.SIGTERM)
        output = done.communicate()[0] + "\nwaits forever"
    begin = next((float(line.split()[1]) for line in output.splitlines() if line.startswith("killed")), 0.0)
    print(f"{farm}: ended {time.time() - begin:.1f} s after the kill, exit code {done.returncode}; the last lines: {output.splitlines()[-3:]}")


def main():
    words = sys.argv[1:]
    if words[:1] == ["--farm"]:
        run_farm(words[1], words[2], int(words[3]), words[4])
        return
    devel = pathlib.Path(words.pop(0) if words and os.path.isdir(words[0]) else ROOT / "devel").resolve()
    if len(words) > 1 or any(word not in ("speed", "kill") for word in words):
        sys.exit(__doc__)
    others = [farm for farm, module in FARMS.items() if importlib.util.find_spec(module)]
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        if words != ["kill"]:
            speed(devel, folder, ["serial", "threads", "ranks", "alone", *others])
        if words != ["speed"]:
            kill_rank(devel, folder)
            for farm in others:
                kill_worker(devel, folder, farm)


if __name__ == "__main__":
    main()
