// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/contact_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>

#include "codegen/traced.h"
#include "math/arrays.h"

namespace codesign {
namespace {

/// A length below every gap that counts: it keeps directions finite where they are not defined, in
/// the centre of a hollow.
constexpr double kTiny = 1e-12;
/// The sine of the angle to the plane below which a disc counts as lying.
constexpr double kLying = 1e-6;

template <class T>
T softened_length(const T& x, const T& y, const T& z) {
  using std::sqrt;
  return sqrt(x * x + y * y + z * z + kTiny * kTiny);
}

// Surfaces.

template <class T>
SurfaceDistance<T> from_plane(const Vector3<T>& at, const ShapeNumbers<T>&) {
  return {at[2], Vector3<T>(0.0, 0.0, 1.0)};
}

/// The distance from a ball about the origin: of v, a part of `at`.
template <class T>
SurfaceDistance<T> from_centre(const Vector3<T>& v, const T& radius) {
  const T length = softened_length(v[0], v[1], v[2]);
  return {length - radius, (1.0 / length) * v};
}

template <class T>
SurfaceDistance<T> turned_inside_out(const SurfaceDistance<T>& of) {
  return {-of.distance, -of.normal};
}

template <class T>
SurfaceDistance<T> from_sphere(const Vector3<T>& at, const ShapeNumbers<T>& c) {
  return from_centre(at, c.radius);
}

template <class T>
SurfaceDistance<T> from_socket(const Vector3<T>& at, const ShapeNumbers<T>& c) {
  return turned_inside_out(from_centre(at, c.radius));
}

template <class T>
SurfaceDistance<T> from_bore(const Vector3<T>& at, const ShapeNumbers<T>& c) {
  return turned_inside_out(from_centre(Vector3<T>(at[0], at[1], 0.0), c.radius));
}

/// Whether a recording looks for all that its branches can depend on.
template <class T>
bool shows_all_branches(const Vector3<T>& at) {
  return takes_all_branches(at[0]) || takes_all_branches(at[1]) || takes_all_branches(at[2]);
}
/// Then what depends on the whole point stands for all of them.
template <class T>
SurfaceDistance<T> from_all_branches(const Vector3<T>& at) {
  const T sum = at[0] + at[1] + at[2];
  return {sum, Vector3<T>(sum, sum, sum)};
}

template <class T>
SurfaceDistance<T> from_capsule(const Vector3<T>& at, const ShapeNumbers<T>& c) {
  if (shows_all_branches(at)) return from_all_branches(at);
  const T half = 0.5 * c.length;
  const T low = -half;
  T along = at[2];
  if (is_less(half, along, false)) along = half;
  if (is_less(along, low, false)) along = low;
  return from_centre(Vector3<T>(at[0], at[1], at[2] - along), c.radius);
}

/// The distance from what lies within `beyond` <= 0 in each direction. @param outward the direction
/// of each.
template <class T, std::size_t N>
SurfaceDistance<T> from_edges(const std::array<T, N>& beyond,
                              const std::array<Vector3<T>, N>& outward) {
  using std::sqrt;
  Vector3<T> out = Vector3<T>::Zero();
  const T zero(0.0);
  T square(0.0);
  int outside = 0;
  std::size_t last = 0;
  for (std::size_t k = 0; k < N; ++k) {
    if (!is_less(zero, beyond[k], k + 1 == N)) continue;
    out += beyond[k] * outward[k];
    square += beyond[k] * beyond[k];
    ++outside;
    last = k;
  }
  if (outside == 1) return {beyond[last], outward[last]};
  if (outside > 1) {
    const T distance = sqrt(square);
    return {distance, (1.0 / distance) * out};
  }
  for (std::size_t k = 0; k + 1 < N; ++k)
    if (is_less(beyond[last], beyond[k + 1], true)) last = k + 1;
  return {beyond[last], outward[last]};
}

template <class T>
T sign_of(const T& x) {
  const T zero(0.0), one(1.0);
  return is_less(x, zero, false) ? -one : one;
}

template <class T>
SurfaceDistance<T> from_box(const Vector3<T>& at, const ShapeNumbers<T>& c) {
  if (shows_all_branches(at)) return from_all_branches(at);
  std::array<T, 3> beyond;
  std::array<Vector3<T>, 3> outward;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = to_signed(k);
    const T sign = sign_of(at[axis]);
    beyond[k] = sign * at[axis] - 0.5 * c.size[axis];
    outward[k].setZero();
    outward[k][axis] = sign;
  }
  return from_edges(beyond, outward);
}

template <class T>
SurfaceDistance<T> from_cylinder(const Vector3<T>& at, const ShapeNumbers<T>& c) {
  if (shows_all_branches(at)) return from_all_branches(at);
  const SurfaceDistance<T> side = from_centre(Vector3<T>(at[0], at[1], 0.0), c.radius);
  const T sign = sign_of(at[2]);
  const std::array<T, 2> beyond{sign * at[2] - 0.5 * c.length, side.distance};
  return from_edges<T, 2>(beyond, {Vector3<T>(0.0, 0.0, sign), side.normal});
}

/// Between two planes, of which the nearer one counts.
template <class T>
SurfaceDistance<T> from_slot(const Vector3<T>& at, const ShapeNumbers<T>& c) {
  if (shows_all_branches(at)) return from_all_branches(at);
  const T sign = sign_of(at[2]);
  return {0.5 * c.length - sign * at[2], Vector3<T>(0.0, 0.0, -sign)};
}

// Points.

template <class T>
Vector3<T> centre(int, const Vector3<T>&, const ShapeNumbers<T>&) {
  return Vector3<T>::Zero();
}

template <class T>
Vector3<T> end_of_capsule(int k, const Vector3<T>&, const ShapeNumbers<T>& c) {
  return Vector3<T>(0.0, 0.0, (k == 0 ? -0.5 : 0.5) * c.length);
}

template <class T>
Vector3<T> corner(int k, const Vector3<T>&, const ShapeNumbers<T>& c) {
  const auto side = [k](int axis) { return (k & (1 << axis)) != 0 ? 0.5 : -0.5; };
  return Vector3<T>(side(0) * c.size[0], side(1) * c.size[1], side(2) * c.size[2]);
}

/// The point of a disc's rim that lies furthest in a direction; the centre of a disc that lies.
template <class T>
Vector3<T> rim(int, const Vector3<T>& towards, const ShapeNumbers<T>& c) {
  using std::sqrt;
  const T across = towards[0] * towards[0] + towards[1] * towards[1],
          scale = c.radius / sqrt(across + kLying * kLying);
  return Vector3<T>(scale * towards[0], scale * towards[1], 0.0);
}

// Curvatures.

template <class T>
T no_curvature(const ShapeNumbers<T>&) {
  return 0.0;
}

template <class T>
T round_curvature(const ShapeNumbers<T>& c) {
  return 1.0 / c.radius;
}

template <class T>
T hollow_curvature(const ShapeNumbers<T>& c) {
  return -1.0 / c.radius;
}

constexpr ContactShape make_row(const char* name, Law<SurfaceFunction> surface) {
  ContactShape shape;
  shape.name = name;
  shape.surface = surface;
  return shape;
}

constexpr ContactShape make_round(const char* name, Law<SurfaceFunction> surface) {
  ContactShape shape = make_row(name, surface);
  shape.has_radius = true;
  return shape;
}

constexpr ContactShape sphere() {
  ContactShape shape = make_round("sphere", {from_sphere, from_sphere});
  shape.points = 1;
  shape.ball = true;
  shape.point = {centre, centre};
  shape.curvature = {round_curvature, round_curvature};
  return shape;
}

constexpr ContactShape plane() {
  ContactShape shape = make_row("plane", {from_plane, from_plane});
  shape.holds_points = shape.flat = true;
  shape.curvature = {no_curvature, no_curvature};
  return shape;
}

constexpr ContactShape hollow(const char* name, Law<SurfaceFunction> surface) {
  ContactShape shape = make_round(name, surface);
  shape.holds_points = true;
  return shape;
}

constexpr ContactShape socket() {
  ContactShape shape = hollow("socket", {from_socket, from_socket});
  shape.curvature = {hollow_curvature, hollow_curvature};
  return shape;
}

/// The journal of a bearing is taken as a ball, as by Flores and others.
constexpr ContactShape bore() {
  ContactShape shape = hollow("bore", {from_bore, from_bore});
  shape.curvature = {hollow_curvature, hollow_curvature};
  return shape;
}

constexpr ContactShape slot() {
  ContactShape shape = make_row("slot", {from_slot, from_slot});
  shape.has_length = shape.holds_points = true;
  shape.curvature = {no_curvature, no_curvature};
  return shape;
}

constexpr ContactShape capsule() {
  ContactShape shape = make_round("capsule", {from_capsule, from_capsule});
  shape.has_length = shape.ball = true;
  shape.points = 2;
  shape.point = {end_of_capsule, end_of_capsule};
  return shape;
}

constexpr ContactShape box() {
  ContactShape shape = make_row("box", {from_box, from_box});
  shape.has_size = true;
  shape.points = 8;
  shape.point = {corner, corner};
  return shape;
}

constexpr ContactShape cylinder() {
  ContactShape shape = make_round("cylinder", {from_cylinder, from_cylinder});
  shape.has_length = true;
  return shape;
}

constexpr ContactShape disc() {
  ContactShape shape = make_round("disc", {});
  shape.points = 1;
  shape.turns = true;
  shape.point = {rim, rim};
  return shape;
}

constexpr ContactShape kShapeTable[] = {
    sphere(), plane(), socket(), bore(), capsule(), box(), cylinder(), disc(), slot(),
};

}  // namespace

static_assert(std::string_view(kShapeTable[0].name) == "sphere",
              "the constants below count rows: append new ones");
static_assert(std::string_view(kShapeTable[2].name) == "socket" &&
              std::string_view(kShapeTable[3].name) == "bore" &&
              std::string_view(kShapeTable[5].name) == "box" &&
              std::string_view(kShapeTable[8].name) == "slot");
const ShapeKind ShapeKind::kSphere{kShapeTable[0]}, ShapeKind::kSocket{kShapeTable[2]},
    ShapeKind::kBore{kShapeTable[3]}, ShapeKind::kBox{kShapeTable[5]},
    ShapeKind::kSlot{kShapeTable[8]};

std::vector<ShapeKind> contact_shapes() {
  return std::vector<ShapeKind>(std::begin(kShapeTable), std::end(kShapeTable));
}

double extent_of(const ContactShape& shape, const ShapeNumbers<double>& numbers) {
  double extent = std::numeric_limits<double>::infinity();
  if (shape.has_radius) extent = numbers.radius;
  if (shape.has_size) extent = 0.5 * numbers.size.minCoeff();
  return extent;
}

}  // namespace codesign
