#include "engine/keypoints/correct_people.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "tests/engine/keypoints/walkers.h"

namespace etude {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::size_t kCorrectedFrames = 50;

/// A walker seen by some cameras, with another person behind; `person` is the walker.
struct CorrectedTake {
  std::vector<ProjectionMatrix> cameras;
  std::vector<SeenPeople> people;
  MatchedPerson person, truth;

  using Figure = std::function<LandmarkPositions(double x, double z, double seconds)>;

  explicit CorrectedTake(std::size_t count, double sigma_px = 1, const Figure& figure = Walker) {
    RandomStream dice = WalkersDice("mended");
    const std::vector<Camera> all = Pinholes();
    for (std::size_t c = 0; c < count; ++c) {
      cameras.push_back(MatrixOf(all[c]));
      people.emplace_back(kCorrectedFrames);
      person.seen.emplace_back(kCorrectedFrames);
      for (std::size_t k = 0; k < kCorrectedFrames; ++k) {
        const double t = static_cast<double>(k) / 30;
        people[c][k] = {Seen(all[c], Walker(0.7, 0.2, t + 0.4), sigma_px, dice),
                        Seen(all[c], figure(-0.5, 0, t), sigma_px, dice)};
        person.seen[c][k] = people[c][k][1];
      }
    }
    truth = person;
  }

  std::vector<PersonCorrection> Run() { return CorrectPerson(cameras, people, 0.1, person); }

  /// Returns the number of frames and cameras in which the person's keypoints are wrong.
  std::size_t Wrong() const {
    std::size_t wrong = 0;
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      for (std::size_t k = 0; k < kCorrectedFrames; ++k) {
        const auto &now = person.seen[c][k], &then = truth.seen[c][k];
        bool is_same = now.has_value() == then.has_value();
        for (std::size_t i = 0; is_same && now && i < kLandmarkCount; ++i) {
          is_same = now->keypoints[i].pixel == then->keypoints[i].pixel;
        }
        wrong += is_same ? 0 : 1;
      }
    }
    return wrong;
  }
};

std::vector<std::size_t> FramesFrom(std::size_t first, std::size_t last) {
  std::vector<std::size_t> frames(last - first);
  std::iota(frames.begin(), frames.end(), first);
  return frames;
}

bool IsOfLegs(Landmark landmark) {
  const std::string_view name = LandmarkName(landmark);
  for (const std::string_view part : {"Hip", "Knee", "Ankle", "Toe", "Heel"}) {
    if (name.find(part) != std::string_view::npos) return true;
  }
  return false;
}

/// Returns the person with left and right exchanged: legs, the rest, or both.
SeenPerson Exchanged(const SeenPerson& person, bool legs, bool arms) {
  SeenPerson other = person;
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    const auto landmark = static_cast<Landmark>(i);
    if (IsOfLegs(landmark) ? legs : arms) other[landmark] = person[OtherSide(landmark)];
  }
  return other;
}

TEST(OtherSide, ExchangesNamesThatBeginWithASide) {
  EXPECT_EQ(OtherSide(Landmark::kLeftWrist), Landmark::kRightWrist);
  EXPECT_EQ(OtherSide(Landmark::kRightSmallToe), Landmark::kLeftSmallToe);
  EXPECT_EQ(OtherSide(Landmark::kNose), Landmark::kNose);
  SeenPerson person;
  for (std::size_t i = 0; i < kLandmarkCount; ++i) person.keypoints[i].pixel.x = static_cast<double>(i);
  const SeenPerson swapped = WithSidesSwapped(person);
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    const auto landmark = static_cast<Landmark>(i);
    EXPECT_EQ(OtherSide(OtherSide(landmark)), landmark) << LandmarkName(landmark);
    EXPECT_EQ(swapped[landmark].pixel, person[OtherSide(landmark)].pixel) << LandmarkName(landmark);
  }
}

TEST(CorrectPerson, LeavesWhatIsRightAlone) {
  for (const std::size_t cameras : {2u, 3u, 4u}) {
    for (const double sigma_px : {0.0, 4.0}) {
      CorrectedTake take(cameras, sigma_px);
      EXPECT_THAT(take.Run(), IsEmpty()) << cameras << " cameras, " << sigma_px << " px";
      EXPECT_EQ(take.Wrong(), 0u);
    }
  }
}

TEST(CorrectPerson, SwapsBackWhatOneCameraExchangedForAWhile) {
  using enum PersonCorrection::Kind;
  for (const auto& [legs, arms, kind] :
       {std::tuple(true, true, kSwappedSides), {true, false, kSwappedLegs}, {false, true, kSwappedArms}}) {
    for (const std::size_t cameras : {2u, 4u}) {  // with two cameras, only the facing shows which one was wrong
      for (const std::size_t camera : {0u, 1u}) {
        CorrectedTake take(cameras);
        for (std::size_t k = 20; k < 40; ++k) {
          take.person.seen[camera][k] = Exchanged(*take.person.seen[camera][k], legs, arms);
        }
        EXPECT_EQ(take.Wrong(), 20u) << "the control";
        const auto corrections = take.Run();
        ASSERT_THAT(corrections, SizeIs(1)) << cameras << " cameras, wrong in " << camera;
        EXPECT_EQ(corrections[0].kind, kind);
        EXPECT_EQ(corrections[0].camera, camera);
        EXPECT_EQ(corrections[0].frames, FramesFrom(20, 40));
        EXPECT_EQ(take.Wrong(), 0u);
      }
    }
  }
}

