# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The longest wait of a test for anything; test/patience.h has that of C++."""
import time

# Of what takes a second on an idle machine, one that is a hundred times slower has it within this time. It is less than a test may take as a whole.
PATIENCE = 120.0  # [s]


def wait_until(condition, what, pause=0.02):
    """Until the condition is true, which is asked every `pause` [s]."""
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, what
        time.sleep(pause)
