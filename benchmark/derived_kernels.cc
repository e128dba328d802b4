// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/derived_kernels.h"

#include <map>
#include <utility>

#include "benchmark/constraint_kernels.h"
#include "codegen/derivatives.h"
#include "equations/equation_variant.h"

namespace codesign {
namespace {

using Arrays = EquationArrays;

/// A recording of kernels, each of which can be recorded as it was written or be derived from the
/// values.
class KernelRecording {
 public:
  KernelRecording(const CompiledSystem& system, const Constants<double>& constants)
      : kernels_(system, constants),
        q_(leaves(Arrays::kQ, kernels_.columns())),
        v_(leaves(Arrays::kV, kernels_.columns())),
        lambda_(leaves(Arrays::kZ, kernels_.rows())) {}

  NumberedRecording* recording() { return &numbered_; }

  std::vector<Traced> by_hand(KernelOperation operation) {
    std::vector<Traced> results(operation == KernelOperation::kJacobian ? kernels_.entries().size()
                                : operation == KernelOperation::kTransposedProduct
                                    ? q_.size()
                                    : lambda_.size());
    switch (operation) {
      case KernelOperation::kJacobian:
        kernels_.jacobian(q_.data(), results.data());
        break;
      case KernelOperation::kProduct:
        kernels_.jacobian_times(q_.data(), v_.data(), results.data());
        break;
      case KernelOperation::kTransposedProduct:
        kernels_.transposed_times(q_.data(), lambda_.data(), results.data());
        break;
      case KernelOperation::kCurvature:
        kernels_.curvature(q_.data(), v_.data(), results.data());
        break;
    }
    return results;
  }

  std::vector<Traced> derived(KernelOperation operation) {
    std::vector<Traced> Phi(lambda_.size());
    kernels_.values(q_.data(), Phi.data());
    switch (operation) {
      case KernelOperation::kJacobian:
        return jacobian(Phi);
      case KernelOperation::kProduct:
        return along_v(Phi);
      case KernelOperation::kTransposedProduct:
        return gradient(Phi);
      case KernelOperation::kCurvature:
        break;
    }
    return along_v(along_v(Phi));
  }

 private:
  std::vector<Traced> leaves(int array, int size) {
    std::vector<Traced> x;
    for (int k = 0; k < size; ++k)
      x.emplace_back(&numbered_.recording, numbered_.recording.leaf(array, k, true));
    return x;
  }

  /// In the order of elimination that the library uses. An entry that ConstraintKernels does not
  /// have is an error.
  std::vector<Traced> jacobian(const std::vector<Traced>& Phi) {
    std::vector<int> outputs;
    for (const Traced& row : Phi) outputs.push_back(row.node_in(&numbered_.recording));
    std::vector<JacobianInput> inputs;
    for (std::size_t k = 0; k < q_.size(); ++k)
      inputs.push_back({q_[k].node(), static_cast<int>(k)});
    std::map<std::pair<int, int>, std::size_t> places;
    for (const auto& entry : kernels_.entries())
      places.emplace(std::make_pair(entry.row, entry.column), places.size());
    std::vector<Traced> results(places.size());
    for (const JacobianEntry& entry :
         derive_jacobian(&numbered_.recording, outputs, inputs, EliminationOrder::kForward))
      results[places.at({entry.row, entry.column})] = entry.value;
    return results;
  }

  /// The derivative of x by q, times v. Forward accumulation of one direction needs no entries of
  /// Phi_q.
  std::vector<Traced> along_v(const std::vector<Traced>& x) {
    Recording* const recording = &numbered_.recording;
    std::vector<Traced> tangents(static_cast<std::size_t>(recording->size()));
    for (std::size_t k = 0; k < q_.size(); ++k) tangent(q_[k], &tangents) = v_[k];
    for (std::size_t n = 0; n < tangents.size(); ++n)
      for (const Partial& partial : partials_of(recording, static_cast<int>(n)))
        tangents[n] = folded(
            recording, tangents[n] + product(recording, folded(recording, partial.factor),
                                             tangents[static_cast<std::size_t>(partial.node)]));
    std::vector<Traced> results;
    for (const Traced& value : x)
      results.push_back(value.is_literal() ? Traced(0.0) : tangent(value, &tangents));
    return results;
  }
  static Traced& tangent(const Traced& x, std::vector<Traced>* tangents) {
    return (*tangents)[static_cast<std::size_t>(x.node())];
  }

