#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <iterator>

#include "engine/base/angles.h"
#include "engine/formats/bvh.h"

namespace etude {
namespace {

/// Angles in radians with R = Rz(z) Rx(x) Ry(y).
struct EulerZxy {
  double z, x, y;
};

EulerZxy ToEulerZxy(const glm::dquat& rotation) {
  const glm::dmat3 columns = glm::mat3_cast(rotation);
  const auto r = [&](int row, int column) { return columns[column][row]; };
  const double cos_x = std::hypot(r(2, 0), r(2, 2));
  const double x = std::atan2(r(2, 1), cos_x);
  // At x = ±90° only z ± y is determined: give all of it to z.
  constexpr double kLocked = 1e-9;
  if (cos_x < kLocked) return {std::atan2(r(1, 0), r(0, 0)), x, 0};
  return {std::atan2(-r(0, 1), r(1, 1)), x, std::atan2(-r(2, 0), r(2, 2))};
}

/// Values that would be printed as "-0.000000" become zero.
glm::dvec3 WithoutMinusZeros(glm::dvec3 values) {
  constexpr double kPrintedAsZero = 0.5e-6;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(values[i]) < kPrintedAsZero) values[i] = 0;
  }
  return values;
}

class Writer {
 public:
  explicit Writer(const Clip& clip) : clip_(clip), children_(clip.skeleton.joints.size()) {
    for (std::size_t i = 0; i < children_.size(); ++i) {
      const int parent = Joint(i).parent;
      if (parent >= 0) {
        children_[parent].push_back(static_cast<int>(i));
      } else {
        assert(root_ < 0 && "BVH holds one root");
        root_ = static_cast<int>(i);
      }
    }
    assert(root_ >= 0);
  }

  std::string Write() {
    Print("HIERARCHY\n");
    WriteJoint(root_, 0);
    Print("MOTION\nFrames: {}\nFrame Time: {:.10f}\n", clip_.frames.size(), 1.0 / clip_.rate_hz);
    for (const LocalPose& pose : clip_.frames) WriteFrame(pose);
    return std::move(text_);
  }

 private:
  struct Column {
    int joint;
    bool has_positions;
  };

  template <typename... Args>
  void Print(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }

  const etude::Joint& Joint(std::size_t index) const { return clip_.skeleton.joints[index]; }

  bool LeavesItsOffset(int joint) const {
    for (const LocalPose& pose : clip_.frames) {
      if (pose[joint].translation != Joint(joint).rest.translation) return true;
    }
    return false;
  }

  void WriteJoint(int index, int depth) {
    const etude::Joint& joint = Joint(index);
    const std::string indent(depth, '\t');
    const bool is_end = joint.is_end_site && children_[index].empty();
    if (is_end) {
      Print("{}End Site\n", indent);
    } else {
      Print("{}{} {}\n", indent, index == root_ ? "ROOT" : "JOINT", joint.name);
    }
    Print("{}{{\n{}\tOFFSET ", indent, indent);
    Print(joint.rest.translation);
    text_ += '\n';
    if (!is_end) {
      const bool has_positions = index == root_ || LeavesItsOffset(index);
      columns_.push_back({index, has_positions});
      Print("{}\tCHANNELS {}Zrotation Xrotation Yrotation\n", indent,
            has_positions ? "6 Xposition Yposition Zposition " : "3 ");
    }
    for (int child : children_[index]) WriteJoint(child, depth + 1);
    Print("{}}}\n", indent);
  }

  void Print(const glm::dvec3& numbers) {
    const glm::dvec3 n = WithoutMinusZeros(numbers);
    Print("{:.6f} {:.6f} {:.6f}", n.x, n.y, n.z);
  }

  void WriteFrame(const LocalPose& pose) {
    for (const Column& column : columns_) {
      const LocalTransform& local = pose[column.joint];
      if (column.has_positions) {
        Print(local.translation);
        text_ += ' ';
      }
      const EulerZxy angles = ToEulerZxy(local.rotation);
      Print(glm::dvec3(Degrees(angles.z), Degrees(angles.x), Degrees(angles.y)));
      text_ += ' ';
    }
    text_.back() = '\n';
  }

  const Clip& clip_;
  std::vector<std::vector<int>> children_;
  int root_ = -1;
  std::vector<Column> columns_;  ///< in the order written
  std::string text_;
};

}  // namespace

std::string WriteBvh(const Clip& clip) { return Writer(clip).Write(); }

}  // namespace etude
