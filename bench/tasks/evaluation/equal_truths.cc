#include "bench/tasks/evaluation/equal_truths.h"

#include "engine/motion/equal_motions.h"
#include "io/clips/raw_motions.h"

namespace etude {
namespace {

Places PlacesOf(const RawMotion& motion) {
  return {motion.FrameCount(), motion.joints.size(),
          [&motion](std::size_t frame, std::size_t joint) { return motion.At(frame, joint); }};
}

}  // namespace

void FindEqualTruths(std::vector<JudgedFiles>& worlds, const OpenOptions& opening) {
  const auto sketch_of = [&](std::size_t w) {
    const auto truth = OpenRawMotion(worlds[w].truth, opening);
    return truth ? SketchOf(PlacesOf(*truth)) : std::vector<glm::dvec3>{};
  };
  const auto are_equal = [&](std::size_t a, std::size_t b) {
    const auto first = OpenRawMotion(worlds[a].truth, opening), second = OpenRawMotion(worlds[b].truth, opening);
    return first && second && AreEqual(PlacesOf(*first), PlacesOf(*second));
  };
  const auto equals = FindEqual(worlds.size(), sketch_of, are_equal);
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    if (!equals[w]) continue;
    worlds[w].same_as = worlds[*equals[w]].name;
    worlds[w].unit = worlds[*equals[w]].unit;
  }
}

}  // namespace etude
