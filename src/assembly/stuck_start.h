// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "math/arrays.h"
#include "system/system.h"

namespace codesign {

/// The deflections zeta of all contacts that start stuck, side by side: Newton's method for the
/// condition that no contact begins to slip, and the derivatives of its solution; doc/theory.md
/// (13h).
///
/// A contact holds while |zeta| < F, the largest friction of a contact that has rested; then its
/// slip acceleration a is zero. Beyond that it slides: zeta = F p/|p| with p = zeta + w a, where w
/// > 0 is any weight. Where several contacts hold one motion, the first ones of the study take the
/// load and the others stay unloaded.
class StuckStart {
 public:
  explicit StuckStart(const System& system);

  bool is_empty() const { return contacts_.empty(); }
  /// Number of deflections, and the place of each among the extra states.
  Eigen::Index size() const { return to_signed(states_.size()); }
  int state(Eigen::Index k) const { return states_[to_index(k)]; }

  /// Begins with unloaded contacts that hold.
  void begin();
  /// Sets what the last deflections cause. @param a slip accelerations. @param response
  /// derivatives of `a` by the deflections. @param limits F of each.
  void set_slips(const Eigen::VectorXd& a, const Eigen::MatrixXd& response,
                 const Eigen::VectorXd& limits);
  /// One step of Newton's method from the last set_slips(). @return its largest change of a
  /// deflection, relative to 1 + |zeta|.
  double improve();
  const Eigen::VectorXd& deflections() const { return zeta_; }
  /// The derivatives of the deflections. @param a, limits derivatives of those of set_slips() at
  /// fixed deflections, one column per direction.
  Eigen::MatrixXd derivatives(const Eigen::MatrixXd& a, const Eigen::MatrixXd& limits) const;
  /// The indices in MotionStudy::initial_state of the joints that slide all the same.
  std::vector<std::size_t> sliding() const;

 private:
  struct Contact {
    Eigen::Index first = 0, size = 1;
    std::size_t start = 0;
    bool slides = false;
  };

  Eigen::VectorXd trial(const Contact& contact) const;
  double weight(const Contact& contact) const;
  void change_over();
  void choose();
  Eigen::MatrixXd matrix() const;

  std::vector<Contact> contacts_;
  std::vector<int> states_;
  Eigen::VectorXd zeta_, a_, limits_;
  Eigen::MatrixXd response_;
  std::vector<bool> holds_;  ///< per deflection: whether it is found from a = 0
};

}  // namespace codesign
