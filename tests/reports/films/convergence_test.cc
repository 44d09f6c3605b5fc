#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "reports/films/convergence_scene.h"
#include "reports/films/ik_race.h"
#include "reports/films/media.h"
#include "reports/scenario_card.h"
#include "tests/reports/films/race_run.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr Paint kCurveRed{1, 0, 0, 1};

// The range of columns with pixels of the pure colour; first > last if there are none.
struct Columns {
  int first = 1 << 20, last = -1;
};
Columns ColumnsOf(const ColourImage& pixels, Rgb8 colour) {
  Columns columns;
  for (int y = 0; y < pixels.height; ++y) {
    for (int x = 0; x < pixels.width; ++x) {
      if (pixels.At(x, y) != colour) continue;
      columns.first = std::min(columns.first, x);
      columns.last = std::max(columns.last, x);
    }
  }
  return columns;
}

Columns CurveAt(const ErrorPlot& plot, double iteration) {
  Canvas canvas(622, 244);
  plot.Draw(canvas, {0, 0, 622, 244}, iteration);
  return ColumnsOf(canvas.Pixels(), {255, 0, 0});
}

TEST(ErrorPlot, DrawsTheCurveAsFarAsItIsKnown) {
  const RaceClock clock(100);
  const ErrorPlot plot("error, cm", " cm", 0.1, {{{0, 1, 10, 100}, {40, 3, 0.5, 0.01}, kCurveRed}}, clock);
  const Columns start = CurveAt(plot, 0), middle = CurveAt(plot, 50), end = CurveAt(plot, 100);
  const double length = end.last - start.last;
  EXPECT_NEAR(end.first, start.first, 6);  // the dot, first at the curve's start, has moved on
  EXPECT_NEAR((middle.last - start.last) / length, clock.ShareOf(10), 0.01);
  EXPECT_GT(length, 400);
}

TEST(ErrorPlot, KeepsWhatIsTooSmallOrNothingAtTheLowerEdge) {
  const ErrorPlot plot("error, cm", " cm", 0.1, {{{0, 1, 2}, {40, 1e-12, 0}, kCurveRed}}, RaceClock(2));
  Canvas canvas(622, 244);
  plot.Draw(canvas, {0, 0, 622, 244}, 2);
  const ColourImage pixels = canvas.Pixels();
  int lowest = 0;
  for (int y = 0; y < pixels.height; ++y) {
    for (int x = 0; x < pixels.width; ++x) lowest = pixels.At(x, y) == Rgb8{255, 0, 0} ? y : lowest;
  }
  EXPECT_GT(lowest, 180);
  EXPECT_LT(lowest, 200);
}

TEST(ErrorPlot, ShowsAMethodThatNeverMoved) {
  const ErrorPlot plot("error, cm", " cm", 0.1, {{{0}, {0.05}, kCurveRed}}, RaceClock(0));
  EXPECT_LE(CurveAt(plot, 0).first, CurveAt(plot, 0).last);
}

class Convergence : public ::testing::Test {
 protected:
  // "early" ends at iteration 9, "late" at iteration 60.
  static RunData Run() {
    return RaceRun({{"early", 0, 1, EveryIteration(9)},
                    {"late", 0, 0.02, EveryIteration(60), Status::kUnsolved, "12° after 60 sweeps"}});
  }
  void SetUp() override {
    ASSERT_OK(renderer, SharedRenderer());
    renderer_ = *renderer;
    const RunData run = Run();
    auto race = FindIkRace(run, run.scenarios.front());
    ASSERT_TRUE(race.has_value()) << ToString(race.error());
    race_ = std::move(*race);
  }

  // Compares one panel's inside; the left panel shows `early`, the right one `late`.
  static bool SameHalf(const ColourImage& a, const ColourImage& b, bool right) {
    const int first = right ? 640 : 0;
    for (int y = 52; y < 452; ++y) {
      for (int x = first; x < first + 640; ++x) {
        if (a.At(x, y) != b.At(x, y)) return false;
      }
    }
    return true;
  }

  Renderer* renderer_ = nullptr;
  IkRace race_;
};

