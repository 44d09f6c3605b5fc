#include "engine/capture/measure_joints.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/base/gaps.h"
#include "engine/base/order_statistics.h"
#include "engine/cameras/robust_triangulation.h"
#include "engine/kinematics/limb_lengths.h"

namespace etude {
namespace {

// Returns the information (inverse covariance) of a stroke's end. It is higher across the stroke than along it.
glm::dmat2 InformationOfEnd(const PixelSegment& stroke, const MarkErrors& errors) {
  const glm::dvec2 limb = stroke.b - stroke.a;
  const double length = glm::length(limb);
  const double across = errors.mark_error_px, along = std::hypot(across, errors.slide_share * length);
  if (!(length > 0)) return glm::dmat2(1 / (across * across));
  const glm::dvec2 t = limb / length, n(-t.y, t.x);
  return glm::outerProduct(t, t) / (along * along) + glm::outerProduct(n, n) / (across * across);
}

// Returns true if the role has a disc. A disc covers the end of its limb's stroke, so the visible stroke is too short.
bool HasDisc(const Marks& marks, Role role) {
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    if (EffectorMarks()[i].role == role) return marks.effectors[i].has_value();
  }
  return false;
}

using enum Role;

// The sightings of each role in one frame. A role has one sighting per picture that shows the role, fused from all
// marks of the role in that picture.
using FrameSightings = std::array<std::vector<InformedSighting>, kRoleCount>;

FrameSightings SightingsOf(const MeasureInputs& inputs, std::size_t frame, const MarkErrors& errors) {
  FrameSightings sightings;
  for (std::size_t camera = 0; camera < inputs.cameras.size(); ++camera) {
    std::array<glm::dmat2, kRoleCount> information{};
    std::array<glm::dvec2, kRoleCount> weighted{};
    for (const MarkedJoint& joint : MarkedJointsOf(inputs.marks[camera][frame], errors)) {
      information[Index(joint.role)] += joint.information;
      weighted[Index(joint.role)] += joint.information * joint.pixel;
    }
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      if (!(glm::determinant(information[i]) > 0)) continue;
      const glm::dvec2 pixel = glm::inverse(information[i]) * weighted[i];
      sightings[i].push_back({{inputs.cameras[camera], pixel}, information[i]});
    }
  }
  return sightings;
}

bool IsMeasured(const PointMeasurement& measurement) { return measurement.information != glm::dmat3(0); }

// Fills the gaps of a track linearly, and holds its first and last values.
std::vector<std::optional<glm::dvec3>> InterpolateTrack(std::span<const std::optional<glm::dvec3>> track) {
  std::vector<std::optional<glm::dvec3>> filled(track.begin(), track.end());
  const auto is_measured = [&](std::size_t frame) { return track[frame].has_value(); };
  FillGaps(track.size(), track.size(), is_measured,
           [&](std::size_t from, std::size_t frame, std::size_t to, double share) {
             filled[frame] = glm::mix(*track[from], *track[to], share);
           });
  for (std::size_t i = 1; i < filled.size(); ++i) {
    if (!filled[i]) filled[i] = filled[i - 1];
  }
  for (std::size_t i = filled.size(); i-- > 1;) {
    if (!filled[i - 1]) filled[i - 1] = filled[i];
  }
  return filled;
}

// Measures a joint that a single picture shows: the point of its sight line nearest to `near_W`.
std::optional<PointMeasurement> OnSightLine(const InformedSighting& seen, const glm::dvec3& near_W) {
  const auto line = SightLineOf(seen.sighting);
  if (!line) return std::nullopt;
  const glm::dvec3 position = NearestOn(*line, near_W);
  const auto sum = PointEquationsAt({&seen, 1}, position);
  if (!sum) return std::nullopt;
  // Standard deviation, along the sight line, of a joint that only one picture shows, metres *(ours)*. It is large
  // because the joint's depth is only interpolated between other frames.
  constexpr double kDepthError = 0.15;
  const glm::dmat3 depth = glm::outerProduct(line->direction_W, line->direction_W) / (kDepthError * kDepthError);
  return PointMeasurement{position, sum->information + depth};
}

