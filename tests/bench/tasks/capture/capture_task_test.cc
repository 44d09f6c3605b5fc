#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/recordings/capture_extras.h"
#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/capture/score.h"
#include "engine/cameras/pose2sim_file.h"
#include "engine/document/node.h"
#include "engine/formats/bvh.h"
#include "tests/bench/tasks/base/cell_values.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"
#include "tests/support/run_world.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

const WorldKey kKey{.suite_seed = 3, .scenario = "capture-test", .trial = 0};

Result<std::unique_ptr<Task>> Make(const std::string& yaml, const std::map<std::string, std::string>& texts = {}) {
  ASSIGN_OR_RETURN(const auto node, ParseYaml(yaml, "test.yaml"));
  ASSIGN_OR_RETURN(const auto clips, LoadClips({"builtin:boxing"}, {}));
  Fields condition(node, "a test");
  TaskInput input{condition, node.Find("methods")->items, clips, texts};
  auto task = MakeCaptureTaskKind().make(input);
  if (task && !condition.ok()) return tl::unexpected(condition.Finish().error());
  return task;
}

TEST(CaptureTask, ShowsEveryMethodTheSameMarksAndRepeatsItself) {
  ASSERT_OK(
      task,
      Make("duration_s: 0.1\nmethods:\n- {name: fixed, solver: ccd, weights: fixed}\n- {name: adaptive, solver: ccd, "
           "weights: adaptive}\n"));
  EXPECT_EQ((*task)->ClipsOf(kKey).front(), "builtin:boxing");
  const auto cells = RunWorld(**task, kKey, 2), again = RunWorld(**task, kKey, 2);
  ASSERT_EQ(cells.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(cells[i].status, Status::kOk) << cells[i].reason;
    EXPECT_EQ(cells[i].digests, again[i].digests);
  }
  for (const char* stage : {"calibration", "pictures", "masks", "marks", "directions", "points", "lengths"}) {
    EXPECT_EQ(DigestOf(cells[0], stage), DigestOf(cells[1], stage)) << stage;
  }
  EXPECT_NE(DigestOf(cells[0], "pose"), DigestOf(cells[1], "pose"));
  EXPECT_GT(*ValueOf(cells[0], "iou"), 0.9);
  EXPECT_LT(*ValueOf(cells[0], "mpjpe_mm"), 150);
  EXPECT_EQ(cells[0].series[0].values.size(), 3u);
}

TEST(CaptureTask, ComesCloseToTheTruthWhenEveryStageIsOne) {
  ASSERT_OK(task, Make("duration_s: 0.1\nmethods:\n- {name: seen}\n"
                       "- {name: true, oracle: [calibration, segmentation, directions, points]}\n"));
  const auto cells = RunWorld(**task, kKey, 2);
  EXPECT_NEAR(*ValueOf(cells[1], "limb_direction_error_deg"), 0, 1e-6);
  EXPECT_NEAR(*ValueOf(cells[1], "triangulation_error_mm"), 0, 1e-9);
  EXPECT_EQ(*ValueOf(cells[1], "iou"), 1);
  EXPECT_LT(*ValueOf(cells[1], "mpjpe_mm"), 1) << "all that nobody sees of this body is its spine";
  EXPECT_GT(*ValueOf(cells[0], "mpjpe_mm"), *ValueOf(cells[1], "mpjpe_mm"));
  EXPECT_GT(*ValueOf(cells[0], "limb_direction_error_deg"), 1);
}

TEST(CaptureTask, GivesThePerformerBackWhenItStartsThereAndPaperBsBodyDoesNot) {
  ASSERT_OK(task,
            Make("duration_s: 0.1\nlimb_measure_mm: 15\nmethods:\n"
                 "- {name: true, oracle: [calibration, segmentation, directions, points, lengths, start]}\n"
                 "- {name: ccd, solver: ccd, oracle: [calibration, segmentation, directions, points, lengths, start]}\n"
                 "- {name: measured, oracle: [calibration, segmentation, directions, points, start]}\n"
                 "- {name: paper, body: paper, oracle: [calibration, segmentation, directions, points, lengths, start, "
                 "ik]}\n"));
  const auto cells = RunWorld(**task, kKey, 4);
  EXPECT_LT(*ValueOf(cells[0], "mpjpe_mm"), 1e-6);
  EXPECT_LT(*ValueOf(cells[1], "mpjpe_mm"), 1e-6);
  EXPECT_GT(*ValueOf(cells[2], "mpjpe_mm"), 3) << "limbs that were measured 15 mm wrong";
  EXPECT_GT(*ValueOf(cells[3], "mpjpe_mm"), 1) << "what 29 degrees of freedom cannot express";
}

