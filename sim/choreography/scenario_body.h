#pragma once

namespace etude {

/// The height of the hips of the body that performs a scenario's clips, metres: StandingPose, scaled to it.
inline constexpr double kScenarioHipHeight = 0.90;

}  // namespace etude
