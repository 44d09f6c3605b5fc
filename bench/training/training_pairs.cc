#include "bench/training/training_pairs.h"

#include <algorithm>
#include <array>

#include "bench/metrics/matching.h"
#include "engine/motion/body.h"
#include "sim/choreography/move.h"

namespace etude {
namespace {

std::vector<TrainingFrame> SampleFrames(const BodyMotion& motion, double standing_hip_height) {
  const int all = static_cast<int>(motion.poses.size());
  const int count = std::min(all, kFramesPerClip);
  std::vector<TrainingFrame> frames;
  for (int i = 0; i < count; ++i) {
    const BodyPose& pose = motion.poses[(2 * i + 1) * all / (2 * count)];
    frames.push_back({pose, ComputeFeatures(pose, standing_hip_height)});
  }
  return frames;
}

std::vector<Grades> GradesOf(std::span<const TrainingFrame> frames, const Memberships& memberships) {
  std::vector<Grades> grades;
  for (const TrainingFrame& frame : frames) grades.push_back(Fuzzify(frame.features, memberships));
  return grades;
}

}  // namespace

TrainingClips SampleClips(std::vector<std::string> identities, std::span<const BodyMotion> clips,
                          const BodyProportions& proportions) {
  TrainingClips training{.identities = std::move(identities), .frames = {}};
  for (const BodyMotion& clip : PerformedBy(proportions, clips)) {
    training.frames.push_back(SampleFrames(clip, proportions.standing_hip_height));
  }
  return training;
}

Result<TrainingClips> GatherTrainingClips(std::span<const BodyMotion> clips, const std::vector<std::string>& identities,
                                          const BodyProportions& proportions) {
  std::vector<std::string> known;
  std::vector<BodyMotion> all;
  for (const std::string& name : BuiltinMoveNames()) {
    ASSIGN_OR_RETURN(auto move, LoadBuiltinMove(name));
    known.push_back("builtin:" + name);
    all.push_back(std::move(move.motion));
  }
  std::vector<std::size_t> others;
  std::vector<std::string> seen = known;
  for (std::size_t i = 0; i < identities.size(); ++i) {
    if (std::find(seen.begin(), seen.end(), identities[i]) != seen.end()) continue;
    seen.push_back(identities[i]);
    others.push_back(i);
  }
  const std::size_t wanted = std::min(others.size(), kMaxTrainingClips - known.size());
  for (std::size_t i = 0; i < wanted; ++i) {
    const std::size_t other = others[i * others.size() / wanted];
    known.push_back(identities[other]);
    all.push_back(clips[other]);
  }
  return SampleClips(std::move(known), all, proportions);
}

std::vector<LabelledPair> LabelPairs(std::span<const TrainingFrame> a, std::span<const TrainingFrame> b,
                                     const Memberships& memberships) {
  const std::vector<Grades> grades_a = GradesOf(a, memberships), grades_b = GradesOf(b, memberships);
  std::vector<LabelledPair> pairs;
  pairs.reserve(a.size() * b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      pairs.push_back({SquaredGradeGaps(grades_a[i], grades_b[j]), PoseGap(a[i].pose, b[j].pose) < kCloseGap});
    }
  }
  return pairs;
}

std::vector<LabelledPair> LabelPairsAcross(std::span<const std::vector<TrainingFrame>> clips,
                                           const Memberships& memberships) {
  std::vector<LabelledPair> all;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    for (std::size_t j = i + 1; j < clips.size(); ++j) {
      const std::vector<LabelledPair> pairs = LabelPairs(clips[i], clips[j], memberships);
      all.insert(all.end(), pairs.begin(), pairs.end());
    }
  }
  return all;
}

void UpdateGrades(std::span<const std::vector<TrainingFrame>> clips, const Memberships& memberships,
               std::span<LabelledPair> pairs) {
  std::vector<std::vector<Grades>> grades;
  for (const std::vector<TrainingFrame>& frames : clips) grades.push_back(GradesOf(frames, memberships));
  auto pair = pairs.begin();
  for (std::size_t i = 0; i < clips.size(); ++i) {
    for (std::size_t j = i + 1; j < clips.size(); ++j) {
      for (const Grades& a : grades[i]) {
        for (const Grades& b : grades[j]) (pair++)->squared_gaps = SquaredGradeGaps(a, b);
      }
    }
  }
}

PairTable::PairTable(std::span<const LabelledPair> pairs) {
  blocks_.resize((pairs.size() + kBlock - 1) / kBlock);  // the values of the blocks are zero at first
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    Block& block = blocks_[i / kBlock];
    for (std::size_t k = 0; k < kFeatureCount; ++k) {
      block.squared_gaps[k][i % kBlock] = static_cast<float>(pairs[i].squared_gaps[k]);
    }
    block.used[i % kBlock] = 1;
    block.close[i % kBlock] = pairs[i].close;
    close_count_ += pairs[i].close;
  }
}

/// Computes d² of every pair of the block.
void PairTable::AddUp(const Block& block, const FeatureWeights& weights, float (&squared)[kBlock]) {
  std::array<float, kFeatureCount> factors;
  for (std::size_t k = 0; k < kFeatureCount; ++k) factors[k] = static_cast<float>(weights[k]);
  // The pairs are processed in groups whose sums fit into registers.
  constexpr int kStep = 16;
  for (int first = 0; first < kBlock; first += kStep) {
    std::array<float, kStep> sums{};
    for (std::size_t k = 0; k < kFeatureCount; ++k) {
#pragma GCC unroll 16
      for (int i = 0; i < kStep; ++i) sums[i] += factors[k] * block.squared_gaps[k][first + i];
    }
    std::ranges::copy(sums, squared + first);
  }
}

MatchScore PairTable::Score(const FeatureWeights& weights, double threshold) const {
  const float limit = static_cast<float>(threshold * threshold);
  MatchScore score{.close = close_count_};
  for (const Block& block : blocks_) {
    float squared[kBlock];
    AddUp(block, weights, squared);
    for (int i = 0; i < kBlock; ++i) {
      const int matched = squared[i] < limit;
      score.matched += matched & block.used[i];
      score.close_matched += matched & block.close[i];
    }
  }
  return score;
}

double PairTable::SoftF1(const FeatureWeights& weights, double threshold, double ramp) const {
  const double squared_threshold = threshold * threshold;
  const float far = static_cast<float>(squared_threshold * (1 + ramp));
  const float slope = static_cast<float>(0.5 / (squared_threshold * ramp));
  // Each lane has its own sum, so that the compiler may vectorise without changing the order of additions.
  float matched[kBlock] = {}, close_matched[kBlock] = {};
  for (const Block& block : blocks_) {
    float squared[kBlock];
    AddUp(block, weights, squared);
    for (int i = 0; i < kBlock; ++i) {
      const float share = std::min(std::max((far - squared[i]) * slope, 0.0f), 1.0f);
      matched[i] += share * static_cast<float>(block.used[i]);
      close_matched[i] += share * static_cast<float>(block.close[i]);
    }
  }
  double all = 0, both = 0;
  for (int i = 0; i < kBlock; ++i) {
    all += matched[i];
    both += close_matched[i];
  }
  return both > 0 ? 2 * both / (all + close_count_) : 0;
}

}  // namespace etude
