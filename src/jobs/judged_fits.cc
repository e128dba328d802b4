// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/judged_fits.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "jobs/fit_fields.h"
#include "jobs/record_json.h"
#include "mechanism_codesign/error.h"
#include "text/number_text.h"

namespace codesign {
namespace {

[[noreturn]] void fail(const SourceText& json, const std::string& message) {
  throw InputError({{json.name, 0},
                    "identification",
                    message,
                    "",
                    "identification.json as codesign identify --output or --json writes it"});
}

std::vector<JudgedOutput> outputs_of(const Json& root, const char* set) {
  std::vector<JudgedOutput> outputs;
  if (!root.contains(set)) return outputs;
  for (const auto& [name, output] : root.at(set).at("joints").items())
    outputs.push_back({name, output.at("recorded_rms").get<double>(),
                       output.at("rms").get<double>(), output.at("explained").get<double>()});
  return outputs;
}

/// Of each output that both have: what the other model and this one leave, and explain.
Json pairs(const std::vector<JudgedOutput>& other, const std::vector<JudgedOutput>& here) {
  Json object = Json::object();
  for (const JudgedOutput& left : other)
    for (const JudgedOutput& right : here)
      if (left.name == right.name)
        object[left.name] =
            record_json(JudgedPair{{left.rms, right.rms}, {left.explained, right.explained}});
  return object;
}

std::string output_sentence(const std::string& set, const std::string& name, const Json& output) {
  const auto share = [&output](int k) {
    return readable(100.0 * std::max(0.0, output.at("explained").at(k).get<double>()), 3) + " %";
  };
  return set + ", " + name + ": root mean square of the residuals " +
         readable(output.at("rms").at(0).get<double>()) + " there, " +
         readable(output.at("rms").at(1).get<double>()) + " here; explained " + share(0) + ", " +
         share(1);
}

void append_outputs(const std::string& set, const Json& outputs,
                    std::vector<std::string>* sentences) {
  for (const auto& [name, output] : outputs.items())
    sentences->push_back(output_sentence(set, name, output));
}

std::string nested_sentence(const Json& comparison) {
  const int degrees = comparison.at("degrees").get<int>();
  const std::string further =
      degrees == 1 ? "the further number " : "the " + std::to_string(degrees) + " further numbers ";
  const bool is_here = comparison.at("larger") == "here";
  const double statistic = comparison.at("statistic").get<double>();
  if (statistic < 0.0)
    return std::string("the model with more numbers (") + (is_here ? "here" : "there") +
           ") fits worse, though the other one is among its cases by the names of their numbers: "
           "its fit has not ended at its optimum, or the models differ in more";
  return "the likelihood ratio of " + further + (is_here ? "here" : "there") + " is " +
         readable(statistic) + "; numbers that are not needed reach that with a probability of " +
         readable(comparison.at("probability").get<double>(), 3);
}

}  // namespace

JudgedModel read_judged_model(const SourceText& json) {
  Json root;
  try {
    root = Json::parse(json.text);
  } catch (const Json::exception&) {
    fail(json, "not JSON");
  }
  try {
    JudgedModel model;
    if (root.contains("names")) model.numbers = root.at("names").get<std::vector<std::string>>();
    model.rank = root.value("rank", 0);
    model.inflation = root.at("inflation").get<double>();
    model.is_squares = root.at("loss") == "square";
    model.has_rest_bounds = root.value("rest_bounds", false);
    model.data = outputs_of(root, "data");
    model.holdout = outputs_of(root, "holdout");
    if (!model.data.empty()) model.samples = root.at("data").at("samples").get<std::int64_t>();
    if (model.data.empty() && model.holdout.empty()) fail(json, "no outputs in data or holdout");
    return model;
  } catch (const Json::exception& error) {
    const std::string what = error.what();  // "[json.exception.out_of_range.403] key 'loss' ..."
    fail(json, "no result of codesign identify: " + what.substr(what.find("] ") + 2));
  }
}

Json comparison_json(const SourceText& other, const SourceText& here) {
  const JudgedModel there = read_judged_model(other), model = read_judged_model(here);
  Json object = {{"other", other.name}, {"numbers", {there.numbers.size(), model.numbers.size()}}};
  add_fields(compare_models(there, model), &object);
  object["data"] = pairs(there.data, model.data);
  object["holdout"] = pairs(there.holdout, model.holdout);
  return object;
}

std::vector<std::string> comparison_sentences(const Json& comparison) {
  std::vector<std::string> sentences;
  append_outputs("holdout", comparison.at("holdout"), &sentences);
  append_outputs("data", comparison.at("data"), &sentences);
  if (comparison.contains("refusal")) {
    sentences.push_back("no criterion: " + comparison.at("refusal").get<std::string>());
    return sentences;
  }
  const double criterion = comparison.at("criterion").get<double>();
  sentences.push_back("Akaike's criterion here is " + readable(std::abs(criterion)) +
                      (criterion < 0.0 ? " lower: this model" : " higher: the other model") +
                      " is expected to predict better; variances inflated by " +
                      readable(comparison.at("inflation").get<double>(), 3));
  if (comparison.at("nested").get<bool>()) sentences.push_back(nested_sentence(comparison));
  return sentences;
}

}  // namespace codesign
