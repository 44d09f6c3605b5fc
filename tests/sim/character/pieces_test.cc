#include "sim/character/pieces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

using enum Role;

TEST(Pieces, ABlobIsAnEllipsoidAboutItsJoint) {
  const BodyPose rest = StandingPose();
  const Piece piece = MakePiece(Blob{.name = "", .joint = kHead, .centre_cm = {1, 2, 3}, .half_cm = {4, 5, 6}}, rest);
  for (const Piece::Vertex& vertex : piece.vertices) {
    const glm::dvec3 unit = (100.0 * (vertex.position - rest[kHead]) - glm::dvec3(1, 2, 3)) / glm::dvec3(4, 5, 6);
    EXPECT_NEAR(glm::length(unit), 1, 1e-12);
    EXPECT_EQ(vertex.joints[0], kHead);
    EXPECT_EQ(vertex.weights[0], 1);
  }
}

TEST(Pieces, ASoleIsFlat) {
  const Blob foot{.name = "",
                  .joint = kLeftAnkle,
                  .centre_cm = {0, 0, 5},
                  .half_cm = {5, 9, 12},
                  .tilt_deg = {0, 0, 0},
                  .sole_cm = 0};
  const Piece piece = MakePiece(foot, StandingPose());
  const auto on_floor = [](const Piece::Vertex& vertex) { return vertex.position.y == 0; };
  EXPECT_GT(std::ranges::count_if(piece.vertices, on_floor), 10);
  for (const Piece::Vertex& vertex : piece.vertices) EXPECT_GE(vertex.position.y, 0);
}

TEST(Pieces, ATubePassesFromBoneToBoneAcrossTheJoint) {
  BodyPose rest;
  rest[kLeftShoulder] = {0, 1, 0};
  rest[kLeftElbow] = {0, 0.7, 0};
  rest[kLeftWrist] = {0, 0.4, 0};
  const Tube tube{.name = "",
                  .chain = {kLeftShoulder, kLeftElbow, kLeftWrist},
                  .rings = {{0, 5, 4}, {20, 5, 4}, {30, 5, 4}, {35, 5, 4}, {50, 5, 4}},
                  .blend_cm = 10,
                  .first_cap_cm = 1,
                  .last_cap_cm = 1};
  int soft = 0;
  for (const Piece::Vertex& vertex : MakePiece(tube, rest).vertices) {
    EXPECT_NEAR(vertex.weights[0] + vertex.weights[1], 1, 1e-15);
    const double below_elbow = 0.7 - vertex.position.y;
    if (below_elbow > 0.2) continue;  // belongs to the wrist
    double forearm = 0;
    for (int k = 0; k < 2; ++k) forearm += vertex.joints[k] == kLeftElbow ? vertex.weights[k] : 0;
    const double t = std::clamp((below_elbow + 0.1) / 0.2, 0.0, 1.0);
    EXPECT_NEAR(forearm, 3 * t * t - 2 * t * t * t, 1e-9);
    soft += forearm > 0.01 && forearm < 0.99 ? 1 : 0;
  }
  EXPECT_EQ(soft, 2 * 16) << "the rings at the elbow and 5 cm below it";
}

TEST(Pieces, AMirrorImageOfAMirrorImageIsThePiece) {
  const Piece arm =
      MakePiece(Blob{.name = "", .joint = kLeftWrist, .centre_cm = {1, 2, 3}, .half_cm = {4, 5, 6}}, StandingPose());
  const Piece mirrored = MirrorImage(arm), twice = MirrorImage(mirrored);
  EXPECT_EQ(twice.triangles, arm.triangles);
  EXPECT_NE(mirrored.triangles, arm.triangles);
  for (std::size_t i = 0; i < arm.vertices.size(); ++i) {
    EXPECT_EQ(twice.vertices[i].position, arm.vertices[i].position);
    EXPECT_EQ(mirrored.vertices[i].position.x, -arm.vertices[i].position.x);
    EXPECT_EQ(mirrored.vertices[i].joints[0], kRightWrist);
  }
}

}  // namespace
}  // namespace etude
