// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace codesign::cli {

/// The path of a script of this package, found from the folder of a program: in an installation the
/// folder `share/mechanism_codesign/scripts` beside it, in a build the folder that
/// `share/mechanism_codesign/scripts.path` names. Empty if there is none.
std::string find_script(const std::string& name, const std::string& program_folder);

/// The path of the gallery, a folder beside that of the scripts; empty if there is none.
std::string find_gallery(const std::string& program_folder);

/// The path of this program, without links.
std::string own_path();

/// Runs a script of this package with `words` and waits for it. The script finds this program by
/// the environment variable CODESIGN.
/// @returns the exit code of the script, or kFailed if a signal ended it. @throws
/// std::runtime_error if the script cannot be started.
int hand_over(const std::string& script, const std::vector<std::string>& words);

/// The path of another program of this package, in the folder of this one; empty if it does not
/// exist, as in a build without ROS.
std::string find_program(const std::string& name, const std::string& program_folder);

/// Replaces this process by another program of this package with the arguments `words`, so that
/// signals reach that program. @throws std::runtime_error if it cannot be started.
[[noreturn]] void become(const std::string& program, const std::vector<std::string>& words);

}  // namespace codesign::cli
