#include "engine/fuzzy/fuzzy_system.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

std::size_t PlaceOf(Feature feature, std::string_view name) {
  const auto terms = TermsOf(feature);
  for (std::size_t t = 0; t < terms.size(); ++t) {
    if (terms[t].name == name) return FirstTermOf(feature) + t;
  }
  ADD_FAILURE() << name;
  return 0;
}

const std::size_t kRightUp = PlaceOf(Feature::kRH, "up"), kLeftUp = PlaceOf(Feature::kLH, "up");

TEST(Rules, HoldAsFarAsTheirWeakestTerm) {
  const RuleBase base = {.poses = {"arms up"}, .rules = {{.terms = {kRightUp, kLeftUp}, .pose = 0}}};
  Grades grades{};
  grades[kRightUp] = 0.75;
  grades[kLeftUp] = 0.25;
  EXPECT_EQ(InferPoses(base, grades), std::vector{0.25});
}

TEST(Rules, GiveAPoseTheStrongestOfTheRulesThatConcludeIt) {
  const RuleBase base = {
      .poses = {"one arm up", "arms up"},
      .rules = {{.terms = {kRightUp}, .pose = 0}, {.terms = {kLeftUp}, .pose = 0}, {.terms = {kLeftUp}, .pose = 1}}};
  Grades grades{};
  grades[kRightUp] = 0.25;
  grades[kLeftUp] = 0.5;
  EXPECT_EQ(InferPoses(base, grades), (std::vector{0.5, 0.5}));
  EXPECT_EQ(*ChoosePose(base, grades), "one arm up") << "the earlier on a tie";
}

TEST(Rules, NameNoPoseWhenNoneHolds) {
  const RuleBase base = {.poses = {"arms up"}, .rules = {{.terms = {kRightUp}, .pose = 0}}};
  EXPECT_EQ(ChoosePose(base, Grades{}), nullptr);
  EXPECT_EQ(ChoosePose(RuleBase{}, Grades{}), nullptr);
}

TEST(PaperRules, NameThePosesThatTheirWordsSay) {
  using enum Feature;
  PoseFeatures rest;
  rest[kPosture] = 80;
  rest[kTrunk] = rest[kRFK] = rest[kLFK] = 180;
  const auto pose_of = [](const PoseFeatures& features) {
    const std::string* pose = ChoosePose(PaperRules(), Fuzzify(features));
    return pose == nullptr ? "" : *pose;
  };
  const auto with = [&](auto change) {
    PoseFeatures features = rest;
    change(features);
    return pose_of(features);
  };
  EXPECT_EQ(pose_of(rest), "at rest");
  EXPECT_EQ(with([](auto& f) { f[kRH] = f[kLH] = 175; }), "arms up");
  EXPECT_EQ(with([](auto& f) { f[kRH] = f[kLH] = 88; }), "arms out");
  EXPECT_EQ(with([](auto& f) { f[kRH] = 170; }), "one arm up");
  EXPECT_EQ(with([](auto& f) { f[kTrunk] = 100; }), "bow");
  EXPECT_EQ(with([](auto& f) { f[kPosture] = 42, f[kRFK] = f[kLFK] = 80, f[kRF] = f[kLF] = 70; }), "crouch");
  EXPECT_EQ(with([](auto& f) { f[kPosture] = 110; }), "jump");
  EXPECT_EQ(with([](auto& f) { f[kPosture] = 5, f[kTrunk] = 90; }), "lie");
}

}  // namespace
}  // namespace etude
