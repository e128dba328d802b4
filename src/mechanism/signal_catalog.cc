// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/signal_catalog.h"

#include <algorithm>

#include "description/clearance.h"
#include "description/robot.h"
#include "mechanism/signal_axes.h"
#include "mechanism/topology.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

using Names = std::vector<std::string>;

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The quantities of everything that has the name of a signal's object. A link and a joint may have
/// the same name; the quantity then tells them apart.
struct Offer {
  bool exists = false;
  Names scalars;        ///< of a joint, a controller or the mechanism
  Names vectors;        ///< of a joint or a link
  Names quaternions;    ///< of a link
  Names ambiguous;      ///< quantities that both the mechanism and a joint named `mechanism` have
  bool welded = false;  ///< a fixed joint of the tree
  std::string contact;  ///< of a joint with clearance, or one that lets it play: what carries it
};

constexpr const char* kMechanism = "mechanism";

/// Adds the quantities of an owner for which a condition holds.
template <class Condition>
void add_quantities(SignalOwner owner, Condition&& condition, Offer* offer) {
  offer->exists = true;
  for (const SignalFacts& facts : signal_table::kFacts) {
    if (facts.owner != owner || *facts.quantity == '\0' || !condition(facts)) continue;
    Names& names = facts.shape == SignalShape::kScalar   ? offer->scalars
                   : facts.shape == SignalShape::kVector ? offer->vectors
                                                         : offer->quaternions;
    // A power that a joint named `mechanism` has, too.
    const bool is_twice = owner == SignalOwner::kMechanism && contains(names, facts.quantity);
    (is_twice ? offer->ambiguous : names).emplace_back(facts.quantity);
  }
}

Offer offer_of(const std::string& name, const RobotDescription& robot,
               const std::vector<ControllerDescription>& controllers) {
  Offer offer;
  const auto always = [](const SignalFacts&) { return true; };
  for (const JointDescription& joint : robot.joints) {
    if (joint.name != name) continue;
    add_quantities(
        SignalOwner::kJoint, [&](const SignalFacts& facts) { return facts.is_of(joint); }, &offer);
    offer.welded = !is_movable(joint);
    if (has_clearance(robot, joint))
      offer.contact = clearance_contact(name);
    else if (joint.is_play)
      offer.contact = contact_of_play(name);
  }
  for (const ControllerDescription& controller : controllers) {
    if (controller.name != name) continue;
    const auto has = [&](const SignalFacts& facts) {
      if (facts.kind == SignalKind::kControllerOutput) return true;
      if (facts.kind == SignalKind::kObservedDisturbance)
        return controller.observer.has_disturbance;
      const bool is_estimate = facts.kind == SignalKind::kObservedPosition ||
                               facts.kind == SignalKind::kObservedVelocity;
      return is_estimate ? controller.kind->input == ControlInput::kObserved
                         : controller.kind->has_error();
    };
    add_quantities(SignalOwner::kController, has, &offer);
  }
  for (const LinkDescription& link : robot.links)
    if (link.name == name) add_quantities(SignalOwner::kLink, always, &offer);
  for_each_link_element_kind(robot, [&](const LinkElementKind& kind, const auto& elements) {
    for (const auto& element : elements)
      if (element.name == name) add_quantities(kind.owner, always, &offer);
  });
  if (name == kMechanism) add_quantities(SignalOwner::kMechanism, always, &offer);
  return offer;
}

Names all_names(const RobotDescription& robot,
                const std::vector<ControllerDescription>& controllers) {
  Names names;
  for (const JointDescription& joint : robot.joints) names.push_back(joint.name);
  for (const ControllerDescription& controller : controllers) names.push_back(controller.name);
  for (const LinkDescription& link : robot.links) names.push_back(link.name);
  for_each_link_element_kind(robot, [&](const LinkElementKind&, const auto& elements) {
    for (const auto& element : elements) names.push_back(element.name);
  });
  names.emplace_back(kMechanism);
  return names;
}

/// What has signals: "joint, link, spring, contact or controller".
std::string words_of_owners(const RobotDescription& robot) {
  std::string words = "joint, link";
  for_each_link_element_kind(robot, [&words](const LinkElementKind& kind, const auto&) {
    words += std::string(", ") + kind.word;
  });
  return words + " or controller";
}

Names spelled(const std::string& object, const Offer& offer) {
  const std::string prefix = object + "/";
  Names spellings;
  for (const std::string& quantity : offer.scalars) spellings.push_back(prefix + quantity);
  for (const std::string& quantity : offer.vectors)
    spellings.push_back(prefix + quantity + "/{x,y,z}");
  for (const std::string& quantity : offer.quaternions)
    spellings.push_back(prefix + quantity + "/{w,x,y,z}");
  return spellings;
}

std::string spelling(const SignalTerm& term) {
  return term.object + "/" + term.quantity + (term.component.empty() ? "" : "/" + term.component);
}

