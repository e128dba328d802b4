// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/command_inputs.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "fuzz/damage.h"
#include "fuzz/language_seeds.h"
#include "fuzz/mutation.h"
#include "paths.h"

namespace codesign::fuzz {
namespace {

std::string read(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Makes the runs short: the errors that are looked for occur before a run and at its end.
std::string cut_short(std::string study) {
  study = std::regex_replace(study, std::regex("(^|\n)duration: *[0-9.e-]+"), "$1duration: 0.02");
  study = std::regex_replace(
      study, std::regex("(max_evaluations|samples|screen|validate): *[0-9]+"), "$1: 3");
  return std::regex_replace(study, std::regex("starts: *[0-9]+"), "starts: 2");
}

/// Runs, uncertain parameters and many starts, of the shipped studies and of none.
const std::vector<std::string>& ensembles() {
  static const std::vector<std::string> kEnsembles = {
      "runs: {one: {}, two: {weight: 2.0, gravity: [0, 0, -1]}}\n",
      "runs: {slow: {controllers: {crank_speed: {setpoint: -5.0}}}}\nrobust: {measure: "
      "mean_plus_deviation, factor: 1.0, failed: tail}\n",
      "runs: {short: {set: {crank_length: 0.07}, initial_state: {crank_joint: {velocity: "
      "-9.0}}}}\nengine: {type: serial}\n",
      "uncertain: {friction_law: {choice: [brown_mcphee, gonthier, lugre]}}\nrobust: {measure: "
      "worst, samples: 3, validate: 2}\n",
      "uncertain: {mu_static: {normal: [0.3, 0.1], between: [0.0, 0.5]}}\nrobust: {measure: cvar, "
      "level: 0.5, samples: 4, sampler: "
      "random}\n",
      "uncertain: {crank_length: {uniform: [0.07, 0.09]}, rod_length: {choice: [0.29, "
      "0.3]}}\nrobust: {samples: 2, seed: 7, failed: "
      "tail}\n",
      "multistart: {starts: 2, screen: 3, sampler: latin_hypercube, seed: 3, cluster: "
      "1.0e-2}\nengine: {type: threads, workers: 2}\n"};
  return kEnsembles;
}

/// Designs as results have them.
const std::vector<std::string>& results() {
  static const std::vector<std::string> kResults = {
      "{\n  \"version\": \"0.1.0\",\n  \"objective\": 1.5,\n  \"parameters\": {\n    "
      "\"crank_length\": 0.07,\n    \"Kp\": 2.0\n  }\n}\n",
      "{\"parameters\": {}, \"gradient\": {\"Kp\": [1.0, null]}, \"warnings\": [{\"code\": \"a\", "
      "\"line\": 3}]}",
      "{\"parameters\": {\"Kp\": 1e999, \"crank_length\": [[[[]]]]}}"};
  return kResults;
}

const char* const kOverlay =
    R"(<robot name="overlay" xmlns:codesign="http://ros.org/wiki/mechanism_codesign">
  <joint name="NAME">
    <dynamics damping="0.01" friction="0.02"/>
  </joint>
</robot>
)";

/// An overlay that damps the first joint of a model.
std::string overlay_for(const std::string& urdf) {
  std::smatch joint;
  if (!std::regex_search(
          urdf, joint,
          std::regex("<joint name=\"([^\"]*)\" type=\"(revolute|continuous|prismatic)\"")))
    return "";
  return std::regex_replace(std::string(kOverlay), std::regex("NAME"), joint[1].str());
}

const std::vector<std::string>& odd_words() {
  static const std::vector<std::string> kWords = {"check",
                                                  "simulate",
                                                  "gradient",
                                                  "optimize",
                                                  "help",
                                                  "--json",
                                                  "--verify",
                                                  "--verify=ridders",
                                                  "--samples",
                                                  "2",
                                                  "7",
                                                  "0",
                                                  "-1",
                                                  "1e9",
                                                  "2147483648",
                                                  "--set",
                                                  "a=1",
                                                  "crank_length=0.07",
                                                  "crank_length=nan",
                                                  "=",
                                                  "--csv",
                                                  "/dev/full",
                                                  "/dev/null",
                                                  ".",
                                                  "",
                                                  "--output",
                                                  "out",
                                                  "model.urdf",
                                                  "study.yaml",
                                                  "--signals",
                                                  "a/b,,c",
                                                  "--overlay",
                                                  "overlay.urdf",
                                                  "--nosuch",
                                                  "-h",
                                                  "--set=Kp=3",
                                                  "--json=1",
                                                  "\xff",
                                                  "nosuch.urdf",
                                                  "--"};
  return kWords;
}

std::vector<std::string> random_command(const Seed& seed, Dice* dice, bool with_overlay) {
  static const std::vector<std::vector<std::string>> kCommands = {
      {"check"},    {"simulate", "--samples", "5"}, {"gradient"}, {"gradient", "--verify"},
      {"optimize"}, {"optimize", "--output", "out"}};
  std::vector<std::string> words =
      dice->pick(seed.commands.empty() || dice->one_in(4) ? kCommands : seed.commands);
  words.insert(words.end(), {"model.urdf", "study.yaml", "--json"});
  if (with_overlay) words.insert(words.end(), {"--overlay", "overlay.urdf"});
  if (dice->one_in(8)) words.insert(words.end(), {"--csv", "run.csv"});
  return words;
}

void change_words(std::vector<std::string>* words, Dice* dice) {
  const std::size_t at = dice->below(words->size() + 1);
  switch (dice->below(3)) {
    case 0:
      words->insert(words->begin() + static_cast<std::ptrdiff_t>(at), dice->pick(odd_words()));
      break;
    case 1:
      if (at < words->size()) words->erase(words->begin() + static_cast<std::ptrdiff_t>(at));
      break;
    default:
      if (at < words->size()) (*words)[at] = dice->pick(odd_words());
  }
  if (words->empty()) words->emplace_back("check");
}

/// A table is changed as text, a bag as bytes.
void change_recording(std::string* content, Dice* dice) {
  *content =
      content->rfind("#ROSBAG", 0) == 0 ? damage(*content, dice) : mutate_text(*content, dice);
}

/// Replaces one of the expressions by a random one.
std::string change_expression(const std::string& text, Dice* dice) {
  std::vector<std::size_t> places;
  for (std::size_t at = text.find("${"); at != std::string::npos; at = text.find("${", at + 2))
    places.push_back(at + 2);
  if (places.empty()) return text;
  const std::size_t at = dice->pick(places), end = std::min(text.find('}', at), text.size());
  const std::string present = text.substr(at, end - at);
  return text.substr(0, at) +
         random_expression({"(" + present + ")", "crank_length", "Kp"}, 4, dice) + text.substr(end);
}

}  // namespace

std::vector<Seed> shipped_seeds() {
  std::vector<Seed> seeds;
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() + "/urdf")) {
    const std::string name = entry.path().stem().string();
    const std::filesystem::path study = source_dir() + "/config/" + name + ".yaml";
    const bool needs_overlay =
        std::filesystem::exists(source_dir() + "/urdf/overlays/" + name + ".urdf");
    if (entry.path().extension() != ".urdf" || !std::filesystem::exists(study) || needs_overlay)
      continue;
    Seed seed{name, read(entry.path()), cut_short(read(study)), ""};
    seed.overlay = overlay_for(seed.urdf);
    seeds.push_back(std::move(seed));
  }
  std::sort(seeds.begin(), seeds.end(),
            [](const Seed& a, const Seed& b) { return a.name < b.name; });
  for (Seed& seed : language_seeds()) seeds.push_back(std::move(seed));
  return seeds;
}

