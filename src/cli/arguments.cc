// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>

#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign::cli {
namespace {

using Names = std::vector<std::string>;

/// An option of the command line. A required value is the next word or follows `=`, as in `--set
/// x=1` and `--set=x=1`; an optional one must follow `=`.
struct Option {
  enum class Value { kNone, kOptional, kRequired };
  Value value = Value::kRequired;
  Names commands;  ///< commands that have the option; empty: all but `new`
  std::function<void(const std::string&, Arguments*)> apply;
};

void add_setting(const std::string& text, Arguments* arguments) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError("--set: expected PARAMETER=VALUE, such as crank_length=0.07, not \"" + text +
                     "\"");
  const std::optional<double> value = parse_number(text.substr(equals + 1));
  if (!value) throw UsageError("--set: \"" + text.substr(equals + 1) + "\" is not a number");
  arguments->settings.emplace_back(text.substr(0, equals), *value);
}

/// The comma after an item of a list; commas in `${max(a, b)}` separate arguments.
std::size_t comma_after(const std::string& text, std::size_t first) {
  int depth = 0;
  for (std::size_t k = first; k < text.size(); ++k) {
    if (text[k] == '{') ++depth;
    if (text[k] == '}') --depth;
    if (text[k] == ',' && depth <= 0) return k;
  }
  return text.size();
}

void add_signals(const std::string& text, Arguments* arguments) {
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t comma = comma_after(text, first);
    if (comma == first)
      throw UsageError(
          "--signals: an empty name in \"" + text +
          "\" (allowed: names with one comma between them, such as pivot/position,pivot/velocity)");
    arguments->signals.push_back(text.substr(first, comma - first));
    first = comma + 1;
  }
}

void set_samples(const std::string& text, Arguments* arguments) {
  const char* const end = text.data() + text.size();
  const auto [last, error] =
      std::from_chars(text.data() + (text.rfind('+', 0) == 0 ? 1 : 0), end, arguments->samples);
  if (error == std::errc::invalid_argument || last != end)
    throw UsageError("--samples: \"" + text + "\" is not a whole number");
  const bool is_out_of_range = error == std::errc::result_out_of_range;
  if (is_out_of_range && text[0] != '-')
    throw UsageError("--samples: " + text + " is out of range (allowed: 2 to " +
                     std::to_string(std::numeric_limits<int>::max()) + ")");
  if (is_out_of_range || arguments->samples < 2)
    throw UsageError("--samples: " + text + " is less than 2, the first and the last instant");
}

void set_method(const std::string& text, Arguments* arguments) {
  arguments->verify = true;
  arguments->each_parameter = !text.empty();
  if (text == "ridders")
    arguments->method = CheckMethod::kRidders;
  else if (!text.empty() && text != "complex_step")
    throw UsageError("--verify: \"" + text + "\" is neither complex_step nor ridders");
}

void set_base(const std::string& text, Arguments* arguments) {
  if (text != "floating")
    throw UsageError("--base: \"" + text +
                     "\" is not floating; without the option the base stands as the study says");
  arguments->floating_base = true;
}

void set_friction(const std::string& text, Arguments* arguments) {
  for (std::size_t k = 0; k < kLinearFrictionNames.size(); ++k)
    if (text == kLinearFrictionNames[k]) {
      arguments->friction = static_cast<LinearFriction>(k);
      return;
    }
  throw UsageError("--friction must be off or regularised, not \"" + text + "\"");
}

void set_time(const std::string& text, Arguments* arguments) {
  const std::optional<double> time = parse_number(text);
  if (!time || !std::isfinite(*time) || *time < 0.0)
    throw UsageError("--at must be a time of the run in seconds, 0 or more, not \"" + text + "\"");
  arguments->time = *time;
}

void set_folder(const std::string& path, bool resume, Arguments* arguments) {
  if (!arguments->output.empty() && arguments->output != path)
    throw UsageError("--output and --resume: \"" + arguments->output + "\" and \"" + path +
                     "\" are two folders, a job has one; leave one of the options out");
  arguments->output = path;
  arguments->resume = arguments->resume || resume;
}

Names command_names();