void check_term(const SignalTerm& term, const Offer& offer, const SourceLocation& where,
                const std::string& element) {
  const bool as_scalar = contains(offer.scalars, term.quantity);
  const bool as_quaternion = contains(offer.quaternions, term.quantity);
  const bool as_vector = contains(offer.vectors, term.quantity) || as_quaternion;
  const bool good_component = term.component == "x" || term.component == "y" ||
                              term.component == "z" || (as_quaternion && term.component == "w");
  if (contains(offer.ambiguous, term.quantity))
    throw InputError(
        {where, element,
         "a joint is named mechanism, so that this could also be the power of the whole mechanism",
         spelling(term), "rename the joint"});
  if (offer.welded && is_reaction(term))
    throw InputError(
        {where, element,
         "the links of a fixed joint form one body, so the reaction between them is not computed",
         spelling(term),
         "a movable joint; or a floating joint and a <loop type=\"fixed\"> in place of the fixed "
         "joint"});
  if (!offer.contact.empty() && is_reaction(term))
    throw InputError({where, element,
                      "a joint with clearance is carried by its contact, not by a reaction",
                      spelling(term), offer.contact + "/normal_force"});
  if (as_scalar && term.component.empty()) return;
  if (as_vector && good_component) return;
  const std::string allowed = list_names(spelled(term.object, offer));
  if (as_vector)
    throw InputError({where, element,
                      std::string("this signal needs the component ") +
                          (as_quaternion ? "w, x, y or z" : "x, y or z"),
                      spelling(term), allowed});
  if (as_scalar)
    throw InputError({where, element, "this signal has no components", spelling(term), allowed});
  Names known = offer.scalars;
  for (const Names* more : {&offer.vectors, &offer.quaternions})
    known.insert(known.end(), more->begin(), more->end());
  InputFault fault =
      unknown_name(where, element, "quantity of \"" + term.object + "\"", term.quantity, known)
          .fault();
  fault.value = spelling(term);
  fault.allowed = allowed;
  throw InputError(fault);
}

}  // namespace

bool is_of_mechanism(const SignalTerm& term) {
  if (term.object != kMechanism) return false;
  const SignalFacts* facts = find_quantity(SignalOwner::kMechanism, term.quantity);
  return facts != nullptr && (facts->shape == SignalShape::kScalar) == term.component.empty();
}

std::optional<LinkElement> find_link_element(const SignalTerm& term,
                                             const RobotDescription& robot) {
  std::optional<LinkElement> found;
  for_each_link_element_kind(robot, [&](const LinkElementKind& kind, const auto& elements) {
    if (found || find_quantity(kind.owner, term.quantity) == nullptr) return;
    const auto element = std::find_if(elements.begin(), elements.end(),
                                      [&](const auto& one) { return one.name == term.object; });
    if (element != elements.end())
      found = LinkElement{kind.owner, static_cast<int>(element - elements.begin())};
  });
  return found;
}

bool is_reaction(const SignalTerm& term) {
  const SignalFacts* facts = find_quantity(SignalOwner::kJoint, term.quantity);
  return facts != nullptr && facts->shape == SignalShape::kVector;
}

void check_signal(const SignalDescription& signal, const RobotDescription& robot,
                  const std::vector<ControllerDescription>& controllers,
                  const std::string& element) {
  for (const SignalTerm& term : signal.terms) {
    const Offer offer = offer_of(term.object, robot, controllers);
    if (!offer.exists)
      throw unknown_name(signal.where, element, words_of_owners(robot), term.object,
                         all_names(robot, controllers));
    check_term(term, offer, signal.where, element);
  }
  check_axes(signal, robot, element);
}

std::vector<std::string> default_signals(const RobotDescription& robot,
                                         const std::vector<ControllerDescription>& controllers) {
  const std::vector<int> pairs = derive_topology(robot).joint_pair;
  Names signals;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const JointDescription& joint = robot.joints[i];
    if (!joint.has_one_coordinate() || pairs[i] < 0) continue;
    signals.push_back(joint.name + "/position");
    signals.push_back(joint.name + "/velocity");
  }
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const JointDescription& joint = robot.joints[i];
    // Without dynamics of its own, as a tool's frame has none, a joint has no friction to read.
    if (!has_friction(joint) || pairs[i] < 0) continue;
    signals.push_back(joint.name + "/friction");
    if (has_normal_force(joint)) signals.push_back(joint.name + "/normal_force");
    signals.push_back(joint.name + "/sliding_velocity");
    if (!has_gear_loss(joint)) continue;
    signals.push_back(joint.name + "/gear_loss");
    if (has_gear_torque(joint)) signals.push_back(joint.name + "/gear_torque");
  }
  for (const ContactDescription& contact : robot.contacts)
    for (const char* quantity : {"/gap", "/normal_force"})
      signals.push_back(contact.name + quantity);
  for (const ControllerDescription& controller : controllers)
    signals.push_back(controller.name + "/output");
  return signals;
}

std::vector<SignalDescription> signals_of(const MotionStudy& study) {
  std::vector<SignalDescription> signals;
  const auto add = [&signals](const SignalDescription& signal) {
    const auto is_same = [&signal](const SignalDescription& other) {
      return other.text == signal.text;
    };
    if (!signal.terms.empty() && std::none_of(signals.begin(), signals.end(), is_same))
      signals.push_back(signal);
  };
  for (const std::vector<ObjectiveTerm>* terms : {&study.integral, &study.terminal})
    for (const ObjectiveTerm& term : *terms) add(term.signal);
  for (const WatchedSignal& watched : study.watched) add(watched.signal);
  for (const ControllerDescription& controller : study.controllers) {
    add(controller.input);
    for (const FeedbackTerm& term : controller.feedback) add(term.signal);
  }
  return signals;
}

}  // namespace codesign
