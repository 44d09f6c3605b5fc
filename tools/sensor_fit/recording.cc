#include "tools/sensor_fit/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "engine/base/order_statistics.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/rigid_targets.h"
#include "engine/formats/row_clock.h"

namespace etude {
namespace {

using enum Role;

/// For each role, the rigid target that carries the joint: a target near the joint, on a bone that meets the joint.
using T = BodyTarget;
constexpr std::array<BodyTarget, kRoleCount> kTargetOfRole = {
    T::kHips,       T::kChest,        T::kChest,        T::kHead,        // trunk and head
    T::kLeftArm,    T::kLeftForearm,  T::kLeftForearm,  T::kLeftHand,    // left arm
    T::kRightArm,   T::kRightForearm, T::kRightForearm, T::kRightHand,   // right arm
    T::kLeftThigh,  T::kLeftTibia,    T::kLeftTibia,    T::kLeftFoot,    // left leg
    T::kRightThigh, T::kRightTibia,   T::kRightTibia,   T::kRightFoot};  // right leg

TwinMotion TwinOfTargets(const std::vector<TargetFrame>& targets) {
  TwinMotion twin;
  twin.frames.resize(targets.size());
  for (std::size_t t = 0; t < targets.size(); ++t) {
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const auto& target = targets[t][static_cast<std::size_t>(kTargetOfRole[j])];
      if (target) twin.frames[t][j] = Carrier{target->position, target->rotation};
    }
  }
  return twin;
}

/// Computes orientations for the bones of a body that is given only by joint positions. The trunk's orientation follows
/// from the trunk's joints; a limb has the trunk's orientation, swung into the limb's direction.
class BoneFrames {
 public:
  explicit BoneFrames(const RolePositions& places) : places_(places) {
    if (const auto across = Between(kRightHip, kLeftHip), up = Between(kHipCentre, kShoulderCentre); across && up) {
      const glm::dvec3 y = glm::normalize(*up);
      const glm::dvec3 off = *across - glm::dot(*across, y) * y;
      if (glm::length(off) > 1e-6) {
        const glm::dvec3 x = glm::normalize(off);
        trunk_ = glm::quat_cast(glm::dmat3(x, y, glm::cross(x, y)));
      }
    }
  }

  std::optional<Carrier> Of(Role role) const {
    const auto& place = places_[Index(role)];
    if (!place || !trunk_) return std::nullopt;
    const auto parent = ParentOf(role);
    const Region region = RegionOf(role);
    if (!parent || region == Region::kTrunk) return Carrier{*place, *trunk_};
    const auto bone = Between(*parent, role);
    if (!bone) return std::nullopt;
    // The limb's most frequent direction, relative to the trunk. The swing is undefined only for the opposite
    // direction, which is the rarest.
    const double side = RoleName(role).starts_with("left") ? 1 : -1;
    const glm::dvec3 usual =
        glm::normalize(region == Region::kArm ? glm::dvec3(side, -0.4, 0.5) : glm::dvec3(0, -1, 0.2));
    return Carrier{*place, Swing(*trunk_ * usual, glm::normalize(*bone)) * *trunk_};
  }

 private:
  enum class Region { kTrunk, kArm, kLeg };

  static Region RegionOf(Role role) {
    if (role <= kLeftShoulder || role == kRightShoulder || role == kLeftHip || role == kRightHip) {
      return Region::kTrunk;
    }
    return role < kLeftHip ? Region::kArm : Region::kLeg;
  }

  static glm::dquat Swing(const glm::dvec3& from, const glm::dvec3& to) {
    const double cosine = glm::dot(from, to);
    if (cosine < -0.999999) return {1, 0, 0, 0};
    return glm::normalize(glm::dquat(1 + cosine, glm::cross(from, to)));
  }

  std::optional<glm::dvec3> Between(Role from, Role to) const {
    const auto &a = places_[Index(from)], &b = places_[Index(to)];
    if (!a || !b || *a == *b) return std::nullopt;
    return *b - *a;
  }

