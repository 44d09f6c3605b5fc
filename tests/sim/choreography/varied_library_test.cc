#include "tests/sim/choreography/varied_library.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "engine/fuzzy/features.h"
#include "engine/fuzzy/membership.h"
#include "sim/choreography/move.h"

namespace etude {
namespace {

constexpr int kFrames = 3000;

std::vector<BodyMotion> Seeds() {
  std::vector<BodyMotion> seeds;
  for (const char* name : {"clap", "jump", "boxing"}) seeds.push_back(LoadBuiltinMove(name).value().motion);
  return seeds;
}

std::vector<BodyMotion> Vary(const std::vector<BodyMotion>& seeds, const char* purpose, int frames = kFrames) {
  RandomStream dice({.suite_seed = 5, .scenario = "varied", .trial = 0}, purpose);
  return VariedLibrary(seeds, frames, dice);
}

/// Returns joints relative to the hips and heading, so that the place does not matter.
std::vector<double> Shape(const BodyPose& pose) {
  const BodyPose at_origin = ToOrigin(pose).Apply(pose);
  std::vector<double> numbers;
  for (const glm::dvec3& joint : at_origin.joints) numbers.insert(numbers.end(), {joint.x, joint.y, joint.z});
  return numbers;
}

TEST(VariedLibrary, HasAsManyFramesAsAskedForAndNoCopies) {
  std::set<std::vector<double>> shapes;
  std::size_t frames = 0;
  for (const BodyMotion& clip : Vary(Seeds(), "copies")) {
    EXPECT_FALSE(clip.poses.empty());
    frames += clip.poses.size();
    for (const BodyPose& pose : clip.poses) shapes.insert(Shape(pose));
  }
  EXPECT_EQ(frames, static_cast<std::size_t>(kFrames));
  EXPECT_EQ(shapes.size(), frames);
  EXPECT_TRUE(Vary(Seeds(), "copies", 0).empty());
}

TEST(VariedLibrary, KeepsLimbLengths) {
  const std::vector<BodyMotion> seeds = Seeds();
  const BodyPose& seed = seeds[0].poses[0];
  for (const BodyMotion& clip : Vary(seeds, "limbs")) {
    for (const BodyPose& pose : clip.poses) {
      for (const Bone& bone : AllBones()) EXPECT_NEAR(BoneLength(pose, bone), BoneLength(seed, bone), 1e-9);
    }
  }
}

TEST(VariedLibrary, VariesTempoWithinItsBounds) {
  const std::vector<BodyMotion> seeds = {Seeds()[0]};
  const auto length = static_cast<double>(seeds[0].poses.size());
  std::vector<BodyMotion> clips = Vary(seeds, "tempo");
  clips.pop_back();  // the last clip is cut off
  double shortest = 1e9, longest = 0;
  for (const BodyMotion& clip : clips) {
    shortest = std::min(shortest, static_cast<double>(clip.poses.size()));
    longest = std::max(longest, static_cast<double>(clip.poses.size()));
  }
  EXPECT_GE(shortest, length / 1.4 - 2);
  EXPECT_LE(longest, length / 0.7 + 2);
  EXPECT_GT(longest, 1.2 * shortest);
}

TEST(VariedLibrary, VariesAmplitudesAndSides) {
  const BodyMotion boxing = LoadBuiltinMove("boxing").value().motion;
  double left_most = 0, right_most = 0;
  std::vector<double> highest;
  for (const BodyMotion& clip : Vary({boxing}, "amplitudes")) {
    double left = 0, right = 0;
    for (const BodyPose& pose : clip.poses) {
      const PoseFeatures features = ComputeFeatures(pose, StandingHipHeight(pose));
      left = std::max(left, features[Feature::kLH]);
      right = std::max(right, features[Feature::kRH]);
    }
    highest.push_back(left);
    left_most = std::max(left_most, left);
    right_most = std::max(right_most, right);
  }
  const auto [least, most] = std::ranges::minmax(highest);
  EXPECT_GT(most - least, 5) << "degrees";
  EXPECT_LE(most, 180);
  EXPECT_NEAR(left_most, right_most, 25) << "either side takes either part";
}

TEST(VariedLibrary, MovesAsSmoothlyAsItsSeeds) {
  const auto fastest_step = [](std::span<const BodyMotion> clips) {
    double most = 0;
    for (const BodyMotion& clip : clips) {
      for (std::size_t f = 1; f < clip.poses.size(); ++f) {
        for (Role role : AllRoles()) {
          most = std::max(most, glm::distance(clip.poses[f][role], clip.poses[f - 1][role]));
        }
      }
    }
    return most;
  };
  const std::vector<BodyMotion> seeds = Seeds();
  EXPECT_LT(fastest_step(Vary(seeds, "smooth")), 1.4 * 1.3 * 1.5 * fastest_step(seeds));
}

TEST(VariedLibrary, DependsOnItsDiceAlone) {
  const auto first_shapes = [](const std::vector<BodyMotion>& clips) {
    std::vector<std::vector<double>> shapes;
    for (const BodyMotion& clip : clips) shapes.push_back(Shape(clip.poses.front()));
    return shapes;
  };
  EXPECT_EQ(first_shapes(Vary(Seeds(), "dice")), first_shapes(Vary(Seeds(), "dice")));
  EXPECT_NE(first_shapes(Vary(Seeds(), "dice")), first_shapes(Vary(Seeds(), "others")));
}

TEST(VariedLibrary, TakesSeedsThatStandStill) {
  const BodyPose pose = Seeds()[0].poses[0];
  const std::vector<BodyMotion> seeds = {{kJudgedRateHz, {pose, pose}}};
  const std::vector<BodyMotion> clips = Vary(seeds, "still", 20);
  for (const BodyMotion& clip : clips) {
    for (const BodyPose& varied : clip.poses) {
      for (Role role : AllRoles()) EXPECT_TRUE(std::isfinite(glm::length(varied[role])));
    }
  }
  EXPECT_GE(clips.size(), 7u);
}

}  // namespace
}  // namespace etude
