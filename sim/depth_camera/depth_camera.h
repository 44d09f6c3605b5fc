#pragma once

#include <limits>

#include "engine/base/image.h"
#include "engine/cameras/camera.h"
#include "sim/random/stream.h"
#include "sim/skeleton_sensor/options.h"

namespace etude {

/// Returns a mask that is 1 at pixels of `camera` whose surface the projector's light does not reach. The projector is
/// `baseline_m` to the camera's right (+x of the camera's frame) and has the same viewing direction. A nearer surface
/// in the same row shadows the pixel; the shadow left of an edge is f · b · (1/z_near − 1/z_far) pixels wide. Rows are
/// treated as epipolar planes, which a distorted lens violates slightly. Objects outside the picture cast no shadow.
/// With `baseline_m` 0 there is no shadow.
Mask ProjectorShadow(const DepthImage& depth, const Camera& camera, double baseline_m);

/// The properties of a depth camera and the strengths of its faults.
struct DepthCameraOptions {
  DepthLaw law = DepthLaw::kStructuredLight;  ///< law of σ_z, the deviation of a pixel's depth; includes rounding
  /// The focal length of the sensor's own picture, pixels. Lateral noise and disparity steps are given in these pixels.
  /// In a picture with another focal length, noise and steps have the same size in the world.
  double focal_px = 580;
  /// The distance from the camera to the projector, which is on the camera's right (+x of the camera's frame), metres.
  /// With 0 the light comes from the lens itself: there are no shadows and no depth steps.
  double baseline_m = 0.075;
  double disparity_step_px = 1.0 / 8;  ///< disparities focal_px · baseline_m / z are rounded to multiples of this step
  double near_m = 0.8;
  double far_m = 4.0;
  /// The maximum angle between a surface's normal and the line of sight at which depth is measured, radians.
  double largest_angle = 1.396;

  // Strengths, each ≥ 0: 1 is the sensor's value, and 0 switches the fault off.
  double axial_noise = 1;    ///< factor on σ_z
  double lateral_noise = 1;  ///< factor on the standard deviation of edge positions, along both axes of the picture
  double steps = 1;          ///< factor on disparity_step_px; 0: depth is not rounded
  double shadows = 1;        ///< factor on the shadows' width
  double range = 1;          ///< factor on the range: no depth is measured below range · near_m or above far_m / range
  double grazing = 1;        ///< at most 1: moves the angle limit from a right angle (0) to largest_angle (1)
};

/// Returns the options of a structured-light camera, Microsoft's first Kinect: 0.8–4.0 m, with `near_mode` 0.4–3.0 m.
DepthCameraOptions KinectV1Depth(bool near_mode = false);
/// Returns the options of a time-of-flight camera, Microsoft's second Kinect: 0.5–4.5 m, without steps and shadows. No
/// source gives the edge noise of this camera; we assume the same number of pixels as for the first Kinect, with a
/// focal length of 365 pixels.
DepthCameraOptions KinectV2Depth();

/// The value of a pixel without a measurement. In true depth images, this value means that there is no surface.
constexpr float kNotMeasured = std::numeric_limits<float>::infinity();

/// Returns the standard deviation σ of an edge's position in the sensor's pixels: 0.8 + 0.035 θ / (π/2 − θ) (Nguyen,
/// Izadi and Lovell 2012). θ is `angle`, between the surface's normal and the line of sight, radians, below π/2.
double LateralDeviationPx(double angle);

/// Simulates the image of a depth camera from the true depths that `camera` (lens included) sees. Both images have the
/// camera's size and hold metres along the viewing axis, or kNotMeasured. The steps of the simulation, in this order,
/// are: remove shadowed pixels and surfaces at grazing angles; shift edges, also the edges of holes, by lateral noise;
/// add axial noise and round to disparity steps; remove depths out of range. With all strengths 0 the result equals
/// `truth` bit for bit. Every pixel uses three random numbers, whatever the options.
DepthImage MeasureDepth(const DepthImage& truth, const Camera& camera, const DepthCameraOptions& options,
                        RandomStream& random);

}  // namespace etude