  const RolePositions& places_;
  std::optional<glm::dquat> trunk_;
};

/// Fails if the bones of the body are longer or shorter than those of any person.
Result<void> CheckBones(const std::vector<RolePositions>& frames, const std::string& file) {
  constexpr double kMinLongest_m = 0.02, kMaxBone_m = 1.5;
  double longest = 0;
  Role end = Role::kHead;
  for (const Role role : AllRoles()) {
    std::vector<double> lengths;
    for (const RolePositions& places : frames) {
      const auto parent = ParentOf(role);
      if (!parent || !places[Index(role)] || !places[Index(*parent)]) continue;
      lengths.push_back(glm::distance(*places[Index(role)], *places[Index(*parent)]));
    }
    if (lengths.empty()) continue;
    if (const double length = Median(std::move(lengths)); length > longest)
      std::tie(longest, end) = std::pair(length, role);
  }
  if (longest == 0 || (longest >= kMinLongest_m && longest <= kMaxBone_m)) return {};
  return Fail({file},
              "the longest bone, from {} to {}, has {:.3g} m; allowed: {:g} to {:g} m, with positions in metres",
              RoleName(*ParentOf(end)), RoleName(end), longest, kMinLongest_m, kMaxBone_m);
}

/// Gives the rows of a CSV evenly spaced times: each row moves to the nearest frame that follows the row before it.
/// Leaves out rows that would move by more than one and a half frames, and all but the last row of equal times; the
/// remark says how many. Returns by how much each frame's row was later than its new time, seconds. Changes nothing and
/// returns nothing if no frame lies between two rows.
Result<std::vector<double>> SpaceEvenly(JointCsv& csv, const std::string& file) {
  ASSIGN_OR_RETURN(const auto grid, GridOfRows(csv.times_s, csv.lines, std::nullopt, kRoleCount, file));
  const auto is_between = [](const GridFrame& frame) { return !frame.is_hole && frame.part > 0; };
  if (!grid || std::ranges::none_of(grid->frames, is_between)) return std::vector<double>{};
  const double start_s = csv.times_s[grid->frames.front().row];
  std::vector<std::pair<std::size_t, double>> kept;  // rows, and their frames
  for (std::size_t row = 0; row < csv.times_s.size(); ++row) {
    constexpr double kMaxMove = 1.5;  // frames
    const double place = (csv.times_s[row] - start_s) * grid->rate_hz;
    const double frame = std::max(std::round(place), kept.empty() ? 0 : kept.back().second + 1);
    const bool is_repeated = row + 1 < csv.times_s.size() && csv.times_s[row + 1] == csv.times_s[row];
    if (!is_repeated && std::abs(frame - place) <= kMaxMove) kept.emplace_back(row, frame);
  }
  JointCsv even = csv;
  even.times_s.clear();
  even.numbers.clear();
  even.lines.clear();
  even.frames.clear();
  std::vector<double> late_s;
  for (const auto& [row, frame] : kept) {
    even.times_s.push_back(start_s + frame / grid->rate_hz);
    late_s.resize(static_cast<std::size_t>(frame) + 1);
    late_s.back() = csv.times_s[row] - even.times_s.back();
    if (!csv.numbers.empty()) even.numbers.push_back(csv.numbers[row]);
    even.lines.push_back(csv.lines[row]);
    even.frames.push_back(csv.frames[row]);
  }
  if (const std::size_t lost = csv.times_s.size() - kept.size(); lost > 0) {
    even.remark += fmt::format("{}Etude does not use rows that are too near to other rows in time: {}",
                               even.remark.empty() ? "" : "; ", lost);
  }
  csv = std::move(even);
  return late_s;
}

/// The rows of a joint CSV on even frames. `rate_hz` is nullopt if the file has no times.
struct LaidCsv {
  std::optional<double> rate_hz;
  std::vector<RolePositions> frames;
  std::string remark;
  std::vector<double> late_s;  ///< JointRecording::late_s
};

/// Reads a joint CSV. With `rate_hz`, the times only show which rows are missing; if they cannot be used, the frame
/// numbers show this. If `keeps_rows` is true, each frame is one of the file's rows; otherwise rows are interpolated.
Result<LaidCsv> ReadLaidCsv(std::string_view text, const std::string& file, std::optional<double> rate_hz,
                            bool keeps_rows) {
  ASSIGN_OR_RETURN(JointCsv csv, ReadJointCsv(text, file));
  Result<std::vector<double>> late_s;
  if (keeps_rows) late_s = SpaceEvenly(csv, file);
  auto laid = late_s ? LayOnClock(csv, file) : tl::unexpected(late_s.error());
  if (!laid && rate_hz) {
    const std::string why = "Etude does not use the times: " + ToString(laid.error());
    csv.remark += (csv.remark.empty() ? "" : "; ") + why;
    csv.times_s.assign(csv.times_s.size(), std::numeric_limits<double>::quiet_NaN());
    csv.rate_hz.reset();
    late_s = std::vector<double>{};
    laid = LayOnClock(csv, file);
  }
  if (!laid) return tl::unexpected(laid.error());
  LaidCsv made{.rate_hz = rate_hz, .frames = {}, .remark = std::move(laid->remark), .late_s = *std::move(late_s)};
  if (!rate_hz && csv.rate_hz) made.rate_hz = laid->rate_hz;
  for (const auto& places : laid->frames) std::ranges::copy(places, made.frames.emplace_back().begin());
  if (!made.late_s.empty()) made.late_s.resize(made.frames.size());
  for (double& late : made.late_s) late *= laid->rate_hz / made.rate_hz.value_or(laid->rate_hz);
  RETURN_IF_ERROR(CheckBones(made.frames, file));
  return made;
}

TwinMotion TwinOfJoints(const std::vector<RolePositions>& joints) {
  TwinMotion twin;
  for (const RolePositions& places : joints) {
    const BoneFrames bones(places);
    auto& frame = twin.frames.emplace_back();
    for (const Role role : AllRoles()) frame[Index(role)] = bones.Of(role);
  }
  return twin;
}

/// Returns, from the list of usual frame rates, the rate at which the duration of `frames` frames is closest to
/// `seconds`.
double UsualRate(std::size_t frames, double seconds) {
  double best = 60, best_error = 1e300;
  for (const double rate : {30.0, 50.0, 60.0, 100.0, 120.0, 200.0, 240.0}) {
    const double error = std::abs(std::log(static_cast<double>(frames) / rate / seconds));
    if (error < best_error) {
      best = rate;
      best_error = error;
    }
  }
  return best;
}

}  // namespace

