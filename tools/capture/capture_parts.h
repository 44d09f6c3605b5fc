#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/rig_file.h"
#include "engine/keypoints/agreement.h"
#include "engine/keypoints/pixel_fit.h"
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

/// One film of a session and the rig's camera that took it.
struct FilmedView {
  std::filesystem::path path;
  FilmFacts facts;
  NamedCamera camera;
  PixelFit fit;           ///< maps the rig's pixels to the film's pixels
  bool is_sized = false;  ///< true if the keypoint file states the size of the film's pictures
};

/// The films of a session and the rig that took them, in the rig file's coordinates.
struct FilmedSession {
  std::vector<FilmedView> views;
  RigFile rig;
  std::vector<std::string> told;  ///< messages about the rig and the films
};

/// Returns ranges of frames, counted from 1: "3 to 20, 25".
std::string FramesText(const std::vector<std::size_t>& frames);

/// Opens the films and assigns a camera of the rig to each. Fails if there are fewer than two films, if a camera is
/// missing or named twice, if `--fit` does not explain the size of the pictures, and, without `--sync`, if the films'
/// lengths differ by more than 1.5 frames.
Result<FilmedSession> OpenFilms(const CaptureFilmsOptions& options);

/// Returns the lines "doubtful: …" about the cameras of the films (RigDoubts).
std::vector<std::string> DoubtsOnCameras(const std::vector<FilmedView>& views);

/// The cameras and the keypoints from which a person is recovered.
struct SeenFilms {
  std::vector<ProjectionMatrix> cameras;  ///< cameras without lens distortion, because the keypoints have none
  std::vector<SeenPeople> people;         ///< people at the times of the first film's frames
  std::vector<FilmClock> clocks;          ///< the clock of each film
  MessageLog told;
};

/// Reads the keypoints or marks of all films, maps them to the rig's pictures and to a common time, and reports these
/// mappings. Sets in `session` the rotation of each film's pictures and the camera that really took each film.
Result<SeenFilms> SeeFilms(const CaptureFilmsOptions& options, const RecoverPersonOptions& recover,
                           FilmedSession& session);

/// Reports repairs of a person's keypoints and remaining doubts, one line each.
/// @param chosen index, into the person's `people`, of the captured person
void TellCorrections(const RecoveredPerson& person, std::size_t chosen, const std::vector<FilmedView>& views,
                     MessageLog& told);

/// Returns the names and values, metres, of the limb lengths that reports show.
std::vector<std::pair<std::string, double>> ShownLengths(const LimbLengths& lengths);

/// Begins the page of `--report` with the parts that every capture has: title, messages, feet, limb lengths and
/// command.
CapturePage BeginPage(const CaptureFilmsOptions& options, const BodyMotion& motion, const LimbLengths& lengths,
                      const std::vector<std::string>& told);
/// Returns a phrase with the number of lines in `told` that begin with "doubtful".
std::string DoubtsOf(const std::vector<std::string>& told);
/// Writes the film to the file of `--film`, if this option is given, and writes the page. The page contains the film,
/// even without `--film`, if the film has at most 16 MB. Returns false if Ctrl-C interrupted the film.
Result<bool> WritePage(const CaptureFilmsOptions& options, CapturePage page, const std::vector<OverlayView>& overlays,
                       const BodyMotion& motion);
/// Measures the difference between body and silhouette in each camera, per cent.
CameraResiduals ResidualsOfOutlines(const std::vector<FilmedView>& views, const UnmarkedMotion& person);
/// Returns the median over cameras and frames; 100 if there is no value.
double MedianOf(const CameraResiduals& residuals);
/// Returns "body and outlines differ by 7 % in the median".
std::string OutlinesText(const std::vector<FilmedView>& views, const UnmarkedMotion& person);
/// Writes the page of a capture from keypoints or marks.
/// @param views the films, with cameras in world coordinates
/// @param chosen index into the person's `people`
/// @param both the motion from silhouettes, or null if silhouettes were not used
Result<bool> WriteReport(const CaptureFilmsOptions& options, const std::vector<FilmedView>& views,
                         const RecoveredPerson& person, std::size_t chosen, const SeenFilms& films,
                         const UnmarkedMotion* both);

/// Returns, for the overlay film, the films and the keypoints that are drawn over them.
std::vector<OverlayView> OverlaysOf(const std::vector<FilmedView>& views, const RecoveredPerson& person,
                                    std::size_t chosen, const std::vector<FilmClock>& clocks);

