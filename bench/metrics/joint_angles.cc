#include "bench/metrics/joint_angles.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "engine/base/angles.h"

namespace etude {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr glm::dvec3 kDown(0, -1, 0);

/// A body segment: the index of the joint that carries the segment's rotation, and the segment's rotation from the rest
/// pose to the neutral pose.
struct Segment {
  int joint = -1;
  glm::dquat neutral{1, 0, 0, 0};
};

/// A joint of the body, with the segments above and below it.
struct BodyJoint {
  std::string name;
  Segment above, below;
  /// The signs that make flexion, abduction and rotation positive (rotations about X, Z and Y).
  double flexion = 1, abduction = 1, rotation = 1;
};

/// Returns the nearest common ancestor of joints `a` and `b`; −1 if there is none.
int CarrierOf(const RawMotion& motion, int a, int b) {
  for (int above = a < 0 || b < 0 ? -1 : motion.parents[a]; above >= 0; above = motion.parents[above]) {
    for (int other = motion.parents[b]; other >= 0; other = motion.parents[other]) {
      if (other == above) return above;
    }
  }
  return -1;
}

/// Returns the shortest rotation that turns direction `from` into direction `to`.
glm::dquat ShortestArc(const glm::dvec3& from, const glm::dvec3& to) {
  const double length = glm::length(from) * glm::length(to);
  if (length == 0) return {1, 0, 0, 0};
  const double cosine = glm::dot(from, to) / length;
  if (cosine < -1 + 1e-12) return {0, 0, 0, 1};  // the directions are opposite: half a turn about Z
  return glm::normalize(glm::dquat(1 + cosine, glm::cross(from, to) / length));
}

class AngleReader {
 public:
  explicit AngleReader(const RawMotion& motion) : motion_(motion) {}

  AngleTracks Read() {
    if (motion_.rotations.empty() || !FindAxes()) return {};
    FindJoints();
    AngleTracks angles;
    for (const BodyJoint& joint : joints_) {
      for (const char* axis : {"_flexion", "_abduction", "_rotation"}) angles.names.push_back(joint.name + axis);
    }
    for (std::size_t f = 0; f < motion_.FrameCount(); ++f) {
      for (const BodyJoint& joint : joints_) AddAngles(joint, f, angles.degrees);
    }
    return angles;
  }

 private:
  int Playing(Role role) const { return motion_.roles[Index(role)]; }

  /// Finds the body's axes in the rest pose. Returns false if a hip is missing, or if one hip is exactly above the
  /// other.
  bool FindAxes() {
    const int left = Playing(Role::kLeftHip), right = Playing(Role::kRightHip);
    if (left < 0 || right < 0) return false;
    glm::dvec3 across = motion_.rest_positions[left] - motion_.rest_positions[right];
    across.y = 0;
    if (glm::length(across) == 0) return false;
    across = glm::normalize(across);
    const glm::dvec3 up(0, 1, 0);
    axes_ = glm::quat_cast(glm::dmat3(across, up, glm::cross(across, up)));
    return true;
  }

  /// Returns the segment of `joint`, with the rest pose as the segment's neutral pose.
  static Segment AsAtRest(int joint) { return {joint}; }
  /// Returns the segment from `joint` to `next`. The segment hangs down in the neutral pose.
  Segment Hanging(int joint, int next) const {
    if (joint < 0 || next < 0) return {joint};
    const glm::dvec3 direction = motion_.rest_positions[next] - motion_.rest_positions[joint];
    return {joint, ShortestArc(glm::inverse(axes_) * direction, kDown)};
  }

  void Add(BodyJoint joint) {
    if (joint.above.joint < 0 || joint.below.joint < 0 || joint.above.joint == joint.below.joint) return;
    joints_.push_back(std::move(joint));
  }

  void FindJoints() {
    using enum Role;
    // Add the joints of the trunk.
    const Segment pelvis = AsAtRest(CarrierOf(motion_, Playing(kLeftHip), Playing(kRightHip)));
    const Segment thorax = AsAtRest(CarrierOf(motion_, Playing(kLeftShoulder), Playing(kRightShoulder)));
    Add({"trunk", pelvis, thorax, 1, -1, 1});
    Add({"head", thorax, AsAtRest(Playing(kHead)), 1, -1, 1});
    struct Side {
      const char* name;
      double out;
      Role hip, knee, ankle, shoulder, elbow, wrist;
    };
    const Side sides[] = {{"left_", 1, kLeftHip, kLeftKnee, kLeftAnkle, kLeftShoulder, kLeftElbow, kLeftWrist},
                          {"right_", -1, kRightHip, kRightKnee, kRightAnkle, kRightShoulder, kRightElbow, kRightWrist}};
    // Add the joints of each side. The segments of arms and legs hang down in the neutral pose.
    for (const Side& side : sides) {
      const auto hanging = [&](Role from, Role to) { return Hanging(Playing(from), Playing(to)); };
      const Segment thigh = hanging(side.hip, side.knee), shank = hanging(side.knee, side.ankle);
      const Segment arm = hanging(side.shoulder, side.elbow), forearm = hanging(side.elbow, side.wrist);
      Segment hand = forearm;  // in the neutral pose, the hand continues the line of the forearm
      hand.joint = Playing(side.wrist);
      const auto add = [&](const char* name, const Segment& above, const Segment& below, double flexion) {
        Add({std::string(side.name) + name, above, below, flexion, side.out, -side.out});
      };
      add("hip", pelvis, thigh, -1);
      add("knee", thigh, shank, 1);
      add("ankle", shank, AsAtRest(Playing(side.ankle)), -1);
      add("shoulder", thorax, arm, -1);
      add("elbow", arm, forearm, -1);
      add("wrist", forearm, hand, -1);
    }
  }

