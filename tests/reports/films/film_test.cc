#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/model/recording.h"
#include "bench/recordings/capture_extras.h"
#include "io/drawing/canvas.h"
#include "reports/films/capture_panel.h"
#include "reports/films/capture_scene.h"
#include "reports/films/shown_cell.h"
#include "tests/reports/support/example_run.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

// The panel's colour for the body's left side, as cairo draws it.
constexpr Rgb8 kLeftBone{255, 204, 76};

TEST(Canvas, ShowsAnImageWhereItWasPut) {
  ColourImage red(4, 4, {200, 10, 20});
  Canvas canvas(20, 10);
  canvas.DrawImage(red, {10, 0, 10, 10});
  const ColourImage pixels = canvas.Pixels();
  EXPECT_EQ(pixels.At(15, 5), (Rgb8{200, 10, 20}));
  EXPECT_EQ(pixels.At(5, 5), (Rgb8{0, 0, 0}));
  EXPECT_TRUE(canvas.Png().starts_with("\x89PNG"));
}

TEST(Canvas, CutsTextThatDoesNotFit) {
  Canvas canvas(300, 40);
  canvas.DrawText({0, 30}, std::string(200, 'W'), 20, {1, 1, 1, 1}, 100);
  const ColourImage pixels = canvas.Pixels();
  int inside = 0, outside = 0;
  for (int y = 0; y < pixels.height; ++y) {
    for (int x = 0; x < pixels.width; ++x) (x <= 101 ? inside : outside) += pixels.At(x, y).r > 0;
  }
  EXPECT_GT(inside, 100);
  EXPECT_EQ(outside, 0);
}

TEST(Canvas, DrawsTextThatIsALittleTooWideSmaller) {
  const std::string text = "as the sensor saw it";
  const auto drawn = [&](double size, double room) {
    Canvas canvas(300, 40);
    canvas.DrawText({0, 30}, text, size, {1, 1, 1, 1}, room);
    return canvas.Pixels().pixels;
  };
  const double width = Canvas(300, 40).TextWidth(text, 20);
  const auto shown = drawn(20, 0.85 * width);
  bool is_whole = false;
  for (double size = 15; size < 20; size += 0.25) is_whole = is_whole || shown == drawn(size, width);
  EXPECT_TRUE(is_whole) << "no letter is lost";
  EXPECT_NE(shown, drawn(20, width));
}

TEST(Outline, IsTheRimOfTheMask) {
  Mask mask(7, 7);
  for (int y = 1; y < 6; ++y) {
    for (int x = 1; x < 6; ++x) mask.At(x, y) = 1;
  }
  const Mask outline = OutlineOf(mask);
  int set = 0;
  for (const auto pixel : outline.pixels) set += pixel;
  EXPECT_EQ(set, 16);
  EXPECT_EQ(outline.At(3, 3), 0);
  EXPECT_EQ(outline.At(1, 3), 1);
}

TEST(Cast, PrefersATypicalCellOfTheMethodThatAnswers) {
  RunData run = ExampleRun();
  const Recording recording{{{"recovered", BodyMotion{30, {BodyPose{}}}}}, "{}"};
  for (const Row& row : run.rows) {
    // Trials 2…10; the error grows with the trial, so the median trial is 6.
    if (row.scenario == "capture" && row.trial >= 2 && row.trial <= 10) run.recordings.push_back({row.Id(), recording});
  }
  ASSERT_OK(chosen, ChooseCell(run, "capture", "recovered"));
  EXPECT_EQ(chosen->row->method, "ccd-fixed");
  EXPECT_EQ(chosen->row->trial, 6);
  EXPECT_FALSE(ChooseCell(run, "capture", "coach").has_value());
  EXPECT_FALSE(ChooseCell(run, "transition", "coach").has_value());
}

TEST(CapturePanel, RefusesMasksThatDoNotFitTheMotion) {
  RunData run = ExampleRun();
  AddRecordings(run);
  auto& recording = run.recordings.back().recording;
  recording.tracks.front().motion.poses.pop_back();
  EXPECT_THAT(testing::Refusal(CapturePanel::Make(run, *ChooseCell(run, "capture", "recovered"))),
              HasSubstr("differ in length"));
}

