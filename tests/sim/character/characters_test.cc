#include "sim/character/characters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "engine/base/digest.h"
#include "engine/retargeting/rig.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/move.h"
#include "tests/support/results.h"

namespace etude {
namespace {

std::vector<GlobalTransform> GlobalsAt(const Character& character, const BodyPose& pose) {
  std::vector<GlobalTransform> globals;
  ComputeGlobals(character.skeleton, PoseRig(pose, StandingPose()), globals);
  return globals;
}

/// Returns for each vertex the number of its connected piece.
std::vector<std::size_t> PieceOfVertex(const SkinnedMesh& mesh) {
  std::vector<std::size_t> piece(mesh.vertices.size());
  for (std::size_t i = 0; i < piece.size(); ++i) piece[i] = i;
  const auto root = [&](std::size_t i) {
    while (piece[i] != i) i = piece[i];
    return i;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    piece[root(b)] = root(a);
    piece[root(c)] = root(a);
  }
  for (std::size_t i = 0; i < piece.size(); ++i) piece[i] = root(i);
  return piece;
}

/// The smallest and largest stretch of edges of at least a centimetre.
struct Stretch {
  double least = 1, most = 1;
};
Stretch StretchOf(const SkinnedMesh& mesh, const std::vector<GlobalTransform>& globals) {
  Stretch stretch;
  const DeformedMesh deformed = Deform(mesh, globals);
  for (const auto& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
      const double rest = glm::distance(mesh.vertices[a].position, mesh.vertices[b].position);
      if (rest < 0.01) continue;
      const double factor = glm::distance(deformed.positions[a], deformed.positions[b]) / rest;
      stretch = {std::min(stretch.least, factor), std::max(stretch.most, factor)};
    }
  }
  return stretch;
}

class Figures : public ::testing::TestWithParam<Character (*)()> {
 protected:
  const Character character_ = GetParam()();
};

TEST_P(Figures, AreBoundToTheStandingBody) {
  const Skeleton expected = BodySkeleton(StandingPose());
  ASSERT_EQ(character_.skeleton.joints.size(), expected.joints.size());
  for (std::size_t i = 0; i < expected.joints.size(); ++i) {
    EXPECT_EQ(character_.skeleton.joints[i].name, expected.joints[i].name);
    EXPECT_EQ(character_.skeleton.joints[i].rest, expected.joints[i].rest);
  }
  const std::vector<GlobalTransform> globals = GlobalsAt(character_, StandingPose());
  for (const SkinnedMesh& mesh : character_.meshes) {
    const DeformedMesh deformed = Deform(mesh, globals);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      EXPECT_LT(glm::distance(deformed.positions[i], mesh.vertices[i].position), 1e-12);
      EXPECT_LT(glm::distance(deformed.normals[i], mesh.vertices[i].normal), 1e-12);
    }
  }
}

TEST_P(Figures, HaveWellFormedMeshes) {
  std::size_t triangles = 0;
  for (const SkinnedMesh& mesh : character_.meshes) {
    ASSERT_LT(static_cast<std::size_t>(mesh.material), character_.materials.size());
    for (const SkinnedMesh::Vertex& vertex : mesh.vertices) {
      double sum = 0;
      for (std::size_t k = 0; k < vertex.weights.size(); ++k) {
        EXPECT_GE(vertex.weights[k], 0);
        ASSERT_LT(static_cast<std::size_t>(vertex.bindings[k]), mesh.bindings.size());
        sum += vertex.weights[k];
      }
      EXPECT_NEAR(sum, 1, 1e-12);
      EXPECT_NEAR(glm::length(vertex.normal), 1, 1e-12);
    }
    for (const auto& [a, b, c] : mesh.triangles) {
      const glm::dvec3 at = mesh.vertices[a].position;
      const glm::dvec3 across = glm::cross(mesh.vertices[b].position - at, mesh.vertices[c].position - at);
      EXPECT_GT(0.5 * glm::length(across), 1e-7) << "a triangle of less than 0.1 mm² in " << mesh.name;
    }
    triangles += mesh.triangles.size();
  }
  EXPECT_GT(triangles, 1500u);
  EXPECT_LT(triangles, 6000u);
}

TEST_P(Figures, AreMadeOfClosedPiecesSeenFromOutside) {
  for (const SkinnedMesh& mesh : character_.meshes) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    std::map<std::size_t, double> volumes;
    const std::vector<std::size_t> piece = PieceOfVertex(mesh);
    for (const auto& triangle : mesh.triangles) {
      for (int i = 0; i < 3; ++i) ++edges[{triangle[i], triangle[(i + 1) % 3]}];
      const auto& [a, b, c] = triangle;
      volumes[piece[a]] +=
          glm::dot(mesh.vertices[a].position, glm::cross(mesh.vertices[b].position, mesh.vertices[c].position)) / 6;
    }
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      EXPECT_TRUE(edges.contains({edge.second, edge.first})) << "a hole in " << mesh.name;
    }
    for (const auto& [first, volume] : volumes) EXPECT_GT(volume, 1e-8) << mesh.name << " at vertex " << first;
  }
}

