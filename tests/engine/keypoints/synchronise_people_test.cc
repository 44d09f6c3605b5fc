#include "engine/keypoints/synchronise_people.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/keypoints/walkers.h"

namespace etude {
namespace {

constexpr double kFilmRate = 30;
const std::vector<double> kOffsets = {0, 3.4, -7.25, 11};  // frames

struct Session {
  std::vector<ProjectionMatrix> cameras;
  std::vector<SeenPeople> people;
};

/// One or two people before four cameras whose clocks are off, in an order that changes; the second one unseen by the
/// last camera. The films have different lengths.
Session Filmed(int persons, double sigma_px, const std::vector<double>& offsets = kOffsets) {
  RandomStream dice = WalkersDice("clocks");
  Session session;
  std::vector<Camera> cameras = FourCameras();
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    cameras[c].distortion = {};
    session.cameras.push_back(MatrixOf(cameras[c]));
    SeenPeople& people = session.people.emplace_back(60 + 3 * c);
    for (std::size_t k = 0; k < people.size(); ++k) {
      const double t = (static_cast<double>(k) + offsets[c]) / kFilmRate;
      people[k].push_back(Seen(cameras[c], Walker(-0.5, 0, t), sigma_px, dice));
      if (persons > 1 && c < 3) people[k].push_back(Seen(cameras[c], Walker(0.7, 0.2, t + 0.4), sigma_px, dice));
      if (people[k].size() > 1 && (k * 7 + c) % 3 == 0) std::swap(people[k][0], people[k][1]);
    }
  }
  return session;
}

TEST(SynchronisePeople, FindsHowLateEveryCameraIs) {
  for (const int persons : {1, 2}) {
    const Session exact = Filmed(persons, 0), noisy = Filmed(persons, 4);
    const auto found = EstimateOffsets(exact.cameras, exact.people),
               roughly = EstimateOffsets(noisy.cameras, noisy.people);
    for (std::size_t c = 0; c < kOffsets.size(); ++c) {
      EXPECT_NEAR(found[c], kOffsets[c], 0.04) << persons << " people, camera " << c;
      EXPECT_NEAR(roughly[c], kOffsets[c], 0.25) << persons << " people, camera " << c;
    }
  }
}

TEST(SynchronisePeople, LeavesClocksAloneThatNothingTellsOf) {
  const Session agree = Filmed(1, 0, {0, 0, 0, 0});
  for (const double offset : EstimateOffsets(agree.cameras, agree.people)) EXPECT_NEAR(offset, 0, 0.1);
  Session empty = agree;
  for (SeenPeople& people : empty.people) people.assign(people.size(), {});
  EXPECT_EQ(EstimateOffsets(empty.cameras, empty.people), std::vector<double>(4, 0.0));
}

TEST(PeopleInTime, ShowsEverybodyAtTheFirstCamerasTime) {
  const Session session = Filmed(2, 0);
  const std::vector<Camera> cameras = FourCameras();
  const SeenPeople in_time = PeopleInTime(session.people[1], kOffsets[1], 60);
  ASSERT_EQ(in_time.size(), 60u);
  EXPECT_TRUE(in_time[2].empty()) << "before the camera's first frame";
  ASSERT_EQ(in_time[30].size(), 2u);
  const LandmarkPlaces truth = Walker(-0.5, 0, 30 / kFilmRate);
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
