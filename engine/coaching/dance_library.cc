#include "engine/coaching/dance_library.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "engine/fuzzy/features.h"

namespace etude {
namespace {

/// A clip from which transitions leave the dance (ClipLeaving) contains this many frames of the next repetition: enough
/// for a window to close, for the longest wait of a transition, and for a join.
constexpr std::size_t kLeavingFrames = 60;
/// A clip at which transitions enter an act (ClipEntering) contains the first frames of the act: half a second, and
/// enough frames for the longest join.
constexpr std::size_t kEnteringFrames = 15 + 30 + 1;
/// A clip through which transitions return to the dance (ClipReturning) begins `kBeforeFrames` before a repetition, so
/// that the player can start to move. It ends `kIntoFrames` after the beginning of this repetition, enough for the
/// longest join.
constexpr std::size_t kBeforeFrames = 45, kIntoFrames = 30;

BodyMotion Excerpt(const BodyMotion& motion, std::size_t first, std::size_t end) {
  BodyMotion cut{.rate_hz = motion.rate_hz, .poses = {}};
  const auto begin = motion.poses.begin();
  cut.poses.assign(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(end));
  return cut;
}

/// Clips and their names, as MakeLibrary takes them.
struct Clips {
  std::vector<std::string> names;
  std::vector<BodyMotion> motions;
  void Add(std::string name, BodyMotion motion) {
    names.push_back(std::move(name));
    motions.push_back(std::move(motion));
  }
};

}  // namespace

Result<DanceLibrary> DanceLibrary::Make(Dance dance) {
  RETURN_IF_ERROR(CheckDance(dance));
  DanceLibrary made;
  Clips clips;
  // Add the whole acts and slow demonstrations.
  for (const CoachAct& act : dance.acts) clips.Add(act.name, act.motion);
  for (const DanceMove& move : dance.moves) clips.Add("slow_" + move.name, move.slow);

  // Add the excerpts at which transitions leave the dance, one per repetition and one for the song's beginning.
  const std::size_t frames = dance.motion.poses.size();
  const int count = static_cast<int>(dance.repetitions.size());
  const auto first_of = [&](int repetition) {
    if (repetition < 0) return std::size_t{0};
    return repetition < count ? dance.repetitions[repetition].first : frames;
  };
  for (int repetition = -1; repetition < count; ++repetition) {
    const std::size_t first = first_of(repetition);
    const std::size_t end = std::min(first_of(repetition + 1) + kLeavingFrames, frames);
    clips.Add("dance from " + std::to_string(first), Excerpt(dance.motion, first, end));
    made.dance_frames_.push_back(first);
  }
  // Add the beginnings of the acts and demonstrations. Transitions enter the acts and demonstrations there.
  const std::size_t wholes = dance.acts.size() + dance.moves.size();
  for (std::size_t whole = 0; whole < wholes; ++whole) {
    clips.Add(clips.names[whole],
              Excerpt(clips.motions[whole], 0, std::min(kEnteringFrames, clips.motions[whole].poses.size())));
  }
  // Add the excerpts at which transitions return to the dance.
  for (int repetition = -1; repetition < count; ++repetition) {
    const std::size_t begin = first_of(repetition);
    const std::size_t first = begin - std::min(begin, kBeforeFrames);
    clips.Add("dance at " + std::to_string(begin),
              Excerpt(dance.motion, first, std::min(begin + kIntoFrames + 1, frames)));
    made.dance_frames_.push_back(first);
  }
  // Prepare all clips for transitions.
  const BodyPose& body = dance.motion.poses.front();
  made.library_ = MakeLibraryOfOneBody(std::move(clips.names), std::move(clips.motions),
                                       MakeBodyProportions(body, StandingHipHeight(body)));
  made.dance_ = std::move(dance);
  return made;
}

int DanceLibrary::ClipOfAct(std::string_view act) const {
  const CoachAct* found = dance_.FindAct(act);
  assert(found != nullptr);
  return static_cast<int>(found - dance_.acts.data());
}

int DanceLibrary::ClipOfSlow(int move) const { return static_cast<int>(dance_.acts.size()) + move; }

int DanceLibrary::ClipLeaving(int repetition) const {
  return ClipOfSlow(static_cast<int>(dance_.moves.size())) + 1 + repetition;
}

int DanceLibrary::ClipEntering(int whole) const {
  return ClipLeaving(static_cast<int>(dance_.repetitions.size())) + whole;
}

int DanceLibrary::ClipReturning(int repetition) const {
  return ClipEntering(ClipOfSlow(static_cast<int>(dance_.moves.size()))) + 1 + repetition;
}

int DanceLibrary::WholeOf(int clip) const {
  const int first = ClipEntering(0);
  return clip >= first && clip < ClipReturning(-1) ? clip - first : clip;
}

int DanceLibrary::RepetitionAt(double dance_frame) const {
  const auto after = std::ranges::upper_bound(dance_.repetitions, dance_frame, {}, [](const Repetition& repetition) {
    return static_cast<double>(repetition.first);
  });
  return static_cast<int>(after - dance_.repetitions.begin()) - 1;
}

std::size_t DanceLibrary::DanceFrameOf(int clip) const {
  const int left = clip - ClipLeaving(-1);
  return dance_frames_[IsReturning(clip) ? clip - ClipReturning(-1) + dance_frames_.size() / 2 : left];
}

bool DanceLibrary::IsLoop(int clip) const {
  return clip < static_cast<int>(dance_.acts.size()) && dance_.acts[clip].loops;
}

}  // namespace etude
