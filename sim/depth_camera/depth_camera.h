#pragma once

#include <limits>

#include "engine/base/image.h"
#include "engine/cameras/camera.h"
#include "sim/random/stream.h"
#include "sim/skeleton_sensor/options.h"

namespace etude {

/// Returns 1 where what `camera` sees gets no light from a projector `baseline_m` on its right (+x of the camera's
/// frame, same viewing direction): something nearer in the same row lies between. Left of an edge that is f · b ·
/// (1/z_near − 1/z_far) pixels wide. Rows are taken as the planes of projector and camera, which a lens bends a little;
/// what stands outside the picture throws no shadow into it. None with `baseline_m` 0.
Mask ProjectorShadow(const DepthImage& depth, const Camera& camera, double baseline_m);

/// The properties of a depth camera, and the strengths of its faults.
struct DepthCameraOptions {
  DepthLaw law = DepthLaw::kStructuredLight;  ///< σ_z of a pixel, what rounding to steps adds included
  /// The focal length of the sensor's own picture, pixels. Lateral noise and steps are told in those: in a picture of
  /// another focal length they are as large in the world.
  double focal_px = 580;
  /// The distance from the camera to the projector on its right (+x of the camera's frame), metres; 0: the light comes
  /// from the lens itself, nothing is in shadow, and depth has no steps.
  double baseline_m = 0.075;
  double disparity_step_px = 1.0 / 8;  ///< disparities d = focal_px · baseline_m / z are rounded to multiples of it
  double near_m = 0.8;
  double far_m = 4.0;
  /// The angle between a surface's normal and the line of sight beyond which too little light comes back, radians.
  double largest_angle = 1.396;

  // Strengths, each ≥ 0: 1 = as the sensor does, 0 = that fault is absent.
  double axial_noise = 1;    ///< multiplies σ_z
  double lateral_noise = 1;  ///< multiplies the standard deviation of edges, in both directions of the picture
  double steps = 1;          ///< multiplies disparity_step_px
  double shadows = 1;        ///< multiplies the shadows' width
  double range = 1;          ///< nothing is measured nearer than near_m times this or farther than far_m divided by it
  double grazing = 1;        ///< at most 1: how much of the way from a right angle to largest_angle is lost
};

/// Returns the options of a structured-light camera, Microsoft's first Kinect: 0.8–4.0 m, with `near_mode` 0.4–3.0 m.
DepthCameraOptions KinectV1Depth(bool near_mode = false);
/// Returns the options of a time-of-flight camera, Microsoft's second Kinect: 0.5–4.5 m, no steps, no shadows. Its
/// edges are ours: as unsteady as the first one's, in pixels of its own (focal length 365).
DepthCameraOptions KinectV2Depth();

/// The depth where nothing is measured, as where a true depth image shows nothing.
constexpr float kNotMeasured = std::numeric_limits<float>::infinity();

/// Returns σ of an edge in the sensor's pixels, for a surface whose normal is `angle` from the line of sight (radians,
/// below π/2): 0.8 + 0.035 θ / (π/2 − θ) (Nguyen, Izadi and Lovell 2012).
double LateralDeviationPx(double angle);

/// Measures depths as a depth camera would, from the true depths that `camera` (lens included) sees. Both images have
/// the camera's size; metres along the viewing axis, kNotMeasured where nothing is measured. In turn: what the
/// projector does not light and what is seen at a slant is lost; edges, those of holes too, shift by noise; depth gets
/// its noise and its steps; what is out of range is lost. With all strengths 0 the result is `truth`, bit for bit.
/// Three throws a pixel, whatever the options.
DepthImage MeasureDepth(const DepthImage& truth, const Camera& camera, const DepthCameraOptions& options,
                        RandomStream& random);

}  // namespace etude
