#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "engine/base/named.h"
#include "engine/base/order_statistics.h"
#include "engine/keypoints/guess_session.h"
#include "io/keypoints/read_people.h"
#include "tools/capture/capture_parts.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

Result<fs::path> EntryOf(const CaptureFilmsOptions& options, const FilmedView& view) {
  return EntryOfFilm(options.marks.empty() ? options.keypoints : options.marks, view.path.stem().string());
}

/// Reads the keypoints or marks of all films. If the frame numbers of one film count from 1, so do those of a film
/// whose numbers may count from 0 or from 1. The films share one scale of scores (SharedScoreScale): a film in which
/// the person is seen badly then counts less than the others.
Result<std::vector<PeopleOfFilm>> ReadFilms(const CaptureFilmsOptions& options, const std::vector<FilmedView>& views) {
  const auto read = [&](const FilmedView& view, bool from_one, double score_scale) -> Result<PeopleOfFilm> {
    ASSIGN_OR_RETURN(const fs::path entry, EntryOf(options, view));
    const FilmFacts& facts = view.facts;
    const FilmOfKeypoints of{facts.width, facts.height, static_cast<std::size_t>(facts.frames), from_one, score_scale};
    return options.marks.empty() ? ReadKeypoints(entry, options.layout, of) : ReadMarkedPictures(entry);
  };
  std::vector<PeopleOfFilm> films;
  for (const FilmedView& view : views) {
    ASSIGN_OR_RETURN(films.emplace_back(), read(view, false, 0));
  }
  // Read again the films whose numbers or scores have another meaning when all films are considered together.
  const bool from_one = std::ranges::any_of(films, &PeopleOfFilm::is_from_one);
  std::vector<double> scales;
  for (const PeopleOfFilm& film : films) scales.push_back(SharedScoreScale(film.score_scale, films));
  for (std::size_t i = 0; i < views.size(); ++i) {
    const bool is_other_base = from_one && films[i].is_base_open;
    if (!is_other_base && scales[i] == 0) continue;
    ASSIGN_OR_RETURN(films[i], read(views[i], is_other_base, scales[i]));
  }
  return films;
}

/// Returns the people of a film, in pixels of the keypoint file. Sets `view.is_sized` if the file states the size of
/// the pictures.
Result<SeenPeople> TakePeople(const CaptureFilmsOptions& options, PeopleOfFilm film, FilmedView& view,
                              double min_confidence, MessageLog& told) {
  ASSIGN_OR_RETURN(const fs::path entry, EntryOf(options, view));
  if (!film.told.empty()) options.listener.print(fmt::format("{}: {}\n", entry.filename().string(), film.told));
  if (!film.doubt.empty()) told.Tell(fmt::format("doubtful: {}: {}", entry.filename().string(), film.doubt));
  // Check that the file has the film's number of frames and, up to a rotation by 90°, the film's picture size.
  if (film.frames.size() != static_cast<std::size_t>(view.facts.frames)) {
    return Fail(
        {entry.string()},
        "contains keypoints of {} frames, but the film {} has {} frames; allowed: an entry or a file for each frame, "
        "even for frames that show nobody, or frame numbers (frame_id, image_id, or at the end of file names)",
        film.frames.size(), view.path.string(), view.facts.frames);
  }
  const bool is_turned = film.width == view.facts.height && film.height == view.facts.width;
  if (film.width != 0 && !is_turned && (film.width != view.facts.width || film.height != view.facts.height)) {
    return Fail({entry.string()}, "the keypoints were found in pictures of {} x {} pixels, but the film has {} x {}",
                film.width, film.height, view.facts.width, view.facts.height);
  }
  view.is_sized = film.width != 0;
  // Report scores that are too low for keypoints to be used.
  std::size_t seen = 0, unsure = 0;
  for (const auto& frame : film.frames) {
    for (const SeenPerson& person : frame) {
      for (const Keypoint& keypoint : person.keypoints) {
        seen += keypoint.confidence > 0;
        unsure += keypoint.confidence > 0 && keypoint.confidence < min_confidence;
      }
    }
  }
  constexpr double kMaxUnsure = 0.25;
  if (static_cast<double>(unsure) > kMaxUnsure * static_cast<double>(seen)) {
    told.Tell(fmt::format("{}: {:.0f} % of the keypoints have a score below {:g} and are not used",
                          entry.filename().string(), 100.0 * static_cast<double>(unsure) / static_cast<double>(seen),
                          min_confidence));
  }
  return std::move(film.frames);
}

