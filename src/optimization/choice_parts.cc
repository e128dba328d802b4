// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/choice_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "description/study.h"
#include "description/tuned_parameters.h"
#include "math/arrays.h"

namespace codesign {
namespace {

double range(const ChoiceSpace& space, const ChoiceList& list, std::size_t column) {
  const Parameter& p = space.study.parameters[to_index(list.choice->parameters[column])];
  return p.upper > p.lower ? p.upper - p.lower : 1.0;
}

double distance(const ChoiceSpace& space, const ChoiceList& list, std::size_t row,
                const Eigen::VectorXd& rho) {
  double largest = 0.0;
  for (std::size_t c = 0; c < list.places.size(); ++c)
    largest = std::max(
        largest, std::abs(list.choice->rows[row][c] - rho[list.places[c]]) / range(space, list, c));
  return largest;
}

/// The column in which rows spread most, and the value after which they are divided.
std::pair<std::size_t, double> cut_of(const ChoiceSpace& space, const ChoiceList& list,
                                      const std::vector<std::size_t>& rows,
                                      const Eigen::VectorXd& rho) {
  std::size_t column = 0;
  double widest = -1.0;
  std::vector<double> values;
  for (std::size_t c = 0; c < list.places.size(); ++c) {
    std::vector<double> of;
    of.reserve(rows.size());
    for (const std::size_t row : rows) of.push_back(list.choice->rows[row][c]);
    std::sort(of.begin(), of.end());
    const double spread = (of.back() - of.front()) / range(space, list, c);
    if (spread > widest) column = c, widest = spread, values = std::move(of);
  }
  values.erase(std::unique(values.begin(), values.end()), values.end());
  const double value = rho[list.places[column]];
  std::size_t k = 0;
  while (k + 2 < values.size() && values[k + 1] <= value) ++k;
  return {column, values[k]};
}

}  // namespace

std::vector<ChoiceList> choice_lists(const Study& study) {
  std::vector<ChoiceList> lists;
  for (const ParameterChoice& choice : study.choices)
    if (std::vector<Eigen::Index> places = places_of(choice, study); !places.empty())
      lists.push_back({&choice, std::move(places)});
  return lists;
}

ChoicePart all_rows(const ChoiceSpace& space) {
  ChoicePart part;
  for (const ChoiceList& list : space.lists) {
    std::vector<std::size_t>& rows = part.emplace_back();
    for (std::size_t k = 0; k < list.choice->rows.size(); ++k) rows.push_back(k);
  }
  return part;
}

bool is_single(const ChoicePart& part) {
  return std::all_of(part.begin(), part.end(), [](const auto& rows) { return rows.size() == 1; });
}

ChoicePart nearest_rows(const ChoiceSpace& space, const ChoicePart& part,
                        const Eigen::VectorXd& rho) {
  ChoicePart result;
  for (std::size_t k = 0; k < space.lists.size(); ++k) {
    std::size_t nearest = part[k].front();
    for (const std::size_t row : part[k])
      if (distance(space, space.lists[k], row, rho) < distance(space, space.lists[k], nearest, rho))
        nearest = row;
    result.push_back({nearest});
  }
  return result;
}

std::vector<ChoicePart> split_part(const ChoiceSpace& space, const ChoicePart& part,
                                   const Eigen::VectorXd& rho) {
  const ChoicePart near = nearest_rows(space, part, rho);
  std::size_t divided = 0;
  double farthest = -1.0;
  for (std::size_t k = 0; k < space.lists.size(); ++k) {
    if (part[k].size() < 2) continue;
    const double away = distance(space, space.lists[k], near[k].front(), rho);
    if (away > farthest) divided = k, farthest = away;
  }
  const ChoiceList& list = space.lists[divided];
  const auto [column, at] = cut_of(space, list, part[divided], rho);
  ChoicePart below = part, above = part;
  below[divided].clear();
  above[divided].clear();
  for (const std::size_t row : part[divided])
    (list.choice->rows[row][column] <= at ? below : above)[divided].push_back(row);
  if (rho[list.places[column]] > at) std::swap(below, above);
  return {below, above};
}

}  // namespace codesign
