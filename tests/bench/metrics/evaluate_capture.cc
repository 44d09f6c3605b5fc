#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/metrics/annotation.h"
#include "bench/metrics/measurement.h"
#include "bench/metrics/pose_error.h"
#include "bench/metrics/segmentation.h"
#include "bench/statistics/curves/curves.h"
#include "tests/bench/metrics/evaluators.h"
#include "tests/bench/metrics/vector_input.h"

namespace etude {
namespace {

PoseErrors PoseErrorsOf(const Json& in, const char* found) {
  return ComparePoses(ReadMotion(in.at(found)).poses, ReadMotion(in.at("truth")).poses);
}

// Returns true for each number of a list of 0 and 1 that equals `wanted`.
std::vector<bool> FlagsOf(const Json& json, bool wanted) {
  std::vector<bool> flags;
  for (const Json& flag : json) flags.push_back((flag.get<int>() != 0) == wanted);
  return flags;
}

std::optional<double> MpjpeWhereSeen(const Json& in, bool seen) {
  return MeanOfFlagged(PoseErrorsOf(in, "found").frame_mpjpe_mm, FlagsOf(in.at("seen"), seen));
}

std::vector<MeasuredAndTrue> SightedThings(const Json& list) {
  std::vector<MeasuredAndTrue> things;
  for (const Json& thing : list) {
    things.push_back({ReadOptionalPoint(thing.at("found")), ReadOptionalPoint(thing.at("truth"))});
  }
  return things;
}

std::optional<glm::dvec2> ReadOptionalPixel(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return glm::dvec2(json.at(0).get<double>(), json.at(1).get<double>());
}

std::vector<MarkedTwice> MarkedThings(const Json& list) {
  std::vector<MarkedTwice> things;
  for (const Json& thing : list) {
    things.push_back({ReadOptionalPixel(thing.at("first")), ReadOptionalPixel(thing.at("second"))});
  }
  return things;
}

double ReprojectionOf(const Json& in) {
  std::vector<std::vector<PointPair>> pairs;
  std::vector<CameraFit> fits;
  for (const Json& camera : in.at("cameras")) {
    std::vector<PointPair>& list = pairs.emplace_back();
    for (std::size_t i = 0; i < camera.at("points_m").size(); ++i) {
      const Json& pixel = camera.at("pixels").at(i);
      list.push_back({ReadPoint(camera.at("points_m").at(i)), {pixel.at(0).get<double>(), pixel.at(1).get<double>()}});
    }
    fits.push_back({{camera.at("matrix").get<std::array<std::array<double, 4>, 3>>()}, list});
  }
  return MeanReprojectionRmsPx(fits);
}

Value ShareOf(const Json& flags) {
  const auto frames = flags.get<std::vector<int>>();
  return Share(std::count(frames.begin(), frames.end(), 1), static_cast<std::int64_t>(frames.size()));
}

MaskScore MasksOf(const Json& in) {
  std::vector<MaskScore> scores;
  for (const Json& image : in.at("images")) {
    scores.push_back(ScoreMask(ReadMask(image.at("found")), ReadMask(image.at("truth")), ReadMask(image.at("shadow"))));
  }
  return MeanScore(scores);
}

}  // namespace

std::span<const Evaluator> CaptureEvaluators() {
  static constexpr Evaluator kAll[] = {
      {"mpjpe_mm", [](const Json& in) -> Value { return PoseErrorsOf(in, "found").mpjpe_mm; }},
      {"mpjpe_before_ik_mm", [](const Json& in) -> Value { return PoseErrorsOf(in, "before_ik").mpjpe_mm; }},
      {"pa_mpjpe_mm", [](const Json& in) -> Value { return PoseErrorsOf(in, "found").pa_mpjpe_mm; }},
      {"pck_50mm", [](const Json& in) -> Value { return PoseErrorsOf(in, "found").pck_50mm; }},
      {"auc_200mm", [](const Json& in) -> Value { return PoseErrorsOf(in, "found").auc_200mm; }},
      {"bone_length_error_cm", [](const Json& in) -> Value { return PoseErrorsOf(in, "found").bone_length_error_cm; }},
      {"joint_angle_error_deg",
       [](const Json& in) -> Value { return PoseErrorsOf(in, "found").joint_angle_error_deg; }},
      {"mpjpe_seen_mm", [](const Json& in) -> Value { return MpjpeWhereSeen(in, true); }},
      {"mpjpe_held_mm", [](const Json& in) -> Value { return MpjpeWhereSeen(in, false); }},
      {"jerk_error_mps3",
       [](const Json& in) -> Value {
         const BodyMotion found = ReadMotion(in.at("found"));
         return JerkErrorMps3(found.poses, ReadMotion(in.at("truth")).poses, FlagsOf(in.at("in_view"), true),
                              found.rate_hz);
       }},
      {"limb_length_error_mm",
       [](const Json& in) -> Value {
         const Json& lengths = in.at("lengths_m");
         return LimbLengthErrorMm(lengths.at("found").get<std::vector<double>>(),
                                  lengths.at("truth").get<std::vector<double>>());
       }},
      {"limb_direction_error_deg",
       [](const Json& in) -> Value { return LimbDirectionErrorDeg(SightedThings(in.at("limbs"))).mean; }},
      {"limb_direction_coverage",
       [](const Json& in) -> Value { return LimbDirectionErrorDeg(SightedThings(in.at("limbs"))).coverage; }},
      {"triangulation_error_mm",
       [](const Json& in) -> Value { return TriangulationErrorMm(SightedThings(in.at("ends_m"))).mean; }},
      {"triangulation_coverage",
       [](const Json& in) -> Value { return TriangulationErrorMm(SightedThings(in.at("ends_m"))).coverage; }},
      {"annotator_distance_px",
       [](const Json& in) -> Value { return AnnotatorDistancePx(MarkedThings(in.at("joints_px"))); }},
      {"annotator_overlap", [](const Json& in) -> Value { return AnnotatorOverlap(MarkedThings(in.at("limbs_px"))); }},
      {"reprojection_rms_px", [](const Json& in) -> Value { return ReprojectionOf(in); }},
      {"frames_in_view", [](const Json& in) -> Value { return ShareOf(in.at("in_view")); }},
      {"frames_recovered", [](const Json& in) -> Value { return ShareOf(in.at("recovered")); }},
      {"iou", [](const Json& in) -> Value { return MasksOf(in).iou; }},
      {"mask_precision", [](const Json& in) -> Value { return MasksOf(in).precision; }},
      {"mask_recall", [](const Json& in) -> Value { return MasksOf(in).recall; }},
      {"mask_f1", [](const Json& in) -> Value { return MasksOf(in).f1; }},
      {"shadow_error", [](const Json& in) -> Value { return MasksOf(in).shadow_error; }},
      {"pwc", [](const Json& in) -> Value { return MasksOf(in).pwc; }},
  };
  return kAll;
}

}  // namespace etude
