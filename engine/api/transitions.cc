#include <etude/transitions.h>

#include "engine/api/convert.h"
#include "engine/base/names.h"
#include "engine/transitions/library/library.h"

namespace etude::engine {
namespace {

TransitionWay WayOf(const TransitionOptions& options) {
  TransitionWay way = WayNamed(options.choice, options.join);
  if (!(options.threshold > 0 && options.threshold <= kFarthestFuzzy)) {
    throw BadInput(fmt::format("threshold {}; allowed: above 0, up to {}", options.threshold, kFarthestFuzzy));
  }
  way.rules.threshold = options.threshold;
  return way;
}

}  // namespace

TransitionWay WayNamed(const std::string& choice, const std::string& join) {
  const TransitionWay way{.choice = FindChoice(choice), .join = FindJoin(join)};
  if (way.choice == nullptr) throw BadInput(fmt::format("choice '{}'; allowed: {}", choice, Join(ChoiceNames())));
  if (way.join == nullptr) throw BadInput(fmt::format("join '{}'; allowed: {}", join, Join(JoinNames())));
  return way;
}

std::vector<std::string> TransitionChoices() { return ChoiceNames(); }
std::vector<std::string> TransitionJoins() { return JoinNames(); }

struct TransitionLibrary::Library {
  MotionLibrary clips;

  void Check(int clip, int frame) const {
    const int count = static_cast<int>(clips.motions.size());
    if (clip < 0 || clip >= count) throw BadInput(fmt::format("clip {}; allowed: 0 to {}", clip, count - 1));
    const int frames = static_cast<int>(clips.motions[clip].poses.size());
    if (frame < 0 || frame >= frames) {
      throw BadInput(fmt::format("frame {} of clip {}; allowed: 0 to {}", frame, clip, frames - 1));
    }
  }
};

TransitionLibrary::TransitionLibrary(std::span<const Motion> clips) : library_(std::make_unique<Library>()) {
  const std::vector<BodyMotion> motions = ToBodyMotions(clips);
  std::vector<std::string> names;
  for (const BodyMotion& motion : motions) {
    if (motion.poses.size() < 2 || motion.rate_hz != kJudgedRateHz) {
      throw BadInput(fmt::format("clip {}: {} frames at {} Hz; allowed: two or more at {}", names.size(),
                                 motion.poses.size(), motion.rate_hz, kJudgedRateHz));
    }
    names.push_back(fmt::format("clip {}", names.size()));
  }
  const BodyPose& first = motions.front().poses.front();
  library_->clips = MakeLibrary(std::move(names), motions, MakeBodyProportions(first, StandingHipsOf(first)));
}

TransitionLibrary::TransitionLibrary(TransitionLibrary&&) noexcept = default;
TransitionLibrary& TransitionLibrary::operator=(TransitionLibrary&&) noexcept = default;
TransitionLibrary::~TransitionLibrary() = default;

Transition TransitionLibrary::Make(int from, int frame, int to, double budget_s,
                                   const TransitionOptions& options) const {
  library_->Check(from, frame);
  library_->Check(to, 0);
  CheckBudget(budget_s);
  const etude::Transition made = MakeTransition(
      library_->clips, {.from = from, .request_frame = frame, .to = to, .budget_s = budget_s}, WayOf(options));
  Transition shown{.motion = FromBodyMotion(made.splice.motion),
                   .points = {},
                   .wait_s = made.record.wait_s,
                   .branch = std::string(BranchName(made.record.branch)),
                   .why = made.record.why};
  for (const PlacedPoint& point : made.splice.points) shown.points.push_back(point.frame);
  return shown;
}

}  // namespace etude::engine
