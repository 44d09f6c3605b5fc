#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/drawing/film.h"
#include "reports/films/capture_panel.h"
#include "sim/render/renderer.h"

namespace etude {

/// Draws two frames of a capture as the first two cameras saw these frames, with the segmentation mask and the
/// recovered skeleton over each picture.
std::vector<Picture> DrawStrip(const CapturePanel& capture, Renderer& renderer);

/// Saves the pictures of DrawStrip for other programs, as EXR files with colour, depth and labels.
Result<void> SaveStripPictures(const CapturePanel& capture, Renderer& renderer, const FilePath& folder);

/// Draws all processing stages of a capture's moments (the frames whose intermediate results the recording keeps) in
/// the layout of paper B's figures 5.3 to 5.14. Each moment and camera has a row: the picture, the person cut out of
/// the picture, the marks of the limbs, the skeleton with its bone lengths fixed, and the skeleton after inverse
/// kinematics. The rows below show, as figure 5.15 does, the whole motion in the cameras' pictures and as skeletons. At
/// most two cameras are shown. Returns nullopt if the recording keeps no moments.
std::optional<Picture> DrawPlate(const CapturePanel& capture, Renderer& renderer);

/// Finds the captures that a film compares: at most three captures of the world of `typical` (ChooseCell), one per
/// method, in the scenario's order of methods. The result is empty if that world has no recordings. Fails if a
/// recording cannot be read.
Result<std::vector<CapturePanel>> FindCaptures(const RunData& run, const ShownCell& typical);

/// The film of a capture: the views of two cameras and, for each method, a column with the true skeleton and, over it,
/// the recovered skeleton. The colour of a recovered bone shows the error of the bone's joints.
class CaptureScene : public Scene {
 public:
  /// The maximum numbers of compared methods and of frames.
  static constexpr std::size_t kMaxMethods = 3;
  static constexpr int kLongest = 8 * kFilmRate;

  /// Makes the scene from 1 to kMaxMethods captures of one world. The renderer must outlive the scene.
  CaptureScene(Renderer& renderer, std::vector<CapturePanel> captures);

  int Frames() const override;
  int PosterFrame() const override { return Frames() / 2; }
  std::string Words() const override;
  Canvas Draw(int frame) override;

 private:
  std::string Methods() const;
  void DrawSeen(Canvas& canvas, int frame) const;
  void DrawSkeletons(Canvas& canvas, const CapturePanel& capture, const Box& box, int frame) const;

  Renderer& renderer_;
  const std::vector<CapturePanel> captures_;
  Camera camera_;  ///< the camera in front of the skeletons; the camera's pictures are as large as a column
};

}  // namespace etude
