// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/linear_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "control/controller.h"
#include "forces/pade.h"
#include "linear/flowing_loop.h"
#include "linear/linear_motion.h"
#include "linear/periodic_loop.h"
#include "linear/sampled_motion.h"
#include "linear/sliding_friction.h"
#include "math/arrays.h"
#include "observation/observer.h"

namespace codesign {
namespace {

/// Shares of the joints in a motion, the largest one 1; zero where they are rounding beside `size`.
std::vector<double> scaled(const Eigen::VectorXcd& rates, double size) {
  constexpr double kRounding = 1e-12;
  std::complex<double> most = 0.0;
  for (Eigen::Index k = 0; k < rates.size(); ++k)
    if (std::abs(rates[k]) > std::abs(most) * (1.0 + 1e-9)) most = rates[k];
  std::vector<double> result;
  result.reserve(to_index(rates.size()));
  for (Eigen::Index k = 0; k < rates.size(); ++k)
    result.push_back(std::abs(most) <= kRounding * size ? 0.0 : (rates[k] / most).real());
  return result;
}

/// "damping, controllers and samples".
std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 == words.size() ? " and " : ", ") + words[k];
  return text;
}

/// Number of extra states of controllers, the first ones.
int controller_states(const System& system) {
  int count = 0;
  for (std::size_t c = 0; c < system.controllers().size(); ++c) {
    const int queued = system.study().controllers[c].realization.queued();
    for (const StatePlace& place : system.controllers()[c].places(queued))
      if (place.first >= 0) count = std::max(count, place.first + place.count);
  }
  return count;
}

/// The state of a system as that of another one with the same bodies and pairs, whose controllers
/// may do without integrals that have no effect.
State<double> carried(const State<double>& state, const System& from, const System& to) {
  State<double> result = state;
  result.s.setZero(to.layout().states);
  const auto carry = [&](int old_place, int new_place, int count) {
    if (old_place >= 0 && new_place >= 0)
      result.s.segment(new_place, count) = state.s.segment(old_place, count);
  };
  for (std::size_t c = 0; c < from.controllers().size(); ++c) {
    const int queued = from.study().controllers[c].realization.queued();
    const std::vector<StatePlace> old_places = from.controllers()[c].places(queued),
                                  new_places = to.controllers()[c].places(queued);
    for (std::size_t k = 0; k < old_places.size(); ++k)
      carry(old_places[k].first, new_places[k].first, old_places[k].count);
  }
  const int old_first = controller_states(from), new_first = controller_states(to);
  carry(old_first, new_first, from.layout().states - old_first);
  const Eigen::Index rates = to.layout().n + to.layout().m;
  result.z.setZero(to.layout().columns());
  result.z.head(rates) = state.z.head(rates);
  return result;
}

/// The order of Pade's approximation of the delay of a controller's inputs; 0: it has none.
int pade_order(const ControllerDescription& controller) {
  int most = 0;
  for (std::size_t input = 0; input < filtered_inputs(controller); ++input) {
    int order = 0;
    for (const FilterDescription& filter : filters_of(controller, input))
      if (is_pade(filter.kind)) order += filter.kind->order;
    most = std::max(most, order);
  }
  return most;
}

class ModelWriter {
 public:
  ModelWriter(const LinearCase& of, const State<double>& state)
      : case_(of),
        study_(with_inputs(bare_study(of), of.parameters, state.t, of.at_rest)),
        controllers_(of.system->study().controllers.size()),
        counted_(counted_robot(of, study_, state)),
        system_(counted_.robot, study_.study, of.system->sharing()),
        motion_(system_, study_),
        pattern_(sample_pattern(study_.study)) {}

  LinearModel write(const State<double>& state, const VectorX<double>& theta) {
    LinearModel model;
    model.duration = study_of_case().duration;
    model.status = case_.at_rest ? motion_.linearize_at_rest(state, case_.integrals)
                                 : motion_.linearize(carried(state, *case_.system, system_));
    if (!model.status.ok()) return model;
    closed_ = pattern_.period > 0.0 ? sampled_motion(&motion_, pattern_) : motion_.flow();
    add_modes(theta, &model);
    if (case_.question.with_loops)
      for (std::size_t c = 0; c < controllers_; ++c)
        if (study_.disturbances[c] >= 0) model.loops.push_back(loop_of(c));
    model.system = without_surplus(closed_);
    return model;
  }

