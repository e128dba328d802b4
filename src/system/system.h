// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/controller.h"
#include "control/signal.h"
#include "description/motion_study.h"
#include "description/robot.h"
#include "forces/bristles.h"
#include "mechanism/topology.h"
#include "system/joint_load.h"
#include "system/reaction_sharing.h"
#include "system/state.h"

namespace codesign {

struct Study;

/// The signal and the loss of one objective term, weight rho(signal - reference); theory (21).
struct ResolvedTerm {
  Signal signal;
  int description = 0;  ///< index into Study::integral or Study::terminal
  LossKind loss = LossKind::kSquare;
};

/// A gear whose motor moves by itself, theory (9c): the coordinates of its joint and of its motor.
struct ElasticGear {
  CoordinateIndex joint, motor;
};

/// The winding of a joint's motor, theory (9d).
struct Winding {
  int pair = -1, element = -1;  ///< coordinate of the motor, System::motor_of()
  std::string joint;            ///< name of the joint that it moves
  /// whether it determines the effort; else the motion is given, and the effort the current
  bool acts = false;
  std::vector<int> controllers;  ///< whose outputs add up to the voltage
  int state = -1;                ///< of the current among the extra states; -1: L = 0
  int start = -1;  ///< index in MotionStudy::initial_state with a current; -1: it starts at 0
};

/// Friction whose bristles hold its joint at the start; theory (13h).
struct StuckContact {
  std::size_t bristle = 0;  ///< index in System::bristles()
  std::size_t start = 0;    ///< index in MotionStudy::initial_state
};

/// The rotor of an actuator, theory (9a), or an armature, (9e).
struct Rotor {
  int pair = -1, element = -1;  ///< coordinate of the joint that it drives
  int body = -1;                ///< body that carries it; -1: the ground, or none
  bool is_armature = false;     ///< an inertia of the coordinate alone
};

/// The expressions of signals of a load with their names resolved; empty for functions of time.
struct LoadSignals {
  Signal effort;
  std::array<Signal, 3> force, torque;
};

/// A load on a link, theory (13g).
struct LinkLoad {
  int load = -1;             ///< index into Study::loads
  int body = -1, link = -1;  ///< the link and the body that it is part of
  bool turns = false;        ///< whether force and torque turn with the link
};

/// A mechanism and a study with every name resolved to an index, the same for all designs:
/// topology, layout of the unknowns, loads, controllers and signals. It determines the equations;
/// the elements (src/elements) evaluate them. Immutable and thread-safe.
class System {
 public:
  /// @param sharing how redundant constraints are treated, theory (23); by default there are none.
  /// @param drives joints (indices in `robot`) whose motion is prescribed from outside: each gets a
  /// row after the rows of the couplings and of the motions that the study gives, theory (28).
  /// @throws InputError for a mechanism without moving mass, loads or actuators on joints without a
  /// coordinate of their own, and signals, controllers or couplings that cannot be resolved.
  System(const RobotDescription& robot, const Study& study, ReactionSharing sharing = {},
         const std::vector<int>& drives = {});
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  /// The coordinates that `solver: {coordinates: auto}` stands for: joint coordinates where they
  /// are possible. A system whose study still says `auto` has absolute coordinates; make_system()
  /// chooses.
  CoordinatesKind best_coordinates() const;