  /// The gradient of lambda^T Phi.
  std::vector<Traced> gradient(const std::vector<Traced>& Phi) {
    Recording* const recording = &numbered_.recording;
    std::vector<AdjointSeed> seeds;
    for (std::size_t k = 0; k < Phi.size(); ++k)
      seeds.push_back({Phi[k].node_in(recording), lambda_[k]});
    std::vector<bool> is_target(static_cast<std::size_t>(recording->size()));
    for (const Traced& x : q_) is_target[static_cast<std::size_t>(x.node())] = true;
    const std::vector<Traced> adjoints = derive_adjoints(recording, seeds, is_target);
    std::vector<Traced> results;
    for (const Traced& x : q_) results.push_back(adjoints[static_cast<std::size_t>(x.node())]);
    return results;
  }

  NumberedRecording numbered_;
  ConstraintKernels<Traced> kernels_;
  std::vector<Traced> q_, v_, lambda_;
};

}  // namespace

struct KernelProgram::Parts {
  Parts(const std::vector<Traced>& results, NumberedRecording* numbered) {
    Recording* const recording = &numbered->recording;
    ValueTask task;
    for (std::size_t k = 0; k < results.size(); ++k) {
      const Traced result = folded(recording, results[k]);
      if (!result.is(0.0))
        task.outputs.push_back(
            {result.node_in(recording), {Arrays::kResults, static_cast<int>(k)}});
    }
    numbered->number_nodes();
    task.homes = numbered->homes;
    // The constants of the design are literals here, so that nothing else is a number.
    for (int n : numbered->numbers) numbers.push_back(recording->node(n).literal);
    const ValueProgram program(*recording, task);
    instructions = static_cast<int>(program.instructions.size());
    code = compile_values(*recording, task, program, false);
    slots.resize(code->slots);
  }

  std::unique_ptr<CompiledFunction> code;
  std::vector<double> numbers, slots;
  int instructions;
};

KernelProgram KernelProgram::recorded(KernelOperation operation, const CompiledSystem& system,
                                      const Constants<double>& constants) {
  KernelRecording kernels(system, constants);
  return KernelProgram(std::make_unique<Parts>(kernels.by_hand(operation), kernels.recording()));
}

KernelProgram KernelProgram::derived(KernelOperation operation, const CompiledSystem& system,
                                     const Constants<double>& constants) {
  KernelRecording kernels(system, constants);
  return KernelProgram(std::make_unique<Parts>(kernels.derived(operation), kernels.recording()));
}

KernelProgram::KernelProgram(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
KernelProgram::KernelProgram(KernelProgram&& other) noexcept = default;
KernelProgram::~KernelProgram() = default;

int KernelProgram::instructions() const { return parts_->instructions; }

void KernelProgram::run(const double* q, const double* v, const double* lambda, double* results) {
  ValueCode::Arrays arrays{};
  arrays[Arrays::kQ] = q, arrays[Arrays::kV] = v, arrays[Arrays::kZ] = lambda;
  arrays[Arrays::kNumbers] = parts_->numbers.data(), arrays[Arrays::kResults] = results,
  arrays[Arrays::kSlots] = parts_->slots.data();
  parts_->code->values->run(arrays);
}

std::vector<KernelProgram> derived_kernels(const CompiledSystem& system,
                                           const Constants<double>& constants) {
  std::vector<KernelProgram> programs;
  for (int k = 0; k < kKernelOperations; ++k)
    programs.push_back(KernelProgram::derived(static_cast<KernelOperation>(k), system, constants));
  return programs;
}

}  // namespace codesign
