#include "engine/transitions/transition_record.h"

namespace etude {

std::string_view BranchName(Branch branch) {
  switch (branch) {
    case Branch::kNone:
      return "none";
    case Branch::kNow:
      return "now";
    case Branch::kEnd:
      return "end";
    case Branch::kStandingPose:
      return "standing pose";
    case Branch::kFrontHalf:
      return "front half";
    case Branch::kRearHalf:
      return "rear half";
    case Branch::kInBetween:
      return "in-between";
    case Branch::kForced:
      return "forced";
    case Branch::kUnbroken:
      return "unbroken";
  }
  return "";
}

std::string_view OutcomeName(CandidateOutcome outcome) {
  switch (outcome) {
    case CandidateOutcome::kTaken:
      return "taken";
    case CandidateOutcome::kTooFar:
      return "too far";
    case CandidateOutcome::kLater:
      return "later";
    case CandidateOutcome::kWorse:
      return "worse";
  }
  return "";
}

double WaitOf(const std::vector<Segment>& segments, double rate_hz) {
  double frames = 0;
  for (std::size_t i = 0; i + 1 < segments.size(); ++i) frames += segments[i].last - segments[i].first;
  return frames / rate_hz;
}

}  // namespace etude
