# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""How soon a call ends behind Ctrl-C or its event, measured in a process of its own: for a test and for benchmark/python_calls.py."""
import signal
import subprocess
import sys
import time

from fixture import ARM, FIT, FREE, LONG, processor_time, wait_for_computing

# A recording whose preparation alone takes a while, with the torque of the arm of `fixture.recorded`.
RECORDING = """
t = np.linspace(0.0, 8000.0, 800001)
q, v, a = np.sin(2.0 * t), 2.0 * np.cos(2.0 * t), -4.0 * np.sin(2.0 * t)
effort = 0.51 * a + 9.81 * np.sin(q) + 0.7 * v + 0.01 * np.random.default_rng(1).standard_normal(len(t))
"""
# By name: model, study, what is made before the call, and the call.
CALLS = {
    "simulate()": (FREE, LONG, "", "problem.simulate()"),
    "objective()": (FREE, LONG, "", "problem.objective()"),
    "gradient()": (FREE, LONG, "", "problem.gradient()"),
    "adjoint()": (FREE, LONG, "", "problem.adjoint()"),
    "residuals()": (FREE, LONG, "", "problem.residuals()"),
    "jacobian()": (FREE, LONG, "", "problem.jacobian()"),
    "optimize()": (FREE, LONG, "", "problem.optimize(progress=lambda trial: None, cancel=event)"),
    "identify()": (ARM, FIT, RECORDING, "problem.identify(t, q, effort, cancel=event)"),
}
WITH_EVENT = ("optimize()", "identify()")
PROGRAM = """
import os, sys, threading, time
import numpy as np
import mechanism_codesign as codesign
problem = codesign.Problem({model!r}, {study!r})
{before}
event = threading.Event()
threading.Thread(target=lambda: sys.stdin.readline() and event.set(), daemon=True).start()
try:
    print("ready", flush=True)
    end = {call}.status.code
except KeyboardInterrupt:
    end = "interrupted"
print(end, time.process_time(), flush=True)
os._exit(0)
"""


def latency(call, after, by_event=False):
    """How `call` ends, and how long after SIGINT, or after its event was set, which come `after` seconds of computing: (end, time, processor time) [s]."""
    model, study, before, text = CALLS[call]
    program = PROGRAM.format(model=model, study=study, before=before, call=text)
    with subprocess.Popen([sys.executable, "-c", program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout.readline() == "ready\n"
        wait_for_computing(child.pid, after)
        begin, spent = time.monotonic(), processor_time(child.pid)
        if by_event:
            child.stdin.write("\n")
            child.stdin.flush()
        else:
            child.send_signal(signal.SIGINT)
        end, spent_at_end = child.stdout.readline().split()
        return end, time.monotonic() - begin, max(0.0, float(spent_at_end) - spent)
