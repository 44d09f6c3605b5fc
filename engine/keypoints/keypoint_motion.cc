#include "engine/keypoints/keypoint_motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/gaps.h"
#include "engine/base/order_statistics.h"

namespace etude {
namespace {

using enum Landmark;

/// The joints of one side whose positions may have to be guessed, and the joints from which they are guessed.
struct SideRoles {
  Role elbow, wrist, hand, ankle, foot;
};
constexpr SideRoles kSides[] = {
    {Role::kLeftElbow, Role::kLeftWrist, Role::kLeftHand, Role::kLeftAnkle, Role::kLeftFoot},
    {Role::kRightElbow, Role::kRightWrist, Role::kRightHand, Role::kRightAnkle, Role::kRightFoot}};

constexpr double kHandOfForearm = 0.72;
constexpr double kFootLength = 0.18;

/// Returns the direction that the body faces: horizontal and perpendicular to the line between the hips.
std::optional<glm::dvec3> FacingOf(const RoleVectors& joints) {
  const auto &left = joints[Index(Role::kLeftHip)], &right = joints[Index(Role::kRightHip)];
  if (!left || !right) return std::nullopt;
  const glm::dvec3 facing = glm::cross(*left - *right, glm::dvec3(0, 1, 0));
  const double length = glm::length(facing);
  if (!(length > 1e-6)) return std::nullopt;
  return facing / length;
}

}  // namespace

std::optional<glm::dvec3> MiddleOf(const LandmarkPositions& places, Landmark a, Landmark b) {
  const auto &p = places[Index(a)], &q = places[Index(b)];
  return p && q ? std::optional(0.5 * (*p + *q)) : std::nullopt;
}

std::vector<TriangulatedLandmark> TriangulateLandmarks(std::span<const ProjectionMatrix> cameras,
                                                       const MatchedPerson& person, const TriangulateOptions& options) {
  assert(person.seen.size() == cameras.size());
  std::vector<TriangulatedLandmark> all;
  const std::size_t frames = person.seen.empty() ? 0 : person.seen.front().size();
  for (std::size_t frame = 0; frame < frames; ++frame) {
    for (std::size_t i = 0; i < kLandmarkCount; ++i) {
      std::vector<WeightedSighting> sightings;
      std::vector<std::size_t> by;
      for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
        const auto& seen = person.seen[camera][frame];
        if (!seen || seen->keypoints[i].confidence < options.min_confidence) continue;
        sightings.push_back({{cameras[camera], seen->keypoints[i].pixel}, seen->keypoints[i].confidence});
        by.push_back(camera);
      }
      if (auto point = TriangulateRobustly(sightings, options.robust)) {
        all.push_back({frame, i, std::move(by), std::move(*point)});
      }
    }
  }
  return all;
}

std::vector<LandmarkPositions> TriangulatePerson(std::span<const ProjectionMatrix> cameras, const MatchedPerson& person,
                                                 const TriangulateOptions& options, TriangulationReport* report) {
  const std::size_t frames = person.seen.empty() ? 0 : person.seen.front().size();
  std::vector<LandmarkPositions> places(frames);
  std::vector<double> residuals, used(cameras.size()), rejected(cameras.size());
  std::array<std::size_t, kLandmarkCount> found{};
  // Store the triangulated positions, and count the outliers of each camera.
  for (const auto& [frame, landmark, by, point] : TriangulateLandmarks(cameras, person, options)) {
    places[frame][landmark] = point.position;
    residuals.push_back(point.residual_px);
    ++found[landmark];
    for (std::size_t k = 0; k < by.size(); ++k) {
      used[by[k]] += 1;
      if (!point.agrees[k]) rejected[by[k]] += 1;
    }
  }
  // Report the share of outliers of each camera, the median residual, and the share of points found.
  if (report != nullptr) {
    report->rejected.clear();
    for (std::size_t c = 0; c < cameras.size(); ++c)
      report->rejected.push_back(used[c] > 0 ? rejected[c] / used[c] : 0);
    report->residual_px = residuals.empty() ? 0 : UpperMedian(residuals);
    const auto ever = static_cast<double>(std::ranges::count_if(found, [](std::size_t n) { return n > 0; }));
    report->found = ever > 0 ? static_cast<double>(residuals.size()) / (ever * static_cast<double>(frames)) : 0;
  }
  return places;
}

