#include "engine/capture/capture_motion.h"

namespace etude {
namespace {

Result<void> Check(const CaptureInputs& inputs, const CaptureOptions& options) {
  const auto& [matrices, marks, known] = inputs.pictures;
  if (matrices.size() < 2) return Fail({}, "{} cameras; at least 2 are needed", matrices.size());
  if (marks.size() != matrices.size()) {
    return Fail({}, "marks of {} cameras, and matrices of {}", marks.size(), matrices.size());
  }
  const std::size_t frames = marks[0].size();
  for (std::size_t i = 1; i < marks.size(); ++i) {
    if (marks[i].size() == frames) continue;
    return Fail({}, "camera {} has marks of {} frames, camera 1 of {}", i + 1, marks[i].size(), frames);
  }
  if (!known.empty() && known.size() != frames) {
    return Fail({}, "known measurements of {} frames, and marks of {}", known.size(), frames);
  }
  if (!inputs.marked.empty() && inputs.marked.size() != frames) {
    return Fail({}, "'marked' tells of {} frames, and there are marks of {}", inputs.marked.size(), frames);
  }
  if (!IsValid(inputs.body.lengths)) return Fail({}, "a limb length that is not positive");
  if (options.recover.solver == nullptr) return Fail({}, "no solver is given");
  return {};
}

}  // namespace

Result<CapturedMotion> CaptureMotion(const CaptureInputs& inputs, const CaptureOptions& options) {
  if (auto sound = Check(inputs, options); !sound) return tl::unexpected(sound.error());
  CapturedMotion motion;
  motion.measured = MeasureFrames(inputs.pictures, options.measure);
  motion.seen = BridgeGaps(motion.measured, options.bridge);
  motion.frames = RecoverFrames({.body = inputs.body, .seen = motion.seen, .marked = inputs.marked}, options.recover);
  return motion;
}

}  // namespace etude
