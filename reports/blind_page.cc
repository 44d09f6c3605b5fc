#include "reports/blind_page.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "bench/metrics/catalogue.h"
#include "engine/base/base64.h"
#include "engine/base/digest.h"
#include "io/drawing/assets/assets.h"
#include "io/drawing/escape.h"
#include "io/drawing/look.h"
#include "io/drawing/tool_page.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "reports/films/transition_race.h"
#include "reports/films/transition_scene.h"
#include "sim/random/stream.h"
#include "sim/render/renderer.h"

namespace etude {
namespace {

// A film begins one second before the request and ends two seconds after the last transition point of the two paths.
// The film is shorter if the recordings are shorter.
constexpr int kBefore = kFilmRate, kAfter = 2 * kFilmRate, kLongest = 20 * kFilmRate;
constexpr int kSide = 480, kGap = 16;

/// One film of the page: a world, and the transitions of two methods in this world. The left side shows the first
/// method.
struct ShownPair {
  const ScenarioSummary* scenario;
  const RecordedRequest* request;
  TransitionRace race;
};

/// Shuffles the items with the Fisher–Yates algorithm.
template <typename Item>
void Shuffle(std::vector<Item>& items, RandomStream& dice) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[dice.IndexBelow(i)]);
}

std::vector<std::vector<std::string>> PairsOf(const std::vector<std::string>& methods) {
  std::vector<std::vector<std::string>> pairs;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    for (std::size_t j = i + 1; j < methods.size(); ++j) pairs.push_back({methods[i], methods[j]});
  }
  return pairs;
}

std::vector<BlindKey::Metric> MetricsOf(const RecordedRequest& request, const ShownPair& pair) {
  const auto row_of = [&](std::size_t side) {
    const auto of_method = [&](const RecordedTransition& t) { return t.row->method == pair.race.paths[side].method; };
    return std::ranges::find_if(request.transitions, of_method)->row;
  };
  std::vector<BlindKey::Metric> metrics;
  for (const MetricValue& value : row_of(0)->result.metrics) {
    const MetricInfo* info = FindMetric(value.id);
    if (info == nullptr || info->direction == Direction::kNeither) continue;
    metrics.push_back(
        {value.id, info->direction == Direction::kHigherIsBetter, value.value, ValueOf(*row_of(1), value.id)});
  }
  return metrics;
}

/// Returns true if both methods of a pair made a transition in this world, and if the transitions end early enough for
/// a film of at most kLongest frames.
bool CanBeCompared(const TransitionRace& race) {
  const auto is_in_time = [](const TransitionPath& path) {
    return path.LastPoint() >= 0 && path.LastPoint() <= kLongest - kAfter;
  };
  return race.paths.size() == 2 && std::ranges::all_of(race.paths, is_in_time);
}

/// Films the paths of the two methods side by side. While a path is not recorded, its side is empty, because a body
/// that is shown without motion would seem to have frozen. Returns an empty text if filming was stopped.
Result<std::string> FilmPair(const TransitionRace& race, Renderer& renderer, const FilePath& path,
                             const FilmWatch& watch) {
  const auto begin_of = [](const TransitionPath& shown) { return shown.TimeOf(0); };
  const auto end_of = [](const TransitionPath& shown) {
    return shown.TimeOf(static_cast<int>(shown.motion.poses.size()));
  };
  const auto &one = race.paths[0], &other = race.paths[1];
  const int first = std::max(-kBefore, std::min(begin_of(one), begin_of(other)));
  const int end = std::min(std::max(one.LastPoint(), other.LastPoint()) + kAfter, std::max(end_of(one), end_of(other)));
  const TransitionStage stage(race, first, end, kSide, kSide);
  const auto draw = [&](int frame) {
    const int time = first + frame;
    Canvas canvas(2 * kSide + kGap, kSide);
    canvas.FillBox({0, 0, 2.0 * kSide + kGap, kSide}, kBackdrop);
    for (std::size_t side = 0; side < 2; ++side) {
      const TransitionPath& shown = race.paths[side];
      if (time < begin_of(shown) || time >= end_of(shown)) continue;
      const auto picture = stage.Picture(renderer, shown, side, shown.FrameAt(time), std::nullopt);
      canvas.Put(picture, static_cast<int>(side) * (kSide + kGap), 0);
    }
    return canvas;
  };
  ASSIGN_OR_RETURN(const bool is_whole, EncodeFrames(path, end - first, kFilmRate, draw, watch));
  return is_whole ? ReadWholeFile(path) : Result<std::string>("");
}

