#include <etude/capture.h>

#include <algorithm>
#include <cmath>

#include "engine/api/convert.h"
#include "engine/base/names.h"
#include "engine/formats/bvh.h"
#include "engine/keypoints/people.h"
#include "engine/keypoints/recover_person.h"

namespace etude::engine {
namespace {

etude::SeenPerson ToLandmarks(const SeenPerson& person, const KeypointLayout& layout) {
  if (person.size() != layout.landmarks.size()) {
    throw BadInput(fmt::format("{} keypoints; allowed: those of layout {}, {}", person.size(), layout.name,
                               layout.landmarks.size()));
  }
  etude::SeenPerson seen;
  for (std::size_t i = 0; i < person.size(); ++i) {
    const Keypoint& point = person[i];
    if (!std::isfinite(point.pixel.x + point.pixel.y) || !(point.confidence >= 0 && point.confidence <= 1)) {
      throw BadInput(fmt::format("keypoint {} at ({}, {}) with confidence {}; allowed: finite, 0 to 1", i,
                                 point.pixel.x, point.pixel.y, point.confidence));
    }
    seen[layout.landmarks[i]] = {point.pixel, point.confidence};
  }
  return seen;
}

const KeypointLayout& LayoutNamed(const std::string& name) {
  if (const KeypointLayout* layout = FindKeypointLayout(name)) return *layout;
  throw BadInput(fmt::format("layout '{}'; allowed: {}", name, Join(KeypointLayoutNames())));
}

void CheckSizes(std::span<const Camera> cameras, std::span<const SeenPeople> seen, const CaptureOptions& options) {
  if (cameras.size() < 2 || seen.size() != cameras.size()) {
    throw BadInput(fmt::format("{} cameras, but keypoints of {}; allowed: at least two cameras, and keypoints of each",
                               cameras.size(), seen.size()));
  }
  for (const SeenPeople& frames : seen) {
    if (frames.empty() || frames.size() != seen.front().size()) {
      throw BadInput(
          fmt::format("{} frames of one camera, but {} of the first; allowed: the same number for all, at least one",
                      frames.size(), seen.front().size()));
    }
  }
  if (!(options.rate_hz >= 1 && options.rate_hz <= 1000)) {
    throw BadInput(fmt::format("a rate of {} Hz; allowed: 1 to 1000", options.rate_hz));
  }
  if (options.person < 0) throw BadInput(fmt::format("person {}; allowed: 0 or more", options.person));
  if (!(options.smooth_hz >= 0)) throw BadInput(fmt::format("smooth_hz {}; allowed: 0 or more", options.smooth_hz));
}

}  // namespace

CapturedMotion Capture(std::span<const Camera> cameras, std::span<const SeenPeople> seen,
                       const CaptureOptions& options) {
  CheckSizes(cameras, seen, options);
  const KeypointLayout& layout = LayoutNamed(options.layout);
  std::vector<ProjectionMatrix> matrices;
  std::vector<etude::SeenPeople> people;
  int longer_side = 0;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const etude::Camera camera = ToEngineCamera(cameras[i]);
    longer_side = std::max({longer_side, cameras[i].width, cameras[i].height});
    etude::SeenPeople landmarks;
    for (const auto& frame : seen[i]) {
      auto& in_frame = landmarks.emplace_back();
      for (const SeenPerson& person : frame) in_frame.push_back(ToLandmarks(person, layout));
    }
    matrices.push_back(MatrixOf(camera));
    people.push_back(UndistortPeople(camera, std::move(landmarks)));
  }
  RecoverPersonOptions recover = UsualRecovery(options.rate_hz, longer_side);
  recover.person = static_cast<std::size_t>(options.person);
  recover.cutoff_hz = options.smooth_hz;
  RecoveredPerson person = OrThrow(RecoverPerson(matrices, people, recover));
  return {FromBodyMotion(person.motion), WriteBvh(std::move(person.clip)), std::move(person.is_held),
          person.report.residual_px};
}

}  // namespace etude::engine
