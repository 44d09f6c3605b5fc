#include "bench/metrics/catalogue_parts.h"

namespace etude {
namespace {

using enum Direction;
using enum Aggregate;

const MetricInput kFrames = {"frames",
                             "per frame `effectors`, a list with `position_m` and `target_m`, [x, y, z] in metres, and "
                             "`axes` and `target_axes`, three unit vectors [x, y, z] each"};
const MetricInput kFrameIterations = {"frame_iterations", "per frame the solver's own steps"};
const char* const kFrameInHundred = "One frame in a hundred.";
const char* const kUntold = "When a method outside answers without telling what it took.";

}  // namespace

std::vector<MetricInfo> TrackingCatalogue() {
  return {
      {.id = "frames_solved",
       .label = "frames solved (0.1 cm, 0.1°)",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMean,
       .practical = 0.01,
       .definition = "Share of frames with all effectors within 0.1 cm and 0.1° of their targets and no limit broken.",
       .practical_reason = kFrameInHundred,
       .formula = "The mean over all frames, the first included, of solved_practical in that frame. The targets are "
                  "those that the solver was given: noise moves them, too.",
       .null_rule = "Never: no answer is 0.",
       .source = "Etude.",
       .inputs = {kFrames}},
      {.id = "frames_solved_tight",
       .label = "frames solved (10⁻³ cm, 10⁻³°)",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMean,
       .practical = 0.01,
       .definition =
           "Share of frames with all effectors within 0.001 cm and 0.001° of their targets and no limit broken.",
       .practical_reason = kFrameInHundred,
       .formula = "The mean over all frames, the first included, of solved_tight in that frame. Solvers stop short of "
                  "it unless stop_at is tight.",
       .null_rule = "Never: no answer is 0.",
       .source = "Etude: a hundredth of frames_solved.",
       .inputs = {kFrames}},
      {.id = "iterations_per_frame",
       .label = "solver steps per frame",
       .unit = "",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 1,
       .definition = "The solver's own steps, mean over the frames.",
       .practical_reason = "A step a frame is what a frame's time is divided into.",
       .formula =
           "(1/F) Σ_f iterations_f over all frames, solved or not; a frame that was not solved has spent at most "
           "the limit, so that few steps are no success: read it with frames_solved.",
       .null_rule = kUntold,
       .source = "Etude.",
       .inputs = {kFrameIterations}},
      {.id = "iterations_per_frame_p95",
       .label = "solver steps per frame, 95th percentile",
       .unit = "",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 1,
       .definition = "The steps that nineteen frames in twenty need no more than.",
       .practical_reason = "A step a frame is what a frame's time is divided into.",
       .formula = "The frames' iterations sorted, the one at rank 0.95 · (F − 1) counted from 0, linear between "
                  "neighbours: who must be in time for every frame pays for the slow ones.",
       .null_rule = kUntold,
       .source = "Etude; the percentile as in Hyndman and Fan 1996, definition 7.",
       .inputs = {kFrameIterations}},
      {.id = "angle_jerk_ratio",
       .label = "jerk of the angles, against the truth's",
       .unit = "",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 0.1,
       .definition = "How many times jerkier the joint angles are than the true ones: 1 is as smooth as the truth.",
       .practical_reason = "A tenth of the truth's own jerk.",
       .formula = "J(found) / J(true) with J(θ) = Σ_f Σ_i |θ_i(f) − 3 θ_i(f − 1) + 3 θ_i(f − 2) − θ_i(f − 3)| over all "
                  "angles and all frames from the fourth on: the mean size of the third difference, jitter, without "
                  "its unit. Angles are taken as they are, not modulo 360°. One that stands still has 0: read it with "
                  "the errors.",
       .null_rule =
           "Fewer than four frames, or a truth that stands still: third differences below 10⁻⁹ rad on average.",
       .source = "Jerk as a measure of smoothness: Flash and Hogan 1985; its mean size as jitter of captured motion: "
                 "Yi, Zhou and Xu 2021 (TransPose), there of joints in m/s³.",
       .inputs = {{"found_frames_deg", "per frame the solved angle of every degree of freedom, degrees"},
                  {"true_frames_deg", "the true angles likewise"}}},
  };
}

}  // namespace etude
