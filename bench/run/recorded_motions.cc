#include "bench/run/recorded_motions.h"

#include <fcntl.h>

#include <algorithm>
#include <filesystem>

#include "bench/model/recording.h"
#include "bench/recordings/evaluation_extras.h"
#include "bench/results/folder.h"
#include "bench/results/row_json.h"
#include "engine/base/names.h"
#include "engine/retargeting/rig.h"
#include "io/clips/clip_file.h"
#include "io/clips/marker_files.h"
#include "io/clips/open_clip.h"
#include "io/files/files.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// Returns the recordings of a cell. If `cell` names a world but no method, returns the recordings of all methods in
/// this world.
std::vector<FilePath> RecordingsOf(const fs::path& run, const std::string& cell) {
  if (FilePath own = RecordingFile(run, cell); Exists(own)) return {std::move(own)};
  const std::string world = RecordingFile(run, cell + "/").whole().stem().string();
  std::vector<fs::path> names;
  std::error_code none;
  for (fs::directory_iterator at(run / "recordings", none), end; !none && at != end; at.increment(none)) {
    if (at->path().filename().string().starts_with(world)) names.push_back(at->path().filename());
  }
  std::ranges::sort(names);
  std::vector<FilePath> found;
  for (const fs::path& name : names) found.push_back(Inside(run) / "recordings" / name);
  return found;
}

/// Returns a reference to a recording's file. Fails if the file is a symbolic link, because a stranger may have made
/// the run.
Result<SplitReference> ReferTo(const FilePath& file, const std::optional<std::string>& animation) {
  RETURN_IF_ERROR(OpenFile(file, O_RDONLY));
  return SplitReference{file.string(), animation};
}

/// Reads the two motions, ground truth and answer, of a cell of task evaluation. They contain only the joints that are
/// judged.
Result<ClipFile> ReadPair(const std::string& extras_json, const std::string& path, const OpenOptions& options) {
  const auto pair = ReadEvaluationExtras(extras_json);
  if (!pair) return Fail({path}, "a recording without a motion");
  ASSIGN_OR_RETURN(auto file, FileOfJoints(ClipFormat::kRecording, pair->truth, path, options));
  ASSIGN_OR_RETURN(auto answer, FileOfJoints(ClipFormat::kRecording, pair->answer, path, options));
  file.clips.front().name = "truth";
  answer.clips.front().name = "answer";
  file.clips.push_back(std::move(answer.clips.front()));
  file.bodies.push_back(std::move(answer.bodies.front()));
  if (options.keeps_shown) file.shown.push_back(std::move(answer.shown.front()));
  return file;
}

class ResultFolders : public RecordedMotions {
 public:
  bool IsRecording(std::string_view text) const override {
    // Recordings of version 2 begin with the first text, those of version 1 with the second text.
    return text.starts_with(R"({"recording":)") || text.starts_with(R"({"tracks":)");
  }

  Result<ClipFile> Read(const std::string& text, const std::string& path, const OpenOptions& options) const override {
    ASSIGN_OR_RETURN(const auto recording, ReadRecording(text, path));
    if (recording.tracks.empty()) return ReadPair(recording.extras_json, path, options);
    ClipFile file{.format = ClipFormat::kRecording,
                  .figure = {.name = "", .skeleton = {}, .materials = {}, .meshes = {}},
                  .clips = {}};
    for (const Track& track : recording.tracks) {
      if (track.motion.poses.empty()) continue;
      file.clips.push_back(RigClip(track.motion, StandingPose(), track.name));
      file.bodies.push_back({.changes = {"read from a run's recording"}});
    }
    if (file.clips.empty()) return Fail({path}, "a recording without a motion");
    file.figure.skeleton = file.clips.front().skeleton;
    return file;
  }

  Result<SplitReference> Find(const SplitReference& wanted) const override {
    const fs::path run = wanted.path;
    if (!wanted.animation || !Exists(Inside(run) / "manifest.json")) return wanted;
    const std::size_t at = wanted.animation->rfind('@');
    const std::string cell = wanted.animation->substr(0, at);
    std::optional<std::string> animation;
    if (at != std::string::npos) {
      animation = wanted.animation->substr(at + 1);
      for (const std::string& world : {cell, cell.substr(0, cell.rfind('/'))}) {
        const FilePath other = RecordingFile(run, world + "/" + *animation);
        if (Exists(other) && !IsTrack(run, cell, *animation)) return ReferTo(other, "");
      }
    }
    const std::vector<FilePath> files = RecordingsOf(run, cell);
    if (files.empty()) {
      return Fail({wanted.path},
                  "has no recording of the cell {}; the key 'video' of a scenario selects the cells whose motions a "
                  "run writes into {}",
                  Quote(cell), (run / "recordings").string());
    }
    return ReferTo(files.front(), animation);
  }

  std::string OwnTrack(const std::vector<Clip>& clips) const override {
    for (const char* name : {"recovered", "solution", "coach", "sensed", "answer"}) {
      if (std::ranges::find(clips, name, &Clip::name) != clips.end()) return name;
    }
    return clips.back().name;
  }

 private:
  /// Returns true if `name`, which is the name of a method, is also a track of the cell's recording: the track is
  /// meant. If `cell` names a world but no method, only "truth" is a track, because each method has its own of the
  /// others.
  bool IsTrack(const fs::path& run, const std::string& cell, const std::string& name) const {
    const std::vector<FilePath> files = RecordingsOf(run, cell);
    if (files.empty() || (name != "truth" && !Exists(RecordingFile(run, cell)))) return false;
    const auto text = ReadWholeFile(files.front(), kMaxClipFileBytes);
    if (!text) return false;
    const auto recording = Read(*text, files.front().string(), {});
    return recording && std::ranges::find(recording->clips, name, &Clip::name) != recording->clips.end();
  }
};

}  // namespace

const RecordedMotions& MotionsOfRuns() {
  static const ResultFolders folders;
  return folders;
}

}  // namespace etude
