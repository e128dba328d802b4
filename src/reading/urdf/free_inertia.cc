// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/inertial_reader.h"

#include <cctype>
#include <string>

#include "mechanism/mass_properties.h"
#include "reading/urdf/overlay.h"
#include "reading/urdf/quantity_reader.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using tinyxml2::XMLElement;

constexpr const char* kAttribute = "codesign:inertia";
constexpr std::array<const char*, 6> kMoments = {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"};

/// A link's name as the beginning of parameters' names: other characters than letters, digits and _
/// become _.
std::string names_begin_with(const std::string& link) {
  std::string prefix = link;
  for (char& c : prefix)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return std::isdigit(static_cast<unsigned char>(prefix.front())) != 0 ? "_" + prefix : prefix;
}

void refuse_twins(const XmlElement& inertial) {
  for (const XmlElement& child : inertial.children())
    for (const std::string& name : child.attributes())
      if (name.rfind(kPrefix, 0) == 0)
        child.fail_at(name, "the numbers of a free inertia are parameters themselves",
                      "plain numbers, or remove codesign:inertia");
}

/// The plain numbers, in the link's axes.
MassProperties<double> read_plain(const XmlElement& inertial) {
  const ParameterTable none{std::vector<Parameter>()};
  InertialDescription plain;
  plain.origin = read_origin(inertial, none);
  plain.mass = read_quantity(inertial.only("mass"), "value", Range::kPositive, none);
  const XmlElement inertia = inertial.only("inertia");
  for (std::size_t k = 0; k < kMoments.size(); ++k)
    plain.inertia[k] = read_quantity(inertia, kMoments[k], Range::kAny, none);
  return mass_properties(plain, std::vector<double>());
}

void write_twin(XMLElement* element, const std::string& attribute, const std::string& plain,
                const std::string& twin) {
  element->SetAttribute(attribute.c_str(), plain.c_str());
  element->SetAttribute((kPrefix + attribute).c_str(), twin.c_str());
}

/// The expressions of (28e).
void write_inertial_twins(XMLElement* inertial, const MassProperties<double>& plain,
                          const std::string& link) {
  const auto name = [&link](const char* number) { return link + "_" + number; };
  const auto exp2 = [&name](const char* number) { return "exp(2*" + name(number) + ")"; };
  const auto term = [](const std::string& expression) { return "${" + expression + "}"; };
  const std::string m = exp2("alpha"), s12 = name("s12"), s23 = name("s23"), s13 = name("s13"),
                    l2 = "exp(" + name("d2") + ")", l3 = "exp(" + name("d3") + ")";
  const std::string xx = exp2("d1") + "+" + s12 + "*" + s12 + "+" + s13 + "*" + s13,
                    yy = exp2("d2") + "+" + s23 + "*" + s23, zz = exp2("d3");
  XMLElement* origin = inertial->FirstChildElement("origin");
  if (origin == nullptr) origin = inertial->InsertNewChildElement("origin");
  write_twin(origin, "xyz", format_numbers({plain.centre[0], plain.centre[1], plain.centre[2]}),
             term(name("t1")) + " " + term(name("t2")) + " " + term(name("t3")));
  origin->SetAttribute("rpy", "0 0 0");
  write_twin(inertial->FirstChildElement("mass"), "value", to_decimal(plain.mass), term(m));
  XMLElement* inertia = inertial->FirstChildElement("inertia");
  const auto moment = [&](const char* attribute, int i, int k, const std::string& twin) {
    write_twin(inertia, attribute, to_decimal(plain.inertia(i, k)), term(m + "*(" + twin + ")"));
  };
  moment("ixx", 0, 0, yy + "+" + zz);
  moment("iyy", 1, 1, xx + "+" + zz);
  moment("izz", 2, 2, xx + "+" + yy);
  moment("ixy", 0, 1, "0-" + s12 + "*" + l2 + "-" + s13 + "*" + s23);
  moment("ixz", 0, 2, "0-" + s13 + "*" + l3);
  moment("iyz", 1, 2, "0-" + s23 + "*" + l3);
}

void write_out(XMLElement* node, const std::string& link, XmlDocument* document) {
  const XmlElement inertial(node, document);
  if (inertial.text(kAttribute) != "free")
    inertial.fail_at(kAttribute, "unknown kind of inertia", "free");
  if (inertial.has("codesign:density"))
    inertial.fail_at(kAttribute, "mass and inertia come from the shapes", "one of the two");
  refuse_twins(inertial);
  const MassProperties<double> plain = read_plain(inertial);
  const std::optional<std::array<double, 10>> numbers = log_cholesky(plain);
  if (!numbers)
    inertial.fail(
        "no body with an extent in all directions has this inertia, so that it cannot be free",
        "ixx=" + to_decimal(plain.inertia(0, 0)) + " iyy=" + to_decimal(plain.inertia(1, 1)) +
            " izz=" + to_decimal(plain.inertia(2, 2)),
        "principal moments each above zero and below the sum of the other two");
  const std::string prefix = names_begin_with(link);
  std::array<double, 10> values = *numbers;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::string name = prefix + "_" + kLogCholeskyNames[k];
    if (const XMLElement* declared = find_named(document->robot(), kParameterTag, name)) {
      values[k] = read_number(XmlElement(declared, document), "value", Range::kAny);
      continue;
    }
    XMLElement* parameter =
        document->append_new(document->robot(), kParameterTag, inertial.where());
    parameter->SetAttribute("name", name.c_str());
    parameter->SetAttribute("value", to_decimal(values[k]).c_str());
    if (kLogCholeskyUnits[k][0] != '\0') parameter->SetAttribute("unit", kLogCholeskyUnits[k]);
  }
  write_inertial_twins(node, properties_of(values), prefix);
  node->DeleteAttribute(kAttribute);
}

}  // namespace

void write_out_free_inertias(XmlDocument* document) {
  for (XMLElement* link = document->robot()->FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    XMLElement* inertial = link->FirstChildElement("inertial");
    if (inertial != nullptr && inertial->FindAttribute(kAttribute) != nullptr)
      write_out(inertial, XmlElement(link, document).text("name"), document);
  }
}

}  // namespace codesign
