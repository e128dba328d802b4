// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/mutation.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace codesign::fuzz {
namespace {

using Places = std::vector<std::pair<std::size_t, std::size_t>>;  // first byte and length

const std::vector<std::string>& odd_values() {
  static const std::vector<std::string> kValues = {"0",
                                                   "-1",
                                                   "1",
                                                   "1e308",
                                                   "-1e308",
                                                   "1e-320",
                                                   "1e-300",
                                                   "nan",
                                                   "inf",
                                                   "-inf",
                                                   "1e9",
                                                   "1e12",
                                                   "-0",
                                                   "0.5",
                                                   "1e-9",
                                                   "1e6",
                                                   "3.141592654",
                                                   "1.5708",
                                                   "",
                                                   "abc",
                                                   "[]",
                                                   "{}",
                                                   "true",
                                                   "null",
                                                   "~",
                                                   "0 0 0",
                                                   "1 0 0",
                                                   "0 0 1",
                                                   "1,2",
                                                   "0x10",
                                                   "+1",
                                                   "1e",
                                                   "${",
                                                   "${1/0}",
                                                   "${x}",
                                                   "${1>0?1}",
                                                   "${sqrt(-1)}",
                                                   "-${1}",
                                                   "${${1}}",
                                                   "\"",
                                                   "'",
                                                   "<",
                                                   "&",
                                                   "&amp;",
                                                   "*x",
                                                   "&x y",
                                                   "!!int 3",
                                                   "|",
                                                   "- - -",
                                                   "\xff\xfe",
                                                   "\xc3\xa4",
                                                   "revolute",
                                                   "fixed",
                                                   "floating",
                                                   "planar",
                                                   "world",
                                                   "..",
                                                   "prismatic",
                                                   "continuous",
                                                   "/dev/zero",
                                                   "codesign:x",
                                                   "gonthier",
                                                   "lugre",
                                                   "idas",
                                                   "adjoint",
                                                   "cubic",
                                                   "waypoints",
                                                   "basis",
                                                   "state_feedback",
                                                   "runs",
                                                   "uncertain",
                                                   "robust",
                                                   "multistart",
                                                   "engine",
                                                   "set",
                                                   "weight",
                                                   "uniform",
                                                   "normal",
                                                   "between",
                                                   "choice",
                                                   "friction_law",
                                                   "measure",
                                                   "worst",
                                                   "cvar",
                                                   "mean_plus_deviation",
                                                   "level",
                                                   "factor",
                                                   "samples",
                                                   "sampler",
                                                   "sobol",
                                                   "latin_hypercube",
                                                   "random",
                                                   "seed",
                                                   "validate",
                                                   "failed",
                                                   "tail",
                                                   "starts",
                                                   "screen",
                                                   "cluster",
                                                   "serial",
                                                   "threads",
                                                   "workers",
                                                   "1" + std::string(400, '0'),
                                                   std::string(3000, 'n'),
                                                   std::string(40, '(')};
  return kValues;
}

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '.' || c == '-' || c == '+';
}

/// Words and numbers.
Places words_of(const std::string& text) {
  Places places;
  for (std::size_t k = 0; k < text.size();) {
    std::size_t end = k;
    while (end < text.size() && is_word(text[end])) ++end;
    if (end > k) places.emplace_back(k, end - k);
    k = std::max(end, k + 1);
  }
  return places;
}

Places lines_of(const std::string& text) {
  Places places;
  for (std::size_t k = 0; k < text.size();) {
    const std::size_t end = std::min(text.find('\n', k), text.size() - 1) + 1;
    places.emplace_back(k, end - k);
    k = end;
  }
  return places;
}

bool is_number(const std::string& word) {
  char* end = nullptr;
  std::strtod(word.c_str(), &end);
  return !word.empty() && *end == '\0';
}

std::string with_typo(std::string word, Dice* dice) {
  const std::size_t at = dice->below(word.size());
  if (dice->one_in(3)) return word.erase(at, 1);
  if (dice->one_in(2)) return word.insert(at, 1, word[at]);
  std::swap(word[at], word[dice->below(word.size())]);
  return word;
}

std::string scaled(const std::string& number, Dice* dice) {
  static const std::vector<double> kFactors = {0.0,  -1.0, 0.5, 2.0,  0.99, 1.01,
                                               10.0, 0.1,  1e3, 1e-3, 1e-8, 1e8};
  char text[64];
  std::snprintf(text, sizeof text, "%.17g",
                std::strtod(number.c_str(), nullptr) * dice->pick(kFactors));
  return text;
}

void change_word(std::string* text, Dice* dice) {
  const Places words = words_of(*text);
  if (words.empty()) return;
  const auto [at, length] = dice->pick(words);
  const auto [other, other_length] = dice->pick(words);
  const std::string word = text->substr(at, length);
  if (dice->one_in(4)) {
    text->replace(at, length, dice->pick(odd_values()));
  } else if (is_number(word)) {
    text->replace(at, length, scaled(word, dice));
  } else {
    text->replace(at, length,
                  dice->one_in(2) ? with_typo(word, dice) : text->substr(other, other_length));
  }
}