TEST_F(Convergence, AMethodThatHasEndedWaitsForTheOther) {
  ConvergenceScene scene(race_, "race", *renderer_);
  const RaceClock clock(60);
  int ended = 0;
  while (clock.IterationAt(ended) < 9) ++ended;
  const ColourImage before = scene.Draw(ended - 20).Pixels();
  const ColourImage then = scene.Draw(ended).Pixels();
  const ColourImage last = scene.Draw(scene.Frames() - 1).Pixels();
  EXPECT_FALSE(SameHalf(before, then, false));
  EXPECT_TRUE(SameHalf(then, last, false));
  EXPECT_FALSE(SameHalf(then, last, true));
}

TEST_F(Convergence, TheSameRaceGivesTheSamePictures) {
  ConvergenceScene scene(race_, "race", *renderer_), again(race_, "race", *renderer_);
  scene.Draw(0);
  EXPECT_EQ(scene.Draw(100).Pixels().pixels, again.Draw(100).Pixels().pixels);
}

TEST_F(Convergence, TellsInWordsWhoSolvedItAndWhoDidNot) {
  const ConvergenceScene scene(race_, "race", *renderer_);
  EXPECT_THAT(scene.Words(), HasSubstr("early on the left (solved at iteration 6)"));
  EXPECT_THAT(scene.Words(), HasSubstr("late on the right (not solved: 12° after 60 sweeps)"));
  EXPECT_THAT(scene.Words(), HasSubstr("trial 0, the first world with recordings of both methods"));
  EXPECT_EQ(scene.PosterFrame(), scene.Frames() - 1);
}

TEST_F(Convergence, RingsMarkTheTargetsNotTheTruth) {
  const IkPath& path = race_.paths[0];
  const Paint white{1, 1, 1, 1};
  const auto met = ConvergenceStage(race_, *renderer_, 622, 400).Picture(*renderer_, path.poses.back(), white);
  EXPECT_THAT(ConvergenceScene(race_, "race", *renderer_).Words(), HasSubstr("rings: the targets of right foot"));
  *race_.targets[1] += glm::dvec3(0.2, 0, 0);
  const auto moved = ConvergenceStage(race_, *renderer_, 622, 400).Picture(*renderer_, path.poses.back(), white);
  EXPECT_NE(met.pixels, moved.pixels);
  race_.targets.fill(std::nullopt);
  const auto none = ConvergenceStage(race_, *renderer_, 622, 400).Picture(*renderer_, path.poses.back(), white);
  EXPECT_NE(met.pixels, none.pixels);
  EXPECT_THAT(ConvergenceScene(race_, "race", *renderer_).Words(), Not(HasSubstr("rings")));
}

TEST_F(Convergence, TheCounterRunsOnBetweenRecordedIterations) {
  const RunData run = RaceRun({{"a", 0, 0.1, {0, 1, 100}}, {"b", 0, 0.1, {0, 1, 100}}});
  auto race = FindIkRace(run, run.scenarios.front());
  ASSERT_TRUE(race.has_value()) << ToString(race.error());
  ConvergenceScene scene(std::move(*race), "race", *renderer_);
  const RaceClock clock(100);
  int tenth = 0, fiftieth = 0;
  while (clock.IterationAt(tenth) < 10) ++tenth;
  while (clock.IterationAt(fiftieth) < 50) ++fiftieth;
  EXPECT_FALSE(SameHalf(scene.Draw(tenth).Pixels(), scene.Draw(fiftieth).Pixels(), false));
}

TEST_F(Convergence, BodiesStandInThePictureRightOfTheWords) {
  const ConvergenceStage stage(race_, *renderer_, 622, 400);
  const IkPath& path = race_.paths[0];
  const auto picture = stage.Picture(*renderer_, path.poses.front(), {1, 0, 0, 1});
  int left = picture.width, right = 0, top = picture.height, bottom = 0, red = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const std::uint32_t seen = picture.At(x, y);
      const auto level = [&](int shift) { return static_cast<std::uint8_t>(seen >> shift); };
      const Rgb8 pixel{level(16), level(8), level(0)};
      if (pixel.r < 60 || pixel.g > pixel.r / 3 || pixel.b > pixel.r / 3) continue;
      ++red;
      left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
    }
  }
  EXPECT_GT(red, 3000);
  EXPECT_GT(left, 0.34 * picture.width);
  EXPECT_LT(right, picture.width - 1);
  EXPECT_GT(top, 0);
  EXPECT_LT(bottom, picture.height - 1);
}

