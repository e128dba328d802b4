// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "description/expression.h"
#include "description/loss_law.h"
#include "description/signal_table.h"
#include "forces/contact_law.h"
#include "forces/contact_shape.h"
#include "forces/control_law.h"
#include "forces/friction_law.h"
#include "joints/joint_law.h"
#include "mechanism_codesign/error.h"
#include "mechanism_codesign/parameter.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

struct MeshMoments;
struct ParameterSwitch;

/// The tables of laws whose names a model and its study may use. A program adds a row of its own to
/// a copy of standard_laws() and reads its models with it; the row must outlive everything that is
/// read.
struct Laws {
  std::vector<FrictionModel> friction;
  std::vector<RowReference<JointLaw>> joints;
  std::vector<ControllerKind> controllers;
  std::vector<LossKind> losses;
  std::vector<ContactModel> contacts;
  std::vector<ShapeKind> shapes;
};

/// The laws of doc/annotations.md and doc/study.md.
const Laws& standard_laws();

/// The friction law of a name; std::nullopt if there is none.
std::optional<FrictionModel> find_friction(const Laws& laws, const std::string& name);
/// The names of a table's rows, in its order.
template <class Row>
std::vector<std::string> names_of(const std::vector<Row>& rows) {
  std::vector<std::string> names;
  for (const Row& row : rows) names.emplace_back(row->name);
  return names;
}

/// `<codesign:friction>`. Numbers that the model does not give keep the `standard` of their rule;
/// lengths and arms are then zero.
struct FrictionDescription : FrictionNumbers<Quantity> {
  FrictionDescription() {
    visit_friction_numbers(
        [](const FrictionNumberRule& rule, Quantity& number) { number = Quantity(rule.standard); },
        this);
  }

  FrictionModel model = FrictionModel::kBrownMcPhee;
  bool is_direct = false;  ///< in N m or N, theory (10a); else coefficients over a normal force
  /// a number for motion against the axis is given; else they are unused
  bool is_directional = false;
  bool has_exponent = false;  ///< viscous_exponent is given
  /// transition_velocity is not given and follows the machine, theory (13i); its value is that
  /// without any mass
  bool transition_follows = false;
  std::optional<std::array<double, 3>> transverse_axis;  ///< x'' in the joint frame
  SourceLocation where;
};

/// A pose in URDF's `<origin>`.
struct PoseDescription {
  QuantityVector xyz;  ///< translation [m]
  QuantityVector rpy;  ///< fixed-axis roll, pitch, yaw [rad]
};

/// A visual or collision solid.
struct ShapeDescription {
  enum class Kind { kBox, kCylinder, kSphere, kMesh };
  Kind kind = Kind::kMesh;
  PoseDescription origin;  ///< in the link frame; a cylinder's axis is its z
  /// box: x y z; cylinder: radius, length; sphere: radius [m]; mesh: its scale
  std::array<Quantity, 3> size;
  std::shared_ptr<const MeshMoments> mesh;  ///< kMesh: in the unit of its file
};

/// Mass properties of a link, given as numbers or computed from its shapes.
struct InertialDescription {
  PoseDescription origin;           ///< centre of mass and axes of the inertia, in the link frame
  Quantity mass;                    ///< [kg]
  std::array<Quantity, 6> inertia;  ///< about `origin`: ixx ixy ixz iyy iyz izz [kg m^2]
  /// If present, mass, centre and inertia are computed from `shapes` with this density [kg/m^3];
  /// the three fields above are unused.
  std::optional<Quantity> density;
  std::vector<ShapeDescription> shapes;
  SourceLocation where;
};

/// A `<link>`; without inertial it has no mass.
struct LinkDescription {
  std::string name;
  std::optional<InertialDescription> inertial;
  SourceLocation where;
  bool stays = false;  ///< a link without mass that is not folded into a joint
};

/// `<limit>`. Exporters write zeros for unknown limits; the three bounds_ functions tell which
/// limits count.
struct LimitDescription {
  Quantity lower, upper;      ///< position [rad or m]
  Quantity effort, velocity;  ///< [N m or N], [rad/s or m/s]

