#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/clips/convert.h"
#include "bench/files/json.h"
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
#include "reports/capture_page.h"
#include "reports/films/decoder.h"
#include "reports/films/overlay_film.h"

namespace etude {

struct CaptureCommandOptions {
  std::vector<std::string> films;
  std::string rig;                   ///< a calibration: a file or a folder that ReadRigFile or ReadRigPair knows
  PlaceOptions place;                ///< its unit, up axis and floor
  std::string keypoints;             ///< a folder with an entry for each film
  std::string marks;                 ///< likewise, of annotation pictures
  bool silhouettes = false;          ///< the films' outlines tell, alone or beside keypoints
  std::string rooms;                 ///< of silhouettes: a folder with a picture of each film's empty room, "" = none
  double stature_m = 0;              ///< of silhouettes: the person's, 0 = found
  std::string output;                ///< BVH, GLB, TRC or CSV by its ending
  std::string points;                ///< a TRC of the triangulated keypoints, "" = none
  std::string report;                ///< an HTML page of all that was found, "" = none
  std::string film;                  ///< an MP4 of the skeleton over the films, "" = none
  std::string reference;             ///< a TRC to compare the triangulated keypoints with, "" = none
  std::string distances;             ///< a file of these comparisons, "" = none
  std::string layout;                ///< a name of KeypointLayouts(), "" = by the count
  std::string fit = "none";          ///< letterbox, stretch, crop
  std::vector<std::string> cameras;  ///< of the rig, one for each film; empty: by the films' names
  int person = 1;
  std::string poses = "frames";  ///< of keypoints: each by itself, or "bundle": all at once
  double smooth_hz = 0;
  double longest_gap_s = 0.5;
  double outlier_px = 0;  ///< 0: by the residuals, at most 3 % of the picture's longer side
  double sync_s = 0;      ///< the films' clocks may differ by this; 0: they agree
  bool overwrite = false;
  std::string command_line;  ///< what was typed
  bool as_json = false;
};

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
Result<FilmedSession> OpenFilms(const CaptureCommandOptions& options);

/// The cameras and people from which a person is recovered.
struct SeenFilms {
  std::vector<ProjectionMatrix> cameras;  ///< without their lenses, as are the people
  std::vector<SeenPeople> people;         ///< at the first film's times
  std::vector<FilmClock> clocks;          ///< of each film
  std::vector<std::string> told;          ///< the lines that were printed
};

/// Prints a line and keeps it for the page.
void Tell(std::vector<std::string>& told, const std::string& line);

/// Reads the keypoints or marks of all films, finds how they lie in the rig's pictures and in time, and says so.
/// The views learn how their pictures were turned, and whose camera took them.
Result<SeenFilms> SeeFilms(const CaptureCommandOptions& options, const RecoverPersonOptions& recover,
                           FilmedSession& session);

/// Tells what was mended of a person and what still is doubtful, a line each.
/// @param chosen which of the person's `people`
void TellMends(const RecoveredPerson& person, std::size_t chosen, const std::vector<FilmedView>& views,
               std::vector<std::string>& told);

/// Begins the page of `--report` with what any capture tells: its title, what was told, feet, limbs, the command.
CapturePage BeginPage(const CaptureCommandOptions& options, const BodyMotion& motion, const LimbLengths& lengths,
                      const std::vector<std::string>& told);
/// Says of what was told how much is doubtful.
std::string DoubtsOf(const std::vector<std::string>& told);
/// Puts the overlay film into the page and writes it. False when it was interrupted.
Result<bool> WritePage(const CaptureCommandOptions& options, CapturePage page, const std::vector<OverlayView>& overlays,
                       const BodyMotion& motion);
/// Measures how much body and outlines are apart in each camera, per cent.
CameraResiduals ResidualsOfOutlines(const std::vector<FilmedView>& views, const UnmarkedMotion& person);
/// The median over cameras and frames.
double MedianOf(const CameraResiduals& residuals);
/// Writes the page of a capture from keypoints or marks.
/// @param views whose cameras are placed
/// @param chosen which of the person's `people`
/// @param both what outlines beside them told, null where they were not asked
Result<bool> WriteReport(const CaptureCommandOptions& options, const std::vector<FilmedView>& views,
                         const RecoveredPerson& person, std::size_t chosen, const SeenFilms& films,
                         const UnmarkedMotion* both);

/// Gives the films with what is drawn over them.
std::vector<OverlayView> OverlaysOf(const std::vector<FilmedView>& views, const RecoveredPerson& person,
                                    std::size_t chosen, const std::vector<FilmClock>& clocks);

/// Writes the film of `--film`. False when it was interrupted.
Result<bool> WriteFilm(const CaptureCommandOptions& options, const std::vector<OverlayView>& overlays,
                       const BodyMotion& motion);

/// Writes a clip, and the same as twenty joints, in the format that the file's name tells.
Result<void> WriteMotion(const std::string& path, Clip clip, const BodyMotion& motion);

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
MarkerMotion InTimeWith(const MarkerMotion& motion, MarkerMotion reference, std::vector<std::string>& told);

/// Prints medians, a row for each marker of the first column and one for all, and their 95th percentile, under `words`,
/// which say what they are; writes the file of `--distances`, if there shall be one.
Result<void> TellColumns(const std::string& words, const std::vector<ComparedColumn>& columns,
                         const std::vector<FilmedView>& views, const CaptureCommandOptions& options);

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
Result<ReducedTake> ReadTake(const CaptureCommandOptions& options, const std::vector<FilmedView>& views,
                             const std::vector<FilmClock>& clocks);
ReducedTake PairOf(const ReducedTake& take, const CameraPair& pair);

/// Holds what keypoints tell beside outlines, if anything: where the person is seen, by the take's cameras, and limb
/// lengths.
struct SeenBeside {
  const MatchedPerson* person = nullptr;
  std::optional<LimbLengths> lengths = {};
};
Result<UnmarkedMotion> RecoverByOutlines(const ReducedTake& take, const CaptureCommandOptions& options, double rate_hz,
                                         const SeenBeside& beside = {});

/// Gives the joints of a reference, by their own names, or as an estimator's landmarks show them; joints that landmarks
/// leave to rules of thumb are left out.
MarkerMotion JointsOfReference(const MarkerMotion& reference);

/// Captures from keypoints or marks, or from the films alone: then the motion of the only person who moves in them, by
/// outlines. With `options.silhouettes` keypoints are what outlines are followed with. Compares it with `reference`, if
/// there is one, and adds what was found to `facts`. False when it was interrupted.
Result<bool> CaptureKeypoints(const CaptureCommandOptions& options, FilmedSession session,
                              const std::optional<MarkerMotion>& reference, Json& facts);
Result<bool> CaptureUnmarked(const CaptureCommandOptions& options, const FilmedSession& session,
                             const std::optional<MarkerMotion>& reference, Json& facts);

}  // namespace etude
