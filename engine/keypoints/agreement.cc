#include "engine/keypoints/agreement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/keypoints/plane_search.h"

namespace etude {
namespace {

constexpr double kMmPerMetre = 1000;

MarkerAgreement Summed(std::string name, std::vector<double> distances_mm) {
  if (distances_mm.empty()) return {.name = std::move(name)};
  std::ranges::sort(distances_mm);
  const auto at = [&](double share) {
    return distances_mm[static_cast<std::size_t>(std::lround(share * static_cast<double>(distances_mm.size() - 1)))];
  };
  return {.name = std::move(name), .median_mm = at(0.5), .p95_mm = at(0.95), .frames = distances_mm.size()};
}

/// Returns the distances, in millimetres, between a marker of the reference and the marker of the same name in
/// `motion`, in all frames in which both markers are seen. Returns an empty list if `motion` has no marker of this
/// name.
std::vector<double> Distances(const MarkerMotion& motion, const MarkerMotion& reference, std::size_t marker) {
  std::vector<double> distances;
  const auto found = std::ranges::find(motion.names, reference.names[marker]);
  if (found == motion.names.end()) return distances;
  const auto own = static_cast<std::size_t>(found - motion.names.begin());
  const std::size_t frames = std::min(motion.frames.size(), reference.frames.size());
  for (std::size_t k = 0; k < frames; ++k) {
    const auto &a = motion.frames[k][own], &b = reference.frames[k][marker];
    if (a && b) distances.push_back(kMmPerMetre * glm::distance(*a, *b));
  }
  return distances;
}

/// Interpolates a marker at a fractional frame; nullopt outside the recording, or if a neighbouring frame lacks the
/// marker.
std::optional<glm::dvec3> MarkerAt(const MarkerMotion& markers, double frame, std::size_t marker) {
  constexpr double kSameTime = 1e-9;
  if (frame < -kSameTime || frame > static_cast<double>(markers.frames.size() - 1) + kSameTime) return std::nullopt;
  const auto before = static_cast<std::size_t>(std::max(0.0, frame + kSameTime));
  const double share = std::max(0.0, frame - static_cast<double>(before));
  const auto& here = markers.frames[before][marker];
  if (share < kSameTime || !here) return here;
  const auto& next = markers.frames[before + 1][marker];
  return next ? std::optional(glm::mix(*here, *next, share)) : std::nullopt;
}

/// For each marker that `a` and `b` both contain, returns the marker's index in `a` and its index in `b`.
std::vector<std::pair<std::size_t, std::size_t>> SharedMarkers(const MarkerMotion& a, const MarkerMotion& b) {
  std::vector<std::pair<std::size_t, std::size_t>> shared;
  for (std::size_t i = 0; i < a.names.size(); ++i) {
    const auto found = std::ranges::find(b.names, a.names[i]);
    if (found != b.names.end()) shared.emplace_back(i, found - b.names.begin());
  }
  return shared;
}

MarkerMotion NamedByRole(double rate_hz) {
  MarkerMotion motion{.rate_hz = rate_hz, .names = {}, .frames = {}};
  for (const Role role : AllRoles()) motion.names.emplace_back(RoleName(role));
  return motion;
}

}  // namespace

MarkerMotion ToMarkers(std::span<const LandmarkPositions> frames, double rate_hz) {
  MarkerMotion motion{.rate_hz = rate_hz, .names = {}, .frames = {}};
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    if (std::ranges::none_of(frames, [&](const LandmarkPositions& frame) { return frame[i].has_value(); })) continue;
    seen.push_back(i);
    motion.names.emplace_back(LandmarkName(static_cast<Landmark>(i)));
  }
  for (const LandmarkPositions& frame : frames) {
    auto& places = motion.frames.emplace_back();
    for (const std::size_t i : seen) places.push_back(frame[i]);
  }
  return motion;
}

std::vector<LandmarkPositions> ToLandmarks(const MarkerMotion& markers) {
  std::vector<LandmarkPositions> frames(markers.frames.size());
  for (std::size_t i = 0; i < markers.names.size(); ++i) {
    const auto landmark = FindLandmark(markers.names[i]);
    if (!landmark) continue;
    for (std::size_t k = 0; k < frames.size(); ++k) frames[k][Index(*landmark)] = markers.frames[k][i];
  }
  return frames;
}

