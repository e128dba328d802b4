# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# Completion of the program codesign, in shells that somebody types into.
if [ -n "${PS1-}" ]; then
  . "$CATKIN_ENV_HOOK_WORKSPACE/share/mechanism_codesign/completion/codesign.zsh"
fi
