// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/linear_tables.h"

#include <cmath>

#include "text/number_text.h"
#include "text/table.h"

namespace codesign::cli {
namespace {

constexpr int kDigits = 6;
constexpr double kDegrees = 57.29577951308232;  // per rad
constexpr double kTurn = 6.283185307179586;     // [rad]

/// "hinge 1, slide -0.2": the joints that take part.
std::string rates_text(const LinearMode& mode, const std::vector<std::string>& joints) {
  std::string text;
  for (std::size_t k = 0; k < joints.size(); ++k)
    if (std::abs(mode.rates[k]) > 1e-6)
      text += (text.empty() ? "" : ", ") + joints[k] + " " + readable(mode.rates[k], 3);
  return text.empty() ? "no joint with one coordinate" : text;
}

/// "2.7928 (8.91 dB)", "32.4 deg", "none".
std::string margin_text(const std::string& name, const std::optional<AtFrequency>& margin,
                        const std::string& unit, bool is_stable) {
  if (!margin)
    return !is_stable || name == "bandwidth" ? "none" : name == "gain_reduction" ? "0" : "infinite";
  if (unit == "rad") return readable(margin->value * kDegrees, kDigits) + " deg";
  if (unit == "rad/s") return readable(margin->value / kTurn, kDigits) + " Hz";
  std::string text = readable(margin->value, kDigits);
  if (unit == "s") return text + " s";
  return text + " (" + readable(20.0 * std::log10(margin->value), 3) + " dB)";
}

}  // namespace

void print_stability(const LinearModel& model, std::ostream& out) {
  out << model.verdict << '\n';
  if (model.modes.empty()) return;
  Table table;
  table.add({"small motion", "growth [1/s]", "frequency [Hz]", "damping ratio", "rates"});
  for (std::size_t k = 0; k < model.modes.size(); ++k) {
    // What rounding leaves of zero is shown as zero.
    Pole pole = model.modes[k].pole;
    if (pole.is_zero(model.duration)) pole.value = 0.0;
    if (std::abs(pole.growth()) <= pole.uncertainty) pole.value = {0.0, pole.value.imag()};
    table.add({std::to_string(k + 1), readable(pole.growth(), kDigits),
               readable(pole.frequency(), kDigits), readable(pole.damping_ratio(), kDigits),
               rates_text(model.modes[k], model.joints)});
  }
  table.print(out);
}

void print_margins(const LinearModel& model, std::ostream& out) {
  Table table;
  table.add({"loop", "", "at [Hz]"});
  for (const ControllerLoop& loop : model.loops) {
    if (loop.samples != 1)
      out << loop.controller << ": margins by the poles over "
          << (loop.samples > 1 ? std::to_string(loop.samples) + " samples, " : "")
          << "the common period of all controllers\n";
    visit_margins(loop.margins, [&](const std::string& name,
                                    const std::optional<AtFrequency>& margin, const char* unit) {
      std::string title = name;
      for (char& c : title)
        if (c == '_') c = ' ';
      table.add({loop.controller + " " + title,
                 margin_text(name, margin, unit, loop.margins.is_stable),
                 margin ? readable(margin->frequency / kTurn, kDigits) : "-"});
    });
  }
  if (!model.loops.empty()) table.print(out);
}

}  // namespace codesign::cli
