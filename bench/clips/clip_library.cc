#include "bench/clips/clip_library.h"

#include "bench/clips/builtin_clip.h"
#include "bench/clips/references.h"

namespace etude {
namespace {

Result<void> AddBuiltin(const std::string& reference, const Place& place, ClipLibrary& library) {
  auto builtin = LoadBuiltinClip(reference.substr(kBuiltinPrefix.size()), place);
  if (!builtin) return tl::unexpected(builtin.error());
  library.clips.push_back({reference, reference, std::move(builtin->motion), std::move(builtin->move), ""});
  return {};
}

Result<void> AddFile(const std::string& reference, const OpenOptions& options, ClipLibrary& library) {
  auto clips = ReadClips(reference);
  if (!clips) return tl::unexpected(clips.error());
  for (SourceClip& clip : *clips) {
    auto opened = UnderstandClip(std::move(clip), options);
    if (!opened) return tl::unexpected(opened.error());
    library.clips.push_back(
        {opened->source.name, opened->source.source, std::move(opened->body.motion), std::nullopt, opened->body.note});
  }
  return {};
}

}  // namespace

Result<ClipLibrary> LoadClips(const std::vector<std::string>& references, const Place& place,
                              const OpenOptions& options) {
  ClipLibrary library;
  for (const std::string& reference : references) {
    const auto expanded = ExpandReference(reference, place);
    if (!expanded) return tl::unexpected(expanded.error());
    for (const std::string& one : *expanded) {
      auto added = one.starts_with(kBuiltinPrefix) ? AddBuiltin(one, place, library) : AddFile(one, options, library);
      if (!added) return tl::unexpected(added.error());
      if (library.clips.size() > kMostClips) return Fail(place, "more than {} clips", kMostClips);
    }
  }
  return library;
}

}  // namespace etude
