#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "sim/render/figure_batches.h"
#include "sim/render/renderer.h"
#include "tests/sim/render/dancer.h"
#include "tests/sim/render/ray_caster.h"
#include "tests/sim/render/tessellation.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

constexpr auto kShadow = static_cast<std::uint32_t>(Part::kShadow);

class RenderedSurfaces : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_OK(made, SharedRenderer());
    renderer_ = *made;
  }
  View Draw(const std::vector<Figure>& figures, const Room& room = {}) {
    return renderer_->Render(room, figures, camera_, Targets::kAll);
  }

  Camera camera_ = LookAt({}, {-1.2, 1.4, 3.9}, {0, 0.95, 0});
  Renderer* renderer_ = nullptr;
};

Figure OfSurfaces(std::vector<Surface> surfaces) { return {.shape = {}, .surfaces = std::move(surfaces)}; }

// Returns a flat four-sided sheet, counter-clockwise seen from its front.
Surface Sheet(const std::array<glm::dvec3, 4>& corners, Part part, Rgb8 colour = {220, 120, 60}) {
  const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  return {.positions = {corners.begin(), corners.end()},
          .normals = std::vector(4, normal),
          .triangles = {{0, 1, 2}, {0, 2, 3}},
          .parts = {part, part},
          .colour = colour};
}

Surface FacingSheet(Part part) { return Sheet({{{-0.5, 0.5, 0}, {0.5, 0.5, 0}, {0.5, 1.5, 0}, {-0.5, 1.5, 0}}}, part); }

