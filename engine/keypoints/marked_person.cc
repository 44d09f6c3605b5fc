#include "engine/keypoints/marked_person.h"

#include <array>
#include <optional>
#include <utility>

namespace etude {
namespace {

/// The landmark at a joint that strokes begin or end at, or a disc marks.
std::optional<Landmark> LandmarkAt(Role role) {
  constexpr std::pair<Role, Landmark> kSame[] = {
      {Role::kLeftShoulder, Landmark::kLeftShoulder}, {Role::kRightShoulder, Landmark::kRightShoulder},
      {Role::kLeftElbow, Landmark::kLeftElbow},       {Role::kRightElbow, Landmark::kRightElbow},
      {Role::kLeftWrist, Landmark::kLeftWrist},       {Role::kRightWrist, Landmark::kRightWrist},
      {Role::kLeftHand, Landmark::kLeftHand},         {Role::kRightHand, Landmark::kRightHand},
      {Role::kLeftHip, Landmark::kLeftHip},           {Role::kRightHip, Landmark::kRightHip},
      {Role::kLeftKnee, Landmark::kLeftKnee},         {Role::kRightKnee, Landmark::kRightKnee},
      {Role::kLeftAnkle, Landmark::kLeftAnkle},       {Role::kRightAnkle, Landmark::kRightAnkle},
      {Role::kLeftFoot, Landmark::kLeftBigToe},       {Role::kRightFoot, Landmark::kRightBigToe},
      {Role::kShoulderCentre, Landmark::kNeck},       {Role::kHead, Landmark::kHead}};
  for (const auto& [at, landmark] : kSame) {
    if (at == role) return landmark;
  }
  return std::nullopt;
}

}  // namespace

SeenPerson PersonOf(const Marks& marks) {
  std::array<glm::dvec2, kLandmarkCount> sums{};
  std::array<int, kLandmarkCount> counts{};
  const auto add = [&](Role role, const glm::dvec2& pixel) {
    if (const auto landmark = LandmarkAt(role)) {
      sums[Index(*landmark)] += pixel;
      ++counts[Index(*landmark)];
    }
  };
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (!marks.strokes[i]) continue;
    add(StrokeMarks()[i].from, marks.strokes[i]->a);
    add(StrokeMarks()[i].to, marks.strokes[i]->b);
  }
  SeenPerson person;
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    if (counts[i] > 0) person.keypoints[i] = {sums[i] / static_cast<double>(counts[i]), 1};
  }
  // A disc says where the end is better than its stroke.
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    const auto landmark = LandmarkAt(EffectorMarks()[i].role);
    if (marks.effectors[i] && landmark) person[*landmark] = {*marks.effectors[i], 1};
  }
  return person;
}

}  // namespace etude
