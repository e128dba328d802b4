// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace codesign {

struct ParameterChoice;
struct Study;

/// A list with the places of its parameters in rho.
struct ChoiceList {
  const ParameterChoice* choice;
  std::vector<Eigen::Index> places;
};

/// The lists of a study that it tunes. @throws InputError if it tunes a part of a list
std::vector<ChoiceList> choice_lists(const Study& study);

/// Both must outlive it.
struct ChoiceSpace {
  const Study& study;
  std::vector<ChoiceList> lists;
};

/// A part of the combinations: of each list rows, ascending, at least one.
using ChoicePart = std::vector<std::vector<std::size_t>>;

ChoicePart all_rows(const ChoiceSpace& space);
/// Whether a part is one combination.
bool is_single(const ChoicePart& part);

/// Of each list of a part the row nearest to a design: the largest difference of a number, over the
/// range of its column in the whole list.
ChoicePart nearest_rows(const ChoiceSpace& space, const ChoicePart& part,
                        const Eigen::VectorXd& rho);

/// Both halves of a part that is no single combination, that in which `rho` lies first: the list
/// whose nearest row is farthest from `rho`, divided between two values of the column that spreads
/// most, beside `rho`.
std::vector<ChoicePart> split_part(const ChoiceSpace& space, const ChoicePart& part,
                                   const Eigen::VectorXd& rho);

}  // namespace codesign
