#include <gtest/gtest.h>

#include <array>
#include <map>

#include "engine/transitions/choices/choice.h"
#include "engine/transitions/choices/matching.h"
#include "engine/transitions/choices/played.h"
#include "engine/transitions/choices/rehearsal.h"
#include "engine/transitions/choices/through_in_between.h"
#include "tests/engine/transitions/prints.h"

namespace etude {
namespace {

using testing::Fingerprint;

MotionLibrary GoldenLibrary(const std::string& name) {
  if (name == "ties") return LibraryOfTies();
  if (name == "moves") return LibraryOfMoves();
  if (name == "lying") return LibraryOfLying();
  RandomStream dice({.suite_seed = 6, .scenario = "golden", .trial = 0}, "clips");
  return RandomLibrary(dice, {37, 52, 23, 90, 2});
}

/// Requests between all clips, at any frame, the last one too, some with no time to wait and some with plenty.
std::vector<TransitionRequest> RequestsOf(const MotionLibrary& library, int count) {
  testing::Dice dice(7);
  std::vector<TransitionRequest> requests;
  const std::size_t clips = library.motions.size();
  for (int i = 0; i < count; ++i) {
    TransitionRequest request{.from = static_cast<int>(dice.Below(clips)), .request_frame = 0, .to = 0};
    request.to = static_cast<int>((request.from + 1 + dice.Below(clips - 1)) % clips);
    const int frames = library.tagged[request.from].FrameCount();
    request.request_frame = i == 4 ? frames - 1 : static_cast<int>(dice.Below(frames));
    request.budget_s = std::array{1.0, 0.5, 0.31, 2.0, 1.0, 0.0}[i % 6];
    requests.push_back(request);
  }
  return requests;
}

/// Paper A's rules; others on every count; comparing inside the class alone; and hardly ever a match.
std::array<MatchRules, 4> FourRules() {
  std::array<MatchRules, 4> rules;
  rules[1].weights = {0.25, 1.5, 0.5, 1, 2, 0.75, 0.3, 0.7, 0.5, 0.5};
  rules[1].threshold = 0.125;
  rules[1].pick = Pick::kSmallest;
  rules[2].threshold = 1.5;
  rules[2].within_class = true;
  rules[3].threshold = 0.01;
  return rules;
}

std::vector<double> OtherSettings(const Choice& choice) {
  std::vector<double> values;
  for (const NumberSetting& setting : choice.settings) values.push_back(0.4 * setting.fallback);
  return values;
}

Fingerprint PrintOfChoice(const std::string& name, const MotionLibrary& library) {
  const Choice& choice = *FindChoice(name);
  const bool is_dear = name == "played";
  Fingerprint print;
  for (const TransitionRequest& request : RequestsOf(library, is_dear ? 5 : 14)) {
    for (const MatchRules& rules : FourRules()) {
      if (is_dear && (rules.within_class || rules.threshold < 0.1)) continue;
      const bool is_other = rules.pick == Pick::kSmallest;
      const std::vector<double> values = is_other ? OtherSettings(choice) : std::vector<double>();
      AddTo(print, choice.plan(library, request, rules, values));
      if (choice.allowed == nullptr) continue;
      const AllowedFrames allowed = choice.allowed(library, request, values);
      print.Add(allowed.leave).Add(allowed.enter);
    }
  }
  return print;
}

struct KeptPair {
  std::string what;
  std::size_t count;
  double sum;
};

void ExpectKept(const std::string& library_name, const std::vector<KeptPair>& kept) {
  const MotionLibrary library = GoldenLibrary(library_name);
  for (const auto& [choice, count, sum] : kept) {
    EXPECT_TRUE(PrintOfChoice(choice, library).Is(count, sum)) << choice;
  }
}

TEST(ChoicesGolden, OfDifferingClips) {
  ExpectKept("random", {{"fuzzy-bridge", 50117, -2823.78964786},
                        {"fuzzy-kovar", 50651, 1107.47651445},
                        {"fuzzy-window", 50611, 3196.4563656},
                        {"point-cloud", 16995, 6083.99519026},
                        {"motion-matching", 17846, 4552.94911453},
                        {"played", 2731, 1415.11356802},
                        {"through-standing", 88700, 2952.55962932},
                        {"now", 5096, 2366.88673554},
                        {"wait-for-end", 5488, -586.177833455},
                        {"unbroken", 3568, 2706.36768581}});
}

TEST(ChoicesGolden, OfClipsInWhichNearlyEverythingTies) {
  ExpectKept("ties", {{"fuzzy-bridge", 25100, -3621.03262281},
                      {"fuzzy-kovar", 23517, -2291.91560997},
                      {"fuzzy-window", 23326, -1325.30630846},
                      {"point-cloud", 19990, 729.871138666},
                      {"motion-matching", 20829, -3081.6397597},
                      {"played", 3541, 2371.23768012},
                      {"through-standing", 72128, -5747.64815355}});
}

TEST(ChoicesGolden, OfMovesThatBridgeFramesJoin) {
  ExpectKept("moves", {{"fuzzy-bridge", 67408, 8853.84297269},
                       {"fuzzy-kovar", 70299, -9005.43276076},
                       {"fuzzy-window", 70262, 20974.7473802},
                       {"point-cloud", 24328, 26528.8781102},
                       {"motion-matching", 25195, 32274.5233412},
                       {"played", 2126, 1352.99568402},
                       {"through-standing", 119924, 1713.46431175}});
}

TEST(ChoicesGolden, OfWhoLiesAndStands) {
  ExpectKept("lying", {{"fuzzy-bridge", 53523, 8553.67986455},
                       {"fuzzy-kovar", 52355, -5837.69760636},
                       {"played", 2499, 585.436073357}});
}

TEST(ChoicesGolden, OfWaysThroughClips) {
  const MotionLibrary library = LibraryOfLying();
  Fingerprint print;
  for (const auto& [from, to] : {std::pair{0, 1}, {1, 0}, {0, 3}, {2, 1}, {4, 1}, {3, 4}, {5, 2}}) {
    for (const double most_s : {0.2, 0.3, 1.0, 2.0, 4.0, 60.0}) {
      const TransitionRequest request{.from = from, .request_frame = 9, .to = to, .budget_s = 0.7};
      AddTo(print, PlanPlayed(library, request, {}, {.most_through_s = most_s}));
    }
  }
  EXPECT_TRUE(print.Is(10546, -388.208023641));
}

TEST(ChoicesGolden, OfEveryWayThatIsPlayed) {
  const MotionLibrary moves = LibraryOfMoves(), lying = LibraryOfLying();
  Fingerprint print;
  const auto add = [&](const MotionLibrary& library, const TransitionRequest& request, const PlayedRates& rates,
                       const std::vector<FramePair>& pairs, int last) {
    for (const PlayedWay& way : PlayWays(library, request, rates, pairs, last)) {
      print.Add(way.pair.leave).Add(way.pair.enter).Add(way.number).Add(way.frames).Add(way.way).Add(way.cost_s);
      print.Add(way.unsupported);
    }
  };
  const PlayedRates rates{.excess_per_s = 0.2, .invented_per_s = 5};
  add(moves, {.from = 0, .request_frame = 20, .to = 4}, rates, {{20, 0}, {31, 7}, {38, 3}}, 180);
  add(moves, {.from = 1, .request_frame = 0, .to = 2}, {.excess_per_s = 3, .invented_per_s = 0.5}, {{0, 0}, {4, 1}},
      30);
  add(moves, {.from = 5, .request_frame = 60, .to = 3}, rates, {{62, 30}}, 33);
  add(lying, {.from = 1, .request_frame = 5, .to = 3}, rates, {{5, 0}, {8, 20}, {60, 46}}, 46);
  add(lying, {.from = 2, .request_frame = 70, .to = 0}, {.excess_per_s = 0.02, .invented_per_s = 50}, {{74, 2}}, 21);
  add(lying, {.from = 1, .request_frame = 50, .to = 3}, rates, {{60, 46}}, 46);
  EXPECT_TRUE(print.Is(126, 2718.30210737));
}

TEST(ChoicesGolden, OfRowsOfCosts) {
  RandomStream dice({.suite_seed = 6, .scenario = "golden", .trial = 1}, "rows");
  const MotionLibrary library = RandomLibrary(dice, {29, 43});
  const std::vector<int> enter = {0, 1, 6, 7, 8, 15, 16, 21, 30, 41, 42};
  std::vector<double> costs(enter.size());
  const MatchRules rules = FourRules()[1];
  Fingerprint clouds, windows;
  for (const int first : {0, 3, 11}) {
    for (const int reach : {0, 1, 4, 9}) {
      FuzzyWindowRows fuzzy(library.tagged[0].grades, library.tagged[1].grades, first, reach, rules.weights);
      PointCloudRows cloud(library.motions[0], library.motions[1], first, 0.11 * reach);
      for (int leave = first; leave < 29; leave += 2) {
        fuzzy.Compute(leave, enter, costs);
        windows.Add(costs);
        cloud.Compute(leave, enter, costs);
        clouds.Add(costs);
      }
    }
  }
  EXPECT_TRUE(windows.Is(1776, 37.8615922763));
  EXPECT_TRUE(clouds.Is(1776, 255.368235593));
}

TEST(ChoicesGolden, OfWhatIsSaidOfThem) {
  Fingerprint print;
  for (const Choice& choice : AllChoices()) {
    print.Add(choice.name).Add(choice.description).Add(choice.matches_poses).Add(choice.uses_fuzzy);
    AddTo(print, choice.settings);
  }
  for (const TransitionRecord& record :
       {PlanFuzzyWindow(LibraryOfTies(), {.from = 1, .request_frame = 3, .to = 3}, {}, {.reach_s = 0.1}),
        PlanPointCloud(LibraryOfTies(), {.from = 1, .request_frame = 3, .to = 3}, {}, {.window_s = 0.1}),
        PlanFuzzyKovar(LibraryOfTies(), {.from = 2, .request_frame = 3, .to = 0}, {}, {.window_s = 1})}) {
    AddTo(print, record);
  }
  EXPECT_TRUE(print.Is(2832, -571270.609544));
}

}  // namespace
}  // namespace etude
