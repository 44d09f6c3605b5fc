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

/// The places in the world, metres, of those landmarks that are known.
using LandmarkPlaces = std::array<std::optional<glm::dvec3>, kLandmarkCount>;

struct TriangulateOptions {
  double least_confidence = 0.1;  ///< keypoints below are passed over
  RobustOptions robust;
};

/// The agreement of a person's keypoints with each other.
struct TriangulationReport {
  std::vector<double> rejected;  ///< of each camera, the share of its keypoints that disagreed with the others'
  double residual_px = 0;        ///< median over all points
  double found = 0;              ///< share of frames × landmarks (that are ever seen) that could be triangulated
};

/// Triangulates the person's landmarks in every frame, each from all cameras that agree on it, weighed by their
/// confidence.
/// @param cameras without their lenses, as are the pixels
std::vector<LandmarkPlaces> TriangulatePerson(std::span<const ProjectionMatrix> cameras, const MatchedPerson& person,
                                              const TriangulateOptions& options, TriangulationReport* report = nullptr);

/// Fills gaps of at most `longest_gap` frames straight from the last to the next place of the landmark.
void BridgePoints(std::span<LandmarkPlaces> frames, std::size_t longest_gap);

/// Smooths places by a Gaussian over time that halves the power at `cutoff_hz`; each place is replaced by the weighted
/// mean of those around it. It delays nothing. A cutoff of half the rate or more changes nothing.
void SmoothPoints(std::span<LandmarkPlaces> frames, double rate_hz, double cutoff_hz);

/// Returns the twenty joints as far as landmarks determine them: hips, knees, ankles, shoulders, elbows and wrists are
/// themselves; the shoulder centre is midway between the shoulders, the hip centre between the hips; the head is its
/// top, or else the middle of the ears, or the nose; a foot ends at its big toe. *(Ours)*: without finger tips, a hand
/// goes on from the forearm at 0.72 of its length; without a face, the head goes on from the trunk at half of its
/// length; without toes, a foot is 0.18 m ahead of its ankle and a little down.
RoleVectors JointsOf(const LandmarkPlaces& landmarks);

}  // namespace etude
