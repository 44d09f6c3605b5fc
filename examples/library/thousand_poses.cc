// Solves inverse kinematics for 1,000 poses: the hands, head and foot of a person reach the positions that they have in
// a random pose.
#include <etude/kinematics.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>

using namespace etude;

int main() {
  const KinematicTree body = MakeBodyTree(LimbLengths{});
  std::mt19937 dice(1);
  // Draws an angle uniformly from the given share of a joint's range, around its middle.
  const auto draw = [&](const AngleRange& range, double share) {
    const double middle = (range.lower + range.upper) / 2, half = share * (range.upper - range.lower) / 2;
    return middle + half * (2 * dice() / double(std::mt19937::max()) - 1);
  };

  std::vector<IkProblem> problems(1000);
  for (IkProblem& problem : problems) {
    problem.limits = body.limits;
    TreeState wanted;
    for (const AngleRange& range : body.limits) {
      wanted.angles.push_back(draw(range, 0.5));
      problem.start.angles.push_back(draw(range, 0.1));
    }
    for (const LimbFrame& end : ComputeFrames(body, wanted).effectors) {
      problem.targets.push_back({end.position, end.axes});
    }
  }

  const auto before = std::chrono::steady_clock::now();
  const auto solved = SolveGaussNewtonBatch(body, problems, IkOptions{}, Precision::kFloat);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - before;
  std::printf("%td of %zu poses solved in %.0f ms\n",
              std::ranges::count(solved, IkStatus::kConverged, &IkSolution::status), solved.size(), took.count());
}
