// Every transition that a session can need, by paper A's method (sections 3.5 and 4): from the end of every window to
// every corrective act, on to the slow demonstration, and back to the dance.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <tuple>

#include "engine/coaching/playback.h"
#include "engine/transitions/choices/choice.h"
#include "engine/transitions/joins/join.h"
#include "sim/choreography/dance_of.h"
#include "sim/choreography/song.h"

namespace etude {
namespace {

constexpr int kWindowLag = 9;  // frames after the repetition, the coaches' default
constexpr double kWaitLimit_s = TransitionRequest{}.budget_s;

/// Counts over all transitions of a song.
struct Ways {
  int count = 0, through_in_betweens = 0, unmatched = 0;
  double longest_s = 0;
  std::set<std::string> pairs;  ///< (clip left, clip entered)
};

void Add(const ShownPath& path, const std::string& pair, Ways& ways) {
  ++ways.count;
  const Branch branch = path.record->branch;
  ways.through_in_betweens += branch == Branch::kInBetween;
  ways.unmatched += branch != Branch::kFrontHalf && branch != Branch::kRearHalf && branch != Branch::kInBetween;
  ways.longest_s = std::max(ways.longest_s, static_cast<double>(path.entered) / kJudgedRateHz);
  ways.pairs.insert(pair);
}

Ways WaysOf(const std::string& song, const char* choice) {
  const Dance dance = *DanceOf(*LoadBuiltinSong(song));
  const DanceLibrary library = *DanceLibrary::Make(dance);
  const DanceTransitions transitions(library, {.choice = FindChoice(choice), .join = FindJoin("cut")});
  const auto last_of = [&](int clip) { return static_cast<int>(library.library().motions[clip].poses.size()) - 1; };
  Ways ways;
  for (int r = 0; r < static_cast<int>(dance.repetitions.size()); ++r) {
    const Repetition& repetition = dance.repetitions[static_cast<std::size_t>(r)];
    const std::string move = dance.moves[static_cast<std::size_t>(repetition.move)].name;
    const auto closes = static_cast<double>(repetition.end + kWindowLag);
    const int leaving = library.ClipLeaving(library.RepetitionAt(closes));
    const int frame =
        std::min(static_cast<int>(closes - static_cast<double>(library.DanceFrameOf(leaving))), last_of(leaving));
    const int slow = library.ClipOfSlow(repetition.move);
    for (const std::string act : {"head_shake", "wave", "puzzled"}) {
      const int whole = library.ClipOfAct(act);
      Add(*transitions.Find(leaving, frame, library.ClipEntering(whole)), move + " > " + act, ways);
      Add(*transitions.Find(whole, last_of(whole) - 30, library.ClipEntering(slow)), act + " > slow " + move, ways);
    }
    Add(*transitions.Find(slow, last_of(slow) - 30, library.ClipReturning(r)), "slow " + move + " > " + move, ways);
  }
  return ways;
}

TEST(Ways, NoneTakesLongerThanTheWaitAndTheLongestInBetween) {
  for (const std::string& song : BuiltinSongNames()) {
    const Ways ways = WaysOf(song, "fuzzy-bridge");
    EXPECT_GT(ways.count, 100) << song;
    EXPECT_LE(ways.longest_s, kWaitLimit_s + LongestInBetween({}, kJudgedRateHz)) << song;
    EXPECT_GT(ways.longest_s, 0) << song;
  }
}

// Paper A's method saves work: bridge frames and one common set of in-betweens join all these pairs, so nobody has to
// draw in-betweens for each pair.
TEST(Ways, AreAllCarriedByBridgeFrames) {
  for (const std::string& song : BuiltinSongNames()) {
    const Ways ways = WaysOf(song, "fuzzy-bridge");
    RecordProperty(song + "_pairs", static_cast<int>(ways.pairs.size()));
    RecordProperty(song + "_through_in_betweens", ways.through_in_betweens);
    EXPECT_GE(ways.pairs.size(), 56u) << song;  // seven pairs for each of at least eight moves
    EXPECT_EQ(ways.unmatched, 0) << song << ": of " << ways.count;
    EXPECT_LT(ways.through_in_betweens, ways.count) << song;
  }
}

// The way back must lead to the frames before the repeated one. Paper A's choice sometimes finds no match there.
TEST(Ways, BackLeadToBeforeTheRepetition) {
  for (const std::string& song : BuiltinSongNames()) {
    const DanceLibrary library = *DanceLibrary::Make(*DanceOf(*LoadBuiltinSong(song)));
    const int most_of_paper = static_cast<int>(library.dance().repetitions.size()) / 4;
    for (const auto& [choice, join, most] :
         {std::tuple{"fuzzy-bridge", "cut", most_of_paper}, std::tuple{"played", "planted-feet", 0}}) {
      const DanceTransitions transitions(library, {.choice = FindChoice(choice), .join = FindJoin(join)});
      int late = 0;
      for (int r = 1; r < static_cast<int>(library.dance().repetitions.size()); ++r) {
        const Repetition& repetition = library.dance().repetitions[static_cast<std::size_t>(r)];
        const int slow = library.ClipOfSlow(repetition.move), back = library.ClipReturning(r);
        const int last = static_cast<int>(library.library().motions[slow].poses.size()) - 1;
        const auto path = transitions.Find(slow, last - 30, back);
        late += library.DanceFrameOf(back) + static_cast<std::size_t>(path->clip_frame) > repetition.first + kWindowLag;
      }
      EXPECT_LE(late, most) << song << ", " << choice;
    }
  }
}

TEST(Ways, AreNotCarriedByThemWhoIsCutOffAtOnce) {  // the control
  const Ways ways = WaysOf("groove", "now");
  EXPECT_EQ(ways.unmatched, ways.count);
}

}  // namespace
}  // namespace etude