MarkerMotion JointMarkers(std::span<const LandmarkPositions> frames, double rate_hz) {
  MarkerMotion motion = NamedByRole(rate_hz);
  for (const LandmarkPositions& frame : frames) {
    const RoleVectors joints = JointsOf(frame);
    motion.frames.emplace_back(joints.begin(), joints.end());
  }
  return motion;
}

MarkerMotion JointMarkers(const BodyMotion& motion) {
  MarkerMotion markers = NamedByRole(motion.rate_hz);
  for (const BodyPose& pose : motion.poses) markers.frames.emplace_back(pose.joints.begin(), pose.joints.end());
  return markers;
}

MarkerMotion AtRate(MarkerMotion markers, double rate_hz) {
  if (std::abs(markers.rate_hz - rate_hz) <= kSameRateTolerance * rate_hz || markers.frames.empty()) return markers;
  const double ratio = markers.rate_hz / rate_hz;
  constexpr double kSameTime = 1e-9;
  const auto frames = static_cast<std::size_t>(static_cast<double>(markers.frames.size() - 1) / ratio + kSameTime) + 1;
  return AtClock(markers, {.stretch = ratio - 1}, frames, rate_hz);
}

MarkerMotion AtClock(const MarkerMotion& reference, const ReferenceClock& clock, std::size_t frames, double rate_hz) {
  MarkerMotion out{rate_hz, reference.names, {}};
  for (std::size_t k = 0; k < frames; ++k) {
    const double at = clock.at + (1 + clock.stretch) * static_cast<double>(k);
    auto& places = out.frames.emplace_back(reference.names.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = MarkerAt(reference, at, i);
  }
  return out;
}

std::optional<ReferenceClock> MeasureClock(const MarkerMotion& motion, const MarkerMotion& reference) {
  const auto shared = SharedMarkers(motion, reference);
  if (shared.empty() || motion.frames.empty() || reference.frames.empty()) return std::nullopt;
  const double middle = 0.5 * static_cast<double>(motion.frames.size());
  const auto clock_of = [&](double shift, double turn) {  // `turn`: drift over half of the motion, frames
    const double stretch = turn / middle;
    return ReferenceClock{.at = shift - turn, .stretch = stretch};
  };
  // Returns the mean loss of a clock over fewer than 400 frames; nullopt if the recordings share too few markers.
  const auto loss_of = [&](const ReferenceClock& clock) -> std::optional<double> {
    constexpr std::size_t kMaxFrames = 200;  // with twice as many frames or more, frames are skipped
    constexpr double kFar = 0.03;
    const std::size_t stride = std::max<std::size_t>(1, motion.frames.size() / kMaxFrames);
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t k = 0; k < motion.frames.size(); k += stride) {
      const double at = clock.at + (1 + clock.stretch) * static_cast<double>(k);
      for (const auto& [own, theirs] : shared) {
        const auto& a = motion.frames[k][own];
        const auto b = a ? MarkerAt(reference, at, theirs) : std::nullopt;
        if (!b) continue;
        const double squared = glm::dot(*a - *b, *a - *b);
        sum += squared / (squared + kFar * kFar);
        ++count;
      }
    }
    constexpr std::size_t kMinCount = 30;
    return count < kMinCount ? std::nullopt : std::optional(sum / static_cast<double>(count));
  };
  const auto before = loss_of({});
  if (!before) return std::nullopt;
  PlaneSearch least([&](double shift, double turn) { return loss_of(clock_of(shift, turn)); }, *before);
  for (double t = -3; t <= 3; t += 1) {
    for (double s = -2; s <= 2; s += 1) least.Try(s, t);
  }
  least.Refine();
  ReferenceClock clock = clock_of(least.x(), least.y());
  clock.before = *before;
  clock.after = least.loss();
  return clock;
}

std::vector<MarkerAgreement> CompareMarkers(const MarkerMotion& motion, const MarkerMotion& reference) {
  std::vector<MarkerAgreement> agreements;
  for (std::size_t marker = 0; marker < reference.names.size(); ++marker) {
    if (std::ranges::find(motion.names, reference.names[marker]) == motion.names.end()) continue;
    agreements.push_back(Summed(reference.names[marker], Distances(motion, reference, marker)));
  }
  return agreements;
}

MarkerAgreement CompareAllMarkers(const MarkerMotion& motion, const MarkerMotion& reference) {
  std::vector<double> all;
  for (std::size_t marker = 0; marker < reference.names.size(); ++marker) {
    const std::vector<double> distances = Distances(motion, reference, marker);
    all.insert(all.end(), distances.begin(), distances.end());
  }
  return Summed("all", std::move(all));
}

}  // namespace etude
