// Pictures of the studio, and how films draw them: vectorised, redrawn only where something changed, in several
// processes.
#include "io/drawing/studio.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "io/drawing/film.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "sim/character/characters.h"
#include "sim/character/posed.h"
#include "sim/choreography/canonical_body.h"
#include "tests/support/results.h"

namespace etude {
namespace {

constexpr Box kPicture{0, 0, 180, 240};

Figure BearAt(const FloorMove& move, bool is_closed = true) {
  return Placed(PosedFigure(BearCharacter(), StandingPose(), is_closed), move);
}

ViewBounds BoundsOfBear() {
  ViewBounds bounds;
  Studio::Include(BearAt({0.4, 0, 0}), bounds);
  return bounds;
}

class StudioPictures : public ::testing::Test {
 protected:
  ColourImage Draw(Studio& studio, const FloorMove& move) {
    Canvas canvas(180, 240);
    studio.Draw(canvas, kPicture, *renderer_, BearAt(move), move);
    return canvas.Pixels();
  }

  Renderer* renderer_ = *SharedRenderer();
};

int WorstJointDistance(const ColourImage& a, const ColourImage& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const Rgb8 &p = a.pixels[i], &q = b.pixels[i];
    largest = std::max({largest, std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)});
  }
  return largest;
}

TEST_F(StudioPictures, DoNotDependOnThoseBefore) {
  const FloorMove here{0.4, 0, 0}, there{0.1, 0.3, -0.2};
  for (const double detail : {1.0, 1.5, 2.0}) {
    Studio fresh(180, 240, detail, BoundsOfBear()), used(180, 240, detail, BoundsOfBear());
    const ColourImage picture = Draw(fresh, here);
    Draw(used, here);
    EXPECT_GT(WorstJointDistance(Draw(used, there), picture), 20) << "another picture";
    EXPECT_EQ(Draw(used, here).pixels, picture.pixels);
  }
}

TEST_F(StudioPictures, ShowFiguresAndShadowsWhereTheRendererDoes) {
  // The oracle: GL draws the whole studio with both sides of all triangles. The floor is the same for both.
  const Camera camera =
      LookAt({.width = 200, .height = 260, .fx = 400, .fy = 400, .cx = 100, .cy = 130}, {0, 1.35, 5.2}, {0, 0.92, 0});
  const FloorMove move{0.4, 0, 0};
  const View seen = renderer_->Render({}, {BearAt(move, false)}, camera, Targets::kAll);
  Overlay overlay;
  renderer_->DrawFigures({BearAt({-1, 0.5, 0})}, camera, overlay);  // earlier drawings leave no trace
  renderer_->DrawFigures({BearAt(move)}, camera, overlay);
  int bodies = 0, shadows = 0, other = 0, missing = 0;
  for (std::size_t i = 0; i < seen.labels.pixels.size(); ++i) {
    const std::uint8_t* pixel = &overlay.bytes[4 * i];
    const std::uint32_t label = seen.labels.pixels[i];
    const Rgb8& colour = seen.colour.pixels[i];
    if (label >= kFirstBodyPart) {
      ++bodies;
      other += pixel[3] != Overlay::kBody || pixel[0] != colour.r || pixel[1] != colour.g || pixel[2] != colour.b;
    } else {
      shadows += label == static_cast<std::uint32_t>(Part::kShadow) && pixel[3] == Overlay::kShadow;
      other += pixel[3] == Overlay::kBody;
      missing += label != static_cast<std::uint32_t>(Part::kShadow) && pixel[3] == Overlay::kShadow;
    }
  }
  EXPECT_GT(bodies, 3000);
  EXPECT_GT(shadows, 500);
  EXPECT_LE(other, bodies / 2000) << "where two surfaces meet";
  EXPECT_EQ(missing, 0);
}

TEST(Shrinker, TakesTheMeanOfWhatEachPixelCovers) {
  Image<std::uint32_t> large(9, 6), small(6, 4, 7);
  for (std::size_t i = 0; i < large.pixels.size(); ++i)
    large.pixels[i] = static_cast<std::uint32_t>(i * 2654435761u) & 0xffffff;
  Shrinker(9, 6, 6, 4).Shrink(large, {0, 0, 9, 6}, small);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 6; ++x) {
      for (const int shift : {0, 8, 16}) {
        double sum = 0, area = 0;
        for (int v = 0; v < 6; ++v) {
          for (int u = 0; u < 9; ++u) {
            const auto share = [](double at, double begin) {
              return std::max(0.0, std::min(at + 1, begin + 1.5) - std::max(at, begin));
            };
            const double covered = share(u, 1.5 * x) * share(v, 1.5 * y);
            sum += covered * (large.At(u, v) >> shift & 255);
            area += covered;
          }
        }
        EXPECT_NEAR(small.At(x, y) >> shift & 255, sum / area, 1) << x << ' ' << y;
      }
    }
  }
  // Pixels outside the changed part stay.
  Image<std::uint32_t> again(6, 4, 7);
  Shrinker(9, 6, 6, 4).Shrink(large, {4, 3, 5, 4}, again);
  EXPECT_EQ(again.At(0, 0), 7u);
  EXPECT_EQ(again.At(2, 2), small.At(2, 2));
}

