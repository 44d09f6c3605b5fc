#include "engine/transitions/base/transition_record.h"

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

std::string_view FateName(Fate fate) {
  switch (fate) {
    case Fate::kTaken:
      return "taken";
    case Fate::kTooFar:
      return "too far";
    case Fate::kLater:
      return "later";
    case Fate::kWorse:
      return "worse";
  }
  return "";
}

double WaitOf(const std::vector<Leg>& legs, double rate_hz) {
  double frames = 0;
  for (std::size_t i = 0; i + 1 < legs.size(); ++i) frames += legs[i].last - legs[i].first;
  return frames / rate_hz;
}

}  // namespace etude
