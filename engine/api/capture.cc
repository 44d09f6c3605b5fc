#include <etude/capture.h>

#include <algorithm>
#include <cmath>

#include "engine/api/checks.h"
#include "engine/formats/bvh.h"
#include "engine/keypoints/recover_person.h"

namespace etude::engine {
namespace {

void CheckPerson(const SeenPerson& person) {
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    const auto& [pixel, confidence] = person.keypoints[i];
    if (std::isfinite(pixel.x + pixel.y) && confidence >= 0 && confidence <= 1) continue;
    throw BadInput(fmt::format(
        "keypoint {} is at ({}, {}) with confidence {}; allowed: finite coordinates and a confidence from 0 to 1",
        LandmarkName(Landmark(i)), pixel.x, pixel.y, confidence));
  }
}

void CheckSizes(std::span<const NamedCamera> cameras, std::span<const SeenPeople> seen, const CaptureOptions& options) {
  if (cameras.size() < 2 || seen.size() != cameras.size()) {
    throw BadInput(
        fmt::format("found {} cameras, but keypoints for {} cameras; allowed: two or more cameras, each with keypoints",
                    cameras.size(), seen.size()));
  }
  for (const SeenPeople& frames : seen) {
    if (frames.empty() || frames.size() != seen.front().size()) {
      throw BadInput(fmt::format(
          "one camera has {} frames, but the first camera has {}; allowed: the same number for all cameras, at least 1",
          frames.size(), seen.front().size()));
    }
    for (const auto& frame : frames) std::ranges::for_each(frame, CheckPerson);
  }
  if (!(options.rate_hz >= 1 && options.rate_hz <= 1000)) {
    throw BadInput(fmt::format("the rate is {} Hz; allowed: 1 to 1000 Hz", options.rate_hz));
  }
  if (options.person < 0) throw BadInput(fmt::format("person is {}; allowed: 0 or more", options.person));
  if (!(options.smooth_hz >= 0)) throw BadInput(fmt::format("smooth_hz is {}; allowed: 0 or more", options.smooth_hz));
}

}  // namespace

CapturedMotion Capture(std::span<const NamedCamera> cameras, std::span<const SeenPeople> seen,
                       const CaptureOptions& options) {
  CheckSizes(cameras, seen, options);
  std::vector<ProjectionMatrix> matrices;
  std::vector<SeenPeople> people;
  int longer_side = 0;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Camera& camera = cameras[i].camera;
    longer_side = std::max({longer_side, camera.intrinsics.width, camera.intrinsics.height});
    matrices.push_back(MatrixOf(camera));
    people.push_back(UndistortPeople(camera, seen[i]));
  }
  RecoverPersonOptions recover = DefaultRecovery(options.rate_hz, longer_side);
  recover.person = static_cast<std::size_t>(options.person);
  recover.cutoff_hz = options.smooth_hz;
  RecoveredPerson person = OrThrow(RecoverPerson(matrices, people, recover));
  return {std::move(person.motion), WriteBvh(std::move(person.clip)), std::move(person.is_held),
          person.report.residual_px};
}

}  // namespace etude::engine
