# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The page of `codesign report`: what a job has left in its folder, as one HTML file."""