  /// False if both limits are zero or missing.
  bool bounds_position() const { return !lower.is_zero() || !upper.is_zero(); }
  bool bounds_effort() const { return !effort.is_zero(); }
  bool bounds_velocity() const { return !velocity.is_zero(); }
};

/// `<mimic>`: theta = multiplier * theta_joint + offset, with theta_joint of the joint that is
/// followed; theory (8a).
struct MimicDescription {
  std::string joint;
  Quantity multiplier{1.0}, offset{0.0};
  SourceLocation where;
};

/// `<codesign:torsion_spring>`: load stiffness * (theta - free_position) + damping * theta' against
/// the coordinate; theory (13).
struct TorsionSpringDescription {
  /// [N m/rad or N/m], [N m s/rad or N s/m], [rad or m]
  Quantity stiffness, damping, free_position;
};

/// The losses of an actuator's gear and motor, theory (9b).
struct GearDescription {
  std::optional<Quantity> efficiency;  ///< eta, 0 ... 1; none: no loss by torque
  /// eta_b, at most 1; none: as many losses per torque
  std::optional<Quantity> backdrive_efficiency;
  Quantity coulomb, viscous;  ///< T_c [N m] and b [N m s/rad] at the motor's shaft
  FrictionDescription slip;   ///< law of the flanks, direct, with T_s = T_c = 1 [rad/s or m/s]
};

/// The compliance of an actuator's gear, theory (9c), at the joint's side.
struct ElasticGearDescription {
  Quantity stiffness, damping;       ///< k [N m/rad or N/m], d [N m s/rad or N s/m]
  std::optional<Quantity> backlash;  ///< b [rad or m], the whole play; none: no play
};

/// The circuit of an actuator's DC motor, theory (9d).
struct WindingDescription {
  Quantity resistance, inductance;      ///< R > 0 [ohm], L [H]; L = 0: the current has no state
  Quantity torque_constant;             ///< K > 0 [N m/A], also that of the voltage, [V s/rad]
  std::optional<Quantity> bus_voltage;  ///< [V] bounds the voltage; none: no bound

  bool has_state() const { return !inductance.is_zero(); }
};

/// `<codesign:actuator>`: a motor whose rotor turns `gear_ratio` times as fast as the joint; theory
/// (9a). The rotor is carried by the parent link and turns about the joint's axis.
struct ActuatorDescription {
  Quantity gear_ratio{1.0};  ///< n, rotor rate per joint rate [-, or rad/m on a prismatic joint]
  /// J_r about the rotor's axis [kg m^2]; reflected to the joint as n^2 J_r
  Quantity rotor_inertia;
  std::optional<GearDescription> gear;
  std::optional<ElasticGearDescription> elastic;  ///< none: the gear is rigid
  std::optional<WindingDescription> winding;      ///< none: its torque is the controllers' output
  SourceLocation where;
};

/// A joint of the tree, or a loop. The joint frame moves with the child (of a loop: the successor).
struct JointDescription {
  std::string name;
  JointType type = JointType::kFixed;
  std::optional<PairKind> own_kind;  ///< kOther: the row that the file names
  bool is_loop = false;
  /// of a loop: reactions out of the plane of its motion are stated to be zero; theory (23c)
  bool in_plane = false;
  /// indices into RobotDescription::links; of a loop: predecessor, successor
  int parent = -1, child = -1;
  PoseDescription origin;  ///< joint frame at zero position in the parent's link frame
  /// joint frame in the child's link frame; the identity for a tree joint
  PoseDescription child_origin;
  QuantityVector axis{1.0, 0.0, 0.0};  ///< in the joint frame, not necessarily of unit length
  /// universal loops: the successor's axis, in the successor's joint frame
  QuantityVector second_axis{0.0, 1.0, 0.0};
  Quantity distance;  ///< kDistance: the length [m]
  std::optional<FrictionDescription> friction;
  Quantity damping, dry_friction;  ///< `<dynamics damping friction>`
  /// inertia of the coordinate alone [kg m^2 or kg], theory (9e), of the motor's side of an elastic
  /// gear; of `<codesign:actuator>`, or of `<dynamics>` without one
  Quantity armature;
  /// of dry_friction [rad/s or m/s]: no file gives it; theory (13)
  double dry_transition_velocity = 1e-2;
  std::optional<LimitDescription> limit;
  std::optional<MimicDescription> mimic;
  std::optional<TorsionSpringDescription> spring;
  std::optional<ActuatorDescription> actuator;
  /// kFloating: the child's orientation at zero turning coordinates, as rpy in the joint frame
  /// [rad]; taken from the study's initial state.
  QuantityVector start_rotation;
  /// Of a joint with one coordinate: where the study starts it, `position` or `guess` [rad or m];
  /// it tells apart the two triples of Euler angles that are one orientation.
  std::optional<Quantity> start_position;
  /// the joint of the motor's side of an elastic gear, with_motor_sides(); -1: motor and joint move
  /// together
  int motor = -1;
  bool is_motor = false;  ///< it is such a joint
  /// it lets another joint play, read_clearances(): zero at the start unless the study says
  /// otherwise
  bool is_play = false;
  SourceLocation where;

