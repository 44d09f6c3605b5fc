#include "engine/keypoints/recover_person.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/kinematics/capture_body.h"

namespace etude {
namespace {

Result<CapturedMotion> Capture(std::span<const ProjectionMatrix> matrices, const RecoveredPerson& person,
                               const CaptureOptions& options) {
  const std::vector<KnownMeasurement> known = MeasurementsOf(person.landmarks);
  const std::vector<std::vector<Marks>> marks(matrices.size(), std::vector<Marks>(known.size()));
  const CaptureInputs inputs{.pictures = {.cameras = matrices, .marks = marks, .known = known},
                             .body = PaperBody(person.lengths)};
  return CaptureMotion(inputs, options);
}

}  // namespace

SeenPeople UndistortPeople(const Camera& camera, SeenPeople people) {
  for (auto& frame : people) {
    for (SeenPerson& person : frame) {
      for (Keypoint& keypoint : person.keypoints) {
        if (keypoint.confidence <= 0) continue;
        const auto pixel = UndistortPixel(camera, keypoint.pixel);
        keypoint = pixel ? Keypoint{*pixel, keypoint.confidence} : Keypoint{};
      }
    }
  }
  return people;
}

Result<RecoveredPerson> RecoverPerson(std::span<const Camera> cameras, std::span<const SeenPeople> people,
                                      const RecoverPersonOptions& options) {
  assert(cameras.size() >= 2 && cameras.size() == people.size());
  std::vector<ProjectionMatrix> matrices;
  std::vector<SeenPeople> undistorted;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    matrices.push_back(MatrixOf(cameras[i]));
    undistorted.push_back(UndistortPeople(cameras[i], people[i]));
  }
  RecoveredPerson person;
  person.people = MatchPeople(matrices, undistorted, options.match);
  std::vector<std::size_t> in_space;
  for (std::size_t i = 0; i < person.people.size(); ++i) {
    if (person.people[i].cameras >= 2) in_space.push_back(i);
  }
  if (in_space.empty()) {
    return Fail(
        {},
        "no person is seen alike by two cameras; do the films belong to these cameras of the rig, and run together?");
  }
  if (options.person >= in_space.size()) {
    return Fail({}, "person {}: {} seen by two cameras or more", options.person + 1, in_space.size());
  }
  const MatchedPerson& wanted = person.people[in_space[options.person]];
  person.landmarks = TriangulatePerson(matrices, wanted, options.triangulate, &person.report);
  BridgePoints(person.landmarks, static_cast<std::size_t>(std::lround(options.longest_gap_s * options.rate_hz)));
  if (options.cutoff_hz > 0) SmoothPoints(person.landmarks, options.rate_hz, options.cutoff_hz);
  const auto lengths = MedianLengths(person.landmarks);
  if (!lengths) return Fail({}, "a limb is never seen by two cameras: its length is not known");
  person.lengths = *lengths;
  ASSIGN_OR_RETURN(const CapturedMotion captured, Capture(matrices, person, options.capture));
  const auto recovered = std::ranges::count_if(captured.frames, [](const auto& frame) { return frame.has_value(); });
  if (recovered == 0) return Fail({}, "no frame shows enough of the person");
  person.held = captured.frames.size() - static_cast<std::size_t>(recovered);
  const std::vector<RecoveredFrame> frames = HoldFrames(captured.frames);
  person.clip = ToClip(PaperBody(person.lengths), frames, options.rate_hz, "capture");
  person.motion.rate_hz = options.rate_hz;
  for (const RecoveredFrame& frame : frames) person.motion.poses.push_back(frame.pose);
  return person;
}

}  // namespace etude
