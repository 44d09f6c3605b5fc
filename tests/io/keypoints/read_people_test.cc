#include "io/keypoints/read_people.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "tests/io/keypoints/keypoint_files.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

class ReadPeople : public testing::KeypointFiles {};

TEST_F(ReadPeople, TakesOpenPosesFramesInTheOrderOfTheirNumbers) {
  Write("a/f_10.json", OpenPose(25, "30, 40, 0.7"));
  Write("a/f_9.json", OpenPose(25));
  Write("a/f_0100.json", R"({"people": []})");
  ASSERT_OK(film, ReadKeypoints(folder_.path() / "a", "body_25b"));
  ASSERT_EQ(film->frames.size(), 3u);
  EXPECT_EQ(film->frames[0][0][Landmark::kNose].pixel, glm::dvec2(10.5, 20.5));
  EXPECT_DOUBLE_EQ(film->frames[1][0][Landmark::kNose].confidence, 0.7);
  EXPECT_EQ(film->frames[0][0][Landmark::kNeck].confidence, 0);
  EXPECT_TRUE(film->frames[2].empty());
}

TEST_F(ReadPeople, FramesWithoutAFileAreFramesWithoutPeople) {
  for (int k = 0; k < 60; ++k) {
    if (k >= 20 && k < 35) continue;
    Write(fmt::format("a/cam1_{:012}_keypoints.json", k), OpenPose(18, fmt::format("{}, 20, 0.5", k)));
    Write(fmt::format("b/{}.json", 5 * k + 300), OpenPose(18, fmt::format("{}, 20, 0.5", k)));
  }
  for (const char* folder : {"a", "b"}) {
    ASSERT_OK(film, ReadKeypoints(folder_.path() / folder, ""));
    ASSERT_EQ(film->frames.size(), 60u) << folder;
    for (std::size_t k = 0; k < 60; ++k) {
      ASSERT_EQ(film->frames[k].size(), k < 20 || k >= 35 ? 1u : 0u) << folder << k;
      if (!film->frames[k].empty()) {
        EXPECT_EQ(film->frames[k][0][Landmark::kNose].pixel.x, static_cast<double>(k) + 0.5);
      }
    }
    EXPECT_EQ(film->told,
              "by the frame numbers or times, 15 of 60 frames are missing; Etude assumes that these frames show "
              "nobody");
  }
  // If a film has as many frames as there are files, each file is a frame; else the files' numbers are frames.
  EXPECT_EQ(ReadKeypoints(folder_.path() / "a", "", {.frames = 45})->frames.size(), 45u);
  EXPECT_EQ(ReadKeypoints(folder_.path() / "a", "", {.frames = 64})->frames.size(), 64u);
}

TEST_F(ReadPeople, FramesAreLaidOnTheirTimes) {
  const auto list = [&](const char* key, double unit) {
    std::string text;
    for (int k = 0; k < 60; ++k) {
      if (k >= 20 && k < 35) continue;
      text += fmt::format("{}{{\"{}\": {:.0f}, \"people\": [{{\"keypoints\": [{}]}}]}}", text.empty() ? "" : ",", key,
                          1e3 + unit * k / 30, Triples(17, fmt::format("{}, 20, 0.5", k)));
    }
    return Write("list.json", "[" + text + "]");
  };
  for (const auto& [key, unit] :
       {std::pair("timestamp_ms", 1e3), std::pair("timestamp", 1e6), std::pair("time", 1e9)}) {
    ASSERT_OK(film, ReadKeypoints(list(key, unit), ""));
    ASSERT_EQ(film->frames.size(), 60u) << key;
    EXPECT_TRUE(film->frames[27].empty());
    EXPECT_EQ(film->frames[35][0][Landmark::kNose].pixel.x, 35.5);
    EXPECT_EQ(film->told,
              "by the frame numbers or times, 15 of 60 frames are missing; Etude assumes that these frames show "
              "nobody");
    EXPECT_EQ(ReadKeypoints(list(key, unit), "", {.frames = 45})->frames.size(), 45u);
  }
}

TEST_F(ReadPeople, PicturesOfCocoAreLaidOnTheNumbersOfTheirNames) {
  std::string images, annotations;
  for (int k = 0; k < 30; ++k) {
    if (k >= 10 && k < 14) continue;
    images += fmt::format("{}{{\"id\": {}, \"file_name\": \"film/frame_{:06}.PNG\"}}", images.empty() ? "" : ",",
                          100 + images.size(), k);
    annotations += fmt::format(
        "{}{{\"image_id\": {}, \"keypoints\": [{}]}}", annotations.empty() ? "" : ",",
        images.substr(images.rfind("\"id\": ") + 6, images.rfind(", \"file") - images.rfind("\"id\": ") - 6),
        Triples(17, fmt::format("{}, 20, 2", k)));
  }
  const auto film =
      ReadKeypoints(Write("coco.json", "{\"images\": [" + images + "], \"annotations\": [" + annotations + "]}"), "");
  ASSERT_TRUE(film) << ToString(film.error());
  ASSERT_EQ(film->frames.size(), 30u);
  EXPECT_TRUE(film->frames[12].empty());
  EXPECT_EQ(film->frames[20][0][Landmark::kNose].pixel.x, 20.5);
}

