// What the engine answers to inputs that Python makes, too: a line each, a name and numbers in hexadecimal, to be
// compared to the last bit (engine_test.py).
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

std::vector<double> NumbersOf(const std::vector<Pose>& poses) {
  std::vector<double> numbers;
  for (const Pose& pose : poses) {
    for (const glm::dvec3& joint : pose.joints) numbers.insert(numbers.end(), {joint.x, joint.y, joint.z});
  }
  return numbers;
}

void TellKinematics() {
  const Kinematics body(AdultBody());
  IkBatch batch{.roots = {Frame{}}, .starts = {}, .targets = {}};
  double fraction = 0.5;
  const auto draw = [&](const AngleRange& range, double share) {
    fraction += 0.6180339887498949;
    fraction -= static_cast<int>(fraction);
    return (range.lower + range.upper) / 2 + share * (fraction - 0.5) * (range.upper - range.lower);
  };
  for (int i = 0; i < 20; ++i) {
    TreePose wanted;
    for (const AngleRange& range : body.tree().limits) {
      wanted.angles.push_back(draw(range, 0.6));
      batch.starts.push_back(draw(range, 0.1));
    }
    for (const Frame& frame : body.Effectors(wanted)) batch.targets.push_back({frame});
  }
  Tell("doubles", body.Solve(batch).angles);
  Tell("floats", body.Solve(batch, Precision::kFloat).angles);
}

void TellMotions(const sim::BuiltinDance& groove) {
  Motion start = groove.dance.motion;
  start.poses.resize(100);
  std::vector<double> features;
  const auto found = ComputeFeatures(start);
  for (const Features& each : found) features.insert(features.end(), each.begin(), each.end());
  Tell("features", features);
  Tell("distance", {FuzzyDistance(found[0], found[99])});
  const TransitionLibrary library(std::vector{groove.moves[0].examples[0], groove.moves[1].examples[0]});
  Tell("transition", NumbersOf(library.Make(0, 10, 1).motion.poses));
  std::vector<Pose> sensed;
  for (const SensedPose& frame : sim::SenseSkeleton(start, {.seed = 3})) sensed.push_back(frame.pose);
  Tell("sensed", NumbersOf(sensed));
  Coach coach(groove.dance, groove.moves, {.dances_at_once = true});
  std::vector<Pose> shown;
  for (const Pose& pose : start.poses) shown.push_back(coach.Step({.pose = pose, .seen = {}}, 0.5).body);
  Tell("coach", NumbersOf(shown));
}

void TellSilhouettes() {
  PersonMask mask{80, 60, std::vector<std::uint8_t>(80 * 60)};
  for (int y = 12; y < 48; ++y) std::fill_n(&mask.pixels[80 * y + 35], 10, 1);
  std::vector<double> rim;
  for (const OutlinePoint& point : Outline(mask)) rim.insert(rim.end(), {point.pixel.x, point.pixel.y});
  Tell("outline", rim);
  std::vector<Camera> cameras(2);
  for (Camera& camera : cameras)
    camera.width = 80, camera.height = 60, camera.fx = camera.fy = 75, camera.cx = 40, camera.cy = 30;
  cameras[0].R_CW = {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, cameras[0].p_WC = {0, 1, 4};
  cameras[1].R_CW = {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}}, cameras[1].p_WC = {4, 1, 0};
  std::vector<Pose> poses;
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
