#include "engine/cameras/triangulation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/engine/cameras/camera_at.h"
#include "tests/support/results.h"

namespace etude {
namespace {

Sighting SightingOf(const ProjectionMatrix& matrix, const glm::dvec3& point) {
  return {matrix, *Project(matrix, point)};
}

TEST(Triangulation, FindsThePointThatTwoOrMoreCamerasSee) {
  const glm::dvec3 point(0.4, 1.3, -0.6);
  std::vector<Sighting> sightings;
  for (double degrees : {-40.0, 40.0, 95.0, 170.0}) {
    sightings.push_back(SightingOf(CameraAt(degrees), point));
    if (sightings.size() < 2) continue;
    const TriangulatedPoint found = Triangulate(sightings);
    ASSERT_EQ(found.status, PointStatus::kOk);
    EXPECT_LT(glm::distance(found.position, point), 1e-9);
    EXPECT_LT(found.residual_px, 1e-6);
  }
}

TEST(Triangulation, SplitsADisagreementEvenlyBetweenEqualCameras) {
  // One camera sees the point 2 px too low, the other one 2 px too high. These errors cancel, so the triangulated point
  // stays in place, and its residual is 2 px in each picture.
  const glm::dvec3 point(0, 0.9, 0);
  Sighting left = SightingOf(CameraAt(-40), point), right = SightingOf(CameraAt(40), point);
  left.pixel.y += 2;
  right.pixel.y -= 2;
  const TriangulatedPoint found = Triangulate(std::vector{left, right});
  ASSERT_EQ(found.status, PointStatus::kOk);
  EXPECT_LT(glm::distance(found.position, point), 2e-3);
  EXPECT_NEAR(found.residual_px, 2, 0.02);
}

TEST(Triangulation, DoesNotDependOnTheScaleOfH) {
  const glm::dvec3 point(0.2, 0.5, 0.3);
  Sighting left = SightingOf(CameraAt(-40), point), right = SightingOf(CameraAt(40), point);
  left.pixel += glm::dvec2(3, -1);
  const glm::dvec3 before = Triangulate(std::vector{left, right}).position;
  for (auto& row : left.matrix.h) {
    for (double& entry : row) entry *= 1000;
  }
  EXPECT_LT(glm::distance(Triangulate(std::vector{left, right}).position, before), 1e-9);
}

TEST(Triangulation, SaysWhenOneCameraIsNotEnough) {
  EXPECT_EQ(Triangulate({}).status, PointStatus::kTooFewViews);
  EXPECT_EQ(Triangulate(std::vector{SightingOf(CameraAt(0), {0, 1, 0})}).status, PointStatus::kTooFewViews);
}

TEST(Triangulation, RefusesAPointBehindACamera) {
  // Diverging rays meet behind both cameras: two cameras half a metre apart look outwards.
  const ProjectionMatrix left = MatrixOf(LookAt({}, {-0.25, 1, 0}, {-1.25, 1, -4}));
  const ProjectionMatrix right = MatrixOf(LookAt({}, {0.25, 1, 0}, {1.25, 1, -4}));
  const TriangulatedPoint found = Triangulate(std::vector<Sighting>{{left, {320, 240}}, {right, {320, 240}}});
  EXPECT_EQ(found.status, PointStatus::kIllConditioned);
  const glm::dvec3 before(0, 1, -3);
  EXPECT_EQ(Triangulate(std::vector{SightingOf(left, before), SightingOf(right, before)}).status, PointStatus::kOk)
      << "the control: the same cameras, a point before them";
}

TEST(Triangulation, NeedsMoreThanAHundredthOfADegreeBetweenItsRays) {
  const glm::dvec3 point(0, 1, 0);
  auto status_at = [&](double degrees) {
    return Triangulate(std::vector{SightingOf(CameraAt(0), point), SightingOf(CameraAt(degrees), point)}).status;
  };
  EXPECT_EQ(status_at(0.01), PointStatus::kIllConditioned);
  EXPECT_EQ(status_at(1), PointStatus::kOk);
}

TEST(Triangulation, SaysWhenTheRaysAreParallelOrNotFinite) {
  const glm::dvec3 point(0.1, 1, 0);
  const Sighting once = SightingOf(CameraAt(20), point);
  EXPECT_EQ(Triangulate(std::vector{once, once}).status, PointStatus::kIllConditioned);
  Sighting broken = SightingOf(CameraAt(-20), point);
  broken.pixel.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Triangulate(std::vector{once, broken}).status, PointStatus::kIllConditioned);
}

/// Three, five and eight cameras with different poses, focal lengths and scales of H; pixel errors have deviation 2.
struct Vector {
  std::vector<Sighting> sightings;
  glm::dvec3 alike, by_pixels;
};

// The expected points, computed by numpy: `alike` by lstsq with each row divided by |h₃|, and `by_pixels` by three more
// lstsq with each row divided by the point's depth.
const std::vector<Vector> kVectors = {
    {{
         {{{{{-948.087947, -514.157818, -1837.001172, 5065.350543}, {-266.023824, -1922.68834, -41.779107, 5182.375886}, {-3.771323, -1.606743, -0.592287, 15.82922}}}}, {285.786, 167.792}},
         {{{{{-1326.204681, -29.550838, -1268.168188, 2640.570854}, {-539.933192, -1653.340599, 186.880763, 3448.487864}, {-2.476084, -0.092346, 0.857018, 8.251784}}}}, {260.155, 104.312}},
         {{{{{412.378852, -102.835674, 396.878958, 1567.934839}, {54.25306, -541.213417, -14.9013, 1593.629125}, {0.881532, -0.321361, -0.242124, 4.899796}}}}, {350.565, 170.266}},
     },
     {0.108314169683994, 1.56426590195031, 0.270300746977416},
     {0.109561818279375, 1.56642090819275, 0.273227829604447}},
    {{
         {{{{{999.675588, -61.190315, 65.884998, 2080.71637}, {102.421415, -937.387781, -178.696085, 2362.882818}, {0.683666, -0.19122, -1.192803, 6.502239}}}}, {257.653, 224.322}},
         {{{{{643.069827, -160.830366, 2044.711915, 3924.431759}, {742.818694, -1789.95246, 283.186095, 4445.720536}, {3.88144, -0.502595, 1.479728, 12.263849}}}}, {341.566, 228.495}},
         {{{{{2759.922922, -367.210021, 1011.959389, 5434.50307}, {22.821489, -2853.319124, -24.404282, 6395.99775}, {2.446003, -1.147531, -2.615646, 16.982822}}}}, {250.492, 236.982}},
         {{{{{-330.68818, -9.098596, 171.089772, 859.945413}, {4.69503, -344.885769, 96.065422, 949.214699}, {0.023606, -0.028433, 0.482996, 2.687329}}}}, {379.629, 226.052}},
         {{{{{798.42453, -65.978691, -2751.521051, 5179.822509}, {-439.382061, -2739.788096, -318.388063, 6306.140552}, {-2.449458, -0.206183, -1.774943, 16.186945}}}}, {280.167, 217.249}},
     },
     {-0.471491531522303, 1.01890607773545, -0.0342059832401558},
     {-0.471248810367389, 1.01957708873574, -0.0387712010630876}},
    {{
         {{{{{-321.400114, 22.524971, -1112.449521, 1405.282268}, {-356.652718, -1070.326604, -23.419851, 2032.46}, {-1.227364, 0.070391, -0.080596, 4.391507}}}}, {336.782, 339.048}},
         {{{{{3815.703865, 44.564628, 1705.457125, 7008.008639}, {889.448828, -3860.223235, -879.191983, 8760.288515}, {3.366588, 0.139264, -3.327766, 21.900027}}}}, {333.308, 306.624}},
         {{{{{201.128592, -158.801175, -755.651166, 1210.984006}, {86.275992, -757.521729, 66.524056, 1482.816767}, {-0.747719, -0.496254, -0.576537, 3.784325}}}}, {352.323, 322.019}},
         {{{{{-128.572182, -14.634237, 194.445442, 445.495871}, {28.58662, -208.443557, 61.053806, 511.842995}, {0.161107, -0.045732, 0.344083, 1.392175}}}}, {293.208, 296.76}},
         {{{{{-605.476598, -202.079184, 817.574248, 2386.769043}, {56.455644, -928.664279, 182.958779, 2489.471184}, {0.555337, -0.631497, 1.799709, 7.458653}}}}, {299.278, 279.214}},
         {{{{{3130.089019, -137.774733, -772.750398, 6660.440951}, {156.465961, -2994.589883, -747.224833, 7597.463663}, {0.895291, -0.430546, -4.275588, 20.813878}}}}, {340.53, 290.994}},
         {{{{{-132.74096, -267.78983, 3847.401325, 5324.518029}, {385.775962, -3712.228462, 170.739966, 7153.636002}, {4.102806, -0.836843, 1.815854, 16.639119}}}}, {294.295, 313.746}},
         {{{{{1012.559907, -167.454849, -720.655642, 3800.024304}, {-8.797072, -1131.634, -270.252849, 3755.456805}, {-0.06988, -0.523296, -2.146774, 11.875076}}}}, {337.692, 272.631}},
     },
     {0.17496752457594, 0.514361730292423, -0.0565710434039559},
     {0.175496393377904, 0.513803500894785, -0.0557576686260705}}};

TEST(TriangulationOfMany, AgreesWithNumpy) {
  for (const Vector& vector : kVectors) {
    const TriangulatedPoint alike = Triangulate(vector.sightings), by_pixels = TriangulateByPixels(vector.sightings);
    ASSERT_EQ(alike.status, PointStatus::kOk);
    ASSERT_EQ(by_pixels.status, PointStatus::kOk);
    EXPECT_LT(glm::distance(alike.position, vector.alike), 1e-9);
    EXPECT_LT(glm::distance(by_pixels.position, vector.by_pixels), 1e-9);
    EXPECT_GT(glm::distance(vector.alike, vector.by_pixels), 1e-5) << "the control: weights matter";
    EXPECT_LT(by_pixels.residual_px, alike.residual_px);
  }
}

TEST(TriangulationOfMany, OfTwoEquallyFarCamerasIsThatOfTwo) {
  const glm::dvec3 point(0, 0.9, 0);
  std::vector<Sighting> two = {{CameraAt(-40), *Project(CameraAt(-40), point)},
                               {CameraAt(40), *Project(CameraAt(40), point)}};
  two[0].pixel.y += 3;
  EXPECT_LT(glm::distance(Triangulate(two).position, TriangulateByPixels(two).position), 1e-4);
}

const glm::dvec3 kSeen(0.3, 1.2, -0.4);

TEST(EpipolarGeometry, OfOnePointsPixelsTheDistanceIsNothing) {
  ASSERT_OK(geometry, EpipolarGeometry::Of(CameraAt(-30), CameraAt(50)));
  EXPECT_NEAR(geometry->DistancePx(*Project(CameraAt(-30), kSeen), *Project(CameraAt(50), kSeen)), 0, 1e-9);
}

/// A second way: the point nearest to both pixels' rays, and its pixel errors.
TEST(EpipolarGeometry, IsTheResidualOfTriangulationToFirstOrder) {
  const std::array cameras = {CameraAt(-30), CameraAt(50)};
  const auto geometry = EpipolarGeometry::Of(cameras[0], cameras[1]);
  for (const glm::dvec2& off : {glm::dvec2(0, 3), {2, -2}, {-1, 5}}) {
    const std::array<Sighting, 2> sightings = {
        {{cameras[0], *Project(cameras[0], kSeen) + off}, {cameras[1], *Project(cameras[1], kSeen)}}};
    const double residual = TriangulateByPixels(sightings).residual_px;
    EXPECT_NEAR(std::abs(geometry->DistancePx(sightings[0].pixel, sightings[1].pixel)), residual, 0.02 * residual);
    EXPECT_GT(residual, 0.1) << "the control";
  }
}

}  // namespace
}  // namespace etude
