#pragma once

#include <span>
#include <string>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"
#include "io/files/json.h"

namespace etude {

/// Describes a body to outside methods, for inverse kinematics. Units are metres and degrees; Y is up; the frame is
/// right-handed. A rotation is a list of its three rows and transforms vectors from the child's frame to the parent's.
///
/// The body as a kinematic tree:
///
///     {"joints": [{"name": "left_toe", "parent": null, "offset_m": [0, 0, 0], "rest": [[…], […], […]],
///                  "first_angle": 0, "axes": []},
///                 {"name": "left_ankle", "parent": 0, "offset_m": [0, 0, 0.18], "rest": [[…], […], […]],
///                  "first_angle": 0, "axes": ["x"]}, …],
///      "angles": [{"name": "left_ankle.x", "lower_deg": -20, "upper_deg": 50}, …],
///      "effectors": [{"name": "right_foot", "joint": 14, "offset_m": [0, 0, 0.18]}, …]}
///
/// Forward kinematics gives every joint i a position p_i and a rotation R_i to the world. The root is the joint without
/// parent: p = `position_m`, R = `rotation` of DescribeRoot; it has no angles. For every other joint, in the order
/// given (parents come first), with its parent a:
///
///     p_i = p_a + R_a · offset_m
///     R_i = R_a · rest · Rx(q₀) · Ry(q₁) · Rz(q₂)
///
/// where Rx, Ry, Rz turn about x, y, z by the right-hand rule. The joint has one angle for each of its `axes`, from
/// index `first_angle` on; the angles about other axes are zero. An effector of joint i is at p_i + R_i · offset_m and
/// has the rotation R_i.
Json DescribeBodyTree(const KinematicTree& tree);

/// Describes when built-in solvers stop: {"max_steps": 200, "position_goal_cm": 0.1, "orientation_goal_deg": 0.1}. The
/// orientation goal applies to each axis of an effector.
Json DescribeGoals(const IkOptions& options);

/// Describes the pose of the root: {"position_m": [0, 0, 0], "rotation": [[…], […], […]]}.
Json DescribeRoot(const TreeState& state);

/// Lists the targets in the tree's order: [{"effector": "right_foot", "position_m": [x, y, z], "rotation": [[…], […],
/// […]]}, …].
Json DescribeTargets(const KinematicTree& tree, std::span<const EffectorTarget> targets);

/// InDegrees encodes angles in radians as a list of degrees. ReadDegrees reads a list of `count` numbers back. It
/// fails, naming `path`, if the count differs or an angle exceeds a million degrees.
Json InDegrees(std::span<const double> angles);
Result<std::vector<double>> ReadDegrees(const Json& json, const std::string& path, std::size_t count);

/// Describes the limits that are exceeded: "2 angles outside the limits; angles_deg[4] is the farthest outside,
/// by 3.2°". Returns "" if no limit is exceeded by more than 10⁻⁶ degrees (rounding). `path` is the position of the
/// angles in the answer: "angles_deg".
std::string DescribeBrokenLimits(const KinematicTree& tree, std::span<const double> angles, std::string_view path);

}  // namespace etude