  /// Its row of the table of joints: what it leaves free, and how.
  const JointLaw& law() const { return own_kind ? **own_kind : row_of(type); }
  const JointFreedoms& freedoms() const { return law().freedoms; }
  /// As those of JointLaw.
  bool has_one_coordinate() const { return law().has_one_coordinate(); }
  bool is_turn() const { return law().is_turn(); }
  bool is_slide() const { return law().is_slide(); }
  /// A joint of the tree whose start is a pose, of its child in the joint frame.
  bool has_pose() const { return !is_loop && freedoms().size() > 1; }
  /// Whether it holds its two links together as one.
  bool is_fixed() const { return type == JointType::kFixed; }

  bool has_elastic_gear() const { return actuator && actuator->elastic; }
  /// Whether a voltage moves it.
  bool has_winding() const { return actuator && actuator->winding; }
  /// Whether the torque that the actuator's gear transmits is known: a loss in proportion to it
  /// needs it, (9b), and a spring determines it, (9c).
  bool has_gear_torque() const {
    return has_elastic_gear() || (actuator && actuator->gear && actuator->gear->efficiency);
  }

  /// The element for messages: `<joint name="crank_joint">` or `<loop name="close">`.
  std::string element() const {
    return (is_loop ? "<loop name=\"" : "<joint name=\"") + name + "\">";
  }
};

/// The kind of pair that a single joint or loop makes.
PairKind kind_of(const JointDescription& joint);

/// Whether `<limit lower upper>` bounds the joint's position. On a continuous joint URDF ignores
/// both.
inline bool has_stops(const JointDescription& joint) {
  return joint.limit && joint.limit->bounds_position() && joint.law().needs_limit;
}

/// URDF+ `<coupling>`: the joints up to the successor move `ratio` times as far as the joints up to
/// the predecessor; theory (8a).
struct CouplingDescription {
  std::string name;
  int predecessor = -1, successor = -1;  ///< links
  Quantity ratio{1.0};
  SourceLocation where;
};

/// `<codesign:spring_damper>` between a point of each of two links; theory (13b).
struct SpringDamperDescription {
  std::string name;
  int predecessor = -1, successor = -1;  ///< links
  /// the points, in the frames of the links; rpy is unused
  PoseDescription predecessor_origin, successor_origin;
  Quantity stiffness, damping, free_length;  ///< [N/m], [N s/m], [m]
  SourceLocation where;
};

/// The axes of a shape in a joint with clearance: z along the joint's axis, x along x''.
struct ShapeAxes {
  QuantityVector axis;                              ///< of the joint, in its frame
  std::optional<std::array<double, 3>> transverse;  ///< towards x''; none: transverse_axis()
  bool across = false;                              ///< z is x'', and x is y''
};