int WorstJointDistance(Rgb8 a, Rgb8 b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

bool SameView(const View& a, const View& b) {
  return a.colour.pixels == b.colour.pixels && a.labels.pixels == b.labels.pixels && a.depth.pixels == b.depth.pixels;
}

TEST_F(RenderedSurfaces, AgreeWithARayCasterOnEveryLabelAndDepth) {
  const std::vector<Surface> edgy = Tessellate(Dancer(), PerformerColours(), 4);
  for (const Camera& camera : TestCameras()) {
    const View view = renderer_->Render({}, {OfSurfaces(edgy)}, camera, Targets::kAll);
    const Comparison result = Compare(view, {camera, {}, edgy});
    EXPECT_GT(result.compared, 8000);
    EXPECT_EQ(result.wrong_labels, 0);
    EXPECT_LT(result.worst_depth, 1e-4);
    EXPECT_LT(result.on_outlines, result.compared / 500);
  }
}

TEST_F(RenderedSurfaces, WouldBeCaughtBeingThreeMillimetresOff) {
  std::vector<Surface> edgy = Tessellate(Dancer(), PerformerColours(), 4);
  const View view = Draw({OfSurfaces(edgy)});
  for (Surface& surface : edgy) {
    for (glm::dvec3& position : surface.positions) position.x += 0.003;
  }
  EXPECT_GT(Compare(view, {camera_, {}, edgy}).wrong_labels, 20);
}

TEST_F(RenderedSurfaces, HideAndAreHiddenByCapsulesAlike) {
  const std::vector<Capsule> dancer = Dancer();
  std::vector<Capsule> first, second;
  for (std::size_t i = 0; i < dancer.size(); ++i) (i % 2 == 0 ? first : second).push_back(dancer[i]);
  const std::vector<Surface> surfaces = Tessellate(second, PerformerColours(), 4);
  const View view = Draw({{first, PerformerColours(), surfaces}});
  const Comparison result = Compare(view, {camera_, first, surfaces});
  EXPECT_EQ(result.wrong_labels, 0);
  EXPECT_LT(result.worst_depth, 1e-3);
}

TEST_F(RenderedSurfaces, OfFineTrianglesLookLikeTheCapsuleTheyFollow) {
  for (const glm::dvec3& end : {glm::dvec3(0, 1, 0), glm::dvec3(0.4, 1.3, -0.2)}) {
    const Capsule capsule{Part::kTrunk, {0, 1, 0}, end, 0.25};
    const Rgb8 paint = PerformerColours()[static_cast<std::size_t>(Part::kTrunk)];
    const View exact = Draw({{{capsule}, PerformerColours()}});
    const View fine = Draw({OfSurfaces({Tessellate(capsule, paint, 192)})});
    int body = 0, shadow = 0, full_shadow = 0, other_label = 0, other_depth = 0, worst_body = 0, lighter = 0;
    for (std::size_t i = 0; i < exact.labels.pixels.size(); ++i) {
      const std::uint32_t label = exact.labels.pixels[i];
      if (label != fine.labels.pixels[i]) {
        ++other_label;
        continue;
      }
      body += label == static_cast<std::uint32_t>(Part::kTrunk);
      shadow += label == kShadow;
      other_depth += std::abs(exact.depth.pixels[i] - fine.depth.pixels[i]) > 1e-3;
      const Rgb8 a = exact.colour.pixels[i], b = fine.colour.pixels[i];
      if (label == kShadow) {
        full_shadow += WorstJointDistance(a, b) <= 2;
        lighter += b.r > a.r + 2 || b.g > a.g + 2 || b.b > a.b + 2;
      } else {
        worst_body = std::max(worst_body, WorstJointDistance(a, b));
      }
    }
    EXPECT_GT(body, 4000);
    EXPECT_GT(shadow, 2000);
    // Tessellation moves outlines, which are about 300 pixels long, inwards by a hundredth of a pixel.
    EXPECT_LT(other_label, 10);
    EXPECT_LT(other_depth, 20);
    EXPECT_LE(worst_body, 2);
    // Shadows agree in the middle; a capsule's shadow has softer edges.
    EXPECT_GT(full_shadow, shadow / 4);
    EXPECT_LT(full_shadow, shadow);
    EXPECT_EQ(lighter, 0);
  }
}

TEST_F(RenderedSurfaces, AreLitOnTheSideThatIsSeen) {
  Surface turned = FacingSheet(Part::kTrunk);
  const View front = Draw({OfSurfaces({turned})});
  // The same sheet seen from behind.
  for (auto& triangle : turned.triangles) std::swap(triangle[0], triangle[1]);
  for (glm::dvec3& normal : turned.normals) normal = -normal;
  EXPECT_TRUE(SameView(front, Draw({OfSurfaces({turned})})));

  // A normal that contradicts the winding makes the front dark.
  for (glm::dvec3& normal : turned.normals) normal = -normal;
  const View contradictory = Draw({OfSurfaces({turned})});
  EXPECT_EQ(front.labels.pixels, contradictory.labels.pixels);
  EXPECT_GT(front.colour.At(320, 240).r, contradictory.colour.At(320, 240).r + 50);
}

TEST_F(RenderedSurfaces, EachTriangleHasItsOwnLabel) {
  Surface sheet = FacingSheet(Part::kLeftHand);
  sheet.parts[1] = Part::kRightFoot;
  const View view = Draw({OfSurfaces({sheet})});
  EXPECT_EQ(Compare(view, {camera_, {}, {sheet}}).wrong_labels, 0);
  EXPECT_GT(std::ranges::count(view.labels.pixels, static_cast<std::uint32_t>(Part::kLeftHand)), 1000);
  EXPECT_GT(std::ranges::count(view.labels.pixels, static_cast<std::uint32_t>(Part::kRightFoot)), 1000);
}

TEST_F(RenderedSurfaces, MayReachBehindTheCameraAboveTheLampAndUnderTheFloor) {
  const std::vector<Surface> sheets = {
      // A low table that extends from the wall to far behind the camera.
      Sheet({{{-2, 0.4, 30}, {3, 0.4, 30}, {3, 0.4, -2}, {-2, 0.4, -2}}}, Part::kTrunk),
      // A banner that leans through the lamp's height.
      Sheet({{{0.5, 1.2, -1}, {1.5, 1.2, -1}, {1.5, 8, 1}, {0.5, 8, 1}}}, Part::kHead),
      // A board that penetrates the floor.
      Sheet({{{-1.5, -3, -0.5}, {-0.5, -3, -0.5}, {-0.5, 1, 0.5}, {-1.5, 1, 0.5}}}, Part::kLeftFoot),
      // A board that penetrates the wall.
      Sheet({{{-1, 1.5, -9}, {0, 1.5, -9}, {0, 1.9, -1}, {-1, 1.9, -1}}}, Part::kLeftHand)};
  for (const Camera& camera : TestCameras()) {
    const View view = renderer_->Render({}, {OfSurfaces(sheets)}, camera, Targets::kAll);
    const Comparison result = Compare(view, {camera, {}, sheets});
    EXPECT_EQ(result.wrong_labels, 0);
    EXPECT_LT(result.worst_depth, 1e-3);
  }
  const View shown = Draw({OfSurfaces(sheets)});
  for (const Part part : {Part::kTrunk, Part::kHead, Part::kLeftFoot, Part::kLeftHand, Part::kShadow}) {
    EXPECT_GT(std::ranges::count(shown.labels.pixels, static_cast<std::uint32_t>(part)), 500) << static_cast<int>(part);
  }
}

TEST_F(RenderedSurfaces, OutOfSightAndOutOfTheLightLeaveTheRoomAsItIs) {
  const std::vector<Surface> sheets = {
      Sheet({{{-3, 0, 9}, {3, 0, 9}, {3, 3, 9}, {-3, 3, 9}}}, Part::kTrunk),                // behind camera and lamp
      Sheet({{{-3, 5, -2}, {3, 5, -2}, {3, 5, 2}, {-3, 5, 2}}}, Part::kTrunk),              // above camera and lamp
      Sheet({{{-3, -0.1, -2}, {3, -0.1, -2}, {3, -0.1, 2}, {-3, -0.1, 2}}}, Part::kTrunk),  // under the floor
      Sheet({{{-3, 0, -3}, {3, 0, -3}, {3, 3, -3}, {-3, 3, -3}}}, Part::kTrunk)};           // behind the wall
  EXPECT_TRUE(SameView(Draw({OfSurfaces(sheets)}), Draw({})));
}

TEST_F(RenderedSurfaces, BeginACentimetreFromTheCamera) {
  const glm::dmat3 R_WC = glm::transpose(camera_.R_CW);
  const auto with_speck = [&](double depth) {
    std::array<glm::dvec3, 4> corners{{{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}}};
    for (glm::dvec3& corner : corners) corner = camera_.p_WC + R_WC * (depth * corner);
    return Draw({OfSurfaces({Sheet(corners, Part::kHead)})});
  };
  EXPECT_TRUE(SameView(with_speck(0.0099), Draw({})));
  EXPECT_TRUE(
      std::ranges::all_of(with_speck(0.0101).depth.pixels, [](float d) { return std::abs(d - 0.0101) < 1e-6; }));
}

TEST_F(RenderedSurfaces, LeaveOutTrianglesThatAreNotFiniteOrEmpty) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
  Surface sheet = FacingSheet(Part::kTrunk);
  const View expected = Draw({OfSurfaces({sheet})});
  const auto add = [&sheet](const glm::dvec3& position, const glm::dvec3& normal) {
    sheet.positions.push_back(position);
    sheet.normals.push_back(normal);
    sheet.triangles.push_back({0, 1, static_cast<std::uint32_t>(sheet.positions.size() - 1)});
    sheet.parts.push_back(Part::kHead);
  };
  const glm::dvec3 ahead(0, 0, 1);
  add({kNan, 1, 0}, ahead);
  add({0, kInfinity, 0}, ahead);
  add({0, 0, -1e300}, ahead);
  add({0, 0, 1e9}, ahead);
  add({0, 1, 0}, {0, kNan, 0});
  SurfaceTriangles all;
  MakeTriangles({OfSurfaces({sheet})}, {}, all);
  EXPECT_EQ(all.plain.indices.size(), 6u);
  add({0, 1, 0}, ahead);
  MakeTriangles({OfSurfaces({sheet})}, {}, all);
  EXPECT_EQ(all.plain.indices.size(), 9u) << "the good one is kept";
  sheet.triangles.back() = {2, 0, 2};  // without area
  EXPECT_TRUE(SameView(Draw({OfSurfaces({sheet, {}})}), expected));
  EXPECT_TRUE(SameView(Draw({OfSurfaces({{}, {}})}), Draw({})));
}

