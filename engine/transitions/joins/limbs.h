#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <vector>

namespace etude {

/// A rotation vector: axis × angle, in radians. Bodies are joint positions without local frames, so a limb's rotation
/// is the smallest rotation from one direction of the limb to another.
using LimbTurn = glm::dvec3;

/// Returns the smallest rotation between the directions of two vectors; zero if either vector is zero. For opposite
/// directions, the axis is a fixed perpendicular of `from`.
LimbTurn TurnBetween(const glm::dvec3& from, const glm::dvec3& to);

/// Returns `v` rotated by `turn`; its length is unchanged.
glm::dvec3 Turned(const glm::dvec3& v, const LimbTurn& turn);

/// Returns the turn about the vertical from one direction to another, radians, in [−π, π]; 0 if either is vertical.
double TurnOnFloor(const glm::dvec3& from, const glm::dvec3& to);

/// Finds the largest turn within any run of frames.
class TurnMeter {
 public:
  /// Adds the turn from the previous frame to this one, radians; positive and negative turns cancel.
  void Add(double turn) {
    turned_ += turn;
    min_ = std::min(min_, turned_);
    max_ = std::max(max_, turned_);
    largest_ = std::max(largest_, max_ - min_);
  }
  /// Ends the run.
  void End() { turned_ = min_ = max_ = 0; }
  double largest() const { return largest_; }

 private:
  double turned_ = 0, min_ = 0, max_ = 0, largest_ = 0;
};

/// Returns the vector from the hip–ankle line to the knee, perpendicular to that line, in metres. The vector points in
/// the knee's direction, and its length grows as the leg bends.
glm::dvec3 KneeOffset(const glm::dvec3& hip, const glm::dvec3& knee, const glm::dvec3& ankle);

/// Rotates `offset`, a KneeOffset of a leg along `from`, by the smallest rotation from `from` to `to`.
glm::dvec3 CarriedOffset(const glm::dvec3& offset, const glm::dvec3& from, const glm::dvec3& to);

/// The solution of SolveLeg: knee and ankle.
struct Leg {
  glm::dvec3 knee{0}, ankle{0};
};

/// Solves two-bone inverse kinematics for a leg from `hip` to `ankle` whose limbs have the lengths `thigh` and `shin`.
/// If the leg is too short, the ankle is placed as near as possible on the line from hip to ankle. The knee points
/// towards `pole` (of any length; only its component perpendicular to the leg counts).
Leg SolveLeg(const glm::dvec3& hip, const glm::dvec3& ankle, double thigh, double shin, const glm::dvec3& pole);

constexpr double kStill = 0.005;  ///< metres; a foot that travels at most this far is not lifted
/// Returns the height of a step in its middle, metres, for a foot that travels `travel` metres; at most 5 cm.
double LiftFor(double travel);
/// Returns how far a hip must be lowered for its leg (of length `reach`) to reach the ankle, in metres; at most 10 cm.
double HipDrop(const glm::dvec3& hip, const glm::dvec3& ankle, double reach);
/// Returns a smooth curve (one value per frame) that is at least `needed`, except near its ends, where it goes down to
/// 0.
std::vector<double> SmoothlyAbove(const std::vector<double>& needed);

}  // namespace etude
