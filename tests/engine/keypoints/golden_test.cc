// The golden value of people from keypoints that are noisy, mistaken or missing: tracked, matched, repaired, recovered
// and adjusted. The other tests of this folder check that results are right.
#include <gtest/gtest.h>

#include <vector>

#include "engine/keypoints/adjust_person.h"
#include "tests/engine/keypoints/crowd.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Fingerprint;

void AddRecovered(Fingerprint& print, const Result<RecoveredPerson>& person) {
  print.Add(person.has_value());
  if (!person) return;
  for (const LandmarkPositions& places : person->landmarks) print.Add(places);
  print.Add(person->people.size()).Add(person->report.rejected).Add(person->report.residual_px);
  print.Add(person->report.found).Add(person->corrections.size()).Add(person->outlier_px).Add(person->is_held);
  print.Add(person->body.bones);
  for (const TreeState& state : person->states)
    print.Add(state.root_position).Add(state.root_frame[0]).Add(state.angles);
  for (const BodyPose& pose : person->motion.poses) print.Add(pose.joints);
  for (const auto& joint : person->clip.skeleton.joints) print.Add(joint.name);
  print.Add(person->clip.frames.size());
}

TEST(KeypointsGolden, PeopleRecoveredAndAdjusted) {
  testing::Dice dice(3);
  Fingerprint print;
  for (int k = 0; k < 5; ++k) {
    const double rate_hz = k == 2 ? 50 : 30;
    const Crowd crowd(dice, k == 1 ? 21 : 14 + k, 2 + k, 0.03, rate_hz);
    RecoverPersonOptions options = DefaultRecovery(rate_hz, 1280);
    options.corrects = k % 2 == 0;
    options.match.may_be_swapped = true;
    options.min_outlier_px = 4;
    options.person = k == 3 ? 1 : k == 4 ? 2 : 0;
    if (k > 0) options.cutoff_hz = 6, options.max_gap_s = 0.1;
    const std::size_t count = k == 1 ? 2 : 4;
    const auto cameras = std::span(crowd.matrices).first(count);
    auto person = RecoverPerson(cameras, std::span(crowd.people).first(count), options);
    AddRecovered(print, person);
    if (!person || k != 1) continue;
    const RecoveredPerson before = *person;
    for (const bool has_outlines : {false, true}) {
      *person = before;
      BodyMotion outlines = before.motion;
      for (BodyPose& pose : outlines.poses) {
        for (glm::dvec3& joint : pose.joints) joint += 0.03 * dice.Vector();
      }
      AdjustPersonOptions adjust{.rate_hz = rate_hz, .min_confidence = has_outlines ? 0.4 : 0.1};
      if (has_outlines) adjust.outlines = &outlines;
      const MatchedPerson& seen = *std::ranges::find_if(before.people, [](const auto& p) { return p.cameras >= 2; });
      print.Add(AdjustPerson(cameras, seen, adjust, *person));
      AddRecovered(print, person);
    }
  }
  EXPECT_TRUE(print.Is(23497, -82.5850581366));
}

TEST(MedianBody, SaysWhatNoFrameShows) {
  const auto none = MedianBody(std::vector<LandmarkPositions>(3));
  EXPECT_EQ(none.error().message, "no frame shows both spine and hip_centre");
}

}  // namespace
}  // namespace etude