/// Maps all keypoints to the rig's pictures, and reports the mappings.
void FitPeople(const RigFile& rig, std::vector<FilmedView>& views, std::vector<SeenPeople>& people,
               double min_confidence, MessageLog& told_lines) {
  std::vector<PictureOfFilm> films;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const FilmedView& view = views[i];
    films.push_back(
        {view.camera.camera, view.fit, {view.facts.width, view.facts.height}, std::move(people[i]), view.is_sized});
    names.push_back(view.camera.name);
  }
  // Find out whether films were exchanged between cameras.
  SessionGuess session = GuessSession(films, names, rig.R_WF, min_confidence);
  if (!session.mended.empty()) told_lines.Tell("corrected: " + session.mended);
  if (!session.doubt.empty()) told_lines.Tell("doubtful: " + session.doubt);
  for (std::size_t i = 0; i < views.size(); ++i) {
    films[i] = Turned(std::move(films[i]), session.turns);
    films[i].camera = views[i].camera.camera = session.cameras[i];
    films[i].people = people[i] = std::move(session.people[i]);
    // The keypoints' pictures and the film's are the same, unless only one of them is turned by 90°.
    if (session.turns % 2 == 0) views[i].fit = session.fits[i];
  }
  // Find each film's rotation, scale and shift, and apply these to the keypoints.
  std::vector<PictureGuess> guesses;
  if (session.doubt.empty()) {
    guesses = GuessPictures(films, min_confidence);
  } else {
    for (const PixelFit& fit : session.fits) guesses.push_back({fit, ""});
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    FilmedView& view = views[i];
    const PictureGuess& guess = guesses[i];
    std::string told = guess.told;
    if (told.empty() && view.fit.quarter_turns != 0 && session.turns == 0) {
      told = fmt::format("pictures turned by {}° clockwise, {}", 90 * view.fit.quarter_turns,
                         view.facts.turned % 2 != 0 ? "as the film states" : "as their size suggests");
    }
    if (!told.empty()) told_lines.Tell(fmt::format("{}: {}", view.camera.name, told));
    for (auto& frame : people[i]) {
      for (SeenPerson& person : frame) {
        for (Keypoint& keypoint : person.keypoints) keypoint.pixel = guess.fit.ToRig(keypoint.pixel);
      }
    }
    // If the keypoints' pictures were scaled differently from the film, the keypoints do not show how the film itself
    // was scaled.
    const bool is_films_own = guess.fit.scale == view.fit.scale && guess.fit.shift == view.fit.shift;
    if (is_films_own && session.turns % 2 == 0) view.fit = guess.fit;
  }
}

constexpr double kMsPerSecond = 1000;

/// Estimates the films' clocks within the range of --sync, and reports the clocks.
void Synchronise(const CaptureFilmsOptions& options, const std::vector<FilmedView>& views,
                 const RecoverPersonOptions& recover, SeenFilms& films) {
  const double rate = recover.rate_hz;
  std::size_t shortest = films.people.front().size();
  for (const SeenPeople& people : films.people) shortest = std::min(shortest, people.size());
  // Limit the search to half the length of a film, because at larger delays the films share too few frames.
  const int max_frames =
      std::clamp(static_cast<int>(std::lround(options.sync_s * rate)), 1, std::max(1, static_cast<int>(shortest / 2)));
  const SyncOptions clocks{.max_frames = max_frames, .max_px = recover.triangulate.robust.outlier_px};
  const std::vector<ClockOffset> found = EstimateOffsets(films.cameras, films.people, {clocks, recover.match.follow});
  // Report each clock, and the cameras whose clock the keypoints do not determine.
  std::string untold, told;
  for (std::size_t i = 0; i < views.size(); ++i) {
    films.clocks[i].offset = found[i].frames;
    if (!found[i].is_told) {
      untold += (untold.empty() ? "" : ", ") + views[i].camera.name;
    } else if (told.empty()) {
      told = fmt::format("delays relative to {}:", views[i].camera.name);
    } else {
      told += fmt::format("{} {} {:+.2f} frames ({:+.0f} ms)", told.ends_with(':') ? "" : ",", views[i].camera.name,
                          films.clocks[i].offset, kMsPerSecond * films.clocks[i].offset / rate);
    }
  }
  if (!told.ends_with(':')) films.told.Tell(told);
  if (untold.empty()) return;
  films.told.Tell(
      fmt::format("the keypoints do not determine the delay of {}, so Etude assumes no delay. Possible causes: people "
                  "hardly move; the delay is more than --sync {:g}; a camera's pose differs from the rig",
                  untold, options.sync_s));
}