  /// The model, with the study's start rotations of floating joints and the joints of
  /// with_motor_sides().
  const RobotDescription& robot() const { return robot_; }
  /// What the equations read of the study; and all of it.
  const MotionStudy& study() const { return *motion_; }
  const Study& whole_study() const { return *study_; }
  const Topology& topology() const { return topology_; }
  const Layout& layout() const { return layout_; }
  const std::vector<Controller>& controllers() const { return controllers_; }
  /// Row of Phi of the k-th drive.
  int drive_row(int k) const { return layout_.coupling_row(layout_.couplings - drives_ + k); }
  /// Whether a controller has states that do not begin at zero, theory (50), (51).
  bool begins_controllers() const;
  /// One entry per joint coordinate on which anything acts.
  const std::vector<JointLoad>& loads() const { return loads_; }
  const std::vector<LinkLoad>& link_loads() const { return link_loads_; }
  /// One entry per entry of Study::loads.
  const std::vector<LoadSignals>& load_signals() const { return load_signals_; }
  /// Whether an expression of signals contains the time.
  bool reads_time() const { return reads_time_; }
  const std::vector<Rotor>& rotors() const { return rotors_; }
  const std::vector<ElasticGear>& elastic_gears() const { return elastic_gears_; }
  const std::vector<Winding>& windings() const { return windings_; }
  /// The coordinate of the motor that moves a joint's coordinate: behind an elastic gear that of
  /// the motor, else the joint's own.
  CoordinateIndex motor_of(int pair, int element) const;
  /// Indices of the pairs with isotropic friction, theory (13a).
  const std::vector<int>& contacts() const { return contacts_; }
  /// The coordinates and contacts whose friction law has states, theory (13e), (13f).
  const std::vector<BristleContact>& bristles() const { return bristles_; }
  /// Those that start stuck, in the order of MotionStudy::initial_state; of one joint the bearing
  /// before the gear.
  const std::vector<StuckContact>& stuck() const { return stuck_; }
  /// Whether the k-th of bristles() starts in steady sliding, theory (13j): neither stuck nor with
  /// states that the study gives.
  bool begins_steadily(std::size_t k) const;
  /// Whether one of them does.
  bool begins_bristles() const;
  /// The states of the friction law of a joint coordinate, of its gear, or of a contact (element
  /// -1); null if the law has no states.
  const BristleContact* bristle(int pair, int element, bool gear = false) const;
  /// The friction law of a pair with Pair::friction_joint.
  const FrictionLaw& friction_law(int pair) const;
  /// The law of the flanks of a coordinate's gear, theory (9b).
  const FrictionLaw& gear_law(int pair, int element) const;
  /// The terms of the integrand and the terminal terms of the objective, theory (21).
  const std::vector<ResolvedTerm>& integral() const { return integral_; }
  const std::vector<ResolvedTerm>& terminal() const { return terminal_; }
  /// The signals of Study::watched, theory (21a).
  const std::vector<Signal>& watched() const { return watched_; }
  /// The condition of Study::until, 1 where it holds; null without one.
  const Signal* until() const { return until_ ? &*until_ : nullptr; }

  /// Redundant constraints, theory (23): how they are treated, the places of the unknowns, and
  /// epsilon [1/kg] (zero without redundancy).
  const ReactionSharing& sharing() const { return sharing_; }
  const SharingLayout& sharing_layout() const { return sharing_layout_; }
  const std::vector<int>& dropped_rows() const {
    return dropped_rows_;
  }  ///< rows of Phi, ascending
  double compliance() const { return sharing_.compliance; }

  /// @throws InputError if a signal reads the coordinate of a joint in a folded chain that has no
  /// closed form, or the integral of a controller without one. @param description of the signal,
  /// for the message.
  void check_readable(const Signal& signal, const SignalDescription& description) const;

  /// Start values of all named parameters, order of Study::parameters.
  std::vector<double> parameters() const;
  /// All named parameters, the tuned ones at `rho` (order of Study::tuned), the others at their
  /// start values.
  std::vector<double> parameters(const Eigen::VectorXd& rho) const;

 private:
  void add_drives(const std::vector<int>& drives);
  void choose_forest();
  std::vector<const SignalDescription*> controller_inputs() const;
  const SignalDescription* mechanism_friction() const;
  std::vector<bool> cut_pairs() const;
  void lay_out();
  void lay_out_bodies();
  void resolve_controllers();
  void check_signals() const;
  void check_effort_rate(const SignalReference& term, const SignalDescription& description) const;
  void collect_elastic_gears();
  void collect_windings();
  void add_elastic_gear(JointLoad* load) const;
  void add_loads_of(const JointDescription& joint, bool slips_in_contact, int* unknowns,
                    JointLoad* load) const;
  void add_efforts(const JointDescription* joint, JointLoad* load) const;
  void collect_loads();
  void collect_link_loads();
  void collect_rotors();
  void add_rotor(int joint, int body, bool is_armature);
  void collect_bristles();
  void add_bristle(BristleContact contact);
  void collect_stuck();
  void find_coordinates();
  void refuse_load(int pair, int element) const;
  void check_couplings() const;
  void resolve_objective();
  void resolve_load_signals();
  Signal resolve_named(const SignalDescription& signal);
  void refuse_unsupported() const;

  RobotDescription robot_;
  std::shared_ptr<const Study> study_;
  const MotionStudy* motion_;
  Topology topology_;
  int drives_ = 0;  ///< the last ones of Topology::couplings
  Layout layout_;
  ReactionSharing sharing_;
  SharingLayout sharing_layout_;
  std::vector<int> dropped_rows_;
  std::vector<Controller> controllers_;
  std::vector<JointLoad> loads_;
  std::vector<LinkLoad> link_loads_;
  std::vector<LoadSignals> load_signals_;
  bool reads_time_ = false;
  std::vector<Rotor> rotors_;
  std::vector<ElasticGear> elastic_gears_;
  std::vector<Winding> windings_;
  std::vector<int> contacts_;
  std::vector<BristleContact> bristles_;
  std::vector<StuckContact> stuck_;
  std::vector<std::vector<bool>> has_coordinate_;  ///< per pair and chain element
  std::vector<ResolvedTerm> integral_, terminal_;
  std::vector<Signal> watched_;
  std::optional<Signal> until_;
};

}  // namespace codesign
