#include "engine/cameras/camera_parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "engine/base/angles.h"
#include "sim/random/stream.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

std::array<double, 12> Listed(const CameraParameters& p) {
  return {p.focal_length, p.delta_u, p.delta_v, p.principal_u, p.principal_v, p.skew,
          p.omega,        p.phi,     p.kappa,   p.t.x,         p.t.y,         p.t.z};
}

CameraParameters AnyParameters(int seed) {
  RandomStream dice(WorldKey{.suite_seed = 1, .scenario = "parameters", .trial = seed}, "camera");
  return {.focal_length = dice.Uniform(200, 3000),
          .delta_u = dice.Uniform(0.5, 2),
          .delta_v = 1,
          .principal_u = dice.Uniform(0, 2000),
          .principal_v = dice.Uniform(0, 2000),
          .skew = dice.Uniform(Radians(60), Radians(120)),
          .omega = dice.Uniform(-kPi, kPi),
          .phi = dice.Uniform(Radians(-89), Radians(89)),
          .kappa = dice.Uniform(-kPi, kPi),
          .t = {dice.Uniform(-5, 5), dice.Uniform(-5, 5), dice.Uniform(0.1, 9)}};
}

/// A second implementation: K and R as in the header, multiplied out.
ProjectionMatrix PrintedMatrix(const CameraParameters& p) {
  const double K[3][3] = {{p.focal_length / p.delta_u, -p.focal_length / p.delta_u / std::tan(p.skew), p.principal_u},
                          {0, p.focal_length / (p.delta_v * std::sin(p.skew)), p.principal_v},
                          {0, 0, 1}};
  const double so = std::sin(p.omega), co = std::cos(p.omega), sp = std::sin(p.phi), cp = std::cos(p.phi),
               sk = std::sin(p.kappa), ck = std::cos(p.kappa);
  const double X[3][3] = {{1, 0, 0}, {0, co, -so}, {0, so, co}}, Y[3][3] = {{cp, 0, sp}, {0, 1, 0}, {-sp, 0, cp}},
               Z[3][3] = {{ck, -sk, 0}, {sk, ck, 0}, {0, 0, 1}};
  ProjectionMatrix matrix;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      matrix.h[i][j] = 0;
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
          for (int c = 0; c < 3; ++c) matrix.h[i][j] += K[i][a] * X[a][b] * Y[b][c] * Z[c][j];
        }
      }
      matrix.h[i][3] += K[i][j] * p.t[j];
    }
  }
  return matrix;
}

/// Returns the parameters' matrix, scaled so that w is the depth in metres.
ProjectionMatrix Recompose(const CameraParameters& parameters) { return MatrixOf(ToCamera(parameters, 1, 1)); }

TEST(CameraParameters, RecomposeIsThePrintedProduct) {
  for (int seed = 0; seed < 50; ++seed) {
    const CameraParameters p = AnyParameters(seed);
    const ProjectionMatrix ours = Recompose(p), printed = PrintedMatrix(p);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 4; ++j) EXPECT_NEAR(ours.h[i][j], printed.h[i][j], 1e-8) << seed;
    }
  }
}

TEST(CameraParameters, AreTheSameAfterRecomposingAndDecomposing) {
  for (int seed = 0; seed < 200; ++seed) {
    const CameraParameters p = AnyParameters(seed);
    ProjectionMatrix scaled = Recompose(p);
    for (auto& row : scaled.h) {
      for (double& value : row) value *= 7.5;  // a matrix is known up to its scale
    }
    ASSERT_OK(back, Decompose(scaled));
    for (std::size_t i = 0; i < 12; ++i) {
      EXPECT_NEAR(Listed(*back)[i], Listed(p)[i], 1e-9 * std::max(1.0, std::abs(Listed(p)[i]))) << seed << ", " << i;
    }
    const auto of_camera = Listed(ParametersIn(ToCamera(p, 640, 480)));
    for (std::size_t i = 0; i < 12; ++i) {
      EXPECT_NEAR(of_camera[i], Listed(p)[i], 1e-9 * std::max(1.0, std::abs(Listed(p)[i]))) << seed << ", " << i;
    }
  }
}

TEST(CameraParameters, AreFoundWhereTwoAxesOfRotationFallTogether) {
  CameraParameters p = AnyParameters(3);
  p.phi = kPi / 2;
  ASSERT_OK(back, Decompose(Recompose(p)));
  const ProjectionMatrix again = Recompose(*back), wanted = Recompose(p);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) EXPECT_NEAR(again.h[i][j], wanted.h[i][j], 1e-7);
  }
}

TEST(CameraParameters, RefuseWhatIsNoCamera) {
  ProjectionMatrix mirrored = Recompose(AnyParameters(1));
  for (double& value : mirrored.h[0]) value = -value;
  EXPECT_THAT(Decompose(mirrored).error().message, HasSubstr("mirrors the picture"));
  ProjectionMatrix flat = Recompose(AnyParameters(1));
  flat.h[1] = flat.h[2];
  EXPECT_THAT(Decompose(flat).error().message, HasSubstr("one line"));
  for (const auto& [row, other] : {std::pair(0, 2), {0, 1}, {1, 0}}) {
    flat = Recompose(AnyParameters(2));
    flat.h[row] = flat.h[other];
    EXPECT_EQ(Decompose(flat).error().message, "the camera matrix projects all points onto one line") << row;
  }
  ProjectionMatrix far = Recompose(AnyParameters(1));
  far.h[2] = {0, 0, 0, 1};
  EXPECT_THAT(Decompose(far).error().message, HasSubstr("infinity"));
  ProjectionMatrix broken = Recompose(AnyParameters(1));
  broken.h[0][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(Decompose(broken).error().message, HasSubstr("not finite"));
}

}  // namespace
}  // namespace etude
