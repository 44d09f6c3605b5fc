// Golden values of whole results, of keypoints that err, are mistaken, or are not there: whatever changes a number or a
// word is noticed. What is right is said by the tests beside.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/keypoints/adjust_person.h"
#include "engine/keypoints/agreement.h"
#include "tests/engine/keypoints/crowd.h"

namespace etude {
namespace {

using testing::Fingerprint;

void AddPlaces(Fingerprint& print, const std::vector<LandmarkPlaces>& frames) {
  for (const LandmarkPlaces& places : frames) print.Add(places);
}

void AddMatched(Fingerprint& print, const MatchedPerson& person) {
  for (const auto& camera : person.seen) {
    for (const auto& seen : camera) {
      print.Add(seen.has_value());
      if (seen) AddSeen(print, *seen);
    }
  }
}

TEST(KeypointsGolden, PeopleFollowedMatchedAndMended) {
  testing::Dice dice(1);
  Fingerprint followed, matched, mended, limits;
  for (int k = 0; k < 6; ++k) {
    const Crowd crowd(dice, k == 2 ? 5 : k == 3 ? 8 : 27 + k, 1 + 3 * k);
    MatchOptions options;
    options.may_be_swapped = k % 2 == 1;
    if (k > 3) options = {{0.1, 2, 0.4}, 0.03, true};
    for (const PersonTrack& track : FollowPeople(crowd.people[k % 4], options.follow)) {
      for (const auto& [frame, entry] : track.entries) followed.Add(frame).Add(entry);
    }
    for (MatchedPerson& person : MatchPeople(crowd.matrices, crowd.people, options)) {
      AddMatched(matched, person);
      limits.Add(person.error).Add(person.sightings).Add(person.cameras);
      if (person.cameras < 2) continue;
      for (const double least : {0.1, 0.4}) {
        MatchedPerson now = person;
        for (const Mend& mend : MendPerson(crowd.matrices, crowd.people, least, now))
          mended.Add(mend.kind).Add(mend.camera).Add(mend.frames);
        AddMatched(mended, now);
        for (const double most : {20.0, 200.0}) limits.Add(OutlierLimit(crowd.matrices, now, least, 1, most));
        limits.Add(KeypointErrorPx(crowd.matrices, now, least, 40));
      }
    }
  }
  EXPECT_TRUE(limits.Is(126, 340.808778248));
  EXPECT_TRUE(followed.Is(462, 45.3342010155));
  EXPECT_TRUE(matched.Is(74364, -71748.7881579));
  EXPECT_TRUE(mended.Is(143672, -29612.1632039));
}

/// People whom nobody followed rightly: sides, whole persons and nobody, at random.
TEST(KeypointsGolden, PeopleMistakenAtRandom) {
  testing::Dice dice(2);
  Fingerprint print;
  for (int k = 0; k < 8; ++k) {
    const Crowd crowd(dice, 24, 1 + k % 3, 0.05);
    const std::size_t count = 2 + k % 3;
    MatchedPerson person;
    for (std::size_t c = 0; c < count; ++c) {
      auto& seen = person.seen.emplace_back(24);
      for (std::size_t frame = 0; frame < 24; ++frame) {
        const auto& here = crowd.people[c][frame];
        if (here.empty() || dice.Below(12) == 0) continue;
        seen[frame] = here[dice.Below(4) ? 0 : here.size() - 1];
        if (frame / 5 % 2 == dice.Below(2)) seen[frame] = WithSidesSwapped(*seen[frame]);
      }
    }
    const auto cameras = std::span(crowd.matrices).first(count);
    for (const Mend& mend : MendPerson(cameras, std::span(crowd.people).first(count), 0.1, person))
      print.Add(mend.kind).Add(mend.camera).Add(mend.frames);
    AddMatched(print, person);
    for (const auto& seen : person.seen[0]) {
      if (seen) print.Add(HeightPx(*seen));
    }
  }
  EXPECT_TRUE(print.Is(42203, 31908.4333943));
}

void AddStates(Fingerprint& print, std::span<const TreeState> states) {
  for (const TreeState& state : states) print.Add(state.root_position).Add(state.root_frame[0]).Add(state.angles);
}

void AddRecovered(Fingerprint& print, const Result<RecoveredPerson>& person) {
  print.Add(person.has_value());
  if (!person) {
    print.Add(person.error().message);
    return;
  }
  AddPlaces(print, person->landmarks);
  print.Add(person->people.size()).Add(person->report.rejected).Add(person->report.residual_px);
  print.Add(person->report.found).Add(person->mends.size()).Add(person->outlier_px).Add(person->is_held);
  print.Add(person->body.bones);
  AddStates(print, person->states);
  for (const BodyPose& pose : person->motion.poses) print.Add(pose.joints);
  for (const auto& joint : person->clip.skeleton.joints) print.Add(joint.name);
  print.Add(person->clip.frames.size());
}

TEST(KeypointsGolden, PeopleRecoveredAndAdjusted) {
  testing::Dice dice(3);
  Fingerprint recovered, adjusted;
  for (int k = 0; k < 5; ++k) {
    const double rate_hz = k == 2 ? 50 : 30;
    const Crowd crowd(dice, k == 1 ? 21 : 14 + k, 2 + k, 0.03, rate_hz);
    RecoverPersonOptions options = UsualRecovery(rate_hz, 1280);
    options.mends = k % 2 == 0;
    options.match.may_be_swapped = true;
    options.least_outlier_px = 4;
    options.person = k == 3 ? 1 : k == 4 ? 2 : 0;
    if (k > 0) options.cutoff_hz = 6, options.longest_gap_s = 0.1;
    const std::size_t count = k == 1 ? 2 : 4;
    const auto cameras = std::span(crowd.matrices).first(count);
    auto person = RecoverPerson(cameras, std::span(crowd.people).first(count), options);
    AddRecovered(recovered, person);
    if (!person || k != 1) continue;
    const RecoveredPerson before = *person;
    for (const bool has_outlines : {false, true}) {
      *person = before;
      BodyMotion outlines = before.motion;
      for (BodyPose& pose : outlines.poses) {
        for (glm::dvec3& joint : pose.joints) joint += 0.03 * dice.Vector();
      }
      AdjustPersonOptions adjust{.rate_hz = rate_hz, .least_confidence = has_outlines ? 0.4 : 0.1};
      if (has_outlines) adjust.outlines = &outlines;
      const MatchedPerson& seen = *std::ranges::find_if(before.people, [](const auto& p) { return p.cameras >= 2; });
      adjusted.Add(AdjustPerson(cameras, seen, adjust, *person));
      AddRecovered(adjusted, person);
    }
  }
  EXPECT_TRUE(recovered.Is(14825, 2666.9783874));
  EXPECT_TRUE(adjusted.Is(8712, 2804.08327908));
}

/// A walker of whom landmarks are missing at random, some throughout; hands and ears are seen in some frames.
std::vector<LandmarkPlaces> Gappy(testing::Dice& dice, std::size_t frames, double noise, int kind) {
  using enum Landmark;
  std::vector<LandmarkPlaces> walked;
  for (std::size_t k = 0; k < frames; ++k) {
    LandmarkPlaces& places = walked.emplace_back(Walker(0.1 * k, 0, 0.05 * k));
    if (kind % 2) {
      for (const auto& [own, at] : {std::pair(kLeftHand, kLeftWrist),
                                    {kRightHand, kRightWrist},
                                    {kLeftEar, kNose},
                                    {kRightEar, kHead},
                                    {kLeftHeel, kLeftAnkle},
                                    {kRightHeel, kRightAnkle}})
        places[Index(own)] = *places[Index(at)] + glm::dvec3(0.01, -0.07, -0.04);
    }
    if (kind > 1) places[Index(kHead)].reset();
    if (kind > 3) places[Index(kLeftBigToe)].reset(), places[Index(kNose)].reset();
    for (auto& place : places) {
      if (place) *place += noise * dice.Vector();
      if (dice.Below(8) == 0) place.reset();
    }
  }
  return walked;
}

TEST(KeypointsGolden, PointsBridgedSmoothedAndFitted) {
  testing::Dice dice(4);
  Fingerprint points, fits;
  for (int kind = 0; kind < 6; ++kind) {
    std::vector<LandmarkPlaces> walked = Gappy(dice, 13 + kind, 0.02, kind);
    for (const LandmarkPlaces& places : walked) points.Add(JointsOf(places));
    if (const auto body = MedianBody(walked)) {
      fits.Add(body->bones);
      for (const auto& state : FitPerson(*body, walked)) {
        fits.Add(state.has_value());
        if (state) AddStates(fits, {&*state, 1});
      }
    }
    for (const std::size_t gap : {1, 3}) {
      BridgePoints(walked, gap);
      AddPlaces(points, walked);
    }
    for (const double cutoff : {20.0, 14.9, 8.0, 2.0}) {
      SmoothPoints(walked, 30, cutoff);
      AddPlaces(points, walked);
    }
  }
  const auto none = MedianBody(std::vector<LandmarkPlaces>(3));
  EXPECT_EQ(none.error().message, "no frame shows how far spine is from hip_centre");
  EXPECT_TRUE(points.Is(53226, 106.196492615));
  EXPECT_TRUE(fits.Is(4776, -103.747970113));
}

void AddMarkers(Fingerprint& print, const MarkerMotion& motion) {
  print.Add(motion.rate_hz);
  for (const std::string& name : motion.names) print.Add(name);
  for (const auto& frame : motion.frames) print.Add(frame);
}

TEST(KeypointsGolden, MarkersBesideAReference) {
  testing::Dice dice(5);
  Fingerprint print, clocks;
  for (int k = 0; k < 9; ++k) {
    MarkerMotion motion = ToMarkers(Gappy(dice, 40 + 90 * (k % 3), 0.01, k), 30);
    MarkerMotion reference = ToMarkers(Gappy(dice, 44 + 90 * (k % 3), 0.02, k), 30);
    if (k == 3) reference.names[2] = "else";
    if (k == 4) reference.frames.resize(2);
    if (k == 5) reference = AtClock(reference, {.at = 1.3, .stretch = 0.01}, 130, 30);
    if (k == 6) reference = AtClock(reference, {.at = -2, .stretch = 0.06}, 100, 30);
    if (k == 7) reference.frames.clear();
    if (k == 8) motion.frames.clear();
    AddMarkers(print, motion);
    AddPlaces(print, ToLandmarks(reference));
    for (const double rate_hz : {29.95, 29.9, 47.0, 12.0}) AddMarkers(print, AtRate(motion, rate_hz));
    if (k % 2) AddMarkers(print, JointMarkers(ToLandmarks(motion), 25));
    const auto clock = MeasureClock(motion, reference);
    clocks.Add(clock.has_value());
    if (clock) {
      clocks.Add(clock->at).Add(100 * clock->stretch).Add(clock->before).Add(clock->after).Add(clock->DriftOver(50));
      AddMarkers(print, AtClock(reference, *clock, 30, 25));
    }
    std::vector<MarkerAgreement> agreements = CompareMarkers(motion, reference);
    agreements.push_back(CompareAllMarkers(motion, reference));
    for (const MarkerAgreement& one : agreements) {
      clocks.Add(one.name).Add(1e-3 * one.median_mm).Add(1e-3 * one.p95_mm).Add(one.frames);
    }
  }
  EXPECT_TRUE(clocks.Is(1645, 2797.47670127));
  EXPECT_TRUE(print.Is(422723, -3826.9502061));
}

}  // namespace
}  // namespace etude