std::string PageOf(const RunData& run, const std::string& digest, const std::string& films_html) {
  const std::string content = fmt::format(
      "<div class=\"blind\" data-page=\"{}\"><p><label>Your name or a code: <input id=\"rater\"></label></p>"
      "<p id=\"place\" aria-live=\"polite\"></p>{}<p><button data-answer=\"left\">← Left</button> "
      "<button data-answer=\"same\">↓ No difference</button> <button data-answer=\"right\">Right →</button></p>"
      "<p><button id=\"back\">Back</button> <button id=\"save\">Save answers</button></p></div>"
      "<style>.blind button, .blind input {{ font: inherit; padding: 6px 14px; margin: 2px; }} .blind "
      "[aria-pressed=true] {{ outline: 3px solid var(--accent); }} .blind video {{ width: auto; max-width: "
      "100%; max-height: 56vh; }}</style>",
      digest, films_html);
  return WriteToolPage({.kind = "comparison",
                        .title = "Which body moves more naturally?",
                        .verdict = "In each film, both bodies change from one motion to another. A side of the film is "
                                   "empty while its motion has not begun or has already ended. Watch each film to the "
                                   "end at least once, then choose the side with the more natural motion. At the end, "
                                   "save your answers, and send the file to the person who gave you this page.",
                        .version = run.program_version,
                        .command = "",
                        .script = BlindJs()},
                       content);
}

}  // namespace

Result<std::optional<BlindTrial>> MakeBlindTrial(const RunData& run, const BlindOptions& options) {
  // Collect the recorded worlds and put these worlds in a random order.
  std::vector<std::pair<const ScenarioSummary*, RecordedRequest>> worlds;
  for (const ScenarioSummary& scenario : run.scenarios) {
    for (RecordedRequest& request : RecordedRequestsOf(run, scenario))
      worlds.emplace_back(&scenario, std::move(request));
  }
  RandomStream dice({options.seed, "blind", 0}, "order and sides");
  Shuffle(worlds, dice);
  // Give each world the next pair of methods, and draw which of the two is shown on the left.
  BlindTrial trial;
  trial.key.seed = fmt::format("{}", options.seed);
  trial.key.worlds = static_cast<int>(worlds.size());
  const auto pairs = PairsOf(options.methods);
  std::vector<ShownPair> shown;
  for (std::size_t i = 0; i < worlds.size() && static_cast<int>(shown.size()) < options.pairs; ++i) {
    auto methods = pairs[i % pairs.size()];
    if (dice.Chance(0.5)) std::swap(methods[0], methods[1]);
    TransitionRace race = RaceIn(worlds[i].second, *worlds[i].first, methods);
    if (CanBeCompared(race)) {
      shown.push_back({worlds[i].first, &worlds[i].second, std::move(race)});
    } else {
      ++trial.key.left_out;
    }
  }
  if (shown.empty()) {
    return Fail({},
                "no world has recorded motions of two of these methods: {}. Use `etude run --keep motions` or the "
                "scenario key 'video' to record motions",
                fmt::join(options.methods, ", "));
  }
  // Film the pairs. In `trial.key`, name the method that each side of a film shows.
  ASSIGN_OR_RETURN(auto* const renderer, SharedRenderer());
  ASSIGN_OR_RETURN(const auto folder, TemporaryFolder::Make("blind"));
  std::string films_html;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const ShownPair& pair = shown[i];
    ASSIGN_OR_RETURN(const auto film,
                     FilmPair(pair.race, *renderer, folder.path() / fmt::format("pair-{}.mp4", i + 1), options.watch));
    if (film.empty()) return std::nullopt;
    films_html += fmt::format(
        "<figure class=\"pair film\" hidden><video controls muted playsinline preload=\"none\" "
        "src=\"data:video/mp4;base64,{}\"></video><figcaption>{}</figcaption></figure>",
        Base64(film), EscapeMarkup(pair.race.request));
    trial.key.pairs.push_back({pair.scenario->name, pair.race.world, pair.race.paths[0].method,
                               pair.race.paths[1].method, MetricsOf(*pair.request, pair)});
  }
  trial.key.page = Digest().Add(films_html).Hex();
  trial.page_html = PageOf(run, trial.key.page, films_html);
  return trial;
}

}  // namespace etude
