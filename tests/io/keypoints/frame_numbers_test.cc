#include "io/keypoints/frame_numbers.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <functional>

#include "tests/io/keypoints/keypoint_files.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

TEST(FileNames, AreNumberedIfTheyDifferInNumbers) {
  const auto are = [](std::vector<std::string> names) { return AreNumbered(names); };
  EXPECT_TRUE(are({"f_9.png", "f_10.png", "f_1.png"}));
  EXPECT_TRUE(are({"shot1_f10.png", "shot1_f11.png"}));
  EXPECT_TRUE(are({"7.png", "8.png"}));
  EXPECT_FALSE(are({"f_1.png", "f_1.png"})) << "one name twice";
  EXPECT_FALSE(are({"a1.png", "b2.png"}));
  EXPECT_FALSE(are({"f.png", "f_1.png"}));
  EXPECT_FALSE(are({"", ""}));
  EXPECT_FALSE(are({}));
}

/// Reads lists and folders in which the nose of frame k is at x = k + 1.
class FrameNumbers : public testing::KeypointFiles {
 protected:
  static std::string Points(int k) {
    std::string points;
    for (int i = 0; i < 17; ++i) points += fmt::format("{}[{}, 20, 0.9]", i == 0 ? "" : ", ", i == 0 ? k + 1 : 99);
    return "[" + points + "]";
  }
  /// Writes an entry for each of these frames; `key` gives the members before the keypoints.
  std::filesystem::path List(const std::vector<int>& frames, const std::function<std::string(int)>& key) {
    std::string text;
    for (const int k : frames) {
      text += fmt::format(R"({}{{{}"keypoints": {}}})", text.empty() ? "" : ", ", key(k), Points(k));
    }
    return Write("list.json", "[" + text + "]");
  }
  /// Returns the true number of each frame that was read, -1 for a frame without people.
  std::vector<double> Noses(const std::filesystem::path& path, std::size_t frames, std::string* told = nullptr) {
    const auto film = ReadKeypoints(path, "", {.frames = frames});
    if (!film) ADD_FAILURE() << ToString(film.error());
    std::vector<double> noses;
    for (const auto& frame : film ? film->frames : SeenPeople{}) {
      noses.push_back(frame.empty() ? -1 : frame[0][Landmark::kNose].pixel.x - 1.5);
    }
    if (told != nullptr && film) *told = film->told;
    return noses;
  }
  static std::vector<int> Range(int first, int last, int step = 1) {
    std::vector<int> range;
    for (int k = first; k <= last; k += step) range.push_back(k);
    return range;
  }
  /// The frames that a film of 12 shows if only these were read.
  static std::vector<double> OfTwelve(const std::vector<int>& read) {
    std::vector<double> all(12, -1);
    for (const int k : read) all[static_cast<std::size_t>(k)] = k;
    return all;
  }
};

TEST_F(FrameNumbers, AListWithoutNumbersHasTheFramesThatItLists) {
  const auto none = [](int) { return ""; };
  EXPECT_EQ(Noses(List(Range(3, 8), none), 12), (std::vector<double>{3, 4, 5, 6, 7, 8})) << "none is added";
  EXPECT_THAT(Reason(List(Range(3, 8), [](int k) { return k == 5 ? "" : fmt::format("\"frame\": {}, ", k); })),
              HasSubstr("entry 2 has no frame number, but the first entry has one"));
}

TEST_F(FrameNumbers, EntriesOfOneFrameAreItsPeople) {
  const auto path = Write("list.json", fmt::format(R"([{{"frame": 1, "keypoints": {}}}, {{"frame": 0, "keypoints": {}}},
                                         {{"frame": 1, "keypoints": {}}}, {{"frame": 1, "keypoints": null}}])",
                                                   Points(1), Points(0), Points(5)));
  ASSERT_OK(film, ReadKeypoints(path, ""));
  ASSERT_EQ(film->frames.size(), 2u);
  EXPECT_EQ(film->frames[0].size(), 1u);
  ASSERT_EQ(film->frames[1].size(), 2u);
  EXPECT_EQ(film->frames[1][0][Landmark::kNose].pixel.x, 2.5);
  EXPECT_EQ(film->frames[1][1][Landmark::kNose].pixel.x, 6.5);
}

TEST_F(FrameNumbers, AFlatListOfNumbersIsOnePerson) {
  const auto flat = [&](const std::string& numbers) {
    return Write("flat.json", "[{\"frame\": 0, \"track_id\": 3, \"keypoints\": [" + numbers + "]}]");
  };
  ASSERT_OK(film, ReadKeypoints(flat(Triples(17)), ""));
  EXPECT_EQ(film->frames[0][0][Landmark::kNose].pixel, glm::dvec2(10.5, 20.5));
  EXPECT_THAT(Reason(flat("1, 2, 3, 4")),
              HasSubstr("(4 numbers); allowed: a list with x, y and confidence for each keypoint"));
  ASSERT_OK(unseen, ReadKeypoints(flat("null, null, null" + Triples(17).substr(Triples(1).size())), ""));
  EXPECT_EQ(unseen->frames[0][0][Landmark::kNose].confidence, 0);
}