void change_number(std::string* text, Dice* dice) {
  const Places words = words_of(*text);
  for (int tries = 0; tries < 20 && !words.empty(); ++tries) {
    const auto [at, length] = dice->pick(words);
    const std::string word = text->substr(at, length);
    if (!is_number(word)) continue;
    text->replace(at, length, dice->one_in(4) ? dice->pick(odd_values()) : scaled(word, dice));
    return;
  }
}

void change_line(std::string* text, Dice* dice) {
  const Places lines = lines_of(*text);
  if (lines.empty()) return;
  const auto [at, length] = dice->pick(lines);
  const auto [other, other_length] = dice->pick(lines);
  const std::string copy = text->substr(other, other_length);
  switch (dice->below(4)) {
    case 0:
      text->erase(at, length);
      break;
    case 1:
      text->insert(at, copy);
      break;
    case 2:
      text->replace(at, length, copy);
      break;
    default:
      text->insert(at, dice->one_in(2) ? "  " : "\t");
  }
}

void change_bytes(std::string* text, Dice* dice) {
  if (text->empty()) return;
  const std::size_t at = dice->below(text->size());
  switch (dice->below(4)) {
    case 0:
      text->resize(at);
      break;
    case 1:
      (*text)[at] = static_cast<char>(dice->below(256));
      break;
    case 2:
      text->insert(at, dice->pick(odd_values()));
      break;
    default:
      text->erase(at, 1 + dice->below(40));
  }
}

void collect(tinyxml2::XMLElement* element, std::vector<tinyxml2::XMLElement*>* all) {
  for (tinyxml2::XMLElement* child = element->FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    all->push_back(child);
    collect(child, all);
  }
}

bool stands_in(const tinyxml2::XMLNode* node, const tinyxml2::XMLNode* above) {
  for (; node != nullptr; node = node->Parent())
    if (node == above) return true;
  return false;
}

void change_element(tinyxml2::XMLDocument* document, const std::vector<tinyxml2::XMLElement*>& all,
                    Dice* dice) {
  tinyxml2::XMLElement *const one = dice->pick(all), *const other = dice->pick(all);
  const tinyxml2::XMLAttribute* attribute = one->FirstAttribute();
  for (std::size_t skip = dice->below(4);
       attribute != nullptr && attribute->Next() != nullptr && skip > 0; --skip)
    attribute = attribute->Next();
  switch (dice->below(6)) {
    case 0:
      one->Parent()->DeleteChild(one);
      break;
    case 1:
      other->InsertEndChild(one->DeepClone(document));
      break;
    case 2:
      one->Parent()->InsertEndChild(one->DeepClone(document));
      break;
    case 3:
      if (!stands_in(other, one)) other->InsertEndChild(one);
      break;
    case 4:
      if (attribute != nullptr) one->DeleteAttribute(std::string(attribute->Name()).c_str());
      break;
    default:
      if (attribute != nullptr)
        one->SetAttribute(with_typo(attribute->Name(), dice).c_str(),
                          dice->pick(odd_values()).c_str());
  }
}

}  // namespace

std::string mutate_text(const std::string& text, Dice* dice) {
  std::string changed = text;
  switch (dice->below(8)) {
    case 0:
      change_bytes(&changed, dice);
      break;
    case 1:
    case 2:
      change_line(&changed, dice);
      break;
    case 3:
    case 4:
    case 5:
      change_number(&changed, dice);
      break;
    default:
      change_word(&changed, dice);
  }
  return changed;
}

std::string mutate_xml(const std::string& text, Dice* dice) {
  tinyxml2::XMLDocument document;
  if (document.Parse(text.c_str(), text.size()) != tinyxml2::XML_SUCCESS ||
      document.RootElement() == nullptr)
    return text;
  std::vector<tinyxml2::XMLElement*> all;
  collect(document.RootElement(), &all);
  if (all.empty()) return text;
  change_element(&document, all, dice);
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

std::string random_expression(const std::vector<std::string>& names, int depth, Dice* dice) {
  static const std::vector<std::string> kOperators = {
      "+", "-", "*", "/", "^", "**", "<", ">=", "==", "?", ":", ",", " ", "\n", "="};
  static const std::vector<std::string> kFunctions = {"sqrt", "sin", "atan2", "min",    "max",
                                                      "log",  "pow", "abs",   "nosuch", "pi"};
  const auto inner = [&] { return random_expression(names, depth - 1, dice); };
  if (depth <= 0 || dice->one_in(4)) {
    if (dice->one_in(3)) return dice->pick(odd_values());
    return names.empty() || dice->one_in(2) ? std::to_string(dice->below(9)) : dice->pick(names);
  }
  switch (dice->below(5)) {
    case 0:
      return "(" + inner() + ")";
    case 1:
      return dice->pick(kFunctions) + "(" + inner() + (dice->one_in(2) ? ", " + inner() : "") +
             (dice->one_in(12) ? "" : ")");
    case 2:
      return inner() + " < " + inner() + " ? " + inner() + " : " + inner();
    case 3:
      return "-" + inner();
    default:
      return inner() + dice->pick(kOperators) + inner();
  }
}

}  // namespace codesign::fuzz
