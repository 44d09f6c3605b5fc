#include "bench/tasks/capture/coco.h"

#include <array>
#include <cassert>
#include <nlohmann/json.hpp>

#include "bench/tasks/base/answer_fields.h"
#include "engine/keypoints/people.h"

namespace etude {
namespace {

/// The names that COCO and Halpe give to the keypoints of the layout "halpe_26_hands".
constexpr std::array kNames = {
    "nose",           "left_eye",   "right_eye",    "left_ear",      "right_ear",      "left_shoulder",
    "right_shoulder", "left_elbow", "right_elbow",  "left_wrist",    "right_wrist",    "left_hip",
    "right_hip",      "left_knee",  "right_knee",   "left_ankle",    "right_ankle",    "head",
    "neck",           "hip",        "left_big_toe", "right_big_toe", "left_small_toe", "right_small_toe",
    "left_heel",      "right_heel", "left_hand",    "right_hand"};
static_assert(kNames.size() == kLandmarkCount);

/// The limbs, as pairs of keypoints counted from one: COCO's own list, then the limbs of the head, feet and hands.
constexpr int kSkeleton[][2] = {{16, 14}, {14, 12}, {17, 15}, {15, 13}, {12, 13}, {6, 12},  {7, 13},  {6, 7},
                                {6, 8},   {7, 9},   {8, 10},  {9, 11},  {2, 3},   {1, 2},   {1, 3},   {2, 4},
                                {3, 5},   {4, 6},   {5, 7},   {18, 19}, {16, 21}, {17, 22}, {10, 27}, {11, 28}};

Json Category() {
  Json skeleton = Json::array();
  for (const auto& limb : kSkeleton) skeleton.push_back({limb[0], limb[1]});
  return {{"id", 1}, {"name", "person"}, {"supercategory", "person"}, {"keypoints", kNames}, {"skeleton", skeleton}};
}

/// Returns the COCO annotation of one frame; nothing if no keypoint is marked.
std::optional<Json> Annotation(std::size_t frame, const Marks& marks) {
  constexpr double kOurPixelCentre = 0.5;
  Json keypoints = Json::array();
  int marked = 0;
  glm::dvec2 low(1e9), high(-1e9);
  // Write each keypoint as (u, v, 2), or as three zeros if it is not marked. In COCO, pixel centres are whole numbers.
  const SeenPerson person = PersonOf(marks);
  for (const Landmark landmark : FindKeypointLayout("halpe_26_hands")->landmarks) {
    if (person[landmark].confidence == 0) {
      for (int i = 0; i < 3; ++i) keypoints.push_back(0);
      continue;
    }
    const glm::dvec2 pixel = person[landmark].pixel - kOurPixelCentre;
    low = glm::min(low, pixel);
    high = glm::max(high, pixel);
    keypoints.push_back(pixel.x);
    keypoints.push_back(pixel.y);
    keypoints.push_back(2);
    ++marked;
  }
  if (marked == 0) return std::nullopt;
  // Compute the bounding box of the marked keypoints.
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

Result<Mask> ReadCocoMask(const Json& json, const std::string& path, int width, int height) {
  Mask mask(width, height);
  const int pixels = width * height;
  AnswerFields fields(json, path);
  const Json& size = fields.List("size", 2, 2);
  const Json& counts = fields.List("counts", 1, mask.pixels.size() + 1);
  RETURN_IF_ERROR(fields.Finish());
  if (size != Json{height, width}) {
    return Fail({}, "{}: {}; allowed: [{}, {}], the picture's height and width", fields.PathOf("size"), size.dump(),
                height, width);
  }
  int done = 0;
  bool is_person = false;
  for (std::size_t run = 0; run < counts.size(); ++run, is_person = !is_person) {
    // A run cannot be longer than the rest of the picture.
    ASSIGN_OR_RETURN(const int count, ReadInteger(counts[run], fields.PathOf("counts", run), 0, pixels - done));
    for (const int end = done + count; done < end; ++done) mask.At(done / height, done % height) = is_person;
  }
  if (done == pixels) return mask;
  return Fail({}, "{}: {} pixels in all; the picture has {}", fields.PathOf("counts"), done, pixels);
}

}  // namespace etude