TEST_P(Figures, StandOnTheFloorAsTallAsAnAdult) {
  double lowest = std::numeric_limits<double>::infinity(), highest = 0;
  for (const SkinnedMesh& mesh : character_.meshes) {
    for (const SkinnedMesh::Vertex& vertex : mesh.vertices) {
      lowest = std::min(lowest, vertex.position.y);
      highest = std::max(highest, vertex.position.y);
    }
  }
  EXPECT_NEAR(lowest, 0, 0.01);
  EXPECT_GT(highest, 1.5);
  EXPECT_LT(highest, 2.0);
}

TEST_P(Figures, AreTheirOwnMirrorImages) {
  for (const SkinnedMesh& mesh : character_.meshes) {
    for (const SkinnedMesh::Vertex& vertex : mesh.vertices) {
      const glm::dvec3 there = vertex.position * glm::dvec3(-1, 1, 1);
      const auto is_image = [&](const SkinnedMesh::Vertex& other) {
        const int mirrored = static_cast<int>(Index(Mirrored(static_cast<Role>(vertex.bindings[0]))));
        return glm::distance(other.position, there) < 1e-9 && other.bindings[0] == mirrored &&
               std::abs(other.weights[0] - vertex.weights[0]) < 1e-9;
      };
      EXPECT_TRUE(std::ranges::any_of(mesh.vertices, is_image)) << mesh.name;
    }
  }
}

TEST_P(Figures, NeitherTearNorCollapseInAnyMoveOrAct) {
  Stretch worst;
  std::vector<std::string> names = BuiltinMoveNames();
  std::ranges::copy(BuiltinActNames(), std::back_inserter(names));
  ASSERT_GT(names.size(), 15u);
  for (const std::string& name : names) {
    ASSERT_OK(move, LoadBuiltinMove(name));
    for (std::size_t frame = 0; frame < move->motion.poses.size(); frame += 3) {
      const std::vector<GlobalTransform> globals = GlobalsAt(character_, move->motion.poses[frame]);
      for (const SkinnedMesh& mesh : character_.meshes) {
        const Stretch stretch = StretchOf(mesh, globals);
        worst = {std::min(worst.least, stretch.least), std::max(worst.most, stretch.most)};
      }
    }
  }
  EXPECT_GT(worst.least, 0.1);
  EXPECT_LT(worst.most, 2.0);
  RecordProperty("stretch", std::to_string(worst.least) + " … " + std::to_string(worst.most));
}

INSTANTIATE_TEST_SUITE_P(Both, Figures, ::testing::Values(&BearCharacter, &MannequinCharacter),
                         [](const auto& each) { return each.param().name; });

TEST(FiguresStretch, IsSeenWhereSkinTears) {
  Character bear = BearCharacter();
  SkinnedMesh& fur = bear.meshes[0];
  fur.vertices[5].bindings[0] = static_cast<int>(Index(Role::kLeftWrist));
  fur.vertices[5].weights = {1, 0, 0, 0};
  ASSERT_OK(move, LoadBuiltinMove("stretch"));
  double most = 0;
  for (const BodyPose& pose : move->motion.poses) most = std::max(most, StretchOf(fur, GlobalsAt(bear, pose)).most);
  EXPECT_GT(most, 3);
}

/// Returns a digest of positions rounded to micrometres, which hides a library's last bits.
std::string DigestOf(const Character& character) {
  const auto micro = [](double value) { return static_cast<std::int64_t>(std::llround(1e6 * value)); };
  Digest digest;
  for (const SkinnedMesh& mesh : character.meshes) {
    for (const SkinnedMesh::Vertex& vertex : mesh.vertices) {
      for (int i = 0; i < 3; ++i) digest.Add(micro(vertex.position[i])).Add(micro(vertex.normal[i]));
      for (std::size_t k = 0; k < vertex.weights.size(); ++k) {
        digest.Add(std::int64_t{vertex.bindings[k]}).Add(micro(vertex.weights[k]));
      }
    }
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) digest.Add(std::int64_t{corner});
    }
  }
  return digest.Hex();
}

TEST(FiguresDigest, IsTheSameEverywhere) {
  EXPECT_EQ(DigestOf(BearCharacter()), "7d8e11364730c60c");
  EXPECT_EQ(DigestOf(MannequinCharacter()), "17504d3c26b29240");
}

}  // namespace
}  // namespace etude