TEST(CorrectPerson, ToesTellWhereAllCamerasExchangedThroughout) {
  CorrectedTake take(3);
  for (auto& camera : take.person.seen) {
    for (auto& seen : camera) seen = Exchanged(*seen, true, true);
  }
  const auto corrections = take.Run();
  ASSERT_THAT(corrections, SizeIs(3));
  for (const PersonCorrection& correction : corrections) {
    EXPECT_EQ(correction.kind, PersonCorrection::Kind::kSwappedSides);
    EXPECT_EQ(correction.frames, FramesFrom(0, kCorrectedFrames));
  }
  EXPECT_EQ(take.Wrong(), 0u);
}

TEST(CorrectPerson, ToesOfAKneelerPointBackwards) {
  // The shanks lie on the floor. The feet are stretched to 0.2 or 0.7 radians from the shanks' direction.
  for (const double foot : {0.2, 0.7}) {
    const auto kneeler = [foot](double x, double z, double seconds) {
      LandmarkPositions marks = Walker(x, z, seconds);
      for (const auto& [knee, ankle, toe] :
           {std::array{Landmark::kLeftKnee, Landmark::kLeftAnkle, Landmark::kLeftBigToe},
            {Landmark::kRightKnee, Landmark::kRightAnkle, Landmark::kRightBigToe}}) {
        marks[Index(ankle)] = *marks[Index(knee)] - glm::dvec3(0, 0, 0.42);
        marks[Index(toe)] = *marks[Index(ankle)] - 0.18 * glm::dvec3(0, std::sin(foot), std::cos(foot));
      }
      return marks;
    };
    CorrectedTake take(3, 1, kneeler);
    EXPECT_THAT(take.Run(), IsEmpty()) << foot;
    EXPECT_EQ(take.Wrong(), 0u) << foot;
  }
}

TEST(CorrectPerson, FindsThePersonAgainWhereSomebodyElsesKeypointsStoodForIt) {
  for (const std::size_t camera : {0u, 1u}) {
    CorrectedTake take(4);
    for (std::size_t k = 10; k < 20; ++k) take.person.seen[camera][k] = take.people[camera][k][0];
    const auto corrections = take.Run();
    ASSERT_THAT(corrections, SizeIs(1));
    EXPECT_EQ(corrections[0].kind, PersonCorrection::Kind::kOtherPerson);
    EXPECT_EQ(corrections[0].camera, camera);
    EXPECT_EQ(corrections[0].frames, FramesFrom(10, 20));
    EXPECT_EQ(take.Wrong(), 0u);
  }
}

TEST(CorrectPerson, OfSeveralWhoFitMuchBetterTheBestIsTaken) {
  for (const bool is_first : {true, false}) {
    CorrectedTake take(4);
    for (std::size_t k = 10; k < 20; ++k) {
      // A second detection of the walker, some pixels away.
      auto& people = take.people[1][k];
      SeenPerson blurred = people[1];
      for (Keypoint& keypoint : blurred.keypoints) keypoint.pixel += glm::dvec2(4, 4);
      take.person.seen[1][k] = people[0];
      people.insert(is_first ? people.begin() : people.end(), blurred);
    }
    take.Run();
    EXPECT_EQ(take.Wrong(), 0u) << is_first;
  }
}

TEST(CorrectPerson, TakesNobodyWhereAThirdCameraContradictsAndNobodyFits) {
  for (const std::size_t cameras : {2u, 4u}) {
    CorrectedTake take(cameras);
    for (std::size_t k = 10; k < 15; ++k) {
      take.people[1][k].pop_back();
      take.people[0][k].erase(take.people[0][k].begin());
      take.person.seen[1][k] = take.people[1][k][0];
      take.truth.seen[1][k].reset();
    }
    const auto corrections = take.Run();
    if (cameras == 2) {
      EXPECT_EQ(take.Wrong(), 5u) << "of two nothing tells which is wrong";
      continue;
    }
    ASSERT_THAT(corrections, SizeIs(1));
    EXPECT_EQ(corrections[0].kind, PersonCorrection::Kind::kNobody);
    EXPECT_EQ(corrections[0].camera, 1u);
    EXPECT_EQ(corrections[0].frames, FramesFrom(10, 15));
    EXPECT_EQ(take.Wrong(), 0u);
  }
}

TEST(OutlierLimit, IsEightDeviationsOfTheResidualsWithinItsBounds) {
  const auto limit = [](double sigma_px, double least, double most) {
    const CorrectedTake take(4, sigma_px);
    return OutlierLimit(take.cameras, take.person, 0.1, least, most);
  };
  // The residual of four views is σ √(χ² / 4) with 8 − 3 degrees of freedom, whose median is 4.35.
  for (const double sigma_px : {0.5, 2.0}) {
    EXPECT_NEAR(limit(sigma_px, 0, 200), 8 * 1.4826 * sigma_px * std::sqrt(4.35 / 4), 0.6 * sigma_px) << sigma_px;
  }
  EXPECT_EQ(limit(0, 7, 60), 7);
  EXPECT_EQ(limit(5, 7, 40), 40);
  CorrectedTake nobody(2);
  for (auto& camera : nobody.person.seen) camera.assign(kCorrectedFrames, std::nullopt);
  EXPECT_EQ(OutlierLimit(nobody.cameras, nobody.person, 0.1, 7, 60), 60);
}

}  // namespace
}  // namespace etude
