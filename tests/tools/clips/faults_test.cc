#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/engine/motion/standing_body.h"
#include "tools/clips/clip_facts.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

/// Returns a built-in clip of a body that stands at a height and breathes, 120 Hz, three seconds.
SourceClip Breathing(double height) {
  BodyMotion motion{.rate_hz = 120, .poses = {}};
  for (int f = 0; f < 360; ++f) {
    BodyPose pose = Standing();
    for (glm::dvec3& joint : pose.joints) joint.y += height;
    pose[Role::kHead].z += 0.01 * std::sin(f / 30.0);
    motion.poses.push_back(pose);
  }
  return {.name = "breathing",
          .source = "breathing",
          .format = ClipFormat::kBuiltin,
          .clip = ToClip(motion, "breathing"),
          .character = nullptr};
}

TEST(FaultsOfAClip, AreFoundAtTheRateOfItsFile) {
  SourceClip clip = Breathing(0);
  ASSERT_TRUE(FaultsOf(clip, {}));
  EXPECT_TRUE(FaultsOf(clip, {})->faults.empty()) << "the control";
  // A single frame at 120 Hz, which sampling at 30 Hz would skip.
  const int hand = clip.clip.skeleton.Find("left_hand");
  ASSERT_GE(hand, 0);
  clip.clip.frames[150][static_cast<std::size_t>(hand)].translation.y += 0.5;
  const auto found = FaultsOf(clip, {});
  ASSERT_EQ(found->faults.size(), 1u);
  EXPECT_THAT(found->faults.front().text, HasSubstr("left_hand pops by 50 cm at 1.24 s"));
}

TEST(FaultsOfAClip, AreFoundAtTheHeightsOfItsFile) {
  const auto found = FaultsOf(Breathing(0.15), {});
  ASSERT_TRUE(found && found->faults.size() == 1);
  EXPECT_EQ(found->faults.front().kind, FaultKind::kFloats);
}

TEST(FaultsOfAClip, StandInItsFactsForPeopleAndForPrograms) {
  const auto facts = FactsOf("builtin:clap", {});
  ASSERT_TRUE(facts.size() == 1 && facts[0].body && facts[0].body->faults);
  EXPECT_TRUE(FactsAsJson(facts)["clips"][0]["body"]["remarks"].empty());
  ClipFacts spoilt = facts[0];
  spoilt.body->faults->faults = {{FaultKind::kPops, 1, 1.5, Role::kHead, 0.5, 0, "head pops"}};
  EXPECT_THAT(FactsAsText(spoilt), HasSubstr("remark   head pops\n"));
  const Json told = FactsAsJson({spoilt})["clips"][0]["body"];
  EXPECT_EQ(told["remarks"], Json::array({"head pops"}));
  EXPECT_EQ(told["faults"]["list"][0], Json({{"kind", "pops"},
                                             {"from_s", 1.0},
                                             {"to_s", 1.5},
                                             {"joint", "head"},
                                             {"size", 0.5},
                                             {"unit", "m"},
                                             {"text", "head pops"}}));
}

}  // namespace
}  // namespace etude