const std::map<std::string, Option>& options() {
  using Value = Option::Value;
  static const Names kAll = command_names();
  static const Names kOfDesigns = {"check",     "urdf",     "simulate", "efforts",  "equilibrium",
                                   "linearize", "gradient", "optimize", "identify", "excite"};
  static const std::map<std::string, Option> kOptions = {
      {"--overlay",
       {Value::kRequired,
        {},
        [](const std::string& text, Arguments* to) { to->overlays.push_back(text); }}},
      {"--base", {Value::kRequired, {}, set_base}},
      {"--set", {Value::kRequired, kOfDesigns, add_setting}},
      {"--result",
       {Value::kRequired, kOfDesigns,
        [](const std::string& text, Arguments* to) { to->result = text; }}},
      {"--json", {Value::kNone, kAll, [](const std::string&, Arguments* to) { to->json = true; }}},
      {"--quiet",
       {Value::kNone, kAll, [](const std::string&, Arguments* to) { to->quiet = true; }}},
      {"--sticks",
       {Value::kNone, {"urdf"}, [](const std::string&, Arguments* to) { to->sticks = true; }}},
      {"--fill",
       {Value::kNone, {"urdf"}, [](const std::string&, Arguments* to) { to->fill = true; }}},
      {"--run",
       {Value::kRequired,
        {"simulate", "efforts", "equilibrium", "linearize", "gradient"},
        [](const std::string& text, Arguments* to) { to->run = text; }}},
      {"--signals",
       {Value::kRequired, {"simulate", "efforts", "equilibrium", "linearize"}, add_signals}},
      {"--friction", {Value::kRequired, {"equilibrium", "linearize"}, set_friction}},
      {"--at", {Value::kRequired, {"linearize"}, set_time}},
      {"--csv",
       {Value::kRequired,
        {"simulate", "efforts", "linearize"},
        [](const std::string& text, Arguments* to) { to->csv = text; }}},
      {"--samples", {Value::kRequired, {"simulate", "efforts"}, set_samples}},
      {"--verify", {Value::kOptional, {"gradient"}, set_method}},
      {"--output",
       {Value::kRequired,
        {"optimize", "identify", "excite"},
        [](const std::string& text, Arguments* to) { set_folder(text, false, to); }}},
      {"--resume",
       {Value::kRequired,
        {"optimize"},
        [](const std::string& text, Arguments* to) { set_folder(text, true, to); }}},
      {"--from",
       {Value::kRequired,
        {"new"},
        [](const std::string& text, Arguments* to) { to->from = text; }}},
  };
  return kOptions;
}

[[noreturn]] void fail_unknown(const std::string& kind, const std::string& word,
                               const Names& known) {
  const std::string near = nearest_name(word, known);
  throw UsageError("unknown " + kind + " \"" + word + "\"" + did_you_mean(near));
}

const Option& find_option(const std::string& name, const std::string& command) {
  Names known;
  for (const auto& [option_name, option] : options()) {
    const bool fits = option.commands.empty()
                          ? command != "new"
                          : std::count(option.commands.begin(), option.commands.end(), command) > 0;
    if (fits && option_name == name) return option;
    if (fits) known.push_back(option_name);
  }
  if (options().count(name) > 0) throw UsageError("\"" + command + "\" takes no " + name);
  fail_unknown("option", name, known);
}

/// Applies the option at words[i] and returns the index of its last word.
std::size_t apply_option(const Names& words, std::size_t i, Arguments* arguments) {
  const std::size_t equals = words[i].find('=');
  const std::string name = words[i].substr(0, equals);
  const Option& option = find_option(name, arguments->command);
  std::optional<std::string> value;
  if (equals != std::string::npos) value = words[i].substr(equals + 1);
  if (option.value == Option::Value::kNone && value) throw UsageError(name + " takes no value");
  if (option.value == Option::Value::kRequired && !value) {
    if (++i == words.size()) throw UsageError(name + " needs a value");
    value = words[i];
  }
  if (value && value->empty()) throw UsageError(name + " needs a value");
  option.apply(value.value_or(""), arguments);
  return i;
}

