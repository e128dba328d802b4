// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/signal_axes.h"

#include <cstring>
#include <optional>
#include <vector>

#include "description/signal_table.h"
#include "math/arrays.h"
#include "mechanism/signal_catalog.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

/// The axes in which a component is told, and its unit. Two with the same `link` and `frame` have
/// the same axes at all times.
struct ComponentAxes {
  int link = -1;     ///< the one nearest to the root with these axes
  int frame = -1;    ///< a loop whose successor's frame is turned against that link; else -1
  std::string name;  ///< of the link, or of that frame, as the user knows it
  const char* unit = "";

  bool is_unlike(const ComponentAxes& other) const {
    return std::strcmp(unit, other.unit) == 0 && (link != other.link || frame != other.frame);
  }
};

int link_named(const RobotDescription& robot, const std::string& name) {
  for (std::size_t k = 0; k < robot.links.size(); ++k)
    if (robot.links[k].name == name) return static_cast<int>(k);
  return -1;
}

const SignalFacts* facts_of_term(const SignalTerm& term) {
  if (term.component.empty()) return nullptr;
  if (is_of_mechanism(term)) return find_quantity(SignalOwner::kMechanism, term.quantity);
  return find_quantity(is_reaction(term) ? SignalOwner::kJoint : SignalOwner::kLink, term.quantity);
}

bool is_unturned(const PoseDescription& pose) {
  for (const Quantity& angle : pose.rpy)
    if (!angle.is_zero()) return false;
  return true;
}

/// The link nearest to the root whose axes are those of `link` at all times: fixed joints and
/// slides between them do not turn it.
int first_with_axes_of(const RobotDescription& robot, int link) {
  for (std::size_t steps = 0; steps < robot.joints.size(); ++steps) {
    int next = -1;
    for (const JointDescription& joint : robot.joints)
      if (!joint.is_loop && joint.child == link && joint.freedoms().turns == 0 &&
          is_unturned(joint.origin))
        next = joint.parent;
    if (next < 0) break;
    link = next;
  }
  return link;
}

/// Nothing of what is no vector.
std::optional<ComponentAxes> told(const SignalTerm& term, const RobotDescription& robot) {
  const SignalFacts* facts = facts_of_term(term);
  if (facts == nullptr || facts->axes == SignalAxes::kNone) return std::nullopt;
  ComponentAxes result;
  result.unit = facts->unit;
  result.link = robot.root;
  if (!term.axes.empty()) {
    result.link = link_of_axes(term, robot);
  } else if (facts->axes == SignalAxes::kOwnLink) {
    result.link = link_named(robot, term.object);
  } else if (facts->axes == SignalAxes::kChildFrame) {
    const int joint = joint_named(robot, term.object);
    result.link = robot.joints[to_index(joint)].child;
    if (!is_unturned(robot.joints[to_index(joint)].child_origin)) result.frame = joint;
  }
  result.name = result.frame >= 0 ? "the frame of '" + term.object + "'"
                                  : "link '" + robot.links[to_index(result.link)].name + "'";
  result.link = first_with_axes_of(robot, result.link);
  return result;
}

/// Finds two components in unlike axes that a formula adds: a value of the stack is told in axes as
/// long as only sums, differences and multiples are made of it.
class FormulaCheck {
 public:
  explicit FormulaCheck(const std::vector<std::optional<ComponentAxes>>& variables)
      : variables_(variables) {}

  /// The unlike ones; null: none.
  const ComponentAxes* first = nullptr;
  const ComponentAxes* second = nullptr;

  void run(const ExpressionSteps& steps) {
    for (const ExpressionStep& step : steps) {
      apply(step);
      if (first != nullptr) return;
    }
  }

 private:
  using Code = ExpressionStep::Code;

  const ComponentAxes* pop() {
    if (stack_.empty()) return nullptr;
    const ComponentAxes* top = stack_.back();
    stack_.pop_back();
    return top;
  }

