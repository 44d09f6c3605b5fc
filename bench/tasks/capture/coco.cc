#include "bench/tasks/capture/coco.h"

#include <algorithm>
#include <cassert>
#include <nlohmann/json.hpp>

#include "bench/files/json.h"

namespace etude {
namespace {

constexpr std::array kNames = {"nose",          "left_eye",       "right_eye",  "left_ear",    "right_ear",
                               "left_shoulder", "right_shoulder", "left_elbow", "right_elbow", "left_wrist",
                               "right_wrist",   "left_hip",       "right_hip",  "left_knee",   "right_knee",
                               "left_ankle",    "right_ankle"};
static_assert(kNames.size() == kCocoKeypoints);

/// The joints behind the keypoints from the left shoulder on.
constexpr std::size_t kFirstJoint = 5;
constexpr std::array kJoints = {Role::kLeftShoulder, Role::kRightShoulder, Role::kLeftElbow, Role::kRightElbow,
                                Role::kLeftWrist,    Role::kRightWrist,    Role::kLeftHip,   Role::kRightHip,
                                Role::kLeftKnee,     Role::kRightKnee,     Role::kLeftAnkle, Role::kRightAnkle};
static_assert(kFirstJoint + kJoints.size() == kCocoKeypoints);

/// COCO's own list of limbs, keypoints counted from one.
constexpr int kSkeleton[][2] = {{16, 14}, {14, 12}, {17, 15}, {15, 13}, {12, 13}, {6, 12}, {7, 13},
                                {6, 7},   {6, 8},   {7, 9},   {8, 10},  {9, 11},  {2, 3},  {1, 2},
                                {1, 3},   {2, 4},   {3, 5},   {4, 6},   {5, 7}};

Json Category() {
  Json skeleton = Json::array();
  for (const auto& limb : kSkeleton) skeleton.push_back({limb[0], limb[1]});
  return {{"id", 1}, {"name", "person"}, {"supercategory", "person"}, {"keypoints", kNames}, {"skeleton", skeleton}};
}

/// Nothing when no keypoint is marked.
std::optional<Json> Annotation(std::size_t frame, const Marks& marks) {
  constexpr double kOurPixelCentre = 0.5;
  Json keypoints = Json::array();
  int marked = 0;
  glm::dvec2 low(1e9), high(-1e9);
  for (const auto& point : CocoKeypointsOf(marks)) {
    if (!point) {
      for (int i = 0; i < 3; ++i) keypoints.push_back(0);
      continue;
    }
    const glm::dvec2 pixel = *point - kOurPixelCentre;
    low = glm::min(low, pixel);
    high = glm::max(high, pixel);
    keypoints.push_back(pixel.x);
    keypoints.push_back(pixel.y);
    keypoints.push_back(2);
    ++marked;
  }
  if (marked == 0) return std::nullopt;
  const glm::dvec2 size = high - low;
  return Json{{"id", frame + 1},
              {"image_id", frame + 1},
              {"category_id", 1},
              {"iscrowd", 0},
              {"keypoints", std::move(keypoints)},
              {"num_keypoints", marked},
              {"bbox", {low.x, low.y, size.x, size.y}},
              {"area", size.x * size.y}};
}

}  // namespace

std::array<std::optional<glm::dvec2>, kCocoKeypoints> CocoKeypointsOf(const Marks& marks) {
  std::array<std::optional<glm::dvec2>, kCocoKeypoints> keypoints;
  for (std::size_t i = 0; i < kJoints.size(); ++i) {
    glm::dvec2 sum(0);
    int ends = 0;
    const auto add = [&](Role role, const glm::dvec2& end) {
      if (role != kJoints[i]) return;
      sum += end;
      ++ends;
    };
    for (std::size_t s = 0; s < kStrokeCount; ++s) {
      if (!marks.strokes[s]) continue;
      add(StrokeMarks()[s].from, marks.strokes[s]->a);
      add(StrokeMarks()[s].to, marks.strokes[s]->b);
    }
    if (ends > 0) keypoints[kFirstJoint + i] = sum / static_cast<double>(ends);
  }
  return keypoints;
}

Result<std::string> WriteCocoKeypoints(const Intrinsics& camera, std::span<const std::string> pictures,
                                       std::span<const Marks> marks) {
  assert(pictures.size() == marks.size());
  Json images = Json::array(), annotations = Json::array();
  for (std::size_t frame = 0; frame < pictures.size(); ++frame) {
    images.push_back(
        {{"id", frame + 1}, {"file_name", pictures[frame]}, {"width", camera.width}, {"height", camera.height}});
    if (auto annotation = Annotation(frame, marks[frame])) annotations.push_back(*std::move(annotation));
  }
  const Json file = {
      {"images", std::move(images)}, {"annotations", std::move(annotations)}, {"categories", {Category()}}};
  return WriteJson(file);
}

}  // namespace etude
