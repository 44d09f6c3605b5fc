#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/displacements.h"
#include "engine/motion/motion_faults.h"

namespace etude {

/// The joints of the feet.
inline constexpr std::array kFootJoints = {Role::kLeftFoot, Role::kRightFoot, Role::kLeftAnkle, Role::kRightAnkle};

/// A motion, its floor, and its positions without the displacements of the whole body (Displacements::common).
class GroundView {
 public:
  /// `motion` and `displacements` must outlive this object. FindMotionFaults says how the floor is found.
  GroundView(const BodyMotion& motion, const Displacements& displacements, const FaultOptions& options);

  const BodyMotion& motion() const { return motion_; }
  const std::vector<Displacement>& displacements() const { return displacements_.common; }
  const std::vector<VelocityStep>& velocity_steps() const { return displacements_.steps; }
  int frames() const { return static_cast<int>(motion_.poses.size()); }
  double floor() const { return floor_; }
  bool is_floor_found() const { return is_floor_found_; }
  /// Returns the displacement of the whole body in a frame, metres.
  const glm::dvec3& Offset(int frame) const { return offsets_[frame]; }
  /// Returns a joint's position without the displacements.
  glm::dvec3 Place(int frame, Role role) const { return motion_.poses[frame][role] - offsets_[frame]; }
  /// Returns a joint's velocity without the displacements, metres per second: the mean from a fifteenth of a second
  /// before the frame to a fifteenth after it.
  glm::dvec3 Velocity(int frame, Role role) const;

  /// Returns the height at which a foot joint rests most often, without the displacements, metres.
  double RestHeight(Role role) const {
    return role == Role::kLeftFoot || role == Role::kRightFoot ? toe_rest_ : ankle_rest_;
  }
  /// Returns the lower of the rest heights of toes and ankles.
  double LowestRest() const { return toe_rest_ < ankle_rest_ ? toe_rest_ : ankle_rest_; }
  /// Returns the smallest height of a foot joint above its rest height, metres, without the displacements.
  double FootHeight(int frame) const;
  /// Returns the height of the lowest joint, metres, with the displacements. Finger tips are ignored.
  double Lowest(int frame) const { return lowest_[frame]; }
  const std::vector<double>& lowest() const { return lowest_; }
  /// Returns true if only feet and hands are near the floor: all other joints are more than 20 cm above `LowestRest()`.
  bool IsOnFeet(int frame) const;
  /// Returns true if trunk and legs are upright.
  bool IsUpright(int frame) const { return is_upright_[frame]; }
  /// Returns the share of the frames in `range` in which trunk and legs are upright.
  double UprightShare(const FrameRange& range) const;
  double UprightShare() const { return UprightShare({0, frames() - 1}); }

  double Seconds(const FrameRange& range) const { return (range.last - range.first + 1) / motion_.rate_hz; }
  MotionFault FaultOf(FaultKind kind, const FrameRange& range, double size) const {
    return {kind, range.first / motion_.rate_hz, range.last / motion_.rate_hz, std::nullopt, size};
  }

 private:
  const BodyMotion& motion_;
  const Displacements& displacements_;
  std::vector<glm::dvec3> offsets_;
  std::vector<bool> is_upright_;
  std::vector<double> lowest_;
  double toe_rest_ = 0, ankle_rest_ = 0;
  double floor_ = 0;
  bool is_floor_found_ = false;
};

}  // namespace etude