  void apply(const ExpressionStep& step) {
    switch (step.code) {
      case Code::kConstant:
        return stack_.push_back(nullptr);
      case Code::kVariable: {
        const std::optional<ComponentAxes>& variable = variables_[to_index(step.index)];
        return stack_.push_back(variable ? &*variable : nullptr);
      }
      case Code::kNegate:
        return;
      case Code::kJump:
      case Code::kJumpUnless:
        pop();
        return;
      case Code::kCall:
        for (int k = 0; k < step.count; ++k) pop();
        return stack_.push_back(nullptr);
      default:
        break;
    }
    const ComponentAxes *right = pop(), *left = pop();
    const bool adds = step.code == Code::kAdd || step.code == Code::kSubtract;
    if (adds && left != nullptr && right != nullptr && left->is_unlike(*right)) {
      first = left;
      second = right;
    }
    const bool scales = step.code == Code::kMultiply && (left == nullptr || right == nullptr);
    const bool divides = step.code == Code::kDivide && right == nullptr;
    const ComponentAxes* kept = left != nullptr ? left : right;
    stack_.push_back(adds || scales || divides ? kept : nullptr);
  }

  const std::vector<std::optional<ComponentAxes>>& variables_;
  std::vector<const ComponentAxes*> stack_;
};

std::string spelled(const SignalTerm& term, const char* axes) {
  return term.object + "/" + term.quantity + "/" + term.component + "@" + axes;
}

[[noreturn]] void refuse_sum(const SignalDescription& signal, const ComponentAxes& first,
                             const ComponentAxes& second, const std::string& element) {
  std::string allowed = "all of them in the axes of one link";
  const char* separator = ": ";
  for (const SignalTerm& term : signal.terms) {
    const SignalFacts* facts = facts_of_term(term);
    if (facts == nullptr || std::strcmp(facts->unit, first.unit) != 0) continue;
    allowed += separator + spelled(term, kGroundAxes);
    separator = ", ";
  }
  throw InputError({signal.where, element,
                    "the sum adds components along the axes of " + first.name + " and of " +
                        second.name +
                        ", which are turned against each other, so that it is a component of "
                        "nothing",
                    signal.text, allowed});
}

void check_name(const SignalTerm& term, const RobotDescription& robot,
                const SignalDescription& signal, const std::string& element) {
  const SignalFacts* facts = facts_of_term(term);
  if (facts == nullptr || facts->axes == SignalAxes::kNone)
    throw InputError({signal.where, element,
                      "only vectors are told in the axes of a link: reactions, velocities, "
                      "accelerations, shaking force and moment",
                      signal.text, "the same without @" + term.axes});
  if (link_of_axes(term, robot) >= 0) return;
  std::vector<std::string> names{kGroundAxes};
  for (const LinkDescription& link : robot.links) names.push_back(link.name);
  InputFault fault = unknown_name(signal.where, element, "link", term.axes, names).fault();
  fault.value = signal.text;
  throw InputError(fault);
}

}  // namespace

int link_of_axes(const SignalTerm& term, const RobotDescription& robot) {
  const int link = link_named(robot, term.axes);
  return link < 0 && term.axes == kGroundAxes ? robot.root : link;
}

void check_axes(const SignalDescription& signal, const RobotDescription& robot,
                const std::string& element) {
  std::vector<std::optional<ComponentAxes>> terms;
  for (const SignalTerm& term : signal.terms) {
    if (!term.axes.empty()) check_name(term, robot, signal, element);
    terms.push_back(told(term, robot));
  }
  if (!signal.formula) {
    for (std::size_t k = 0; k < terms.size(); ++k)
      for (std::size_t other = 0; other < k; ++other)
        if (terms[k] && terms[other] && terms[other]->is_unlike(*terms[k]))
          refuse_sum(signal, *terms[other], *terms[k], element);
    return;
  }
  std::vector<std::optional<ComponentAxes>> variables;
  std::size_t next = 0;
  for (const std::string& name : signal.formula->names)
    variables.push_back(name.find('/') != std::string::npos ? terms[next++] : std::nullopt);
  FormulaCheck check(variables);
  check.run(signal.formula->steps);
  if (check.first != nullptr) refuse_sum(signal, *check.first, *check.second, element);
}

}  // namespace codesign
