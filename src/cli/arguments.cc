// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/arguments.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <map>
#include <optional>

#include "text/nearest_name.h"

namespace codesign::cli {
namespace {

using Names = std::vector<std::string>;

/// An option of the command line. A required value is the next word or follows `=`, as in `--set x=1` and `--set=x=1`; an optional one must
/// follow `=`.
struct Option {
  enum class Value { kNone, kOptional, kRequired };
  Value value = Value::kRequired;
  Names commands;  ///< commands that have the option; empty: all
  std::function<void(const std::string&, Arguments*)> apply;
};

template <class T>
T number_of(const std::string& option, const std::string& text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) throw UsageError(option + ": \"" + text + "\" is not a number");
  return value;
}

void add_setting(const std::string& text, Arguments* arguments) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw UsageError("--set: expected PARAMETER=VALUE, not \"" + text + "\"");
  arguments->settings.emplace_back(text.substr(0, equals), number_of<double>("--set", text.substr(equals + 1)));
}

void add_signals(const std::string& text, Arguments* arguments) {
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t comma = std::min(text.find(',', first), text.size());
    if (comma == first) throw UsageError("--signals: an empty name in \"" + text + "\"");
    arguments->signals.push_back(text.substr(first, comma - first));
    first = comma + 1;
  }
}

void set_samples(const std::string& text, Arguments* arguments) {
  arguments->samples = number_of<int>("--samples", text);
  if (arguments->samples < 2) throw UsageError("--samples: " + text + " is less than 2");
}

void set_method(const std::string& text, Arguments* arguments) {
  arguments->verify = true;
  arguments->each_parameter = !text.empty();
  if (text == "ridders")
    arguments->method = CheckMethod::kRidders;
  else if (!text.empty() && text != "complex_step")
    throw UsageError("--verify: \"" + text + "\" is neither complex_step nor ridders");
}

void set_folder(const std::string& path, bool resume, Arguments* arguments) {
  if (!arguments->output.empty() && arguments->output != path)
    throw UsageError("--output and --resume: \"" + arguments->output + "\" and \"" + path + "\" are two folders, a job has one");
  arguments->output = path;
  arguments->resume = arguments->resume || resume;
}

const std::map<std::string, Option>& options() {
  using Value = Option::Value;
  static const std::map<std::string, Option> kOptions = {
      {"--overlay", {Value::kRequired, {}, [](const std::string& text, Arguments* to) { to->overlays.push_back(text); }}},
      {"--set", {Value::kRequired, {}, add_setting}},
      {"--result", {Value::kRequired, {}, [](const std::string& text, Arguments* to) { to->result = text; }}},
      {"--json", {Value::kNone, {}, [](const std::string&, Arguments* to) { to->json = true; }}},
      {"--quiet", {Value::kNone, {}, [](const std::string&, Arguments* to) { to->quiet = true; }}},
      {"--sticks", {Value::kNone, {"urdf"}, [](const std::string&, Arguments* to) { to->sticks = true; }}},
      {"--signals", {Value::kRequired, {"simulate"}, add_signals}},
      {"--csv", {Value::kRequired, {"simulate"}, [](const std::string& text, Arguments* to) { to->csv = text; }}},
      {"--samples", {Value::kRequired, {"simulate"}, set_samples}},
      {"--verify", {Value::kOptional, {"gradient"}, set_method}},
      {"--output",
       {Value::kRequired, {"optimize", "identify", "excite"}, [](const std::string& text, Arguments* to) { set_folder(text, false, to); }}},
      {"--resume", {Value::kRequired, {"optimize"}, [](const std::string& text, Arguments* to) { set_folder(text, true, to); }}},
  };
  return kOptions;
}

[[noreturn]] void fail_unknown(const std::string& kind, const std::string& word, const Names& known) {
  const std::string near = nearest_name(word, known);
  throw UsageError("unknown " + kind + " \"" + word + "\"" + did_you_mean(near));
}

const Option& find_option(const std::string& name, const std::string& command) {
  Names known;
  for (const auto& [option_name, option] : options()) {
    const bool fits = option.commands.empty() || std::count(option.commands.begin(), option.commands.end(), command) > 0;
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
  else if (arguments->study.empty())
    arguments->study = word;
  else
    throw UsageError("unexpected \"" + word + "\" after model and study");
}

bool asks_for_help(const Names& words) {
  return words[0] == "help" || std::count(words.begin(), words.end(), "--help") > 0 || std::count(words.begin(), words.end(), "-h") > 0;
}

}  // namespace

Arguments parse_arguments(const std::vector<std::string>& words) {
  const Names commands = {"check", "urdf", "simulate", "gradient", "optimize", "identify", "excite", "report", "apply", "help"};
  Arguments arguments;
  if (words.empty()) throw UsageError("no command given");
  arguments.command = asks_for_help(words) ? "help" : words[0];
  if (arguments.command == "help") {
    // The command before `--help`, or the word after `help`.
    arguments.topic = words[0] == "help" && words.size() > 1 ? words[1] : words[0];
    if (arguments.topic.rfind('-', 0) == 0 || arguments.topic == "help") arguments.topic.clear();
    if (!arguments.topic.empty() && std::count(commands.begin(), commands.end(), arguments.topic) == 0)
      fail_unknown("command", arguments.topic, commands);
    return arguments;
  }
  if (words[0] == "--version") {
    arguments.command = "version";
    return arguments;
  }
  if (std::count(commands.begin(), commands.end(), arguments.command) == 0) fail_unknown("command", arguments.command, commands);
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i].empty()) throw UsageError("an empty argument");
    if (words[i][0] == '-')
      i = apply_option(words, i, &arguments);
    else
      take_positional(words[i], &arguments);
  }
  if (arguments.model.empty()) throw UsageError("\"" + arguments.command + "\" needs a MODEL");
  if (arguments.study.empty() && arguments.command != "check" && arguments.command != "urdf")
    throw UsageError("\"" + arguments.command + "\" needs a STUDY");
  return arguments;
}

}  // namespace codesign::cli
