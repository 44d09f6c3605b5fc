// Inverse kinematics of 1,000 poses: a person's hands, head and foot are brought to where a random pose has them.
#include <etude/kinematics.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>

using namespace etude::engine;

int main() {
  const Kinematics body(AdultBody());
  std::mt19937 dice(1);
  const auto draw = [&](const AngleRange& range, double share) {  // from the middle of a joint's range
    const double middle = (range.lower + range.upper) / 2, half = share * (range.upper - range.lower) / 2;
    return middle + half * (2 * dice() / double(std::mt19937::max()) - 1);
  };

  IkBatch batch{.roots = {Frame{}}, .starts = {}, .targets = {}};
  for (int i = 0; i < 1000; ++i) {
    TreePose wanted;
    for (const AngleRange& range : body.tree().limits) {
      wanted.angles.push_back(draw(range, 0.5));
      batch.starts.push_back(draw(range, 0.1));
    }
    for (const Frame& frame : body.Effectors(wanted)) batch.targets.push_back({frame});
  }

  const auto before = std::chrono::steady_clock::now();
  const IkBatchAnswer answer = body.Solve(batch, Precision::kFloat);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - before;
  std::printf("%td of %zu poses solved in %.0f ms\n", std::ranges::count(answer.statuses, IkStatus::kConverged),
              answer.statuses.size(), took.count());
}
