#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/capture/take_cameras.h"
#include "engine/document/node.h"
#include "engine/vision/change_detection.h"
#include "io/clips/clip_library.h"
#include "tests/bench/tasks/base/cell_values.h"
#include "tests/bench/tasks/base/make_task.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

ColourImage DecodePpm(const std::string& bytes) {
  std::istringstream in(bytes);
  std::string format;
  int width = 0, height = 0, most = 0;
  in >> format >> width >> height >> most;
  EXPECT_EQ(format, "P6");
  EXPECT_EQ(most, 255);
  in.get();
  ColourImage image(width, height);
  in.read(reinterpret_cast<char*>(image.pixels.data()), static_cast<std::streamsize>(3 * image.pixels.size()));
  EXPECT_TRUE(in.good() && in.peek() == EOF);
  return image;
}

/// Returns COCO's run lengths of a mask, down the columns.
Json RunLengths(const Mask& mask) {
  Json counts = Json::array();
  bool is_person = false;
  int run = 0;
  for (int x = 0; x < mask.width; ++x) {
    for (int y = 0; y < mask.height; ++y) {
      if ((mask.At(x, y) != 0) != is_person) {
        counts.push_back(std::exchange(run, 0));
        is_person = !is_person;
      }
      ++run;
    }
  }
  counts.push_back(run);
  return {{"size", {mask.height, mask.width}}, {"counts", std::move(counts)}};
}

/// A program inside this process that segments a picture, given the empty room.
class ImaginedSegmenter final : public LiveProgram {
 public:
  using Answer = std::function<Json(const ColourImage& background, const ColourImage& picture)>;
  explicit ImaginedSegmenter(Answer answer) : answer_(std::move(answer)) {}

  bool Begin(const Payload& session) override {
    sessions.push_back(*session.json);
    background_ = DecodePpm(session.files.at(0).bytes);
    return true;
  }
  JsonPtr Step(const Payload& step) override {
    EXPECT_EQ((*step.json)["picture"], step.files.at(0).name);
    pictures.push_back(step.files.at(0).name);
    const Json answer = answer_(background_, DecodePpm(step.files.at(0).bytes));
    return answer.is_null() ? nullptr : JsonPtr(new Json(answer));
  }

  std::vector<Json> sessions;
  std::vector<std::string> pictures;

 private:
  Answer answer_;
  ColourImage background_;
};

/// Makes a world of three frames; the first method segments by itself, the second asks a program.
std::unique_ptr<Task> MakeTaskOf(const std::string& methods) {
  static const ClipLibrary clips = *LoadClips({"builtin:boxing"}, {});
  auto task = MakeTask(MakeCaptureTaskKind(), "{duration_s: 0.1}", methods, clips);
  EXPECT_TRUE(task) << ToString(task.error());
  return std::move(*task);
}

const WorldKey kSeatWorld{.suite_seed = 3, .scenario = "seat", .trial = 0};

TEST(SeatedSegmenter, WithABuiltInSegmentersAnswersTheCellIsThatSegmentersToTheLastBit) {
  const std::vector<std::string> rests = {"pieces: large", "recovery: silhouettes",
                                          "recovery: bundle, calibration: refined"};
  std::string methods;
  for (std::size_t i = 0; i < rests.size(); ++i) {
    methods += fmt::format("{{name: own {0}, segmenter: ratio, {1}}}, {{name: program {0}, seat: segmenter, {1}}}, ", i,
                           rests[i]);
  }
  const auto task = MakeTaskOf("[" + methods + "]");
  const auto world = task->MakeWorld(kSeatWorld, false);
  for (std::size_t i = 0; i < rests.size(); ++i) {
    ImaginedSegmenter program([](const ColourImage& background, const ColourImage& picture) {
      return Json{{"mask", RunLengths(DetectChange(background, picture, Segmenter::kRatio))}};
    });
    ASSERT_OK(seated, world->RunWith(program, 2 * i + 1));
    const CellResult built_in = world->Run(2 * i);
    EXPECT_EQ(built_in.status, Status::kOk);
    EXPECT_EQ(seated->status, built_in.status);
    EXPECT_EQ(seated->digests, built_in.digests) << rests[i];
    for (const MetricValue& metric : built_in.metrics)
      EXPECT_EQ(ValueOf(*seated, metric.id), metric.value) << metric.id;
  }
}

