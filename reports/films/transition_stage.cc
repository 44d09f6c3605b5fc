#include "reports/films/transition_stage.h"

#include "reports/films/followed_way.h"
#include "sim/character/characters.h"
#include "sim/character/posed.h"

namespace etude {
namespace {

constexpr double kStageDetail = 1.5;
// The camera follows a walking body smoothly: a mean over a second to either side.
constexpr int kFollowFrames = 30;
// Poses change little from one frame to the next: enough to know how much room they need.
constexpr int kLookedAtEvery = 3;

std::vector<FloorMove> PlacementsOf(const TransitionPath& path) {
  const double yaw = -Heading(path.motion.poses[static_cast<std::size_t>(path.FrameAt(0))]);
  const FloorMove turn{yaw, 0, 0};
  std::vector<FloorMove> placements;
  for (const glm::dvec3& followed : FollowedWay(path.motion, kFollowFrames)) {
    const glm::dvec3 turned = turn.Apply(followed);
    placements.push_back({yaw, -turned.x, -turned.z});
  }
  return placements;
}

std::vector<std::vector<FloorMove>> AllPlacements(const TransitionRace& race) {
  std::vector<std::vector<FloorMove>> placements;
  for (const TransitionPath& path : race.paths) placements.push_back(PlacementsOf(path));
  return placements;
}

}  // namespace

TransitionStage::TransitionStage(const TransitionRace& race, int first, int last, int width, int height)
    : width_(width),
      height_(height),
      bear_(BearCharacter()),
      placements_(AllPlacements(race)),
      studio_(width, height, kStageDetail, SightOf(race, first, last)) {}

Sight TransitionStage::SightOf(const TransitionRace& race, int first, int last) const {
  Sight sight;
  for (std::size_t i = 0; i < race.paths.size(); ++i) {
    for (int time = first; time <= last; time += kLookedAtEvery) {
      const auto frame = static_cast<std::size_t>(race.paths[i].FrameAt(time));
      Studio::Include(Placed(PosedFigure(bear_, race.paths[i].motion.poses[frame]), placements_[i][frame]), sight);
    }
  }
  return sight;
}

ColourImage TransitionStage::Picture(Renderer& renderer, const TransitionPath& path, std::size_t index, int frame,
                                     std::optional<int> ghost) const {
  const FloorMove& placement = placements_[index][static_cast<std::size_t>(frame)];
  const auto placed = [&](int at) {
    return Placed(PosedFigure(bear_, path.motion.poses[static_cast<std::size_t>(at)]), placement);
  };
  std::optional<Mask> shadow;
  if (ghost) shadow = studio_.Silhouette(renderer, placed(*ghost));
  Canvas canvas(width_, height_);
  const Box whole{0, 0, static_cast<double>(width_), static_cast<double>(height_)};
  studio_.Draw(canvas, whole, renderer, placed(frame), placement, shadow ? &*shadow : nullptr);
  return canvas.Pixels();
}

}  // namespace etude