TEST_F(ReadPeople, TakesOpenPosesFirstFormat) {
  Write("a/0.json", R"({"version": 1.0, "people": [{"pose_keypoints": [)" + Triples(18) + "]}]}");
  ASSERT_OK(film, ReadKeypoints(folder_.path() / "a", ""));
  EXPECT_EQ(film->frames[0][0][Landmark::kNose].pixel, glm::dvec2(10.5, 20.5));
}

TEST_F(ReadPeople, TakesWhatPythonWritesOfKeypointsThatWereNotSeen) {
  Write("a/f_0.json", OpenPose(26, "NaN, NaN, NaN, 30, 40, 0.7"));
  Write("a/f_1.json",
        R"({"note": "NaN \" NaN", "people": [{"pose_keypoints_2d": [)" + Triples(26, "NaN, 1, NaN") + "]}]}");
  const auto film = ReadKeypoints(folder_.path() / "a", "");
  ASSERT_FALSE(film) << "27 keypoints";
  Write("a/f_0.json", R"({"people": [{"pose_keypoints_2d": [)" + Triples(25, "NaN, NaN, NaN, 30, 40, 0.7") + "]}]}");
  ASSERT_OK(seen, ReadKeypoints(folder_.path() / "a", ""));
  EXPECT_EQ(seen->frames[0][0][Landmark::kNose].confidence, 0);
  EXPECT_EQ(seen->frames[0][0][Landmark::kLeftEye].pixel, glm::dvec2(30.5, 40.5));
  EXPECT_TRUE(seen->frames[1].empty()) << "nobody";
  Write("a/f_1.json", OpenPose(26, "nan, 1, 1"));
  EXPECT_THAT(Reason(folder_.path() / "a"), HasSubstr("not valid JSON"));
}

TEST_F(ReadPeople, PointsAtTheOriginOrAtMinusOneWereNotSeenWhateverTheirScore) {
  Write("a/f_0.json", OpenPose(25, "0, 0, 0.9, 30, 40, 0.7"));
  Write("a/f_1.json", OpenPose(25, "-1, -1, 0.9, 30, 40, 0.7"));
  Write("a/f_2.json", OpenPose(25, "-1, 20, 0.9, 30, 40, 0.7"));
  ASSERT_OK(film, ReadKeypoints(folder_.path() / "a", ""));
  for (const auto& [frame, confidence] : {std::pair(0, 0.0), {1, 0.0}, {2, 0.9}}) {
    ASSERT_EQ(film->frames[frame].size(), 1u);
    EXPECT_EQ(film->frames[frame][0][Landmark::kNose].confidence, confidence) << frame;
    EXPECT_EQ(film->frames[frame][0][Landmark::kLeftEye].confidence, 0.7) << "the control";
  }
}

TEST_F(ReadPeople, AsksWhichOrderTwentyFiveKeypointsHave) {
  Write("a/1.json", OpenPose(25));
  EXPECT_THAT(Reason(folder_.path() / "a"), HasSubstr("body_25 or body_25b; use --layout to choose one"));
  EXPECT_EQ(Reason(folder_.path() / "a", "body_25"), "accepted");
  EXPECT_THAT(Reason(folder_.path() / "a", "coco"),
              HasSubstr("found 25 keypoints per person, which do not fit the layout coco; allowed: coco (17)"));
}

