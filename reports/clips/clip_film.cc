#include "reports/clips/clip_film.h"

#include <fmt/core.h>

#include <cmath>

#include "bench/films/encoder.h"
#include "reports/clips/clip_facts.h"
#include "reports/films/look.h"

namespace etude {
namespace {

// Moving pictures hide rough edges: half the pixels of a sheet's.
constexpr double kDetail = 1.5;
// The camera follows slowly: half a second to either side.
constexpr int kSmoothing = 15;
// Enough of the clip's frames to know how much room it needs.
constexpr int kLookedAt = 200;

}  // namespace

Result<bool> FilmClip(ClipActor actor, const FilmOptions& options, const std::filesystem::path& path,
                      Renderer& renderer) {
  const ClipFacts facts = FactsOf(actor.clip());
  const Shot shot(std::move(actor), options.from, kSmoothing);
  Sight sight;
  shot.Include(SpreadFrames(shot, kLookedAt), sight);
  const Studio studio(options.width, options.height, kDetail, sight);
  const auto rate = static_cast<int>(std::lround(shot.actor().motion().rate_hz));
  ASSIGN_OR_RETURN(auto encoder, Encoder::Start(path, options.width, options.height, rate));
  const Box whole{0, 0, static_cast<double>(options.width), static_cast<double>(options.height)};
  for (int frame = 0; frame < shot.Frames(); ++frame) {
    if (options.watch.IsStopped()) return false;
    Canvas canvas(options.width, options.height);
    shot.Draw(canvas, whole, studio, renderer, frame);
    DrawTag(canvas, whole, fmt::format("{:.2f} s", shot.SecondsAt(frame)));
    DrawLegend(canvas, whole.width - 16, 29);
    DrawCaption(canvas, whole, facts.name, FactsAsLine(facts));
    RETURN_IF_ERROR(encoder.Add(canvas.Pixels()));
    options.watch.Tell(path, static_cast<std::size_t>(frame + 1), static_cast<std::size_t>(shot.Frames()));
  }
  RETURN_IF_ERROR(encoder.Finish());
  return true;
}

}  // namespace etude