/// Sets the clocks from the films' frame rates, and reports rates that differ.
void ClocksOfRates(const std::vector<FilmedView>& views, SeenFilms& films) {
  const double rate = views.front().facts.rate_hz;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const double own = views[i].facts.rate_hz;
    if (own == rate) continue;
    const bool is_one = std::abs(own - rate) <= kSameRateTolerance * rate;
    if (!is_one) films.clocks[i].drift = rate / own - 1;
    films.told.Tell(fmt::format("{}: the film has {:g} frames per second, but the first film has {:g}; {}",
                                views[i].camera.name, own, rate,
                                is_one ? "Etude assumes that both have the same rate"
                                       : "Etude resamples the keypoints by cubic interpolation"));
  }
}

/// Returns a camera's name in front of "'s": with more than two cameras, a delay is one against all others.
std::string OthersOf(const std::vector<FilmedView>& views) {
  return views.size() > 2 ? "the other cameras" : views.front().camera.name;
}

/// Reports the films whose keypoints fit the other films' at no delay, although the other films agree with each other.
void WarnOfMisfits(const std::vector<FilmedView>& views, const std::vector<ClockOffset>& found, int max_frames,
                   double rate_hz, SeenFilms& films) {
  double most = 0;  // the largest misfit of the films that agree, squared pixels
  for (const ClockOffset& clock : found) {
    if (clock.is_told) most = std::max(most, clock.misfit);
  }
  constexpr double kMinPx = 1, kMuchMore = 4;
  for (std::size_t i = 0; most > 0 && i < views.size(); ++i) {
    if (found[i].is_told || found[i].misfit < kMuchMore * std::max(kMinPx, most)) continue;
    films.told.Tell(
        fmt::format("doubtful: {}: the keypoints do not fit the keypoints of {} with any delay up to {} frames. Use "
                    "--sync {:.1f} to search larger delays, or check the camera's pose in the rig",
                    views[i].camera.name, OthersOf(views), max_frames, std::ceil(4 * max_frames / rate_hz)));
  }
}

/// Reports films that seem delayed although the keypoints are too noisy to correct the delay.
void WarnOfDelays(const std::vector<FilmedView>& views, const RecoverPersonOptions& recover, int max_frames,
                 SeenFilms& films) {
  const SyncOptions clocks{.max_frames = max_frames, .max_px = recover.triangulate.robust.outlier_px};
  const auto guessed = EstimateOffsets(films.cameras, films.people, {clocks, recover.match.follow});
  WarnOfMisfits(views, guessed, max_frames, recover.rate_hz, films);
  // Name a film that differs from most of the others. If there are only two films, name the second one.
  std::vector<double> offsets;
  for (const ClockOffset& clock : guessed) {
    if (clock.is_told) offsets.push_back(clock.frames);
  }
  const double usual = offsets.size() > 2 ? UpperMedian(offsets) : 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const double frames = guessed[i].frames - usual;
    if (!guessed[i].is_told || std::abs(frames) < 1) continue;
    films.told.Tell(
        fmt::format("doubtful: {}: the film seems to be {:.1f} frames {} than {}; use --sync {:.1f} to correct this",
                    views[i].camera.name, std::abs(frames), frames > 0 ? "later" : "earlier", OthersOf(views),
                    std::ceil(10 * (std::abs(frames) + 2) / recover.rate_hz) / 10));
  }
}

/// Reports clocks that drift although every film has one delay.
void WarnOfDrifts(const std::vector<FilmedView>& views, const RecoverPersonOptions& recover, SeenFilms& films) {
  constexpr double kMaxSeconds = 0.3;  // the films are synchronised, apart from drifts
  const int max_frames = std::max(2, static_cast<int>(std::lround(kMaxSeconds * recover.rate_hz)));
  const SyncOptions clocks{.max_frames = max_frames, .max_px = recover.triangulate.robust.outlier_px};
  const double half = 0.5 * static_cast<double>(films.people.front().size());
  for (const ClockDrift& drift : FindDrifts(films.cameras, films.people, {clocks, recover.match.follow})) {
    films.told.Tell(fmt::format(
        "doubtful: {}: the clock of this film drifts. Compared with {}, its delay is {:.1f} frames {} in the second "
        "half of the film than in the first half, as if the frame rate were {:.2f} Hz instead of {:g} Hz. Not "
        "corrected (residual {:.2f} px with one delay, {:.2f} px with a delay for each quarter)",
        views[drift.film].camera.name, OthersOf(views), std::abs(drift.frames), drift.frames > 0 ? "later" : "earlier",
        recover.rate_hz / (1 + drift.frames / half), recover.rate_hz, drift.constant_px, drift.changing_px));
  }
}

