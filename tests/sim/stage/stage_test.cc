#include "sim/stage/stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/body/shape.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/move.h"
#include "sim/render/renderer.h"
#include "sim/stage/palette.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

const std::vector<double> kScenes = {0.05, 0.25, 0.5, 0.75, 1.0};

std::vector<Camera> Cameras() {
  return {LookAt({}, {-2.4, 1.0, 2.9}, {0, 0.95, 0}), LookAt({}, {2.4, 2.2, 2.9}, {0, 0.95, 0})};
}

std::vector<Camera> SmallCameras() {
  std::vector<Camera> cameras = Cameras();
  for (Camera& camera : cameras) {
    camera.intrinsics = {.width = 320, .height = 240, .fx = 300, .fy = 300, .cx = 160, .cy = 120};
  }
  return cameras;
}

StagedRoom MakeStage(std::uint64_t seed, double scene) {
  const std::vector<BodyPose> poses = {StandingPose()};
  return StagedRoom({.seed = seed, .scene = scene}, poses, Cameras());
}

bool SamePlace(const FurnitureBox& a, const FurnitureBox& b) {
  return a.centre == b.centre && a.half_size == b.half_size && a.heading == b.heading;
}

bool SamePlace(const WallPicture& a, const WallPicture& b) {
  return a.wall == b.wall && a.centre == b.centre && a.half_size == b.half_size;
}

template <typename Thing>
std::size_t CountMissing(const std::vector<Thing>& fewer, const std::vector<Thing>& more) {
  return static_cast<std::size_t>(std::ranges::count_if(fewer, [&](const Thing& thing) {
    return std::ranges::none_of(more, [&](const Thing& other) { return SamePlace(thing, other); });
  }));
}

TEST(StagedRoom, IsTheStudioAtZero) {
  const StagedRoom stage = MakeStage(1, 0);
  EXPECT_EQ(stage.interior(), nullptr);
  EXPECT_TRUE(stage.MoversAt(1.0).empty());
  EXPECT_EQ(stage.FlickerAt(0.3), 1);
  const PartColours colours = PerformerColours();
  const Figure figure = stage.PerformerAt(StandingPose(), colours);
  EXPECT_EQ(figure.shape.size(), BodyCapsules(StandingPose()).size());
  EXPECT_EQ(figure.colours, colours);
  EXPECT_TRUE(figure.surfaces.empty());
}

TEST(StagedRoom, WhatIsThereStaysThereAsTheSceneGrows) {
  std::size_t least = 0, most = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    for (std::size_t i = 0; i + 1 < kScenes.size(); ++i) {
      const StagedRoom fewer = MakeStage(seed, kScenes[i]), more = MakeStage(seed, kScenes[i + 1]);
      EXPECT_EQ(CountMissing(fewer.interior()->furniture, more.interior()->furniture), 0u) << seed;
      EXPECT_EQ(CountMissing(fewer.interior()->pictures, more.interior()->pictures), 0u) << seed;
      EXPECT_LE(fewer.MoversAt(2).size(), more.MoversAt(2).size());
      EXPECT_EQ(fewer.interior()->low, more.interior()->low);
      EXPECT_EQ(fewer.interior()->high, more.interior()->high);
    }
    least += MakeStage(seed, kScenes.front()).interior()->furniture.size();
    most += MakeStage(seed, 1).interior()->furniture.size();
    EXPECT_LE(MakeStage(seed, 1).interior()->furniture.size(), kMaxFurnitureBoxes);
    EXPECT_LE(MakeStage(seed, 1).interior()->pictures.size(), kMaxWallPictures);
  }
  EXPECT_EQ(least, 0u);
  EXPECT_GT(most, 12u * 20);
  // The control: another seed gives other furniture.
  EXPECT_GT(CountMissing(MakeStage(1, 1).interior()->furniture, MakeStage(2, 1).interior()->furniture), 10u);
}

TEST(StagedRoom, DiceDoNotDependOnTheScene) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const StagedRoom some = MakeStage(seed, 0.9), all = MakeStage(seed, 1);
    // Shapes, patterns and the lengths of sleeves and skirts are equal; only colours differ.
    ASSERT_EQ(some.interior()->wall.pattern, all.interior()->wall.pattern);
    ASSERT_EQ(some.interior()->floor.size, all.interior()->floor.size);
    const auto a = some.BystanderAt(1.5), b = all.BystanderAt(1.5);
    ASSERT_EQ(a.has_value(), b.has_value());
    const Outfit one = MakeOutfit(seed, "performer", Wardrobe::kStudio, 0.2);
    const Outfit other = MakeOutfit(seed, "performer", Wardrobe::kStudio, 0.9);
    EXPECT_EQ(one.build, other.build);
    EXPECT_EQ(one.sleeve_cm, other.sleeve_cm);
    EXPECT_EQ(one.skirt_cm, other.skirt_cm);
    EXPECT_EQ(one.top.pattern, other.top.pattern);
    EXPECT_EQ(one.top.patch, other.top.patch);
    EXPECT_NE(one.top.first, other.top.first);
  }
}

