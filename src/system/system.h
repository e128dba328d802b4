// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SYSTEM_SYSTEM_H_
#define MECHANISM_CODESIGN_SYSTEM_SYSTEM_H_

#include <vector>

#include "control/controller.h"
#include "control/signal.h"
#include "description/robot.h"
#include "description/study.h"
#include "forces/bristle_law.h"
#include "mechanism/topology.h"
#include "system/reaction_sharing.h"
#include "system/state.h"

namespace codesign {

/// One objective term, weight (signal - reference)^2.
struct ResolvedTerm {
  Signal signal;
  int description = 0;  ///< index into Study::integral or Study::terminal
};

/// Friction or any other load that depends on a joint's own motion.
struct JointLoad {
  int pair = -1, element = -1;
  bool reaction_friction = false;  ///< an annotated friction law acts on this coordinate
  bool constant_friction = false;  ///< `<dynamics friction>`
  bool passive = false;            ///< damping or a torsion spring
  bool spring = false;             ///< a torsion spring, which depends on the position
  bool stop = false;               ///< `<limit lower upper>` as stops
  bool saturated = false;          ///< `<limit effort>` bounds what the controllers apply
  std::vector<int> controllers;    ///< that drive this coordinate
  std::vector<int> constant;       ///< indices into Study::loads

  bool needs_position() const { return spring || stop; }
};

/// A spinning rotor, theory (9a).
struct Rotor {
  int pair = -1, element = -1;  ///< of the joint that it drives
  int body = -1;                ///< that carries it; -1: the ground
};

/// A constant wrench on a link, theory (13g).
struct LinkLoad {
  int load = -1;  ///< index into Study::loads
  int body = -1, link = -1;
  bool turns = false;  ///< its components turn with the link
};

/// A mechanism and a study with every name resolved: the layout of the unknowns, and the loads, controllers and signals that act on them.
/// Immutable. It knows which equations there are; the elements know what they say.
class System {
 public:
  /// @param sharing what becomes of redundant constraints; none by default. theory (23).
  /// @throws InputError for what cannot be compiled.
  System(const RobotDescription& robot, const Study& study, ReactionSharing sharing = {});
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  const RobotDescription& robot() const { return robot_; }
  const Study& study() const { return study_; }
  const Topology& topology() const { return topology_; }
  const Layout& layout() const { return layout_; }
  const std::vector<Controller>& controllers() const { return controllers_; }
  const std::vector<JointLoad>& loads() const { return loads_; }
  const std::vector<LinkLoad>& link_loads() const { return link_loads_; }
  const std::vector<Rotor>& rotors() const { return rotors_; }
  /// Pairs with isotropic friction.
  const std::vector<int>& contacts() const { return contacts_; }
  /// Contacts whose friction law has states.
  const std::vector<BristleContact>& bristles() const { return bristles_; }
  /// The states of the friction law of a joint coordinate, or of a contact (element -1); null if the law has no states.
  const BristleContact* bristle(int pair, int element) const;
  const std::vector<ResolvedTerm>& integral() const { return integral_; }
  const std::vector<ResolvedTerm>& terminal() const { return terminal_; }

  const ReactionSharing& sharing() const { return sharing_; }
  const SharingLayout& sharing_layout() const { return sharing_layout_; }
  double compliance() const { return sharing_.compliance; }

  /// @throws InputError if a signal reads a coordinate that has no closed form (of a joint in a folded chain), or an integral that nobody
  /// computes.
  void check_readable(const Signal& signal, const SignalDescription& description) const;

  /// Start values of all named parameters.
  std::vector<double> parameters() const;
  /// All named parameters, the tuned ones at `rho` (order of Study::tuned), the others at their start values.
  std::vector<double> parameters(const Eigen::VectorXd& rho) const;

 private:
  void lay_out();
  void resolve_controllers();
  void check_signals() const;
  void collect_loads();
  void collect_link_loads();
  void collect_rotors();
  void collect_bristles();
  void add_bristle(int pair, int element, int size);
  void find_coordinates();
  void refuse_load(int pair, int element) const;
  void check_couplings() const;
  void resolve_objective();
  void refuse_unsupported() const;

  RobotDescription robot_;
  Study study_;
  Topology topology_;
  Layout layout_;
  ReactionSharing sharing_;
  SharingLayout sharing_layout_;
  std::vector<Controller> controllers_;
  std::vector<JointLoad> loads_;
  std::vector<LinkLoad> link_loads_;
  std::vector<Rotor> rotors_;
  std::vector<int> contacts_;
  std::vector<BristleContact> bristles_;
  std::vector<std::vector<bool>> has_coordinate_;  ///< per pair and chain element
  std::vector<ResolvedTerm> integral_, terminal_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SYSTEM_SYSTEM_H_
