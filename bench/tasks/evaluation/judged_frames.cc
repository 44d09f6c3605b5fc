#include "bench/tasks/evaluation/judged_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace etude {

bool HaveSameRate(const RawMotion& truth, const RawMotion& answer) {
  constexpr double kMaxDrift = 0.01;  // tolerance, frames
  return std::abs(answer.rate_hz / truth.rate_hz - 1) * static_cast<double>(truth.FrameCount()) < kMaxDrift;
}

StatedOffset OffsetOf(const RawMotion& truth, const RawMotion& answer) {
  constexpr const char* kByClocks = ": judged by these clocks";
  constexpr double kSame = 0.1;  // tolerance, frames
  const double truth_s = truth.start_s.value_or(0), answer_s = answer.start_s.value_or(0);
  const double frames = (answer_s - truth_s) * truth.rate_hz;
  if (std::abs(frames) < kSame) return {};
  const auto told = [](const RawMotion& motion) {
    // Round to milliseconds. 13 digits are enough, even for times since 1970.
    return motion.start_s ? fmt::format("begins at {:.13g} s", std::round(1000 * *motion.start_s) / 1000)
                          : std::string("states no clock");
  };
  const std::string both = fmt::format("the truth {}, the answer {}", told(truth), told(answer));
  const auto end_of = [](const RawMotion& motion, double start_s) {
    return start_s + static_cast<double>(motion.FrameCount() - 1) / motion.rate_hz;
  };
  const bool overlap = answer_s <= end_of(truth, truth_s) && truth_s <= end_of(answer, answer_s);
  if (!truth.start_s || !answer.start_s || !overlap)
    return {0, both + ": their first frames are taken as simultaneous"};
  const bool is_whole = HaveSameRate(truth, answer) && std::abs(frames - std::round(frames)) < kSame;
  if (is_whole) return {std::round(frames) / answer.rate_hz, both + kByClocks};
  return {frames / truth.rate_hz, both + kByClocks};
}

std::optional<TimeShift> FindLag(const JudgedSide& truth, const JudgedSide& answer, double start_s) {
  // Move the answer to the truth's clock. Frames are added before the answer's first frame, so that the resampled
  // answer still contains its last frames.
  const double rate_hz = answer.motion.rate_hz;
  const auto added = static_cast<std::size_t>(std::ceil(std::max(-start_s, 0.0) * rate_hz));
  RawMotion moved;
  if (start_s != 0) moved = Sampled(answer.motion, rate_hz, start_s, answer.motion.FrameCount() + added);
  const RawMotion& found = start_s != 0 ? moved : answer.motion;
  const double truth_rate_hz = HaveSameRate(truth.motion, answer.motion) ? rate_hz : truth.motion.rate_hz;
  return FindTimeShift(JointColumns(truth.motion, truth.joints, truth.motion.FrameCount()), truth_rate_hz,
                       JointColumns(found, answer.joints, found.FrameCount()), rate_hz);
}

JudgedFrames FramesToJudge(const RawMotion& truth, const RawMotion& answer, double start_s) {
  constexpr double kSame = 0.01;  // tolerance, frames of the truth
  JudgedFrames frames;
  const bool is_same_rate = HaveSameRate(truth, answer);
  const double truth_rate_hz = is_same_rate ? answer.rate_hz : truth.rate_hz;
  const double last = static_cast<double>(truth.FrameCount()) - 1, start = start_s * answer.rate_hz;
  const auto in_truth = [&](double frame) {
    const double at = (frame - start) * truth_rate_hz / answer.rate_hz;
    return std::abs(at - std::round(at)) < kSame ? std::round(at) : at;
  };
  // Find the answer's first and last frame within the truth. The answer may not have these frames.
  double first = std::floor(start) - 1, end = std::ceil(start + last * answer.rate_hz / truth_rate_hz) + 1;
  while (in_truth(first) < 0) ++first;
  while (in_truth(end) > last) --end;
  const bool is_denser = !is_same_rate && answer.rate_hz > truth.rate_hz;
  frames.rate_hz = is_same_rate || is_denser ? truth.rate_hz : answer.rate_hz;
  for (double frame = first; frame <= end && !is_denser; ++frame) frames.of_answer.push_back(frame);
  if (first > end) return frames;
  // If the answer has the higher rate, take the frame nearest to each of the truth's.
  for (double f = 0; f <= last && is_denser; ++f) {
    const double frame = std::clamp(std::round(start + f * answer.rate_hz / truth.rate_hz), first, end);
    if (frames.of_answer.empty() || frames.of_answer.back() < frame) frames.of_answer.push_back(frame);
  }
  for (double frame = first; frame <= end && is_denser; ++frame) frames.own.push_back(frame);
  for (std::size_t i = 0; i < frames.of_answer.size(); ++i) {
    const auto& at = frames.of_answer;
    frames.of_truth.push_back(in_truth(at[i]));
    frames.is_interpolated = frames.is_interpolated || frames.of_truth[i] != std::round(frames.of_truth[i]);
    frames.is_even = frames.is_even && (i < 2 || at[i] - at[i - 1] == at[i - 1] - at[i - 2]);
  }
  return frames;
}

}  // namespace etude
