# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What `rosrun mechanism_codesign panel` consists of."""
