// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>

#include "cli/command_help.h"
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

void set_points(const std::string& text, Arguments* arguments) {
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, arguments->points);
  if (error != std::errc() || last != end || arguments->points < 1)
    throw UsageError("--points: \"" + text + "\" is not a whole number of points");
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
  throw UsageError("--friction must be off, regularised or given_speed, not \"" + text + "\"");
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

std::function<void(const std::string&, Arguments*)> text_into(std::string Arguments::*member) {
  return [member](const std::string& text, Arguments* to) { to->*member = text; };
}

std::function<void(const std::string&, Arguments*)> sets(bool Arguments::*member) {
  return [member](const std::string&, Arguments* to) { to->*member = true; };
}

const std::map<std::string, Option>& options() {
  using Value = Option::Value;
  static const Names kAll = command_names();
  static const Names kOfDesigns = {"check",       "urdf",      "simulate", "efforts",
                                   "equilibrium", "linearize", "gradient", "optimize",
                                   "tradeoff",    "identify",  "excite"};
  static const std::map<std::string, Option> kOptions = {
      {"--overlay",
       {Value::kRequired,
        {},
        [](const std::string& text, Arguments* to) { to->overlays.push_back(text); }}},
      {"--base", {Value::kRequired, {}, set_base}},
      {"--set", {Value::kRequired, kOfDesigns, add_setting}},
      {"--result", {Value::kRequired, kOfDesigns, text_into(&Arguments::result)}},
      {"--json", {Value::kNone, kAll, sets(&Arguments::json)}},
      {"--quiet", {Value::kNone, kAll, sets(&Arguments::quiet)}},
      {"--sticks", {Value::kNone, {"urdf"}, sets(&Arguments::sticks)}},
      {"--fill", {Value::kNone, {"urdf"}, sets(&Arguments::fill)}},
      {"--run",
       {Value::kRequired,
        {"simulate", "efforts", "equilibrium", "linearize", "gradient"},
        text_into(&Arguments::run)}},
      {"--signals",
       {Value::kRequired, {"simulate", "efforts", "equilibrium", "linearize"}, add_signals}},
      {"--friction", {Value::kRequired, {"equilibrium", "linearize"}, set_friction}},
      {"--at", {Value::kRequired, {"linearize"}, set_time}},
      {"--csv",
       {Value::kRequired,
        {"simulate", "efforts", "linearize", "tradeoff"},
        text_into(&Arguments::csv)}},
      {"--points", {Value::kRequired, {"tradeoff"}, set_points}},
      {"--samples", {Value::kRequired, {"simulate", "efforts"}, set_samples}},
      {"--verify", {Value::kOptional, {"gradient"}, set_method}},
      {"--evaluate", {Value::kNone, {"identify"}, sets(&Arguments::evaluate)}},
      {"--compare", {Value::kRequired, {"excite"}, text_into(&Arguments::compare)}},
      {"--against", {Value::kRequired, {"identify"}, text_into(&Arguments::against)}},
      {"--output",
       {Value::kRequired,
        {"optimize", "identify", "excite"},
        [](const std::string& text, Arguments* to) { set_folder(text, false, to); }}},
      {"--resume",
       {Value::kRequired,
        {"optimize"},
        [](const std::string& text, Arguments* to) { set_folder(text, true, to); }}},
      {"--from", {Value::kRequired, {"new"}, text_into(&Arguments::from)}},
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

}  // namespace codesign::cli
