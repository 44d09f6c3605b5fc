#include "engine/cameras/planes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "engine/base/nearest_rotation.h"

namespace etude {
namespace {

using Eigen::Matrix3d;

/// Returns the map that shifts the mean of the points to the origin and scales the points to a mean distance of √2 from
/// the origin (Hartley 1997).
Matrix3d Normaliser(const Eigen::MatrixX2d& points) {
  const Eigen::RowVector2d mean = points.colwise().mean();
  const double distance = (points.rowwise() - mean).rowwise().norm().mean();
  const double scale = distance > 0 ? std::sqrt(2.0) / distance : 1;
  Matrix3d m;
  m << scale, 0, -scale * mean.x(), 0, scale, -scale * mean.y(), 0, 0, 1;
  return m;
}

bool LieOnALine(const Eigen::MatrixX2d& points) {
  constexpr double kOneLine = 1e-4;
  const Eigen::MatrixX2d centred = points.rowwise() - points.colwise().mean();
  const Eigen::Vector2d extents = Eigen::JacobiSVD<Eigen::MatrixXd>(centred).singularValues();
  return !(extents[1] > kOneLine * extents[0]);
}

glm::dmat3 ToGlm(const Matrix3d& m) {
  glm::dmat3 out;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) out[column][row] = m(row, column);
  }
  return out;
}

/// Returns the composition X_AC = X_AB X_BC of two poses.
CalibrationTargetPose Product(const CalibrationTargetPose& ab, const CalibrationTargetPose& bc) {
  return {ab.R_WT * bc.R_WT, ab.R_WT * bc.p_WT + ab.p_WT};
}

CalibrationTargetPose Inverse(const CalibrationTargetPose& pose) {
  const glm::dmat3 R = glm::transpose(pose.R_WT);
  return {R, -(R * pose.p_WT)};
}

/// A view of a flat board, and the homography from the board to the picture.
struct PlaneView {
  const TargetView* view;
  glm::dmat3 homography;
  CalibrationTargetPose pose_CT{};
};

/// The poses of cameras and boards, found one after the other.
class Places {
 public:
  Places(std::size_t cameras, std::size_t targets) : cameras_(cameras), targets_(targets) {}

  /// Adds the pose of one camera or board. A view qualifies if the pose of either its camera or its board is known, but
  /// not of both; the function uses the qualifying view with the most corners. Returns false if no view qualifies. The
  /// pose of the first board must be set before.
  bool Join(std::span<const PlaneView> views) {
    const PlaneView* best = nullptr;
    for (const PlaneView& view : views) {
      if (cameras_[view.view->camera].has_value() == targets_[view.view->target].has_value()) continue;
      if (best == nullptr || view.view->pairs.size() > best->view->pairs.size()) best = &view;
    }
    if (best == nullptr) return false;
    auto& camera_CW = cameras_[best->view->camera];
    auto& target_WT = targets_[best->view->target];
    if (target_WT) {
      camera_CW = Product(best->pose_CT, Inverse(*target_WT));
    } else {
      target_WT = Product(Inverse(*camera_CW), best->pose_CT);
    }
    return true;
  }

  std::vector<std::optional<CalibrationTargetPose>> cameras_, targets_;
};

}  // namespace

Result<glm::dmat3> HomographyOf(std::span<const PointPair> pairs) {
  // Collect the points. Refuse points that determine no homography.
  if (pairs.size() < 4) return Fail({}, "found {} corners; allowed: at least 4", pairs.size());
  const auto count = static_cast<Eigen::Index>(pairs.size());
  Eigen::MatrixX2d plane(count, 2), picture(count, 2);
  for (Eigen::Index i = 0; i < count; ++i) {
    const PointPair& pair = pairs[static_cast<std::size_t>(i)];
    plane.row(i) << pair.world.x, pair.world.y;
    picture.row(i) << pair.pixel.x, pair.pixel.y;
  }
  if (!plane.allFinite() || !picture.allFinite()) return Fail({}, "the position of a corner is not finite");
  if (LieOnALine(plane) || LieOnALine(picture)) return Fail({}, "the corners lie on one line");
  // Write two equations for each pair, in normalised coordinates.
  const Matrix3d Np = Normaliser(plane), Ni = Normaliser(picture);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * count, 9);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d X = Np * plane.row(i).transpose().homogeneous();
    const Eigen::Vector3d x = Ni * picture.row(i).transpose().homogeneous();
    A.row(2 * i).segment<3>(0) = X;
    A.row(2 * i).segment<3>(6) = -x[0] * X;
    A.row(2 * i + 1).segment<3>(3) = X;
    A.row(2 * i + 1).segment<3>(6) = -x[1] * X;
  }
  // H is the right singular vector of the smallest singular value.
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullV);
  const Eigen::VectorXd h = svd.matrixV().col(8);
  Matrix3d H;
  H << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], h[8];
  return ToGlm(Ni.inverse() * H * Np);
}

