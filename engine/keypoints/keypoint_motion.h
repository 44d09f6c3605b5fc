#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/cameras/robust_triangulation.h"
#include "engine/capture/measure_frames.h"
#include "engine/keypoints/match_people.h"

namespace etude {

/// The positions of the known landmarks in the world, metres.
using LandmarkPositions = std::array<std::optional<glm::dvec3>, kLandmarkCount>;

/// Returns the mean of two landmarks; nullopt if one is missing.
std::optional<glm::dvec3> MiddleOf(const LandmarkPositions& places, Landmark a, Landmark b);

struct TriangulateOptions {
  double min_confidence = 0.1;  ///< keypoints of lower confidence are ignored
  RobustOptions robust;
};

struct TriangulationReport {
  std::vector<double> rejected;  ///< for each camera, the share of its keypoints that were outliers
  double residual_px = 0;        ///< median reprojection error over all points
  /// Share of all frames × landmarks that were triangulated; landmarks that are never seen do not count.
  double found = 0;
};

struct TriangulatedLandmark {
  std::size_t frame = 0, landmark = 0;
  std::vector<std::size_t> cameras;  ///< indices of the cameras that see the landmark with enough confidence
  RobustPoint point;
};

/// Triangulates each landmark in each frame from the cameras that see it with enough confidence, weighted by
/// confidence. Landmarks that cannot be triangulated are left out.
std::vector<TriangulatedLandmark> TriangulateLandmarks(std::span<const ProjectionMatrix> cameras,
                                                       const MatchedPerson& person, const TriangulateOptions& options);

/// Triangulates the person's landmarks in every frame, each from the cameras that agree on it, weighted by confidence.
/// @param cameras the cameras of the rig, without lens distortion; all pixels must be undistorted
std::vector<LandmarkPositions> TriangulatePerson(std::span<const ProjectionMatrix> cameras, const MatchedPerson& person,
                                              const TriangulateOptions& options, TriangulationReport* report = nullptr);

/// Fills gaps of at most `max_gap` frames by linear interpolation between the landmark's positions before and after.
void InterpolatePoints(std::span<LandmarkPositions> frames, std::size_t max_gap);

/// Smooths positions over time by a Gaussian filter that passes half of the power at `cutoff_hz`. Each position becomes
/// a weighted mean of the positions around it. The filter has no delay. A cutoff of at least half the rate changes
/// nothing.
void SmoothPoints(std::span<LandmarkPositions> frames, double rate_hz, double cutoff_hz);

/// Returns the positions of all joints that the landmarks determine. Hips, knees, ankles, shoulders, elbows and wrists
/// are landmarks; the shoulder centre is midway between the shoulders, the hip centre between the hips; the head is at
/// its top, else midway between the ears, else at the nose; a foot ends at its big toe. *(Ours)*: without a finger tip,
/// the hand extends the forearm by 0.72 of the forearm's length; without a face, the head extends the trunk by half of
/// the trunk's length; without a toe, the foot ends 0.18 m from its ankle, ahead and a little down.
RoleVectors JointsOf(const LandmarkPositions& landmarks);

}  // namespace etude
