#include "engine/capture/measure_lengths.h"

#include <algorithm>

#include "engine/base/order_statistics.h"

namespace etude {
namespace {

using enum Role;

/// A length of LimbLengths as the distance of two joints, and of the same two on the other side.
struct LengthBetween {
  double LimbLengths::*length;
  Role a, b;
};
constexpr std::array<LengthBetween, 8> kBetween = {{{&LimbLengths::foot, kLeftAnkle, kLeftFoot},
                                                    {&LimbLengths::shank, kLeftKnee, kLeftAnkle},
                                                    {&LimbLengths::thigh, kLeftHip, kLeftKnee},
                                                    {&LimbLengths::hip_width, kLeftHip, kRightHip},
                                                    {&LimbLengths::shoulder_width, kLeftShoulder, kRightShoulder},
                                                    {&LimbLengths::upper_arm, kLeftShoulder, kLeftElbow},
                                                    {&LimbLengths::forearm, kLeftElbow, kLeftWrist},
                                                    {&LimbLengths::hand, kLeftWrist, kLeftHand}}};

SomeJoints PlacedJoints(const JointMeasurements& frame) {
  SomeJoints joints;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    if (frame.is_triangulated[i]) joints[i] = frame.joints[i].position;
  }
  return joints;
}

std::optional<double> MedianOf(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  return UpperMedian(std::move(values));
}

std::optional<glm::dvec3> MiddleOf(const SomeJoints& joints, Role a, Role b) {
  if (!joints[Index(a)] || !joints[Index(b)]) return std::nullopt;
  return 0.5 * (*joints[Index(a)] + *joints[Index(b)]);
}

// What no frame tells keeps an adult's length.
LimbLengths MedianLengths(std::span<const SomeJoints> frames) {
  LimbLengths lengths;
  const auto set = [&](double LimbLengths::*length, std::vector<double> found) {
    if (const auto median = MedianOf(std::move(found)); median && *median > 0) lengths.*length = *median;
  };
  for (const auto& [length, a, b] : kBetween) {
    std::vector<double> found;
    for (const SomeJoints& joints : frames) {
      for (const auto& [from, to] : {std::pair(a, b), std::pair(Mirrored(a), Mirrored(b))}) {
        if (joints[Index(from)] && joints[Index(to)]) {
          found.push_back(glm::distance(*joints[Index(from)], *joints[Index(to)]));
        }
      }
    }
    set(length, std::move(found));
  }
  std::vector<double> trunks, necks;
  for (const SomeJoints& joints : frames) {
    const auto hips = MiddleOf(joints, kLeftHip, kRightHip),
               shoulders = MiddleOf(joints, kLeftShoulder, kRightShoulder);
    if (hips && shoulders) trunks.push_back(glm::distance(*hips, *shoulders));
    if (shoulders && joints[Index(kHead)]) necks.push_back(glm::distance(*shoulders, *joints[Index(kHead)]));
  }
  set(&LimbLengths::trunk, std::move(trunks));
  set(&LimbLengths::neck, std::move(necks));
  return lengths;
}

// Of the frames that show the most joints (at least, so many as are wanted), some that lie evenly apart.
std::vector<std::size_t> ChooseFrames(std::span<const SomeJoints> joints, std::size_t wanted) {
  std::vector<std::size_t> shown;
  for (const SomeJoints& frame : joints) {
    shown.push_back(
        static_cast<std::size_t>(std::ranges::count_if(frame, [](const auto& j) { return j.has_value(); })));
  }
  std::vector<std::size_t> candidates;
  for (std::size_t least = kRoleCount; least > 0 && candidates.size() < wanted; --least) {
    candidates.clear();
    for (std::size_t k = 0; k < shown.size(); ++k) {
      if (shown[k] >= least) candidates.push_back(k);
    }
  }
  if (candidates.size() <= wanted) return candidates;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < wanted; ++i) {
    chosen.push_back(candidates[wanted == 1 ? 0 : i * (candidates.size() - 1) / (wanted - 1)]);
  }
  return chosen;
}

}  // namespace

std::optional<LimbLengths> MeasureLengths(const MeasureInputs& pictures, std::span<const JointMeasurements> measured,
                                          const MeasureLengthsOptions& options) {
  std::vector<SomeJoints> placed;
  for (const JointMeasurements& frame : measured) placed.push_back(PlacedJoints(frame));
  const auto chosen = ChooseFrames(placed, static_cast<std::size_t>(options.frames));
  std::vector<SomeJoints> start;
  std::vector<std::vector<Marks>> marks(pictures.marks.size());
  for (const std::size_t k : chosen) {
    start.push_back(placed[k]);
    for (std::size_t camera = 0; camera < marks.size(); ++camera) marks[camera].push_back(pictures.marks[camera][k]);
  }
  const LimbLengths first = MedianLengths(start);
  if (!IsValid(first)) return std::nullopt;
  AdjustTakeOptions adjust{.marks = options.marks, .bundle = {}};
  adjust.bundle.adjusts_lengths = true;
  const AdjustedTake take =
      AdjustTake({.pictures = {.cameras = pictures.cameras, .marks = marks}, .lengths = first, .start = start}, adjust);
  if (!take.is_solved || !IsValid(take.body.lengths)) return std::nullopt;
  return take.body.lengths;
}

}  // namespace etude