TEST_F(ReadPeople, KnowsTheOrderOfOpenPosesBody25ByItsMidHip) {
  // People with a different order of landmarks: mid-hip and hips, or elbow, wrist and hip.
  const auto people = [](bool has_mid_hip) {
    std::string list;
    for (std::size_t i = 0; i < 25; ++i) {
      const bool is_face = i == 0 || (has_mid_hip && i >= 15 && i <= 18);
      const double x = i == 9    ? 90
                       : i == 12 ? 110
                                 : 100,
                   y = is_face       ? (has_mid_hip ? 0 : 60)
                       : i == 24     ? 200
                       : has_mid_hip ? 100
                                     : 60 + 8 * i;
      list += fmt::format("{}{}, {}, 0.9", i == 0 ? "" : ", ", x, i == 8 && !has_mid_hip ? 40 : y);
    }
    return R"({"people": [{"pose_keypoints_2d": [)" + list + "]}]}";
  };
  for (int k = 0; k < 4; ++k) {
    Write(fmt::format("a/{}.json", k), people(true));
    Write(fmt::format("b/{}.json", k), people(false));
  }
  ASSERT_OK(film, ReadKeypoints(folder_.path() / "a", ""));
  EXPECT_THAT(film->told, HasSubstr("body_25"));
  EXPECT_EQ(film->frames[0][0][Landmark::kRightHip].pixel, glm::dvec2(90.5, 100.5));
  EXPECT_THAT(Reason(folder_.path() / "b"), HasSubstr("to choose one of them"));
  EXPECT_EQ(Reason(folder_.path() / "a", "body_25b"), "accepted") << "what is said counts";
  // A layout that the keypoints contradict is doubted; the other one is not.
  const auto doubt = [&](const char* people_in, const char* layout) {
    return ReadKeypoints(folder_.path() / people_in, layout).value().doubt;
  };
  EXPECT_EQ(doubt("a", "body_25b"),
            "in the layout body_25b, the right elbow would be between the left wrist and the right hip in 4 of 4 "
            "people; try --layout body_25");
  EXPECT_EQ(doubt("b", "body_25"),
            "in the layout body_25, the mid-hip would be between the hips in only 0 of 4 people; try --layout "
            "body_25b");
  EXPECT_EQ(doubt("a", "body_25") + doubt("b", "body_25b") + doubt("a", ""), "");
}

/// Returns the landmarks of a person, 170 pixels tall, who stands or crouches, turned by quarters about the hips.
std::map<Landmark, glm::dvec2> Stick(bool crouches, int quarters, bool from_behind) {
  using enum Landmark;
  std::map<Landmark, glm::dvec2> at = {
      {kHead, {0, -85}},       {kNose, {1, -72}},          {kLeftEye, {4, -75}},
      {kRightEye, {-3, -75}},  {kLeftEar, {8, -73}},       {kRightEar, {-7, -73}},
      {kNeck, {0, -55}},       {kLeftShoulder, {18, -55}}, {kRightShoulder, {-18, -55}},
      {kLeftElbow, {22, -25}}, {kRightElbow, {-24, -26}},  {kLeftWrist, {24, 0}},
      {kRightWrist, {-20, 1}}, {kMidHip, {0, 0}},          {kLeftHip, {10, 0}},
      {kRightHip, {-10, 0}},   {kLeftKnee, {11, 42}},      {kRightKnee, {-10, 41}},
      {kLeftAnkle, {12, 85}},  {kRightAnkle, {-13, 84}}};
  if (crouches) {
    at[kLeftKnee] = {25, -20};
    at[kRightKnee] = {-22, -18};
    at[kLeftAnkle] = {14, 20};
    at[kRightAnkle] = {-12, 21};
  }
  for (auto& [landmark, pixel] : at) {
    if (from_behind) pixel.x = -pixel.x;
    for (int i = 0; i < quarters; ++i) pixel = {-pixel.y, pixel.x};
    pixel += glm::dvec2(300, 200);
  }
  return at;
}

TEST_F(ReadPeople, DoubtsKeypointsInAnotherOrderThanTheirNumberTells) {
  const auto write = [&](const char* layout, const std::map<Landmark, glm::dvec2>& stick) {
    std::string points;
    for (const Landmark landmark : FindKeypointLayout(layout)->landmarks) {
      const glm::dvec2 p = stick.at(landmark == Landmark::kNoLandmark ? Landmark::kMidHip : landmark);
      points += fmt::format("{}{}, {}, 0.9", points.empty() ? "" : ", ", p.x, p.y);
    }
    const std::string frame = R"({"people": [{"keypoints": [)" + points + "]}]}";
    return Write("list.json", fmt::format("[{0}, {0}, {0}, {0}]", frame));
  };
  for (const bool crouches : {false, true}) {
    for (const int quarters : {0, 1, 2, 3}) {
      for (const bool from_behind : {false, true}) {
        const auto stick = Stick(crouches, quarters, from_behind);
        for (const char* usual : {"coco", "coco_18"}) {
          EXPECT_EQ(ReadKeypoints(write(usual, stick), "").value().doubt, "") << usual << crouches << quarters;
        }
        for (const char* rare : {"h36m", "trt_pose"}) {
          const auto file = write(rare, stick);
          const std::string doubt = ReadKeypoints(file, "").value().doubt;
          EXPECT_THAT(doubt, HasSubstr("in 4 of 4 people")) << crouches << quarters;
          EXPECT_THAT(doubt, HasSubstr(fmt::format("try --layout {}", rare)));
          ASSERT_OK(told, ReadKeypoints(file, rare));
          EXPECT_EQ(told->doubt, "");
          EXPECT_EQ(told->frames[0][0][Landmark::kRightKnee].pixel, stick.at(Landmark::kRightKnee) + 0.5);
        }
        EXPECT_THAT(ReadKeypoints(write("coco", stick), "h36m").value().doubt, HasSubstr("try --layout coco"));
      }
    }
  }
}

