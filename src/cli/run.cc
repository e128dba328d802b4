// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "cli/arguments.h"
#include "cli/command_help.h"
#include "cli/commands.h"
#include "cli/hand_over.h"
#include "cli/report.h"
#include "jobs/files.h"
#include "mechanism_codesign/error.h"
#include "mechanism_codesign/version.h"

namespace codesign::cli {
namespace {

int dispatch(const Arguments& arguments, const Console& console) {
  if (arguments.command == "check") return check(arguments, console);
  if (arguments.command == "urdf") return urdf(arguments, console);
  if (arguments.command == "overlay") return overlay(arguments, console);
  if (arguments.command == "simulate") return simulate(arguments, console);
  if (arguments.command == "efforts") return efforts(arguments, console);
  if (arguments.command == "equilibrium") return equilibrium(arguments, console);
  if (arguments.command == "linearize") return linearize(arguments, console);
  if (arguments.command == "gradient") return gradient(arguments, console);
  if (arguments.command == "optimize") return optimize(arguments, console);
  if (arguments.command == "tradeoff") return tradeoff(arguments, console);
  if (arguments.command == "identify") return identify(arguments, console);
  if (arguments.command == "excite") return excite(arguments, console);
  if (arguments.command == "new") {
    const std::filesystem::path program = own_path();
    const std::string gallery = find_gallery(program.parent_path().string());
    if (gallery.empty())
      throw std::runtime_error("the gallery of this package is not installed beside " +
                               program.string() + "; the Debian package and devel/ have it");
    return start_project(arguments, gallery, console);
  }
  if (arguments.command == "version")
    console.out << "codesign " << version() << '\n';
  else
    console.out << usage(arguments.topic);
  return kDone;
}

int report(bool json, const Json& error, const Console& console, int code) {
  console.err << "codesign: " << error["message"].get<std::string>() << std::endl;
  if (json) print({{"error", error}}, console.out);
  return code;
}

int run_command(const std::vector<std::string>& words, const Console& console) {
  const bool json = std::find(words.begin(), words.end(), "--json") != words.end();
  try {
    // A script makes the report, and reads its own command line.
    if (!words.empty() && words[0] == "report")
      return hand_over("report", {words.begin() + 1, words.end()});
    // A program of its own, since `apply` needs ROS, and this program is not linked with ROS.
    if (!words.empty() && words[0] == "apply") become("apply", {words.begin() + 1, words.end()});
    return dispatch(parse_arguments(words), console);
  } catch (const UsageError& error) {
    console.err << usage(words.empty() ? "" : words[0]) << '\n';
    return report(json, {{"code", "bad_usage"}, {"message", error.what()}}, console, kBadInput);
  } catch (const InputError& error) {
    return report(json, to_json(error), console, kBadInput);
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string path = error.path1().string();
    return report(json,
                  to_json(InputError({{path, 0},
                                      "",
                                      "this path cannot be used: " + error.code().message(),
                                      path,
                                      "a path that this system takes"})),
                  console, kBadInput);
  } catch (const OutputError& error) {
    return report(json, {{"code", "output_failed"}, {"message", error.what()}}, console, kFailed);
  } catch (const std::exception& error) {
    return report(json, {{"code", "failed"}, {"message", error.what()}}, console, kFailed);
  }
}

}  // namespace

int run(const std::vector<std::string>& words, const Console& console) {
  const int code = run_command(words, console);
  errno = 0;
  console.out.flush();
  if (console.out) return code;
  console.err << "codesign: " << OutputError::of_system("standard output", errno).what()
              << std::endl;
  return code == kDone ? kFailed : code;
}

}  // namespace codesign::cli