TEST_F(FrameNumbers, BeyondTheFilmAreNumbersOfALongerOne) {
  const auto id = [](int k) { return fmt::format("\"frame_id\": {}, ", k + 100); };
  std::string told;
  EXPECT_EQ(Noses(List(Range(0, 11), id), 12, &told), OfTwelve(Range(0, 11)));
  EXPECT_THAT(
      told,
      HasSubstr("frame numbers go from 100 to 111, and the film has 12 frames; Etude assumes that number 100 is the"));
  EXPECT_EQ(Noses(List({0, 1, 5, 11}, id), 12), OfTwelve({0, 1, 5, 11}));
  const auto fifth = [](int k) { return fmt::format("\"frame_id\": {}, ", 5 * k + 10); };
  EXPECT_EQ(Noses(List({0, 1, 2, 5, 11}, fifth), 12), OfTwelve({0, 1, 2, 5, 11}));
  EXPECT_THAT(Reason(List(Range(0, 9), id), "", {.frames = 12}),
              HasSubstr("frame numbers go from 100 to 109, but the film has 12 frames; allowed: numbers from 0 or 1"));
}

TEST_F(FrameNumbers, OfFilesWithGapsAreTheFilmsFrames) {
  auto folder = [&, count = 0](const std::vector<int>& frames, int first) mutable {
    const std::string name = fmt::format("folder-{}", ++count);
    for (const int k : frames) {
      Write(fmt::format("{}/cam_{:012}_keypoints.json", name, k + first), "[{\"keypoints\": " + Points(k) + "}]");
    }
    return folder_.path() / name;
  };
  std::string told;
  EXPECT_EQ(Noses(folder(Range(0, 11, 2), 0), 12, &told), OfTwelve(Range(0, 11, 2)));
  EXPECT_THAT(told, HasSubstr("6 of 12 frames are missing"));
  EXPECT_EQ(Noses(folder(Range(0, 11, 5), 0), 12), OfTwelve(Range(0, 11, 5)));
  EXPECT_EQ(Noses(folder({0, 2, 8, 10}, 0), 12), OfTwelve({0, 2, 8, 10})) << "with a gap";
  EXPECT_EQ(Noses(folder(Range(0, 11, 3), 1), 12), OfTwelve(Range(0, 11, 3))) << "counted from 1";
  EXPECT_EQ(Noses(folder(Range(2, 11, 3), 0), 12, &told), OfTwelve(Range(2, 11, 3)));
  EXPECT_THAT(
      told,
      HasSubstr("file numbers go from 2 to 11, and the film has 12 frames; Etude assumes that the numbers count"));
  // Files that break off, and files of a longer film, are not extended.
  EXPECT_EQ(Noses(folder(Range(0, 4, 2), 0), 12).size(), 3u);
  EXPECT_EQ(Noses(folder(Range(0, 8), 0), 12).size(), 9u);
  EXPECT_EQ(Noses(folder({0, 1, 3, 4}, 100), 12).size(), 5u);
  EXPECT_EQ(Noses(folder({0, 1, 2, 4, 12}, 0), 12).size(), 13u);
}

TEST_F(FrameNumbers, TimesCountFromTheFilmsStartIfTheyLieWithinIt) {
  const auto ms = [](double start) {
    return [start](int k) { return fmt::format("\"timestamp_ms\": {:.0f}, ", start + 1e3 * k / 30); };
  };
  EXPECT_EQ(Noses(List({0, 1, 2, 5, 6, 7}, ms(0)), 12), OfTwelve({0, 1, 2, 5, 6, 7}));
  EXPECT_EQ(Noses(List({3, 4, 5, 6, 9, 10}, ms(0)), 12), OfTwelve({3, 4, 5, 6, 9, 10}));
  EXPECT_EQ(Noses(List({3, 4, 5, 9, 10, 11}, ms(1e3 / 30)), 12), OfTwelve({3, 4, 5, 9, 10, 11})) << "the next frame's";
  EXPECT_EQ(Noses(List({3, 4, 5, 9, 10, 11}, ms(1e12)), 12), (std::vector<double>{3, 4, 5, -1, -1, -1, 9, 10, 11}));
}

// Only a film whose last frame shows a person tells 0…N − 1 from 1…N; a session has one numbering.
TEST_F(FrameNumbers, CountFromOneIfAnotherFilmDoes) {
  const auto id = [](int k) { return fmt::format(R"("image_id": {}, )", k + 1); };
  const auto list = List(Range(2, 9), id);
  for (const bool from_one : {false, true}) {
    const auto film = ReadKeypoints(list, "", {.frames = 12, .from_one = from_one});
    ASSERT_TRUE(film);
    EXPECT_TRUE(film->is_base_open);
    EXPECT_EQ(film->frames[2].empty(), !from_one) << "frame 2 is the first of the list";
    EXPECT_THAT(film->told, HasSubstr(from_one ? "from 1, as in another film" : "from 0"));
  }
  const auto whole = ReadKeypoints(List(Range(2, 11), id), "", {.frames = 12});
  ASSERT_TRUE(whole);
  EXPECT_TRUE(whole->is_from_one);
  EXPECT_FALSE(whole->is_base_open);
}

TEST_F(FrameNumbers, HaveKnownNamesOrAreRefused) {
  for (const char* name : {"frame_idx", "frame_number", "frame_id"}) {
    const auto path = List({0, 1, 5, 11}, [&](int k) { return fmt::format(R"("{}": {}, )", name, k); });
    EXPECT_EQ(Noses(path, 12), OfTwelve({0, 1, 5, 11})) << name;
  }
  const auto path =
      List({0, 1, 5}, [&](int k) { return fmt::format(R"("frames_so_far": {}, "frame_rate": 30, )", k); });
  EXPECT_THAT(Reason(path, "", {.frames = 3}), HasSubstr("the key 'frames_so_far' of entry 1 may be a frame number"));
}

}  // namespace
}  // namespace etude
