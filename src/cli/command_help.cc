// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/command_help.h"

#include <algorithm>
#include <iterator>

namespace codesign::cli {
namespace {

/// The help of one command: its line with arguments and meaning, then its options.
struct CommandHelp {
  std::string name, text;
};

constexpr const char* kFiles =
    "MODEL is an annotated URDF (doc/annotations.md), STUDY a YAML file (doc/study.md).\n";

const CommandHelp kCommands[] = {
    {"check", R"(  check MODEL [STUDY]      the table of equations, redundant constraints
)"},
    {"urdf",
     R"(  urdf MODEL [STUDY]       the URDF that is simulated: overlays merged, parameters at their values
    --sticks               for viewers: links without <visual>, or whose meshes are not here,
                           get sticks and spheres
    --fill                 first write each plain number that an expression beside it gives
)"},
    {"overlay",
     R"(  overlay MODEL            an overlay to begin with: what a vendor's URDF does not say (base,
                           masses, rotors, gears, friction), with a line for each number to fill in
)"},
    {"simulate", R"(  simulate MODEL STUDY     one run as CSV
    --signals A,B          the signals to print; by default of all joints, frictions, controllers
    --csv FILE             the file to write; by default standard output
    --samples N            number of equally spaced instants, at least 2; by default 101
    --run NAME             one of the study's runs, in place of the study itself
)"},
    {"efforts",
     R"(  efforts MODEL STUDY      the efforts that the set-points of the study need, or the postures of
                           efforts.grid, there with those at which friction gives way; as CSV
    --signals A,B          further signals, such as reactions
    --csv FILE             the file to write; by default standard output
    --samples N            along set-points: number of equally spaced instants; by default 101
    --run NAME             one of the study's runs, in place of the study itself
)"},
    {"equilibrium",
     R"(  equilibrium MODEL STUDY  a posture near the start in which everything rests, and its stability
    --signals A,B          further signals there, such as reactions
    --friction HOW         whether friction counts for its stability: off (default), regularised,
                           with the slope of its law at rest, or given_speed, with that at the
                           speeds with which the study starts
    --run NAME             one of the study's runs, in place of the study itself
)"},
    {"linearize",
     R"(  linearize MODEL STUDY    small motions about the equilibrium: poles, margins of each controller
    --at TIME              about the state of the run at this time [s], in place of the equilibrium
    --signals A,B          the outputs of C and D
    --csv FILE             the frequency response of each controller's open loop
    --friction HOW         whether friction counts about rest: off (default), regularised, with the
                           slope of its law at rest, or given_speed, with that at the speeds with
                           which the study starts
    --run NAME             one of the study's runs, in place of the study itself
)"},
    {"gradient",
     R"(  gradient MODEL STUDY     the objective and its gradient by direct sensitivities
    --verify               compare with a complex step (with idas: Ridders' differences) along one
                           direction; where that disagrees, by each parameter
    --verify=METHOD        compare by each parameter, with complex_step or ridders
    --run NAME             one of the study's runs, in place of the measure over all
)"},
    {"optimize",
     R"(  optimize MODEL STUDY     tune the study's parameters; Ctrl-C ends with the best point so far
    --output DIR           write result.json, tuned.urdf, gains.yaml, tables of both runs and of
                           the search (doc/results.md); best.urdf and best.json while it runs
    --resume DIR           go on with the optimization of DIR/journal.jsonl, killed or cancelled
)"},
    {"tradeoff",
     R"(  tradeoff MODEL STUDY     the curve of best designs between the objectives of the study's tradeoff;
                           Ctrl-C ends with the points so far
    --points N             number of points, by default 11; of three objectives along a side, 5
    --csv FILE             the points as a table
)"},
    {"identify",
     R"(  identify MODEL STUDY     fit parameters to recordings, and tell how well they are known
    --output DIR           write identification.json, identified_overlay.urdf, identified.urdf,
                           residuals.csv and job_study.yaml, the study
    --evaluate             fit nothing: residuals, shares and doubts of the model as it stands
    --against FILE         compare with another identification.json of the same recordings
)"},
    {"excite",
     R"(  excite MODEL STUDY       a motion within all limits, after whose recording identify knows most
    --output DIR           write trajectory.csv, plain.csv, excitation.json; with ROS trajectory.bag
    --compare FILE         judge the trajectory of this table, too: columns time, JOINT/position
)"},
    {"new",
     R"(  new [NAME]               a project of your own, the folder NAME, from a machine of the gallery;
                           without NAME the machines are listed
    --from MACHINE         the machine whose model and study are copied
)"},
    {"report",
     R"(  report DIR|BAG           a page with all that an optimization or identification has found, or
                           with the curves and maps of a file of efforts --json, or the margins,
                           diagrams and poles of a file of linearize --json, or the curve and
                           designs of a file of tradeoff --json
    -o FILE                the page; by default report.html
)"},
    {"apply",
     R"(  apply DIR|BAG            send the gains of an optimization to a running robot, along a ramp, and
                           take them back if it leaves its limits (apply --help; with ROS)
)"},
};

constexpr const char* kOtherCommands =
    R"(  help [COMMAND]           this text, or the options of one command
  --version                the version of this program, as "codesign 0.3.0"
)";

constexpr const char* kSharedOptions =
    R"(  --overlay FILE           annotations to merge into the model; may be repeated
  --base floating          the root link moves freely in space: a drone, a walking robot
  --result FILE            take the design of a result.json; of another study what fits
  --set PARAMETER=VALUE    replace a parameter's value, or the start of a tuned one; may be repeated
  --json                   one JSON object on standard output, with this program's version
  --quiet                  no progress on standard error; warnings and errors stay
)";

constexpr const char* kExitCodes = R"(
exit code: 0 success, 1 a failed run or output that cannot be written, 2 bad input
the codes of failures (error.code in JSON) are listed in doc/statuses.md
)";

}  // namespace

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const CommandHelp& command : kCommands) names.push_back(command.name);
  return names;
}

std::string usage(const std::string& command) {
  const auto one = std::find_if(std::begin(kCommands), std::end(kCommands),
                                [&](const CommandHelp& help) { return help.name == command; });
  if (one != std::end(kCommands)) {
    if (command == "new")
      return "usage: codesign new [NAME --from MACHINE] [--json] [--quiet]\n\n" + one->text;
    if (command == "overlay")
      return "usage: codesign overlay MODEL [--overlay FILE] [--json] [--quiet]\n\n" + one->text +
             "    --overlay FILE         what it gives is not asked for again; may be repeated\n";
    const bool is_for_jobs = command == "report" || command == "apply";
    const std::string head =
        "usage: codesign " + command +
        (is_for_jobs ? " DIR|BAG [OPTIONS]\n\n" : " MODEL [STUDY] [OPTIONS]\n\n");
    return head + one->text +
           (is_for_jobs
                ? ""
                : std::string("\noptions of every command\n") + kSharedOptions + '\n' + kFiles);
  }
  std::string text =
      std::string("usage: codesign COMMAND MODEL [STUDY] [OPTIONS]\n\n") + kFiles + "\ncommands\n";
  for (const CommandHelp& help : kCommands) text += help.text;
  return text + kOtherCommands + "\noptions of every command but new, report and apply\n" +
         kSharedOptions + kExitCodes;
}

}  // namespace codesign::cli