void take_positional(const std::string& word, Arguments* arguments) {
  if (arguments->model.empty())
    arguments->model = word;
  else if (arguments->study.empty() && arguments->command != "new" &&
           arguments->command != "overlay")
    arguments->study = word;
  else if (arguments->command == "new")
    throw UsageError(
        "unexpected \"" + word +
        "\" after the name of the folder; a name with spaces stands in quotation marks");
  else if (arguments->command == "overlay")
    throw UsageError(
        "unexpected \"" + word +
        "\" after the model; a starting overlay needs no study, and a path with spaces "
        "stands in quotation marks");
  else
    throw UsageError(
        "unexpected \"" + word +
        "\" after model and study; further URDF files are given by --overlay, and a path with "
        "spaces stands in quotation marks");
}

bool asks_for_help(const Names& words) {
  return words[0] == "help" || std::count(words.begin(), words.end(), "--help") > 0 ||
         std::count(words.begin(), words.end(), "-h") > 0;
}

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
    --friction HOW         whether friction counts for its stability: off (default) or regularised,
                           with the slope of its law at rest
    --run NAME             one of the study's runs, in place of the study itself
)"},
    {"linearize",
     R"(  linearize MODEL STUDY    small motions about the equilibrium: poles, margins of each controller
    --at TIME              about the state of the run at this time [s], in place of the equilibrium
    --signals A,B          the outputs of C and D
    --csv FILE             the frequency response of each controller's open loop
    --friction HOW         whether friction counts about rest: off (default) or regularised
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
    {"identify",
     R"(  identify MODEL STUDY     fit parameters to recordings, and tell how well they are known
    --output DIR           write identification.json, identified_overlay.urdf, identified.urdf,
                           residuals.csv and job_study.yaml, the study
)"},
    {"excite",
     R"(  excite MODEL STUDY       a motion within all limits, after whose recording identify knows most
    --output DIR           write trajectory.csv, plain.csv, excitation.json; with ROS trajectory.bag
)"},
    {"new",
     R"(  new [NAME]               a project of your own, the folder NAME, from a machine of the gallery;
                           without NAME the machines are listed
    --from MACHINE         the machine whose model and study are copied
)"},
    {"report",
     R"(  report DIR|BAG           a page with all that an optimization or identification has found, or
                           with the curves and maps of a file of efforts --json
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

Names command_names() {
  Names names;
  for (const CommandHelp& command : kCommands) names.push_back(command.name);
  return names;
}

constexpr const char* kExitCodes = R"(
exit code: 0 success, 1 a failed run or output that cannot be written, 2 bad input
the codes of failures (error.code in JSON) are listed in doc/statuses.md
)";

}  // namespace

Arguments parse_arguments(const std::vector<std::string>& words) {
  Names commands = command_names();
  commands.push_back("help");
  Arguments arguments;
  if (words.empty()) throw UsageError("no command given (allowed: " + list_names(commands) + ")");
  arguments.command = asks_for_help(words) ? "help" : words[0];
  if (arguments.command == "help") {
    // The command before `--help`, or the word after `help`.
    arguments.topic = words[0] == "help" && words.size() > 1 ? words[1] : words[0];
    if (arguments.topic.rfind('-', 0) == 0 || arguments.topic == "help") arguments.topic.clear();
    if (!arguments.topic.empty() &&
        std::count(commands.begin(), commands.end(), arguments.topic) == 0)
      fail_unknown("command", arguments.topic, commands);
    return arguments;
  }
  if (words[0] == "--version") {
    arguments.command = "version";
    return arguments;
  }
  if (std::count(commands.begin(), commands.end(), arguments.command) == 0)
    fail_unknown("command", arguments.command, commands);
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i].empty())
      throw UsageError("an empty argument; a variable of the shell that is not set gives one");
    if (words[i][0] == '-')
      i = apply_option(words, i, &arguments);
    else
      take_positional(words[i], &arguments);
  }
  if (arguments.command == "new") return arguments;
  if (arguments.model.empty())
    throw UsageError("\"" + arguments.command + "\" needs a MODEL, the path of a URDF file");
  const bool needs_study =
      arguments.command != "check" && arguments.command != "urdf" && arguments.command != "overlay";
  if (arguments.study.empty() && needs_study)
    throw UsageError("\"" + arguments.command +
                     "\" needs a STUDY, the path of a YAML file, after the MODEL");
  return arguments;
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