std::vector<PointMeasurement> TrackOf(std::span<const JointMeasurements> measured, std::size_t role) {
  std::vector<PointMeasurement> track;
  for (const JointMeasurements& frame : measured) track.push_back(frame.joints[role]);
  return track;
}

SmoothedTrack SmoothLikeliest(std::span<const PointMeasurement> track, double rate_hz) {
  PointMotion motion{.frame_s = 1 / rate_hz};
  motion.acceleration_density = LikeliestAccelerationDensity(track, motion);
  return SmoothTrack(track, motion);
}

// Returns the median, over frames, of the variance of a joint's triangulated position along one axis, m².
std::optional<double> UsualVariance(std::span<const JointMeasurements> measured, std::size_t role) {
  std::vector<double> variances;
  for (const JointMeasurements& frame : measured) {
    if (!frame.is_triangulated[role]) continue;
    const glm::dmat3 covariance = glm::inverse(frame.joints[role].information);
    variances.push_back((covariance[0][0] + covariance[1][1] + covariance[2][2]) / 3);
  }
  if (variances.empty()) return std::nullopt;
  return UpperMedian(std::move(variances));
}

// Returns a vector from right to left across the body, from hips and shoulders if known.
std::optional<glm::dvec3> AcrossOf(const OptionalJoints& joints) {
  std::optional<glm::dvec3> across;
  for (const auto& [left, right] : {std::pair(kLeftHip, kRightHip), std::pair(kLeftShoulder, kRightShoulder)}) {
    if (!joints[Index(left)] || !joints[Index(right)]) continue;
    across = across.value_or(glm::dvec3(0)) + *joints[Index(left)] - *joints[Index(right)];
  }
  return across;
}

double YawOf(const glm::dvec3& across) { return std::atan2(-across.z, across.x); }

}  // namespace

std::vector<MarkedJoint> MarkedJointsOf(const Marks& marks, const MarkErrors& errors) {
  std::vector<MarkedJoint> joints;
  // Collect the ends of strokes and the discs.
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (!marks.strokes[i]) continue;
    const glm::dmat2 information = InformationOfEnd(*marks.strokes[i], errors);
    joints.push_back({StrokeMarks()[i].from, marks.strokes[i]->a, information});
    if (!HasDisc(marks, StrokeMarks()[i].to)) joints.push_back({StrokeMarks()[i].to, marks.strokes[i]->b, information});
  }
  const glm::dmat2 of_disc(1 / (errors.mark_error_px * errors.mark_error_px));
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    if (marks.effectors[i]) joints.push_back({EffectorMarks()[i].role, *marks.effectors[i], of_disc});
  }
  // Divide the information among all marks of one joint, because the annotator places all these marks by one decision.
  std::array<int, kRoleCount> count{};
  for (const MarkedJoint& joint : joints) ++count[Index(joint.role)];
  for (MarkedJoint& joint : joints) joint.information /= static_cast<double>(count[Index(joint.role)]);
  return joints;
}

std::vector<JointMeasurements> MeasureJoints(const MeasureInputs& inputs, const MarkErrors& errors) {
  assert(inputs.cameras.size() >= 2 && inputs.marks.size() == inputs.cameras.size());
  const std::size_t count = inputs.marks[0].size();
  std::vector<FrameSightings> sightings;
  std::vector<JointMeasurements> measured(count);
  for (std::size_t k = 0; k < count; ++k) sightings.push_back(SightingsOf(inputs, k, errors));
  for (std::size_t role = 0; role < kRoleCount; ++role) {
    // Triangulate the joint in the frames in which two or more pictures show it.
    std::vector<std::optional<glm::dvec3>> track(count);
    for (std::size_t k = 0; k < count; ++k) {
      const auto joint = TriangulateLikeliest(sightings[k][role]);
      if (!joint) continue;
      measured[k].joints[role] = {joint->position, joint->information};
      measured[k].is_triangulated[role] = true;
      track[k] = joint->position;
    }
    // If one picture shows the joint, use the sight line and the neighbouring frames.
    const auto filled = InterpolateTrack(track);
    for (std::size_t k = 0; k < count; ++k) {
      if (track[k] || !filled[k] || sightings[k][role].empty()) continue;
      measured[k].joints[role] = OnSightLine(sightings[k][role].front(), *filled[k]).value_or(PointMeasurement{});
    }
  }
  return measured;
}

