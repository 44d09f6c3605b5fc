#include "engine/teaching/moves_file.h"

#include <gtest/gtest.h>

#include "engine/teaching/teach_move.h"
#include "tests/engine/teaching/arms.h"
#include "tests/support/kept_answers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::Raise;

std::vector<TaughtMove> TwoMoves() {
  SkeletonStream seen = Raise(10, 100);
  seen.frames[3][Role::kHead].state = TrackingState::kInferred;
  seen.frames[4][Role::kHead].state = TrackingState::kNotTracked;
  for (SensedJoint& joint : seen.frames[5].joints) joint.state = TrackingState::kNotTracked;
  seen.frames[5].body_seen = false;
  return {*TeachMove("it's a raise", {seen, Raise(10, 90)}, {Raise(10, 40)}),
          *TeachMove("lower: all", {Raise(90, 20)})};
}

std::string MovesComplaint(const std::string& text) { return testing::Refusal(ReadMoves(text, "m.yaml")); }

TEST(MovesFile, ComesBackAsItWasWritten) {
  const std::vector<TaughtMove> moves = TwoMoves();
  const std::string text = WriteMoves(moves);
  ASSERT_OK(read, ReadMoves(text, "m.yaml"));
  EXPECT_EQ(WriteMoves(*read), text);
  ASSERT_EQ(read->size(), 2u);
  const TaughtMove &before = moves[0], &after = (*read)[0];
  EXPECT_EQ(after.name, before.name);
  EXPECT_EQ(after.span_s, before.span_s);
  ASSERT_EQ(after.poses.size(), before.poses.size());
  EXPECT_NEAR(after.poses[1].targets[0].degrees, before.poses[1].targets[0].degrees, 0.05);
  ASSERT_EQ(after.examples.size(), 2u);
  EXPECT_EQ(after.counter_examples.size(), 1u);
  for (std::size_t t = 0; t < before.examples[0].frames.size(); ++t) {
    const SensedFrame &a = before.examples[0].frames[t], &b = after.examples[0].frames[t];
    EXPECT_EQ(a.body_seen, b.body_seen);
    for (const Role role : AllRoles()) {
      EXPECT_EQ(a[role].state, b[role].state);
      EXPECT_LT(glm::distance(a[role].position, b[role].position), 1e-4);
    }
  }
}

TEST(MovesFile, MayBeWrittenByHandWithKeyPosesAlone) {
  ASSERT_OK(
      read,
      ReadMoves("moves:\n  - name: arms-out\n    key_poses:\n      - {tolerance_deg: 20, RH: 90, LH: {degrees: 90, "
                "tolerance_deg: 15}}\n",
                "m.yaml"));
  const std::vector<PoseTarget>& targets = (*read)[0].poses[0].targets;
  EXPECT_EQ(targets[0].tolerance_deg, 20);
  EXPECT_EQ(targets[1].tolerance_deg, 15);
}

TEST(MovesFile, RefusalsSayWhereAndWhatIsAllowed) {
  EXPECT_TRUE(testing::AnswersAreKept("tests/engine/teaching/complaints.txt", MovesComplaint));
  std::string many = "moves:\n";
  for (int i = 0; i < 200; ++i) many += "  - name: m" + std::to_string(i) + "\n";
  EXPECT_EQ(MovesComplaint(many), "accepted");
  EXPECT_NE(MovesComplaint(many + "  - name: more\n"), "accepted");
  std::string text = WriteMoves(TwoMoves());
  EXPECT_EQ(MovesComplaint(text), "accepted");
  text.insert(text.rfind('\n', text.size() - 20), " 5");
  EXPECT_NE(MovesComplaint(text).find("more than 60 numbers"), std::string::npos);
}

}  // namespace
}  // namespace etude
