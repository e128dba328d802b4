// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/console.h"

namespace codesign::cli {

/// The commands of the program. Each returns kDone or kFailed. @throws InputError for bad input,
/// OutputError for output that cannot be written.
int check(const Arguments& arguments, const Console& console);
int simulate(const Arguments& arguments, const Console& console);
int efforts(const Arguments& arguments, const Console& console);
int equilibrium(const Arguments& arguments, const Console& console);
int linearize(const Arguments& arguments, const Console& console);
int urdf(const Arguments& arguments, const Console& console);
int overlay(const Arguments& arguments, const Console& console);
int gradient(const Arguments& arguments, const Console& console);
int optimize(const Arguments& arguments, const Console& console);
int tradeoff(const Arguments& arguments, const Console& console);
int identify(const Arguments& arguments, const Console& console);
int excite(const Arguments& arguments, const Console& console);

/// Copies model and study of a machine of the gallery into a new folder and prints the next
/// commands; without arguments it lists the machines. @param gallery its folder. @throws InputError
/// also for a machine that the gallery does not have, and for a folder that exists.
int start_project(const Arguments& arguments, const std::string& gallery, const Console& console);

/// Runs the program and reports every error. @param words the command line without the program's
/// name. @returns the exit code, an ExitCode.
int run(const std::vector<std::string>& words, const Console& console);

}  // namespace codesign::cli
