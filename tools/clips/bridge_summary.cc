#include "tools/clips/bridge_summary.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "engine/base/names.h"
#include "io/drawing/numbers.h"
#include "io/files/json.h"

namespace etude {
namespace {

/// The largest number of clips whose matrix fits a terminal. The output of --json has no limit.
constexpr int kMaxMatrixClips = 24;

/// One clip's row of the table. Coverage is measured for each other clip separately if the table of pairs is made,
/// otherwise for all other clips together.
struct ClipSummary {
  int frames = 0, bridge_frames = 0;
  int poses = 0;           ///< number of different tag combinations among the clip's bridge frames
  int reached = 0;         ///< number of other clips that this clip leads into; only if pairs are made
  /// The two shares of ClipCoverage; if pairs are made, their means over the other clips.
  double frame_share = 0;
  double in_between_share = 0;
  std::optional<double> worst_wait_s;  ///< longest wait; if pairs are made, over the clips that this clip leads into
};

ClipSummary Summarize(const TaggedClip& clip, const Coverage& coverage, int from) {
  ClipSummary summary;
  summary.frames = clip.FrameCount();
  summary.bridge_frames = static_cast<int>(clip.bridge_frames.size());
  std::set<Tags> poses;
  for (int frame : clip.bridge_frames) poses.insert(clip.tags[frame]);
  summary.poses = static_cast<int>(poses.size());
  if (!coverage.HasPairs()) {
    const ClipCoverage& any = coverage.IntoAny(from);
    summary.frame_share = any.frame_share;
    summary.in_between_share = any.in_between_share;
    summary.worst_wait_s = any.worst_wait_s;
    return summary;
  }
  const int others = coverage.ClipCount() - 1;
  for (int to = 0; to < coverage.ClipCount(); ++to) {
    if (to == from) continue;
    const ClipCoverage& pair = coverage.Of(from, to);
    summary.frame_share += pair.frame_share / others;
    summary.in_between_share += pair.in_between_share / others;
    if (!pair.worst_wait_s) continue;
    ++summary.reached;
    summary.worst_wait_s = std::max(summary.worst_wait_s.value_or(0), *pair.worst_wait_s);
  }
  return summary;
}

std::vector<ClipSummary> SummarizeAll(const BridgeLibrary& loaded, const Coverage& coverage) {
  std::vector<ClipSummary> all;
  for (int c = 0; c < coverage.ClipCount(); ++c) all.push_back(Summarize(loaded.library.tagged[c], coverage, c));
  return all;
}

ClipSummary Total(const std::vector<ClipSummary>& clips) {
  ClipSummary total;
  for (const ClipSummary& clip : clips) {
    total.frames += clip.frames;
    total.bridge_frames += clip.bridge_frames;
    total.frame_share += clip.frame_share * clip.frames;
    total.in_between_share += clip.in_between_share * clip.frames;
  }
  if (total.frames > 0) {
    total.frame_share /= total.frames;
    total.in_between_share /= total.frames;
  }
  return total;
}

double Percent(double part, double whole) { return whole > 0 ? 100 * part / whole : 0; }

std::vector<std::string> NamesOf(const std::vector<int>& clips, const TaggedLibrary& library) {
  std::vector<std::string> names;
  for (int clip : clips) names.push_back(library.names[clip]);
  return names;
}

int NameWidth(const TaggedLibrary& library) {
  std::size_t width = 4;
  for (const std::string& name : library.names) width = std::max(width, name.size());
  return static_cast<int>(std::min<std::size_t>(width, 40));
}

std::string ClipsAsText(const BridgeLibrary& loaded, const Coverage& coverage, const std::vector<ClipSummary>& clips,
                        double wait_s) {
  const bool has_pairs = coverage.HasPairs();
  std::string text;
  const int width = NameWidth(loaded.library);
  text += fmt::format("\n     {:{}}  frames  bridge frames  poses{}  frames with a match  worst wait  in-between\n",
                      "clip", width, has_pairs ? "  leads into" : "");
  for (std::size_t c = 0; c < clips.size(); ++c) {
    const ClipSummary& clip = clips[c];
    text += fmt::format("{:>3}  {:{}}  {:>6}  {:>6} ({:>3.0f} %)  {:>5}", c + 1, loaded.library.names[c], width,
                        clip.frames, clip.bridge_frames, Percent(clip.bridge_frames, clip.frames), clip.poses);
    if (has_pairs) text += fmt::format("  {:>3} of {:<3}", clip.reached, clips.size() - 1);
    text += fmt::format("  {:>17.0f} %  {:>10}  {:>8.0f} %\n", 100 * clip.frame_share,
                        clip.worst_wait_s ? fmt::format("{:.1f} s", *clip.worst_wait_s) : "-",
                        100 * clip.in_between_share);
  }
  text += fmt::format(
      "\n"
      "poses: number of different sets of ten tags. frames with a match: share of frames with a distance d < {} to a "
      "frame of {}.\n"
      "worst wait: longest time until a bridge frame with a match in {}; the clip is repeated.\n"
      "in-between: share of frames from which a transition within {} s needs an in-between clip.{}\n",
      loaded.match_rules.threshold, has_pairs ? "another clip" : "any other clip",
      has_pairs ? "the other clip, maximum over all reachable clips" : "any other clip", wait_s,
      has_pairs ? " The shares of matches and in-betweens are means over the other clips." : "");
  return text;
}

/// Writes the matrix of clips: each entry is the percentage of the row clip's bridge frames that match a bridge frame
/// of the column clip; "." means none.
std::string MatrixAsText(const BridgeLibrary& loaded, const Coverage& coverage) {
  std::string text;
  const int count = coverage.ClipCount(), width = NameWidth(loaded.library);
  text += fmt::format(
      "\nPercentage of the bridge frames of the clip in a row that match a bridge frame of the clip in a column:\n     "
      "{:{}}",
      "", width);
  for (int to = 0; to < count; ++to) text += fmt::format(" {:>3}", to + 1);
  text += "\n";
  for (int from = 0; from < count; ++from) {
    text += fmt::format("{:>3}  {:{}}", from + 1, loaded.library.names[from], width);
    for (int to = 0; to < count; ++to) {
      const ClipCoverage& pair = coverage.Of(from, to);
      const std::string share = pair.worst_wait_s ? fmt::format("{:.0f}", 100 * pair.bridge_share) : ".";
      text += fmt::format(" {:>3}", from == to ? "-" : share);
    }
    text += "\n";
  }
  return text;
}

std::string WaysAsText(const BridgeLibrary& loaded, const Coverage& coverage) {
  std::string text = "\n";
  for (int wanted : loaded.corrective) {
    const std::vector<std::string> without = NamesOf(coverage.WithoutWayInto(wanted), loaded.library);
    const std::string& name = loaded.library.names[wanted];
    if (without.empty()) {
      text += fmt::format("Every clip has a bridge frame that leads into {}.\n", name);
    } else {
      text += fmt::format("These clips have no bridge frame that leads into {}: {}.\n", name, Join(without));
    }
  }
  if (loaded.corrective.empty())
    text +=
        "No corrective clip is in the library or in --to, so Etude did not search bridge frames that lead into "
        "corrective clips.\n";
  return text;
}

}  // namespace

std::string BridgeSummaryAsText(const BridgeLibrary& loaded, const Coverage& coverage, double wait_s) {
  std::string text;
  const std::vector<ClipSummary> clips = SummarizeAll(loaded, coverage);
  const ClipSummary total = Total(clips);
  text += fmt::format("{}, {}, {} ({:.0f} %); fuzzy system {}, threshold {}{}\n", Plural(std::ssize(clips), "clip"),
                      Plural(total.frames, "frame"), Plural(total.bridge_frames, "bridge frame"),
                      Percent(total.bridge_frames, total.frames), loaded.system.name, loaded.match_rules.threshold,
                      loaded.match_rules.within_class ? ", matches only between frames with the same tags" : "");
  text += ClipsAsText(loaded, coverage, clips, wait_s);
  if (!coverage.HasPairs()) {
    text += "\nPairs of clips were not compared; use --pairs to compare all pairs.\n";
  } else if (coverage.ClipCount() <= kMaxMatrixClips) {
    text += MatrixAsText(loaded, coverage);
  } else {
    text += fmt::format("\nThe matrix of {} × {} clips is too large for this text; --json prints it.\n", clips.size(),
                        clips.size());
  }
  text += WaysAsText(loaded, coverage);
  if (coverage.ClipCount() == 1) return text + "The library has only one clip, so there are no transitions.\n";
  text += fmt::format(
      "Transitions from all frames into {} other clip within {} s: {:.0f} % lead directly, {:.0f} % need an in-between "
      "clip. In-between\n"
      "clips are made from {} key poses and take at most {:.1f} s.\n",
      coverage.HasPairs() ? "any" : "some", wait_s, 100 * (1 - total.in_between_share), 100 * total.in_between_share,
      loaded.library.in_betweens.keys.size(), LongestInBetween(loaded.library.in_betweens.tween, kJudgedRateHz));
  return text;
}

Json BridgeSummaryAsJson(const BridgeLibrary& loaded, const Coverage& coverage, double wait_s) {
  const std::vector<ClipSummary> clips = SummarizeAll(loaded, coverage);
  const auto or_null = [](const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); };
  const auto of_pairs = [&](const auto& value) { return coverage.HasPairs() ? Json(value) : Json(nullptr); };
  const auto coverage_json = [&](const ClipCoverage& of) {
    return Json{{"frame_share", of.frame_share},
                {"bridge_share", of.bridge_share},
                {"worst_wait_s", or_null(of.worst_wait_s)},
                {"in_between_share", of.in_between_share}};
  };
  const TaggedLibrary& library = loaded.library;
  // Write one object for each clip, and one object for each ordered pair of clips.
  Json of_clips = Json::array(), pairs = Json::array(), ways = Json::array();
  for (int from = 0; from < coverage.ClipCount(); ++from) {
    const ClipSummary& clip = clips[from];
    of_clips.push_back({{"name", library.names[from]},
                        {"source", loaded.sources[from]},
                        {"frames", clip.frames},
                        {"bridge_frames", clip.bridge_frames},
                        {"poses", clip.poses},
                        {"any", coverage_json(coverage.IntoAny(from))},
                        {"leads_into", of_pairs(clip.reached)},
                        {"partner_share", of_pairs(clip.frame_share)},
                        {"worst_wait_s", coverage.HasPairs() ? or_null(clip.worst_wait_s) : Json(nullptr)},
                        {"in_between_share", of_pairs(clip.in_between_share)}});
    for (int to = 0; coverage.HasPairs() && to < coverage.ClipCount(); ++to) {
      if (to == from) continue;
      Json pair = coverage_json(coverage.Of(from, to));
      pair["from"] = library.names[from];
      pair["to"] = library.names[to];
      pairs.push_back(std::move(pair));
    }
  }
  // For each corrective clip, list the clips that do not lead into it.
  for (int wanted : loaded.corrective) {
    ways.push_back({{"into", library.names[wanted]}, {"not_from", NamesOf(coverage.WithoutWayInto(wanted), library)}});
  }
  Json summary = {{"fuzzy_system", loaded.system.name},
                  {"threshold", loaded.match_rules.threshold},
                  {"within_class", loaded.match_rules.within_class},
                  {"wait_s", wait_s},
                  {"clips", of_clips},
                  {"corrective", ways},
                  {"keys", library.in_betweens.keys.size()},
                  {"longest_in_between_s", LongestInBetween(library.in_betweens.tween, kJudgedRateHz)}};
  if (coverage.HasPairs()) summary["pairs"] = std::move(pairs);
  return summary;
}

}  // namespace etude
