// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "text/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <locale>
#include <sstream>
#include <system_error>

namespace codesign {
namespace {

/// A number out of the range of doubles: zero (or a denormal) if too small, as urdfdom reads it;
/// std::nullopt if too large.
std::optional<double> underflow(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double value = 0.0;
  stream >> value;
  if (stream.fail()) return std::nullopt;
  return value;
}

}  // namespace

std::string to_decimal(double value) {
  std::array<char, 32> text;  // a double needs at most 24
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return std::string(text.data(), result.ptr);
}

std::optional<double> parse_number(const std::string& text) {
  const char* begin = text.data();
  const char* const end = begin + text.size();
  if (text.size() > 1 && *begin == '+' && text[1] != '-')
    ++begin;  // urdfdom accepts a plus sign, from_chars does not
  double value = 0.0;
  const std::from_chars_result result = std::from_chars(begin, end, value);
  if (result.ptr != end) return std::nullopt;
  if (result.ec == std::errc::result_out_of_range) return underflow(text);
  if (result.ec != std::errc()) return std::nullopt;
  return value;
}

std::string format_numbers(const std::vector<double>& values) {
  std::string text;
  for (double value : values) text += (text.empty() ? "" : " ") + to_decimal(value);
  return text;
}

std::vector<std::string> split_words(const std::string& text) {
  constexpr const char* kSpace = " \t\n\v\f\r";
  std::vector<std::string> words;
  for (std::size_t at = text.find_first_not_of(kSpace), end = 0; at != std::string::npos;
       at = text.find_first_not_of(kSpace, end)) {
    end = std::min(text.find_first_of(kSpace, at), text.size());
    words.push_back(text.substr(at, end - at));
  }
  return words;
}

bool ends_with(const std::string& text, const std::string& tail) {
  return text.size() >= tail.size() &&
         text.compare(text.size() - tail.size(), tail.size(), tail) == 0;
}

std::string readable(double value, int digits) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(digits);
  text << value;
  return text.str();
}

}  // namespace codesign
