#include "io/clips/clip_library.h"

#include "engine/retargeting/proportions.h"
#include "io/clips/references.h"
#include "sim/character/posed.h"

namespace etude {
namespace {

Result<void> AddBuiltin(const std::string& reference, const Place& place, ClipLibrary& library) {
  ASSIGN_OR_RETURN(auto builtin, LoadBuiltinClip(reference.substr(kBuiltinPrefix.size()), place));
  RestBody body = RestBodyOf(builtin.motion.poses);
  library.clips.push_back({reference, reference, std::move(builtin.motion), std::move(builtin.move), std::move(body)});
  return {};
}

std::shared_ptr<const RecordedFigure> FigureOf(const OpenedClip& clip) {
  if (clip.source.character == nullptr) return nullptr;
  return std::make_shared<const RecordedFigure>(clip.source.character, clip.source.clip, clip.map, clip.body);
}

Result<void> AddFile(const std::string& reference, const OpenOptions& options, ClipLibrary& library) {
  ASSIGN_OR_RETURN(auto clips, ReadClips(reference, options));
  for (SourceClip& clip : clips) {
    ASSIGN_OR_RETURN(auto opened, UnderstandClip(std::move(clip), options));
    RestBody body = MeasureBody(opened.source.clip, opened.map, opened.body);
    std::shared_ptr<const RecordedFigure> figure = FigureOf(opened);
    library.clips.push_back({opened.source.name, opened.source.source, std::move(opened.body.motion), std::nullopt,
                             std::move(body), std::move(figure), opened.body.changes});
  }
  return {};
}

}  // namespace

std::string CollectionOf(const LibraryClip& clip) {
  const std::size_t slash = clip.source.rfind('/');
  const bool is_named = clip.source.starts_with(kBuiltinPrefix) || FileOf(clip.source) != clip.source;
  if (is_named) return clip.source.substr(0, clip.source.find(':'));
  return slash == std::string::npos ? "." : clip.source.substr(0, slash);
}

Result<ClipLibrary> LoadClips(const std::vector<std::string>& references, const Place& place,
                              const OpenOptions& options, const OnProgress& on_progress) {
  ClipLibrary library;
  std::size_t done = 0;
  for (const std::string& reference : references) {
    if (on_progress) on_progress(done++, references.size());
    ASSIGN_OR_RETURN(const auto expanded, ExpandReference(reference, place));
    for (const std::string& one : expanded) {
      RETURN_IF_ERROR(one.starts_with(kBuiltinPrefix) ? AddBuiltin(one, place, library)
                                                      : AddFile(one, options, library));
      if (library.clips.size() > kMaxClips) return Fail(place, "more than {} clips", kMaxClips);
    }
  }
  if (on_progress) on_progress(done, references.size());
  return library;
}

}  // namespace etude