Result<Intrinsics> IntrinsicsFromPlanes(std::span<const glm::dmat3> homographies, int width, int height) {
  // Put the principal point at the origin and divide pixels by the picture's longer side. Then h₁ᵀωh₂ = 0 and h₁ᵀωh₁ =
  // h₂ᵀωh₂ are linear in ω = diag(a, b, 1), where a = 1/fx², b = 1/fy².
  const double unit = std::max(width, height);
  Eigen::MatrixX2d A(2 * static_cast<Eigen::Index>(homographies.size()), 2);
  Eigen::VectorXd rhs(A.rows());
  Eigen::Index row = 0;
  for (const glm::dmat3& homography : homographies) {
    glm::dvec3 h[2];
    for (int i = 0; i < 2; ++i) {
      h[i] = homography[i];
      h[i].x = (h[i].x - width / 2.0 * h[i].z) / unit;
      h[i].y = (h[i].y - height / 2.0 * h[i].z) / unit;
    }
    const double size = std::max(glm::length(h[0]), glm::length(h[1]));
    for (glm::dvec3& column : h) column /= size;
    A.row(row) << h[0].x * h[1].x, h[0].y * h[1].y;
    rhs[row++] = -h[0].z * h[1].z;
    A.row(row) << h[0].x * h[0].x - h[1].x * h[1].x, h[0].y * h[0].y - h[1].y * h[1].y;
    rhs[row++] = h[1].z * h[1].z - h[0].z * h[0].z;
  }
  // Solve for a and b if the planes determine both; otherwise assume square pixels, a = b.
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  constexpr double kTellsApart = 0.02;
  Eigen::Vector2d ab = svd.solve(rhs);
  if (!(svd.singularValues()[1] > kTellsApart * svd.singularValues()[0]) || !(ab.minCoeff() > 0)) {
    const Eigen::VectorXd both = A.rowwise().sum();
    ab.setConstant(both.dot(rhs) / both.squaredNorm());
  }
  const Eigen::Vector2d focal = unit * ab.cwiseSqrt().cwiseInverse();
  // Maximum focal length as a multiple of the picture's longer side; longer lenses are implausible for filming a
  // person.
  constexpr double kMaxFocal = 50;
  if (!(ab.minCoeff() > 0) || !focal.allFinite() || focal.maxCoeff() > kMaxFocal * unit) {
    return Fail({},
                "all boards are parallel to the picture, so they do not determine the focal length; tilt the board in "
                "some pictures");
  }
  return Intrinsics{width, height, focal[0], focal[1], width / 2.0, height / 2.0, 0};
}

CalibrationTargetPose PoseOfPlane(const Intrinsics& in, const glm::dmat3& homography) {
  const glm::dmat3 K = glm::transpose(glm::dmat3(in.fx, in.skew, in.cx, 0, in.fy, in.cy, 0, 0, 1));
  glm::dmat3 m = glm::inverse(K) * homography;
  m /= (glm::length(m[0]) + glm::length(m[1])) / 2;
  if (m[2].z < 0) m *= -1.0;
  const glm::dvec3 t = m[2];
  m[2] = glm::cross(m[0], m[1]);
  return {NearestRotationTo(m).rotation, t};
}

