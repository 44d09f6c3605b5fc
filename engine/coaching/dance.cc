#include "engine/coaching/dance.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/base/named.h"
#include "engine/coaching/dance_library.h"

namespace etude {
namespace {

/// A clip needs two frames: a transition leaves it at one and enters it at another.
constexpr std::size_t kMinFrames = 2;

Result<void> CheckMotion(const std::string& title, std::string_view what, const BodyMotion& motion) {
  if (motion.poses.size() < kMinFrames) {
    return Fail({}, "dance '{}': {} has {} frames; allowed: at least {}", title, what, motion.poses.size(), kMinFrames);
  }
  if (motion.rate_hz != kJudgedRateHz) {
    return Fail({}, "dance '{}': {} has a rate of {} Hz; allowed: {} Hz", title, what, motion.rate_hz, kJudgedRateHz);
  }
  return {};
}

Result<void> CheckRepetitions(const Dance& dance) {
  std::size_t free_from = 0;
  if (dance.repetitions.empty()) return Fail({}, "dance '{}' has no repetition", dance.title);
  for (std::size_t i = 0; i < dance.repetitions.size(); ++i) {
    const Repetition& repetition = dance.repetitions[i];
    if (repetition.move < 0 || repetition.move >= static_cast<int>(dance.moves.size())) {
      return Fail(
          {}, "dance '{}', repetition {}: there is no move {}; moves are counted from 0, and the dance has {} moves",
          dance.title, i, repetition.move, dance.moves.size());
    }
    if (repetition.first < free_from || repetition.end < repetition.first + kMinFrames ||
        repetition.end > dance.motion.poses.size()) {
      return Fail(
          {}, "dance '{}', repetition {}: found frames {} to {}; allowed: at least two frames in the range {} to {}",
          dance.title, i, repetition.first, repetition.end, free_from, dance.motion.poses.size());
    }
    free_from = repetition.end;
  }
  return {};
}

Result<void> CheckTags(const Dance& dance) {
  const MusicTag* before = nullptr;
  for (const MusicTag& tag : dance.tags) {
    if (!std::isfinite(tag.music_s) || tag.frame >= dance.motion.poses.size()) {
      return Fail({}, "dance '{}': a music-time tag has frame {} and {} s; allowed: a frame below {} and a finite time",
                  dance.title, tag.frame, tag.music_s, dance.motion.poses.size());
    }
    if (before != nullptr && (tag.frame <= before->frame || tag.music_s <= before->music_s)) {
      return Fail({},
                  "dance '{}': found the music-time tag (frame {}, {} s) after the tag (frame {}, {} s); allowed: "
                  "increasing frames and times",
                  dance.title, tag.frame, tag.music_s, before->frame, before->music_s);
    }
    before = &tag;
  }
  return {};
}

}  // namespace

const CoachAct* Dance::FindAct(std::string_view name) const { return FindByName(acts, name); }

std::vector<std::string> RequiredActs() {
  return {"standby", "attract", "doze", "wake", "head_shake", "wave", "puzzled", "praise"};
}

Result<void> CheckDance(const Dance& dance) {
  RETURN_IF_ERROR(CheckMotion(dance.title, "the song", dance.motion));
  std::set<std::string> names;
  for (const DanceMove& move : dance.moves) {
    RETURN_IF_ERROR(CheckMotion(dance.title, "the slow demonstration of '" + move.name + "'", move.slow));
    if (!names.insert(move.name).second)
      return Fail({}, "dance '{}': two moves are named '{}'", dance.title, move.name);
  }
  RETURN_IF_ERROR(CheckRepetitions(dance));
  RETURN_IF_ERROR(CheckTags(dance));
  for (const std::string& name : RequiredActs()) {
    const CoachAct* act = dance.FindAct(name);
    if (act == nullptr) return Fail({}, "dance '{}' lacks the act '{}'", dance.title, name);
    RETURN_IF_ERROR(CheckMotion(dance.title, "the act '" + name + "'", act->motion));
  }
  return {};
}

double MusicAt(const Dance& dance, double frame) {
  const auto& tags = dance.tags;
  if (tags.empty()) return frame / kJudgedRateHz;
  const int next = NextTag(dance, frame);
  if (next == 0) return tags.front().music_s - (static_cast<double>(tags.front().frame) - frame) / kJudgedRateHz;
  const MusicTag& before = tags[next - 1];
  const double since = frame - static_cast<double>(before.frame);
  if (next == static_cast<int>(tags.size())) return before.music_s + since / kJudgedRateHz;
  const MusicTag& after = tags[next];
  return before.music_s + since * (after.music_s - before.music_s) / static_cast<double>(after.frame - before.frame);
}

int NextTag(const Dance& dance, double frame) {
  const auto next = std::ranges::lower_bound(dance.tags, frame, {},
                                             [](const MusicTag& tag) { return static_cast<double>(tag.frame); });
  return static_cast<int>(next - dance.tags.begin());
}

double RateToTag(const Dance& dance, int next, double frame, double music_s, double slowest, double fastest) {
  const double target = next < static_cast<int>(dance.tags.size()) ? static_cast<double>(dance.tags[next].frame)
                                                                   : static_cast<double>(dance.motion.poses.size() - 1);
  const double frames = target - frame, music_frames = (MusicAt(dance, target) - music_s) * kJudgedRateHz;
  // The music has already reached the tag, so dance as fast as allowed.
  if (music_frames <= 0) return fastest;
  return std::clamp(frames / music_frames, slowest, fastest);
}

}  // namespace etude
