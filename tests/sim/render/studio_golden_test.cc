// The studio's pictures, byte for byte; changes for furnished rooms, clothes and speed must not alter them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include "engine/base/digest.h"
#include "sim/render/renderer.h"
#include "tests/sim/render/dancer.h"
#include "tests/sim/render/ray_caster.h"
#include "tests/sim/render/tessellation.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

// Digests of pictures that Mesa renders in the pinned environment. They are equal for OSMesa and EGL (ctest runs both).
// Another Mesa may differ.
struct GoldenPictures {
  const char* mesa;
  std::array<const char*, 3> digests;
};
constexpr std::array<GoldenPictures, 2> kGolden = {
    {{"Mesa 22.3.", {"bf3ebf84930eed37", "5665ea0b9aeff575", "e4d87eb8c24d3163"}},
     {"Mesa 25.0.", {"bf3ebf84930eed37", "5665ea0b9aeff575", "e4d87eb8c24d3163"}}}};

template <typename Pixel>
void Add(const Image<Pixel>& image, Digest& digest) {
  digest.Add(
      std::span(reinterpret_cast<const std::uint8_t*>(image.pixels.data()), image.pixels.size() * sizeof(Pixel)));
}

std::vector<Capsule> Moved(double x, double z, double turn) {
  std::vector<Capsule> shape = Dancer();
  const auto move = [&](glm::dvec3& p) {
    p = {x + std::cos(turn) * p.x + std::sin(turn) * p.z, p.y, z - std::sin(turn) * p.x + std::cos(turn) * p.z};
  };
  for (Capsule& capsule : shape) {
    move(capsule.a);
    move(capsule.b);
  }
  return shape;
}

// Returns a digest of twelve pictures by one camera: capsules at many places and lights, one of surfaces, one empty.
std::string DigestBy(Renderer& renderer, const Camera& camera) {
  Digest digest;
  const auto add = [&](const Room& room, const std::vector<Figure>& figures) {
    const View view = renderer.Render(room, figures, camera, Targets::kAll);
    Add(view.colour, digest);
    Add(view.labels, digest);
    Add(view.depth, digest);
    Add(renderer.Render(room, figures, camera, Targets::kColour).colour, digest);
  };
  for (int i = 0; i < 10; ++i) {
    const Room room{.texture_seed = 1u + i / 5, .brightness = 0.9 + 0.037 * i};
    add(room, {{Moved(0.21 * (i - 5), 0.1 * i - 0.9, 0.7 * i), PerformerColours()}});
  }
  add({}, {{.shape = {}, .surfaces = Tessellate(Dancer(), PerformerColours(), 12)}});
  add({}, {});
  return digest.Hex();
}

TEST(StudioGolden, PicturesAreThoseThatWereRecorded) {
  const std::string version = RendererVersion();
  const auto* golden =
      std::ranges::find_if(kGolden, [&](const auto& of) { return version.find(of.mesa) != std::string::npos; });
  if (golden == kGolden.end()) GTEST_SKIP() << "nothing was recorded with " << version;
  // The library that ctest requested is the one that draws.
  if (const char* choice = std::getenv("ETUDE_GL")) {
    EXPECT_TRUE(version.ends_with(std::string(choice) == "egl" ? "by EGL" : "by OSMesa")) << version;
  }
  ASSERT_OK(renderer, SharedRenderer());
  std::size_t compared = 0;
  for (const Camera& camera : TestCameras()) {
    EXPECT_EQ(DigestBy(**renderer, camera), golden->digests[compared]);
    ++compared;
  }
  EXPECT_EQ(compared, golden->digests.size());
}

}  // namespace
}  // namespace etude
