#include "io/clips/body_in_place.h"

#include <algorithm>
#include <utility>

namespace etude {
namespace {

/// Returns, for each frame, the joints that the reader placed by a rule because the file does not show them; empty if
/// the file shows every joint in every frame.
std::vector<JointSet> UnseenIn(const OpenedClip& opened) {
  const std::size_t frames = opened.body.motion.poses.size();
  std::vector<JointSet> unseen(frames);
  for (const Role role : opened.map.composed) {
    for (JointSet& joints : unseen) joints.set(Index(role));
  }
  const std::size_t first = opened.source.made ? opened.source.made->first_frame : 0;
  const RawMotion* shown = opened.source.shown.get();
  if (shown != nullptr && shown->FrameCount() >= first + frames) {
    for (const Role role : AllRoles()) {
      const int at = shown->roles[Index(role)];
      for (std::size_t f = 0; f < frames; ++f) {
        if (at < 0 || !IsSeen(shown->At(first + f, static_cast<std::size_t>(at)))) unseen[f].set(Index(role));
      }
    }
  }
  const bool shows_all = std::ranges::none_of(unseen, [](const JointSet& joints) { return joints.any(); });
  return shows_all ? std::vector<JointSet>() : unseen;
}

}  // namespace

Result<BodyInPlace> BodyInPlaceOf(SourceClip clip, const OpenOptions& options) {
  OpenOptions own = options;
  own.body.rate_hz = clip.clip.rate_hz;
  own.body.keep_floor = true;
  ASSIGN_OR_RETURN(auto opened, UnderstandClip(std::move(clip), own));
  // UnderstandClip may have moved the floor of a body of markers to height 0: move the body back.
  BodyConversion& body = opened.body;
  const double floor_m = body.floor * body.metres_per_unit;
  for (BodyPose& pose : body.motion.poses) {
    for (glm::dvec3& joint : pose.joints) joint.y += floor_m;
  }
  const std::size_t before = opened.source.made ? opened.source.made->first_frame : 0;
  const double begin_s = static_cast<double>(body.dropped_frames + before) / body.motion.rate_hz;
  std::vector<JointSet> unseen = UnseenIn(opened);
  const ClipFormat format = opened.source.format;
  const bool is_of_markers = format == ClipFormat::kC3d || format == ClipFormat::kTrc || format == ClipFormat::kMotive;
  const RawMotion* shown = opened.source.shown.get();
  const std::size_t frames = body.motion.poses.size() + before;
  const std::size_t behind = shown == nullptr || shown->FrameCount() < frames ? 0 : shown->FrameCount() - frames;
  const double lost_after_s = static_cast<double>(behind) / body.motion.rate_hz;
  const double lost_before_s = static_cast<double>(before) / body.motion.rate_hz;
  return BodyInPlace{std::move(body.motion), begin_s,       lost_after_s,           lost_before_s,
                     std::move(unseen),      is_of_markers, std::move(body.changes)};
}

FaultOptions FaultOptionsOf(const BodyInPlace& body, std::optional<double> floor_m) {
  return {.floor_m = floor_m,
          .begin_s = body.begin_s,
          .unseen = body.unseen,
          .lost_before_s = body.lost_before_s,
          .lost_after_s = body.lost_after_s,
          .is_of_markers = body.is_of_markers};
}

Result<BodyInPlace> OpenBodyInPlace(const std::string& reference, const OpenOptions& options) {
  OpenOptions own = options;
  own.body.keep_floor = true;
  own.keeps_shown = true;
  ASSIGN_OR_RETURN(auto clip, ReadOneClip(reference, own));
  return BodyInPlaceOf(std::move(clip), options);
}

}  // namespace etude