TEST_F(Convergence, ShowsNoErrorsOfWhatWasNotAskedFor) {
  for (IkPath& path : race_.paths) std::ranges::fill(path.orientation_deg, 0);
  ConvergenceScene positions(race_, "race", *renderer_);
  const ColourImage pixels = positions.Draw(positions.Frames() - 1).Pixels();
  // The second method's colour (io/drawing/marks.h) is in the plot of positions, but not in that of orientations.
  ASSERT_EQ(race_.paths[1].method_index, 1u);
  const Rgb8 teal{0x9f, 0xf5, 0xd4};
  int left = 0, right = 0;
  for (int y = 464; y < 708; ++y) {
    for (int x = 0; x < pixels.width; ++x) (x < 640 ? left : right) += pixels.At(x, y) == teal;
  }
  EXPECT_GT(left, 500);
  EXPECT_EQ(right, 0);
}

TEST(ScenarioFilms, SayWhyThereAreNone) {
  RunData run = RaceRun({{"a", 0, 1, EveryIteration(3)}, {"b", 0, 1, {}}});
  const fs::path folder = fs::path(::testing::TempDir()) / "etude_no_films";
  fs::remove_all(folder);
  const Media media = MakeMedia(run, {.films = folder, .pictures = folder});
  ASSERT_EQ(media.scenario_films.size(), 1u);
  EXPECT_EQ(media.scenario_films[0].scenario, "race");
  EXPECT_EQ(media.scenario_films[0].film.file, "convergence.mp4");
  EXPECT_THAT(media.scenario_films[0].film.why_not, HasSubstr("recordings of only one method"));
  EXPECT_THAT(FilmElement(media.scenario_films[0].film, false), HasSubstr("recordings of only one method"));
  EXPECT_FALSE(fs::exists(folder));
}

TEST(ScenarioFilms, HaveNamesOfTheirOwnWhenThereAreSeveral) {
  RunData run = RaceRun({{"a", 0, 1, {}}});
  run.scenarios.push_back(run.scenarios.front());
  run.scenarios.back().name = "../other";
  const Media media = MakeMedia(run, {.films = "nowhere", .pictures = "nowhere"});
  ASSERT_EQ(media.scenario_films.size(), 2u);
  EXPECT_EQ(media.scenario_films[0].film.file, "convergence-race.mp4");
  EXPECT_EQ(media.scenario_films[1].film.file, "convergence-___other-2.mp4");
}

TEST(Film, IsItsPosterAndTheReasonWhenItCannotBeEncoded) {
  class Still : public Scene {
    int Frames() const override { return 2; }
    int PosterFrame() const override { return 1; }
    std::string Words() const override { return "nothing <much>"; }
    Canvas Draw(int) override { return BeginFrame("still"); }
  } scene;
  const fs::path file = fs::path(::testing::TempDir()) / "etude_file_not_folder";
  std::FILE* made = std::fopen(file.c_str(), "w");
  ASSERT_NE(made, nullptr);
  std::fclose(made);
  const Film film = Shoot(scene, file / "film.mp4");
  EXPECT_TRUE(film.mp4.empty());
  EXPECT_TRUE(film.poster.png.starts_with("\x89PNG"));
  EXPECT_THAT(film.why_not, HasSubstr("only this picture"));
  const std::string element = FilmElement(film, true);
  EXPECT_THAT(element,
              HasSubstr("nothing &lt;much&gt; Etude made only this picture, because it could not make the film"));
  EXPECT_THAT(element, Not(HasSubstr("<video")));
  const Film whole = Shoot(scene, fs::path(::testing::TempDir()) / "etude_still" / "film.mp4");
  EXPECT_EQ(whole.why_not, "");
  EXPECT_THAT(FilmElement(whole, true), HasSubstr("autoplay"));
  EXPECT_THAT(FilmElement(whole, true), HasSubstr("<a href=\"../video/film.mp4\">video/film.mp4</a>"));
  EXPECT_THAT(FilmElement(whole, false), Not(HasSubstr("autoplay")));
}

}  // namespace
}  // namespace etude
