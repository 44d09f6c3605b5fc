// Prints the engine's answers to inputs that Python also makes: one line each, a name and hexadecimal numbers, which
// engine_test.py compares to the last bit.
#include <etude/coaching.h>
#include <etude/fuzzy.h>
#include <etude/kinematics.h>
#include <etude/silhouettes.h>
#include <etude/sim/dances.h>
#include <etude/sim/sensor.h>
#include <etude/transitions.h>

#include <algorithm>
#include <cstdio>

namespace etude::engine {
namespace {

void Tell(const char* name, const std::vector<double>& numbers) {
  std::printf("%s", name);
  for (const double number : numbers) std::printf(" %a", number);
  std::printf("\n");
}

std::vector<double> NumbersOf(const std::vector<BodyPose>& poses) {
  std::vector<double> numbers;
  for (const BodyPose& pose : poses) {
    for (const glm::dvec3& joint : pose.joints) numbers.insert(numbers.end(), {joint.x, joint.y, joint.z});
  }
  return numbers;
}

void TellKinematics() {
  const KinematicTree body = MakeBodyTree(LimbLengths{});
  double fraction = 0.5;
  const auto draw = [&](const AngleRange& range, double share) {
    fraction += 0.6180339887498949;
    fraction -= static_cast<int>(fraction);
    return (range.lower + range.upper) / 2 + share * (fraction - 0.5) * (range.upper - range.lower);
  };
  std::vector<IkProblem> problems;
  for (int i = 0; i < 20; ++i) {
    IkProblem& problem = problems.emplace_back(IkProblem{.start = {}, .targets = {}, .limits = body.limits});
    TreeState wanted;
    for (const AngleRange& range : body.limits) {
      wanted.angles.push_back(draw(range, 0.6));
      problem.start.angles.push_back(draw(range, 0.1));
    }
    for (const LimbFrame& end : ComputeFrames(body, wanted).effectors) {
      problem.targets.push_back({end.position, end.axes});
    }
  }
  for (const auto& [name, precision] : {std::pair{"doubles", Precision::kDouble}, {"floats", Precision::kFloat}}) {
    std::vector<double> angles;
    for (const IkSolution& solution : SolveGaussNewtonBatch(body, problems, {}, precision)) {
      angles.insert(angles.end(), solution.angles.begin(), solution.angles.end());
    }
    Tell(name, angles);
  }
}

void TellMotions(const sim::BuiltinDance& groove) {
  BodyMotion start = groove.dance.motion;
  start.poses.resize(100);
  std::vector<double> features;
  const auto found = ComputeFeatures(start);
  for (const PoseFeatures& each : found) features.insert(features.end(), each.values.begin(), each.values.end());
  Tell("features", features);
  Tell("distance", {FuzzyDistance(found[0], found[99])});
  std::vector<BodyMotion> clips;
  for (int move : {0, 1}) clips.push_back(MotionOf(groove.moves[move].examples[0]));
  Tell("transition", NumbersOf(TransitionLibrary(clips).Make(0, 10, 1).motion.poses));
  Tell("sensed", NumbersOf(MotionOf(sim::SenseSkeleton(start, {.seed = 3})).poses));
  Coach coach(groove.dance, groove.moves, {.dances_at_once = true});
  std::vector<BodyPose> shown;
  for (const SensedFrame& frame : StreamOf(start).frames) shown.push_back(coach.Step(frame, 0.5).body);
  Tell("coach", NumbersOf(shown));
}

void TellSilhouettes() {
  Mask mask(80, 60);
  for (int y = 12; y < 48; ++y) std::fill_n(&mask.At(35, y), 10, 1);
  std::vector<double> rim;
  for (const OutlinePoint& point : MakeSilhouette(mask).outline) rim.insert(rim.end(), {point.pixel.x, point.pixel.y});
  Tell("outline", rim);
  std::vector<NamedCamera> cameras(2);
  for (NamedCamera& each : cameras) each.camera.intrinsics = {80, 60, 75, 75, 40, 30, 0};
  cameras[0].camera.R_CW = {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, cameras[0].camera.p_WC = {0, 1, 4};
  cameras[1].camera.R_CW = {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}}, cameras[1].camera.p_WC = {4, 1, 0};
  std::vector<BodyPose> poses;
  for (const auto& pose : TrackSilhouettes(cameras, std::vector(2, std::vector{mask, mask}))) poses.push_back(*pose);
  Tell("silhouettes", NumbersOf(poses));
}

}  // namespace
}  // namespace etude::engine

int main() {
  etude::engine::TellKinematics();
  etude::engine::TellMotions(etude::sim::DanceOfSong("groove"));
  etude::engine::TellSilhouettes();
}
