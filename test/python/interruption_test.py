#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C and events while the library computes. That a call ends within 0.2 s is a requirement; the bound here is wide and of processor time, for machines with
other work."""
import os
import signal
import subprocess
import sys
import threading
import unittest

from fixture import FREE, LONG, PATIENCE, PENDULUM, SWING, wait_for_computing
from interruption import CALLS, WITH_EVENT, latency

import mechanism_codesign as codesign

MOST = 2.0  # [s]; the calls last minutes, the preparation of identify() alone some seconds on a slow machine


class Interruption(unittest.TestCase):
    def test_each_call_ends_by_ctrl_c(self):
        for call in CALLS:
            for after in (0.1, 0.5):
                with self.subTest(call, after=after):
                    end, seconds, of_processor = latency(call, after)
                    print(f"{call} ended {seconds:.3f} s, {of_processor:.2f} s of the processor, after SIGINT at {after} s", file=sys.stderr)
                    self.assertEqual(end, "interrupted")
                    self.assertLess(of_processor, MOST)

    def test_a_job_ends_by_its_event(self):
        for call in WITH_EVENT:
            for after in (0.1, 0.5):
                with self.subTest(call, after=after):
                    end, seconds, of_processor = latency(call, after, by_event=True)
                    print(f"{call} ended {seconds:.3f} s, {of_processor:.2f} s of the processor, after its event at {after} s", file=sys.stderr)
                    self.assertEqual(end, "cancelled")
                    self.assertLess(of_processor, MOST)

    def test_a_thread_does_not_keep_the_program(self):
        program = f"""
import os, threading
import mechanism_codesign as codesign
problem = codesign.Problem({FREE!r}, {LONG!r})
thread = threading.Thread(target=problem.gradient, daemon=True)
thread.start()
try:
    print("ready", flush=True)
    thread.join()
except KeyboardInterrupt:
    print("interrupted", flush=True)
    os._exit(0)
"""
        with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as child:
            self.assertEqual(child.stdout.readline(), "ready\n")
            child.send_signal(signal.SIGINT)
            self.assertEqual(child.communicate(timeout=PATIENCE)[0], "interrupted\n")

    def test_a_thread_that_computes_while_the_interpreter_ends_leaves_it_alone(self):
        """Python ends a thread that asks for its lock now: in the middle of C++ that would end the process with an error."""
        program = f"""
import threading
import mechanism_codesign as codesign
problem = codesign.Problem({PENDULUM!r}, {SWING!r})
def again():
    while True:
        problem.optimize(progress=lambda *told: None)
for _ in range(4):
    threading.Thread(target=again, daemon=True).start()
problem.gradient()
"""
        for _ in range(10):
            child = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=PATIENCE, check=False)
            self.assertEqual((child.returncode, child.stderr), (0, ""))

    def test_a_handler_that_raises_nothing_ends_the_call_as_cancelled(self):
        seen = []
        before = signal.signal(signal.SIGINT, lambda number, frame: seen.append(number))
        self.addCleanup(signal.signal, signal.SIGINT, before)
        problem = codesign.Problem(FREE, LONG)

        def interrupt():
            wait_for_computing(os.getpid(), 0.3)
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        self.assertEqual(problem.optimize().status.code, "cancelled")
        thread.join()
        self.assertEqual(seen, [signal.SIGINT])
        self.assertIsNotNone(codesign.Problem(PENDULUM, SWING).gradient(), "the next call begins anew")
        os.kill(os.getpid(), signal.SIGINT)
        self.assertEqual(len(seen), 2, "Python's own handler is back")


if __name__ == "__main__":
    unittest.main()
