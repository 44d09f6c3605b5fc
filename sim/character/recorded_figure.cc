#include "sim/character/recorded_figure.h"

#include <utility>

#include "engine/motion/clip.h"
#include "sim/character/posed.h"

namespace etude {
namespace {

glm::dmat4 MatrixOf(const FloorMove& move) {
  const glm::dvec3 origin = move.Apply(glm::dvec3(0));
  const auto axis = [&](const glm::dvec3& along) { return glm::dvec4(move.Apply(along) - origin, 0); };
  return {axis({1, 0, 0}), axis({0, 1, 0}), axis({0, 0, 1}), glm::dvec4(origin, 1)};
}

}  // namespace

RecordedFigure::RecordedFigure(std::shared_ptr<const Character> character, Clip clip, const JointMap& map,
                               const BodyConversion& body)
    : character_(std::move(character)),
      clip_(std::move(clip)),
      first_(static_cast<double>(body.dropped_frames)),
      frames_per_frame_(clip_.rate_hz / body.motion.rate_hz),
      to_world_(WorldFromFile(body)),
      still_(StillSurfaces(*character_, PartsOfJoints(character_->skeleton, map))) {}

Figure RecordedFigure::At(double frame, const FloorMove& move) const {
  const LocalPose pose = SampleFrame(clip_, first_ + frame * frames_per_frame_);
  return FigureAt(*character_, still_, GlobalsInWorld(character_->skeleton, pose, MatrixOf(move) * to_world_));
}

}  // namespace etude