std::size_t NumberTargets(std::span<TargetView> views) {
  std::map<std::size_t, std::size_t> numbers;
  for (TargetView& view : views) view.target = numbers.try_emplace(view.target, numbers.size()).first->second;
  return numbers.size();
}

Result<RefinedRig> CalibrateFromPlanes(std::span<const PictureSize> sizes, std::span<const TargetView> views,
                                       const RefineOptions& options) {
  // Keep the views that have a homography.
  std::vector<PlaneView> usable;
  for (const TargetView& view : views) {
    if (auto homography = HomographyOf(view.pairs)) usable.push_back({&view, *homography});
  }
  // Estimate the intrinsics of each camera.
  RigGuess guess;
  for (std::size_t camera = 0; camera < sizes.size(); ++camera) {
    std::vector<glm::dmat3> homographies;
    for (const PlaneView& view : usable) {
      if (view.view->camera == camera) homographies.push_back(view.homography);
    }
    if (homographies.empty())
      return Fail({}, "no picture of camera {} shows a board with four corners or more", camera + 1);
    const auto intrinsics = IntrinsicsFromPlanes(homographies, sizes[camera].width, sizes[camera].height);
    if (!intrinsics) return Fail({}, "camera {}: {}", camera + 1, intrinsics.error().message);
    guess.cameras.push_back({.intrinsics = *intrinsics});
  }
  for (PlaneView& view : usable) {
    view.pose_CT = PoseOfPlane(guess.cameras[view.view->camera].intrinsics, view.homography);
  }
  // Drop the boards that have no view left, and renumber the others.
  std::vector<TargetView> kept;
  for (const PlaneView& view : usable) kept.push_back(*view.view);
  const std::size_t boards = NumberTargets(kept);
  for (std::size_t i = 0; i < usable.size(); ++i) usable[i].view = &kept[i];
  // Find all poses, starting from the first board.
  Places places(sizes.size(), boards);
  places.targets_.front() = CalibrationTargetPose{};
  while (places.Join(usable)) {
  }
  // The adjustment of all cameras and boards together starts at these poses.
  for (std::size_t camera = 0; camera < sizes.size(); ++camera) {
    const auto& pose_CW = places.cameras_[camera];
    if (!pose_CW) {
      return Fail({},
                  "the position of camera {} is not determined, because this camera and the cameras before it never "
                  "see a board at the same time; show a board to both at the same time",
                  camera + 1);
    }
    guess.cameras[camera].R_CW = pose_CW->R_WT;
    guess.cameras[camera].p_WC = -(glm::transpose(pose_CW->R_WT) * pose_CW->p_WT);
  }
  for (const auto& target : places.targets_) guess.targets.push_back(*target);
  return RefineRig(guess, kept, options);
}

// Each board's initial pose follows from its first usable view.
Result<RefinedRig> LocateBoards(std::span<const Camera> cameras, std::span<const TargetView> views) {
  RigGuess guess{.cameras = {cameras.begin(), cameras.end()}, .targets = {}};
  std::vector<std::optional<std::size_t>> number;
  std::vector<TargetView> kept;
  for (const TargetView& view : views) {
    const Camera& camera = cameras[view.camera];
    std::vector<PointPair> pinhole;
    for (const PointPair& pair : view.pairs) {
      if (const auto pixel = UndistortPixel(camera, pair.pixel)) pinhole.push_back({pair.world, *pixel});
    }
    const auto homography = HomographyOf(pinhole);
    if (!homography) continue;
    if (view.target >= number.size()) number.resize(view.target + 1);
    auto& as = number[view.target];
    if (!as) {
      as = guess.targets.size();
      const CalibrationTargetPose pose_CW{camera.R_CW, -(camera.R_CW * camera.p_WC)};
      guess.targets.push_back(Product(Inverse(pose_CW), PoseOfPlane(camera.intrinsics, *homography)));
    }
    kept.push_back({view.camera, *as, view.pairs});
  }
  if (kept.empty()) return Fail({}, "found no board with four corners or more");
  return RefineRig(guess, kept, {.lens = LensModel::kAsInCamera, .hold_cameras = true});
}

}  // namespace etude