TEST(TrianglesOfSurfaces, ShareCornersWithinAPartAlone) {
  Surface sheet = FacingSheet(Part::kHead);
  sheet.parts = {Part::kTrunk, Part::kTrunk};
  SurfaceTriangles all;
  MakeTriangles({OfSurfaces({sheet})}, {}, all);
  EXPECT_EQ(all.plain.corners.size(), 4u);
  EXPECT_EQ(all.plain.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  sheet.parts = {Part::kTrunk, Part::kHead};
  MakeTriangles({OfSurfaces({sheet})}, {}, all);
  EXPECT_EQ(all.plain.indices, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(all.plain.corners[3].place, all.plain.corners[0].place);
  EXPECT_EQ(all.plain.corners[3].paint_and_label.a, static_cast<float>(Part::kHead));
}

TEST_F(RenderedSurfaces, GiveTheSameBytesAgainWithoutLabelsAndDepthToo) {
  const std::vector<Figure> figures = {OfSurfaces(Tessellate(Dancer(), PerformerColours(), 4))};
  const View first = Draw(figures);
  Draw({{Dancer(), PerformerColours()}});
  EXPECT_TRUE(SameView(first, Draw(figures)));
  EXPECT_EQ(first.colour.pixels, renderer_->Render({}, figures, camera_, Targets::kColour).colour.pixels);
  ASSERT_OK(fresh, Renderer::Create());
  renderer_ = fresh->get();
  EXPECT_TRUE(SameView(first, Draw(figures)));
}

TEST_F(RenderedSurfaces, ObeyTheRoomsBrightnessAndItsShadows) {
  const std::vector<Figure> figures = {OfSurfaces(Tessellate(Dancer(), PerformerColours(), 4))};
  const View normal = Draw(figures), dim = Draw(figures, {.brightness = 0.8});
  for (std::size_t i = 0; i < normal.colour.pixels.size(); i += 7) {
    const Rgb8 &a = normal.colour.pixels[i], &b = dim.colour.pixels[i];
    ASSERT_LE(std::max({std::abs(0.8 * a.r - b.r), std::abs(0.8 * a.g - b.g), std::abs(0.8 * a.b - b.b)}), 1.0);
  }
  EXPECT_GT(std::ranges::count(normal.labels.pixels, kShadow), 3000);
  EXPECT_EQ(std::ranges::count(Draw(figures, {.casts_shadows = false}).labels.pixels, kShadow), 0);
}

// Returns a texture of four squares: red and green above, blue and white below.
SharedTexture FourFields(int side = 64) {
  auto texture = std::make_shared<Texture>();
  texture->picture = ColourImage(side, side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const bool right = x >= side / 2, low = y >= side / 2;
      texture->picture.At(x, y) =
          low ? (right ? Rgb8{240, 240, 240} : Rgb8{0, 0, 240}) : (right ? Rgb8{0, 240, 0} : Rgb8{240, 0, 0});
    }
  }
  return texture;
}

// Returns a sheet with u to the right and v down; the texture repeats `times` times.
Surface TexturedSheet(SharedTexture texture, float times = 1) {
  Surface sheet = FacingSheet(Part::kTrunk);
  sheet.texture = std::move(texture);
  sheet.on_texture = {{0, times}, {times, times}, {times, 0}, {0, 0}};
  return sheet;
}

Rgb8 ColourAt(const View& view, const Camera& camera, const glm::dvec3& place) {
  const auto pixel = Project(camera, place);
  return view.colour.At(static_cast<int>(pixel->x), static_cast<int>(pixel->y));
}

TEST_F(RenderedSurfaces, ShowEachPartOfATextureAtItsPlace) {
  const View view = Draw({OfSurfaces({TexturedSheet(FourFields())})});
  const Rgb8 red = ColourAt(view, camera_, {-0.25, 1.25, 0}), green = ColourAt(view, camera_, {0.25, 1.25, 0});
  const Rgb8 blue = ColourAt(view, camera_, {-0.25, 0.75, 0}), white = ColourAt(view, camera_, {0.25, 0.75, 0});
  EXPECT_GT(red.r, 4 * (red.g + red.b) + 40);
  EXPECT_GT(green.g, 4 * (green.r + green.b) + 40);
  EXPECT_GT(blue.b, 4 * (blue.r + blue.g) + 40);
  EXPECT_LT(WorstJointDistance(white, {white.g, white.g, white.g}), 3);
  EXPECT_GT(white.g, 80);
  // The same light as on a plain sheet.
  const Rgb8 plain = ColourAt(Draw({OfSurfaces({Sheet({{{-0.5, 0.5, 0}, {0.5, 0.5, 0}, {0.5, 1.5, 0}, {-0.5, 1.5, 0}}},
                                                      Part::kTrunk, {240, 240, 240})})}),
                              camera_, {0.25, 0.75, 0});
  EXPECT_LE(WorstJointDistance(white, plain), 1);
}

TEST_F(RenderedSurfaces, HaveAsManyCopiesOfATextureAsTheyAskFor) {
  const View view = Draw({OfSurfaces({TexturedSheet(FourFields(), 2)})});
  EXPECT_GT(ColourAt(view, camera_, {0.125, 1.375, 0}).r, 100);  // the upper left field of the second copy
  auto stays = std::make_shared<Texture>(*FourFields());
  stays->beyond_u = stays->beyond_v = Texture::Beyond::kStays;
  const View once = Draw({OfSurfaces({TexturedSheet(stays, 2)})});
  EXPECT_LT(ColourAt(once, camera_, {0.125, 1.375, 0}).r, 20);  // clamped to the upper right field, green
}

TEST_F(RenderedSurfaces, AreDrawnTheSameWhateverTexturesWereDrawnBefore) {
  const View first = Draw({OfSurfaces({TexturedSheet(FourFields())})});
  for (int i = 0; i < 70; ++i) Draw({OfSurfaces({TexturedSheet(FourFields(2 * (i + 1)))})});
  EXPECT_TRUE(SameView(first, Draw({OfSurfaces({TexturedSheet(FourFields())})})));
  EXPECT_FALSE(SameView(first, Draw({OfSurfaces({FacingSheet(Part::kTrunk)})})));
}

}  // namespace
}  // namespace etude