TEST(Canvas, BecomesI420AsBt601HasIt) {
  const struct {
    Paint paint;
    int y, u, v;
  } cases[] = {
      {{0, 0, 0}, 16, 128, 128}, {{1, 1, 1}, 235, 128, 128}, {{1, 0, 0}, 82, 90, 240}, {{0, 0, 1}, 41, 240, 110}};
  for (const auto& colour : cases) {
    Canvas canvas(10, 4);
    canvas.FillBox({0, 0, 10, 4}, colour.paint);
    std::vector<std::uint8_t> planes(60);
    canvas.ToI420(planes.data());
    for (int i = 0; i < 60; ++i) EXPECT_NEAR(planes[i], i < 40 ? colour.y : i < 50 ? colour.u : colour.v, 1) << i;
  }
}

Canvas Numbered(int frame) {
  Canvas canvas(64, 32);
  canvas.FillBox({0, 0, 64, 32}, {(frame % 10) / 10.0, frame / 100.0, 0.5});
  return canvas;
}

TEST(FilmWorkers, HandOverEveryFrameInOrderHoweverManyDraw) {
  for (const int jobs : {1, 2, 3, 50}) {
    auto film = FilmWorkers::Start(45, jobs, [](int frame, auto) { return Numbered(frame); });
    ASSERT_TRUE(film) << ToString(film.error());
    std::vector<std::uint8_t> wanted(64 * 32 * 3 / 2);
    for (int frame = 0; frame < 45; ++frame) {
      Numbered(frame).ToI420(wanted.data());
      ASSERT_OK(picture, film->Next());
      EXPECT_TRUE(std::ranges::equal(*picture, wanted)) << frame << " of " << jobs;
    }
    EXPECT_FALSE(film->Next());
  }
}

TEST(FilmWorkers, DrawWhatOneSourceFeedsThemInOrder) {
  for (const int jobs : {1, 2, 3, 50}) {
    int fed = 0;
    const auto fill = [&](int frame, std::span<std::uint8_t> into) -> Result<void> {
      EXPECT_EQ(frame, fed++);
      EXPECT_EQ(into.size(), 3u);
      std::ranges::fill(into, static_cast<std::uint8_t>(frame));
      return {};
    };
    const auto draw = [](int, std::span<const std::uint8_t> numbers) { return Numbered(numbers[2]); };
    auto film = FilmWorkers::Start(20, jobs, draw, {3, fill});
    ASSERT_TRUE(film) << ToString(film.error());
    std::vector<std::uint8_t> wanted(64 * 32 * 3 / 2);
    for (int frame = 0; frame < 20; ++frame) {
      Numbered(frame).ToI420(wanted.data());
      ASSERT_OK(picture, film->Next());
      EXPECT_TRUE(std::ranges::equal(*picture, wanted)) << frame << " of " << jobs;
    }
    EXPECT_EQ(fed, 20);
    EXPECT_FALSE(film->Next());
  }
}

TEST(FilmWorkers, AFeedThatFailsEndsTheFilmWithItsReason) {
  const auto fill = [](int frame, std::span<std::uint8_t>) -> Result<void> {
    if (frame == 7) return Fail({"left.mp4"}, "ends before frame 8");
    return {};
  };
  auto film = FilmWorkers::Start(20, 2, [](int frame, auto) { return Numbered(frame); }, {1, fill});
  ASSERT_TRUE(film);
  auto picture = film->Next();
  for (int frames = 0; picture && frames < 20; ++frames) picture = film->Next();
  EXPECT_EQ(testing::Refusal(picture), "left.mp4: ends before frame 8");
}

TEST(FilmWorkers, OneThatDiesIsAnErrorNotAnEndlessWait) {
  const pid_t here = getpid();
  auto film = FilmWorkers::Start(40, 2, [&](int frame, auto) {
    if (frame == 20 && getpid() != here) _exit(3);
    return Numbered(frame);
  });
  ASSERT_TRUE(film);
  int frames = 0;
  auto picture = film->Next();
  for (; picture && frames < 40; picture = film->Next()) ++frames;
  EXPECT_EQ(frames, 20);
  EXPECT_THAT(ToString(picture.error()), ::testing::HasSubstr("drawing process"));
}

TEST(EncodeFrames, GivesTheSameFileForAnyNumberOfProcesses) {
  const TemporaryFolder folder = *TemporaryFolder::Make("film-test");
  std::vector<std::string> films;
  for (const int jobs : {1, 3}) {
    const auto path = folder.path() / "film.mp4";
    ASSERT_OK(made, EncodeFrames(path, 30, 30, Numbered, {.jobs = jobs}));
    films.push_back(*ReadWholeFile(path));
  }
  EXPECT_GT(films[0].size(), 1000u);
  EXPECT_EQ(films[0], films[1]);
}

}  // namespace
}  // namespace etude