/// Reports the clock drift that a film's keypoints show, if the film's rate was assumed to equal the first film's rate
/// although the two files state different rates.
void TellDrift(const std::vector<FilmedView>& views, std::size_t film, const FilmClock& taken, const FilmClock& nearest,
               std::size_t frames, SeenFilms& films) {
  const double rate = views.front().facts.rate_hz, own = views[film].facts.rate_hz;
  if (own == rate || std::abs(own - rate) > kSameRateTolerance * rate) return;
  const auto over_film = [&](double drift) { return drift * static_cast<double>(frames); };
  films.told.Tell(
      fmt::format("{}: the measured clock drift is {:+.2f} frames over the film, but the frame rates of the files give "
                  "{:+.2f} frames. The evidence is too weak for a correction",
                  views[film].camera.name, over_film(nearest.drift - taken.drift), over_film(rate / own - 1)));
}

/// Corrects clocks that contradict the keypoints.
void CorrectClocks(const std::vector<FilmedView>& views, const RecoverPersonOptions& recover, bool is_set,
                SeenFilms& films) {
  const double rate = recover.rate_hz;
  const std::size_t frames = films.people.front().size();
  // Search half a second around the clocks, or only one frame if --sync has set the clocks.
  constexpr double kMaxSeconds = 0.5;
  const int max_frames = is_set ? 1
                          : std::clamp(static_cast<int>(std::lround(kMaxSeconds * rate)), 1,
                                       std::max(1, static_cast<int>(frames / 4)));
  const auto found = FindClocks(films.cameras, films.people, films.clocks, max_frames, recover.match.follow);
  const bool has_own_rates = std::ranges::any_of(films.clocks, [](const FilmClock& clock) { return clock.drift != 0; });
  const bool is_any_mended = std::ranges::any_of(found, &FoundClock::is_mended);
  if (!is_set && !is_any_mended && !has_own_rates) WarnOfDelays(views, recover, max_frames, films);
  // Report the delay in the middle of the film, and the drift over the film's length.
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!found[i].is_mended) TellDrift(views, i, films.clocks[i], found[i].nearest, frames, films);
    if (!found[i].is_mended) continue;
    const FilmClock before = films.clocks[i], now = found[i].clock;
    films.clocks[i] = now;
    const double half = 0.5 * static_cast<double>(frames);
    const double late = now.offset - before.offset + (now.drift - before.drift) * half;
    const double drift = (now.drift - before.drift) * static_cast<double>(frames);
    std::string told =
        fmt::format("the film is {:.2f} frames ({:.0f} ms) {} than {}", std::abs(late),
                    kMsPerSecond * std::abs(late) / rate, late > 0 ? "later" : "earlier", views.front().camera.name);
    constexpr double kHardly = 0.02;
    if (std::abs(drift) > kHardly) {
      told += fmt::format(
          " in the middle of the film, and its frame rate is {:.4f} Hz, which adds {:.2f} frames of delay over the "
          "film",
          rate / (1 + now.drift), std::abs(drift));
    }
    films.told.Tell(fmt::format("{}: {}; corrected (loss {:.2f} to {:.3f})", views[i].camera.name, told,
                                found[i].before, found[i].after));
  }
}

}  // namespace

std::string FramesText(const std::vector<std::size_t>& frames) {
  std::string text;
  constexpr std::size_t kMaxRanges = 12;
  std::size_t ranges = 0;
  for (std::size_t i = 0; i < frames.size(); ++ranges) {
    std::size_t j = i;
    while (j + 1 < frames.size() && frames[j + 1] == frames[j] + 1) ++j;
    if (ranges == kMaxRanges) return text + fmt::format(", … ({} in all)", frames.size());
    text += text.empty() ? "" : ", ";
    text += i == j ? fmt::format("{}", frames[i] + 1) : fmt::format("{} to {}", frames[i] + 1, frames[j] + 1);
    i = j + 1;
  }
  return text;
}