TEST(CaptureTask, MarksTrueJointsWhereItIsToldTo) {
  ASSERT_OK(task, Make("duration_s: 0.1\nannotation_error_px: 4\nmethods:\n- {name: seen, oracle: [calibration]}\n"
                       "- {name: marks, oracle: [calibration, marks]}\n"));
  const auto cells = RunWorld(**task, kKey, 2);
  EXPECT_LT(*ValueOf(cells[1], "triangulation_error_mm"), 1e-6);
  EXPECT_LT(*ValueOf(cells[1], "limb_direction_error_deg"), 1e-4);
  EXPECT_GT(*ValueOf(cells[0], "triangulation_error_mm"), 5) << "the control";
  EXPECT_NE(DigestOf(cells[0], "marks"), DigestOf(cells[1], "marks"));
  EXPECT_EQ(DigestOf(cells[0], "masks"), DigestOf(cells[1], "masks"));
}

TEST(CaptureTask, HEAVY_SetsItsClocksByTheMarks) {
  ASSERT_OK(
      task,
      Make(
          "duration_s: 3\nsync_offset_ms: 100\nmethods:\n"
          "- {name: assumed, oracle: [calibration, marks]}\n- {name: estimated, sync: estimated, oracle: [calibration, "
          "marks]}\n"));
  const auto cells = RunWorld(**task, kKey, 2);
  EXPECT_LT(*ValueOf(cells[1], "triangulation_error_mm"), 0.3 * *ValueOf(cells[0], "triangulation_error_mm"));
  EXPECT_GT(*ValueOf(cells[0], "triangulation_error_mm"), 10) << "three frames apart";
}

TEST(CaptureTask, RecoversTheSameMarksInOtherWaysToo) {
  ASSERT_OK(
      task,
      Make("duration_s: 0.3\nmethods:\n- {name: ik, body: paper}\n- {name: ends, recovery: ends}\n"
           "- {name: smooth, recovery: ends, smoothing: rts}\n- {name: bundle, recovery: bundle}\n"
           "- {name: measured, recovery: bundle, lengths: measured}\n- {name: keypoints, recovery: keypoints}\n"));
  const auto cells = RunWorld(**task, kKey, 6);
  for (const CellResult& cell : cells) {
    ASSERT_EQ(cell.status, Status::kOk) << cell.reason;
    EXPECT_EQ(DigestOf(cell, "marks"), DigestOf(cells[0], "marks"));
    EXPECT_LT(*ValueOf(cell, "mpjpe_mm"), 100);
    EXPECT_TRUE(ValueOf(cell, "mpjpe_seen_mm"));
    EXPECT_FALSE(ValueOf(cell, "mpjpe_held_mm")) << "every frame is marked";
  }
  EXPECT_FALSE(ValueOf(cells[1], "mpjpe_before_ik_mm")) << "there is no inverse kinematics";
  EXPECT_LT(*ValueOf(cells[2], "jerk_error_mps3"), 0.5 * *ValueOf(cells[1], "jerk_error_mps3"));
  EXPECT_LT(*ValueOf(cells[3], "bone_length_error_cm"), *ValueOf(cells[1], "bone_length_error_cm"));
  EXPECT_FALSE(ValueOf(cells[3], "limb_length_error_mm")) << "lengths are known";
  EXPECT_LT(*ValueOf(cells[4], "limb_length_error_mm"), 60);
  EXPECT_LT(*ValueOf(cells[5], "limb_length_error_mm"), 60) << "it measures them";
  EXPECT_LT(*ValueOf(cells[5], "bone_length_error_cm"), *ValueOf(cells[1], "bone_length_error_cm"));
}

