#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/drawing/film.h"
#include "reports/films/capture_panel.h"
#include "sim/render/renderer.h"

namespace etude {

/// Draws two moments of a capture as both cameras saw them, with mask and recovered skeleton.
std::vector<Picture> DrawStrip(const CapturePanel& capture, Renderer& renderer);

/// Saves the same moments with colour, depth and labels, as EXR files for other programs.
Result<void> SaveStripPictures(const CapturePanel& capture, Renderer& renderer, const FilePath& folder);

/// Draws every stage of a capture's moments in the layout of paper B's figures 5.3 to 5.14: for each moment and camera
/// the picture, the person cut out of it, the marks, the skeleton with its lengths fixed, and after inverse kinematics;
/// beneath, as in figure 5.15, the whole motion as the cameras saw it, and its skeletons. At most two cameras. Nothing
/// when the recording keeps no moments.
std::optional<Picture> DrawPlate(const CapturePanel& capture, Renderer& renderer);

/// Finds the recorded captures of one world that a film compares: of the typical cell's world (ChooseCell) every method
/// that kept one, in the scenario's order, three at most. Empty when there is none; fails when one cannot be read.
Result<std::vector<CapturePanel>> FindCaptures(const RunData& run, const CastCell& typical);

/// The film of a capture: what two cameras saw of a performer, and, side by side for each method, the true skeleton
/// with the recovered one over it, whose bones tell by colour how far their joints are off.
class CaptureScene : public Scene {
 public:
  /// The most methods that are shown, and the most frames.
  static constexpr std::size_t kMostMethods = 3;
  static constexpr int kLongest = 8 * kFilmRate;

  /// Shows captures of one world, one to kMostMethods; the renderer must outlive the scene.
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
  Camera camera_;  ///< before the skeletons; the width and height are a column's
};

}  // namespace etude
