// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Tries random inputs, or inputs from files, and prints the ones that fail. Exit code 1 if one
// fails, 2 for an invalid command line.
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "fuzz/command_inputs.h"
#include "fuzz/command_oracle.h"
#include "fuzz/expression_fuzz.h"
#include "fuzz/journal_fuzz.h"
#ifdef CODESIGN_FUZZ_REQUESTS
#include "fuzz/request_fuzz.h"
#endif

namespace {

using namespace codesign::fuzz;

struct Options {
  double minutes = 0.0;  ///< 0: `inputs` decide
  long inputs = 500;
  std::uint64_t seed = 1;
  std::string keep = "fuzz_failures";
  std::vector<std::string> replay;
};

Options parse(int argc, char** argv) {
  Options options;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    const bool has_value = k + 1 < argc;
    if (word == "--minutes" && has_value) {
      options.minutes = std::stod(argv[++k]);
    } else if (word == "--inputs" && has_value) {
      options.inputs = std::stol(argv[++k]);
    } else if (word == "--seed" && has_value) {
      options.seed = std::stoull(argv[++k]);
    } else if (word == "--keep" && has_value) {
      options.keep = argv[++k];
    } else if (!word.empty() && word[0] != '-') {
      options.replay.push_back(word);
    } else {
      throw std::invalid_argument(
          "fuzz: what is \"" + word +
          "\"? [--minutes M | --inputs N] [--seed S] [--keep FOLDER] [FILE...]");
    }
  }
  return options;
}

int replay(const std::vector<std::string>& paths) {
  int failures = 0;
  for (const std::string& path : paths) {
    const std::string fault = run_command(load_input(path), default_limits());
    if (fault.empty()) continue;
    ++failures;
    std::cout << path << ": " << fault << std::endl;
  }
  std::cout << paths.size() << " inputs, " << failures << " failures" << std::endl;
  return failures > 0 ? 1 : 0;
}

/// Tries one input, made from its number alone. Returns a sentence about a fault; empty if there is
/// none.
std::string try_one(const std::vector<Seed>& seeds, std::uint64_t number, const std::string& keep) {
  Dice dice(number);
  if (number % 20 == 1)
    return run_isolated([&](const std::atomic<bool>&) { return try_expressions(300, &dice); },
                        default_limits());
  if (number % 20 == 3) return run_resumed(seeds, default_limits(), &dice);
#ifdef CODESIGN_FUZZ_REQUESTS
  if (number % 10 == 2) return run_request(seeds, default_limits(), &dice);
#endif
  const Input input = random_input(seeds, &dice);
  std::string fault = run_command(input, default_limits());
  if (fault.empty()) return fault;
  std::filesystem::create_directories(keep);
  const std::string path = keep + "/" + std::to_string(number) + ".yaml";
  save_input(path, input);
  return fault + "\n  kept as " + path;
}

int fuzz(const Options& options) {
  const std::vector<Seed> seeds = shipped_seeds();
  const auto begin = std::chrono::steady_clock::now();
  const auto minutes = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / 60.0;
  };
  long inputs = 0, failures = 0;
  for (; options.minutes > 0.0 ? minutes() < options.minutes : inputs < options.inputs; ++inputs) {
    const std::uint64_t number = options.seed * 1000000000 + static_cast<std::uint64_t>(inputs);
    const std::string fault = try_one(seeds, number, options.keep);
    if (fault.empty()) continue;
    ++failures;
    std::cout << number << ": " << fault << std::endl;
  }
  std::cout << inputs << " inputs, " << failures << " failures, " << minutes() << " min"
            << std::endl;
  return failures > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = parse(argc, argv);
    return options.replay.empty() ? fuzz(options) : replay(options.replay);
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
}
