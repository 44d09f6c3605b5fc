#include "engine/streams/stream_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/order_statistics.h"

namespace etude {
namespace {

using enum Role;

constexpr double kMaxTilt = Radians(30), kMaxDifference = Radians(15);
const glm::dvec3 kFileUp(0, 1, 0);

/// Returns the distance from the head to the midpoint of the ankles; nullopt if a joint is missing.
std::optional<double> HeadToAnkles(const RecordedFrame& frame) {
  const auto &head = frame.places[Index(kHead)], &left = frame.places[Index(kLeftAnkle)],
             &right = frame.places[Index(kRightAnkle)];
  if (!head || !left || !right) return std::nullopt;
  return glm::distance(*head, 0.5 * (*left + *right));
}

/// Returns the trunk's median direction: the median of each coordinate, normalised. Frames in which the distance from
/// head to ankles is below `tall` do not count.
std::optional<glm::dvec3> MedianTrunk(std::span<const RecordedFrame> frames, double tall) {
  std::vector<double> axes[3];
  for (const RecordedFrame& frame : frames) {
    const auto &hips = frame.places[Index(kHipCentre)], &neck = frame.places[Index(kShoulderCentre)];
    if (!hips || !neck || *hips == *neck || HeadToAnkles(frame).value_or(tall) < tall) continue;
    const glm::dvec3 up = glm::normalize(*neck - *hips);
    for (int axis = 0; axis < 3; ++axis) axes[axis].push_back(up[axis]);
  }
  if (axes[0].empty()) return std::nullopt;
  const glm::dvec3 middle(LowerPercentile(axes[0], 0.5), LowerPercentile(axes[1], 0.5), LowerPercentile(axes[2], 0.5));
  if (glm::length(middle) < 0.5) return std::nullopt;
  return glm::normalize(middle);
}

/// Returns MedianTrunk. A person who squats or bows leans forwards, so if the distance from head to ankles falls by
/// more than a seventh, only the frames with a large distance count. But if the trunk is far from the file's up
/// direction in these frames, the body is lying in them, and all frames count.
std::optional<glm::dvec3> UpOfTrunk(std::span<const RecordedFrame> frames) {
  constexpr double kTall = 0.95, kDown = 6.0 / 7;
  std::vector<double> heights;
  for (const RecordedFrame& frame : frames) {
    if (const auto height = HeadToAnkles(frame)) heights.push_back(*height);
  }
  if (!heights.empty()) {
    const double usual = LowerPercentile(heights, 0.9);
    const bool comes_down = LowerPercentile(std::move(heights), 0.1) < kDown * usual;
    const auto up = comes_down ? MedianTrunk(frames, kTall * usual) : std::nullopt;
    if (up && AngleBetween(*up, kFileUp) <= kMaxTilt) return up;
  }
  return MedianTrunk(frames, 0);
}

/// Lists the positions of standing feet, which are the feet slower than 0.1 m/s.
std::vector<glm::dvec3> PlantedFeet(std::span<const RecordedFrame> frames, double rate_hz) {
  constexpr double kStill = 0.1;
  std::vector<glm::dvec3> points;
  for (std::size_t t = 1; t < frames.size(); ++t) {
    for (const Role foot : {kLeftFoot, kRightFoot}) {
      const auto &before = frames[t - 1].places[Index(foot)], &now = frames[t].places[Index(foot)];
      const bool is_tracked = frames[t].states[Index(foot)] == TrackingState::kTracked;
      if (before && now && is_tracked && glm::distance(*before, *now) * rate_hz < kStill) points.push_back(*now);
    }
  }
  return points;
}

/// Returns the normal of the least-squares plane y = a x + b z + c; nullopt if the points do not determine it.
std::optional<glm::dvec3> UpOfFeet(const std::vector<glm::dvec3>& points) {
  constexpr std::size_t kMinPoints = 30;
  constexpr double kSpread = 0.10, kFlat = 0.03;
  if (points.size() < kMinPoints) return std::nullopt;
  const auto n = static_cast<double>(points.size());
  // Compute mean and covariance.
  glm::dvec3 mean(0);
  for (const glm::dvec3& p : points) mean += p / n;
  double xx = 0, xz = 0, zz = 0, xy = 0, zy = 0;
  for (const glm::dvec3& p : points) {
    const glm::dvec3 d = p - mean;
    xx += d.x * d.x / n;
    xz += d.x * d.z / n;
    zz += d.z * d.z / n;
    xy += d.x * d.y / n;
    zy += d.z * d.y / n;
  }
  // Give up if the points extend in one horizontal direction only.
  const double smaller = 0.5 * (xx + zz) - std::sqrt(0.25 * (xx - zz) * (xx - zz) + xz * xz);
  if (smaller < kSpread * kSpread) return std::nullopt;
  // Solve for the plane by least squares, and test the distance of the points from it.
  const double determinant = xx * zz - xz * xz;
  const double a = (xy * zz - zy * xz) / determinant, b = (zy * xx - xy * xz) / determinant;
  double off = 0;
  for (const glm::dvec3& p : points) {
    const glm::dvec3 d = p - mean;
    off += (d.y - a * d.x - b * d.z) * (d.y - a * d.x - b * d.z) / n;
  }
  if (off > kFlat * kFlat) return std::nullopt;
  return glm::normalize(glm::dvec3(-a, 1, -b));
}

/// Returns the smallest rotation from one unit vector to another; the angle between them must be below 180°.
glm::dmat3 Swing(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 v = glm::cross(from, to);
  const glm::dmat3 cross(0, v.z, -v.y, -v.z, 0, v.x, v.y, -v.x, 0);
  return glm::dmat3(1) + cross + cross * cross / (1 + glm::dot(from, to));
}

/// Returns the rotation by `quarters` quarter turns about the line of sight, Z. A quarter turn takes X to Y.
glm::dmat3 QuarterTurns(int quarters) {
  constexpr int kCosines[] = {1, 0, -1, 0}, kSines[] = {0, 1, 0, -1};
  const double c = kCosines[quarters], s = kSines[quarters];
  return {c, s, 0, -s, c, 0, 0, 0, 1};
}

/// If the sensor was in portrait or upside down, returns the number of quarter turns that set bodies upright; otherwise
/// 0.
int QuartersOfSensor(std::span<const RecordedFrame> frames) {
  constexpr double kMinShare = 0.7, kHardlyAny = 0.05, kFaces = 0.7;
  std::array<double, 4> upright{};
  std::vector<double> fronts;  // by frame: sine of the angle by which the body faces up or down in the file's axes
  double all = 0;
  for (const RecordedFrame& frame : frames) {
    const auto &hips = frame.places[Index(kHipCentre)], &neck = frame.places[Index(kShoulderCentre)],
               &left = frame.places[Index(kLeftShoulder)], &right = frame.places[Index(kRightShoulder)];
    if (!hips || !neck || *hips == *neck) continue;
    ++all;
    for (int quarters = 0; quarters < 4; ++quarters) {
      if (AngleBetween(QuarterTurns(quarters) * (*neck - *hips), kFileUp) <= kMaxTilt) ++upright[quarters];
    }
    if (!left || !right) continue;
    const glm::dvec3 front = glm::cross(*left - *right, *neck - *hips);
    if (glm::length(front) > 0) fronts.push_back(std::abs(front.y) / glm::length(front));
  }
  if (all == 0 || upright[0] > kHardlyAny * all) return 0;
  const int most = static_cast<int>(std::ranges::max_element(upright) - upright.begin());
  if (upright[most] < kMinShare * all) return 0;
  const bool is_portrait = most % 2 != 0;
  return is_portrait && (fronts.empty() || UpperMedian(std::move(fronts)) > kFaces) ? 0 : most;
}

/// Estimates the level of a sensor that is neither in portrait nor upside down.
StreamLevel LevelOfSensor(std::span<const RecordedFrame> frames, double rate_hz) {
  // Choose the evidence for the up direction: feet if they agree with the trunk, otherwise the trunk.
  StreamLevel level;
  const auto trunk = UpOfTrunk(frames), feet = UpOfFeet(PlantedFeet(frames, rate_hz));
  std::optional<glm::dvec3> up;
  if (feet && trunk && AngleBetween(*feet, *trunk) <= kMaxDifference) {
    up = feet;
    level.up_by = StreamLevel::By::kFeet;
  } else if (trunk) {
    up = trunk;
    level.up_by = StreamLevel::By::kTrunk;
  }
  // Rotate the up direction to Y, unless the tilt is implausible.
  if (up && AngleBetween(*up, kFileUp) <= kMaxTilt) {
    level.R_WF = Swing(*up, kFileUp);
    level.tilt_deg = Degrees(AngleBetween(*up, kFileUp));
  } else {
    level.up_by = StreamLevel::By::kNothing;
    if (up) level.trunk_deg = Degrees(AngleBetween(*up, kFileUp));
  }
  // Estimate the floor from the lower foot.
  std::vector<double> heights;
  for (const RecordedFrame& frame : frames) {
    const auto &left = frame.places[Index(kLeftFoot)], &right = frame.places[Index(kRightFoot)];
    if (left && right) heights.push_back(std::min((level.R_WF * *left).y, (level.R_WF * *right).y));
  }
  if (!heights.empty()) level.floor_m = LowerPercentile(heights, 0.1);
  return level;
}

using enum Role;

constexpr double kMaxGap_s = 0.2, kMaxLoss_s = 600, kSameTime = 5e-4;

bool ShowsBody(const RecordedFrame& frame) {
  return std::ranges::any_of(frame.places, [](const auto& place) { return place.has_value(); });
}

/// Interpolates between two frames. The result lacks a joint if one of the two frames lacks it.
RecordedFrame Between(const RecordedFrame& a, const RecordedFrame& b, double part) {
  RecordedFrame frame;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    if (!a.places[i] || !b.places[i]) continue;
    frame.places[i] = glm::mix(*a.places[i], *b.places[i], part);
    frame.states[i] = std::max(a.states[i], b.states[i]);
  }
  return frame;
}

}  // namespace

