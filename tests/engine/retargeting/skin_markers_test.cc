#include "engine/retargeting/skin_markers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/directions.h"

namespace etude {
namespace {

using enum Role;
using ::testing::HasSubstr;

/// The unit directions of the two parts of a limb that bends about the X axis, which points to the body's left.
struct Bent {
  glm::dvec3 upper, lower;
};
Bent BentBy(double swing, double bend, double sign) {
  // Hanging, swung forward by an angle, then bent forward (arms, sign 1) or backward (legs, −1).
  const auto at = [](double angle) { return glm::dvec3(0, -std::cos(angle), std::sin(angle)); };
  return {at(swing), at(swing + sign * bend)};
}

/// The place of the elbow markers.
enum class ElbowMarker { kOutside, kPoint };

/// Returns the joint centres of a person who walks on the spot.
JointPositions Centres(std::size_t frame) {
  const double t = 0.2 * static_cast<double>(frame);
  JointPositions at;
  for (const double side : {1.0, -1.0}) {
    const auto of = [&](Role role) -> MarkerPosition& { return at[Index(side > 0 ? role : Mirrored(role))]; };
    const Bent arm = BentBy(0.3 * std::sin(t + side), 1.5 + 0.2 * std::sin(t), 1);
    const Bent leg = BentBy(0.3 * std::sin(t - side), 0.5 + 0.4 * std::sin(t), -1);
    of(kLeftShoulder) = glm::dvec3(side * 0.18, 1.4, 0);
    of(kLeftElbow) = *of(kLeftShoulder) + 0.28 * arm.upper;
    of(kLeftWrist) = *of(kLeftElbow) + 0.25 * arm.lower;
    of(kLeftHip) = glm::dvec3(side * 0.09, 0.9, 0);
    of(kLeftKnee) = *of(kLeftHip) + 0.42 * leg.upper;
    of(kLeftAnkle) = *of(kLeftKnee) + 0.41 * leg.lower;
  }
  at[Index(kShoulderCentre)] = glm::dvec3(0, 1.4, 0);
  at[Index(kSpine)] = glm::dvec3(0, 1.15, 0);
  return at;
}

/// Moves joints to their markers; `depths` are the distances of knee, ankle, elbow and shoulder from the centres.
JointPositions OnTheSkin(JointPositions at, const std::array<double, 4>& depths, ElbowMarker elbow) {
  for (const double side : {1.0, -1.0}) {
    const auto of = [&](Role role) -> MarkerPosition& { return at[Index(side > 0 ? role : Mirrored(role))]; };
    const glm::dvec3 outside(side, 0, 0);
    const glm::dvec3 forearm = *of(kLeftWrist) - *of(kLeftElbow);
    const glm::dvec3 upper = *of(kLeftElbow) - *of(kLeftShoulder);
    const glm::dvec3 behind = UnitOr(upper - glm::dot(upper, forearm) / glm::dot(forearm, forearm) * forearm, {});
    *of(kLeftElbow) += depths[2] * (elbow == ElbowMarker::kOutside ? outside : behind);
    *of(kLeftKnee) += depths[0] * outside;
    *of(kLeftAnkle) += depths[1] * outside;
    *of(kLeftShoulder) += glm::dvec3(0, depths[3], 0);
  }
  return at;
}

const MarkerSet& Gait() { return MarkerSets().back(); }

constexpr std::size_t kSkinFrames = 40;
constexpr std::array kSkinRoles = {kLeftShoulder,  kLeftElbow,  kLeftKnee,  kLeftAnkle,
                                   kRightShoulder, kRightElbow, kRightKnee, kRightAnkle};

struct MovedMarkers {
  std::string said;
  double worst = 0;
};
MovedMarkers MovedFrom(const std::array<double, 4>& depths, ElbowMarker elbow,
                       const std::map<std::string, double>& sizes) {
  std::vector<JointPositions> frames;
  for (std::size_t t = 0; t < kSkinFrames; ++t) frames.push_back(OnTheSkin(Centres(t), depths, elbow));
  MovedMarkers moved{.said = MoveToJointCentres(Gait(), sizes, std::vector<Wands>(kSkinFrames), frames)};
  for (std::size_t t = 0; t < kSkinFrames; ++t) {
    const JointPositions wanted = Centres(t);
    for (const Role role : kSkinRoles) {
      moved.worst = std::max(moved.worst, glm::distance(*frames[t][Index(role)], *wanted[Index(role)]));
    }
  }
  return moved;
}

TEST(SkinMarkers, AreMovedToTheCentresByTheFilesWidths) {
  const std::map<std::string, double> sizes = {
      {"LKNEEWIDTH", .12},      {"RKNEEWIDTH", .12},      {"LANKLEWIDTH", .08},
      {"RANKLEWIDTH", .08},     {"LELBOWWIDTH", .07},     {"RELBOWWIDTH", .07},
      {"LSHOULDEROFFSET", .05}, {"RSHOULDEROFFSET", .05}, {"MARKERDIAMETER", .02}};
  const MovedMarkers moved = MovedFrom({.07, .05, .045, .06}, ElbowMarker::kOutside, sizes);
  EXPECT_LT(moved.worst, 0.016);
  EXPECT_EQ(moved.said,
            "Etude placed joint centres under the skin, at these distances from the markers in cm: knees 7.0, ankles "
            "5.0, elbows 4.5, shoulders 6.0 by the file's widths");
}

TEST(SkinMarkers, AreMovedByTheLimbsLengthsWithoutWidths) {
  const MovedMarkers moved = MovedFrom({.05, .035, .045, .045}, ElbowMarker::kOutside, {});
  EXPECT_LT(moved.worst, 0.016);
  EXPECT_THAT(moved.said, HasSubstr("by the lengths of the limbs"));
  EXPECT_THAT(moved.said, ::testing::Not(HasSubstr("point")));
}

TEST(SkinMarkers, OnTheElbowsPointAreToldByUpperArmsThatKeepTheirLength) {
  const MovedMarkers moved = MovedFrom({.05, .035, .045, .045}, ElbowMarker::kPoint, {});
  EXPECT_LT(moved.worst, 0.016);
  EXPECT_THAT(moved.said, HasSubstr("Etude assumes that the elbow markers are on the point of the elbow"));
}

TEST(SkinMarkers, OfALimbWithAGapAreNotSeenRatherThanLeftOnTheSkin) {
  const std::array<double, 4> depths = {0.067, 0.047, 0.042, 0.047};
  const auto moved = [&](std::initializer_list<Role> lost, std::size_t from, std::size_t to) {
    std::vector<JointPositions> frames;
    for (std::size_t t = 0; t < kSkinFrames; ++t) {
      frames.push_back(OnTheSkin(Centres(t), depths, ElbowMarker::kOutside));
      for (const Role role : lost) {
        if (t >= from && t < to) frames.back()[Index(role)].reset();
      }
    }
    MoveToJointCentres(Gait(), {{"MARKERDIAMETER", .014}}, std::vector<Wands>(kSkinFrames), frames);
    return frames;
  };
  const auto whole = moved({}, 0, 0), gap = moved({kLeftShoulder, kLeftAnkle}, 10, 15);
  for (std::size_t t = 0; t < kSkinFrames; ++t) {
    const bool is_gap = t >= 10 && t < 15;
    // Both elbows need both shoulders; the right leg needs nothing of the left ankle.
    for (const Role role : {kLeftElbow, kRightElbow, kLeftKnee})
      EXPECT_NE(gap[t][Index(role)].has_value(), is_gap) << t;
    for (const Role role : {kRightKnee, kRightAnkle, kRightWrist}) EXPECT_TRUE(gap[t][Index(role)]) << t;
    for (const Role role : {kLeftElbow, kRightElbow, kLeftKnee}) {
      if (is_gap) continue;
      EXPECT_LT(glm::distance(*gap[t][Index(role)], *whole[t][Index(role)]), 0.004) << t;
    }
  }
  // A file without wrists keeps its elbow markers.
  const auto handless = moved({kLeftWrist, kRightWrist}, 0, kSkinFrames);
  for (std::size_t t = 0; t < kSkinFrames; ++t) EXPECT_TRUE(handless[t][Index(kLeftElbow)]);
}

TEST(SkinMarkers, FollowTheWandsOfThighsAndShanks) {
  // The straight legs are turned outward by 45°, so that only wands show the knee axes.
  std::vector<JointPositions> frames(10);
  std::vector<Wands> wands(10);
  const glm::dvec3 outside[] = {{std::sqrt(.5), 0, -std::sqrt(.5)}, {-std::sqrt(.5), 0, -std::sqrt(.5)}};
  for (std::size_t t = 0; t < frames.size(); ++t) {
    frames[t] = Centres(0);
    for (const std::size_t side : {0, 1}) {
      const auto of = [&](Role role) -> MarkerPosition& { return frames[t][Index(side == 0 ? role : Mirrored(role))]; };
      const double x = side == 0 ? 0.09 : -0.09;
      of(kLeftKnee) = glm::dvec3(x, 0.48, 0) + 0.05 * outside[side];
      of(kLeftAnkle) = glm::dvec3(x, 0.07, 0) + 0.035 * outside[side];
      wands[t].thigh[side] = glm::dvec3(x, 0.7, 0) + 0.12 * outside[side];
      wands[t].shank[side] = glm::dvec3(x, 0.3, 0) + 0.12 * outside[side];
    }
  }
  MoveToJointCentres(Gait(), {}, wands, frames);
  for (const auto& [role, x, y] : {std::tuple(kLeftKnee, .09, .48), {kRightKnee, -.09, .48}, {kLeftAnkle, .09, .07}}) {
    EXPECT_LT(glm::distance(*frames[0][Index(role)], glm::dvec3(x, y, 0)), 0.002) << RoleName(role);
  }
}

}  // namespace
}  // namespace etude
