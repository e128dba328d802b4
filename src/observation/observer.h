// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "equations/equations.h"
#include "mechanism_codesign/frame.h"
#include "system/tree_kinematics.h"

namespace codesign {

class CompiledSystem;

/// For each link the index of the link that it hangs on, in the order of FrameNames::links; the
/// root hangs on itself.
std::vector<std::size_t> link_parents(const RobotDescription& robot);

/// Fills a Frame from a state: URDF joint positions (massless joints included), link poses,
/// friction, controllers, loop errors, signals. Not thread-safe.
class Observer {
 public:
  /// @param signals the signals of the frames, in order. @param system must outlive this.
  /// @throws InputError for a signal that does not exist.
  Observer(const CompiledSystem& system, const std::vector<SignalDescription>& signals);

  const FrameNames& names() const { return names_; }

  /// @param state with accelerations and multipliers. @param objective integral of the integrand so
  /// far.
  /// @param theta tree joint coordinates of the start; joints below which nothing has mass keep
  /// these positions.
  /// @param equations must hold the design; they load `state`.
  void observe(const State<double>& state, double objective, const VectorX<double>& theta,
               Equations<double>* equations, Frame* frame);

 private:
  struct JointSource {
    int joint = -1, pair = -1,
        element = -1;  ///< pair is -1 for a joint below which nothing has mass
    /// for a joint without a pair: index in joints_ of the joint that it mimics, or -1
    int mimicked = -1;
  };
  /// Element of a FrictionSource: isotropic friction of the whole pair.
  static constexpr int kContact = -2;
  struct FrictionSource {
    int pair = -1, element = -1;
    int contact = -1;  ///< index in RobotDescription::contacts; then there is no pair
  };

  void name_joints();
  void name_frictions();
  void name_links();
  void follow_mimics(const std::vector<double>& parameters, VectorX<double>* positions,
                     Frame* frame) const;
  void observe_frictions(Equations<double>* equations, Frame* frame) const;
  void observe_contact(int index, Equations<double>* equations, FrictionSample* sample) const;
  void observe_touch(int index, Equations<double>* equations, FrictionSample* sample) const;
  void observe_controllers(const State<double>& state, Equations<double>* equations,
                           Frame* frame) const;
  void observe_links(const VectorX<double>& theta, Equations<double>* equations,
                     Frame* frame) const;
  void observe_loops(const State<double>& state, Equations<double>* equations, Frame* frame);

  const CompiledSystem& system_;
  TreeLayout tree_;
  std::vector<Signal> signals_;
  FrameNames names_;
  std::vector<JointSource> joints_;
  std::vector<FrictionSource> frictions_;
  std::vector<int> loops_;  ///< indices of the pairs that close a loop
  VectorX<double> errors_, rates_;
};

}  // namespace codesign
