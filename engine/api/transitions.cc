#include <etude/transitions.h>

#include <algorithm>
#include <cmath>

#include "engine/api/checks.h"
#include "engine/base/names.h"
#include "engine/transitions/library/library.h"

namespace etude::engine {
namespace {

const Choice& ChoiceNamed(const std::string& name) {
  const Choice* const choice = FindChoice(name);
  if (choice == nullptr) throw BadInput(fmt::format("choice '{}'; allowed: {}", name, Join(ChoiceNames())));
  return *choice;
}

const JoinKind& JoinNamed(const std::string& name) {
  const JoinKind* const join = FindJoin(name);
  if (join == nullptr) throw BadInput(fmt::format("join '{}'; allowed: {}", name, Join(JoinNames())));
  return *join;
}

/// Returns the values of settings in the order of `known`; settings without a value in `told` get their defaults.
/// Throws BadInput, naming `of`, for unknown keys.
std::vector<double> ValuesOf(const std::map<std::string, double>& told, const std::vector<NumberSetting>& known,
                             const std::string& of) {
  std::vector<double> values;
  std::vector<std::string> keys;
  for (const NumberSetting& setting : known) {
    values.push_back(setting.fallback);
    keys.push_back(setting.key);
  }
  for (const auto& [key, value] : told) {
    const auto found = std::ranges::find(known, key, &NumberSetting::key);
    if (found == known.end()) {
      throw BadInput(fmt::format("setting '{}' of '{}'; allowed: {}", key, of, keys.empty() ? "none" : Join(keys)));
    }
    const bool is_allowed =
        value >= found->lowest && value <= found->largest && (!found->is_whole || value == std::round(value));
    if (!is_allowed) {
      throw BadInput(fmt::format("setting '{}' is {} for method '{}'; allowed: {}{:g} to {:g}", key, value, of,
                                 found->is_whole ? "whole numbers from " : "", found->lowest, found->largest));
    }
    values[static_cast<std::size_t>(found - known.begin())] = value;
  }
  return values;
}

TransitionWay WayOf(const TransitionOptions& options) {
  TransitionWay way = WayNamed(options.choice, options.join);
  way.choice_settings = ValuesOf(options.choice_settings, way.choice->settings, options.choice);
  way.join_settings = ValuesOf(options.join_settings, way.join->settings, options.join);
  if (!(options.threshold > 0 && options.threshold <= kFarthestFuzzy)) {
    throw BadInput(fmt::format("threshold is {}; allowed: above 0, up to {}", options.threshold, kFarthestFuzzy));
  }
  way.rules.threshold = options.threshold;
  return way;
}

etude::BodyProportions ToEngineProportions(const BodyProportions& told) {
  constexpr double kLowest = 0.1, kHighest = 10;  // range of the hips' height, metres
  if (!(told.hip_height >= kLowest && told.hip_height <= kHighest)) {
    throw BadInput(fmt::format("the hips are {} m high; allowed: {} to {} m", told.hip_height, kLowest, kHighest));
  }
  Checked({.poses = {told.pose}});
  StandingHipsOf(told.pose);
  return MakeBodyProportions(told.pose, told.hip_height);
}

}  // namespace

TransitionWay WayNamed(const std::string& choice, const std::string& join) {
  return {.choice = &ChoiceNamed(choice), .join = &JoinNamed(join)};
}

std::vector<std::string> TransitionChoices() { return ChoiceNames(); }
std::vector<std::string> TransitionJoins() { return JoinNames(); }

std::vector<NumberSetting> TransitionChoiceSettings(const std::string& choice) { return ChoiceNamed(choice).settings; }
std::vector<NumberSetting> TransitionJoinSettings(const std::string& join) { return JoinNamed(join).settings; }

struct TransitionLibrary::Library {
  MotionLibrary clips;

  void Check(int clip, int frame) const {
    const int count = static_cast<int>(clips.motions.size());
    if (clip < 0 || clip >= count) throw BadInput(fmt::format("clip {}; allowed: 0 to {}", clip, count - 1));
    const int frames = static_cast<int>(clips.motions[clip].poses.size());
    if (frame < 0 || frame >= frames) {
      throw BadInput(fmt::format("found frame {} for clip {}; allowed: 0 to {}", frame, clip, frames - 1));
    }
  }
};

TransitionLibrary::TransitionLibrary(std::span<const BodyMotion> clips,
                                     const std::optional<BodyProportions>& proportions)
    : library_(std::make_unique<Library>()) {
  CheckClips(clips);
  std::vector<std::string> names;
  for (const BodyMotion& motion : clips) {
    if (motion.poses.size() < 2 || motion.rate_hz != kJudgedRateHz) {
      throw BadInput(fmt::format("clip {} has {} frames at {} Hz; allowed: two or more frames at {} Hz", names.size(),
                                 motion.poses.size(), motion.rate_hz, kJudgedRateHz));
    }
    names.push_back(fmt::format("clip {}", names.size()));
  }
  StandingHipsOf(clips.front().poses.front());
  library_->clips =
      MakeLibrary(std::move(names), clips,
                  proportions ? ToEngineProportions(*proportions) : MedianProportions(clips.front().poses));
}

TransitionLibrary::TransitionLibrary(TransitionLibrary&&) noexcept = default;
TransitionLibrary& TransitionLibrary::operator=(TransitionLibrary&&) noexcept = default;
TransitionLibrary::~TransitionLibrary() = default;

Transition TransitionLibrary::Make(int from, int frame, int to, double budget_s,
                                   const TransitionOptions& options) const {
  library_->Check(from, frame);
  library_->Check(to, 0);
  CheckBudget(budget_s);
  etude::Transition made = MakeTransition(
      library_->clips, {.from = from, .request_frame = frame, .to = to, .budget_s = budget_s}, WayOf(options));
  Transition shown{.motion = std::move(made.splice.motion),
                   .points = {},
                   .wait_s = made.record.wait_s,
                   .branch = std::string(BranchName(made.record.branch)),
                   .why = std::move(made.record.why)};
  for (const PlacedPoint& point : made.splice.points) shown.points.push_back(point.frame);
  return shown;
}

}  // namespace etude::engine