Result<JointRecording> ReadJointRecording(std::string_view text, const std::string& file,
                                          std::optional<double> rate_hz) {
  JointRecording recording;
  if (IsJointCsv(text)) {
    ASSIGN_OR_RETURN(auto csv, ReadLaidCsv(text, file, rate_hz, true));
    recording.frames = std::move(csv.frames);
    recording.late_s = std::move(csv.late_s);
    recording.rate_hz = csv.rate_hz.value_or(kJudgedRateHz);
    recording.remark = std::move(csv.remark);
  } else {
    ASSIGN_OR_RETURN(const auto frames, ReadKinectV2Text(text, file));
    for (const KinectV2Frame& frame : frames) recording.frames.push_back(PlacesOf(frame));
    recording.rate_hz = rate_hz.value_or(kJudgedRateHz);
    recording.sensor_at = glm::dvec3(0);
  }
  return recording;
}

Result<TwinMotion> ReadTwinMotion(std::string_view text, const std::string& file, std::optional<double> rate_hz,
                                  double seconds) {
  if (IsJointCsv(text)) {
    ASSIGN_OR_RETURN(auto csv, ReadLaidCsv(text, file, rate_hz, false));
    TwinMotion twin = TwinOfJoints(csv.frames);
    twin.rate_hz = csv.rate_hz ? *csv.rate_hz : UsualRate(twin.frames.size(), seconds);
    twin.remark = std::move(csv.remark);
    return twin;
  }
  ASSIGN_OR_RETURN(const auto targets, ReadRigidTargets(text, file));
  TwinMotion twin = TwinOfTargets(targets);
  twin.rate_hz = rate_hz.value_or(UsualRate(twin.frames.size(), seconds));
  return twin;
}

JointRecording Excerpt(const JointRecording& recording, std::size_t begin, std::size_t end) {
  JointRecording part{.rate_hz = recording.rate_hz, .frames = {}, .sensor_at = recording.sensor_at};
  for (std::size_t t = begin; t < std::min(end, recording.frames.size()); ++t) {
    part.frames.push_back(recording.frames[t]);
    if (!recording.late_s.empty()) part.late_s.push_back(recording.late_s[t]);
  }
  return part;
}

JointRecording RecordingOf(const SkeletonStream& stream, const glm::dvec3& sensor_at) {
  JointRecording recording{.rate_hz = stream.rate_hz, .frames = {}, .sensor_at = sensor_at};
  for (const SensedFrame& frame : stream.frames) {
    RolePositions& places = recording.frames.emplace_back();
    for (const Role role : AllRoles()) {
      if (frame[role].state != TrackingState::kNotTracked) places[Index(role)] = frame[role].position;
    }
  }
  return recording;
}

}  // namespace etude
