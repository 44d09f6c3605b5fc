#include "sim/choreography/dance_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/coaching/dance_library.h"
#include "tests/support/kept_answers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

TEST(DanceOf, EveryBuiltinSongIsADanceACoachCanDo) {
  for (const std::string& name : BuiltinSongNames()) {
    const auto song = LoadBuiltinSong(name);
    ASSERT_OK(dance, DanceOf(*song));
    EXPECT_TRUE(CheckDance(*dance)) << ToString(CheckDance(*dance).error());
    EXPECT_EQ(dance->repetitions.size(), dance->tags.size());
    EXPECT_GE(dance->moves.size(), 8U);
    std::size_t times = 0;
    for (const SongPart& part : song->parts) times += static_cast<std::size_t>(part.times);
    EXPECT_EQ(dance->repetitions.size(), times);
    EXPECT_EQ(MovesOf(*song)->size(), dance->moves.size());
  }
}

TEST(HintOf, SaysTheKeyPoseInWords) {
  EXPECT_EQ(HintOf(*LoadBuiltinMove("bird")), "both arms at shoulder height, both elbows slightly bent");
  EXPECT_EQ(HintOf(*LoadBuiltinMove("boxing")),
            "left arm at shoulder height, right arm half raised, left elbow straight, right elbow bent; then the other "
            "side");
}

TEST(ReadBeats, ReadsWhatBeatTrackersAndLabelTracksWrite) {
  ASSERT_OK(beats, ReadBeats("# my song\n0.5\n1.0\t1.0\tbeat\n\n1.5 x\n2,1\n2.5\n3\r\n3.5\n  4.0\n", "my.txt"));
  EXPECT_THAT(*beats, ::testing::ElementsAre(0.5, 1.0, 1.5, 2, 2.5, 3, 3.5, 4));
  EXPECT_DOUBLE_EQ(TempoOf(*beats), 120);
}

TEST(ReadBeats, TellsWhereAndWhatIsWrong) {
  EXPECT_TRUE(testing::AnswersAreKept("tests/sim/choreography/beat_complaints.txt", [](const std::string& text) {
    return testing::Refusal(ReadBeats(text, "my.txt"));
  }));
}

TEST(ToBeats, PutsEveryTagOnItsBeat) {
  const auto dance = DanceOf(*LoadBuiltinSong("warm_up"));
  std::vector<double> even, swinging;
  for (int beat = 0; beat < 200; ++beat) {
    even.push_back(1 + beat * 60 / dance->tempo_bpm);
    swinging.push_back(even.back() + (beat % 2 == 0 ? 0 : 0.05));
  }
  const auto shifted = ToBeats(*dance, even), swung = ToBeats(*dance, swinging);
  for (std::size_t i = 0; i < dance->tags.size(); ++i) {
    EXPECT_NEAR(shifted->tags[i].music_s, dance->tags[i].music_s + 1, 1e-9);
    // Tags of whole moves are at even beats.
    EXPECT_NEAR(swung->tags[i].music_s, dance->tags[i].music_s + 1, 1e-9);
  }
  even.resize(50);
  EXPECT_THAT(testing::Message(ToBeats(*dance, even)), HasSubstr("50 beats, but 'warm_up' needs"));
}

}  // namespace
}  // namespace etude
