#include "engine/cameras/refine.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/crs_matrix.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/cameras/angle_axis.h"
#include "engine/cameras/camera_parameters.h"
#include "engine/cameras/reprojection_error.h"

namespace etude {
namespace {

constexpr std::array<const char*, kIntrinsicsCount> kIntrinsicsNames = {
    "focal length", "focal length", "principal point", "principal point", "skew",
    "distortion",   "distortion",   "distortion",      "distortion",      "distortion"};
/// A pose's parameter block: Rodrigues' vector, then the translation; R_CW and p_CW for a camera, R_WT and p_WT for a
/// target.
constexpr int kPoseCount = 6;

/// Returns true if a lens has more than the five coefficients that are estimated.
bool IsBeyondBrown(const Distortion& d) {
  const Distortion brown{.k1 = d.k1, .k2 = d.k2, .p1 = d.p1, .p2 = d.p2, .k3 = d.k3};
  return d != brown;
}

using IntrinsicsBlock = std::array<double, kIntrinsicsCount>;
using PoseBlock = std::array<double, kPoseCount>;

PoseBlock ToBlock(const glm::dmat3& R, const glm::dvec3& t) {
  const glm::dvec3 turn = ToAngleAxis(R);
  return {turn.x, turn.y, turn.z, t.x, t.y, t.z};
}

glm::dmat3 RotationOf(const PoseBlock& block) { return FromAngleAxis({block[0], block[1], block[2]}); }

IntrinsicsBlock ToBlock(const Camera& camera, const RefineOptions& options) {
  const Intrinsics& in = camera.intrinsics;
  const bool has_lens = options.lens != LensModel::kPinhole;
  const Distortion d = has_lens ? camera.distortion : Distortion{};
  return {in.fx, in.fy, in.cx, in.cy, in.skew, d.k1, d.k2, d.p1, d.p2, d.k3};
}

/// Returns the indices of the intrinsics that are held fixed.
std::vector<int> Held(const RefineOptions& options) {
  std::vector<int> held;
  const bool holds_lens = options.lens == LensModel::kPinhole || options.lens == LensModel::kAsInCamera;
  for (int i = 0; i < kIntrinsicsCount; ++i) {
    const bool is_lens = i >= kK1;
    if ((i == kSkew && !options.skew) || (is_lens && holds_lens) || (i == kK3 && options.lens == LensModel::kRadial2)) {
      held.push_back(i);
    }
  }
  return held;
}

/// The least-squares problem, its parameters, and Ceres's representation of it.
class Bundle {
 public:
  Bundle(const RigGuess& guess, std::span<const TargetView> views, const RefineOptions& options)
      : guess_(guess), views_(views), options_(options), held_(Held(options)) {
    for (const Camera& camera : guess.cameras) {
      intrinsics_.push_back(ToBlock(camera, options));
      cameras_.push_back(ToBlock(camera.R_CW, -(camera.R_CW * camera.p_WC)));
    }
    for (const CalibrationTargetPose& target : guess.targets) targets_.push_back(ToBlock(target.R_WT, target.p_WT));
    for (const TargetView& view : views) AddView(view);
    for (IntrinsicsBlock& intrinsics : intrinsics_) Hold(intrinsics);
    if (!options.hold_cameras) problem_.SetParameterBlockConstant(targets_.front().data());
    for (PoseBlock& camera : cameras_) {
      if (options.hold_cameras) problem_.SetParameterBlockConstant(camera.data());
    }
  }

  std::size_t points() const { return points_; }
  std::size_t parameters() const {
    if (options_.hold_cameras) return targets_.size() * kPoseCount;
    const std::size_t free_intrinsics = options_.hold_intrinsics ? 0 : kIntrinsicsCount - held_.size();
    return intrinsics_.size() * (free_intrinsics + kPoseCount) + (targets_.size() - 1) * kPoseCount;
  }

  Result<void> Solve() {
    ceres::Solver::Options o;
    o.linear_solver_type = targets_.size() > 1 ? ceres::DENSE_SCHUR : ceres::DENSE_QR;
    if (targets_.size() > 1) o.linear_solver_ordering = TargetsFirst();
    o.num_threads = 1;
    o.max_num_iterations = options_.most_iterations;
    // Iterate to the precision of doubles, because callers compare the final residual with the error of the corners.
    o.function_tolerance = 1e-15;
    o.parameter_tolerance = 1e-14;
    o.gradient_tolerance = 1e-14;
    o.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(o, &problem_, &summary);
    if (summary.termination_type == ceres::FAILURE) {
      return Fail({},
                  "in the first estimate, a point is behind the camera that saw it; are the world points paired with "
                  "the right pixels?");
    }
    return {};
  }