Input random_input(const std::vector<Seed>& seeds, Dice* dice) {
  const Seed& seed = dice->pick(seeds);
  const bool with_overlay = !seed.overlay.empty() && dice->one_in(4);
  Input input;
  input.arguments = random_command(seed, dice, with_overlay);
  input.files = {{"model.urdf", seed.urdf}, {"study.yaml", seed.study}};
  if (with_overlay) input.files["overlay.urdf"] = seed.overlay;
  input.files.insert(seed.files.begin(), seed.files.end());
  if (dice->one_in(5)) input.files["study.yaml"] += dice->pick(ensembles());
  for (std::size_t changes = 1 + dice->below(3); changes > 0; --changes) {
    const std::string name = with_overlay && dice->one_in(2) ? "overlay.urdf"
                             : dice->one_in(2)               ? "model.urdf"
                                                             : "study.yaml";
    std::string& text = input.files[name];
    const std::size_t kind = dice->below(10);
    if (kind == 0)
      change_words(&input.arguments, dice);
    else if (kind == 1)
      text = change_expression(text, dice);
    else
      text = name != "study.yaml" && kind < 6 ? mutate_xml(text, dice) : mutate_text(text, dice);
  }
  if (dice->one_in(10)) {
    input.files["result.json"] = mutate_text(dice->pick(results()), dice);
    input.arguments.insert(input.arguments.end(), {"--result", "result.json"});
  }
  if (!seed.files.empty() && dice->one_in(2))
    change_recording(&input.files[seed.files.begin()->first], dice);
  if (dice->one_in(25)) input.disk = static_cast<long>(dice->below(20000));
  return input;
}

}  // namespace codesign::fuzz
