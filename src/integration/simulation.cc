// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/simulation.h"

#include <algorithm>
#include <limits>

#include "assembly/assembly.h"
#include "equations/compiled_system.h"
#include "equations/formulas.h"
#include "integration/contact_watch.h"
#include "integration/event_names.h"
#include "integration/integrator.h"
#include "integration/run_ends.h"
#include "integration/simulation_of.h"
#include "integration/stop_watch.h"
#include "math/cpu_timer.h"
#include "observation/observer.h"
#include "problem/load_problem.h"
#include "text/cancel.h"

namespace codesign {
namespace {

std::vector<SignalDescription> parse_signals(const std::vector<std::string>& texts) {
  std::vector<SignalDescription> signals;
  signals.reserve(texts.size());
  for (const std::string& text : texts) signals.push_back(parse_signal(text, {}, "signal"));
  return signals;
}

}  // namespace

class Simulation::Implementation {
 public:
  Implementation(std::shared_ptr<const CompiledSystem> system,
                 const std::vector<double>& parameters,
                 const std::vector<SignalDescription>& signals)
      : system_(std::move(system)),
        parameters_(parameters),
        observer_(*system_, signals),
        integrator_(make_integrator(*system_)),
        stops_(*system_),
        contacts_(*system_) {
    for (StepWatch* const watch : std::initializer_list<StepWatch*>{&stops_, &contacts_})
      if (watch->has_work()) watches_.push_back(watch);
    sample_.resize(system_->layout());
  }

  Status start() {
    const CpuTimer timer;
    const Status status = integrator_->start(parameters_);
    for (StepWatch* const watch : watches_) watch->start();
    statistics_ = integrator_->statistics();
    statistics_.cpu_seconds += timer.seconds();
    return status;
  }

  // The integrator gets an end that its last step must hit: the study's duration, so that the state
  // at the end is not interpolated. Beyond the duration the end is set one duration ahead.
  Status advance(double time) {
    const CpuTimer timer;
    const double duration = integrator_->end();
    Status status;
    while (status.ok() && is_before(time)) {
      const double now = integrator_->state().t;
      status = step(now < duration && time <= duration ? duration : std::max(time, now) + duration);
    }
    keep_statistics(timer);
    return status;
  }

  Status advance_to(double time) {
    const CpuTimer timer;
    Status status;
    while (status.ok() && is_before(time)) status = step(time);
    keep_statistics(timer);
    return status;
  }

  Status go_on(double time, const std::vector<double>& parameters) {
    const CpuTimer timer;
    const Status status = integrator_->go_on(time, parameters);
    if (status.ok()) parameters_ = parameters;
    keep_statistics(timer);
    return status;
  }

  // Interpolated accelerations and multipliers have a lower order than q, v and s, so they are
  // solved for again from these.
  void sample(double time, Frame* frame) {
    double psi = 0.0;
    if (integrator_->is_ended()) time = std::min(time, integrator_->state().t);
    integrator_->interpolate(time, &sample_, &psi);
    if (integrator_->state().t > 0.0)
      integrator_->assembly().rates().solve(&integrator_->equations(), &sample_);
    psi = integrator_->of_losses(psi);
    observer_.observe(sample_, psi, integrator_->assembly().theta(), &integrator_->equations(),
                      frame);
  }

  double objective() {
    sample_ = integrator_->state();
    // The rates of a multistep method do not fulfil the equations.
    if (system_->study().solver.integrator == IntegratorKind::kIdas)
      integrator_->assembly().rates().solve(&integrator_->equations(), &sample_);
    return integrator_->of_losses(integrator_->psi(), integrator_->equations().terminal(sample_));
  }
  double time() const { return integrator_->state().t; }
  double end() const { return integrator_->end(); }
  bool has_ended() const { return integrator_->is_ended(); }
  bool may_end() const { return system_->until() != nullptr; }
  bool has_moving_end() const { return codesign::has_moving_end(system_->study()); }

  void obey(const std::atomic<bool>* cancel) { integrator_->obey(cancel); }
  const FrameNames& names() const { return observer_.names(); }
  const Statistics& statistics() const { return statistics_; }
  const std::vector<MethodChange>& methods() const { return integrator_->methods(); }
  Events events() const { return events_of(*system_, integrator_->events()); }
  std::int64_t event_count() const { return integrator_->events().count(); }
  const std::vector<StopExcess>& stops() const { return stops_.excesses(); }
  const Warnings& warnings() const {
    warnings_ = integrator_->warnings();
    for (const StepWatch* const watch : watches_) append(watch->warnings(), &warnings_);
    return warnings_;
  }

