#include "bench/tasks/ik/recording.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/angles.h"
#include "engine/kinematics/tree_to_body.h"

namespace etude {
namespace {

constexpr std::size_t kMostFrames = 150;
constexpr int kEveryUpTo = 60;

/// Every iteration up to kEveryUpTo, then each 1/`share` later than the one before, and the last.
std::vector<int> Growing(int last, int share) {
  std::vector<int> iterations;
  for (int i = 0; i < last; i += i < kEveryUpTo ? 1 : std::max(1, i / share)) iterations.push_back(i);
  iterations.push_back(last);
  return iterations;
}

/// The places that a solver is asked to reach, which noise may have moved away from the true pose.
Json TargetPlaces(const IkProblem& problem) {
  Json places = Json::array();
  for (const EffectorTarget& target : problem.targets) {
    const glm::dvec3& at = target.position;
    places.push_back(target.position_weight > 0 ? Json{at.x, at.y, at.z} : Json(nullptr));
  }
  return places;
}

}  // namespace

std::vector<int> RecordedIterations(int last) {
  for (int share = 2 * kEveryUpTo;; share /= 2) {
    std::vector<int> iterations = Growing(last, share);
    if (iterations.size() <= kMostFrames || share == 1) return iterations;  // at 1 they double: never too many
  }
}

std::vector<IkRecordedStep> StepsOf(std::span<const IkTraceEntry> trace) {
  std::vector<IkRecordedStep> steps;
  for (const int iteration : RecordedIterations(static_cast<int>(trace.size()) - 1)) {
    const IkTraceEntry& entry = trace[static_cast<std::size_t>(iteration)];
    steps.push_back({iteration, entry.angles, 100 * entry.worst_position, Degrees(entry.worst_mean_axis),
                     Degrees(entry.worst_axis)});
  }
  return steps;
}

Recording RecordIk(const KinematicTree& tree, const IkWorld& world, std::span<const IkRecordedStep> steps) {
  Track truth{"truth", {}}, start{"start", {}}, solution{"solution", {}};
  TreeState state = world.problem.start;
  const BodyPose true_pose = ToBodyPose(tree, world.truth), start_pose = ToBodyPose(tree, state);
  Json iterations = Json::array(), position = Json::array(), orientation = Json::array(), axis = Json::array();
  for (const IkRecordedStep& step : steps) {
    state.angles = step.angles;
    truth.motion.poses.push_back(true_pose);
    start.motion.poses.push_back(start_pose);
    solution.motion.poses.push_back(ToBodyPose(tree, state));
    iterations.push_back(step.iteration);
    position.push_back(step.position_error_max_cm);
    orientation.push_back(step.orientation_error_max_deg);
    axis.push_back(step.axis_error_max_deg);
  }
  const Json extras = {{"iterations", std::move(iterations)},
                       {"position_error_max_cm", std::move(position)},
                       {"orientation_error_max_deg", std::move(orientation)},
                       {"axis_error_max_deg", std::move(axis)},
                       {"targets_m", TargetPlaces(world.problem)}};
  return {{std::move(truth), std::move(start), std::move(solution)}, extras.dump()};
}

}  // namespace etude
