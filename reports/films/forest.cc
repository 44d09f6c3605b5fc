#include "reports/films/forest.h"

#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

constexpr Rgb8 kSky{176, 212, 232}, kHills{122, 160, 138}, kMeadow{126, 168, 92}, kTrunk{112, 84, 60};
constexpr std::array<Rgb8, 3> kCrowns = {{{66, 118, 72}, {82, 136, 78}, {52, 100, 68}}};

/// A flat piece, seen from +Z or from above; corners in order.
Surface Sheet(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal, Rgb8 colour) {
  Surface sheet;
  sheet.positions = corners;
  sheet.normals.assign(corners.size(), normal);
  for (std::uint32_t i = 2; i < corners.size(); ++i) sheet.triangles.push_back({0, i - 1, i});
  sheet.parts.assign(sheet.triangles.size(), Part::kClutter);
  sheet.colour = colour;
  return sheet;
}

/// A frustum about the vertical: a trunk, or, with no width at its top, a crown.
Surface Cone(const glm::dvec3& foot, double height, double foot_radius, double top_radius, Rgb8 colour) {
  constexpr int kSides = 10;
  Surface cone;
  const double slope = (foot_radius - top_radius) / height;
  for (int i = 0; i <= kSides; ++i) {
    const double turn = 2 * kPi * i / kSides;
    const glm::dvec3 out(std::cos(turn), 0, std::sin(turn));
    const glm::dvec3 normal = glm::normalize(out + glm::dvec3(0, slope, 0));
    cone.positions.push_back(foot + foot_radius * out);
    cone.positions.push_back(foot + glm::dvec3(0, height, 0) + top_radius * out);
    cone.normals.insert(cone.normals.end(), 2, normal);
  }
  for (std::uint32_t i = 0; i < 2 * kSides; i += 2) {
    cone.triangles.push_back({i, i + 1, i + 2});
    cone.triangles.push_back({i + 1, i + 3, i + 2});
  }
  cone.parts.assign(cone.triangles.size(), Part::kClutter);
  cone.colour = colour;
  return cone;
}

void AddTree(const glm::dvec3& foot, double height, std::size_t kind, Figure& forest) {
  const double trunk = 0.22 * height;
  forest.surfaces.push_back(Cone(foot, 1.2 * trunk, 0.035 * height, 0.025 * height, kTrunk));
  for (int tier = 0; tier < 3; ++tier) {
    const double low = trunk + 0.24 * height * tier, radius = (0.21 - 0.045 * tier) * height;
    forest.surfaces.push_back(Cone(foot + glm::dvec3(0, low, 0), 0.36 * height, radius, 0.0, kCrowns[kind % 3]));
  }
}

}  // namespace

Surface SpotBelow(const BodyPose& pose) {
  constexpr int kCorners = 24;
  constexpr Rgb8 kShade{92, 128, 70};
  const glm::dvec3 left = pose[Role::kLeftAnkle], right = pose[Role::kRightAnkle];
  const glm::dvec3 middle = 0.5 * (left + right);
  const double half = 0.22 + 0.5 * std::abs(left.x - right.x);
  std::vector<glm::dvec3> rim;
  for (int i = 0; i < kCorners; ++i) {
    const double turn = -2 * kPi * i / kCorners;
    rim.push_back({middle.x + half * std::cos(turn), 0.012, middle.z + 0.17 * std::sin(turn)});
  }
  return Sheet(rim, {0, 1, 0}, kShade);
}

Figure ForestFigure() {
  constexpr double kFar = 14, kNear = 8, kBack = kWallZ + 0.02;
  Figure forest;
  forest.surfaces.push_back(
      Sheet({{-kFar, 0, kBack}, {kFar, 0, kBack}, {kFar, 10, kBack}, {-kFar, 10, kBack}}, {0, 0, 1}, kSky));
  const auto hill = [](double x) { return 1.5 + 0.28 * std::sin(0.9 * x + 0.6) + 0.16 * std::sin(2.3 * x); };
  constexpr double kStep = 0.5;
  for (double x = -kFar; x < kFar; x += kStep) {
    const double z = kBack + 0.05, end = x + kStep;
    forest.surfaces.push_back(Sheet({{x, 0, z}, {end, 0, z}, {end, hill(end), z}, {x, hill(x), z}}, {0, 0, 1}, kHills));
  }
  forest.surfaces.push_back(Sheet(
      {{-kFar, 0.004, kNear}, {kFar, 0.004, kNear}, {kFar, 0.004, kBack}, {-kFar, 0.004, kBack}}, {0, 1, 0}, kMeadow));
  // Where trees stand and how high they are: thrown once by hand, the middle left free for the dancers.
  constexpr std::array<glm::dvec3, 12> kTrees = {{{-5.6, 3.0, -2.1},
                                                  {-4.7, 2.3, -1.8},
                                                  {-3.9, 2.9, -2.2},
                                                  {-3.1, 2.2, -1.9},
                                                  {-2.2, 2.7, -2.2},
                                                  {-1.2, 2.0, -2.3},
                                                  {0.2, 2.2, -2.3},
                                                  {1.3, 2.6, -2.2},
                                                  {2.3, 2.1, -2.0},
                                                  {3.2, 2.9, -2.2},
                                                  {4.2, 2.4, -1.8},
                                                  {5.2, 3.1, -2.1}}};  // x, height, z
  for (std::size_t i = 0; i < kTrees.size(); ++i) {
    AddTree({kTrees[i].x, 0, kTrees[i].z}, kTrees[i].y, i, forest);
  }
  return forest;
}

}  // namespace etude