Result<SeenFilms> SeeFilms(const CaptureFilmsOptions& options, const RecoverPersonOptions& recover,
                           FilmedSession& session) {
  std::vector<FilmedView>& views = session.views;
  SeenFilms films{.cameras = {}, .people = {}, .clocks = {}, .told = {options.listener.print}};
  for (const std::string& line : session.told) films.told.Tell(line);
  films.clocks.resize(views.size());
  // Read the keypoints, map them to the rig's pictures and remove the lens distortion.
  ASSIGN_OR_RETURN(std::vector<PeopleOfFilm> read, ReadFilms(options, views));
  for (std::size_t i = 0; i < views.size(); ++i) {
    FilmedView& view = views[i];
    ASSIGN_OR_RETURN(SeenPeople people,
                     TakePeople(options, std::move(read[i]), view, recover.triangulate.min_confidence, films.told));
    if (!view.facts.pictures.empty()) people = PeopleAt(people, view.facts.pictures, recover.match.follow);
    films.people.push_back(std::move(people));
  }
  FitPeople(session.rig, views, films.people, recover.triangulate.min_confidence, films.told);
  for (const std::string& doubt : DoubtsOnCameras(views)) films.told.Tell(doubt);
  for (std::size_t i = 0; i < views.size(); ++i) {
    films.people[i] = UndistortPeople(views[i].camera.camera, std::move(films.people[i]));
    films.cameras.push_back(MatrixOf(views[i].camera.camera));
  }
  // Set the clocks: from frame rates, from --sync, and from the keypoints themselves.
  ClocksOfRates(views, films);
  if (options.sync_s > 0) Synchronise(options, views, recover, films);
  CorrectClocks(views, recover, options.sync_s > 0, films);
  // Resample all keypoints at the times of the first film's frames.
  const std::size_t frames = films.people.front().size();
  for (std::size_t i = 0; i < views.size(); ++i) {
    films.people[i] = PeopleInTime(films.people[i], films.clocks[i], frames, recover.match.follow);
  }
  WarnOfDrifts(views, recover, films);
  return films;
}

constexpr Named<PersonCorrection::Kind> kCorrections[] = {
    {"left and right were exchanged", PersonCorrection::Kind::kSwappedSides},
    {"left and right of face and arms were exchanged", PersonCorrection::Kind::kSwappedArms},
    {"left and right of hips and legs were exchanged", PersonCorrection::Kind::kSwappedLegs},
    {"keypoints of another person were replaced by the person's own", PersonCorrection::Kind::kOtherPerson},
    {"keypoints of another person were left out", PersonCorrection::Kind::kNobody}};

void TellCorrections(const RecoveredPerson& person, std::size_t chosen, const std::vector<FilmedView>& views,
                     MessageLog& told) {
  // Report films in which nobody matches the person.
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto is_seen = [](const auto& seen) { return seen.has_value(); };
    if (std::ranges::any_of(person.people[chosen].seen[i], is_seen)) continue;
    told.Tell(
        fmt::format("doubtful: {}: nobody in this film fits the person in the other films, so the film was left out. "
                    "Check the film, and the film's camera in the rig",
                    views[i].camera.name));
  }
  // Report repairs: exchanged sides and exchanged people.
  for (const PersonCorrection& correction : person.corrections) {
    told.Tell(fmt::format("corrected: {}: {}, frames {}", views[correction.camera].camera.name,
                          NameOfValue(kCorrections, correction.kind), FramesText(correction.frames)));
  }
  // Report cameras that disagree with the others, and large triangulation errors.
  constexpr double kDoubtful = 0.1;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (person.report.rejected[i] <= kDoubtful) continue;
    told.Tell(fmt::format(
        "doubtful: {}: {:.0f} % of this camera's keypoints disagree with the keypoints of the other cameras",
        views[i].camera.name, 100 * person.report.rejected[i]));
  }
  constexpr double kDoubtfulError = 0.03;
  for (const MatchedPerson& one : person.people) {
    if (one.cameras < 2 || one.error <= kDoubtfulError) continue;
    told.Tell(
        fmt::format("doubtful: the median distance between rays is {:.1f} % of a person's height; with usual pose "
                    "estimators, it is 1 to 2 %",
                    100 * one.error));
    break;
  }
}

}  // namespace etude