StreamLevel EstimateLevel(std::span<const RecordedFrame> frames, double rate_hz) {
  // If the sensor was mounted in portrait or upside down, rotate the frames upright first.
  if (const int quarters = QuartersOfSensor(frames); quarters != 0) {
    const glm::dmat3 R_TF = QuarterTurns(quarters);
    std::vector<RecordedFrame> turned(frames.begin(), frames.end());
    for (RecordedFrame& frame : turned) {
      for (auto& place : frame.places) {
        if (place) *place = R_TF * *place;
      }
    }
    StreamLevel level = LevelOfSensor(turned, rate_hz);
    level.R_WF = level.R_WF * R_TF;
    level.turn_deg = 90 * quarters;
    return level;
  }
  return LevelOfSensor(frames, rate_hz);
}

StreamLevel LevelOf(const StreamRecording& recording, const StreamOptions& options) {
  if (!recording.is_level) return options.levels ? EstimateLevel(recording.frames, recording.rate_hz) : StreamLevel{};
  StreamLevel level;
  const UpAxis up = options.up.value_or(UpAxis::kY);
  for (int axis = 0; axis < 3; ++axis) level.R_WF[axis] = Upright(level.R_WF[axis], up);
  return level;
}

std::string DescribeAssumedRate(const StreamRecording& recording) {
  return recording.records_times ? "" : fmt::format("without a clock (Etude assumes {:g} Hz)", recording.rate_hz);
}

