#include "bench/tasks/capture/exchange.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/metrics/measurement.h"
#include "bench/recordings/capture_extras.h"
#include "bench/tasks/base/pose_json.h"
#include "bench/tasks/base/task_kinds.h"
#include "engine/document/node.h"
#include "engine/formats/bvh.h"
#include "tests/bench/tasks/base/cell_values.h"
#include "tests/io/images/exr_files.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

const WorldKey kExchangeKey{.suite_seed = 3, .scenario = "capture-exchange", .trial = 0};

std::unique_ptr<Task> MakeTask(const std::string& yaml, std::vector<Node> methods = {}) {
  const Node node = *ParseYaml(yaml, "test.yaml");
  const ClipLibrary clips = *LoadClips({"builtin:boxing"}, {});
  Fields condition(node, "a test");
  TaskInput input{condition, methods, clips};
  return std::move(*MakeCaptureTaskKind().make(input));
}

const Attachment* Find(const Payload& payload, std::string_view name) {
  for (const Attachment& file : payload.files) {
    if (file.name == name) return &file;
  }
  ADD_FAILURE() << "no file " << name;
  return nullptr;
}

Marks MarksOf(const Json& json) {
  Marks marks;
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    const Json& s = json["strokes"][i];
    if (!s.is_null()) marks.strokes[i] = PixelSegment{{s[0], s[1]}, {s[2], s[3]}};
  }
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    const Json& d = json["discs"][i];
    if (!d.is_null()) marks.effectors[i] = glm::dvec2(d[0], d[1]);
  }
  return marks;
}

TEST(CaptureExchange, TellsTheMarksPicturesAndCalibrationPointsThatBuiltInMethodsSee) {
  const auto method = *ParseYaml("[{name: hue, oracle: [calibration]}]", "methods.yaml");
  const auto task = MakeTask("{duration_s: 0.1, mark_every: 2}", method.items);
  const auto world = task->MakeWorld(kExchangeKey, false);
  const CellResult built_in = world->Run(0);
  ASSERT_OK(problem, world->MakeProblem());
  const Json& json = *problem->json;
  ASSERT_EQ(json["frames"], 3);
  ASSERT_EQ(json["cameras"].size(), 2u);
  EXPECT_EQ(json["cameras"][0]["calibration"].size(), 24u);
  EXPECT_EQ(problem->files.size(), 1 + 2u * (1 + 3) + 2u * SegmenterNames().size())
      << "calibration points, pictures, and marks as COCO keypoints";
  EXPECT_TRUE(Find(*problem, json["cameras"][1]["background"].get<std::string>())->bytes.starts_with("\x89PNG"));
  EXPECT_EQ(json["cameras"][1]["pictures"][2], "camera-2-0002.png");

  const Json& marks = json["marks"]["hue"];
  EXPECT_TRUE(marks[0][1].is_null()) << "nobody looked at the second frame";
  // The problem's marks must give the limb directions of the built-in method, whose cameras are true.
  const CaptureWorld truth =
      MakeCaptureWorld({.duration_s = 0.1, .mark_every = 2}, LoadClips({"builtin:boxing"}, {})->clips[0], kExchangeKey);
  const std::vector<ProjectionMatrix> cameras = {MatrixOf(truth.cameras[0]), MatrixOf(truth.cameras[1])};
  std::vector<MeasuredAndTrue> limbs;
  for (std::size_t k : {0u, 2u}) {
    const std::vector<std::vector<Marks>> told = {{MarksOf(marks[0][k])}, {MarksOf(marks[1][k])}};
    const FrameMeasurement seen = MeasureFrames({.cameras = cameras, .marks = told}).at(0);
    const FrameMeasurement true_frame = TrueMeasurement(truth.truth[k]);
    for (std::size_t i = 0; i < kRoleCount; ++i) limbs.push_back({seen.directions[i], true_frame.directions[i]});
  }
  EXPECT_EQ(ValueOf(built_in, "limb_direction_error_deg"), LimbDirectionErrorDeg(limbs).mean);
  EXPECT_LT(*ValueOf(built_in, "limb_direction_coverage"), 0.7) << "a frame of three was not marked";
}

