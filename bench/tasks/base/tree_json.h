#pragma once

#include <optional>
#include <span>
#include <string>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"
#include "io/files/json.h"

namespace etude {

/// Describes a body to methods outside the program, for inverse kinematics. Metres, degrees, Y up, right-handed; a
/// rotation is a list of its three rows, and turns vectors of the frame below into the frame above.
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
/// Forward kinematics gives every joint i a place p_i and a rotation R_i into the world. The root is the joint without
/// parent: p = `position_m`, R = `rotation` of DescribeRoot; it does not turn. For every other joint, in the order
/// given (parents come first), with its parent a:
///
///     p_i = p_a + R_a · offset_m
///     R_i = R_a · rest · Rx(q₀) · Ry(q₁) · Rz(q₂)
///
/// where Rx, Ry, Rz turn about x, y, z by the right-hand rule, and q₀… are the joint's angles: as many as it has
/// `axes`, from `first_angle` on, those it lacks being zero. An effector of joint i is at p_i + R_i · offset_m, its
/// rotation is R_i.
Json DescribeBodyTree(const KinematicTree& tree);

/// Tells what built-in solvers stop at: {"max_steps": 200, "position_goal_cm": 0.1, "orientation_goal_deg": 0.1}, the
/// latter for every single axis of an effector.
Json DescribeGoals(const IkOptions& options);

/// Tells where the root is: {"position_m": [0, 0, 0], "rotation": [[…], […], […]]}.
Json DescribeRoot(const TreeState& state);

/// Lists the targets in the tree's order: [{"effector": "right_foot", "position_m": [x, y, z], "rotation": [[…], […],
/// […]]}, …].
Json DescribeTargets(const KinematicTree& tree, std::span<const EffectorTarget> targets);

/// Writes radians as a list of degrees; ReadDegrees reads one of `count` numbers back, and refuses, naming `path`,
/// another count or more than a million degrees.
Json InDegrees(std::span<const double> angles);
Result<std::vector<double>> ReadDegrees(const Json& json, const std::string& path, std::size_t count);

/// Says which limits angles break: "2 angles outside the limits, angles_deg[4] the farthest, by 3.2°", or nothing. 10⁻⁶
/// degrees are rounding. `path` is where the angles stand: "angles_deg".
std::string DescribeBrokenLimits(const KinematicTree& tree, std::span<const double> angles, std::string_view path);

}  // namespace etude
