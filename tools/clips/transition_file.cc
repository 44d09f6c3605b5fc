#include "tools/clips/transition_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/retargeting/proportions.h"
#include "engine/retargeting/rig.h"
#include "engine/transitions/choices/choice.h"
#include "engine/transitions/joins/join.h"
#include "engine/transitions/library/library.h"
#include "io/clips/clip_library.h"
#include "io/clips/convert.h"
#include "io/files/files.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

/// A clip as a body at 30 Hz, and the time in the file, seconds, of the body's first frame.
struct TimedBody {
  std::string name;
  BodyMotion motion;
  double begin_s = 0;
  std::vector<std::string> changes;  ///< BodyConversion::changes without the doubts
};

Result<TimedBody> OpenBody(const std::string& reference, const OpenOptions& reading) {
  ASSIGN_OR_RETURN(auto source, ReadOneClip(reference, reading));
  const double rate_hz = source.clip.rate_hz, hidden_s = HiddenStart(source);
  ASSIGN_OR_RETURN(auto opened, UnderstandClip(std::move(source), reading));
  if (opened.body.motion.poses.size() < 2)
    return Fail({reference}, "the clip has only one frame at 30 Hz; a transition needs two frames or more");
  std::erase_if(opened.body.changes,
                [&](const std::string& change) { return std::ranges::count(opened.body.doubts, change) > 0; });
  return TimedBody{opened.source.name, std::move(opened.body.motion),
                   hidden_s + static_cast<double>(opened.body.dropped_frames) / rate_hz, std::move(opened.body.changes)};
}

Result<void> WriteBody(const BodyMotion& motion, const std::string& path) {
  ASSIGN_OR_RETURN(const MotionFormat format, FormatOfName(path));
  const std::string name = std::filesystem::path(path).stem().string();
  const BodyPose rest = Retarget({.poses = {StandingPose()}}, motion.poses.front()).poses.front();
  SourceClip clip{.name = name,
                  .source = path,
                  .format = ClipFormat::kRecording,
                  .clip = RigClip(motion, rest, name),
                  .character = nullptr,
                  .made = MadeBody{}};
  std::vector<SourceClip> clips;
  clips.push_back(std::move(clip));
  ASSIGN_OR_RETURN(const Converted converted, ConvertClips(std::move(clips), format, {}));
  return WriteFileAtomically(path, converted.bytes);
}

}  // namespace

Result<TransitionFile> WriteTransition(const TransitionFileOptions& options) {
  RETURN_IF_ERROR(FormatOfName(options.output));
  ASSIGN_OR_RETURN(TimedBody from, OpenBody(options.from, options.reading));
  ASSIGN_OR_RETURN(TimedBody to, OpenBody(options.to, options.reading));
  const auto frames = static_cast<double>(from.motion.poses.size());
  const double frame = std::round((options.at_s - from.begin_s) * kJudgedRateHz);
  if (!(frame >= 0 && frame < frames)) {
    return Fail({}, "--at {:g}: outside the clip {}; allowed: {:.2f} to {:.2f} s{}", options.at_s, from.name,
                from.begin_s, from.begin_s + (frames - 1) / kJudgedRateHz,
                from.begin_s > 0 ? " (before, there is a T-pose, or the file does not show the whole body)" : "");
  }
  // The body of the first clip performs all clips.
  const BodyProportions proportions = MedianProportions(from.motion.poses);
  std::vector<std::string> names = {from.name, to.name};
  std::vector<BodyMotion> motions = {std::move(from.motion), std::move(to.motion)};
  ASSIGN_OR_RETURN(auto more, LoadClips(options.library, {{"--library"}}, options.reading));
  for (LibraryClip& clip : more.clips) {
    if (clip.source == options.from || clip.source == options.to) continue;
    names.push_back(clip.name);
    motions.push_back(std::move(clip.motion));
  }
  const MotionLibrary library = MakeLibrary(std::move(names), motions, proportions);
  // Make the transition, fill in the result, and write the file.
  const TransitionRequest request{
      .from = 0, .request_frame = static_cast<int>(frame), .to = 1, .budget_s = options.budget_s};
  const Transition made =
      MakeTransition(library, request, {.choice = FindChoice(options.choice), .join = FindJoin(options.join)});
  TransitionFile told{.branch = made.record.branch,
                      .why = made.record.why,
                      .from_changes = std::move(from.changes),
                      .to_changes = std::move(to.changes)};
  if (made.record.segments.empty()) return told;
  const Segment &left = made.record.segments.front(), &entered = made.record.segments.back();
  told.left_s = from.begin_s + left.last / kJudgedRateHz;
  told.entered_s = to.begin_s + entered.first / kJudgedRateHz;
  told.wait_s = made.record.wait_s;
  for (std::size_t i = 1; i + 1 < made.record.segments.size(); ++i) {
    const int clip = made.record.segments[i].clip;
    if (clip != Segment::kOwnFrames) told.through = library.names[clip];
  }
  for (const PlacedPoint& point : made.splice.points) told.points_s.push_back(point.frame / kJudgedRateHz);
  told.duration_s = static_cast<double>(made.splice.motion.poses.size() - 1) / kJudgedRateHz;
  RETURN_IF_ERROR(WriteBody(made.splice.motion, options.output));
  return told;
}

}  // namespace etude
