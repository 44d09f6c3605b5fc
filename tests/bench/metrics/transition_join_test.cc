#include "bench/metrics/transition_join.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "tests/engine/motion/standing_body.h"

namespace etude {
namespace {

using Poses = std::vector<BodyPose>;

constexpr int kPoint = 20, kClipFrames = 80;

/// Returns a standing body that is lifted by `lift` metres in the frames `from` … `to`.
Poses Lifted(double lift, int from, int to) {
  Poses poses(kClipFrames, Standing());
  for (int f = from; f <= to; ++f) {
    for (glm::dvec3& joint : poses[f].joints) joint.y += lift;
  }
  return poses;
}

/// A join from standing to standing, which needs no movement.
class StandingJoin {
 public:
  explicit StandingJoin(Poses shown)
      : shown_(std::move(shown)), left_(kClipFrames, Standing()), wanted_(60, Standing()) {}

  JoinView View() const {
    return {.shown = shown_, .left = left_, .wanted = wanted_, .request = 10, .first = kPoint, .last = kPoint};
  }

 private:
  Poses shown_, left_, wanted_;
};

TEST(JoinSupport, IsOfOneSecondAndAFifthAtLeastAsFarAsTheMotionGoes) {
  const StandingJoin stands(Lifted(0, 0, 0));
  EXPECT_EQ(JoinSupport(stands.View()).size(), 37u);
  const StandingJoin settles_late(Lifted(0.06, 60, 65));  // 6 cm: farther than kArrived
  EXPECT_EQ(JoinSupport(settles_late.View()).size(), 66u - kPoint + 1);
  JoinView ends = stands.View();
  ends.shown = ends.shown.first(40);
  EXPECT_EQ(JoinSupport(ends).size(), 20u);
}

TEST(UnsupportedFrames, AreTheMostInARow) {
  EXPECT_EQ(UnsupportedFrames({}), 0);
  Support held{.joints = 1}, flies{.joints = {}, .flight = true}, floats;
  EXPECT_EQ(UnsupportedFrames(std::vector{floats, floats, held, floats, floats, floats, flies}), 3);
}

TEST(IsSupported, FailsWhereABodyFloatsForFourFrames) {
  EXPECT_TRUE(IsSupported(JoinSupport(StandingJoin(Lifted(0, 0, 0)).View())));
  // A jump within one frame: its neighbouring frames move too fast to rest.
  EXPECT_EQ(UnsupportedFrames(JoinSupport(StandingJoin(Lifted(0.05, 30, 30)).View())), 3);
  EXPECT_EQ(UnsupportedFrames(JoinSupport(StandingJoin(Lifted(0.05, 30, 39)).View())), 12);
  EXPECT_FALSE(IsSupported(JoinSupport(StandingJoin(Lifted(0.05, 30, 39)).View())));
}

TEST(JoinSupport, AsksAClipOnTheWay) {
  const StandingJoin floats(Lifted(0.3, 30, 39));
  const Poses step(10, Lifted(0.3, 0, 0)[0]);  // this clip's body stands 0.3 m higher, on something
  JoinView view = floats.View();
  view.between = {{.poses = step, .begin = 30, .left_at = 39}};
  EXPECT_EQ(UnsupportedFrames(JoinSupport(floats.View())), 12);
  EXPECT_LE(UnsupportedFrames(JoinSupport(view)), 2) << "only where it leaps up, and down again";
}

TEST(BalanceCm, IsTheMeanOverTheFramesThatSomethingBears) {
  const StandingJoin stands(Lifted(0, 0, 0));
  EXPECT_NEAR(BalanceCm(stands.View(), JoinSupport(stands.View())).value_or(-1), 0, 1e-12);
  Support left_foot, floats;
  left_foot.joints.set(Index(Role::kLeftAnkle)).set(Index(Role::kLeftFoot));
  EXPECT_NEAR(BalanceCm(stands.View(), std::vector{left_foot, floats, left_foot}).value_or(-1), 10, 1e-9)
      << "the foot stands 10 cm beside the middle";
  EXPECT_FALSE(BalanceCm(stands.View(), std::vector{floats}));
}

}  // namespace
}  // namespace etude