std::string Describe(const StreamLevel& level) {
  const char* by = level.up_by == StreamLevel::By::kFeet    ? "found by the feet"
                   : level.up_by == StreamLevel::By::kTrunk ? "found by the trunk"
                                                            : "as in the file";
  const std::string turn = level.turn_deg == 0 ? ""
                                               : fmt::format(
                                                     "the sensor was rotated by {} degrees, and Etude rotated the "
                                                     "positions back (--level none keeps the rotation); ",
                                                     level.turn_deg);
  const std::string how =
      level.trunk_deg == 0
          ? fmt::format("{:.1f} degrees", level.tilt_deg)
          : fmt::format("although trunks are {:.0f} degrees from this direction: a lying person, or a tilted sensor",
                        level.trunk_deg);
  return fmt::format("{}the up direction is {} ({}); the floor is {:.2f} m below the sensor", turn, by, how,
                     -level.floor_m);
}

StreamMaker::StreamMaker(const StreamLevel& level, const StreamOptions& options, std::string file)
    : level_(level), options_(options), file_(std::move(file)) {}

SensedFrame StreamMaker::Sensed(const RecordedFrame& frame) {
  SensedFrame sensed;
  sensed.body_seen = ShowsBody(frame);
  for (const Role role : AllRoles()) {  // parents before their children
    SensedJoint& joint = sensed[role];
    auto& last = last_[Index(role)];
    if (const auto& place = frame.places[Index(role)]) {
      last = level_.Apply(*place);
      if (options_.reflects) last->x = -last->x;
      joint = {*last, frame.states[Index(role)]};
    } else if (last) {
      joint.position = *last;
    } else if (const auto parent = ParentOf(role)) {
      joint.position = sensed[*parent].position;
    }
  }
  return sensed;
}

