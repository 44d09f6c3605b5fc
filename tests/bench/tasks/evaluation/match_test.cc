#include "bench/tasks/evaluation/match.h"

#include <gmock/gmock.h>

#include "bench/metrics/catalogue.h"
#include "bench/tasks/evaluation/options.h"
#include "bench/tasks/evaluation/run.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A body that stands, and glides along Z by 0.3 m a second.
RawMotion Gliding(double rate_hz, std::size_t frames) {
  RawMotion motion;
  motion.name = "gliding";
  motion.rate_hz = rate_hz;
  for (const Role role : AllRoles()) {
    motion.roles[Index(role)] = static_cast<int>(motion.joints.size());
    motion.joints.emplace_back(RoleName(role));
  }
  const BodyPose pose = StandingPose();
  for (std::size_t f = 0; f < frames; ++f) {
    const glm::dvec3 moved(0, 0, 0.3 * static_cast<double>(f) / rate_hz);
    for (const glm::dvec3& joint : pose.joints) motion.positions.push_back(joint + moved);
  }
  return motion;
}

double ValueIn(const CellResult& result, const std::string& id) {
  for (const MetricValue& metric : result.metrics) {
    if (metric.id == id) return metric.value.value_or(-1);
  }
  return -2;
}

CellResult Judged(const RawMotion& truth, const RawMotion& answer, const std::string& joints = "roles") {
  const auto matched = Match(truth, answer, joints);
  EXPECT_TRUE(matched) << ToString(matched.error());
  return JudgeMotion(*matched);
}

TEST(Match, AShiftIsAllThatIsLeftOfAnAnswerAtAnotherRate) {
  RawMotion answer = Gliding(12.5, 26);
  for (glm::dvec3& p : answer.positions) p.x += 0.01;
  const CellResult result = Judged(Gliding(30, 60), answer);
  EXPECT_NEAR(ValueIn(result, "mpjpe_unaligned_mm"), 10, 1e-9);
  EXPECT_NEAR(ValueIn(result, "mpjpe_root_mm"), 0, 1e-9);
  EXPECT_NEAR(ValueIn(result, "mpjpe_take_mm"), 0, 1e-9);
  EXPECT_NEAR(ValueIn(result, "accel_error_mps2"), 0, 1e-9);
  EXPECT_EQ(ValueIn(result, "seen_share"), 1);
  EXPECT_THAT(result.reason, HasSubstr("20 joints, 60 frames at 30 Hz, the answer's 12.5 Hz interpolated linearly"));
}

TEST(Match, AnAnswerThatEndsEarlyIsJudgedWhereItIs) {
  const CellResult result = Judged(Gliding(30, 60), Gliding(30, 45));
  EXPECT_NEAR(ValueIn(result, "mpjpe_unaligned_mm"), 0, 1e-9);
  EXPECT_NEAR(ValueIn(result, "seen_share"), 0.75, 1e-12);
  EXPECT_THAT(result.reason, HasSubstr("the last 15 after the answer's end"));
}

TEST(Match, ABodyOfAnotherSizeIsRightOnceScaled) {
  RawMotion answer = Gliding(30, 10);
  for (glm::dvec3& p : answer.positions) p *= 1.1;
  const CellResult result = Judged(Gliding(30, 10), answer);
  EXPECT_GT(ValueIn(result, "mpjpe_root_mm"), 10);
  for (const char* id : {"mpjpe_root_scaled_mm", "mpjpe_first_frame_scaled_mm", "mpjpe_take_scaled_mm",
                         "mpjpe_each_frame_scaled_mm", "wa_mpjpe_mm@wham"}) {
    EXPECT_NEAR(ValueIn(result, id), 0, 1e-9) << id;
  }
}

TEST(Match, ATurnedAndMovedBodyIsRightOnceMoved) {
  RawMotion answer = Gliding(30, 10);
  for (glm::dvec3& p : answer.positions) p = {p.z + 2, p.y, -p.x};
  const CellResult result = Judged(Gliding(30, 10), answer);
  EXPECT_GT(ValueIn(result, "mpjpe_unaligned_mm"), 1000);
  for (const char* id : {"mpjpe_first_frame_mm", "mpjpe_take_mm", "mpjpe_each_frame_mm", "rte@wham"}) {
    EXPECT_NEAR(ValueIn(result, id), 0, 1e-9) << id;
  }
}

TEST(Match, JudgesWhatBothHaveOfASet) {
  RawMotion answer = Gliding(30, 3);
  answer.roles[Index(Role::kLeftElbow)] = -1;
  answer.joints[Index(Role::kLeftElbow)] = "something";
  const auto matched = Match(Gliding(30, 3), answer, "lsp-14");
  ASSERT_TRUE(matched);
  EXPECT_EQ(matched->joints.size(), 13u);
  EXPECT_THAT(matched->lacking, ElementsAre("left_elbow"));
  EXPECT_EQ(matched->bends.size(), 3u) << "both knees, and the right elbow";
  const std::size_t sizes[] = {0, 0, 20, 17, 17, 22, 24, 14};
  const auto sets = JointSetNames();
  ASSERT_EQ(sets.size(), std::size(sizes));
  for (std::size_t i = 0; i < sets.size(); ++i) EXPECT_EQ(JointsOfSet(sets[i]).size(), sizes[i]) << sets[i];
}

TEST(Match, EqualNamesArePairedWhateverTheirRoles) {
  RawMotion truth = Gliding(30, 3), answer = Gliding(30, 3);
  truth.joints[0] = answer.joints[5] = "mine";
  const auto matched = Match(truth, answer, "same");
  ASSERT_TRUE(matched);
  EXPECT_EQ(matched->joints.front(), "mine");
  EXPECT_EQ(matched->joints.size(), 19u);
  EXPECT_GT(ValueIn(JudgeMotion(*matched), "mpjpe_unaligned_mm"), 0);
}

TEST(Match, FailsWithoutACommonJointOrAnySeen) {
  RawMotion others = Gliding(30, 3);
  others.roles = RawMotion::NoRoles();
  for (std::string& name : others.joints) name += "_x";
  const auto none = Match(Gliding(30, 3), others, "roles");
  ASSERT_FALSE(none);
  EXPECT_THAT(ToString(none.error()), HasSubstr("no joint in common"));
  RawMotion blind = Gliding(30, 3);
  for (glm::dvec3& p : blind.positions) p = NotSeen();
  const auto unseen = Match(Gliding(30, 3), blind, "roles");
  ASSERT_FALSE(unseen);
  EXPECT_THAT(ToString(unseen.error()), HasSubstr("ever seen by both"));
}

TEST(JudgeMotion, ReportsEveryMetricOfTheTask) {
  const CellResult result = Judged(Gliding(30, 1), Gliding(30, 1));  // too short for most
  for (const std::string& id : EvaluationMetrics()) {
    EXPECT_NE(ValueIn(result, id), -2) << id;
    EXPECT_NE(FindMetric(id), nullptr) << id;
  }
  EXPECT_EQ(result.metrics.size(), EvaluationMetrics().size());
}

}  // namespace
}  // namespace etude