void InterpolatePoints(std::span<LandmarkPositions> frames, std::size_t max_gap) {
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    FillGaps(
        frames.size(), max_gap, [&](std::size_t frame) { return frames[frame][i].has_value(); },
        [&](std::size_t from, std::size_t frame, std::size_t to, double share) {
          frames[frame][i] = glm::mix(*frames[from][i], *frames[to][i], share);
        });
  }
}

void SmoothPoints(std::span<LandmarkPositions> frames, double rate_hz, double cutoff_hz) {
  if (!(cutoff_hz < rate_hz / 2)) return;
  // Choose the standard deviation so that exp(−2π²σ²f²) = 1/√2 at the cutoff.
  const double sigma = std::sqrt(std::log(2.0)) / (2 * kPi * cutoff_hz) * rate_hz;  // frames
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(3 * sigma));
  const std::vector<LandmarkPositions> before(frames.begin(), frames.end());
  const auto count = static_cast<std::ptrdiff_t>(frames.size());
  for (std::ptrdiff_t frame = 0; frame < count; ++frame) {
    for (std::size_t i = 0; i < kLandmarkCount; ++i) {
      if (!before[static_cast<std::size_t>(frame)][i]) continue;
      glm::dvec3 sum(0);
      double weights = 0;
      // The window is symmetric so that the ends of a film are not shifted in time.
      const std::ptrdiff_t far = std::min({reach, frame, count - 1 - frame});
      for (std::ptrdiff_t k = -far; k <= far; ++k) {
        const auto& place = before[static_cast<std::size_t>(frame + k)][i];
        const double x = static_cast<double>(k) / sigma;
        if (!place) continue;
        sum += std::exp(-0.5 * x * x) * *place;
        weights += std::exp(-0.5 * x * x);
      }
      frames[static_cast<std::size_t>(frame)][i] = sum / weights;
    }
  }
}

RoleVectors JointsOf(const LandmarkPositions& marks) {
  const auto at = [&](Landmark landmark) { return marks[Index(landmark)]; };
  // Take the joints that are landmarks; extend the forearm if a hand is missing.
  RoleVectors joints;
  for (const auto& [landmark, role] : kJointLandmarks) joints[Index(role)] = at(landmark);
  for (const SideRoles& side : kSides) {
    const auto &elbow = joints[Index(side.elbow)], &wrist = joints[Index(side.wrist)];
    auto& hand = joints[Index(side.hand)];
    if (!hand && elbow && wrist) hand = *wrist + kHandOfForearm * (*wrist - *elbow);
  }
  // Compute the joints between landmarks.
  joints[Index(Role::kHipCentre)] = MiddleOf(marks, kLeftHip, kRightHip);
  joints[Index(Role::kShoulderCentre)] = MiddleOf(marks, kLeftShoulder, kRightShoulder);
  auto& head = joints[Index(Role::kHead)];
  head = at(kHead);
  if (!head) head = MiddleOf(marks, kLeftEar, kRightEar);
  if (!head) head = at(kNose);
  // If the head or a foot is missing, guess it.
  const auto &hips = joints[Index(Role::kHipCentre)], &shoulders = joints[Index(Role::kShoulderCentre)];
  constexpr double kNeckOfTrunk = 0.5;
  if (!head && hips && shoulders) head = *shoulders + kNeckOfTrunk * (*shoulders - *hips);
  if (const auto facing = FacingOf(joints)) {
    for (const SideRoles& side : kSides) {
      auto& foot = joints[Index(side.foot)];
      const auto& ankle = joints[Index(side.ankle)];
      constexpr double kAhead = 0.95, kDown = 0.31;
      if (!foot && ankle) foot = *ankle + kFootLength * (kAhead * *facing - glm::dvec3(0, kDown, 0));
    }
  }
  return joints;
}

}  // namespace etude