  /// Computes the standard deviations of the parameters from the inverse of JᵀJ. Fails if the views leave a parameter
  /// undetermined.
  Result<std::vector<IntrinsicsDeviation>> Deviations() {
    if (options_.hold_cameras) return std::vector<IntrinsicsDeviation>(intrinsics_.size());
    const Eigen::MatrixXd normal = NormalMatrix();
    const Eigen::VectorXd scale = normal.diagonal().cwiseSqrt();
    for (Eigen::Index i = 0; i < scale.size(); ++i) {
      if (!(scale[i] > 0)) return Undetermined(static_cast<std::size_t>(i));
    }
    // Scale to a unit diagonal, then test the eigenvalues.
    const Eigen::MatrixXd scaled = scale.cwiseInverse().asDiagonal() * normal * scale.cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
    // Below this ratio of the eigenvalues, some combination of parameters hardly affects the residuals.
    constexpr double kSingular = 1e-12;
    if (!(eigen.eigenvalues()[0] > kSingular * eigen.eigenvalues()[scaled.rows() - 1])) {
      Eigen::Index worst = 0;
      eigen.eigenvectors().col(0).cwiseAbs().maxCoeff(&worst);
      return Undetermined(static_cast<std::size_t>(worst));
    }
    // The variances are the diagonal of the inverse, times the variance of the residuals.
    const Eigen::MatrixXd inverse =
        eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
    const double freedom = 2.0 * static_cast<double>(points_) - static_cast<double>(parameters());
    const double sigma = freedom > 0 ? std::sqrt(2 * cost_ / freedom) : 0;
    const Eigen::VectorXd by_views =
        VariancesByViews(scale.cwiseInverse().asDiagonal() * inverse * scale.cwiseInverse().asDiagonal());
    std::vector<IntrinsicsDeviation> deviations(intrinsics_.size());
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i].intrinsic < 0 || columns_[i].intrinsic > kCy) continue;
      IntrinsicsDeviation& of = deviations[columns_[i].camera];
      double* const members[] = {&of.fx, &of.fy, &of.cx, &of.cy};
      const auto at = static_cast<Eigen::Index>(i);
      const double independent = sigma * std::sqrt(std::max(0.0, inverse(at, at))) / scale[at];
      *members[columns_[i].intrinsic] = std::max(independent, std::sqrt(by_views[at]));
    }
    return deviations;
  }

  RefinedRig Answer() const {
    RefinedRig rig;
    rig.cameras = guess_.cameras;
    for (std::size_t i = 0; i < intrinsics_.size(); ++i) {
      const IntrinsicsBlock& in = intrinsics_[i];
      Camera& camera = rig.cameras[i];
      camera.intrinsics = {
          camera.intrinsics.width, camera.intrinsics.height, in[kFx], in[kFy], in[kCx], in[kCy], in[kSkew]};
      if (options_.lens != LensModel::kAsInCamera) {
        camera.distortion = {.k1 = in[kK1], .k2 = in[kK2], .p1 = in[kP1], .p2 = in[kP2], .k3 = in[kK3]};
      }
      camera.R_CW = RotationOf(cameras_[i]);
      camera.p_WC = -(glm::transpose(camera.R_CW) * glm::dvec3(cameras_[i][3], cameras_[i][4], cameras_[i][5]));
    }
    for (const PoseBlock& target : targets_) {
      rig.targets.push_back({RotationOf(target), {target[3], target[4], target[5]}});
    }
    rig.points = points_;
    rig.parameters = parameters();
    return rig;
  }

 private:
  /// The free parameter to which a column of the Jacobian belongs.
  struct Column {
    std::size_t camera = 0;  ///< index of the camera, or number of cameras + index of the target
    int intrinsic = -1;      ///< index of an Intrinsic; −1 if the parameter belongs to a pose
  };

  void AddView(const TargetView& view) {
    const Distortion& lens = guess_.cameras[view.camera].distortion;
    const bool is_fixed = options_.lens == LensModel::kAsInCamera && IsBeyondBrown(lens);
    const std::optional<Distortion> fixed = is_fixed ? std::optional(lens) : std::nullopt;
    for (const PointPair& pair : view.pairs) {
      using Cost = ceres::AutoDiffCostFunction<ReprojectionError, 2, kIntrinsicsCount, kPoseCount, kPoseCount>;
      problem_.AddResidualBlock(new Cost(new ReprojectionError{pair.world, pair.pixel, fixed}), nullptr,
                                intrinsics_[view.camera].data(), cameras_[view.camera].data(),
                                targets_[view.target].data());
    }
    points_ += view.pairs.size();
  }

  void Hold(IntrinsicsBlock& intrinsics) {
    if (options_.hold_intrinsics || options_.hold_cameras) {
      problem_.SetParameterBlockConstant(intrinsics.data());
    } else if (!held_.empty()) {
      problem_.SetManifold(intrinsics.data(), new ceres::SubsetManifold(kIntrinsicsCount, held_));
    }
  }

  // Eliminate the targets first (Schur complement). Intrinsics and poses are separate groups, because Ceres sorts the
  // blocks of a group by their addresses. Within one array this order is fixed; between arrays it depends on the heap.
  std::shared_ptr<ceres::ParameterBlockOrdering> TargetsFirst() {
    auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (PoseBlock& target : targets_) ordering->AddElementToGroup(target.data(), 0);
    for (std::size_t i = 0; i < intrinsics_.size(); ++i) {
      ordering->AddElementToGroup(intrinsics_[i].data(), 1);
      ordering->AddElementToGroup(cameras_[i].data(), 2);
    }
    return ordering;
  }

  // Returns JᵀJ over the free parameters, and sets columns_, cost_, jacobian_ and residuals_.
  Eigen::MatrixXd NormalMatrix() {
    ceres::Problem::EvaluateOptions evaluate;
    columns_.clear();
    // List the free parameter blocks in order, with their columns.
    for (std::size_t i = 0; i < intrinsics_.size(); ++i) {
      if (!options_.hold_intrinsics) {
        evaluate.parameter_blocks.push_back(intrinsics_[i].data());
        for (int k = 0; k < kIntrinsicsCount; ++k) {
          if (std::find(held_.begin(), held_.end(), k) == held_.end()) columns_.push_back({i, k});
        }
      }
      evaluate.parameter_blocks.push_back(cameras_[i].data());
      columns_.insert(columns_.end(), kPoseCount, Column{i, -1});
    }
    for (std::size_t i = 1; i < targets_.size(); ++i) {
      evaluate.parameter_blocks.push_back(targets_[i].data());
      columns_.insert(columns_.end(), kPoseCount, Column{intrinsics_.size() + i, -1});
    }
    // Evaluate the Jacobian, and compute JᵀJ from its nonzero entries.
    problem_.Evaluate(evaluate, &cost_, &residuals_, nullptr, &jacobian_);
    const ceres::CRSMatrix& jacobian = jacobian_;
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(jacobian.num_cols, jacobian.num_cols);
    for (int row = 0; row < jacobian.num_rows; ++row) {
      for (int a = jacobian.rows[row]; a < jacobian.rows[row + 1]; ++a) {
        for (int b = jacobian.rows[row]; b < jacobian.rows[row + 1]; ++b) {
          normal(jacobian.cols[a], jacobian.cols[b]) += jacobian.values[a] * jacobian.values[b];
        }
      }
    }
    return normal;
  }

  // Returns the variances of the free parameters for errors that are correlated among the corners of one view (by blur,
  // a bent board, or a bias of the finder). The estimator is the sandwich A⁻¹ (Σ g gᵀ) A⁻¹, where A⁻¹ is `inverse`
  // and g is the gradient of one view. The variances are multiplied by the correction CR1 for a small number of views
  // (Cameron and Miller 2015). Returns zeros for fewer than four views.
  Eigen::VectorXd VariancesByViews(const Eigen::MatrixXd& inverse) const {
    Eigen::VectorXd variances = Eigen::VectorXd::Zero(inverse.rows());
    constexpr std::size_t kMinViews = 4;
    if (views_.size() < kMinViews) return variances;
    int row = 0;
    for (const TargetView& view : views_) {
      Eigen::VectorXd gradient = Eigen::VectorXd::Zero(inverse.rows());
      for (const int end = row + 2 * static_cast<int>(view.pairs.size()); row < end; ++row) {
        for (int k = jacobian_.rows[row]; k < jacobian_.rows[row + 1]; ++k) {
          gradient[jacobian_.cols[k]] += jacobian_.values[k] * residuals_[row];
        }
      }
      variances += (inverse * gradient).cwiseAbs2();
    }
    const auto views = static_cast<double>(views_.size()), equations = 2.0 * static_cast<double>(points_);
    const double few =
        views / (views - 1) * (equations - 1) / std::max(1.0, equations - static_cast<double>(parameters()));
    return few * variances;
  }

  tl::unexpected<Error> Undetermined(std::size_t column) const {
    const Column& of = columns_[column];
    if (of.camera >= intrinsics_.size())
      return Fail({}, "the views do not determine the position of board {}", of.camera - intrinsics_.size() + 1);
    const char* const what = of.intrinsic < 0 ? "place" : kIntrinsicsNames[static_cast<std::size_t>(of.intrinsic)];
    return Fail(
        {},
        "camera {}: the points do not determine the camera's {}; points must fill a volume, and boards must be tilted",
        of.camera + 1, what);
  }

  const RigGuess& guess_;
  const std::span<const TargetView> views_;
  const RefineOptions options_;
  const std::vector<int> held_;
  std::vector<IntrinsicsBlock> intrinsics_;
  std::vector<PoseBlock> cameras_, targets_;
  std::size_t points_ = 0;
  ceres::Problem problem_;
  std::vector<Column> columns_;
  double cost_ = 0;
  ceres::CRSMatrix jacobian_;
  std::vector<double> residuals_;
};

