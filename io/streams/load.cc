#include "io/streams/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/recognition/recognise.h"
#include "engine/streams/stream_doubts.h"
#include "io/clips/open_clip.h"
#include "io/clips/references.h"
#include "io/files/files.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFiles = 100'000;

bool IsClip(const std::string& reference) {
  if (reference.starts_with("builtin:")) return true;
  const SplitReference split = Split(reference);
  const std::string ending = InLowerCase(fs::path(FileOf(split.path)).extension().string());
  constexpr std::array kOfClips = {".bvh", ".glb", ".gltf", ".vrm", ".vrma", ".fbx", ".amc", ".c3d", ".npz", ".npy"};
  return split.animation || std::ranges::find(kOfClips, ending) != kOfClips.end();
}

std::string Describe(const StreamRecording& recording, const MadeStream& made, const StreamOptions& options) {
  const std::size_t frames = made.stream.frames.size();
  std::string text =
      fmt::format("{}, {:.1f} s, {} tracking states", StreamFormatName(recording.format),
                  static_cast<double>(frames) / made.stream.rate_hz, recording.records_states ? "with" : "no");
  if (const std::string rate = DescribeAssumedRate(recording); !rate.empty()) text += ", " + rate;
  if (!recording.is_level) text += "; " + Describe(made.level);
  if (made.lost_frames > 0)
    text += fmt::format("; the body is not visible in {} of {} frames", made.lost_frames, frames);
  for (const std::string& remark : recording.remarks) text += "; " + remark;
  for (const std::string& doubt : DoubtsOf(made.stream, StatedUp(recording, options))) {
    if (!doubt.empty()) text += "; " + doubt;
  }
  return text;
}

std::string Describe(const BodyMotion& motion, const std::vector<std::string>& changes) {
  return fmt::format("clip, {:.1f} s{}{}", motion.DurationSeconds(), changes.empty() ? "" : ", ", Join(changes, "; "));
}

/// Lists all files below a folder, sorted; links to folders are not followed.
Result<std::vector<std::string>> FilesBelow(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (at->is_regular_file(error)) files.push_back(at->path().string());
    if (files.size() > kMaxFiles) return Fail({folder}, "over {} files", kMaxFiles);
  }
  if (error) return Fail({folder}, "{}", error.message());
  std::ranges::sort(files);
  return files;
}

/// Returns true if a file of a folder begins like a recording; label files and read-me files do not.
Result<bool> LooksLikeStream(const std::string& path) {
  if (IsClip(path)) return true;
  if (fs::path(path).extension() == ".tagstream") return false;
  ASSIGN_OR_RETURN(const std::string text, ReadWholeFile(path));
  return DetectStreamFormat(text).has_value();
}

Result<void> AddFolder(const std::string& folder, const StreamReading& reading, const StreamOptions& options,
                       const OpenOptions& clips, LoadedStreams& loaded) {
  ASSIGN_OR_RETURN(const auto files, FilesBelow(folder));
  for (const std::string& file : files) {
    const auto is_stream = LooksLikeStream(file);
    if (!is_stream || !*is_stream) {
      ++loaded.passed_over;
      continue;
    }
    auto streams = LoadStream(file, reading, options, clips);
    if (!streams) {
      loaded.refused.push_back(streams.error());
      continue;
    }
    std::ranges::move(*streams, std::back_inserter(loaded.streams));
  }
  return {};
}

/// Checks that options for clips apply to at least one clip, and the up axis to at least one clip, CSV or TRC.
Result<void> CheckClipOptions(const std::vector<NamedStream>& streams, const OpenOptions& clips) {
  const auto is_clip = [](const NamedStream& stream) { return stream.motion.has_value(); };
  if (streams.empty() || std::ranges::any_of(streams, is_clip)) return {};
  const std::string& source = streams.front().source;
  if (clips.body.metres_per_unit || (clips.roles && !clips.roles->joints.empty())) {
    return Fail({source},
                "--joint-map and --unit are allowed only for clips, but this is a recording, whose format determines "
                "the unit and the joints");
  }
  if (clips.body.up && std::ranges::none_of(streams, &NamedStream::takes_up)) {
    return Fail({source}, "--up is {}", kWhereUpIsAllowed);
  }
  return {};
}

/// Returns a clip's stream. It begins at the file's first frame: `cut` frames before the motion show no body. `clock_s`
/// is the time of the motion's first frame by the file's own clock.
NamedStream StreamOfFile(const OpenedClip& opened, double clock_s, std::size_t cut) {
  BodyMotion motion = opened.body.motion;
  const double cut_s = static_cast<double>(cut) / opened.source.clip.rate_hz;
  const auto lead = static_cast<std::size_t>(std::lround(cut_s * motion.rate_hz));
  SkeletonStream stream = StreamOf(motion);
  stream.frames.insert(stream.frames.begin(), lead, SensedFrame{.joints = {}, .body_seen = false});
  motion.poses.insert(motion.poses.begin(), lead, BodyPose(motion.poses.front()));
  return {.name = opened.source.name,
          .source = opened.source.source,
          .person = "",
          .stream = std::move(stream),
          .start_s = clock_s - cut_s,
          .description = Describe(motion, opened.body.changes),
          .motion = std::move(motion)};
}