/// A take of three frames, its truth, and the truth judged as an answer.
struct ToldTake {
  std::unique_ptr<Task> task = MakeTask("{duration_s: 0.1, camera_distance_m: 2.5}");
  std::unique_ptr<TaskWorld> world = task->MakeWorld(kExchangeKey, true);
  Result<Payload> truth = world->MakeTruth();
  Result<void> pictures = world->MakeTruePictures([this](const Attachment& file) -> Result<void> {
    truth->files.push_back(file);
    return {};
  });
  Result<CellResult> cell = world->Judge(Json{{"poses", (*truth.value().json)["poses"]}});
};

const ToldTake& TakeThatIsTold() {
  static const ToldTake take;
  return take;
}

TEST(CaptureExchange, TheTruthIsAPerfectAnswerAndItsFilesTellTheSame) {
  const auto& [task, world, truth, pictures, cell] = TakeThatIsTold();
  ASSERT_TRUE(pictures) << ToString(pictures.error());
  ASSERT_TRUE(cell) << ToString(cell.error());
  EXPECT_EQ(cell->status, Status::kOk) << cell->reason;
  EXPECT_EQ(ValueOf(*cell, "mpjpe_mm"), 0);
  EXPECT_EQ(ValueOf(*cell, "frames_recovered"), 1);
  EXPECT_EQ(ValueOf(*cell, "iou"), std::nullopt);
  EXPECT_EQ(cell->series.size(), 1u);
  ASSERT_TRUE(cell->recording);
  EXPECT_TRUE(ReadCaptureExtras(cell->recording->extras_json));

  ASSERT_OK(clip, ReadBvh(Find(*truth, "truth.bvh")->bytes, "truth.bvh"));
  EXPECT_EQ(clip->frames.size(), 3u);
  EXPECT_THAT(Find(*truth, "truth.trc")->bytes, HasSubstr("hip_centre\t\t\tspine"));
  EXPECT_THAT(Find(*truth, "camera-2.yaml")->bytes, HasSubstr("!!opencv-matrix"));
  EXPECT_EQ((*truth->json)["labels"]["trunk"], 2);
  EXPECT_TRUE(Find(*truth, "camera-1-0002.exr")->bytes.starts_with("\x76\x2f\x31\x01")) << "OpenEXR's magic number";
}

TEST(CaptureExchange, TheTruthHoldsWhatDepthCamerasWouldMeasureInTheCamerasPlace) {
  const Result<Payload>& truth = TakeThatIsTold().truth;
  const std::string path =
      (std::filesystem::temp_directory_path() / fmt::format("etude-depth-{}.exr", getpid())).string();
  const auto depth = [&](const char* file, const char* channel) {
    std::ofstream(path, std::ios::binary) << Find(*truth, file)->bytes;
    return ExrFile(path).Depth(channel);
  };
  const DepthImage z = depth("camera-1-0001.exr", "Z");
  struct Case {
    const char* channel;
    double near, far, most_error_share;
  };
  for (const Case& c : {Case{"Z_measured.v1", 0.8, 4.0, 0.0135}, Case{"Z_measured.v2", 0.5, 4.5, 0.003}}) {
    const DepthImage measured = depth("camera-1-0001.exr", c.channel);
    ASSERT_EQ(measured.pixels.size(), z.pixels.size());
    int seen = 0, alike = 0;
    for (std::size_t i = 0; i < z.pixels.size(); ++i) {
      if (std::isinf(measured.pixels[i])) continue;
      ++seen;
      ASSERT_GE(measured.pixels[i], c.near);
      ASSERT_LE(measured.pixels[i], c.far);
      alike += std::abs(measured.pixels[i] - z.pixels[i]) < 3 * c.most_error_share * z.pixels[i];
    }
    EXPECT_GT(seen, static_cast<int>(z.pixels.size()) / 4) << c.channel;
    EXPECT_LT(seen, static_cast<int>(z.pixels.size())) << "some is out of range, unlit or at a slant";
    EXPECT_GT(alike, 0.97 * seen) << c.channel << ": but for edges";
    const DepthImage next_z = depth("camera-1-0002.exr", "Z"), next = depth("camera-1-0002.exr", c.channel);
    int still = 0, thrown_anew = 0;
    for (std::size_t i = 0; i < z.pixels.size(); ++i) {
      if (z.pixels[i] != next_z.pixels[i] || std::isinf(measured.pixels[i]) || std::isinf(next.pixels[i])) continue;
      ++still;
      thrown_anew += measured.pixels[i] != next.pixels[i];
    }
    EXPECT_GT(thrown_anew, 0.4 * still) << "each frame has its own dice, where nothing moves too";
    EXPECT_GT(still, 10000);
  }
  std::filesystem::remove(path);
}

