#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/rig_file.h"
#include "engine/keypoints/agreement.h"
#include "engine/keypoints/pixel_fit.h"
#include "engine/keypoints/place_rig.h"
#include "engine/keypoints/recover_person.h"
#include "engine/keypoints/synchronise_people.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"
#include "engine/unmarked/recover_unmarked.h"
#include "io/clips/convert.h"
#include "io/files/json.h"
#include "io/films/decoder.h"
#include "tools/capture/capture_films.h"
#include "tools/capture/capture_page.h"
#include "tools/capture/overlay_film.h"

namespace etude {

/// One film of a session, and the camera of the rig that took it.
struct FilmedView {
  std::filesystem::path path;
  FilmFacts facts;
  NamedCamera camera;
  PixelFit fit;           ///< from the rig's pixels to the film's
  bool is_sized = false;  ///< the file of keypoints names the size of the film's pictures
};

/// The films of a session and the rig that took them, as its file has it.
struct FilmedSession {
  std::vector<FilmedView> views;
  RigFile rig;
  std::vector<std::string> told;  ///< what was found out of rig and films
};

/// Opens the films with their cameras of the rig. Fails for fewer than two, for cameras that are missing or named
/// twice, for sizes that `--fit` does not explain, and without `--sync` for films of different lengths.
Result<FilmedSession> OpenFilms(const CaptureFilmsOptions& options);

/// The cameras and people from which a person is recovered.
struct SeenFilms {
  std::vector<ProjectionMatrix> cameras;  ///< without their lenses, as are the people
  std::vector<SeenPeople> people;         ///< at the first film's times
  std::vector<FilmClock> clocks;          ///< of each film
  ToldLines told;
};

/// Reads the keypoints or marks of all films, finds how they lie in the rig's pictures and in time, and says so.
/// The views learn how their pictures were turned, and whose camera took them.
Result<SeenFilms> SeeFilms(const CaptureFilmsOptions& options, const RecoverPersonOptions& recover,
                           FilmedSession& session);

/// Tells what was mended of a person and what still is doubtful, a line each.
/// @param chosen which of the person's `people`
void TellMends(const RecoveredPerson& person, std::size_t chosen, const std::vector<FilmedView>& views,
               ToldLines& told);

/// Begins the page of `--report` with what any capture tells: its title, what was told, feet, limbs, the command.
CapturePage BeginPage(const CaptureFilmsOptions& options, const BodyMotion& motion, const LimbLengths& lengths,
                      const std::vector<std::string>& told);
/// Says of what was told how much is doubtful.
std::string DoubtsOf(const std::vector<std::string>& told);
/// Puts the overlay film into the page and writes it. False when it was interrupted.
Result<bool> WritePage(const CaptureFilmsOptions& options, CapturePage page, const std::vector<OverlayView>& overlays,
                       const BodyMotion& motion);
/// Measures how much body and outlines are apart in each camera, per cent.
CameraResiduals ResidualsOfOutlines(const std::vector<FilmedView>& views, const UnmarkedMotion& person);
/// The median over cameras and frames.
double MedianOf(const CameraResiduals& residuals);
/// Writes the page of a capture from keypoints or marks.
/// @param views whose cameras are placed
/// @param chosen which of the person's `people`
/// @param both what outlines beside them told, null where they were not asked
Result<bool> WriteReport(const CaptureFilmsOptions& options, const std::vector<FilmedView>& views,
                         const RecoveredPerson& person, std::size_t chosen, const SeenFilms& films,
                         const UnmarkedMotion* both);

/// Gives the films with what is drawn over them.
std::vector<OverlayView> OverlaysOf(const std::vector<FilmedView>& views, const RecoveredPerson& person,
                                    std::size_t chosen, const std::vector<FilmClock>& clocks);

/// Writes the film of `--film`. False when it was interrupted.
Result<bool> WriteFilm(const CaptureFilmsOptions& options, const std::vector<OverlayView>& overlays,
                       const BodyMotion& motion);

/// Writes a clip, and the same as twenty joints, to `options.output` in the format that its name tells.
Result<void> WriteMotion(const CaptureFilmsOptions& options, Clip clip, const BodyMotion& motion);

constexpr char kLost = '!';

/// A column of the table that compares with a reference: how near some of the cameras come to it.
struct ComparedColumn {
  std::string heading;  ///< the cameras, and `kLost` where they gave no motion
  std::vector<MarkerAgreement> markers;
  MarkerAgreement all;
};
ComparedColumn CompareColumn(std::string heading, const MarkerMotion& markers, const MarkerMotion& reference);

/// Sets the reference in time with a motion where its rate is another one but taken for the same: measures how both
/// drift apart, says it, and undoes it where that halves the share of distances that are far. Says where one is longer.
MarkerMotion InTimeWith(const MarkerMotion& motion, MarkerMotion reference, ToldLines& told);

/// Tells medians, a row for each marker of the first column and one for all, and their 95th percentile, under `words`,
/// which say what they are; writes the file of `--distances`, if there shall be one.
Result<void> TellColumns(const std::string& words, const std::vector<ComparedColumn>& columns,
                         const std::vector<FilmedView>& views, const CaptureFilmsOptions& options);

/// Two of the films, with the heading of their column.
struct CameraPair {
  std::size_t first = 0, second = 0;
  std::string heading;
};
/// Gives every two of more than two films; of two there is nothing to compare.
std::vector<CameraPair> PairsOf(std::size_t films);

/// The pictures of all films, small and without their lenses, at the first film's moments.
struct ReducedTake {
  std::vector<Camera> cameras;
  std::vector<double> reductions;  ///< pixels of these pictures in one of the rig's camera
  std::vector<std::vector<ColourImage>> pictures;
  std::vector<ColourImage> rooms;
};
Result<ReducedTake> ReadTake(const CaptureFilmsOptions& options, const std::vector<FilmedView>& views,
                             const std::vector<FilmClock>& clocks);
ReducedTake PairOf(const ReducedTake& take, const CameraPair& pair);

/// Holds what keypoints tell beside outlines, if anything: where the person is seen, by the take's cameras, and limb
/// lengths.
struct SeenBeside {
  const MatchedPerson* person = nullptr;
  std::optional<LimbLengths> lengths = {};
};
Result<UnmarkedMotion> RecoverByOutlines(const ReducedTake& take, const CaptureFilmsOptions& options, double rate_hz,
                                         const SeenBeside& beside = {});

/// Gives the joints of a reference, by their own names, or as an estimator's landmarks show them; joints that landmarks
/// leave to rules of thumb are left out.
MarkerMotion JointsOfReference(const MarkerMotion& reference);

/// Captures from keypoints or marks, or from the films alone: then the motion of the only person who moves in them, by
/// outlines. With `options.silhouettes` keypoints are what outlines are followed with. Compares it with `reference`, if
/// there is one, and adds what was found to `facts`. False when it was interrupted.
Result<bool> CaptureKeypoints(const CaptureFilmsOptions& options, FilmedSession session,
                              const std::optional<MarkerMotion>& reference, Json& facts);
Result<bool> CaptureUnmarked(const CaptureFilmsOptions& options, const FilmedSession& session,
                             const std::optional<MarkerMotion>& reference, Json& facts);

}  // namespace etude
