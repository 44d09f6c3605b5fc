#include "engine/keypoints/recover_person.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/keypoints/fit_person.h"
#include "engine/kinematics/capture_body.h"

namespace etude {
namespace {

/// Every frame: those without a state show the last one before, leading ones the first. At least one has a state.
std::vector<TreeState> HoldStates(std::span<const std::optional<TreeState>> states) {
  const auto first = std::ranges::find_if(states, [](const auto& state) { return state.has_value(); });
  assert(first != states.end());
  std::vector<TreeState> held;
  for (const auto& state : states) held.push_back(state ? *state : held.empty() ? **first : held.back());
  return held;
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

RecoverPersonOptions UsualRecovery(double rate_hz, double longer_side_px) {
  constexpr double kOutlierShare = 0.03, kLongestAbsence = 0.5;  // seconds
  RecoverPersonOptions options{.rate_hz = rate_hz, .match = {}, .triangulate = {}};
  options.match.follow.longest_absence = std::max(1, static_cast<int>(std::lround(kLongestAbsence * rate_hz)));
  options.triangulate.robust.outlier_px = kOutlierShare * longer_side_px;
  return options;
}

Result<RecoveredPerson> RecoverPerson(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                      const RecoverPersonOptions& options) {
  assert(cameras.size() >= 2 && cameras.size() == people.size());
  RecoveredPerson person;
  person.people = MatchPeople(cameras, people, options.match);
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
  person.landmarks = TriangulatePerson(cameras, wanted, options.triangulate, &person.report);
  BridgePoints(person.landmarks, static_cast<std::size_t>(std::lround(options.longest_gap_s * options.rate_hz)));
  if (options.cutoff_hz > 0) SmoothPoints(person.landmarks, options.rate_hz, options.cutoff_hz);
  ASSIGN_OR_RETURN(const CaptureBody body, MedianBody(person.landmarks));
  person.body = body;
  const auto states = FitPerson(body, person.landmarks);
  for (const auto& state : states) person.is_held.push_back(!state);
  if (std::ranges::count(person.is_held, false) == 0) return Fail({}, "no frame shows enough of the person");
  const std::vector<TreeState> held = HoldStates(states);
  person.clip = ToClip(body, held, options.rate_hz, "capture");
  person.motion.rate_hz = options.rate_hz;
  for (const TreeState& state : held) person.motion.poses.push_back(ToBodyPose(body, state));
  return person;
}

}  // namespace etude
