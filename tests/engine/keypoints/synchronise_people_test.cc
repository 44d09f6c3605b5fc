#include "engine/keypoints/synchronise_people.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/engine/keypoints/walkers.h"

namespace etude {
namespace {

constexpr double kFilmRate = 30;
const std::vector<double> kOffsets = {0, 3.4, -7.25, 11};  // offsets, frames

struct Session {
  std::vector<ProjectionMatrix> cameras;
  std::vector<SeenPeople> people;
};

/// Returns one or two people in front of four cameras with clock offsets, in changing order; the last camera does not
/// see the second one. Films differ in length, and possibly slightly in rate.
Session Filmed(int persons, double sigma_px, const std::vector<double>& offsets = kOffsets, int luck = 0,
               const std::vector<double>& drifts = {0, 0, 0, 0}) {
  RandomStream dice = WalkersDice(fmt::format("clocks {}", luck).c_str());
  Session session;
  std::vector<Camera> cameras = FourCameras();
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    cameras[c].distortion = {};
    session.cameras.push_back(MatrixOf(cameras[c]));
    SeenPeople& people = session.people.emplace_back(60 + 3 * c);
    for (std::size_t k = 0; k < people.size(); ++k) {
      const double t = (static_cast<double>(k) * (1 + drifts[c]) + offsets[c]) / kFilmRate;
      people[k].push_back(Seen(cameras[c], Walker(-0.5, 0, t), sigma_px, dice));
      if (persons > 1 && c < 3) people[k].push_back(Seen(cameras[c], Walker(0.7, 0.2, t + 0.4), sigma_px, dice));
      if (people[k].size() > 1 && (k * 7 + c) % 3 == 0) std::swap(people[k][0], people[k][1]);
    }
  }
  return session;
}

TEST(SynchronisePeople, FindsHowLateEveryCameraIs) {
  for (const int persons : {1, 2}) {
    const Session exact = Filmed(persons, 0);
    const auto found = EstimateOffsets(exact.cameras, exact.people);
    for (std::size_t c = 0; c < kOffsets.size(); ++c) {
      EXPECT_NEAR(found[c].frames, kOffsets[c], 0.04) << persons << " people, camera " << c;
      EXPECT_TRUE(found[c].is_told) << persons << " people, camera " << c;
    }
  }
}

// A single draw may be lucky, so eight are judged together.
TEST(SynchronisePeople, FindsItRoughlyFromKeypointsThatErr) {
  constexpr int kThrows = 8;
  for (const int persons : {1, 2}) {
    double squares = 0, worst = 0;
    for (int luck = 0; luck < kThrows; ++luck) {
      const Session noisy = Filmed(persons, 4, kOffsets, luck);
      const auto roughly = EstimateOffsets(noisy.cameras, noisy.people);
      for (std::size_t c = 1; c < kOffsets.size(); ++c) {
        const double off = roughly[c].frames - kOffsets[c];
        EXPECT_TRUE(roughly[c].is_told) << persons << " people, camera " << c;
        squares += off * off;
        worst = std::max(worst, std::abs(off));
      }
    }
    const double rms = std::sqrt(squares / (kThrows * static_cast<double>(kOffsets.size() - 1)));
    EXPECT_LT(rms, persons == 1 ? 0.3 : 0.15);
    EXPECT_LT(worst, 0.6);
  }
}

TEST(SynchronisePeople, TellsClocksThatAgree) {
  for (const double sigma_px : {0.0, 4.0}) {
    const Session agree = Filmed(1, sigma_px, {0, 0, 0, 0});
    for (const ClockOffset& offset : EstimateOffsets(agree.cameras, agree.people)) {
      EXPECT_NEAR(offset.frames, 0, sigma_px > 0 ? 0.5 : 0.1) << "to the frame";
      EXPECT_TRUE(offset.is_told);
    }
  }
}

TEST(SynchronisePeople, SaysSoWhereNothingTellsTheTime) {
  Session session = Filmed(1, 4);
  for (SeenPeople& people : session.people) {
    people.assign(people.size(), {});  // nobody is seen
  }
  std::vector<ClockOffset> found = EstimateOffsets(session.cameras, session.people);
  for (std::size_t c = 1; c < found.size(); ++c) {
    EXPECT_EQ(found[c].frames, 0) << c;
    EXPECT_FALSE(found[c].is_told) << c;
  }
  RandomStream dice = WalkersDice("stands still");
  for (std::size_t c = 0; c < session.people.size(); ++c) {
    Camera camera = FourCameras()[c];
    camera.distortion = {};
    for (auto& frame : session.people[c]) frame = {Seen(camera, Walker(0, 0, 0), 4, dice)};
  }
  found = EstimateOffsets(session.cameras, session.people);
  for (std::size_t c = 1; c < found.size(); ++c) EXPECT_FALSE(found[c].is_told) << c;
}

TEST(SynchronisePeople, SaysSoWhereAClockIsFurtherOffThanItLooked) {
  const Session session = Filmed(1, 0);
  const auto found = EstimateOffsets(session.cameras, session.people, {.clocks = {.max_frames = 5}, .follow = {}});
  EXPECT_TRUE(found[1].is_told);
  EXPECT_FALSE(found[3].is_told) << "11 frames late";
}

// One camera's clock is far out of the search, so its keypoints fit the other cameras' at no offset. The clocks of the
// other cameras, whichever of them comes first, must stay exact.
TEST(SynchronisePeople, NamesTheCameraThatIsOutOfRangeAndNotTheOthers) {
  for (const std::size_t cameras : {3u, 4u}) {
    for (std::size_t odd = 0; odd < cameras; ++odd) {
      std::vector<double> offsets(4, 0);
      offsets[odd] = 20;
      Session session = Filmed(1, 1.5, offsets);
      session.cameras.resize(cameras);
      session.people.resize(cameras);
      const auto found = EstimateOffsets(session.cameras, session.people, {.clocks = {.max_frames = 6}, .follow = {}});
      for (std::size_t c = 0; c < cameras; ++c) {
        EXPECT_EQ(found[c].is_told, c != odd) << c << " of " << cameras << ", odd: " << odd;
        EXPECT_NEAR(found[c].frames, 0, 0.3) << c << " of " << cameras << ", odd: " << odd;
        if (c == odd) continue;
        EXPECT_LT(4 * found[c].misfit, found[odd].misfit) << c << " of " << cameras << ", odd: " << odd;
      }
    }
  }
}

TEST(FindDrifts, NamesTheFilmThatDriftsAndSaysByHowMuch) {
  for (std::size_t odd = 0; odd < 4; ++odd) {
    std::vector<double> drifts(4, 0), offsets(4, 0);
    drifts[odd] = 0.08;   // over 60 frames: 4.8 frames, 2.4 between the middles of the halves
    offsets[odd] = -2.4;  // right in the middle of the film
    const Session session = Filmed(1, 1.5, offsets, 0, drifts);
    const auto found = FindDrifts(session.cameras, session.people);
    ASSERT_EQ(found.size(), 1u) << odd;
    EXPECT_EQ(found[0].film, odd);
    EXPECT_NEAR(found[0].frames, 2.4, 0.7);
    EXPECT_LT(found[0].changing_px, found[0].constant_px);
  }
}

TEST(FindDrifts, FindsNoneInClocksThatAgree) {
  for (const int persons : {1, 2}) {
    for (const double sigma_px : {0.0, 1.5, 6.0}) {
      for (int luck = 0; luck < 4; ++luck) {
        const Session session = Filmed(persons, sigma_px, {0, 0.3, -0.4, 0}, luck);
        EXPECT_TRUE(FindDrifts(session.cameras, session.people).empty()) << persons << " people, " << sigma_px;
      }
    }
  }
}

TEST(FindClocks, FindsOffsetsAndDriftsAndLeavesTheFirstFilm) {
  const std::vector<double> offsets = {0, 1.4, -2.25, 0.5}, drifts = {0, 0, 0.01, -0.015};
  const Session session = Filmed(1, 0.1, offsets, 0, drifts);
  const auto found = FindClocks(session.cameras, session.people, std::vector<FilmClock>(4), 4, {});
  EXPECT_FALSE(found[0].is_mended);
  EXPECT_EQ(found[0].clock, FilmClock{});
  for (std::size_t c = 1; c < 4; ++c) {
    EXPECT_TRUE(found[c].is_mended) << c;
    EXPECT_NEAR(found[c].clock.offset, offsets[c], 0.03) << c;
    EXPECT_NEAR(found[c].clock.drift, drifts[c], 0.001) << c;
    EXPECT_LT(found[c].after, 0.5 * found[c].before) << c;
    EXPECT_EQ(found[c].nearest, found[c].clock) << c;
    EXPECT_NEAR(found[c].clock.FrameAt(offsets[c] + (1 + drifts[c]) * 25), 25, 0.05) << c;
  }
}

TEST(FindClocks, LeavesClocksThatKeypointsDoNotContradict) {
  const std::vector<FilmClock> given = {{}, {3.4, 0}, {-7.25, 0}, {11, 0}};
  for (const double sigma_px : {0.1, 6.0}) {
    const Session session = Filmed(1, sigma_px);
    const auto found = FindClocks(session.cameras, session.people, given, 2, {});
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_FALSE(found[c].is_mended) << c;
      EXPECT_EQ(found[c].clock, given[c]) << c;
    }
  }
  const Session nobody = {.cameras = Filmed(1, 0).cameras, .people = std::vector<SeenPeople>(4, SeenPeople(60))};
  for (const FoundClock& found : FindClocks(nobody.cameras, nobody.people, given, 2, {})) EXPECT_FALSE(found.is_mended);
}

TEST(PeopleInTime, ShowsEverybodyAtTheFirstCamerasTime) {
  const Session session = Filmed(2, 0);
  const std::vector<Camera> cameras = FourCameras();
  const SeenPeople in_time = PeopleInTime(session.people[1], kOffsets[1], 60);
  ASSERT_EQ(in_time.size(), 60u);
  EXPECT_TRUE(in_time[2].empty()) << "before the camera's first frame";
  ASSERT_EQ(in_time[30].size(), 2u);
  const LandmarkPositions truth = Walker(-0.5, 0, 30 / kFilmRate);
  const Landmark wrist = Landmark::kLeftWrist;
  const glm::dvec2 wanted = *Project(session.cameras[1], *truth[Index(wrist)]);
  const auto off = [&](const SeenPeople& people) {
    return std::min(glm::distance(people[30][0][wrist].pixel, wanted),
                    glm::distance(people[30][1][wrist].pixel, wanted));
  };
  EXPECT_LT(off(in_time), 0.1);
  EXPECT_GT(off(session.people[1]), 5) << "the control: as they come";
}

}  // namespace
}  // namespace etude
