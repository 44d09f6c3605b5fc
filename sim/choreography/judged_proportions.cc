#include "sim/choreography/judged_proportions.h"

#include "sim/choreography/canonical_body.h"

namespace etude {

BodyProportions JudgedProportions() { return MakeBodyProportions(StandingPose(), kScenarioHipHeight); }

}  // namespace etude
