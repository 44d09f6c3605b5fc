#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bench/metrics/ik_error.h"

namespace etude {

/// How well a motion is followed, frame by frame (docs/metrics.md, Tracking).
struct TrackedFrame {
  IkErrorSummary errors;
  bool keeps_limits = true;
};

/// Practically: 0.1 cm and 0.1° of every axis, all limits kept.
bool IsFrameSolved(const TrackedFrame& frame);

/// `frames_solved` and `frames_solved_tight`: shares of frames. Needs a frame.
double ShareSolvedPractically(std::span<const TrackedFrame> frames);
double ShareSolvedTightly(std::span<const TrackedFrame> frames);

/// `iterations_per_frame` and `iterations_per_frame_p95`. Needs a frame.
struct FrameIterations {
  double mean = 0;
  double p95 = 0;
};
FrameIterations SummariseIterations(std::span<const int> iterations);

/// `angle_jerk_ratio`: how much jerkier the angles found are than the true ones, [frame][angle] in radians, as many
/// of one as of the other. Nothing for fewer than four frames, or when the truth stands still but for rounding.
std::optional<double> AngleJerkRatio(std::span<const std::vector<double>> found,
                                     std::span<const std::vector<double>> truth);

}  // namespace etude