Result<void> CheckViews(const RigGuess& guess, std::span<const TargetView> views) {
  std::vector<std::size_t> points(guess.cameras.size());
  for (const TargetView& view : views) {
    if (view.camera >= guess.cameras.size() || view.target >= guess.targets.size()) {
      return Fail({}, "a view refers to a camera or a board that does not exist");
    }
    points[view.camera] += view.pairs.size();
    for (const PointPair& pair : view.pairs) {
      const double sum = pair.world.x + pair.world.y + pair.world.z + pair.pixel.x + pair.pixel.y;
      if (!std::isfinite(sum))
        return Fail({}, "camera {}: a point pair has a coordinate that is not finite", view.camera + 1);
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i] == 0) return Fail({}, "camera {} has no point", i + 1);
  }
  return {};
}

void AddRms(std::span<const TargetView> views, RefinedRig& rig) {
  std::vector<double> squares(rig.cameras.size());
  std::vector<std::size_t> points(rig.cameras.size());
  double sum = 0;
  for (const TargetView& view : views) {
    const double rms = ReprojectionRms(rig.cameras[view.camera], rig.targets[view.target], view.pairs);
    const double here = rms * rms * static_cast<double>(view.pairs.size());
    squares[view.camera] += here;
    points[view.camera] += view.pairs.size();
    sum += here;
  }
  for (std::size_t i = 0; i < squares.size(); ++i) {
    rig.camera_rms_px.push_back(std::sqrt(squares[i] / static_cast<double>(points[i])));
  }
  rig.rms_px = std::sqrt(sum / static_cast<double>(rig.points));
}

}  // namespace