TEST(CaptureTask, EveryRivalSeesMarksInTimeAndWithoutOutliers) {
  ASSERT_OK(task, Make("duration_s: 1\nsync_offset_ms: 100\nmethods:\n"
                       "- {name: assumed, recovery: bundle, oracle: [calibration, marks]}\n"
                       "- {name: estimated, recovery: bundle, sync: estimated, oracle: [calibration, marks]}\n"));
  const auto cells = RunWorld(**task, kKey, 2);
  EXPECT_LT(*ValueOf(cells[1], "mpjpe_mm"), 0.7 * *ValueOf(cells[0], "mpjpe_mm"));
}

TEST(CaptureTask, RefusesTheTruthOfStagesThatAMethodHasNot) {
  EXPECT_THAT(testing::Refusal(Make("methods:\n- {name: ends, recovery: ends, oracle: [directions]}\n")),
              HasSubstr("recovery: ik"));
}

TEST(CaptureTask, IsCalibratedWithPointsOrWithBoardsFoundInThePictures) {
  const std::string methods = "methods:\n- {name: a, calibration: dlt-normalised, oracle: [segmentation]}\n";
  const auto errors = [&](const std::string& condition) {
    const auto task = Make("duration_s: 0.1\nannotation_error_px: 0\n" + condition + methods);
    EXPECT_TRUE(task) << ToString(task.error());
    const auto cells = RunWorld(**task, kKey, 1);
    EXPECT_EQ(cells[0].status, Status::kOk) << cells[0].reason;
    return std::pair(ValueOf(cells[0], "reprojection_rms_px").value_or(99),
                     ValueOf(cells[0], "triangulation_error_mm").value_or(999));
  };
  const auto exact = errors("calibration_noise_px: 0\n");
  EXPECT_NEAR(exact.first, 0, 1e-9);
  const auto boards = errors("calibration_target: boards\n");
  EXPECT_GT(boards.first, 0.02) << "corners are found, not known";
  EXPECT_LT(boards.first, 0.8);
  EXPECT_LT(boards.second, exact.second + 15);
  EXPECT_GT(errors("calibration_target: boards\ncalibration_measure_mm: 20\n").first, boards.first);
  EXPECT_GT(errors("calibration_noise_px: 0\ncalibration_measure_mm: 20\n").first, 1);
}

// In everyday clothes the trunk's hues are lost, so the silhouette falls into pieces. Several pieces together cover
// more of the person than the largest piece does.
TEST(CaptureTask, FindsMoreOfThePersonInSeveralPieces) {
  ASSERT_OK(
      task,
      Make("duration_s: 0.1\nclothes: everyday\nmethods:\n- {name: largest, segmenter: hue}\n"
           "- {name: large, segmenter: hue, pieces: large}\n- {name: true, pieces: large, oracle: [segmentation]}\n"));
  const auto cells = RunWorld(**task, kKey, 3);
  EXPECT_GT(*ValueOf(cells[1], "mask_recall"), *ValueOf(cells[0], "mask_recall") + 0.01);
  EXPECT_EQ(*ValueOf(cells[2], "mask_recall"), 1) << "the truth has no pieces";
  EXPECT_NE(DigestOf(cells[0], "marks"), DigestOf(cells[1], "marks"));
}

TEST(CaptureTask, MakesASkeletonOfWhatIsMarkedAndSaysHowLittleThatWas) {
  // Hue cannot tell dark blue trousers from a bluish floor, so the feet are never marked.
  ASSERT_OK(task, Make("duration_s: 0.1\nclothes: everyday\nmethods:\n- {name: hue, segmenter: hue}\n"));
  const auto cells = RunWorld(**task, kKey, 1);
  EXPECT_EQ(cells[0].status, Status::kOk) << cells[0].reason;
  EXPECT_LT(*ValueOf(cells[0], "triangulation_coverage"), 0.9);
  EXPECT_LT(*ValueOf(cells[0], "limb_direction_coverage"), 0.9);
  EXPECT_EQ(ValueOf(cells[0], "frames_recovered"), 1);
  EXPECT_TRUE(ValueOf(cells[0], "mpjpe_mm"));
}

