#include "engine/transitions/transition_record.h"

#include "engine/base/named.h"

namespace etude {

namespace {

constexpr Named<Branch> kBranches[] = {{"none", Branch::kNone},
                                       {"now", Branch::kNow},
                                       {"end", Branch::kEnd},
                                       {"standing pose", Branch::kStandingPose},
                                       {"front half", Branch::kFrontHalf},
                                       {"rear half", Branch::kRearHalf},
                                       {"in-between", Branch::kInBetween},
                                       {"forced", Branch::kForced},
                                       {"unbroken", Branch::kUnbroken}};
constexpr Named<CandidateOutcome> kOutcomes[] = {{"taken", CandidateOutcome::kTaken},
                                                 {"too far", CandidateOutcome::kTooFar},
                                                 {"later", CandidateOutcome::kLater},
                                                 {"worse", CandidateOutcome::kWorse}};

}  // namespace

std::string_view BranchName(Branch branch) { return NameOfValue(kBranches, branch); }

std::string_view OutcomeName(CandidateOutcome outcome) { return NameOfValue(kOutcomes, outcome); }

double WaitOf(const std::vector<Segment>& segments, double rate_hz) {
  double frames = 0;
  for (std::size_t i = 0; i + 1 < segments.size(); ++i) frames += segments[i].last - segments[i].first;
  return frames / rate_hz;
}

}  // namespace etude
