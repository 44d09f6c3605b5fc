#include "tools/capture/capture_films.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "engine/base/names.h"
#include "engine/formats/trc.h"
#include "engine/keypoints/people.h"
#include "io/files/files.h"
#include "tools/capture/capture_parts.h"

namespace etude {
namespace {

/// Refuses a reference in which no marker has the name of a keypoint or joint, because nothing could be compared.
Result<void> CheckReference(const MarkerMotion& reference, const std::string& file) {
  const auto is_known = [](const std::string& name) { return FindLandmark(name) || FindRole(name); };
  if (std::ranges::any_of(reference.names, is_known)) return {};
  constexpr std::size_t kShown = 4;
  const std::span<const std::string> shown(reference.names.data(), std::min(kShown, reference.names.size()));
  return Fail({file},
              "no marker can be compared: none of the {} markers ({}{}) has the name of a keypoint ({}, …) or of a "
              "joint ({}, …)",
              reference.names.size(), Join(shown), reference.names.size() > kShown ? ", …" : "",
              LandmarkName(Landmark::kLeftShoulder), RoleName(Role::kLeftShoulder));
}

}  // namespace

Result<CapturedFilms> CaptureFilms(const CaptureFilmsOptions& options) {
  // Check the options that exclude each other, and read the reference.
  RETURN_IF_ERROR(FormatOfName(options.output));
  if (options.keypoints.empty() && options.marks.empty() && !options.silhouettes) {
    return Fail(
        {}, "the source of the person's position is missing; allowed: --keypoints DIR, --marks DIR or --silhouettes");
  }
  std::optional<MarkerMotion> reference;
  if (!options.reference.empty()) {
    ASSIGN_OR_RETURN(const auto text, ReadWholeFile(options.reference));
    ASSIGN_OR_RETURN(reference, ReadTrc(text, options.reference));
    RETURN_IF_ERROR(CheckReference(*reference, options.reference));
  }
  if (options.silhouettes && options.sync_s > 0)
    return Fail({},
                "--sync: outlines cannot determine the delay between films; cut the films so that all begin at the "
                "same moment");
  if (options.silhouettes && !options.keypoints.empty() && options.stature_m > 0) {
    return Fail({}, "--stature: not allowed with --keypoints, because the keypoints determine the person's height");
  }
  RETURN_IF_ERROR(CheckPlace(options.place));
  // Open the films, and resample the reference to the films' frame rate.
  ASSIGN_OR_RETURN(FilmedSession session, OpenFilms(options));
  const FilmFacts facts = session.views.front().facts;
  options.listener.print(
      fmt::format("{} films, {} frames at {:g} Hz\n", session.views.size(), facts.EvenFrames(), facts.rate_hz));
  if (reference && std::abs(reference->rate_hz - facts.rate_hz) > kSameRateTolerance * facts.rate_hz) {
    options.listener.print(
        fmt::format("reference: resampled from {:g} to {:g} Hz by linear interpolation between frames\n",
                    reference->rate_hz, facts.rate_hz));
    reference = AtRate(std::move(*reference), facts.rate_hz);
  }
  // Begin the JSON of findings.
  Json seen = Json::array();
  for (const FilmedView& view : session.views) {
    seen.push_back({{"film", view.path.string()}, {"camera", view.camera.name}});
  }
  Json told = {{"films", std::move(seen)}, {"frames", facts.EvenFrames()}, {"rate_hz", facts.rate_hz},
               {"keypoints", nullptr},     {"silhouettes", nullptr},       {"doubt", nullptr},
               {"output", options.output}};
  bool is_whole = false;
  // With silhouettes alone, the rig must be placed in the world before the person is found.
  if (options.silhouettes && options.keypoints.empty()) {
    const auto place = PlaceRig(session.rig, options.place);
    if (!place) return Fail({options.rig}, "{}", place.error().message);
    session.told.push_back(fmt::format("rig, {}: {}", session.rig.format, place->told));
    if (!place->doubt.empty()) session.told.push_back("doubtful: " + place->doubt);
    for (const std::string& doubt : DoubtsOnCameras(session.views)) session.told.push_back(doubt);
    for (FilmedView& view : session.views) {
      if (view.fit.quarter_turns != 0) {
        return Fail({view.path.string()},
                    "the pictures are rotated, and outlines cannot determine in which direction; rotate the film");
      }
      view.camera.camera = Placed(*place, view.camera.camera);
    }
    ASSIGN_OR_RETURN(is_whole, CaptureUnmarked(options, session, reference, told));
  } else {
    ASSIGN_OR_RETURN(is_whole, CaptureKeypoints(options, std::move(session), reference, told));
  }
  const std::string doubt = told["doubt"].is_null() ? "" : told["doubt"].get<std::string>();
  if (!doubt.empty() && !options.accepts_doubtful) told["output"] = nullptr;
  return CapturedFilms{is_whole, doubt, std::make_unique<Json>(std::move(told))};
}

}  // namespace etude
