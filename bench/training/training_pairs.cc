#include "bench/training/training_pairs.h"

#include "engine/bridging/alignment.h"

namespace etude {
namespace {

/// `wanted` frames in the middles of equal parts of the clip; all frames of a shorter one.
std::vector<int> SampleFrames(int frame_count, int wanted) {
  std::vector<int> frames;
  const int count = std::min(frame_count, wanted);
  for (int i = 0; i < count; ++i) frames.push_back((2 * i + 1) * frame_count / (2 * count));
  return frames;
}

}  // namespace

std::vector<LabelledPair> LabelPairs(const TrainingClip& a, const TrainingClip& b, const TrainingOptions& options) {
  std::vector<LabelledPair> pairs;
  const std::vector<int> frames_a = SampleFrames(a.tagged->FrameCount(), options.frames_per_clip);
  const std::vector<int> frames_b = SampleFrames(b.tagged->FrameCount(), options.frames_per_clip);
  pairs.reserve(frames_a.size() * frames_b.size());
  for (int frame_a : frames_a) {
    for (int frame_b : frames_b) {
      const double gap = PoseGap(a.motion->poses[frame_a], b.motion->poses[frame_b]);
      pairs.push_back(
          {SquaredGradeGaps(a.tagged->grades[frame_a], b.tagged->grades[frame_b]), gap < options.close_gap});
    }
  }
  return pairs;
}

}  // namespace etude
