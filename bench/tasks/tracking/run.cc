#include "bench/tasks/tracking/run.h"

#include <algorithm>
#include <cassert>
#include <functional>

#include "bench/metrics/ik_error.h"
#include "bench/metrics/pose_error.h"
#include "bench/tasks/base/tree_json.h"
#include "engine/base/digest.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/ik_run.h"

namespace etude {
namespace {

IkProblem ProblemAt(const TrackingWorld& world, std::size_t frame, const std::vector<double>& start_angles) {
  IkProblem problem{world.truth[frame], world.targets[frame], world.tree.limits};
  problem.start.angles = start_angles;
  return problem;
}

/// Appends a frame's solution to the answer. Fails if the solver refused its input; the error says what is wrong with
/// `problem`.
Result<void> StoreSolution(IkSolution solution, const IkProblem& problem, const TrackingWorld& world,
                           const TrackingMethod& method, TrackingAnswer& answer) {
  if (solution.status == IkStatus::kBadInput) {
    return Fail({}, "frame {}: {}", answer.angles.size(), FindFault(world.tree, problem, method.options));
  }
  answer.angles.push_back(std::move(solution.angles));
  answer.iterations->push_back(solution.iterations);
  return {};
}

using Angles = std::vector<std::vector<double>>;  // indexed [frame][angle], radians

/// The measurements of an answer, frame by frame.
struct Outcome {
  std::vector<TrackedFrame> frames;
  BodyMotion truth, found;
  std::string first_broken_limit;
};

Outcome MeasureAnswer(const TrackingWorld& world, double rate_hz, const Angles& angles) {
  Outcome outcome{{}, {rate_hz, {}}, {rate_hz, {}}, ""};
  std::vector<EffectorError> errors;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    TreeState state = world.truth[k];
    outcome.truth.poses.push_back(ToBodyPose(world.tree, state));
    state.angles = angles[k];
    outcome.found.poses.push_back(ToBodyPose(world.tree, state));
    MeasureErrors(ComputeFrames(world.tree, state), world.targets[k], errors);
    const std::string broken = DescribeBrokenLimits(world.tree, angles[k], fmt::format("angles_deg[{}]", k));
    outcome.frames.push_back({SummariseIkErrors(errors), broken.empty()});
    if (outcome.first_broken_limit.empty()) outcome.first_broken_limit = broken;
  }
  return outcome;
}

Angles TrueAngles(const TrackingWorld& world) {
  Angles angles;
  for (const TreeState& state : world.truth) angles.push_back(state.angles);
  return angles;
}

std::vector<double> Concatenate(const Angles& frames) {
  std::vector<double> all;
  for (const std::vector<double>& angles : frames) all.insert(all.end(), angles.begin(), angles.end());
  return all;
}

std::string DigestOf(const TrackingWorld& world) {
  Digest digest;
  digest.Add(world.first_angles);
  for (std::size_t k = 0; k < world.truth.size(); ++k) {
    digest.Add(world.truth[k].angles);
    AddTo(digest, world.targets[k]);
  }
  return digest.Hex();
}

std::string DigestOf(const TrackingAnswer& answer) {
  Digest digest;
  for (const std::vector<double>& angles : answer.angles) digest.Add(angles);
  if (answer.iterations) {
    for (const int count : *answer.iterations) digest.Add(static_cast<std::int64_t>(count));
  }
  return digest.Hex();
}

template <class ValueOf>
Series AlongFrames(std::string name, std::span<const TrackedFrame> frames, ValueOf value_of) {
  Series series{std::move(name), "frame", {}};
  for (const TrackedFrame& frame : frames) series.values.push_back(value_of(frame));
  return series;
}

double MeanOf(const Series& series) {
  double sum = 0;
  for (const double value : series.values) sum += value;
  return sum / static_cast<double>(series.values.size());
}

void AddIterations(const std::optional<std::vector<int>>& iterations, CellResult& cell) {
  if (iterations) {
    const FrameIterations spent = SummariseIterations(*iterations);
    cell.Measure("iterations_per_frame", spent.mean);
    cell.Measure("iterations_per_frame_p95", spent.p95);
    cell.series.push_back({"iterations", "frame", {iterations->begin(), iterations->end()}});
  } else {
    for (const char* id : {"iterations_per_frame", "iterations_per_frame_p95"}) {
      cell.Missing(id, "the method did not report its iterations");
    }
  }
}

/// Describes the unsolved frames: "12 of 150 frames not solved; the first is frame 0, with errors of up to
/// 3.1 cm and 4°". If a frame exceeds a limit, describes the first such frame instead. Returns "" if all frames are
/// solved.
std::string DescribeFailure(const Outcome& outcome) {
  const auto unsolved = std::count_if(outcome.frames.begin(), outcome.frames.end(), std::not_fn(IsFrameSolved));
  if (unsolved == 0) return "";
  if (!outcome.first_broken_limit.empty()) return outcome.first_broken_limit;
  const auto first = std::find_if_not(outcome.frames.begin(), outcome.frames.end(), IsFrameSolved);
  return fmt::format("{} of {} frames not solved; the first is frame {}, with errors of up to {:.2g} cm and {:.2g}°",
                     unsolved, outcome.frames.size(), first - outcome.frames.begin(), first->errors.position_max_cm,
                     first->errors.orientation_max_deg);
}

}  // namespace

