// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "description/robot.h"
#include "mechanism/mass_properties.h"
#include "reading/urdf/quantity_reader.h"
#include "reading/xml/xml_document.h"

namespace codesign {

/// A link's `<inertial>`; std::nullopt if there is none, or if mass and inertia are all zero, as
/// some exporters write massless links. Whether a body can have these numbers is checked later,
/// when it is known which links form a body (check_bodies()).
/// @throws InputError for missing or malformed values, and for plain values that disagree with the
/// shapes.
std::optional<InertialDescription> read_inertial(const XmlElement& link,
                                                 const ParameterTable& table);

/// Writes mass, centre and inertia into each `<inertial>` whose density an overlay gives: computed
/// from the shapes at the parameters' defaults, unless the overlay gives them as well.
/// @throws InputError as read_inertial().
void write_out_densities(XmlDocument* document);
/// Origin, mass and inertia as elements of an `<inertial>`, to be pasted.
std::string inertial_text(const MassProperties<double>& properties);

/// The `<inertial>` that a link has if its shapes are solids of this density [kg/m^3], to be
/// pasted.
/// @param from "visual" or "collision". @returns an empty text if there are no such shapes, or one
/// is no box, cylinder, sphere, or mesh that can be read.
std::string inertial_of_shapes(const XmlElement& link, const std::string& from, double density,
                               const ParameterTable& table);

/// Writes out every `<inertial codesign:inertia="free">`: the document gets ten
/// `<codesign:parameter>` LINK_alpha, LINK_d1 and so on (see kLogCholeskyNames), and mass, centre
/// and inertia get twins, so that every value of the parameters is physically possible; theory
/// (28e). The plain numbers do not change and are in the link's axes; a parameter that is declared
/// already, with bounds of its own or by an overlay with identified values, keeps its value and the
/// plain numbers follow. The attribute is removed.
/// @throws InputError for another value than `free`, beside a density or a twin, and for numbers of
/// a body without extent.
void write_out_free_inertias(XmlDocument* document);

}  // namespace codesign