TEST(CaptureExchange, AFrameWithoutAPoseShowsTheLastOneAndCountsAsNotRecovered) {
  const auto task = MakeTask("{duration_s: 0.2}");
  const auto world = task->MakeWorld(kExchangeKey, false);
  const CaptureWorld truth =
      MakeCaptureWorld({.duration_s = 0.2}, LoadClips({"builtin:boxing"}, {})->clips[0], kExchangeKey);
  Json answer;
  for (std::size_t k = 0; k < truth.truth.size(); ++k) {
    answer["poses"].push_back(k == 2 ? Json(nullptr) : EncodePose(truth.truth[k]));
  }
  ASSERT_OK(cell, world->Judge(answer));
  EXPECT_NEAR(*ValueOf(*cell, "frames_recovered"), 5.0 / 6, 1e-12);
  for (std::size_t k = 0; k < 6; ++k) {
    if (k == 2) {
      EXPECT_GT(cell->series[0].values[k], 0.01);
    } else {
      EXPECT_EQ(cell->series[0].values[k], 0);
    }
  }
  answer["poses"] = std::vector<Json>(6, nullptr);
  ASSERT_OK(nothing, world->Judge(answer));
  EXPECT_EQ(nothing->status, Status::kFailed);
  EXPECT_EQ(ValueOf(*nothing, "frames_recovered"), 0);
  EXPECT_EQ(ValueOf(*nothing, "mpjpe_mm"), std::nullopt);
}

TEST(CaptureExchange, ReportsEveryMetricThatItsKindNames) {
  std::vector<std::string> reported;
  for (const MetricValue& metric : TakeThatIsTold().cell->metrics) reported.push_back(metric.id);
  EXPECT_THAT(reported, ::testing::UnorderedElementsAreArray(MakeCaptureTaskKind().metrics));
}

TEST(CaptureExchange, RefusesWhatIsNoAnswerNamingThePlaceInIt) {
  const auto complaint = [](const char* answer) {
    const auto read = ReadCaptureAnswer(Json::parse(answer), 2);
    return read ? std::string() : ToString(read.error());
  };
  EXPECT_EQ(complaint(R"({"poses": [null, null]})"), "");
  EXPECT_THAT(complaint(R"([])"), HasSubstr("not an object"));
  EXPECT_THAT(complaint(R"({})"), HasSubstr("poses"));
  EXPECT_THAT(complaint(R"({"poses": [null]})"), HasSubstr("1 entries, not 2"));
  EXPECT_THAT(complaint(R"({"poses": [null, [1, 2, 3]]})"), HasSubstr("poses[1]: 3 numbers, not 60"));
  EXPECT_THAT(complaint(R"({"poses": [null, null], "pose": 1})"), HasSubstr("did you mean 'poses'"));
}

TEST(CaptureExchange, SettingAndFailureAreTold) {
  const auto task = MakeTask("{duration_s: 0.1}");
  const Json setting = *task->Setting()->json;
  EXPECT_EQ(setting["joints"].size(), kRoleCount);
  ASSERT_EQ(setting["strokes"].size(), kStrokeCount);
  EXPECT_EQ(setting["strokes"][0]["from"], RoleName(StrokeMarks()[0].from));
  EXPECT_EQ(setting["discs"].size(), kEffectorCount);
  EXPECT_EQ(task->ValueOfFailure("frames_recovered"), 0);
  EXPECT_EQ(task->ValueOfFailure("mpjpe_mm"), std::nullopt);
}

TEST(CaptureExchange, RefusesTakesOfMorePicturesThanItHolds) {
  const auto task = MakeTask("{duration_s: 21}");
  EXPECT_THAT(testing::Refusal(task->MakeWorld(kExchangeKey, false)->MakeProblem()),
              HasSubstr("a duration_s of at most 20"));
}

}  // namespace
}  // namespace etude
