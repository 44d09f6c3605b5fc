#pragma once

#include <etude/base.h>

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace etude::engine {

/// A frame F in the world W.
struct Frame {
  glm::dvec3 position{0};  ///< p_WF
  glm::dmat3 axes{1};      ///< R_WF, unit columns
};

/// A joint and the rigid limb beyond it. With P the parent's limb, J the axes before the joint turns and L its limb:
/// R_WL = R_WP R_PJ Rx(q₀) Ry(q₁) Rz(q₂), p_WL = p_WP + R_WP p_PJ. A joint with fewer degrees of freedom leaves out the
/// last rotations.
struct Limb {
  std::string name;
  int parent = -1;  ///< parents come before children; −1: the root, which does not rotate
  glm::dvec3 p_PJ{0};
  glm::dmat3 R_PJ{1};
  int dofs = 0;  ///< 0…3
};

/// The free end E of a limb L, for which a target is set.
struct Effector {
  std::string name;
  int limb = 0;
  glm::dvec3 p_LE{0};
};

struct AngleRange {
  double lower = 0, upper = 0;
};

/// A tree of joints, of any shape.
struct Tree {
  std::vector<Limb> limbs;
  std::vector<Effector> effectors;
  std::vector<AngleRange> limits;  ///< of each degree of freedom, joint after joint
};

/// Returns a person of average build: 15 limbs, 29 degrees of freedom with an adult's limits, root at the left toe. The
/// effectors are right foot, left hand, right hand, head.
ETUDE_API Tree AdultBody();

/// A pose of a tree.
struct TreePose {
  Frame root;
  std::vector<double> angles;  ///< one per degree of freedom
};

/// The position and orientation that an effector shall reach.
struct Target {
  Frame frame;
  double position_weight = 1;  ///< 0: the position is unknown
  glm::dvec3 axis_weights{1};  ///< of each axis; (0, 0, 1) where only the limb's direction is known
};

enum class IkStatus {
  kConverged,
  kStalled,      ///< the angles do not change any more, but a goal is not reached
  kUnreachable,  ///< no pose can reach the targets; the angles are those of the nearest pose found
  kIterationLimit,
  kBadInput,  ///< in a batch: this problem is invalid; its angles are zeros
};

struct IkOptions {
  int max_iterations = 200;
  /// Metres; a pose has converged when every effector is nearer than this, ….
  double position_goal = 0.001;
  double axis_goal = 0.0017453292519943296;  ///< … and each of its axes deviates by less than this, radians (0.1°)
  std::optional<double> most_change;         ///< no angle may change from its start by more than this
};

struct IkAnswer {
  IkStatus status = IkStatus::kBadInput;
  std::vector<double> angles;
  int iterations = 0;
};

/// A batch of problems of one tree, row after row.
struct IkBatch {
  std::vector<Frame> roots;     ///< one for all problems, or one for each
  std::vector<double> starts;   ///< problems × degrees of freedom
  std::vector<Target> targets;  ///< problems × effectors
};

struct IkBatchAnswer {
  std::vector<IkStatus> statuses;
  std::vector<double> angles;  ///< problems × degrees of freedom
  std::vector<int> iterations;
};

enum class Precision {
  kDouble,  ///< the same answers as `Solve`
  kFloat,   ///< twice as many problems at a time; goals are still met in double precision, perhaps by another pose
};

/// Forward and inverse kinematics of one tree. Answers depend on the inputs alone, not on earlier calls.
class ETUDE_API Kinematics {
 public:
  /// Throws BadInput for an invalid tree, or options out of range.
  explicit Kinematics(Tree tree, const IkOptions& options = {});
  Kinematics(Kinematics&&) noexcept;
  Kinematics& operator=(Kinematics&&) noexcept;
  ~Kinematics();

  const Tree& tree() const;
  int dofs() const;

  /// Returns the frames of all limbs. Throws BadInput if the number of angles is not the number of degrees of freedom.
  std::vector<Frame> Limbs(const TreePose& pose) const;
  /// Returns the frames of all effectors.
  std::vector<Frame> Effectors(const TreePose& pose) const;

  /// Finds, of all poses that meet the targets within the limits, the one nearest to `start`; the root does not move.
  /// Throws BadInput for sizes that do not fit the tree, numbers that are not finite, and axes that are not unit
  /// vectors.
  IkAnswer Solve(const TreePose& start, std::span<const Target> targets) const;
  /// Solves many problems at once, several times faster. Throws BadInput for sizes that do not fit.
  IkBatchAnswer Solve(const IkBatch& batch, Precision precision = Precision::kDouble) const;

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace etude::engine
