#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// Nine vectors: where feet and hands are, how fast they move, and how fast the hips move.
constexpr std::size_t kMotionFeatureCount = 27;
/// What motion matching compares (Clavet 2016; Holden et al. 2020): hands and feet as seen from the character, who is
/// at the origin of the floor and faces +Z, and the velocities of hands, feet and hips in the same axes.
using MotionFeatures = std::array<double, kMotionFeatureCount>;

/// The features of every frame of every clip. Each of the nine vectors is divided by its own standard deviation over
/// all frames of the library, so that metres and metres per second count alike; one that never varies counts nothing.
std::vector<std::vector<MotionFeatures>> ComputeMotionFeatures(std::span<const BodyMotion> clips);

}  // namespace etude
