#include "cli/bridge_command.h"

#include <fmt/core.h>

#include "bench/files/files.h"
#include "cli/bridge_library.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "cli/progress_bar.h"
#include "engine/transitions/tags_file/compare_tags.h"
#include "engine/transitions/tags_file/tags_file.h"
#include "reports/clips/bridge_summary.h"

namespace etude {
namespace {

BridgeTags TagsOf(const BridgeLibrary& loaded) {
  return CollectTags(loaded.library, loaded.sources, loaded.system, loaded.tag_rules, loaded.match_rules);
}

/// The file's own rules, so that its clips are tagged as they were.
BridgeCommandOptions OptionsOf(const BridgeTags& tags, BridgeCommandOptions options) {
  options.threshold = tags.threshold;
  options.within_class = tags.within_class;
  options.min_clips = tags.min_clips;
  options.most_per_class = tags.most_per_class;
  if (!options.fuzzy.empty()) return options;
  for (const std::string& name : BuiltinFuzzySystemNames()) {
    if (name == tags.system) options.fuzzy = "builtin:" + name;
  }
  return options;
}

int CheckTags(const BridgeCommandOptions& options) {
  if (options.clips.empty() && !options.fuzzy.empty()) {
    return Complain({{"--fuzzy", 0, 0}, "is for tagging clips again; name those that the file should fit"});
  }
  const auto text = ReadWholeFile(options.check);
  if (!text) return Complain(text.error());
  const auto tags = ReadTagsFile(*text, options.check);
  if (!tags) return Complain(tags.error());
  std::size_t bridge_frames = 0;
  for (const ClipTags& clip : tags->clips) bridge_frames += clip.bridge_frames.size();
  if (options.clips.empty()) {
    fmt::print("{}: {} clips, {} bridge frames, {} key poses; valid\n", options.check, tags->clips.size(),
               bridge_frames, tags->keys.size());
    return kSuccess;
  }
  const auto loaded = LoadBridgeLibrary(OptionsOf(*tags, options));
  if (!loaded) return Complain(loaded.error());
  const TagsComparison comparison = CompareTags(*tags, TagsOf(*loaded));
  if (!comparison.differences.empty()) {
    const std::size_t count = comparison.differences.size();
    const std::string rest = count == 1 ? "" : fmt::format("; {} differences in all", count);
    return Complain(
        {{options.check, 0, 0}, fmt::format("does not fit the clips: {}{}", comparison.differences.front(), rest)});
  }
  fmt::print("{}: {} clips, {} bridge frames, {} key poses; valid, and fits the clips\n", options.check,
             comparison.clips, comparison.bridge_frames, tags->keys.size());
  return kSuccess;
}

/// Writes the tags, after reading them back.
Result<void> WriteTags(const BridgeLibrary& loaded, const std::string& path) {
  const BridgeTags tags = TagsOf(loaded);
  ASSIGN_OR_RETURN(const auto text, WriteTagsFile(tags));
  ASSIGN_OR_RETURN(const auto back, ReadTagsFile(text, path));
  if (!(back == tags)) return Fail({path, 0, 0}, "reads back as other tags; nothing was written");
  return WriteFileAtomically(path, text);
}

}  // namespace

int BridgeCommand(const BridgeCommandOptions& options) {
  if (!options.check.empty()) return CheckTags(options);
  if (options.clips.empty()) return Complain({{}, "etude bridge needs clips, or --check a tags file"});
  if (!options.output.empty()) {
    if (auto free = CheckOutput(options.output, options.overwrite); !free) return Complain(free.error());
  }
  const auto loaded = LoadBridgeLibrary(options);
  if (!loaded) return Complain(loaded.error());
  if (!options.output.empty()) {
    if (auto written = WriteTags(*loaded, options.output); !written) return Complain(written.error());
  }
  const Coverage coverage(loaded->library.tagged, loaded->match_rules, options.wait_s, TellOf("comparisons of a clip"));
  if (options.as_json) {
    const auto json = BridgeSummaryAsJson(*loaded, coverage, options.wait_s);
    if (!json) return Complain(json.error());
    fmt::print("{}\n", *json);
  } else {
    fmt::print("{}", BridgeSummaryAsText(*loaded, coverage, options.wait_s));
  }
  if (!options.output.empty()) TellWritten(options.output, options.as_json ? stderr : stdout);
  return kSuccess;
}

}  // namespace etude
