#include "sim/camera/lens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "sim/body/shape.h"
#include "sim/choreography/canonical_body.h"
#include "sim/render/renderer.h"
#include "tests/sim/camera/shots.h"
#include "tests/support/results.h"

namespace etude {
namespace {

// --- Straight lines (Brown's plumb-line method).

using Curve = std::vector<glm::dvec2>;

/// Paints stripes of 40 pixels, vertical or horizontal; exact pixel coverage gives their edges sub-pixel positions.
Painter Stripes(const CameraModel& model, bool upright) {
  const double middle = upright ? model.pinhole().intrinsics.cx : model.pinhole().intrinsics.cy;
  return [=](int x, int y, double) {
    const double at = (upright ? x : y) - middle + 4000;  // the pixel covers [at, at + 1]
    const double within = std::fmod(at, 80), covered = within < 39   ? 1
                                                       : within < 40 ? 40 - within
                                                       : within < 79 ? 0
                                                                     : within - 79;
    const auto code = CodeTable::Get()(static_cast<float>(0.05 + 0.6 * covered));
    return Rgb8{code, code, code};
  };
}

/// Finds the points at which the brightness along every fourth row (for vertical stripes) or column crosses its
/// middle, and links them to one curve per edge.
std::vector<Curve> FindEdges(const ColourImage& picture, bool upright) {
  constexpr double kMiddle = 0.35;
  const int along = upright ? picture.height : picture.width, across = upright ? picture.width : picture.height;
  const auto light = [&](int s, int t) { return upright ? LightAt(picture, t, s) : LightAt(picture, s, t); };
  std::vector<Curve> edges;
  std::vector<double> tips;
  for (int s = 0; s < along; s += 4) {
    for (int t = 1; t < across; ++t) {
      const double a = light(s, t - 1), b = light(s, t);
      if ((a < kMiddle) == (b < kMiddle)) continue;
      const double place = t - 0.5 + (kMiddle - a) / (b - a);
      const glm::dvec2 point = upright ? glm::dvec2(place, s + 0.5) : glm::dvec2(s + 0.5, place);
      std::size_t nearest = 0;
      while (nearest < tips.size() && std::abs(tips[nearest] - place) > 10) ++nearest;
      if (nearest == tips.size()) tips.push_back(place);
      if (nearest == edges.size()) edges.emplace_back();
      tips[nearest] = place;
      edges[nearest].push_back(point);
    }
  }
  return edges;
}

/// Returns the sum of squared distances of points from their best line.
double Crookedness(const Curve& points) {
  glm::dvec2 mean(0);
  for (const glm::dvec2& p : points) mean += p / static_cast<double>(points.size());
  double xx = 0, xy = 0, yy = 0;
  for (const glm::dvec2& p : points) {
    const glm::dvec2 d = p - mean;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
  }
  return 0.5 * (xx + yy - std::hypot(xx - yy, 2 * xy));
}

/// A second implementation: inverts the formula by fixed-point iteration, where the product uses Newton's method.
glm::dvec2 Straightened(const glm::dvec2& pixel, const Distortion& d) {
  const glm::dvec2 seen((pixel.x - 320) / 600, (pixel.y - 240) / 600);
  glm::dvec2 ray = seen;
  for (int i = 0; i < 60; ++i) {
    const double r2 = ray.x * ray.x + ray.y * ray.y;
    const glm::dvec2 aside(2 * d.p1 * ray.x * ray.y + d.p2 * (r2 + 2 * ray.x * ray.x),
                           d.p1 * (r2 + 2 * ray.y * ray.y) + 2 * d.p2 * ray.x * ray.y);
    ray = (seen - aside) / (1 + d.k1 * r2);
  }
  return 600.0 * ray;
}

/// Finds the k1, p1, p2 that make all edges straightest, by coordinate descent with shrinking steps.
Distortion PlumbLine(const std::vector<Curve>& edges) {
  const auto cost = [&](const Distortion& d) {
    double sum = 0;
    for (const Curve& edge : edges) {
      Curve straight;
      for (const glm::dvec2& point : edge) straight.push_back(Straightened(point, d));
      sum += Crookedness(straight);
    }
    return sum;
  };
  Distortion best;
  double least = cost(best);
  for (double step = 0.02; step > 2e-5;) {
    bool better = false;
    for (double Distortion::*which : {&Distortion::k1, &Distortion::p1, &Distortion::p2}) {
      for (const double sign : {-1.0, 1.0}) {
        Distortion next = best;
        next.*which += sign * step;
        const double now = cost(next);
        if (now >= least) continue;
        least = now;
        best = next;
        better = true;
      }
    }
    if (!better) step /= 2;
  }
  return best;
}

Distortion Recovered(const CameraEffects& effects) {
  CameraModel model = ModelOf(effects);
  std::vector<Curve> edges;
  for (const bool upright : {true, false}) {
    for (Curve& edge : FindEdges(Shoot(model, Stripes(model, upright)), upright)) {
      if (edge.size() > 60) edges.push_back(std::move(edge));
    }
  }
  EXPECT_GE(edges.size(), 20u);
  return PlumbLine(edges);
}

Distortion Set(const CameraEffects& effects) {
  RandomStream random(kShotWorld, "camera/lens");
  return LensDistortion(effects, PlainCamera().intrinsics, random);
}

TEST(Lens, GivesItsDistortionBackByStraightLines) {
  for (const CameraEffects& effects :
       {CameraEffects{.radial_distortion = -0.08, .noise = 0},
        CameraEffects{.radial_distortion = 0.06, .tangential_distortion = 0.01, .noise = 0}}) {
    const Distortion found = Recovered(effects), set = Set(effects);
    EXPECT_NEAR(found.k1, set.k1, 0.02 * std::abs(set.k1));
    EXPECT_NEAR(found.p1, set.p1, 3e-4);
    EXPECT_NEAR(found.p2, set.p2, 3e-4);
  }
}

TEST(Lens, OfAnotherStrengthIsToldApartByStraightLines) {
  const Distortion found = Recovered({.radial_distortion = -0.085, .noise = 0});
  EXPECT_GT(std::abs(found.k1 - Set({.radial_distortion = -0.08}).k1), 0.04 * 0.18);
}

TEST(Lens, MovesTheCornerAsFarAsItsStrengthSays) {
  const Intrinsics in;
  const Distortion d = Set({.radial_distortion = -0.1});
  const glm::dvec2 corner(320.0 / 600, 240.0 / 600);
  EXPECT_NEAR(glm::length(Distort(d, corner)) / glm::length(corner), 0.9, 1e-12);
  const Distortion aside = Set({.tangential_distortion = 0.03});
  EXPECT_NEAR(std::hypot(aside.p1, aside.p2) * 3 * glm::length(corner), 0.03, 1e-12);
  EXPECT_TRUE(Set({}).IsNone());
}

// --- A lens shows points where `Project` says.

/// Paints a chessboard of 0.25 m squares in the plane z = 0; each pixel is the mean of 64 rays.
Painter Board(const CameraModel& model) {
  const Camera pinhole = model.pinhole();
  return [=](int x, int y, double) {
    constexpr int kRays = 8;
    int bright = 0;
    for (int i = 0; i < kRays * kRays; ++i) {
      const double u = x + (i % kRays + 0.5) / kRays, v = y + (i / kRays + 0.5) / kRays;
      const glm::dvec3 ray_C((u - pinhole.intrinsics.cx) / pinhole.intrinsics.fx,
                             (v - pinhole.intrinsics.cy) / pinhole.intrinsics.fy, 1);
      const glm::dvec3 ray = glm::transpose(pinhole.R_CW) * ray_C;
      const glm::dvec3 hit = pinhole.p_WC - ray * (pinhole.p_WC.z / ray.z);
      bright += (static_cast<int>(std::floor(hit.x / 0.25)) + static_cast<int>(std::floor(hit.y / 0.25))) & 1;
    }
    const auto code = CodeTable::Get()(0.05f + 0.7f * static_cast<float>(bright) / (kRays * kRays));
    return Rgb8{code, code, code};
  };
}

double LightBetween(const ColourImage& picture, const glm::dvec2& at) {
  const int x = static_cast<int>(std::floor(at.x - 0.5)), y = static_cast<int>(std::floor(at.y - 0.5));
  const double right = at.x - 0.5 - x, down = at.y - 0.5 - y;
  return (1 - down) * ((1 - right) * LightAt(picture, x, y) + right * LightAt(picture, x + 1, y)) +
         down * ((1 - right) * LightAt(picture, x, y + 1) + right * LightAt(picture, x + 1, y + 1));
}

/// Finds the corner near a place, as the centre about which the board is symmetric under a half turn.
glm::dvec2 FindCorner(const ColourImage& picture, glm::dvec2 corner) {
  const auto asymmetry = [&](const glm::dvec2& centre) {
    double sum = 0;
    for (int dy = 0; dy <= 7; ++dy) {
      for (int dx = -7; dx <= 7; ++dx) {
        const glm::dvec2 aside(dx, dy);
        const double difference = LightBetween(picture, centre + aside) - LightBetween(picture, centre - aside);
        sum += difference * difference;
      }
    }
    return sum;
  };
  double least = asymmetry(corner);
  for (double step = 0.5; step > 0.004;) {
    glm::dvec2 best = corner;
    for (const glm::dvec2& way : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
      const double now = asymmetry(corner + step * way);
      if (now >= least) continue;
      least = now;
      best = corner + step * way;
    }
    if (best == corner) step /= 2;
    corner = best;
  }
  return corner;
}

struct Misses {
  int corners = 0;
  double worst = 0;
};

Misses CornersMissed(const CameraEffects& effects, bool with_lens) {
  Camera camera = LookAt({}, {0.7, 1.4, 3.0}, {0.05, 1, 0});
  CameraEffects soft = effects;
  soft.defocus_px = 1.2;  // edges as wide as the estimator needs; the blur is symmetric, so no corner moves
  CameraModel model = ModelOf(soft, camera);
  camera.distortion = Set(effects);
  const ColourImage picture = Shoot(model, Board(model));
  Misses misses;
  for (int i = -8; i <= 8; ++i) {
    for (int j = -3; j <= 9; ++j) {
      const glm::dvec3 p_WQ(0.25 * i, 0.25 * j, 0);
      const auto truth = Project(camera, p_WQ);
      const auto guess = with_lens ? truth : Project(MatrixOf(camera), p_WQ);
      if (!truth || truth->x < 12 || truth->y < 12 || truth->x > 628 || truth->y > 468) continue;
      ++misses.corners;
      misses.worst = std::max(misses.worst, glm::length(FindCorner(picture, *truth) - *guess));
    }
  }
  return misses;
}

TEST(Lens, ShowsTheCornersOfABoardWhereProjectSays) {
  for (const CameraEffects& effects :
       {CameraEffects{.radial_distortion = -0.1, .tangential_distortion = 0.02, .noise = 0},
        CameraEffects{.radial_distortion = 0.15, .noise = 0}, NoEffects()}) {
    const Misses misses = CornersMissed(effects, true);
    EXPECT_GT(misses.corners, 60);
    EXPECT_LT(misses.worst, 0.1) << "radial " << effects.radial_distortion;
  }
  EXPECT_GT(CornersMissed({.radial_distortion = -0.1, .noise = 0}, false).worst, 10) << "a pinhole would be wrong";
}

// --- Projected joints lie on the body's labels.

BodyPose RandomPose(RandomStream& random) {
  constexpr std::array kTrunk = {Role::kSpine,         Role::kShoulderCentre, Role::kHead,    Role::kLeftShoulder,
                                 Role::kRightShoulder, Role::kLeftHip,        Role::kRightHip};
  BodyPose pose = StandingPose();
  // Each limb points in a random direction from its root; its length is kept.
  for (const Bone& bone : AllBones()) {
    // The trunk stays.
    const bool is_limb = std::find(kTrunk.begin(), kTrunk.end(), bone.child) == kTrunk.end();
    const glm::dvec3 old = StandingPose()[bone.child] - StandingPose()[bone.parent];
    const glm::dvec3 turned = glm::length(old) * glm::normalize(old / glm::length(old) + 0.6 * random.Normal3());
    pose[bone.child] = pose[bone.parent] + (is_limb ? turned : old);
  }
  const double angle = random.Uniform(0, 2 * std::numbers::pi), c = std::cos(angle), s = std::sin(angle);
  const glm::dvec3 step(random.Uniform(-0.9, 0.9), 0, random.Uniform(-0.6, 0.6));
  for (glm::dvec3& joint : pose.joints)
    joint = glm::dvec3(c * joint.x + s * joint.z, joint.y, c * joint.z - s * joint.x) + step;
  return pose;
}

TEST(Lens, PutsProjectedJointsOnTheBody) {
  ASSERT_OK(renderer, SharedRenderer());
  const CameraEffects effects{.radial_distortion = -0.1, .tangential_distortion = 0.02, .noise = 0};
  Camera camera = LookAt({}, {-1.5, 1.6, 3.2}, {0, 0.95, 0});
  CameraModel model = ModelOf(effects, camera);
  camera.distortion = Set(effects);
  RandomStream random(kShotWorld, "poses");
  int joints = 0, on_body = 0, by_pinhole = 0;
  for (int i = 0; i < 80; ++i) {
    const BodyPose pose = RandomPose(random);
    const Figure figure{BodyCapsules(pose), PerformerColours()};
    const View view = model.Shoot(
        0,
        [&](double, const RowRange& rows, Targets targets) {
          return (*renderer)->RenderRows({}, {figure}, model.pinhole(), targets, rows);
        },
        Targets::kAll);
    const auto shows_body = [&](const std::optional<glm::dvec2>& pixel) {
      const int x = static_cast<int>(std::floor(pixel->x)), y = static_cast<int>(std::floor(pixel->y));
      return view.labels.Contains(x, y) && view.labels.At(x, y) >= kFirstBodyPart;
    };
    for (const Role role : AllRoles()) {
      const auto pixel = Project(camera, pose[role]);
      if (!pixel || pixel->x < 0 || pixel->y < 0 || pixel->x >= 640 || pixel->y >= 480) continue;
      ++joints;
      on_body += shows_body(pixel);
      by_pinhole += shows_body(Project(MatrixOf(camera), pose[role]));
    }
  }
  EXPECT_GE(joints, 1000);
  EXPECT_EQ(on_body, joints);
  EXPECT_LT(by_pinhole, joints - 20) << "without the lens, some would miss";
}

TEST(Lens, TakesLabelsAndDepthsFromTheNearestPixel) {
  Camera camera = PlainCamera();
  camera.distortion = Set({.radial_distortion = -0.1, .noise = 0});
  const LensWarp lens(camera);
  const Intrinsics& in = lens.pinhole().intrinsics;
  const RowRange rows = lens.SourceRows({0, 480});
  LabelImage labels(in.width, rows.end - rows.first), warped(640, 480);
  for (int y = rows.first; y < rows.end; ++y) {
    for (int x = 0; x < in.width; ++x) labels.At(x, y - rows.first) = static_cast<std::uint32_t>(y * in.width + x);
  }
  lens.Warp(labels, {0, 480}, warped);
  for (int y = 0; y < 480; y += 7) {
    for (int x = 0; x < 640; x += 7) {
      const int from_x = static_cast<int>(warped.At(x, y)) % in.width,
                from_y = static_cast<int>(warped.At(x, y)) / in.width;
      // Distorting the source pixel gives the target pixel to within half a pixel.
      const glm::dvec2 straight(from_x + 0.5 - in.cx + 320, from_y + 0.5 - in.cy + 240);
      const glm::dvec2 there = *DistortPixel(camera, straight) - glm::dvec2(x + 0.5, y + 0.5);
      EXPECT_LT(std::max(std::abs(there.x), std::abs(there.y)), 0.51);
    }
  }
}

TEST(Lens, WarpsBandsAsItWarpsTheWhole) {
  CameraEffects effects{.radial_distortion = -0.1, .tangential_distortion = 0.02, .noise = 0};
  const auto pattern = [](int x, int y, double) {
    return Rgb8{static_cast<std::uint8_t>(x * 7), static_cast<std::uint8_t>(y * 5), static_cast<std::uint8_t>(x * y)};
  };
  CameraModel whole = ModelOf(effects);
  effects.rolling_shutter_ms = 20;
  CameraModel banded = ModelOf(effects);
  EXPECT_EQ(Shoot(whole, pattern).pixels, Shoot(banded, pattern).pixels) << "nothing moves";
}

TEST(Lens, ShowsAWholeViewAsACameraWithIt) {
  const CameraEffects effects{.radial_distortion = -0.08, .tangential_distortion = 0.01, .noise = 0};
  CameraModel model = ModelOf(effects);
  Camera camera = PlainCamera();
  camera.distortion = Set(effects);
  const LensWarp lens(camera);
  const auto pattern = [](int x, int y, double) {
    return Rgb8{static_cast<std::uint8_t>(x * 7), static_cast<std::uint8_t>(y * 5), static_cast<std::uint8_t>(x * y)};
  };
  const CameraModel::Scene scene = SceneOf(model, pattern);
  const View whole = lens.Warp(scene(0, {0, lens.pinhole().intrinsics.height}, Targets::kAll));
  const View shot = model.Shoot(0, scene, Targets::kAll);
  EXPECT_EQ(whole.colour.pixels, shot.colour.pixels);
  EXPECT_EQ(whole.labels.pixels, shot.labels.pixels);
  EXPECT_EQ(whole.depth.pixels, shot.depth.pixels);
  EXPECT_EQ(LensWarp(PlainCamera()).Warp(whole).colour.pixels, whole.colour.pixels) << "no lens, no change";
}

}  // namespace
}  // namespace etude
