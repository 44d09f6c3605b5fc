#pragma once

namespace etude {

/// The shortest median processor time of a method, in seconds, that can be compared with that of another method. A cell
/// is timed once, and a method that runs after another method first pays for cold caches, about 0.1 ms. In 0.5 ms, this
/// is a fifth.
inline constexpr double kMinJudgedSeconds = 0.0005;

}  // namespace etude
