#include <gtest/gtest.h>

#include "engine/motion/body.h"
#include "tests/engine/transitions/prints.h"

namespace etude {
namespace {

using testing::Fingerprint;

TEST(TransitionsGolden, OfNamesAndDefaults) {
  std::vector<std::string_view> names;
  for (int b = 0; b <= static_cast<int>(Branch::kUnbroken); ++b) names.push_back(BranchName(static_cast<Branch>(b)));
  for (int o = 0; o <= static_cast<int>(CandidateOutcome::kWorse); ++o) {
    names.push_back(OutcomeName(static_cast<CandidateOutcome>(o)));
  }
  EXPECT_EQ(names,
            (std::vector<std::string_view>{"none", "now", "end", "standing pose", "front half", "rear half",
                                           "in-between", "forced", "unbroken", "taken", "too far", "later", "worse"}));
  const TransitionRequest request;
  Fingerprint print;
  TransitionRecord record;
  record.segments.resize(1);
  record.candidates.resize(1);
  AddTo(print, record);
  const MatchRules rules;
  print.Add(request.from).Add(request.request_frame).Add(request.to).Add(request.budget_s);
  print.Add(rules.weights).Add(rules.threshold).Add(rules.pick).Add(rules.within_class).Add(PreferredJoin().blend_s);
  EXPECT_TRUE(print.Is(51, 4.43795993952));
}

TEST(TransitionsGolden, OfAlignmentsGapsAndWaits) {
  const MotionLibrary moves = LibraryOfMoves(), lying = LibraryOfLying();
  Fingerprint print;
  for (const MotionLibrary* library : {&moves, &lying}) {
    for (std::size_t clip = 0; clip < library->motions.size(); ++clip) {
      const std::vector<BodyPose>&a = library->motions[clip].poses, &b = library->motions[(clip + 1) % 6].poses;
      const FloorMove move = AlignOnFloor(a[7], b.back());
      print.Add(move.yaw).Add(move.x).Add(move.z).Add(PoseGap(a[7], b.back())).Add(PoseGap(b[11], a[2]));
    }
  }
  const std::vector<Segment> segments = {{.clip = 0, .first = 3, .last = 21, .own = {}},
                                         {.clip = 1, .first = 5, .last = 6, .own = {}},
                                         {.clip = 2, .first = 9, .last = 90, .own = {}}};
  print.Add(WaitOf(segments, 30)).Add(WaitOf(segments, 24)).Add(WaitOf({segments[0]}, 30)).Add(WaitOf({}, 30));
  EXPECT_TRUE(print.Is(64, 2.78723578198));
}

}  // namespace
}  // namespace etude
