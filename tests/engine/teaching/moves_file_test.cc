#include "engine/teaching/moves_file.h"

#include <gtest/gtest.h>

#include "engine/teaching/teach_move.h"
#include "tests/engine/teaching/arms.h"
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

std::string MovesComplaint(const std::string& text) {
  const auto read = ReadMoves(text, "m.yaml");
  return read ? std::string("(read)") : ToString(read.error());
}

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

TEST(MovesFile, RefusalsSayWhere) {
  const std::string head = "moves:\n  - name: a\n";
  EXPECT_EQ(MovesComplaint("moves: []\n").find("m.yaml:1:8: no list 'moves'"), 0u);
  EXPECT_EQ(MovesComplaint(head + "    speed: 3\n").find("m.yaml:3:5: "), 0u)
      << MovesComplaint(head + "    speed: 3\n");
  EXPECT_EQ(MovesComplaint(head + "    key_poses: [{RX: 3}]\n").find("m.yaml:3:18: unknown feature 'RX'"), 0u);
  EXPECT_EQ(MovesComplaint(head + "    key_poses: [{RH: 3}]\n").find("m.yaml:3:18: no tolerance_deg"), 0u);
  EXPECT_EQ(MovesComplaint("moves:\n  - name: 'a\n\n      b'\n    span_s: 3\n"),
            "m.yaml:2:5: a name with a line break or another control character");
  EXPECT_EQ(MovesComplaint(head + "  - name: a\n").find("m.yaml:3:5: a second move called 'a'"), 0u);
  EXPECT_EQ(MovesComplaint(head + "    span_s: .nan\n").find("m.yaml:3:13: "), 0u);
  const std::string frames = head + "    right:\n      - rate_hz: 30\n        frames: |\n          ";
  EXPECT_EQ(MovesComplaint(frames + "ttt 1 2\n").find("m.yaml:6: found 'ttt'"), 0u);
  EXPECT_EQ(MovesComplaint(frames + "tttttttttttttttttttt 1 2\n").find("m.yaml:6: found"), 0u);
  std::string text = WriteMoves(TwoMoves());
  EXPECT_EQ(MovesComplaint(text), "(read)");
  text.insert(text.rfind('\n', text.size() - 20), " 5");
  EXPECT_NE(MovesComplaint(text).find("more than 60 numbers"), std::string::npos);
}

TEST(MovesFile, TakesWhatIsAtABoundAndNothingBeyond) {
  const auto reads = [](const std::string& text) { return MovesComplaint(text) == "(read)"; };
  const auto with = [](const std::string& field) { return "moves:\n  - name: a\n    " + field + "\n"; };
  const auto posed = [&](const std::string& pose) { return with("key_poses: [{" + pose + "}]"); };
  for (const char* span : {"0.1", "60"}) EXPECT_TRUE(reads(with(std::string("span_s: ") + span))) << span;
  for (const char* span : {"0.09", "60.1"}) EXPECT_FALSE(reads(with(std::string("span_s: ") + span))) << span;
  for (const char* tolerance : {"0.1", "360"}) {
    EXPECT_TRUE(reads(posed(std::string("RH: 3, tolerance_deg: ") + tolerance))) << tolerance;
    EXPECT_TRUE(reads(posed(std::string("RH: {degrees: -360, tolerance_deg: ") + tolerance + "}"))) << tolerance;
  }
  for (const char* tolerance : {"0.09", "360.1"}) {
    EXPECT_FALSE(reads(posed(std::string("RH: 3, tolerance_deg: ") + tolerance))) << tolerance;
    EXPECT_FALSE(reads(posed(std::string("RH: {degrees: 360, tolerance_deg: ") + tolerance + "}"))) << tolerance;
  }
  EXPECT_FALSE(reads(posed("RH: {degrees: 360.5, tolerance_deg: 20}")));
  EXPECT_FALSE(reads(posed("tolerance_deg: 20"))) << "no angle";
  EXPECT_TRUE(reads("moves:\n  - name: " + std::string(200, 'a') + "\n"));
  EXPECT_FALSE(reads("moves:\n  - name: " + std::string(201, 'a') + "\n"));
  std::string many = "moves:\n";
  for (int i = 0; i < 200; ++i) many += "  - name: m" + std::to_string(i) + "\n";
  EXPECT_TRUE(reads(many));
  EXPECT_FALSE(reads(many + "  - name: more\n"));
  const auto shown = [&](const std::string& rate, const std::string& x) {
    std::string frame = std::string(20, 't') + " " + x;
    for (int i = 1; i < 60; ++i) frame += " 1";
    return with("right:\n      - rate_hz: " + rate + "\n        frames: |\n          " + frame);
  };
  for (const char* rate : {"1", "1000"}) EXPECT_TRUE(reads(shown(rate, "-100000"))) << rate;
  for (const char* rate : {"0.9", "1000.5"}) EXPECT_FALSE(reads(shown(rate, "0"))) << rate;
  EXPECT_FALSE(reads(shown("30", "100000.5")));
}

}  // namespace
}  // namespace etude
