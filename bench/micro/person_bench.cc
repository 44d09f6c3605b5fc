// Times how long it takes to find the person in a picture of 640 × 480, with Etude's segmenters and, if OpenCV is
// installed, with OpenCV's functions.
//   build/release/bench/micro/person_bench --benchmark_repetitions=9 --benchmark_report_aggregates_only=true
#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "engine/vision/person_finder.h"
#include "sim/random/stream.h"
#ifdef ETUDE_HAS_OPENCV
#include "bench/peers/opencv_peer.h"
#endif

namespace etude {
namespace {

constexpr int kWidth = 640, kHeight = 480;
constexpr int kPictures = 4, kStepPx = 9;  // the person moves by kStepPx from picture to picture

std::uint8_t Level(double value) { return static_cast<std::uint8_t>(value < 0 ? 0 : value > 255 ? 255 : value + 0.5); }

/// Returns true if a pixel is inside the ellipse with centre (cx, cy) and radii (rx, ry), moved to the right by `shift`
/// pixels.
bool IsIn(int x, int y, int shift, double cx, double cy, double rx, double ry) {
  const double u = (x - cx - shift) / rx, v = (y - cy) / ry;
  return u * u + v * v < 1;
}

/// Returns true if a pixel belongs to the person's head, trunk, arms or legs. The small hole in the trunk belongs to
/// the person.
bool IsPerson(int x, int y, int shift) {
  const auto in = [&](double cx, double cy, double rx, double ry) { return IsIn(x, y, shift, cx, cy, rx, ry); };
  return in(320, 120, 22, 28) || in(320, 220, 45, 80) || in(270, 210, 12, 70) || in(370, 210, 12, 70) ||
         in(300, 350, 20, 90) || in(340, 350, 20, 90);
}

/// Draws a coloured wall and floor with noise (standard deviation 2 of 255), and the person, moved to the right by
/// `shift` pixels.
ColourImage Room(const char* noise, int shift, bool has_person) {
  RandomStream dice(WorldKey{.suite_seed = 1, .scenario = "person-bench", .trial = shift}, noise);
  ColourImage picture(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double shade = 0.8 + 0.2 * x / kWidth;
      double r = 150 * shade, g = 170 * shade, b = 210 * shade;
      if (y > 330) r = 150 * shade, g = 110 * shade, b = 80 * shade;
      const auto in = [&](double cx, double cy, double rx, double ry) { return IsIn(x, y, shift, cx, cy, rx, ry); };
      if (has_person) {
        if (in(320, 120, 22, 28)) r = 220, g = 160, b = 130;
        if (in(320, 220, 45, 80)) r = 200, g = 40, b = 50;
        if (in(270, 210, 12, 70) || in(370, 210, 12, 70)) r = 220, g = 160, b = 130;
        if (in(300, 350, 20, 90) || in(340, 350, 20, 90)) r = 40, g = 120, b = 60;
        if (in(318, 225, 5, 3)) r = 150 * shade, g = 170 * shade, b = 210 * shade;  // a small hole
      }
      picture.At(x, y) = {Level(r + 2 * dice.Normal()), Level(g + 2 * dice.Normal()), Level(b + 2 * dice.Normal())};
    }
  }
  return picture;
}

const ColourImage& Background() {
  static const ColourImage room = Room("background", 0, false);
  return room;
}

const std::vector<ColourImage>& Pictures() {
  static const std::vector<ColourImage> pictures = [] {
    std::vector<ColourImage> made;
    for (int i = 0; i < kPictures; ++i) made.push_back(Room("pictures", kStepPx * i, true));
    return made;
  }();
  return pictures;
}

/// Returns the mean intersection over union of the found and the true person. The finder first sees one second of the
/// empty room, from which some models learn the background.
template <typename Finder>
double IouOf(Finder& finder) {
  constexpr int kEmptyPictures = 30;
  for (int i = 0; i < kEmptyPictures; ++i) (void)finder.Find(Room("empty", i, false));
  double sum = 0;
  for (int i = 0; i < kPictures; ++i) {
    const Mask mask = finder.Find(Pictures()[static_cast<std::size_t>(i)]);
    int both = 0, either = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool found = mask.At(x, y) != 0, is_there = IsPerson(x, y, kStepPx * i);
        both += found && is_there;
        either += found || is_there;
      }
    }
    sum += static_cast<double>(both) / either;
  }
  return sum / kPictures;
}