 private:
  const Study& study_of_case() const { return case_.system->whole_study(); }

  void add_modes(const VectorX<double>& theta, LinearModel* model) {
    const Eigen::MatrixXd rates = joint_rates(theta, &model->joints);
    const Eigen::Index f = motion_.motions() / 2;
    const std::vector<Pole> poles = poles_of(closed_);
    // y' = p y, but of a pole at zero, where y alone is left.
    for (const Pole& pole : poles)
      model->modes.push_back({pole, scaled(rates.cast<std::complex<double>>() * pole.vector.head(f),
                                           pole.vector.norm())});
    model->stability = judge(poles, model->duration);
    model->verdict = std::string(name_of(model->stability)) + ": " +
                     decisive_text(poles, model->stability, closed_.period) + "; " + counted();
  }

  /// What the poles contain, and what they do not.
  std::string counted() const {
    std::vector<std::string> in{"damping", "controllers"}, out;
    bool is_rounded = false;
    for (const ControllerDescription& controller : study_of_case().controllers)
      is_rounded = is_rounded || controller.realization.quantization > 0.0;
    if (pattern_.period > 0.0) in.emplace_back("samples");
    const LinearFriction friction =
        case_.at_rest ? case_.question.friction : LinearFriction::kRegularised;
    (friction == LinearFriction::kOff ? out : in)
        .push_back(friction == LinearFriction::kGivenSpeed ? friction_at_speeds() : "friction");
    if (is_rounded) out.emplace_back("quantization");
    for (const ControllerDescription& controller : study_of_case().controllers)
      if (const int order = pade_order(controller); order > 0)
        in.push_back("the delay of " + controller.name + " by Pade's order " +
                     std::to_string(order));
    return listed(in) + " counted" + (out.empty() ? "" : ", " + listed(out) + " not");
  }

  std::string friction_at_speeds() const {
    if (counted_.at_rest.empty()) return "friction at the given speed";
    if (!counted_.has_sliding) return "friction as at rest";
    std::string names;
    for (const std::string& name : counted_.at_rest) names += (names.empty() ? "" : ", ") + name;
    return "friction at the given speed (as at rest: " + names + ")";
  }

  /// The rates of the joints per rate of y.
  Eigen::MatrixXd joint_rates(const VectorX<double>& theta, std::vector<std::string>* joints) {
    Observer observer(system_, {});
    *joints = observer.names().joints;
    const Eigen::MatrixXd& Q = motion_.coordinates().Q;
    Eigen::MatrixXd rates(to_signed(joints->size()), Q.cols());
    State<double> moving = motion_.state();
    Frame frame;
    for (Eigen::Index k = 0; k < Q.cols(); ++k) {
      moving.v = Q.col(k);
      observer.observe(moving, 0.0, theta, &motion_.equations(), &frame);
      for (Eigen::Index joint = 0; joint < rates.rows(); ++joint)
        rates(joint, k) = frame.joints[to_index(joint)].velocity;
    }
    return rates;
  }

  ControllerLoop loop_of(std::size_t c) {
    ControllerLoop loop;
    loop.controller = study_of_case().controllers[c].name;
    const auto take = [&loop](const auto& open) {
      loop.margins = open.margins();
      loop.frequencies = open.grid();
      for (const double w : loop.frequencies) loop.response.push_back(open.at(w));
    };
    if (pattern_.period == 0.0) {
      take(OpenLoop(continuous_loop(c)));
    } else if (pattern_.samples[c] == 0) {
      loop.samples = 0;
      take(FlowingLoop(flowing_loop(c)));
    } else {
      const StateSpace closed = sampled_loop(&motion_, pattern_, static_cast<int>(c));
      loop.samples = pattern_.samples[c];
      loop.samples > 1 ? take(PeriodicLoop(closed)) : take(OpenLoop(closed));
    }
    return loop;
  }