/// Reads the streams of all clips of a motion file.
Result<std::vector<NamedStream>> StreamsOfFile(const std::string& reference, const OpenOptions& options) {
  std::vector<NamedStream> streams;
  ASSIGN_OR_RETURN(auto clips, ReadClips(reference, options));
  for (SourceClip& clip : clips) {
    const std::optional<MadeBody> made = clip.made;
    ASSIGN_OR_RETURN(const auto opened, UnderstandClip(std::move(clip), options));
    const std::size_t cut = opened.body.dropped_frames + (made ? made->first_frame : 0);
    const double begin_s = static_cast<double>(cut) / opened.source.clip.rate_hz;
    streams.push_back(StreamOfFile(opened, made && made->start_s ? *made->start_s : begin_s, cut));
  }
  return streams;
}

}  // namespace

std::vector<NamedStream> StreamsOf(const ClipLibrary& library) {
  std::vector<NamedStream> streams;
  for (const LibraryClip& clip : library.clips) {
    streams.push_back({.name = clip.name,
                       .source = clip.source,
                       .person = "",
                       .stream = StreamOf(clip.motion),
                       .start_s = 0,
                       .description = Describe(clip.motion, clip.changes),
                       .motion = clip.motion});
  }
  return streams;
}

Result<std::vector<NamedStream>> LoadStream(const std::string& reference, const StreamReading& reading,
                                            const StreamOptions& options, const OpenOptions& clips) {
  if (reference.starts_with("builtin:")) {
    ASSIGN_OR_RETURN(const ClipLibrary library, LoadClips({reference}, {}, clips));
    return StreamsOf(library);
  }
  if (IsClip(reference)) return StreamsOfFile(reference, clips);
  ASSIGN_OR_RETURN(const std::string text, ReadWholeFile(reference));
  // A file in no sensor's format may be a clip.
  if (!reading.format && !DetectStreamFormat(text)) {
    if (auto streams = StreamsOfFile(reference, clips)) return streams;
  }
  ASSIGN_OR_RETURN(const StreamRecording recording, ReadStreamRecording(text, reference, reading));
  ASSIGN_OR_RETURN(MadeStream made, MakeStream(recording, reference, options));
  const std::string name = fs::path(reference).stem().string();
  std::vector<NamedStream> streams;
  streams.push_back({.name = name,
                     .source = reference,
                     .person = PersonInName(name),
                     .stream = {},
                     .start_s = made.start_s,
                     .description = Describe(recording, made, options),
                     .takes_up = recording.is_level});
  streams.back().stream = std::move(made.stream);
  return streams;
}

Result<LoadedStreams> LoadStreams(const std::vector<std::string>& references, const StreamReading& reading,
                                  const StreamOptions& options, const OpenOptions& clips) {
  LoadedStreams loaded;
  for (const std::string& reference : references) {
    // Load each reference: a folder, or the files to which a pattern expands.
    std::error_code ignored;
    if (fs::is_directory(reference, ignored)) {
      RETURN_IF_ERROR(AddFolder(reference, reading, options, clips, loaded));
      continue;
    }
    const auto expanded = ExpandReference(reference, {});
    if (!expanded && IsClip(reference)) return tl::unexpected(expanded.error());
    if (!expanded) return Fail({reference}, "no such recording; allowed: a file, a pattern, a folder or a clip");
    for (const std::string& one : *expanded) {
      auto streams = LoadStream(one, reading, options, clips);
      if (!streams && expanded->size() == 1) return tl::unexpected(streams.error());
      if (!streams) {
        loaded.refused.push_back(streams.error());
        continue;
      }
      std::ranges::move(*streams, std::back_inserter(loaded.streams));
    }
  }
  RETURN_IF_ERROR(CheckClipOptions(loaded.streams, clips));
  if (!loaded.streams.empty()) return loaded;
  if (!loaded.refused.empty()) return tl::unexpected(loaded.refused.front());
  return Fail({references.empty() ? "" : references.front()}, "no recordings of skeletons");
}

Result<std::vector<std::string>> LabelFiles(const std::string& path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) return std::vector{path};
  ASSIGN_OR_RETURN(auto files, FilesBelow(path));
  std::erase_if(files, [](const std::string& file) { return fs::path(file).extension() != ".tagstream"; });
  if (files.empty())
    return Fail({path},
                "the folder contains no .tagstream file; allowed: a labels file, or a folder of .tagstream files");
  return files;
}

Result<std::vector<Label>> LoadLabels(const std::string& path) {
  ASSIGN_OR_RETURN(const auto files, LabelFiles(path));
  std::vector<Label> labels;
  for (const std::string& file : files) {
    ASSIGN_OR_RETURN(const std::string text, ReadWholeFile(file));
    ASSIGN_OR_RETURN(const auto read, ReadLabels(text, file, fs::path(file).stem().string()));
    labels.insert(labels.end(), read.begin(), read.end());
  }
  return labels;
}

}  // namespace etude