TEST_F(ReadPeople, ReadsCocoWithFlagsOrScores) {
  const auto coco = [&](const std::string& v) {
    return R"({"images": [{"id": 7, "width": 640, "height": 480}, {"id": 3, "width": 640, "height": 480}],
      "annotations": [{"image_id": 3, "keypoints": [)" +
           Triples(17, "1, 2, " + v) + "]}]}";
  };
  ASSERT_OK(flags, ReadKeypoints(Write("flags.json", coco("2")), ""));
  ASSERT_EQ(flags->frames.size(), 2u);
  EXPECT_TRUE(flags->frames[1].empty()) << "the image with the higher id";
  EXPECT_DOUBLE_EQ(flags->frames[0][0][Landmark::kNose].confidence, 1);
  EXPECT_EQ(flags->width, 640);
  const auto scores = ReadKeypoints(Write("scores.json", coco("0.25")), "");
  EXPECT_DOUBLE_EQ(scores->frames[0][0][Landmark::kNose].confidence, 0.25);
  const auto above = ReadKeypoints(Write("above.json", coco("1.05")), "");
  EXPECT_DOUBLE_EQ(above->frames[0][0][Landmark::kNose].confidence, 1) << "a score, no flag";
}

TEST_F(ReadPeople, ReadsResultsOfAlphaPoseAndCocoInTheFramesThatTheirImagesName) {
  const auto result = [&](const std::string& image, const std::string& x) {
    return R"({"image_id": )" + image + R"(, "category_id": 1, "keypoints": [)" + Triples(17, x + ", 2, 0.5") + "]}";
  };
  const FilmOfKeypoints film{.width = 640, .height = 480, .frames = 4};
  const auto alpha =
      ReadKeypoints(Write("alpha.json", "[" + result("\"v_0.jpg\"", "10") + "," + result("\"v_3.jpg\"", "13") + "," +
                                            result("\"v_3.jpg\"", "14") + "]"),
                    "", film);
  ASSERT_TRUE(alpha) << ToString(alpha.error());
  ASSERT_EQ(alpha->frames.size(), 4u);
  EXPECT_TRUE(alpha->frames[1].empty());
  EXPECT_EQ(alpha->frames[3].size(), 2u);
  EXPECT_EQ(alpha->frames[3][1][Landmark::kNose].pixel, glm::dvec2(14.5, 2.5));
  const auto from_one =
      ReadKeypoints(Write("coco.json", "[" + result("1", "10") + "," + result("4", "13") + "]"), "", film);
  ASSERT_TRUE(from_one) << ToString(from_one.error());
  EXPECT_EQ(from_one->frames[0].size(), 1u) << "1 to 4 of four frames count from 1";
  EXPECT_EQ(from_one->told, "");
  const auto within = ReadKeypoints(Write("within.json", "[" + result("1", "10") + "]"), "", film);
  EXPECT_EQ(within->frames[1].size(), 1u);
  EXPECT_THAT(within->told, HasSubstr("assumes that the numbers count from 0"));
  EXPECT_THAT(Reason(Write("noname.json", "[" + result("\"last\"", "1") + "]")),
              HasSubstr("the image_id of a result contains no number"));
}

TEST_F(ReadPeople, ReadsAlphaPosesFormatsOpenAndCmu) {
  // Nose, neck, right arm, left arm, right leg, left leg, eyes, ears; `neck` is the neck's row.
  const auto points = [](int neck) {
    return fmt::format(
        "50, 20, 1.5, 50, {}, 1.5, 40, 40, 1, 30, 60, 1, 30, 80, 1, 60, 40, 1, 70, 60, 1, 70, 80, 1, 45, 90, 1, 45, "
        "130, 1, 45, 170, 1, 55, 90, 1, 55, 130, 1, 55, 170, 1, 48, 18, 1, 52, 18, 1, 46, 19, 1, 54, 19, 1",
        neck);
  };
  for (const auto& [people, list] : {std::pair("people", "pose_keypoints_2d"), {"bodies", "joints"}}) {
    for (const int neck : {40, 10}) {
      std::string text;
      for (const int image : {0, 1, 3}) {
        text += fmt::format(R"({}"v_{}.jpg": {{"version": "AlphaPose v0.3", "{}": [{{"{}": [{}]}}]}})",
                            text.empty() ? "" : ", ", image, people, list, points(neck));
      }
      const auto file = Write("alpha.json", "{" + text + "}");
      ASSERT_OK(film, ReadKeypoints(file, "", {.width = 640, .height = 480, .frames = 4}));
      ASSERT_EQ(film->frames.size(), 4u);
      EXPECT_TRUE(film->frames[2].empty());
      ASSERT_EQ(film->frames[3].size(), 1u);
      EXPECT_EQ(film->frames[3][0][Landmark::kNose].pixel, glm::dvec2(50.5, 20.5));
      EXPECT_EQ(film->frames[3][0][Landmark::kLeftAnkle].pixel, glm::dvec2(55.5, 170.5));
      EXPECT_EQ(film->told.find("is not midway between the shoulders") != std::string::npos, neck == 10) << film->told;
    }
  }
}

TEST_F(ReadPeople, ReadsMmposeByTheNamesThatItGives) {
  std::string names, points, scores;
  const char* kOrder[] = {"left_hip",    "left_knee",     "left_ankle", "right_hip",  "right_knee",
                          "right_ankle", "left_shoulder", "left_elbow", "left_wrist", "right_shoulder",
                          "right_elbow", "right_wrist",   "nose",       "tail"};
  for (std::size_t i = 0; i < std::size(kOrder); ++i) {
    const char* comma = i == 0 ? "" : ", ";
    names += fmt::format("{}\"{}\": \"{}\"", comma, i, kOrder[i]);
    points += fmt::format("{}[{}, 7]", comma, 20 + i);
    scores += fmt::format("{}0.75", comma);
  }
  const std::string info =
      R"("instance_info": [{"frame_id": 1, "instances": []}, {"frame_id": 2, "instances": [{"keypoints": [)" + points +
      R"(], "keypoint_scores": [)" + scores + "]}]}]}";
  const FilmOfKeypoints film{.width = 640, .height = 480, .frames = 2};
  const auto read =
      ReadKeypoints(Write("m.json", R"({"meta_info": {"keypoint_id2name": {)" + names + "}}, " + info), "", film);
  ASSERT_TRUE(read) << ToString(read.error());
  ASSERT_EQ(read->frames.size(), 2u);
  EXPECT_EQ(read->frames[1][0][Landmark::kRightHip].pixel, glm::dvec2(23.5, 7.5));
  EXPECT_DOUBLE_EQ(read->frames[1][0][Landmark::kNose].confidence, 0.75);
  EXPECT_THAT(Reason(Write("nameless.json", "{" + info)), HasSubstr("14 keypoints per person; allowed: coco (17)"));
}

TEST_F(ReadPeople, ReadsOneListForEachCoordinate) {
  const auto list = [](const std::string& entry) { return "[" + List(17, [&](int) { return entry; }) + "]"; };
  const auto person = [&](const std::string& points) {
    return R"([[{"name": "person", "class": 0, "box": {"x1": 1}, "keypoints": {)" + points + "}}], []]";
  };
  const std::string xy = R"("x": )" + list("20.5") + R"(, "y": )" + list("7"), sure = R"(, "visible": )";
  ASSERT_OK(read, ReadKeypoints(Write("u.json", person(xy + sure + list("0.75"))), ""));
  ASSERT_EQ(read->frames.size(), 2u);
  ASSERT_EQ(read->frames[0].size(), 1u);
  EXPECT_TRUE(read->frames[1].empty());
  EXPECT_EQ(read->frames[0][0][Landmark::kRightHip].pixel, glm::dvec2(21, 7.5));
  EXPECT_DOUBLE_EQ(read->frames[0][0][Landmark::kNose].confidence, 0.75);
  // Flags are confidences, and without confidences all keypoints are certain.
  EXPECT_EQ(ReadKeypoints(Write("flags.json", person(xy + sure + list("true"))), "")
                ->frames[0][0][Landmark::kNose]
                .confidence,
            1);
  EXPECT_EQ(ReadKeypoints(Write("bare.json", person(xy)), "")->frames[0][0][Landmark::kNose].confidence, 1);
  // A score counts more than a flag, also if it stands beside the keypoints; numbers beside the lists do not count.
  const auto scored = Write("scored.json", R"([[{"track_id": 3, "keypoints": {)" + xy + sure + list("true") +
                                               R"(, "id": 7}, "keypoint_scores": )" + list("0.25") + "}]]");
  EXPECT_DOUBLE_EQ(ReadKeypoints(scored, "")->frames[0][0][Landmark::kNose].confidence, 0.25);
  // Lists of other lengths and texts are refused, not taken for keypoints that were not seen.
  EXPECT_THAT(Reason(Write("short.json", person(xy + sure + "[1, 1]"))),
              HasSubstr("17 values of x, but 'visible' is a list of 2"));
  EXPECT_THAT(Reason(Write("text.json", person(xy + sure + list("\"0.9\"")))),
              HasSubstr("a value of a keypoint is \"0.9\"; allowed: null, or a number"));
}

TEST_F(ReadPeople, TakesSharesOfThePicture) {
  const std::string points = List(33, [](int) { return R"({"x": 0.25, "y": 0.5, "z": 0, "visibility": 0.9})"; });
  const auto path = Write("p.json", R"([{"pose_landmarks": [)" + points + R"(]}, {"pose_landmarks": null}])");
  ASSERT_OK(read, ReadKeypoints(path, "", {.width = 640, .height = 480, .frames = 2}));
  EXPECT_EQ(read->frames[0][0][Landmark::kLeftHeel].pixel, glm::dvec2(160, 240));
  EXPECT_TRUE(read->frames[1].empty());
  EXPECT_THAT(read->told, HasSubstr("fractions of the picture's 640 x 480 pixels"));
  EXPECT_EQ(ReadKeypoints(path, "")->frames[0][0][Landmark::kNose].pixel, glm::dvec2(0.75, 1))
      << "of an unknown film: pixels";
}

TEST_F(ReadPeople, AKeypointAtExactlyZeroWasNotSeen) {
  std::string rest;
  for (int i = 1; i < 17; ++i) rest += ", [30, 40]";
  for (const std::string first : {"[0, 0]", "[0.0, 0.0, 0.3]"}) {
    ASSERT_OK(film, ReadKeypoints(Write("z.json", R"([{"frame": 0, "keypoints": [)" + first + rest + "]}]"), ""));
    EXPECT_EQ(film->frames[0][0][Landmark::kNose].confidence, 0) << first;
    EXPECT_EQ(film->frames[0][0][Landmark::kLeftEye].confidence, 1) << first;
  }
  std::string points = R"({"x": 0, "y": 0})";
  for (int i = 1; i < 17; ++i) points += R"(, {"x": 0, "y": 40})";
  ASSERT_OK(film, ReadKeypoints(Write("o.json", R"([{"frame": 0, "keypoints": [)" + points + "]}]"), ""));
  EXPECT_EQ(film->frames[0][0][Landmark::kNose].confidence, 0);
  EXPECT_EQ(film->frames[0][0][Landmark::kLeftEye].confidence, 1);
}

TEST_F(ReadPeople, ConfidentKeypointsDecideWhetherCoordinatesAreShares) {
  const FilmOfKeypoints film{.width = 640, .height = 480, .frames = 1};
  // Each landmark lies at (x, 0.5); those of `odd` lie at (far, far).
  const auto read = [&](int odd, double far, double sure, double x = 0.25) {
    const std::string points = List(33, [&](int i) {
      const bool is_odd = i >= 33 - odd;
      return fmt::format(R"({{"x": {}, "y": {}, "visibility": {}}})", is_odd ? far : x, is_odd ? far : 0.5,
                         is_odd ? sure : 0.9);
    });
    return ReadKeypoints(Write("p.json", R"([{"pose_landmarks": [)" + points + "]}]"), "", film).value();
  };
  const auto nose = [](const PeopleOfFilm& people) { return people.frames[0][0][Landmark::kNose].pixel; };
  EXPECT_EQ(read(0, 0, 0).told,
            "keypoint coordinates are between 0 and 1, so Etude reads them as fractions of the picture's 640 x 480 "
            "pixels");
  // The last two of MediaPipe's landmarks, the toes, lie below the picture.
  for (const double sure : {0.02, 0.9}) {
    const PeopleOfFilm toes = read(2, 1.25, sure);
    EXPECT_EQ(nose(toes), glm::dvec2(160, 240)) << sure;
    EXPECT_EQ(toes.frames[0][0][Landmark::kLeftBigToe].pixel, glm::dvec2(800, 600));
    EXPECT_THAT(toes.told, HasSubstr("keypoint coordinates are between 0 and 1, all but 2 of 21, so Etude reads them"))
        << sure;
  }
  const PeopleOfFilm pixels = read(33, 200, 0.9);
  EXPECT_EQ(nose(pixels), glm::dvec2(200.5, 200.5));
  EXPECT_EQ(pixels.told, "");
  // Pixels of a person of whom some keypoints lie in the picture's first pixel.
  EXPECT_EQ(nose(read(30, 200, 0.9)), glm::dvec2(0.75, 1));
}

TEST_F(ReadPeople, TakesTheRangeOfOpenPosesScaleFour) {
  const std::string points = List(17, [](int i) { return fmt::format("0.5, {}, 0.9", i < 9 ? -0.5 : 0.5); });
  Write("s/0.json", R"({"people": [{"pose_keypoints_2d": [)" + points + "]}]}");
  ASSERT_OK(film, ReadKeypoints(folder_.path() / "s", "", {.width = 640, .height = 480, .frames = 1}));
  EXPECT_EQ(film->frames[0][0][Landmark::kNose].pixel, glm::dvec2(480, 120));
  EXPECT_EQ(film->frames[0][0][Landmark::kLeftAnkle].pixel, glm::dvec2(480, 360));
  EXPECT_EQ(film->told,
            "keypoint coordinates are between -1 and 1, so Etude reads -1 and 1 as the edges of the picture of 640 x "
            "480 pixels (OpenPose's --keypoint_scale 4)");
}

TEST_F(ReadPeople, RefusesWithTheFileAndTheReason) {
  EXPECT_THAT(Reason(Write("a.json", "{")), HasSubstr("a.json"));
  EXPECT_THAT(Reason(Write("b.json", "[]")), HasSubstr("the lists 'images' and 'annotations' are missing"));
  EXPECT_THAT(Reason(Write("c.json", R"({"images": [], "annotations": []})")), HasSubstr("no image"));
  EXPECT_THAT(Reason(Write("d.json", R"({"images": [{"id": 1}, {"id": 1}], "annotations": []})")),
              HasSubstr("two images"));
  Write("e/1.json", OpenPose(17, "1, \"x\", 1"));
  EXPECT_THAT(Reason(folder_.path() / "e"), HasSubstr("a number of a keypoint is \"x\""));
  Write("f/1.json", OpenPose(17, "1, 1e300, 1"));
  EXPECT_THAT(Reason(folder_.path() / "f"), HasSubstr("a number of a keypoint is 1e+300"));
  Write("g/note.txt", "");
  EXPECT_THAT(Reason(folder_.path() / "g"), HasSubstr("the folder contains no .json file"));
}

TEST_F(ReadPeople, FindsTheEntryOfAFilm) {
  Write("cam1_json/1.json", "");
  Write("cam10.json", "");
  Write("cam2.json", "");
  Write("cam2_b.json", "");
  EXPECT_EQ(EntryOfFilm(folder_.path(), "cam1")->filename(), "cam1_json");
  EXPECT_EQ(EntryOfFilm(folder_.path(), "cam10")->filename(), "cam10.json");
  EXPECT_THAT(EntryOfFilm(folder_.path(), "cam2").error().message, HasSubstr("cam2.json and cam2_b.json, begin"));
  EXPECT_THAT(EntryOfFilm(folder_.path(), "cam3").error().message,
              HasSubstr("the folder contains no file for the film"));
}

// Detectron2's scores are ratios without an upper limit: one peak must not hide all other keypoints.
TEST_F(ReadPeople, LargeScoresHideNoKeypoints) {
  const std::string results = List(20, [](int k) {
    const auto point = [&](int i) { return fmt::format("{}, {}, {}", 10 + i, 20 + k, k == 3 && i == 5 ? 14.0 : 0.4); };
    return fmt::format(R"({{"image_id": {}, "keypoints": [{}]}})", k, List(17, point));
  });
  ASSERT_OK(film, ReadKeypoints(Write("results.json", "[" + results + "]"), ""));
  for (const auto& frame : film->frames) {
    EXPECT_EQ(frame.at(0)[Landmark::kNose].confidence, 0.4);
  }
}

// Percentages, and raw scores of RTMPose. Without scaling, a keypoint of 5 % would count as certain.
TEST_F(ReadPeople, ScoresAbove1AreScaledInEveryFormat) {
  const auto points = [](double scale) {
    return List(17, [&](int i) { return fmt::format("{}, 20, {}", 10 + i, scale * (i == 5 ? 0.05 : 0.9)); });
  };
  for (const double scale : {1.0, 8.0, 100.0}) {
    const auto open_pose =
        Write("cam/1.json", R"({"people": [{"pose_keypoints_2d": [)" + points(scale) + "]}]}").parent_path();
    const auto list = Write("list.json", R"([{"frame": 0, "keypoints": [)" + points(scale) + "]}]");
    const auto results = Write("results.json", R"([{"image_id": 0, "keypoints": [)" + points(scale) + "]}]");
    const auto coco = Write("coco.json", R"({"images": [{"id": 1}], "annotations": [{"image_id": 1, "keypoints": [)" +
                                             points(scale) + "]}]}");
    for (const auto& path : {open_pose, list, results, coco}) {
      ASSERT_OK(film, ReadKeypoints(path, ""));
      const SeenPerson& person = film->frames.at(0).at(0);
      EXPECT_DOUBLE_EQ(person[Landmark::kLeftHip].confidence, scale == 1 ? 0.9 : 1) << path;
      EXPECT_NEAR(person[Landmark::kLeftShoulder].confidence, scale == 1 ? 0.05 : 0.05 / 0.9, 1e-12) << path;
      EXPECT_EQ(film->told,
                scale == 1
                    ? ""
                    : fmt::format("confidences reach {0:.3g}; Etude takes {0:.3g}, their third quartile, and all "
                                  "above it as certain",
                                  scale * 0.9))
          << path;
    }
  }
}

// In one film, the person is seen half as well as in the other: all its keypoints count half.
TEST_F(ReadPeople, FilmsShareTheScaleOfTheirScores) {
  const auto file = [&](const std::string& name, double score) {
    const std::string points = List(17, [&](int i) { return fmt::format("{}, 20, {}", 10 + i, score); });
    return Write(name, R"([{"frame": 0, "keypoints": [)" + points + "]}]");
  };
  const auto dim = file("dim.json", 40);
  std::vector<PeopleOfFilm> films;
  for (const auto& path : {dim, file("bright.json", 80), file("share.json", 0.9), file("raw.json", 8)}) {
    ASSERT_OK(film, ReadKeypoints(path, ""));
    films.push_back(*film);
  }
  // A film of shares and one of raw scores are other estimators'; the largest scale stays.
  std::vector<double> shared;
  for (const PeopleOfFilm& film : films) shared.push_back(SharedScoreScale(film.score_scale, films));
  EXPECT_EQ(shared, (std::vector<double>{80, 0, 0, 0}));
  ASSERT_OK(film, ReadKeypoints(dim, "", {.score_scale = 80}));
  EXPECT_EQ(film->frames.at(0).at(0)[Landmark::kNose].confidence, 0.5);
  EXPECT_EQ(film->told,
            "confidences reach 40; Etude takes 80, the films' largest third quartile, and all above it as certain");
}

TEST_F(ReadPeople, ScoresHaveKnownNamesOrAreRefused) {
  const auto list = [&](const std::string& key) {
    const std::string points =
        List(17, [&](int i) { return fmt::format(R"({{"x": {}, "y": 2, "{}": 0.02}})", i, key); });
    return Write("points.json", R"([{"keypoints": [)" + points + "]}]");
  };
  for (const char* key : {"score", "conf", "likelihood"}) {
    ASSERT_OK(film, ReadKeypoints(list(key), ""));
    EXPECT_EQ(film->frames.at(0).at(0)[Landmark::kLeftHip].confidence, 0.02) << key;
  }
  EXPECT_THAT(Reason(list("surety")), HasSubstr("a keypoint has the number 'surety' in addition to x and y"));
  const auto lists = [&](const std::string& key, const std::string& point) {
    const std::string points = List(17, [&](int) { return point; }), scores = List(17, [](int) { return "0.02"; });
    return Write("lists.json",
                 fmt::format(R"([{{"instances": [{{"keypoints": [{}], "{}": [{}]}}]}}])", points, key, scores));
  };
  ASSERT_OK(film, ReadKeypoints(lists("kpt_scores", "[3, 4]"), ""));
  EXPECT_EQ(film->frames.at(0).at(0)[Landmark::kLeftHip].confidence, 0.02);
  EXPECT_THAT(Reason(lists("sureties", "[3, 4]")),
              HasSubstr("a person has the list 'sureties' in addition to the keypoints"));
  EXPECT_THAT(Reason(lists("keypoint_scores", "[0.3, 0.4, 0.5]")), HasSubstr("3 coordinates in addition to a score"));
}

TEST_F(ReadPeople, NamesTheProgramsWhoseFilesAreNotRead) {
  EXPECT_THAT(Reason(Write("a.h5", "\x89HDF\r\n\x1a\n")), HasSubstr("an HDF5 file, as DeepLabCut"));
  EXPECT_THAT(Reason(Write("b.csv", "track,frame_idx\n")), HasSubstr("a CSV file, as DeepLabCut and SLEAP write"));
  const auto folder = *TemporaryFolder::Make("yolo");
  ASSERT_TRUE(WriteFileAtomically(folder.path() / "cam1_1.txt", "0 0.5 0.5"));
  EXPECT_THAT(Reason(folder.path()), HasSubstr("text files, as YOLO writes"));
  Write("results_cam7.json", "[]");
  EXPECT_EQ(EntryOfFilm(folder_.path(), "cam7")->filename(), "results_cam7.json");
}

}  // namespace
}  // namespace etude