  /// From an effort beside the controller's output, before the lag of its drive, to that output.
  StateSpace continuous_loop(std::size_t c) const {
    const StateSpace& flow = motion_.flow();
    const Eigen::Index row = to_signed(case_.question.outputs.size() + c);
    const Eigen::Index input = study_.disturbances[c];
    StateSpace loop{0.0,    flow.states,       {"disturbance"}, {"output"},
                    flow.A, flow.B.col(input), flow.C.row(row), flow.D.block(row, input, 1, 1)};
    const int lag = system_.controllers()[c].states.lag;
    if (lag < 0) return loop;
    const double time =
        study_of_case().controllers[c].realization.time_constant->at(case_.parameters);
    loop.B.setZero();
    loop.B(motion_.motions() + lag, 0) = 1.0 / time;
    loop.D.setZero();
    return loop;
  }

  /// The same beside sampled controllers.
  ComplexSpace flowing_loop(std::size_t c) {
    const StateSpace flow = continuous_loop(c);
    const Eigen::Index states = flow.A.rows();
    const bool has_lag = system_.controllers()[c].states.lag >= 0;
    const auto jump = [&](const std::vector<ControlEvent>& events) {
      const Eigen::MatrixXd all = motion_.jump(events);
      Eigen::MatrixXcd after = Eigen::MatrixXcd::Zero(all.rows(), states + 1);
      after.leftCols(states).real() = all.leftCols(states);
      if (!has_lag) after.col(states).real() = all.col(states + study_.disturbances[c]);
      return after;
    };
    return {flow.A, flow.B, flow.C, flow.D,
            period_pieces(system_, motion_.motions(), states, pattern_, jump)};
  }

  /// Only the outputs that were asked for, and only the inputs that have an effect.
  StateSpace without_surplus(const StateSpace& all) const {
    StateSpace result = all;
    const Eigen::Index outputs = to_signed(case_.question.outputs.size());
    result.outputs.resize(to_index(outputs));
    result.C.conservativeResize(outputs, Eigen::NoChange);
    result.inputs.clear();
    std::vector<Eigen::Index> kept;
    for (Eigen::Index k = 0; k < all.B.cols(); ++k) {
      const std::string& name = all.inputs[to_index(k)];
      const bool is_rate = name.find("/setpoint_") != std::string::npos;
      if (is_rate && all.B.col(k).isZero(0.0) && all.D.col(k).isZero(0.0)) continue;
      kept.push_back(k);
      result.inputs.push_back(name);
    }
    result.B.resize(all.B.rows(), to_signed(kept.size()));
    result.D.resize(outputs, to_signed(kept.size()));
    for (std::size_t k = 0; k < kept.size(); ++k) {
      result.B.col(to_signed(k)) = all.B.col(kept[k]);
      result.D.col(to_signed(k)) = all.D.col(kept[k]).head(outputs);
    }
    return result;
  }

  const LinearCase& case_;
  const LinearStudy study_;
  const std::size_t controllers_;  ///< of the study, before those that are disturbances
  const CountedRobot counted_;
  const CompiledSystem system_;
  LinearMotion motion_;
  const SamplePattern pattern_;
  StateSpace closed_;
};

}  // namespace

Study bare_study(const LinearCase& of) {
  Study study = of.system->whole_study();
  study.integral.clear();
  study.terminal.clear();
  study.watched.clear();
  study.until.reset();
  for (InitialJointState& initial : study.initial_state) initial.stuck = false;
  const auto watch = [&study](const SignalDescription& signal) {
    WatchedSignal watched;
    watched.signal = signal;
    watched.element = "outputs[" + std::to_string(study.watched.size()) + "]";
    watched.where = signal.where;
    study.watched.push_back(watched);
  };
  for (const SignalDescription& signal : of.question.outputs) watch(signal);
  for (const ControllerDescription& controller : study.controllers)
    watch(parse_signal(controller.name + "/output", controller.where,
                       "controllers." + controller.name));
  return study;
}

LinearModel linear_model(const LinearCase& of, const State<double>& state,
                         const VectorX<double>& theta) {
  return ModelWriter(of, state).write(state, theta);
}

}  // namespace codesign