TEST(StagedRoom, ColoursLeaveTheStudioByDegrees) {
  const auto distance = [](const Rgb8& a, const Rgb8& b) {
    return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
  };
  double nearly = 0, fully = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Rgb8 studio = MakeOutfit(seed, "performer", Wardrobe::kStudio, 0).top.first;
    EXPECT_LT(distance(studio, {230, 92, 66}), 4);
    nearly += distance(studio, MakeOutfit(seed, "performer", Wardrobe::kStudio, 0.02).top.first);
    fully += distance(studio, MakeOutfit(seed, "performer", Wardrobe::kStudio, 1).top.first);
  }
  EXPECT_LT(nearly, fully / 8);
}

TEST(StagedRoom, FurnitureLeavesThePerformersFloorFree) {
  std::size_t checked = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const StagedRoom stage = MakeStage(seed, 1);
    for (const FurnitureBox& box : stage.interior()->furniture) {
      const double reach = std::max(box.half_size.x, box.half_size.z);
      for (const glm::dvec3& joint : StandingPose().joints) {
        EXPECT_GT(std::max(std::abs(box.centre.x - joint.x), std::abs(box.centre.z - joint.z)), reach) << seed;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 1000u);
}

double HueApart(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

TEST(CodedSuit, HasAHueForEveryLimbFarFromItsNeighboursAndTheStudio) {
  using enum Part;
  const PartColours suit = CodedSuit();
  const auto hue = [&](Part part) { return ToHsv(suit[static_cast<std::size_t>(part)]).hue; };
  constexpr auto kLast = static_cast<std::uint32_t>(kRightFoot);
  int pairs = 0;
  for (std::uint32_t a = kFirstBodyPart; a <= kLast; ++a) {
    const double own = hue(static_cast<Part>(a));
    EXPECT_GT(HueApart(own, 190), 40 + 19) << "the studio's hues are 150 to 230 degrees";
    EXPECT_GT(ToHsv(suit[a]).saturation, 0.98) << "furnished rooms have none above 0.62";
    for (std::uint32_t b = kFirstBodyPart; b < a; ++b, ++pairs) {
      EXPECT_GT(HueApart(own, hue(static_cast<Part>(b))), 18) << a << ", " << b;
    }
  }
  EXPECT_EQ(pairs, 14 * 13 / 2);
  const std::array<std::array<Part, 2>, 13> joined = {{{kTrunk, kHead},
                                                       {kTrunk, kLeftUpperArm},
                                                       {kLeftUpperArm, kLeftForearm},
                                                       {kLeftForearm, kLeftHand},
                                                       {kTrunk, kRightUpperArm},
                                                       {kRightUpperArm, kRightForearm},
                                                       {kRightForearm, kRightHand},
                                                       {kTrunk, kLeftThigh},
                                                       {kLeftThigh, kLeftShank},
                                                       {kLeftShank, kLeftFoot},
                                                       {kTrunk, kRightThigh},
                                                       {kRightThigh, kRightShank},
                                                       {kRightShank, kRightFoot}}};
  for (const auto& [a, b] : joined) EXPECT_GT(HueApart(hue(a), hue(b)), 91);
  for (const auto& [left, right] : {std::pair{kLeftUpperArm, kRightUpperArm}, std::pair{kLeftForearm, kRightForearm},
                                    std::pair{kLeftHand, kRightHand}, std::pair{kLeftThigh, kRightThigh},
                                    std::pair{kLeftShank, kRightShank}, std::pair{kLeftFoot, kRightFoot}}) {
    EXPECT_GT(HueApart(hue(left), hue(right)), 120);
  }
}

TEST(CodedSuit, DoesNotGiveWayAsTheRoomIsFurnished) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Outfit little = MakeOutfit(seed, "performer", Wardrobe::kCoded, 0.1);
    const Outfit much = MakeOutfit(seed, "performer", Wardrobe::kCoded, 1);
    ASSERT_TRUE(little.suit && much.suit);
    EXPECT_EQ(*little.suit, *much.suit);
    EXPECT_FALSE(much.is_skirt || much.has_long_hair);
    EXPECT_EQ(much.build, MakeOutfit(seed, "performer", Wardrobe::kStudio, 1).build) << "the same people";
    EXPECT_FALSE(MakeOutfit(seed, "performer", Wardrobe::kStudio, 1).suit);
  }
}

class RenderedStage : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_OK(shared, SharedRenderer());
    renderer_ = *shared;
  }
  Renderer* renderer_ = nullptr;
};