TEST(CaptureTask, FollowsSilhouettesWithoutAMark) {
  ASSERT_OK(task, Make("duration_s: 0.2\nmethods:\n- {name: near, recovery: silhouettes, start: near}\n"
                       "- {name: cold, recovery: silhouettes}\n- {name: strokes}\n"));
  const auto cells = RunWorld(**task, kKey, 3, true), again = RunWorld(**task, kKey, 2);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(cells[i].status, Status::kOk) << cells[i].reason;
    EXPECT_EQ(cells[i].digests, again[i].digests);
    EXPECT_EQ(ValueOf(cells[i], "frames_recovered"), 1);
    EXPECT_LT(*ValueOf(cells[i], "mpjpe_mm"), 60);
    EXPECT_FALSE(ValueOf(cells[i], "mpjpe_before_ik_mm")) << "there is no inverse kinematics";
    EXPECT_FALSE(ValueOf(cells[i], "limb_direction_error_deg")) << "no limb was marked";
    EXPECT_TRUE(cells[i].recording);
  }
  EXPECT_EQ(DigestOf(cells[0], "pictures"), DigestOf(cells[2], "pictures"));
  EXPECT_FALSE(Make("methods:\n- {name: a, start: near}\n")) << "strokes start from nothing";
}

TEST(CaptureTask, FailsWithAReasonWhenNothingIsMarked) {
  CaptureWorld world;
  world.truth.resize(2);
  world.in_view = {true, true};
  const CaptureMethod method;
  const CalibratedCameras cameras;
  const Take take;
  const Observation observation{};
  const CaptureBody body = PaperBody({});
  const MeasuredTake measured{.marks = {},
                              .frames = std::vector<FrameMeasurement>(2),
                              .seen = {},
                              .joints = {},
                              .directions_digest = "",
                              .points_digest = ""};
  const CaptureRun run{.method = method,
                       .cameras = cameras,
                       .take = take,
                       .observation = observation,
                       .measured = measured,
                       .body = body,
                       .frames = {std::nullopt, std::nullopt}};
  const CellResult cell = ScoreCaptureRun(world, run, false);
  EXPECT_EQ(cell.status, Status::kFailed);
  EXPECT_THAT(cell.reason, HasSubstr("no end effector was ever marked in the pictures of two cameras"));
  EXPECT_FALSE(ValueOf(cell, "mpjpe_mm"));
  EXPECT_EQ(ValueOf(cell, "frames_recovered"), 0);
}

TEST(CaptureTask, RecordsWhatAVideoAndABvhFileNeed) {
  ASSERT_OK(task, Make("duration_s: 0.1\nmark_every: 2\nmethods:\n- {name: a}\n"));
  const auto cells = RunWorld(**task, kKey, 1, true);
  ASSERT_TRUE(cells[0].recording) << cells[0].reason;
  ASSERT_EQ(cells[0].recording->tracks.size(), 2u);
  EXPECT_EQ(cells[0].recording->tracks[0].name, "truth");
  EXPECT_EQ(cells[0].recording->tracks[1].name, "recovered");
  EXPECT_EQ(cells[0].recording->tracks[1].motion.poses.size(), 3u);
  ASSERT_OK(extras, ReadCaptureExtras(cells[0].recording->extras_json));
  ASSERT_EQ(extras->views.size(), 2u);
  EXPECT_EQ(extras->views[0].masks.size(), 3u);
  EXPECT_THAT(extras->views[0].still_jpeg_base64, ::testing::StartsWith("/9j/")) << "a JPEG begins with FF D8 FF";
  EXPECT_NE(extras->views[0].still_jpeg_base64, extras->views[1].still_jpeg_base64);
  ASSERT_OK(clip, ReadBvh(extras->bvh, "a.bvh"));
  EXPECT_EQ(clip->frames.size(), 3u);
}