  /// Returns the rotation of a segment from the neutral pose, expressed in the body's axes.
  glm::dquat FromNeutral(const Segment& segment, std::size_t frame) const {
    const std::size_t joints = motion_.joints.size();
    const glm::dquat from_rest =
        motion_.rotations[frame * joints + segment.joint] * glm::inverse(motion_.rest_rotations[segment.joint]);
    return glm::inverse(axes_) * from_rest * axes_ * glm::inverse(segment.neutral);
  }

  void AddAngles(const BodyJoint& joint, std::size_t frame, std::vector<double>& degrees) const {
    if (!IsSeen(motion_.At(frame, joint.above.joint)) || !IsSeen(motion_.At(frame, joint.below.joint))) {
      degrees.insert(degrees.end(), 3, kUnknown);
      return;
    }
    const glm::dmat3 m =
        glm::mat3_cast(glm::inverse(FromNeutral(joint.above, frame)) * FromNeutral(joint.below, frame));
    // Decompose m = Rx · Rz · Ry; the matrix is stored as m[column][row].
    const double about_x = std::atan2(m[1][2], m[1][1]), about_y = std::atan2(m[2][0], m[0][0]);
    const double about_z = std::asin(std::clamp(-m[1][0], -1.0, 1.0));
    degrees.insert(degrees.end(), {joint.flexion * Degrees(about_x), joint.abduction * Degrees(about_z),
                                   joint.rotation * Degrees(about_y)});
  }

  const RawMotion& motion_;
  glm::dquat axes_{1, 0, 0, 0};
  std::vector<BodyJoint> joints_;
};

/// Returns the angle that equals `degrees` modulo 360 and lies within 180° of `other`.
double Near(double degrees, double other) { return other + std::remainder(degrees - other, 360.0); }

}  // namespace

AngleTracks AnglesOfRotations(const RawMotion& motion) { return AngleReader(motion).Read(); }

std::vector<double> EncodeSums(const AgreementSums& sums) {
  return {sums.count, sums.mean_truth, sums.mean_found, sums.square_truth, sums.square_found, sums.product};
}

std::optional<AgreementSums> DecodeSums(std::span<const double> v) {
  if (v.size() != 6) return std::nullopt;
  return AgreementSums{v[0], v[1], v[2], v[3], v[4], v[5]};
}

AgreementSums SumAgreement(const AngleTracks& found, const AngleTracks& truth, std::size_t column) {
  assert(found.degrees.size() == truth.degrees.size());
  // Compute the circular mean of the truth's angle, over the frames in which both angles are known.
  std::vector<std::size_t> places;
  double sine = 0, cosine = 0;
  for (std::size_t at = column; at < truth.degrees.size(); at += truth.names.size()) {
    if (std::isnan(truth.degrees[at]) || std::isnan(found.degrees[at])) continue;
    places.push_back(at);
    sine += std::sin(Radians(truth.degrees[at]));
    cosine += std::cos(Radians(truth.degrees[at]));
  }
  const double middle = Degrees(std::atan2(sine, cosine));
  // Accumulate the sums by Welford's algorithm.
  AgreementSums sums;
  for (const std::size_t at : places) {
    const double t = Near(truth.degrees[at], middle), f = Near(found.degrees[at], t);
    sums.count += 1;
    const double off_t = t - sums.mean_truth, off_f = f - sums.mean_found;
    sums.mean_truth += off_t / sums.count;
    sums.mean_found += off_f / sums.count;
    sums.square_truth += off_t * (t - sums.mean_truth);
    sums.square_found += off_f * (f - sums.mean_found);
    sums.product += off_t * (f - sums.mean_found);
  }
  return sums;
}

AgreementSums Together(const AgreementSums& a, const AgreementSums& b) {
  if (a.count == 0 || b.count == 0) return a.count == 0 ? b : a;
  AgreementSums sums;
  sums.count = a.count + b.count;
  const double off_t = b.mean_truth - a.mean_truth, off_f = b.mean_found - a.mean_found;
  const double part = b.count / sums.count, weight = a.count * part;
  sums.mean_truth = a.mean_truth + part * off_t;
  sums.mean_found = a.mean_found + part * off_f;
  sums.square_truth = a.square_truth + b.square_truth + weight * off_t * off_t;
  sums.square_found = a.square_found + b.square_found + weight * off_f * off_f;
  sums.product = a.product + b.product + weight * off_t * off_f;
  return sums;
}

std::optional<double> RmsOf(const AgreementSums& sums) {
  if (sums.count == 0) return std::nullopt;
  const double bias = sums.mean_found - sums.mean_truth;
  const double square = std::max(0.0, sums.square_truth + sums.square_found - 2 * sums.product);
  return std::sqrt(square / sums.count + bias * bias);
}

std::optional<double> BiasOf(const AgreementSums& sums) {
  if (sums.count == 0) return std::nullopt;
  return sums.mean_found - sums.mean_truth;
}

std::optional<double> IccOf(const AgreementSums& sums) {
  if (sums.count < 2) return std::nullopt;
  const double n = sums.count, bias = sums.mean_found - sums.mean_truth;
  // Compute the mean squares of rows (frames), columns (truth, answer) and residuals.
  const double rows = (sums.square_truth + sums.square_found + 2 * sums.product) / 2 / (n - 1);
  const double columns = n * bias * bias / 2;
  const double rest = (sums.square_truth + sums.square_found - 2 * sums.product) / 2 / (n - 1);
  const double all = rows + rest + 2 / n * (columns - rest);
  constexpr double kRounding = 1e-12;  // smaller mean squares are rounding errors, degrees²
  if (!(all > kRounding)) return std::nullopt;
  return (rows - rest) / all;
}

}  // namespace etude
