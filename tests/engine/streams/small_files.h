#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "engine/motion/body.h"

namespace etude::testing {

/// Returns a person at the origin who faces +Z with the arms out, 1.7 m tall, toes on the floor; the left hand is
/// `raised` m higher.
inline BodyPose StandingPose(double raised = 0) {
  using enum Role;
  BodyPose pose;
  const auto put = [&](Role role, double x, double y, double z) { pose[role] = glm::dvec3(x, y, z); };
  put(kHipCentre, 0, 0.95, 0), put(kSpine, 0, 1.15, 0), put(kShoulderCentre, 0, 1.42, 0), put(kHead, 0, 1.65, 0);
  put(kLeftShoulder, 0.18, 1.4, 0), put(kLeftElbow, 0.46, 1.4, 0), put(kLeftWrist, 0.7, 1.4, 0);
  put(kLeftHand, 0.8, 1.4 + raised, 0);
  put(kLeftHip, 0.09, 0.9, 0), put(kLeftKnee, 0.1, 0.48, 0), put(kLeftAnkle, 0.1, 0.08, 0);
  put(kLeftFoot, 0.11, 0, 0.15);
  for (const Role left : {kLeftShoulder, kLeftElbow, kLeftWrist, kLeftHand, kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot})
    pose[Mirrored(left)] = pose[left] * glm::dvec3(-1, 1, 1);
  pose[kRightHand].y = 1.4;
  return pose;
}

/// Returns a motion in which the left hand goes up and down once in two seconds.
inline BodyMotion WavingMotion(int frames = 60, double rate_hz = 30) {
  BodyMotion motion{.rate_hz = rate_hz, .poses = {}};
  for (int t = 0; t < frames; ++t) motion.poses.push_back(StandingPose(0.3 * std::sin(3.14159 * t / rate_hz)));
  return motion;
}

/// Returns a position in the Kinect SDK's axes (X to the sensor's left, Y up, Z away from the sensor), for a sensor 1 m
/// high and 3 m in front of the person, tilted down by `tilt` radians.
inline glm::dvec3 KinectSpace(const glm::dvec3& world, double tilt = 0) {
  const glm::dvec3 level(-world.x, world.y - 1, 3 - world.z);
  const double c = std::cos(tilt), s = std::sin(tilt);
  return {level.x, c * level.y + s * level.z, -s * level.y + c * level.z};
}

/// Returns the rows of a Kinect v1; `fourth`, if not "", follows each position.
inline std::string KinectV1Text(const BodyMotion& motion, const std::string& fourth = "", double tilt = 0) {
  std::string text;
  for (const BodyPose& pose : motion.poses) {
    for (const glm::dvec3& joint : pose.joints) {
      const glm::dvec3 p = KinectSpace(joint, tilt);
      text += fmt::format("{} {} {} {} ", p.x, p.y, p.z, fourth);
    }
    text += '\n';
  }
  return text;
}

/// Returns the rows with times in front: `first`, then `step` more per row.
inline std::string WithClock(const std::string& rows, double first, double step) {
  std::string text;
  int row = 0;
  for (std::size_t at = 0; at < rows.size();) {
    const std::size_t end = rows.find('\n', at);
    text += fmt::format("{} {}\n", first + step * row++, rows.substr(at, end - at));
    at = end + 1;
  }
  return text;
}

/// Returns a Kinect v2's joints in its SDK's order: a Kinect v1's, and neck, shoulder centre, hand tips, thumbs.
inline std::vector<glm::dvec3> KinectV2Joints(const BodyPose& pose) {
  using enum Role;
  std::vector<glm::dvec3> joints;
  for (const Role role :
       {kHipCentre, kSpine,         kShoulderCentre, kHead,       kLeftShoulder, kLeftElbow, kLeftWrist,
        kLeftHand,  kRightShoulder, kRightElbow,     kRightWrist, kRightHand,    kLeftHip,   kLeftKnee,
        kLeftAnkle, kLeftFoot,      kRightHip,       kRightKnee,  kRightAnkle,   kRightFoot, kShoulderCentre,
        kLeftHand,  kLeftHand,      kRightHand,      kRightHand}) {
    joints.push_back(KinectSpace(pose[role]));
  }
  joints[2] += glm::dvec3(0, 0.05, 0);  // the neck is not the shoulder centre
  return joints;
}

/// Returns the rows of a Kinect v2 with `unit` units per metre; `rest` follows each position.
inline std::string KinectV2Text(const BodyMotion& motion, const std::string& rest, double unit = 1) {
  std::string text;
  for (const BodyPose& pose : motion.poses) {
    for (const glm::dvec3& p : KinectV2Joints(pose))
      text += fmt::format("{} {} {}{} ", unit * p.x, unit * p.y, unit * p.z, rest);
    text += '\n';
  }
  return text;
}

/// Returns NTU's text with one body, except in the frame `without`; every joint has the tracking state `state`.
inline std::string NtuText(const BodyMotion& motion, int state = 2, std::size_t without = 1000000) {
  std::string text = fmt::format("{}\n", motion.poses.size());
  for (std::size_t t = 0; t < motion.poses.size(); ++t) {
    text += t == without ? "0\n" : "1\n";
    if (t == without) continue;
    text += "72057594037931101 0 1 1 1 1 0 0.02764709 0.05745083 2\n25\n";
    for (const glm::dvec3& p : KinectV2Joints(motion.poses[t]))
      text += fmt::format("{} {} {} 277.4 191.9 1036.4 519.1 -0.2 0.04 0.97 -0.08 {}\n", p.x, p.y, p.z, state);
  }
  return text;
}

/// Returns output of the Azure Kinect's offline processor: millimetres, X to the camera's right, Y down, Z forward.
inline std::string AzureText(const BodyMotion& motion, const std::string& confidence = "") {
  using enum Role;
  constexpr int kRoleOfJoint[32] = {0,  1,  2,  2,  4,  4,  5,  6,  7,  7,  7, 8, 8, 9, 10, 11,
                                    11, 11, 12, 13, 14, 15, 16, 17, 18, 19, 3, 3, 3, 3, 3,  3};
  std::string frames;
  for (std::size_t t = 0; t < motion.poses.size(); ++t) {
    std::string joints, confidences;
    for (const int role : kRoleOfJoint) {
      const glm::dvec3 p = motion.poses[t].joints[static_cast<std::size_t>(role)];
      joints += fmt::format("{}[{},{},{}]", joints.empty() ? "" : ",", 1000 * p.x, -1000 * (p.y - 1), 1000 * (3 - p.z));
      confidences += (confidences.empty() ? "" : ",") + confidence;
    }
    const std::string levels = confidence.empty() ? "" : fmt::format(",\"confidence_level\":[{}]", confidences);
    frames += fmt::format(R"({}{{"timestamp_usec":{},"frame_id":{},"num_bodies":1,"bodies":[{{"body_id":1,)"
                          R"("joint_positions":[{}]{}}}]}})",
                          t == 0 ? "" : ",", 1000000 + static_cast<long>(t * 1e6 / motion.rate_hz), t, joints, levels);
  }
  return "{\"joint_names\":[],\"frames\":[" + frames + "]}";
}

}  // namespace etude::testing