std::vector<OptionalJoints> InterpolateJoints(std::span<const JointMeasurements> measured) {
  std::vector<OptionalJoints> joints(measured.size());
  for (std::size_t role = 0; role < kRoleCount; ++role) {
    std::vector<std::optional<glm::dvec3>> track;
    for (const JointMeasurements& frame : measured) {
      track.push_back(IsMeasured(frame.joints[role]) ? std::optional(frame.joints[role].position) : std::nullopt);
    }
    const auto filled = InterpolateTrack(track);
    for (std::size_t k = 0; k < measured.size(); ++k) joints[k][role] = filled[k];
  }
  return joints;
}

std::vector<OptionalJoints> SmoothJoints(std::span<const JointMeasurements> measured, double rate_hz) {
  std::vector<OptionalJoints> joints(measured.size());
  for (std::size_t role = 0; role < kRoleCount; ++role) {
    const std::vector<PointMeasurement> track = TrackOf(measured, role);
    if (std::ranges::none_of(track, IsMeasured)) continue;
    const SmoothedTrack smooth = SmoothLikeliest(track, rate_hz);
    for (std::size_t k = 0; k < measured.size(); ++k) joints[k][role] = smooth.positions[k];
  }
  return joints;
}

std::optional<BodyPose> CompleteJoints(const OptionalJoints& joints, const BodyPose& like) {
  // Interpolate the joints of the trunk.
  OptionalJoints filled = joints;
  const auto middle = [&](Role role, Role a, Role b, double share) {
    const auto &from = filled[Index(a)], &to = filled[Index(b)];
    if (from && to) filled[Index(role)] = glm::mix(*from, *to, share);
  };
  middle(kHipCentre, kLeftHip, kRightHip, 0.5);
  if (!filled[Index(kShoulderCentre)]) middle(kShoulderCentre, kLeftShoulder, kRightShoulder, 0.5);
  middle(kSpine, kHipCentre, kShoulderCentre, kSpineShare);
  if (std::ranges::none_of(filled, [](const auto& joint) { return joint.has_value(); })) return std::nullopt;

  // Attach each missing joint to its neighbour. The offset between the two comes from `like`, rotated by the
  // difference between the headings of this body and of `like`.
  const auto across = AcrossOf(joints);
  const glm::dvec3 like_across = like[kLeftHip] - like[kRightHip];
  const FloorMove turn{.yaw = across ? YawOf(*across) - YawOf(like_across) : 0};
  const auto limb = [&](const Bone& bone) { return turn.Apply(like[bone.child] - like[bone.parent]); };
  // Each pass of this loop attaches the joints that are one limb farther from the known joints.
  for (std::size_t round = 0; round < kRoleCount; ++round) {
    for (const Bone& bone : AllBones()) {
      auto &parent = filled[Index(bone.parent)], &child = filled[Index(bone.child)];
      if (parent && !child) child = *parent + limb(bone);
      if (child && !parent) parent = *child - limb(bone);
    }
  }
  BodyPose pose;
  for (std::size_t i = 0; i < kRoleCount; ++i) pose.joints[i] = *filled[i];
  return pose;
}

std::vector<BodyPose> SmoothPoses(std::span<const std::optional<BodyPose>> poses,
                                  std::span<const JointMeasurements> measured, double rate_hz) {
  assert(poses.size() == measured.size());
  std::vector<BodyPose> smooth(poses.size());
  constexpr double kUnknownVariance = 0.02 * 0.02;  // variance of a joint that was never triangulated, m² *(ours)*
  for (std::size_t role = 0; role < kRoleCount; ++role) {
    const double variance = UsualVariance(measured, role).value_or(kUnknownVariance);
    std::vector<PointMeasurement> track(poses.size());
    for (std::size_t k = 0; k < poses.size(); ++k) {
      if (poses[k]) track[k] = {poses[k]->joints[role], glm::dmat3(1 / variance)};
    }
    const SmoothedTrack of_role = SmoothLikeliest(track, rate_hz);
    for (std::size_t k = 0; k < poses.size(); ++k) smooth[k].joints[role] = of_role.positions[k];
  }
  return smooth;
}

}  // namespace etude