/// Writes the film of `--film`. Returns false if Ctrl-C interrupted the film.
/// @param middle if not null, receives the middle frame
Result<bool> WriteFilm(const CaptureFilmsOptions& options, const std::vector<OverlayView>& overlays,
                       const BodyMotion& motion, Picture* middle = nullptr);

/// Writes a motion to `options.output` in the format that its extension names: writes `clip` if the format holds a
/// skeleton, else `motion`, which is the same motion as twenty joints.
Result<void> WriteMotion(const CaptureFilmsOptions& options, Clip clip, const BodyMotion& motion);

constexpr char kLost = '!';

/// A column of the comparison table: the distances between the reference and the result from some of the cameras.
struct ComparedColumn {
  std::string heading;  ///< names of the cameras; `kLost` is appended if these cameras gave no motion
  std::vector<MarkerAgreement> markers;
  MarkerAgreement all;
};
ComparedColumn CompareColumn(std::string heading, const MarkerMotion& markers, const MarkerMotion& reference);

/// Synchronises a reference with a motion. Frames of the same number are taken as simultaneous. If the frame rates
/// differ, the drift between the two clocks is measured and reported, and removed if its removal halves the share of
/// large distances. Different lengths are also reported.
MarkerMotion SynchroniseWith(const MarkerMotion& motion, MarkerMotion reference, MessageLog& told);

/// Prints a table under the heading `words`: the medians (one row for each marker of the first column, and one row for
/// all markers) and the 95th percentiles. Writes the file of `--distances` if its name is not "".
Result<void> TellColumns(const std::string& words, const std::vector<ComparedColumn>& columns,
                         const std::vector<FilmedView>& views, const CaptureFilmsOptions& options);

/// A pair of films and the heading of its column.
struct CameraPair {
  std::size_t first = 0, second = 0;
  std::string heading;
};
/// Returns all pairs of films; empty for two films, because the only pair of two films is the whole take.
std::vector<CameraPair> PairsOf(std::size_t films);

/// The pictures of all films, reduced in size and without lens distortion, at the times of the first film's frames.
struct ReducedTake {
  std::vector<Camera> cameras;
  std::vector<double> reductions;  ///< for each film: pixels of the reduced picture per pixel of the rig's camera
  std::vector<std::vector<ColourImage>> pictures;
  std::vector<ColourImage> rooms;
  std::vector<std::vector<Mask>> masks;  ///< masks, used instead of `pictures` if not empty
};
Result<ReducedTake> ReadTake(const CaptureFilmsOptions& options, const std::vector<FilmedView>& views,
                             const std::vector<FilmClock>& clocks, MessageLog& told);
ReducedTake PairOf(const ReducedTake& take, const CameraPair& pair);

/// Findings from keypoints that support the tracking by silhouettes: the person's keypoints, in the take's cameras, and
/// the limb lengths. The keypoints or the lengths may be absent.
struct KeypointSupport {
  const MatchedPerson* person = nullptr;
  std::optional<LimbLengths> lengths = {};
};
Result<UnmarkedMotion> RecoverByOutlines(const ReducedTake& take, const CaptureFilmsOptions& options, double rate_hz,
                                         const KeypointSupport& beside = {});

/// Returns the joints of a reference: the joints that the reference names, or joints computed from an estimator's
/// landmarks. Joints that landmarks determine only by rules of thumb are left out.
MarkerMotion JointsOfReference(const MarkerMotion& reference);

/// `CaptureKeypoints` captures from keypoints or marks. `CaptureUnmarked` captures the only moving person of the films
/// from silhouettes alone. With `options.silhouettes`, keypoints support the silhouettes. Both functions compare the
/// motion with `reference`, if there is one, and add the findings to `facts`. They return false if they were
/// interrupted. If a motion from silhouettes alone is probably wrong, `facts["doubt"]` says why, and the motion is
/// written only if the options accept doubtful motions.
Result<bool> CaptureKeypoints(const CaptureFilmsOptions& options, FilmedSession session,
                              const std::optional<MarkerMotion>& reference, Json& facts);
Result<bool> CaptureUnmarked(const CaptureFilmsOptions& options, const FilmedSession& session,
                             const std::optional<MarkerMotion>& reference, Json& facts);

}  // namespace etude
