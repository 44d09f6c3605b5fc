#include "io/keypoints/layout_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace etude {
namespace {

using enum Landmark;

/// Counts people, and those of them who have a property.
struct Share {
  int with = 0, people = 0;
  bool Are() const { return IsEnough() && with >= kMostly * people; }
  bool AreNot() const { return IsEnough() && with <= (1 - kMostly) * people; }

 private:
  static constexpr double kMostly = 0.9;
  static constexpr int kMinPeople = 3;
  bool IsEnough() const { return people >= kMinPeople; }
};

bool IsSeen(const SeenPerson& person, Landmark landmark) { return person[landmark].confidence > 0; }

/// Counts the people who show three landmarks, and those of them whose middle landmark lies midway.
Share CountMidway(const SeenPeople& frames, Landmark middle, Landmark a, Landmark b) {
  constexpr double kMaxShare = 0.03;  // tolerance as a share of the person's height
  Share count;
  for (const auto& frame : frames) {
    for (const SeenPerson& person : frame) {
      const double height = HeightPx(person);
      if (!IsSeen(person, middle) || !IsSeen(person, a) || !IsSeen(person, b) || height <= 0) continue;
      ++count.people;
      const glm::dvec2 wanted = 0.5 * (person[a].pixel + person[b].pixel);
      count.with += glm::distance(person[middle].pixel, wanted) <= kMaxShare * height;
    }
  }
  return count;
}

Share MidHips(const SeenPeople& frames) { return CountMidway(frames, kMidHip, kLeftHip, kRightHip); }

/// Returns the largest distance between two points, pixels.
double Extent(std::span<const glm::dvec2> points) {
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) largest = std::max(largest, glm::distance(points[i], points[j]));
  }
  return largest;
}

/// Returns the largest distance between two landmarks that a person shows, pixels.
double ExtentOf(const SeenPerson& person) {
  std::vector<glm::dvec2> seen;
  for (const Keypoint& keypoint : person.keypoints) {
    if (keypoint.confidence > 0) seen.push_back(keypoint.pixel);
  }
  return Extent(seen);
}

/// Counts the people who show the right leg, and those of them whose leg is hardly longer than a face.
Share CountShortLegs(const SeenPeople& frames) {
  constexpr double kMinLeg = 0.2;
  Share count;
  for (const auto& frame : frames) {
    for (const SeenPerson& person : frame) {
      if (!IsSeen(person, kRightHip) || !IsSeen(person, kRightKnee) || !IsSeen(person, kRightAnkle)) continue;
      const glm::dvec2 knee = person[kRightKnee].pixel;
      ++count.people;
      count.with += glm::distance(person[kRightHip].pixel, knee) + glm::distance(knee, person[kRightAnkle].pixel) <
                    kMinLeg * ExtentOf(person);
    }
  }
  return count;
}

/// Counts the people who show face, shoulders and hips, and those of them whose face extends over much of the body.
Share CountSpreadFaces(const SeenPeople& frames) {
  constexpr double kMaxFace = 0.35;
  constexpr std::size_t kMinFacePoints = 3;
  constexpr std::array kFace = {kNose, kLeftEye, kRightEye, kLeftEar, kRightEar};
  constexpr std::array kTrunk = {kLeftShoulder, kRightShoulder, kLeftHip, kRightHip};
  Share count;
  for (const auto& frame : frames) {
    for (const SeenPerson& person : frame) {
      if (!std::ranges::all_of(kTrunk, [&](Landmark landmark) { return IsSeen(person, landmark); })) continue;
      std::vector<glm::dvec2> face;
      for (const Landmark landmark : kFace) {
        if (IsSeen(person, landmark)) face.push_back(person[landmark].pixel);
      }
      const double extent = ExtentOf(person);
      if (face.size() < kMinFacePoints || extent == 0) continue;
      ++count.people;
      count.with += Extent(face) > kMaxFace * extent;
    }
  }
  return count;
}

}  // namespace

bool HasMidHips(const SeenPeople& frames) { return MidHips(frames).Are(); }

bool FitsClearly(const SeenPeople& frames) {
  const bool is_between = HasMidHips(frames) || CountMidway(frames, kNeck, kLeftShoulder, kRightShoulder).Are();
  const Share faces = CountSpreadFaces(frames);
  return is_between && (faces.people == 0 || faces.AreNot());
}

std::string DoubtOf(const std::string& layout, const SeenPeople& frames) {
  if (layout == "body_25" || layout == "h36m") {
    if (const Share hips = MidHips(frames); hips.AreNot()) {
      return fmt::format(
          "in the layout {}, the mid-hip would be between the hips in only {} of {} people; try --layout {}", layout,
          hips.with, hips.people, layout == "h36m" ? "coco" : "body_25b");
    }
  }
  if (layout == "h36m") {
    if (const Share legs = CountShortLegs(frames); legs.Are()) {
      return fmt::format(
          "in the layout h36m, hip, knee and ankle would be as near to each other as eyes and ears in {} of {} people; "
          "try --layout coco",
          legs.with, legs.people);
    }
  }
  if (layout == "body_25b") {
    // The mid-hip and the two hips of body_25 have the numbers 8, 9 and 12. In body_25b, these numbers stand for the
    // right elbow, the left wrist and the right hip.
    if (const Share hips = CountMidway(frames, kRightElbow, kLeftWrist, kRightHip); hips.Are()) {
      return fmt::format(
          "in the layout body_25b, the right elbow would be between the left wrist and the right hip in {} of {} "
          "people; try --layout body_25",
          hips.with, hips.people);
    }
  }
  const Share faces = CountSpreadFaces(frames);
  if (!faces.Are()) return "";
  return fmt::format(
      "nose, eyes and ears would be as far apart as the limbs are long in {} of {} people, so the keypoints probably "
      "have another order",
      faces.with, faces.people);
}

}  // namespace etude