Result<RefinedRig> RefineRig(const RigGuess& guess, std::span<const TargetView> views, const RefineOptions& options) {
  RETURN_IF_ERROR(CheckViews(guess, views));
  Bundle bundle(guess, views, options);
  if (2 * bundle.points() < bundle.parameters()) {
    return Fail({}, "{} points give {} equations, but there are {} unknowns; more points are needed", bundle.points(),
                2 * bundle.points(), bundle.parameters());
  }
  RETURN_IF_ERROR(bundle.Solve());
  ASSIGN_OR_RETURN(auto deviations, bundle.Deviations());
  RefinedRig rig = bundle.Answer();
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    if (!(rig.cameras[i].intrinsics.fx > 0) || !(rig.cameras[i].intrinsics.fy > 0)) {
      return Fail({}, "camera {}: no focal length above 0 fits the points", i + 1);
    }
  }
  AddRms(views, rig);
  if (!std::isfinite(rig.rms_px)) {
    return Fail({},
                "the best-fitting lens distortion maps several directions to the same pixel; there may be too few "
                "points, or world points may be paired with wrong pixels");
  }
  rig.deviations = std::move(deviations);
  return rig;
}

Result<RefinedRig> RefineCamera(std::span<const PointPair> pairs, int width, int height, const RefineOptions& options) {
  ASSIGN_OR_RETURN(const ProjectionMatrix matrix, Calibrate(pairs, Calibration::kDltNormalised));
  ASSIGN_OR_RETURN(const CameraParameters parameters, Decompose(matrix));
  Camera camera = ToCamera(parameters, width, height);
  if (!options.skew) camera.intrinsics.skew = 0;
  const std::vector<TargetView> views{{0, 0, {pairs.begin(), pairs.end()}}};
  return RefineRig({{camera}, {CalibrationTargetPose{}}}, views, options);
}

double ReprojectionRms(const Camera& camera, const CalibrationTargetPose& target, std::span<const PointPair> pairs) {
  double squares = 0;
  for (const PointPair& pair : pairs) {
    const auto pixel = Project(camera, target.R_WT * pair.world + target.p_WT);
    if (!pixel) return std::numeric_limits<double>::infinity();
    squares += glm::dot(*pixel - pair.pixel, *pixel - pair.pixel);
  }
  return pairs.empty() ? 0 : std::sqrt(squares / static_cast<double>(pairs.size()));
}

}  // namespace etude