TEST(SeatedSegmenter, IsShownEveryPictureOfEveryCameraInOrder) {
  const auto task = MakeTaskOf("[{name: program, seat: segmenter}]");
  ImaginedSegmenter program([](const ColourImage&, const ColourImage& picture) {
    return Json{{"mask", RunLengths(Mask(picture.width, picture.height))}};
  });
  ASSERT_OK(blind, task->MakeWorld(kSeatWorld, false)->RunWith(program, 0));
  EXPECT_EQ(ValueOf(*blind, "iou"), 0);
  ASSERT_EQ(program.sessions.size(), 2u);
  EXPECT_EQ(program.sessions[1],
            (Json{{"seat", "segmenter"}, {"camera", 2}, {"background", "camera-2-background.ppm"}}));
  EXPECT_EQ(program.pictures,
            (std::vector<std::string>{"camera-1-0000.ppm", "camera-1-0001.ppm", "camera-1-0002.ppm",
                                      "camera-2-0000.ppm", "camera-2-0001.ppm", "camera-2-0002.ppm"}));
}

TEST(SeatedSegmenter, AnAnswerThatIsNoMaskOfThePictureIsRefusedAndNothingMoreIsAsked) {
  const auto task = MakeTaskOf("[{name: program, seat: segmenter}]");
  const auto refused = [&](const Json& answer) {
    ImaginedSegmenter program([&](const ColourImage&, const ColourImage&) { return answer; });
    const auto result = task->MakeWorld(kSeatWorld, false)->RunWith(program, 0);
    EXPECT_EQ(program.pictures.size(), 1u);
    return result ? std::string("taken") : result.error().message;
  };
  const auto mask = [](Json size, Json counts) {
    return Json{{"mask", {{"size", std::move(size)}, {"counts", std::move(counts)}}}};
  };
  EXPECT_EQ(refused(Json::object()), "of camera-1-0000.ppm: mask: it is missing");
  EXPECT_EQ(refused({{"mask", 3}}), "of camera-1-0000.ppm: mask: 3 is not an object");
  EXPECT_THAT(refused({{"mask", {}}, {"masks", {}}}), HasSubstr("masks"));
  EXPECT_THAT(refused(mask({640, 480}, {307200})),
              HasSubstr("mask.size: [640,480]; allowed: [480, 640], the picture's height and width"));
  EXPECT_THAT(refused(mask({480, 640}, {307199})),
              HasSubstr("mask.counts: 307199 pixels in all; the picture has 307200"));
  EXPECT_THAT(refused(mask({480, 640}, {307199, 2})), HasSubstr("mask.counts[1]: 2; allowed: 0…1"));
  EXPECT_THAT(refused(mask({480, 640}, {-1, 307201})), HasSubstr("mask.counts[0]: -1; allowed: 0…307200"));
  EXPECT_THAT(refused(mask({480, 640}, {0.5, 307199.5})), HasSubstr("mask.counts[0]: 0.5 is not a whole number"));
  EXPECT_THAT(refused(mask({480, 640}, Json::array())), HasSubstr("mask.counts: found 0 entries"));
}

TEST(SeatedSegmenter, IsAskedNoMoreOnceItHasFailed) {
  const auto task = MakeTaskOf("[{name: program, seat: segmenter}]");
  ImaginedSegmenter program([](const ColourImage&, const ColourImage&) { return Json(); });
  (void)task->MakeWorld(kSeatWorld, false)->RunWith(program, 0);
  EXPECT_EQ(program.pictures.size(), 1u);
  EXPECT_EQ(program.sessions.size(), 1u);
}

}  // namespace
}  // namespace etude