Result<TrackingAnswer> Follow(const TrackingWorld& world, const TrackingMethod& method) {
  TrackingAnswer answer;
  answer.iterations.emplace();
  // Frames with a cold start are independent of each other, so they are solved in one batch.
  if (method.start == FrameStart::kCold) {
    std::vector<IkProblem> problems;
    for (std::size_t frame = 0; frame < world.truth.size(); ++frame) {
      problems.push_back(ProblemAt(world, frame, world.first_angles));
    }
    std::vector<IkSolution> solutions = SolveAll(*method.solver, world.tree, problems, method.options);
    for (std::size_t frame = 0; frame < problems.size(); ++frame) {
      RETURN_IF_ERROR(StoreSolution(std::move(solutions[frame]), problems[frame], world, method, answer));
    }
    return answer;
  }
  // With a warm start, each frame starts at the answer to the previous frame.
  const auto solver = Prepare(*method.solver, world.tree);
  for (std::size_t frame = 0; frame < world.truth.size(); ++frame) {
    const IkProblem problem = ProblemAt(world, frame, frame > 0 ? answer.angles.back() : world.first_angles);
    IkSolution solution = solver->Solve(problem, method.options);
    RETURN_IF_ERROR(StoreSolution(std::move(solution), problem, world, method, answer));
  }
  return answer;
}

std::vector<std::string> TrackingMetrics() {
  return {"frames_solved",         "frames_solved_tight",    "position_error_cm",
          "orientation_error_deg", "hidden_angle_error_deg", "mpjpe_mm",
          "angle_jerk_ratio",      "iterations_per_frame",   "iterations_per_frame_p95"};
}

CellResult ScoreTracking(const TrackingWorld& world, double rate_hz, const TrackingAnswer& answer, bool keeps_motion) {
  assert(answer.angles.size() == world.truth.size());
  // Measure the errors frame by frame.
  Outcome outcome = MeasureAnswer(world, rate_hz, answer.angles);
  const Angles truth = TrueAngles(world);
  const PoseErrors poses = ComparePoses(outcome.found.poses, outcome.truth.poses);
  const Series position = AlongFrames("position_error_cm", outcome.frames,
                                      [](const TrackedFrame& frame) { return frame.errors.position_cm; });
  const Series orientation = AlongFrames("orientation_error_deg", outcome.frames,
                                         [](const TrackedFrame& frame) { return frame.errors.orientation_deg; });
  // Measure the metrics of the whole motion.
  CellResult cell;
  cell.digests = {{"world", DigestOf(world)}, {"solution", DigestOf(answer)}};
  cell.Measure("frames_solved", ShareSolvedPractically(outcome.frames));
  cell.Measure("frames_solved_tight", ShareSolvedTightly(outcome.frames));
  cell.Measure("position_error_cm", MeanOf(position));
  cell.Measure("orientation_error_deg", MeanOf(orientation));
  cell.Measure("hidden_angle_error_deg", HiddenAngleDifferenceDeg(Concatenate(answer.angles), Concatenate(truth)));
  cell.Measure("mpjpe_mm", poses.mpjpe_mm);
  cell.MeasureOr("angle_jerk_ratio", AngleJerkRatio(answer.angles, truth), "the true angles are without jerk");
  // Add the curves, the recording and the status.
  cell.series = {
      AlongFrames("solved_practical", outcome.frames, [](const auto& frame) { return IsFrameSolved(frame); }), position,
      orientation, Series{"mpjpe_mm", "frame", poses.frame_mpjpe_mm}};
  AddIterations(answer.iterations, cell);
  if (keeps_motion) {
    cell.recording = Recording{{{"truth", std::move(outcome.truth)}, {"solution", std::move(outcome.found)}}, "{}"};
  }
  cell.reason = DescribeFailure(outcome);
  cell.status = cell.reason.empty() ? Status::kOk : Status::kUnsolved;
  return cell;
}

std::optional<double> TrackingValueOfFailure(std::string_view metric) {
  if (metric == "frames_solved" || metric == "frames_solved_tight") return 0;
  return std::nullopt;
}

}  // namespace etude