/// One side of a contact: a shape that a link carries.
struct ContactEnd {
  int link = -1;
  PoseDescription origin;         ///< the frame of the shape in that of the link
  std::optional<ShapeAxes> axes;  ///< the shape's in that frame; none: those of the frame
  Quantity clearance;             ///< [m], by which a hollow shape is larger than what it holds
  ShapeKind shape = ShapeKind::kSphere;
  Quantity radius, length;                 ///< [m]; those that the shape does not have are zero
  QuantityVector size;                     ///< [m]
  std::optional<Quantity> youngs_modulus;  ///< [Pa]; none: rigid
  Quantity poisson_ratio;                  ///< [-]
};

/// `<codesign:contact>` between a shape of each of two links; theory (13k) to (13m).
struct ContactDescription {
  std::string name;
  ContactEnd surface, points;  ///< the side that touches with its surface, and with its points
  ContactModel model = ContactModel::kHuntCrossley;
  std::optional<Quantity> stiffness;  ///< [N/m^n]; none: by Hertz from the ends
  Quantity exponent;                  ///< n [-]
  /// lambda [s/m], or c [N s/m]; none: by restitution, or no loss
  std::optional<Quantity> loss;
  std::optional<Quantity> restitution;  ///< [-]
  Quantity impact_velocity;             ///< at which `restitution` holds [m/s]
  std::optional<FrictionDescription> friction;
  SourceLocation where;
  std::string clearance;  ///< the element of the joint whose clearance this is; empty: of none

  bool has_loss() const { return loss || restitution; }
  /// The element for messages: `<codesign:contact name="sole">`.
  std::string element() const {
    return clearance.empty() ? "<codesign:contact name=\"" + name + "\">" : clearance;
  }
};

/// A mechanism as the annotated URDF describes it; nothing is derived from it yet.
struct RobotDescription {
  // Defined in one file: the members of all lists would else be compiled wherever one is copied or
  // destroyed.
  RobotDescription();
  RobotDescription(const RobotDescription&);
  RobotDescription(RobotDescription&&) noexcept;
  RobotDescription& operator=(const RobotDescription&);
  RobotDescription& operator=(RobotDescription&&) noexcept;
  ~RobotDescription();

  std::string name;
  std::vector<Parameter> parameters;
  /// indices of the parameters on which a number of the file depends, visuals included
  std::set<int> used_parameters;
  std::vector<ParameterSwitch> switches;  ///< of its numbers
  std::vector<LinkDescription> links;
  int root = 0;                          ///< index of the root link, which is the ground
  std::vector<JointDescription> joints;  ///< tree joints in file order, then loops in file order
  std::vector<CouplingDescription> couplings;
  std::vector<SpringDamperDescription> spring_dampers;
  std::vector<ContactDescription> contacts;
  Laws laws = standard_laws();  ///< those that its files and its study may name
  std::string file;             ///< the file it was read from, for messages
  Warnings warnings;            ///< from reading the files, in the order of the files
};

/// The index of a joint or loop in RobotDescription::joints; -1 if none has this name.
int joint_named(const RobotDescription& robot, const std::string& name);

/// A kind of elements between two links, which a model names and which have signals.
struct LinkElementKind {
  SignalOwner owner;
  const char* tag;   ///< of its elements in the model
  const char* word;  ///< for messages: "spring"
  /// Whether one may have the name of a link, joint or element of another kind: the quantity of a
  /// signal then tells them apart.
  bool shares_names;
};

/// Calls visit(kind, list) for each kind. A new kind has its structure, its list and a row here;
/// doc/architecture.md says what else it needs.
template <class Robot, class Visit>
void for_each_link_element_kind(Robot& robot, const Visit& visit) {
  visit(LinkElementKind{SignalOwner::kSpring, "codesign:spring_damper", "spring", true},
        robot.spring_dampers);
  visit(LinkElementKind{SignalOwner::kContact, "codesign:contact", "contact", false},
        robot.contacts);
}

/// The tags of all kinds.
inline std::vector<std::string> link_element_tags() {
  std::vector<std::string> tags;
  const RobotDescription robot;
  for_each_link_element_kind(
      robot, [&tags](const LinkElementKind& kind, const auto&) { tags.emplace_back(kind.tag); });
  return tags;
}

}  // namespace codesign