TEST_F(RenderedStage, NothingButThePerformerIsEverLabelledAsOne) {
  std::array<std::ptrdiff_t, 3> seen{};
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const StagedRoom stage = MakeStage(seed, 1);
    for (const Camera& camera : SmallCameras()) {
      const View view = renderer_->Render({.interior = stage.interior()}, stage.MoversAt(0.7), camera, Targets::kAll);
      EXPECT_EQ(std::ranges::count_if(view.labels.pixels, IsPerformer), 0);
      for (const Part part : {Part::kFurniture, Part::kClutter, Part::kBystander}) {
        seen[static_cast<std::size_t>(part) - 16] +=
            std::ranges::count(view.labels.pixels, static_cast<std::uint32_t>(part));
      }
    }
  }
  for (const std::ptrdiff_t pixels : seen) EXPECT_GT(pixels, 500);
}

TEST_F(RenderedStage, FurnitureIsDrawnWhereRaysMeetItsBoxes) {
  const StagedRoom stage = MakeStage(5, 1);
  std::vector<Cuboid> boxes;
  for (const FurnitureBox& piece : stage.interior()->furniture) {
    boxes.push_back({piece.centre, piece.half_size, piece.heading});
  }
  const Camera camera = Cameras().front();
  const View view = renderer_->Render({.interior = stage.interior()}, {}, camera, Targets::kAll);
  const Intrinsics& in = camera.intrinsics;
  int checked = 0, agree = 0;
  for (int y = 0; y < view.labels.height; y += 5) {
    for (int x = 0; x < view.labels.width; x += 5) {
      if (view.labels.At(x, y) != static_cast<std::uint32_t>(Part::kFurniture)) continue;
      const glm::dvec3 along =
          glm::transpose(camera.R_CW) * glm::dvec3((x + 0.5 - in.cx) / in.fx, (y + 0.5 - in.cy) / in.fy, 1);
      double nearest = 1e9;
      for (const Cuboid& box : boxes) {
        nearest = std::min(nearest, HitDistance(box, camera.p_WC, glm::normalize(along)) / glm::length(along));
      }
      ++checked;
      agree += std::abs(nearest - view.depth.At(x, y)) < 1e-3;
    }
  }
  EXPECT_GT(checked, 500);
  EXPECT_GE(agree, checked - checked / 500) << "but for pixels whose centres are on an edge";
}

// Every pixel of a limb has its paint's chromaticity, in light and shade, for capsules and dressed people, except for
// rounding and a tinted lamp.
TEST_F(RenderedStage, HEAVY_ACodedSuitShowsTheChromaticityOfEachLimb) {
  const PartColours suit = CodedSuit();
  const std::vector<BodyPose> poses = {StandingPose()};
  for (const double scene : {0.0, 0.5, 1.0}) {
    const StagedRoom stage({.seed = 3, .scene = scene, .wardrobe = Wardrobe::kCoded}, poses, Cameras());
    std::array<int, 16> pixels{}, right{};
    for (const Camera& camera : Cameras()) {
      const View view = renderer_->Render({.interior = stage.interior()}, {stage.PerformerAt(StandingPose(), suit)},
                                          camera, Targets::kAll);
      for (std::size_t i = 0; i < view.labels.pixels.size(); ++i) {
        const std::uint32_t part = view.labels.pixels[i];
        if (!IsPerformer(part)) continue;
        const Rgb8 seen = view.colour.pixels[i];
        if (seen.r + seen.g + seen.b < 60) continue;
        ++pixels[part];
        right[part] += HueApart(ToHsv(seen).hue, ToHsv(suit[part]).hue) < 9 && ToHsv(seen).saturation > 0.85;
      }
    }
    for (std::uint32_t part = kFirstBodyPart; part <= static_cast<std::uint32_t>(Part::kRightFoot); ++part) {
      EXPECT_GT(pixels[part], 60) << scene << ", " << part;
      EXPECT_GT(right[part], 0.98 * pixels[part]) << scene << ", " << part;
    }
  }
}

TEST_F(RenderedStage, JointsLieInTheDressedBody) {
  const Camera camera = LookAt({}, {-0.8, 1.3, 4.2}, {0, 0.95, 0});
  int joints = 0, inside = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const DressedPerson person(MakeOutfit(seed, "performer", Wardrobe::kStudio, 1));
    for (const char* name : {"boxing", "stretch", "jump", "side_kick"}) {
      ASSERT_OK(move, LoadBuiltinMove(name));
      const BodyPose pose = move->motion.poses[(seed * 7) % move->motion.poses.size()];
      const Figure figure = person.At(ToOrigin(pose).Apply(pose));
      const View view = renderer_->Render({}, {figure}, camera, Targets::kAll);
      for (const glm::dvec3& joint : ToOrigin(pose).Apply(pose).joints) {
        ASSERT_OK(pixel, Project(MatrixOf(camera), joint));
        ++joints;
        inside += IsPerformer(view.labels.At(static_cast<int>(pixel->x), static_cast<int>(pixel->y)));
      }
    }
  }
  EXPECT_EQ(joints, 800);
  EXPECT_GE(inside, 0.99 * joints);
}

}  // namespace
}  // namespace etude
