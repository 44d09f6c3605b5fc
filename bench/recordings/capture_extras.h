#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/motion/body.h"

namespace etude {

/// The extras of task `capture`: the data of a recording that is needed, in addition to its tracks "truth" and
/// "recovered", to draw the stereo views again. The tracks have 30 Hz; brightness[k] and views[c].masks[k] belong to
/// frame k of the tracks. To show frame k of camera c:
/// 1. Render the truth, dressed in `colours`, in Room{texture_seed, brightness[k], casts_shadows} from views[c].truth.
///    A stage (StagedRoom in sim/stage) adds furniture and moving objects, chooses the clothes, and multiplies the
///    brightness by its flicker.
/// 2. Draw views[c].masks[k] over the picture.
/// 3. Project the recovered joints with MatrixOf(views[c].truth).
///
/// As JSON (the content of `Recording::extras_json`):
///
///     {"format": "etude-capture", "version": 1,
///      "room": {"texture_seed": 7, "casts_shadows": true},
///      "colours": [[r, g, b], …],                          sixteen, by Part: Figure::colours
///      "stage": {"seed": 7, "scene": 0.5, "everyday": false},    the options of sim/stage, and "coded": true
///                                                                  for the suit with coded colours; absent in the
///                                                                  empty studio without this suit
///      "brightness": [1.0, 1.01, …],                       one per frame
///      "cameras": [{"width": 640, "height": 480, "fx": …, "fy": …, "cx": …, "cy": …, "skew": 0,
///                   "R_CW": [nine numbers, row by row], "p_WC": [x, y, z],
///                   "distortion": [k1, k2, p1, p2, k3],        only for a lens with distortion (OpenCV's)
///                   "mask_width": 320, "mask_height": 240,
///                   "still": "/9j/4AAQ…",                      frame n / 2 as JPEG in base64; may be absent
///                   "masks": ["120 14 306 …", …]}, …],         one text per frame, see EncodeMask
///      "moments": [{"frame": 9, "fixed": [[x, y, z], …],          the twenty joints with known limb lengths, before IK
///                   "marks": [[[u, v, u, v, r, g, b], …], …]}],    per camera; absent if none were requested
///      "bvh": "HIERARCHY\n…"}                              the recovered clip as a BVH file's text
struct CaptureExtras {
  struct View {
    Camera truth;                        ///< the true parameters of the camera that took the pictures
    std::vector<Mask> masks;             ///< the segmented person in each frame, at half the pictures' width and height
    std::string still_jpeg_base64 = {};  ///< the picture of the middle frame; "" if it was not kept
  };

  struct Mark {
    glm::dvec2 a{0}, b{0};  ///< end points of the mark, pixels
    Rgb8 colour{};          ///< colour of the marked limb
  };
  /// A frame for which the recording keeps the intermediate results of every processing stage.
  struct Moment {
    std::size_t frame = 0;
    BodyPose fixed;  ///< joint positions after the limbs got their known lengths, before inverse kinematics
    std::vector<std::vector<Mark>> marks;  ///< the marks that were found in each camera's picture
  };

  std::uint64_t texture_seed = 1;
  bool casts_shadows = true;
  std::uint64_t stage_seed = 0;    ///< seed of the furniture and the moving objects (sim/stage); used if `scene` > 0
  double scene = 0;                ///< amount of scenery (sim/stage); 0 = the empty studio
  bool wears_everyday = false;     ///< true: the performer wears everyday clothes (only if `scene` > 0)
  bool wears_coded = false;        ///< true: the performer wears the suit with coded colours
  std::array<Rgb8, 16> colours{};  ///< the performer's colours, indexed by Part
  std::vector<double> brightness;  ///< brightness of the light, one per frame; without flicker
  std::vector<View> views;
  std::vector<Moment> moments;
  std::string bvh;
};

std::string WriteCaptureExtras(const CaptureExtras& extras);
/// Reads the text that WriteCaptureExtras returns. For any other text, fails and names what is missing or wrong.
Result<CaptureExtras> ReadCaptureExtras(std::string_view json);

/// Returns a mask as run lengths in scan order, separated by blanks: the number of 0s, then of 1s, then of 0s, and so
/// on. The last run of 0s is left out, so an empty mask is the empty text.
std::string EncodeMask(const Mask& mask);
Result<Mask> DecodeMask(std::string_view text, int width, int height);

/// Halves a mask's width and height: a pixel is set if at least two of its four source pixels are set.
Mask HalveMask(const Mask& mask);

}  // namespace etude
