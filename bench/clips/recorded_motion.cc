#include "bench/clips/recorded_motion.h"

#include <algorithm>
#include <filesystem>

#include "bench/model/recording.h"
#include "bench/results/folder.h"
#include "bench/results/row_json.h"
#include "engine/base/names.h"
#include "engine/retargeting/rig.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// The files of a run's recordings that stand for `cell`: its own; of a world without a method, those of all methods.
std::vector<fs::path> RecordingsOf(const fs::path& run, const std::string& cell) {
  std::error_code none;
  if (const fs::path own = RecordingFile(run, cell); fs::exists(own, none)) return {own};
  const std::string world = RecordingFile(run, cell + "/").stem().string();
  std::vector<fs::path> found;
  for (fs::directory_iterator at(run / "recordings", none), end; !none && at != end; at.increment(none)) {
    if (at->path().filename().string().starts_with(world)) found.push_back(at->path());
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace

bool IsRecording(std::string_view text) {
  return text.starts_with(R"({"recording":)") || text.starts_with(R"({"tracks":)");  // the latter: version 1
}

Result<ClipFile> FileOfRecording(const std::string& text, const std::string& path) {
  ASSIGN_OR_RETURN(const auto recording, ReadRecording(text, path));
  ClipFile file{.format = ClipFormat::kRecording,
                .figure = {.name = "", .skeleton = {}, .materials = {}, .meshes = {}},
                .clips = {}};
  for (const Track& track : recording.tracks) {
    if (track.motion.poses.empty()) continue;
    file.clips.push_back(RigClip(track.motion, StandingPose(), track.name));
    file.notes.emplace_back("of a run's recording");
  }
  if (file.clips.empty()) return Fail({path}, "a recording without a motion");
  file.figure.skeleton = file.clips.front().skeleton;
  return file;
}

Result<SplitReference> InRun(const SplitReference& wanted) {
  std::error_code none;
  const fs::path run = wanted.path;
  if (!wanted.animation || !fs::exists(run / "manifest.json", none)) return wanted;
  const std::size_t at = wanted.animation->rfind('@');
  const std::string cell = wanted.animation->substr(0, at);
  SplitReference found{.path = "", .animation = std::nullopt};
  if (at != std::string::npos) {
    found.animation = wanted.animation->substr(at + 1);
    for (const std::string& world : {cell, cell.substr(0, cell.rfind('/'))}) {
      const fs::path other = RecordingFile(run, world + "/" + *found.animation);
      if (fs::exists(other, none)) return SplitReference{other.string(), ""};
    }
  }
  const std::vector<fs::path> files = RecordingsOf(run, cell);
  if (files.empty()) {
    return Fail({wanted.path}, "recorded no cell {}: a scenario's key 'video' says which are; they are in {}",
                Quote(cell), (run / "recordings").string());
  }
  found.path = files.front().string();
  return found;
}

std::string OwnTrack(const std::vector<Clip>& clips) {
  for (const char* name : {"recovered", "solution", "coach", "sensed"}) {
    if (std::ranges::find(clips, name, &Clip::name) != clips.end()) return name;
  }
  return clips.back().name;
}

}  // namespace etude
