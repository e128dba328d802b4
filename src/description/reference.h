// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "description/expression.h"
#include "math/sampled_function.h"
#include "mechanism_codesign/error.h"

namespace codesign {

/// Degree of the B-splines: 1 or 3.
enum class BasisShape { kLinear, kCubic };

/// A shaped input u(t) = sum_k c_k B_k(t) for 0 <= t <= duration; afterwards the last value is
/// held; theory (C8). B_k are B-splines on equal spans whose end knots are repeated, so that u
/// starts at the first coefficient and ends at the last.
struct BasisDescription {
  BasisShape shape = BasisShape::kLinear;
  double duration = 0.0;               ///< [s]
  std::vector<Quantity> coefficients;  ///< c_k, at least degree() + 1 [unit of u]

  int degree() const { return shape == BasisShape::kLinear ? 1 : 3; }
  int count() const { return static_cast<int>(coefficients.size()); }

  /// The interval of time [s] in which coefficient k has influence; its end is infinite for the
  /// last one, which is held.
  std::array<double, 2> support(int k) const;
};

/// The B_k that are not zero at an instant.
struct BasisWeights {
  int first = 0, count = 0;  ///< B_first, ..., B_(first + count - 1)
  /// B_k and its time derivative [1/s]; the first `count` entries
  std::array<double, 4> value{}, rate{};
};

/// The weights at time t [s]; rates are zero after the duration.
BasisWeights basis_weights(const BasisDescription& basis, double t);

/// A function of time that the owner of a run can replace during the run: sum c_k (t - start)^k in
/// the unit of the signal, after the first command. After each change the run must be continued by
/// Integrator::go_on(). Not thread-safe.
struct LiveFunction {
  bool commanded = false;  ///< false: the planned function is in effect
  double start = 0.0;      ///< [s]
  std::array<double, 6> c{};
};

/// The polynomials between way-points: of fifth, third or first degree; kMonotone: of fifth degree,
/// between the values of each two neighbours; theory (C2).
enum class Interpolation { kQuintic, kCubic, kLinear, kMonotone };

/// offset + amplitude sin(2 pi f t + phase); theory (C1).
struct SineDescription {
  Quantity amplitude, phase, offset;  ///< phase [rad]; the others in the unit of the signal
  Quantity frequency{1.0};            ///< f [Hz], or 1/f [s] if `is_period`
  bool is_period = false;
};

/// Way-points that a function of time passes through; theory (C2).
struct WaypointsDescription {
  Interpolation interpolation = Interpolation::kQuintic;
  std::vector<double> times;            ///< [s], ascending
  std::vector<Quantity> positions;      ///< one per time
  std::vector<Quantity> velocities;     ///< one per time, or empty: chosen as theory (C2) says
  std::vector<Quantity> accelerations;  ///< likewise
};

/// scale f(t + delay) - offset, with f through samples; theory (C2a).
struct SampledDescription {
  std::shared_ptr<const SampledFunction> samples;  ///< f
  Quantity scale{1.0}, delay, offset;              ///< delay [s]
};

struct ReferenceDescription;

/// A function that commands set during a run, and the planned function until the first command;
/// both not null.
struct LiveDescription {
  std::shared_ptr<const LiveFunction> function;
  std::shared_ptr<const ReferenceDescription> planned;
};

/// start + the integral of `rate` from 0 to t, for a motion whose velocity is given; theory (C2b).
struct IntegralDescription {
  /// Not null; a constant, a sine, way-points or an expression.
  std::shared_ptr<const ReferenceDescription> rate;
  Quantity start;         ///< value at t = 0
  double duration = 0.0;  ///< of the study [s]: panels of an expression are prepared up to here
};

/// An expression of the time and of parameters; theory (C2c).
struct TimeExpression {
  std::shared_ptr<const Expression> formula;
  /// index of the time t [s] among the names of the formula; the others are parameters
  int time = -1;
  /// Of a formula with kinks or jumps: per dependency the parameter itself, null for the time.
  std::vector<std::shared_ptr<const Expression>> parameters{};
};

/// A prescribed function of time: the setpoint of a controller, the reference of an objective's
/// term, or the motion of a joint. Of the alternatives the one that `kind` names is used.
struct ReferenceDescription {
  enum class Kind { kConstant, kSine, kWaypoints, kSampled, kLive, kIntegral, kExpression };

  // NOLINTNEXTLINE(google-explicit-constructor): a number is a constant reference.
  ReferenceDescription(Quantity value = 0.0) : constant(std::move(value)) {}
  ReferenceDescription(double value) : constant(value) {}  // NOLINT(google-explicit-constructor)

  Kind kind = Kind::kConstant;
  Quantity constant;
  SineDescription sine;
  WaypointsDescription waypoints;
  SampledDescription sampled;  ///< of recorded efforts; studies do not name it
  LiveDescription live;        ///< of commands (CommandInputs); studies do not name it
  IntegralDescription integral;
  TimeExpression expression;
};

/// The time t itself as a function of time.
const ReferenceDescription& clock_function();

/// The address of a joint's trajectory in a trajectory_msgs/JointTrajectory message of a bag, or of
/// a column of a table.
enum class CellDelimiter;

struct TrajectoryAddress {
  std::string bag, topic, joint;
  SourceLocation where;                 ///< the place in the study that names it, for messages
  std::string element;                  ///< likewise
  std::string csv{}, column{}, time{};  ///< of a table: the file, and names of columns
  CellDelimiter delimiter{};            ///< likewise, CellDelimiter::kAuto
};

/// The way-points of one joint of a recorded trajectory: times [s], then one value per time in the
/// joint's units. Velocities and accelerations may be empty.
struct RecordedTrajectory {
  std::vector<double> times, positions, velocities, accelerations;
};

/// Callback that reads a recorded trajectory. The caller provides it, since this library does not
/// depend on ROS, which reads bags.
/// @throws InputError if the trajectory cannot be read.
using TrajectoryLoader = std::function<RecordedTrajectory(const TrajectoryAddress&)>;

/// Indices of the parameters that appear in the numbers of a function of time, ascending, each
/// once.
std::vector<int> dependencies(const ReferenceDescription& description);
std::vector<int> dependencies(const BasisDescription& description);

}  // namespace codesign
