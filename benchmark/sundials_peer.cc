// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/sundials_peer.h"

#include <idas/idas.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <cmath>
#include <map>
#include <type_traits>

#include "assembly/assembly.h"
#include "benchmark/core_access.h"
#include "integration/idas_handles.h"

namespace codesign {
namespace {

constexpr int kWidth = 8;
using Wide = Lanes<kWidth>;

struct FreeIda {
  void operator()(void* memory) const { IDAFree(&memory); }
};
using Vector = std::unique_ptr<std::remove_pointer_t<N_Vector>, void (*)(N_Vector)>;

/// Where the parts of a state stand among the unknowns (q, v, s, z, psi).
struct Places {
  explicit Places(const Layout& layout)
      : n(layout.n),
        states(layout.states),
        columns(layout.columns()),
        v(n),
        s(2 * n),
        z(s + states),
        psi(z + columns) {}
  int n, states, columns, v, s, z, psi;
  int size() const { return psi + 1; }
};

}  // namespace

class SundialsPeer::Implementation {
 public:
  Implementation(std::shared_ptr<const CompiledSystem> system, SundialsMatrix kind)
      : system_(std::move(system)),
        at_(system_->layout()),
        kind_(kind),
        equations_(*system_),
        wide_(*system_),
        assembly_(*system_),
        derivatives_(*system_) {
    create_context(&context_);
    state_.resize(system_->layout());
    wide_state_.resize(system_->layout());
    equations_.set_design(system_->parameters());
    find_pattern();
  }
  ~Implementation() {
    memory_.reset();
    SUNContext_Free(&context_);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  SundialsResult run(double relative_tolerance, bool with_gradient) {
    SundialsResult result;
    equations_.set_design(system_->parameters());
    State<double> start;
    start.resize(system_->layout());
    if (!assembly_.solve(system_->parameters(), &equations_, &start).ok()) return result;
    const Vector y = new_vector(), yp = new_vector(), id = new_vector();
    fill_start(start, NV_DATA_S(y.get()), NV_DATA_S(yp.get()));
    memory_.reset(IDACreate(context_));
    void* ida = memory_.get();
    IDAInit(ida, &Implementation::residual, 0.0, y.get(), yp.get());
    IDASStolerances(ida, relative_tolerance, 0.01 * relative_tolerance);
    IDASetUserData(ida, this);
    IDASetMaxNumSteps(ida, 1000000);
    IDASetStopTime(ida, system_->study().duration);
    for (int k = 0; k < at_.size(); ++k)
      NV_Ith_S(id.get(), k) = k < at_.z || k == at_.psi ? 1.0 : 0.0;
    IDASetId(ida, id.get());
    IDASetSuppressAlg(ida, SUNTRUE);
    const std::unique_ptr<std::remove_pointer_t<SUNMatrix>, void (*)(SUNMatrix)> matrix(
        new_matrix(), SUNMatDestroy);
    const std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, int (*)(SUNLinearSolver)> solver(
        new_solver(y.get(), matrix.get()), SUNLinSolFree);
    IDASetLinearSolver(ida, solver.get(), matrix.get());
    if (kind_ == SundialsMatrix::kSparseExact) IDASetJacFn(ida, &Implementation::jacobian);
    std::vector<Vector> sensitivities;
    if (with_gradient) add_sensitivities(start, &sensitivities);
    double t = 0.0;
    result.ok = IDASolve(ida, system_->study().duration, &t, y.get(), yp.get(), IDA_NORMAL) >= 0;
    IDAGetNumSteps(ida, &result.steps);
    result.psi = NV_Ith_S(y.get(), at_.psi);
    if (with_gradient) take_gradient(&sensitivities, &result);
    memory_.reset();
    return result;
  }

 private:
  Vector new_vector() const { return {N_VNew_Serial(at_.size(), context_), N_VDestroy}; }
  SUNMatrix new_matrix() const {
    if (kind_ == SundialsMatrix::kDenseDifferences)
      return SUNDenseMatrix(at_.size(), at_.size(), context_);
    return SUNSparseMatrix(at_.size(), at_.size(), static_cast<sunindextype>(rows_.size()), CSC_MAT,
                           context_);
  }
  SUNLinearSolver new_solver(N_Vector y, SUNMatrix matrix) const {
    return kind_ == SundialsMatrix::kDenseDifferences ? SUNLinSol_Dense(y, matrix, context_)
                                                      : SUNLinSol_KLU(y, matrix, context_);
  }

  void fill_start(const State<double>& start, double* y, double* yp) {
    store(start, y);
    y[at_.psi] = 0.0;
    VectorX<double> G;
    double g = 0.0;
    equations_.residual(start, &G, &g);
    rates(start, yp);
    yp[at_.psi] = g;
  }
  void store(const State<double>& state, double* y) const {
    std::copy(state.q.data(), state.q.data() + at_.n, y);
    std::copy(state.v.data(), state.v.data() + at_.n, y + at_.v);
    std::copy(state.s.data(), state.s.data() + at_.states, y + at_.s);
    std::copy(state.z.data(), state.z.data() + at_.columns, y + at_.z);
  }
  void rates(const State<double>& state, double* yp) const {
    std::fill(yp, yp + at_.size(), 0.0);
    std::copy(state.v.data(), state.v.data() + at_.n, yp);
    std::copy(state.z.data(), state.z.data() + at_.n, yp + at_.v);
    std::copy(state.z.data() + at_.columns - at_.states, state.z.data() + at_.columns, yp + at_.s);
  }
  void load(const double* y, State<double>* state) const {
    std::copy(y, y + at_.n, state->q.data());
    std::copy(y + at_.v, y + at_.s, state->v.data());
    std::copy(y + at_.s, y + at_.z, state->s.data());
    std::copy(y + at_.z, y + at_.psi, state->z.data());
  }

  /// F = (q' - v, v' - a, s' - sigma, G, psi' - g) from y, y', G and g, or the same of their
  /// sensitivities.
  void residual_rows(const double* y, const double* yp, double* F) const {
    for (int k = 0; k < at_.n; ++k) F[k] = yp[k] - y[at_.v + k];
    for (int k = 0; k < at_.n; ++k) F[at_.v + k] = yp[at_.v + k] - y[at_.z + k];
    for (int k = 0; k < at_.states; ++k) F[at_.s + k] = yp[at_.s + k] - y[at_.psi - at_.states + k];
  }

  static int residual(sunrealtype, N_Vector y, N_Vector yp, N_Vector F, void* user) {
    auto& self = *static_cast<Implementation*>(user);
    self.load(NV_DATA_S(y), &self.state_);
    double g = 0.0;
    self.equations_.residual(self.state_, &self.G_, &g);
    double* out = NV_DATA_S(F);
    self.residual_rows(NV_DATA_S(y), NV_DATA_S(yp), out);
    std::copy(self.G_.data(), self.G_.data() + self.at_.columns, out + self.at_.z);
    out[self.at_.psi] = NV_Ith_S(yp, self.at_.psi) - g;
    return std::isfinite(g) ? 0 : 1;
  }

  static int sensitivity_residual(int count, sunrealtype, N_Vector y, N_Vector, N_Vector,
                                  N_Vector* S, N_Vector* Sp, N_Vector* out, void* user, N_Vector,
                                  N_Vector, N_Vector) {
    auto& self = *static_cast<Implementation*>(user);
    self.load_wide(NV_DATA_S(y), count, S);
    Wide g(0.0);
    self.wide_.residual(self.wide_state_, &self.wide_G_, &g);
    for (int p = 0; p < count; ++p) {
      double* F = NV_DATA_S(out[p]);
      self.residual_rows(NV_DATA_S(S[p]), NV_DATA_S(Sp[p]), F);
      for (int k = 0; k < self.at_.columns; ++k) F[self.at_.z + k] = self.wide_G_[k].v[p];
      F[self.at_.psi] = NV_Ith_S(Sp[p], self.at_.psi) - g.v[p];
    }
    return 0;
  }
  void load_wide(const double* y, int count, N_Vector* S) {
    const auto part = [&](int first, VectorX<Wide>* x) {
      for (Eigen::Index k = 0; k < x->size(); ++k) {
        (*x)[k].a = y[first + k];
        for (int p = 0; p < count; ++p) (*x)[k].v[p] = NV_Ith_S(S[p], first + k);
      }
    };
    part(0, &wide_state_.q);
    part(at_.v, &wide_state_.v);
    part(at_.s, &wide_state_.s);
    part(at_.z, &wide_state_.z);
  }

  /// Visits dF/dy (`rate` false) and dF/dy' (`rate` true).
  template <class Visit>
  void for_each_entry(const Visit& visit) const {
    for (int k = 0; k < at_.z; ++k) visit(k, k, 1.0, true);
    for (int k = 0; k < at_.n; ++k) {
      visit(k, at_.v + k, -1.0, false);
      visit(at_.v + k, at_.z + k, -1.0, false);
    }
    for (int k = 0; k < at_.states; ++k) visit(at_.s + k, at_.psi - at_.states + k, -1.0, false);
    visit(at_.psi, at_.psi, 1.0, true);
    derivatives_.for_each([&](Variable by, int row, int column, double value) {
      int place = at_.z + column;
      if (by == Variable::kVelocity) place = at_.v + column;
      if (by == Variable::kPosition) place = column < at_.n ? column : at_.s + column - at_.n;
      visit(at_.z + row, place, row < at_.columns ? value : -value, false);
    });
  }

  /// The places that differ from zero at some of a few arbitrary states.
  void find_pattern() {
    std::map<std::pair<int, int>, int> slots;  // by column, then row
    for (int sample = 0; sample < 4; ++sample) {
      int seed = 17 * (sample + 1);
      for (VectorX<double>* x : {&state_.q, &state_.v, &state_.s, &state_.z})
        for (double& value : *x) value = std::sin(static_cast<double>(seed += 3));
      derivatives_.evaluate(&equations_, state_);
      for_each_entry([&](int row, int column, double value, bool) {
        if (value != 0.0) slots[{column, row}] = 0;
      });
    }
    starts_.assign(static_cast<std::size_t>(at_.size()) + 1, 0);
    for (auto& [place, slot] : slots) {
      slot = static_cast<int>(rows_.size());
      rows_.push_back(place.second);
      ++starts_[static_cast<std::size_t>(place.first) + 1];
    }
    for (std::size_t k = 1; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
    for_each_entry([&](int row, int column, double, bool) {
      const auto found = slots.find({column, row});
      calls_.push_back(found == slots.end() ? -1 : found->second);
    });
  }

  static int jacobian(sunrealtype, sunrealtype cj, N_Vector y, N_Vector, N_Vector, SUNMatrix J,
                      void* user, N_Vector, N_Vector, N_Vector) {
    auto& self = *static_cast<Implementation*>(user);
    self.load(NV_DATA_S(y), &self.state_);
    self.derivatives_.evaluate(&self.equations_, self.state_);
    std::copy(self.starts_.begin(), self.starts_.end(), SUNSparseMatrix_IndexPointers(J));
    std::copy(self.rows_.begin(), self.rows_.end(), SUNSparseMatrix_IndexValues(J));
    double* values = SUNSparseMatrix_Data(J);
    std::fill(values, values + self.rows_.size(), 0.0);
    auto call = self.calls_.begin();
    self.for_each_entry([&](int, int, double value, bool rate) {
      const int slot = *call++;
      if (slot >= 0) values[slot] += rate ? cj * value : value;
    });
    return 0;
  }

  void add_sensitivities(const State<double>& start, std::vector<Vector>* all) {
    const std::vector<double> parameters = system_->parameters();
    const std::vector<int>& tuned = system_->study().tuned;
    std::vector<Wide> lanes(parameters.begin(), parameters.end());
    std::vector<double> scales;
    for (std::size_t p = 0; p < tuned.size(); ++p) {
      lanes[static_cast<std::size_t>(tuned[p])].v[static_cast<int>(p)] = 1.0;
      scales.push_back(std::abs(parameters[static_cast<std::size_t>(tuned[p])]));
    }
    wide_.set_design(lanes);
    assembly_.extend(lanes, start, &wide_, &wide_state_);
    Wide g(0.0);
    wide_.residual(wide_state_, &wide_G_, &g);
    std::vector<N_Vector> S, Sp;
    for (std::size_t p = 0; p < tuned.size(); ++p) {
      State<double> direction;
      direction.resize(system_->layout());
      const auto take = [p](const VectorX<Wide>& from, VectorX<double>* to) {
        for (Eigen::Index k = 0; k < from.size(); ++k) (*to)[k] = from[k].v[static_cast<int>(p)];
      };
      take(wide_state_.q, &direction.q);
      take(wide_state_.v, &direction.v);
      take(wide_state_.s, &direction.s);
      take(wide_state_.z, &direction.z);
      for (std::vector<N_Vector>* list : {&S, &Sp}) {
        all->push_back(new_vector());
        list->push_back(all->back().get());
      }
      store(direction, NV_DATA_S(S.back()));
      NV_Ith_S(S.back(), at_.psi) = 0.0;
      rates(direction, NV_DATA_S(Sp.back()));
      NV_Ith_S(Sp.back(), at_.psi) = g.v[static_cast<int>(p)];
    }
    void* ida = memory_.get();
    IDASensInit(ida, static_cast<int>(tuned.size()), IDA_STAGGERED,
                &Implementation::sensitivity_residual, S.data(), Sp.data());
    IDASetSensParams(ida, nullptr, scales.data(), nullptr);
    IDASensEEtolerances(ida);
    IDASetSensErrCon(ida, SUNTRUE);
  }

  void take_gradient(std::vector<Vector>* sensitivities, SundialsResult* result) {
    std::vector<N_Vector> S;
    for (std::size_t k = 0; k < sensitivities->size(); k += 2)
      S.push_back((*sensitivities)[k].get());
    double t = 0.0;
    IDAGetSens(memory_.get(), &t, S.data());
    result->gradient.resize(static_cast<Eigen::Index>(S.size()));
    for (std::size_t p = 0; p < S.size(); ++p)
      result->gradient[static_cast<Eigen::Index>(p)] = NV_Ith_S(S[p], at_.psi);
  }

  std::shared_ptr<const CompiledSystem> system_;
  Places at_;
  SundialsMatrix kind_;
  SUNContext context_ = nullptr;
  std::unique_ptr<void, FreeIda> memory_;
  Equations<double> equations_;
  Equations<Wide> wide_;
  Assembly assembly_;
  LinearizedSystem derivatives_;
  State<double> state_;
  State<Wide> wide_state_;
  VectorX<double> G_;
  VectorX<Wide> wide_G_;
  std::vector<sunindextype> starts_, rows_;
  std::vector<int> calls_;
};

SundialsPeer::SundialsPeer(std::shared_ptr<const CompiledSystem> system, SundialsMatrix matrix)
    : implementation_(std::make_unique<Implementation>(std::move(system), matrix)) {}
SundialsPeer::~SundialsPeer() = default;

SundialsResult SundialsPeer::run(double relative_tolerance, bool with_gradient) {
  return implementation_->run(relative_tolerance, with_gradient);
}

}  // namespace codesign