Result<void> StreamMaker::Add(const RecordedFrame& frame, std::vector<SensedFrame>& stream) {
  if (!before_) {
    start_s_ = frame.time_s;
  } else if (frame.time_s <= before_->time_s || frame.time_s - before_->time_s > kMaxLoss_s) {
    return Fail({file_, frame.line}, "the time {:.6g} s follows {:.6g} s; allowed: at most {} s between rows",
                frame.time_s, before_->time_s, kMaxLoss_s);
  }
  // Make the stream's frames up to the time of `frame`. Each is a recorded frame, an interpolation between two
  // recorded frames, or a frame without a body.
  for (;; ++next_) {
    const double time = start_s_ + static_cast<double>(next_) / options_.rate_hz;
    if (time > frame.time_s + kSameTime) break;
    if (time >= frame.time_s - kSameTime) {
      stream.push_back(Sensed(frame));
    } else if (before_ && time <= before_->time_s + kSameTime) {
      stream.push_back(Sensed(*before_));
    } else if (before_ && frame.time_s - before_->time_s <= kMaxGap_s + kSameTime) {
      const double part = (time - before_->time_s) / (frame.time_s - before_->time_s);
      stream.push_back(Sensed(Between(*before_, frame, part)));
    } else {
      stream.push_back(Sensed({}));
    }
  }
  before_ = frame;
  return {};
}

Result<MadeStream> MakeStream(const StreamRecording& recording, const std::string& file, const StreamOptions& options) {
  MadeStream made;
  made.stream.rate_hz = options.rate_hz;
  made.start_s = recording.frames.front().time_s;
  made.level = LevelOf(recording, options);
  StreamMaker maker(made.level, options, file);
  for (const RecordedFrame& frame : recording.frames) RETURN_IF_ERROR(maker.Add(frame, made.stream.frames));
  made.lost_frames = static_cast<std::size_t>(
      std::ranges::count_if(made.stream.frames, [](const SensedFrame& frame) { return !frame.body_seen; }));
  return made;
}

LegSides LegsOf(const SkeletonStream& stream) {
  LegSides legs;
  for (const SensedFrame& frame : stream.frames) {
    if (!frame.body_seen) continue;
    const glm::dvec3 left = frame[kLeftHip].position - frame[kRightHip].position;
    for (const auto& [hip, knee, ankle, toe] : {std::array{kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot},
                                                std::array{kRightHip, kRightKnee, kRightAnkle, kRightFoot}}) {
      const bool is_seen = std::ranges::all_of(std::array{knee, ankle, toe},
                                               [&](Role role) { return frame[role].state == TrackingState::kTracked; });
      if (is_seen) {
        legs.Add(left, frame[hip].position, frame[knee].position, frame[ankle].position, frame[toe].position);
      }
    }
  }
  return legs;
}

}  // namespace etude