TEST(CaptureTask, FilmsWithOnesOwnCameras) {
  const std::string yaml =
      "duration_s: 0.1\nrig: file\nrig_file: mine.toml\nmethods:\n- {name: a, oracle: [calibration]}\n";
  const Intrinsics in{.width = 400, .height = 300, .fx = 380, .fy = 380, .cx = 200, .cy = 150};
  std::vector<NamedCamera> mine;
  for (const double x : {-2.0, 2.0, 3.0})
    mine.push_back({fmt::format("c{}", mine.size()), LookAt(in, {x, 1 + 0.3 * x, 3}, {0, 1, 0})});
  ASSERT_OK(task, Make(yaml, {{"rig_file", WritePose2SimCalibration(mine)}}));
  const auto cells = RunWorld(**task, kKey, 1, true);
  ASSERT_EQ(cells[0].status, Status::kOk) << cells[0].reason;
  ASSERT_OK(extras, ReadCaptureExtras(cells[0].recording->extras_json));
  ASSERT_EQ(extras->views.size(), 3u);
  EXPECT_EQ(extras->views[1].truth.intrinsics.width, 400);
  EXPECT_NEAR(extras->views[2].truth.p_WC.y, 1.9, 1e-9);
  // Outside methods are told the sizes of these cameras.
  ASSERT_OK(problem, (*task)->MakeWorld(kKey, false)->MakeProblem());
  const Json& told = (*problem->json)["cameras"];
  ASSERT_EQ(told.size(), 3u);
  EXPECT_EQ(told[1]["image_width"], 400);
  EXPECT_EQ(told[1]["image_height"], 300);

  const auto refusal = [&](const std::vector<NamedCamera>& cameras) {
    const auto refused = Make(yaml, {{"rig_file", WritePose2SimCalibration(cameras)}});
    return refused ? std::string() : ToString(refused.error());
  };
  EXPECT_THAT(refusal({mine[0]}), HasSubstr("has 1 cameras; allowed: 2 to 8"));
  std::vector<NamedCamera> huge = mine;
  huge[1].camera.intrinsics.width = 5000;
  EXPECT_THAT(refusal(huge), HasSubstr("camera 'c1' of 'mine.toml' takes pictures of 5000 × 300"));
  std::vector<NamedCamera> rational = mine, in_millimetres = mine;
  rational[1].camera.distortion.k4 = 0.1;
  EXPECT_THAT(refusal(rational), HasSubstr("camera 'c1' of 'mine.toml' has a lens model that scenarios cannot use"));
  in_millimetres[2].camera.p_WC *= 1000;
  EXPECT_THAT(refusal(in_millimetres), HasSubstr("check that the file is in metres"));
  EXPECT_THAT(testing::Refusal(Make("rig: file\nmethods:\n- {name: a}\n")), HasSubstr("needs the key 'rig_file'"));
}

// Without an annotator, the annotator's dice must not matter; only the picture does.
TEST(CaptureTask, HEAVY_ReadsTheColoursOfASuitWhateverAnAnnotatorWouldErr) {
  const std::string methods =
      "methods:\n- {name: colours, segmenter: rgb, pieces: large, marks: colours}\n"
      "- {name: human, segmenter: rgb, pieces: large}\n"
      "- {name: live, segmenter: rgb, pieces: large, marks: colours, causal: true}\n";
  for (const char* scene : {"0", "0.5"}) {
    const std::string studio = fmt::format("duration_s: 0.1\nclothes: coded\nscene: {}\n", scene);
    ASSERT_OK(steady, Make(studio + methods));
    ASSERT_OK(shaky, Make(studio + "annotation_error_px: 8\n" + methods));
    const auto cells = RunWorld(**steady, kKey, 3), others = RunWorld(**shaky, kKey, 3);
    for (const std::size_t coloured : {0u, 2u}) {
      EXPECT_EQ(cells[coloured].status, Status::kOk) << cells[coloured].reason;
      EXPECT_EQ(DigestOf(cells[coloured], "marks"), DigestOf(others[coloured], "marks"));
    }
    EXPECT_EQ(DigestOf(cells[0], "masks"), DigestOf(cells[1], "masks"));
    EXPECT_NE(DigestOf(cells[0], "marks"), DigestOf(cells[1], "marks"));
    EXPECT_NE(DigestOf(cells[1], "marks"), DigestOf(others[1], "marks")) << "the control";
    EXPECT_LT(*ValueOf(cells[0], "limb_direction_error_deg"), 6) << scene;
    EXPECT_LT(*ValueOf(cells[0], "triangulation_error_mm"), 20) << scene;
    EXPECT_GT(*ValueOf(others[1], "limb_direction_error_deg"), 10) << scene;
  }
}

}  // namespace
}  // namespace etude
