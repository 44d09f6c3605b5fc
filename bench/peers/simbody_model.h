#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

namespace etude {

struct SimbodySettings {
  double accuracy = 1e-5;      ///< accuracy of the optimiser; smaller values change nothing
  double position_weight = 3;  ///< weight of a square metre relative to a square radian
};

/// Simbody's model of a kinematic tree, with its Assembler. Simbody's headers do not compile as C++20. This class is
/// therefore compiled as C++17, and its interface uses no type of Simbody.
class SimbodyModel {
 public:
  struct Frame {
    glm::dvec3 position{0};
    glm::dmat3 axes{1};
  };
  struct Joint {
    int parent = -1;
    Frame base;  ///< the joint's frame in the parent limb's frame at angle zero; for the root, in the world
    int dof_count = 0;
    double lower[3] = {}, upper[3] = {};
  };
  struct Effector {
    int joint = 0;
    glm::dvec3 offset{0};
  };

  SimbodyModel(const std::vector<Joint>& joints, const std::vector<Effector>& effectors,
               const SimbodySettings& settings);
  ~SimbodyModel();

  /// Returns the effectors' frames by Simbody's forward kinematics. `angles` are in the order of the joints.
  std::vector<Frame> Effectors(const double* angles);
  /// Returns the angles that the Assembler finds from `start`, or the last angles that it tried if it fails.
  std::vector<double> Assemble(const double* start, const std::vector<Frame>& targets);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace etude
