#pragma once

namespace etude {

/// How high the hips stand of the body that performs a scenario's clips, metres: StandingPose, scaled to it.
inline constexpr double kScenarioHipHeight = 0.90;

}  // namespace etude