 private:
  Status step(double limit) {
    Status status = integrator_->advance(limit);
    if (!status.ok() || watches_.empty()) return status;
    const State<double>& state = integrator_->state();
    Formulas<double>& formulas = integrator_->equations().formulas();
    formulas.load(state);
    for (StepWatch* const watch : watches_) watch->look(formulas, state.t);
    return status;
  }
  /// Rounding may leave the end of a step, or an instant of a controller, a last bit before `time`.
  bool is_before(double time) const {
    return !integrator_->is_ended() &&
           time - integrator_->state().t > 1e-12 * std::max(time, 1e-3 * system_->study().duration);
  }
  void keep_statistics(const CpuTimer& timer) {
    const double cpu = statistics_.cpu_seconds + timer.seconds();
    statistics_ = integrator_->statistics();
    statistics_.cpu_seconds = cpu;
  }

  std::shared_ptr<const CompiledSystem> system_;
  std::vector<double> parameters_;
  Observer observer_;
  std::unique_ptr<Integrator> integrator_;
  StopWatch stops_;
  ContactWatch contacts_;
  std::vector<StepWatch*> watches_;  ///< those of these that have work
  State<double> sample_;
  Statistics statistics_;
  mutable Warnings warnings_;
};

struct SimulationMaker {
  static Simulation make(std::shared_ptr<const CompiledSystem> system,
                         const std::vector<double>& parameters,
                         const std::vector<SignalDescription>& signals) {
    return Simulation(
        std::make_unique<Simulation::Implementation>(std::move(system), parameters, signals));
  }
};

Simulation simulation_of(std::shared_ptr<const CompiledSystem> system,
                         const std::vector<double>& parameters,
                         const std::vector<SignalDescription>& signals) {
  return SimulationMaker::make(std::move(system), parameters, signals);
}

Simulation::Simulation(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
Simulation::Simulation(const Problem& problem, const std::vector<double>& parameters,
                       const std::vector<std::string>& signals)
    : Simulation(std::make_unique<Implementation>(system_of(problem), parameters,
                                                  parse_signals(signals))) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

Status Simulation::start() { return implementation_->start(); }
Status Simulation::advance(double time) { return implementation_->advance(time); }
Status Simulation::advance_to(double time) { return implementation_->advance_to(time); }
Status Simulation::go_on(double time, const std::vector<double>& parameters) {
  return implementation_->go_on(time, parameters);
}
void Simulation::sample(double time, Frame* frame) { implementation_->sample(time, frame); }
double Simulation::objective() { return implementation_->objective(); }
double Simulation::time() const { return implementation_->time(); }
double Simulation::end() const { return implementation_->end(); }
bool Simulation::has_ended() const { return implementation_->has_ended(); }
bool Simulation::may_end() const { return implementation_->may_end(); }
bool Simulation::has_moving_end() const { return implementation_->has_moving_end(); }
void Simulation::obey(const std::atomic<bool>* cancel) { implementation_->obey(cancel); }
const FrameNames& Simulation::names() const { return implementation_->names(); }
const Statistics& Simulation::statistics() const { return implementation_->statistics(); }
const std::vector<MethodChange>& Simulation::methods() const { return implementation_->methods(); }
Events Simulation::events() const { return implementation_->events(); }
std::int64_t Simulation::event_count() const { return implementation_->event_count(); }
const std::vector<StopExcess>& Simulation::stops() const { return implementation_->stops(); }
const Warnings& Simulation::warnings() const { return implementation_->warnings(); }

// Where a run ends by its condition, only the run tells: it is computed once more for the samples.
Status find_end(Simulation* simulation, double* end) {
  if (simulation->has_moving_end()) *end = std::min(*end, simulation->end());
  if (!simulation->may_end()) return {};
  if (Status status = simulation->advance(*end); !status.ok()) return status;
  if (simulation->has_ended()) *end = std::min(*end, simulation->time());
  return simulation->start();
}

Status simulate(Simulation* simulation, double duration, int count, const FrameObserver& observer,
                const std::atomic<bool>* cancel) {
  Frame frame;
  simulation->obey(cancel);
  Status status = simulation->start();
  double end = duration;
  if (status.ok()) status = find_end(simulation, &end);
  for (int k = 0; status.ok() && k < count; ++k) {
    const double time = count > 1 ? end * k / (count - 1) : 0.0;
    status = simulation->advance(time);
    if (!status.ok()) break;
    simulation->sample(time, &frame);
    if (is_set(cancel)) return {StatusCode::kCancelled, time, "cancelled"};
    if (std::string fault = find_not_finite(simulation->names(), frame); !fault.empty())
      return {StatusCode::kNonFinite, time, fault};
    if (!observer(frame)) return {StatusCode::kCancelled, time, "cancelled"};
  }
  return status;
}

}  // namespace codesign
