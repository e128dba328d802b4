// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "description/expression.h"
#include "description/tuned_parameters.h"
#include "math/arrays.h"
#include "math/conditional_normal.h"
#include "reading/study/study_values.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

constexpr const char* kWriter = "a file identification.json, as codesign identify writes it";
constexpr double kAsymmetry = 1e-9;  // of the product of deviations

/// The file as it is read, and which of its numbers are used.
struct IdentifiedFile {
  YamlValue from;  ///< the place in the study
  YamlValue root;
  std::vector<YamlValue> names;
  std::vector<std::size_t> used;  ///< indices of the names that become uncertain
};

YamlValue parse(const YamlValue& file, const FileLoader& files) {
  if (!files) file.fail("no file can be read here", "distributions in the study itself");
  const SourceText source = files({file.text(), file.where(), file.path()});
  YamlValue root = YamlValue::parse(source);
  if (!root.is_map())
    throw InputError(
        {root.where(), file.path(), "this is not the result of an identification", "", kWriter});
  for (const char* key : {"names", "covariance", "identified"})
    if (!root.find(key))
      throw InputError(
          {root.where(), key,
           "the key is missing: this is not the result of an identification that found a point", "",
           kWriter});
  return root;
}

/// The names that stay as they are in the model.
std::set<std::string> read_exceptions(const YamlValue& from,
                                      const std::vector<std::string>& names) {
  std::set<std::string> exceptions;
  if (!from.is_map()) return exceptions;
  from.require_keys({"file"}, {"except"});
  const auto except = from.find("except");
  if (!except) return exceptions;
  for (const YamlValue& item : except->items()) {
    if (std::find(names.begin(), names.end(), item.text()) == names.end())
      throw unknown_name(item.where(), item.path(), "identified number", item.text(), names);
    if (!exceptions.insert(item.text()).second) item.fail("named twice", "each name once");
  }
  return exceptions;
}

/// Numbers of sensors and recordings have names that no parameter can have, as
/// `elbow_joint/offset`.
bool is_no_parameter(const std::string& name) { return !identifier_fault(name).empty(); }

void require_parameter(const YamlValue& name, const Study& study) {
  const std::vector<std::string> known = names_of(study.parameters);
  if (std::find(known.begin(), known.end(), name.text()) == known.end())
    throw unknown_name(name.where(), name.path(), "parameter of the model and the study",
                       name.text(), known);
}

IdentifiedFile select(const YamlValue& from, const Study& study, const std::set<std::string>& own,
                      const FileLoader& files) {
  const YamlValue file = from.is_map() ? from.at("file") : from;
  const YamlValue root = parse(file, files);
  IdentifiedFile result{from, root, root.at("names").items(), {}};
  std::vector<std::string> names;
  for (const YamlValue& name : result.names) {
    if (std::find(names.begin(), names.end(), name.text()) != names.end())
      name.fail("repeated name", "each name once");
    names.push_back(name.text());
  }
  const std::set<std::string> exceptions = read_exceptions(from, names);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const YamlValue entry = root.at("identified").at(names[k]);
    if (is_no_parameter(names[k]) || exceptions.count(names[k]) != 0) continue;
    require_parameter(result.names[k], study);
    const bool is_determined = entry.at("determined").boolean();
    if (is_determined && own.count(names[k]) != 0)
      from.fail(names[k] + " has a distribution of its own in uncertain and one in the file",
                "one of the two, or except: [" + names[k] + "]");
    if (!is_determined && own.count(names[k]) == 0)
      from.fail("the recordings did not determine " + names[k] +
                    ", so that the file has no distribution of it",
                "a distribution of its own beside from, or except: [" + names[k] + "]");
    if (is_determined) result.used.push_back(k);
  }
  if (result.used.empty())
    from.fail("nothing of the file is uncertain", "at least one parameter that was identified");
  return result;
}

Eigen::MatrixXd read_covariance(const IdentifiedFile& file) {
  const YamlValue covariance = file.root.at("covariance");
  const std::vector<YamlValue> rows = covariance.items();
  const std::string size = std::to_string(file.names.size());
  if (rows.size() != file.names.size())
    covariance.fail("there are " + std::to_string(rows.size()) + " rows",
                    "one for each of the " + size + " names");
  const auto used = to_signed(file.used.size());
  Eigen::MatrixXd result(used, used);
  for (Eigen::Index i = 0; i < used; ++i) {
    const YamlValue& row = rows[file.used[to_index(i)]];
    const std::vector<YamlValue> items = row.items();
    if (items.size() != rows.size())
      row.fail("there are " + std::to_string(items.size()) + " numbers in the row", size);
    for (Eigen::Index j = 0; j < used; ++j) result(i, j) = items[file.used[to_index(j)]].number();
  }
  const Eigen::VectorXd deviations = result.diagonal().cwiseMax(0.0).cwiseSqrt();
  if (((result - result.transpose()).array().abs() >
       kAsymmetry * (deviations * deviations.transpose()).array())
          .any())
    covariance.fail("the covariance is not symmetric", "the numbers that codesign identify wrote");
  return result;
}

int index_of(const std::string& name, const Study& study, const YamlValue& from) {
  for (int index : study.tuned)
    if (study.parameters[to_index(index)].name == name)
      from.fail("the study tunes " + name + ", so its value is the search's",
                "except: [" + name + "]");
  return untuned_parameter(name, study, from);
}

UncertainQuantity read_number(const IdentifiedFile& file, std::size_t number, const Study& study) {
  const std::string name = file.names[number].text();
  UncertainQuantity quantity;
  quantity.name = name;
  quantity.where = file.from.where();
  quantity.is_identified = true;
  quantity.parameter = index_of(name, study, file.from);
  const Parameter& parameter = study.parameters[to_index(quantity.parameter)];
  Distribution& distribution = quantity.distribution;
  distribution.kind = DistributionKind::kNormal;
  distribution.mean =
      read_within_bounds(file.root.at("identified").at(name).at("value"), parameter);
  distribution.lower = parameter.lower;
  distribution.upper = parameter.upper;
  return quantity;
}

}  // namespace

std::vector<UncertainQuantity> read_identified(const YamlValue& from, const Study& study,
                                               const std::set<std::string>& own,
                                               const FileLoader& files, std::size_t first) {
  const IdentifiedFile file = select(from, study, own, files);
  const Eigen::MatrixXd covariance = read_covariance(file);
  const std::optional<ConditionalNormal> normal = conditional_normal(covariance);
  if (!normal)
    file.root.at("covariance")
        .fail("no distribution has this covariance", "a positive semidefinite matrix");
  std::vector<UncertainQuantity> quantities;
  for (std::size_t k = 0; k < file.used.size(); ++k) {
    const auto i = to_signed(k);
    UncertainQuantity quantity = read_number(file, file.used[k], study);
    quantity.distribution.deviation = normal->deviations[i];
    quantity.spread = std::sqrt(covariance(i, i));
    for (Eigen::Index j = 0; j < i; ++j)
      if (normal->slopes(i, j) != 0.0)
        quantity.slopes.push_back({first + to_index(j), normal->slopes(i, j)});
    quantities.push_back(std::move(quantity));
  }
  return quantities;
}

}  // namespace codesign