TEST(CapturePanel, DrawsTheSkeletonOverThePersonAndKeepsBothInThePicture) {
  RunData run = ExampleRun();
  AddRecordings(run);
  ASSERT_OK(panel, CapturePanel::Make(run, *ChooseCell(run, "capture", "recovered")));
  ASSERT_OK(renderer, SharedRenderer());
  Canvas canvas(432, 324);
  panel->Draw(canvas, **renderer, 0, 20);
  const ColourImage pixels = canvas.Pixels();
  int bones = 0, highest = pixels.height, lowest = 0;
  for (int y = 0; y < pixels.height; ++y) {
    for (int x = 0; x < pixels.width; ++x) {
      if (pixels.At(x, y) != kLeftBone) continue;
      ++bones;
      highest = std::min(highest, y);
      lowest = std::max(lowest, y);
    }
  }
  EXPECT_GT(bones, 100);
  // Cropped to the person: from the raised hand to the foot it fills most of the picture's height.
  EXPECT_GT(lowest - highest, pixels.height / 2);
  EXPECT_GT(highest, 0);
  EXPECT_LT(lowest, pixels.height - 1);
}

// Returns the plate of the example's capture, whose recording has these moments.
std::optional<Picture> PlateOf(const std::vector<CaptureExtras::Moment>& moments, Renderer& renderer) {
  RunData run = ExampleRun();
  AddRecordings(run);
  Recording& recording = run.recordings.back().recording;
  auto extras = ReadCaptureExtras(recording.extras_json);
  extras->moments = moments;
  recording.extras_json = WriteCaptureExtras(*extras);
  return DrawPlate(*CapturePanel::Make(run, *ChooseCell(run, "capture", "recovered")), renderer);
}

TEST(CapturePlate, ShowsEveryStageOfTheMomentsThatAreKeptAndTheSequence) {
  ASSERT_OK(renderer, SharedRenderer());
  EXPECT_FALSE(PlateOf({}, **renderer)) << "a recording that keeps none";
  const CaptureExtras::Moment early{.frame = 0, .fixed = {}, .marks = {{{{300, 100}, {340, 300}, {255, 0, 0}}}, {}}};
  CaptureExtras::Moment late = early, unmarked = early;
  late.frame = 17;
  unmarked.marks[0].clear();
  const auto one = PlateOf({early}, **renderer), two = PlateOf({early, late}, **renderer);
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->width, two->width);
  EXPECT_EQ((two->height - one->height) * 5, (one->height - 28) * 2) << "two rows more than five: one for each camera";
  EXPECT_NE(one->png, PlateOf({unmarked}, **renderer)->png) << "marks are drawn";
  EXPECT_NE(one->png, PlateOf({late}, **renderer)->png);
  EXPECT_THAT(one->caption, HasSubstr("figures 5.3 to 5.15"));
}

TEST(CaptureScene, ShowsTheMethodsOfOneWorldSideBySideAndColoursTheirErrors) {
  RunData run = ExampleRun();
  AddRecordings(run);
  // The same capture by another method, with one hand half a metre too high.
  const ShownCell first = *ChooseCell(run, "capture", "recovered");
  CellRecording worse = run.recordings.back();
  worse.cell = [&] {
    Row row = *first.row;
    row.method = "ccd-fixed";
    return row.Id();
  }();
  for (Track& track : worse.recording.tracks) {
    if (track.name != "recovered") continue;
    for (BodyPose& pose : track.motion.poses) pose[Role::kLeftHand].y += 0.5;
  }
  ASSERT_OK(alone, FindCaptures(run, first));
  EXPECT_EQ(alone->size(), 1u);
  run.recordings.push_back(worse);
  ASSERT_OK(both, FindCaptures(run, *ChooseCell(run, "capture", "recovered")));
  ASSERT_EQ(both->size(), 2u);
  CaptureScene scene(**SharedRenderer(), *both);
  EXPECT_THAT(scene.Words(), HasSubstr("the skeleton that ccd-fixed and ccd-adaptive recovered"));
  const ColourImage picture = scene.Draw(scene.PosterFrame()).Pixels();
  const auto red_from = [&](int from, int to) {
    int red = 0;
    for (int y = 130; y < 640; ++y) {
      for (int x = from; x < to; ++x) {
        const Rgb8 pixel = picture.At(x, y);
        red += pixel.r > 240 && pixel.g < 90 && pixel.b < 90;
      }
    }
    return red;
  };
  EXPECT_GT(red_from(460, 858), 40) << "the hand";
  EXPECT_EQ(red_from(866, 1264), 0) << "the other method is not as far off";
}

}  // namespace
}  // namespace etude
