#pragma once

#include <optional>
#include <vector>

#include "bench/files/json.h"
#include "bench/tasks/ik/ik_world.h"

namespace etude {

/// What methods outside the program are told about inverse kinematics, and what they answer. Metres, degrees, Y up,
/// right-handed; a rotation is a list of its three rows, and turns vectors of the frame below into the frame above.
///
/// Setting, the body as a kinematic tree:
///
///     {"joints": [{"name": "left_toe", "parent": null, "offset_m": [0, 0, 0], "rest": [[…], […], […]],
///                  "first_angle": 0, "axes": []},
///                 {"name": "left_ankle", "parent": 0, "offset_m": [0, 0, 0.18], "rest": [[…], […], […]],
///                  "first_angle": 0, "axes": ["x"]}, …],
///      "angles": [{"name": "left_ankle.x", "lower_deg": -20, "upper_deg": 50}, …],
///      "effectors": [{"name": "right_foot", "joint": 14, "offset_m": [0, 0, 0.18]}, …],
///      "max_steps": 200, "position_goal_cm": 0.1, "orientation_goal_deg": 0.1}
///
/// Forward kinematics gives every joint i a place p_i and a rotation R_i into the world. The root is the joint without
/// parent: p = the problem's `root.position_m`, R = `root.rotation`; it does not turn. For every other joint, in the
/// order given (parents come first), with its parent a:
///
///     p_i = p_a + R_a · offset_m
///     R_i = R_a · rest · Rx(q₀) · Ry(q₁) · Rz(q₂)
///
/// where Rx, Ry, Rz turn about x, y, z by the right-hand rule, and q₀… are the joint's angles: as many as it has
/// `axes`, from `first_angle` on, those it lacks being zero. An effector of joint i is at p_i + R_i · offset_m, its
/// rotation is R_i.
Json DescribeTree(const KinematicTree& tree, int max_steps, double position_goal, double axis_goal);

/// Problem: where the root is, where to begin, and where each effector shall be, in the setting's order:
///
///     {"root": {"position_m": [0, 0, 0], "rotation": [[…], […], […]]},
///      "start_angles_deg": [twenty-nine numbers, all within their limits],
///      "targets": [{"effector": "right_foot", "position_m": [x, y, z], "rotation": [[…], […], […]]}, …]}
///
/// Asked for are angles that bring every effector to its target: the distance below `position_goal_cm`, and the mean
/// of the angles between its three axes (the columns of its rotation) and the target's below `orientation_goal_deg`.
Json DescribeProblem(const KinematicTree& tree, const IkProblem& problem);

/// Truth: the angles that the targets were made with; itself a perfect answer.
///
///     {"angles_deg": [twenty-nine numbers]}
Json DescribeTruth(const IkWorld& world);

/// What a method outside answers:
///
///     {"angles_deg": [twenty-nine numbers], "iterations": 12, "fk_evaluations": 13}
///
/// The last two may be left out; the metrics of cost are then missing. `iterations` are the method's own steps,
/// `fk_evaluations` its passes of forward kinematics over the whole tree. Angles are taken as they are, never moved
/// into their limits: an answer that breaks a limit by more than 10⁻⁶ degrees is measured, and counts as unsolved.
struct IkAnswer {
  std::vector<double> angles;  ///< radians
  std::optional<int> iterations;
  std::optional<int> fk_evaluations;
};

/// Refuses what is not as told above, and angles of more than a million degrees.
Result<IkAnswer> ReadIkAnswer(const Json& answer, const KinematicTree& tree);

}  // namespace etude
