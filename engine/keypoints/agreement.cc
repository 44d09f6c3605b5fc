#include "engine/keypoints/agreement.h"

#include <algorithm>
#include <cmath>

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

/// Distances of one marker of the reference to its namesake, millimetres; empty without one.
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

MarkerMotion NamedByRole(double rate_hz) {
  MarkerMotion motion{.rate_hz = rate_hz, .names = {}, .frames = {}};
  for (const Role role : AllRoles()) motion.names.emplace_back(RoleName(role));
  return motion;
}

}  // namespace

MarkerMotion ToMarkers(std::span<const LandmarkPlaces> frames, double rate_hz) {
  MarkerMotion motion{.rate_hz = rate_hz, .names = {}, .frames = {}};
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    if (std::ranges::none_of(frames, [&](const LandmarkPlaces& frame) { return frame[i].has_value(); })) continue;
    seen.push_back(i);
    motion.names.emplace_back(LandmarkName(static_cast<Landmark>(i)));
  }
  for (const LandmarkPlaces& frame : frames) {
    auto& places = motion.frames.emplace_back();
    for (const std::size_t i : seen) places.push_back(frame[i]);
  }
  return motion;
}

std::vector<LandmarkPlaces> ToLandmarks(const MarkerMotion& markers) {
  std::vector<LandmarkPlaces> frames(markers.frames.size());
  for (std::size_t i = 0; i < markers.names.size(); ++i) {
    const auto landmark = FindLandmark(markers.names[i]);
    if (!landmark) continue;
    for (std::size_t k = 0; k < frames.size(); ++k) frames[k][Index(*landmark)] = markers.frames[k][i];
  }
  return frames;
}

MarkerMotion JointMarkers(std::span<const LandmarkPlaces> frames, double rate_hz) {
  MarkerMotion motion = NamedByRole(rate_hz);
  for (const LandmarkPlaces& frame : frames) {
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
  if (std::abs(markers.rate_hz - rate_hz) <= kOneRate * rate_hz || markers.frames.empty()) return markers;
  MarkerMotion out{rate_hz, markers.names, {}};
  const double last = static_cast<double>(markers.frames.size() - 1);
  for (std::size_t frame = 0;; ++frame) {
    constexpr double kSameTime = 1e-9;
    const double at = static_cast<double>(frame) * markers.rate_hz / rate_hz;
    if (at > last + kSameTime) return out;
    const auto before = static_cast<std::size_t>(at + kSameTime);
    const double share = std::max(0.0, at - static_cast<double>(before));
    auto& places = out.frames.emplace_back(markers.frames[before]);
    if (share < kSameTime) continue;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto& next = markers.frames[before + 1][i];
      if (places[i]) places[i] = next ? std::optional(glm::mix(*places[i], *next, share)) : std::nullopt;
    }
  }
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