template <typename Finder>
void FindAll(benchmark::State& state, Finder& finder) {
  state.counters["iou"] = IouOf(finder);
  std::size_t i = 0;
  for (auto _ : state) {
    const Mask mask = finder.Find(Pictures()[i++ % Pictures().size()]);
    benchmark::DoNotOptimize(mask.pixels.data());
  }
}

void Ours(benchmark::State& state, Segmenter segmenter) {
  PersonFinder finder(Background(), {.segmenter = segmenter, .change = {}});
  FindAll(state, finder);
}
BENCHMARK_CAPTURE(Ours, rgb, Segmenter::kRgb)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Ours, hue, Segmenter::kHue)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Ours, hue_gated, Segmenter::kHueGated)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Ours, ratio, Segmenter::kRatio)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Ours, running, Segmenter::kRunning)->Unit(benchmark::kMicrosecond);

/// Times the classification of pixels alone. The choice of the largest piece and the filling of holes are left out.
void OursDetect(benchmark::State& state) {
  PersonFinder finder(Background(), {.segmenter = Segmenter::kHue, .change = {}});
  std::size_t i = 0;
  for (auto _ : state) {
    const Mask mask = finder.Detect(Pictures()[i++ % Pictures().size()]);
    benchmark::DoNotOptimize(mask.pixels.data());
  }
}
BENCHMARK(OursDetect)->Unit(benchmark::kMicrosecond);

#ifdef ETUDE_HAS_OPENCV
/// Returns the number of pixels, over all pictures, in which the peer's mask differs from Etude's mask.
template <typename Finder>
std::size_t DifferentFromOurs(Finder& peer) {
  PersonFinder ours(Background(), {.segmenter = Segmenter::kHue, .change = {}});
  std::size_t different = 0;
  for (const ColourImage& picture : Pictures()) {
    const Mask a = ours.Find(picture), b = peer.Find(picture);
    for (std::size_t i = 0; i < a.pixels.size(); ++i) different += a.pixels[i] != b.pixels[i];
  }
  return different;
}

void OpenCvHue(benchmark::State& state, OpenCvPerson::Kind kind) {
  const PersonOptions options;
  OpenCvPerson peer(Background(), options.change.hue_threshold, options.max_hole_px, kind);
  const std::size_t different = DifferentFromOurs(peer);
  if (kind == OpenCvPerson::Kind::kSameHue && different != 0) {
    std::fprintf(stderr, "the chains disagree about %zu pixels\n", different);
    std::exit(1);
  }
  FindAll(state, peer);
  state.counters["pixels_unlike_ours"] = static_cast<double>(different);
}
BENCHMARK_CAPTURE(OpenCvHue, same_hue, OpenCvPerson::Kind::kSameHue)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(OpenCvHue, hsv, OpenCvPerson::Kind::kHsv)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(OpenCvHue, hsv_contours, OpenCvPerson::Kind::kHsvContours)->Unit(benchmark::kMicrosecond);

void OpenCvMixture(benchmark::State& state, OpenCvModel::Kind kind) {
  OpenCvModel peer(kind, PersonOptions{}.max_hole_px);
  FindAll(state, peer);
}
BENCHMARK_CAPTURE(OpenCvMixture, mog2, OpenCvModel::Kind::kMog2)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(OpenCvMixture, knn, OpenCvModel::Kind::kKnn)->Unit(benchmark::kMicrosecond);
#endif

}  // namespace
}  // namespace etude
