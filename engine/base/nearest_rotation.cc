#include "engine/base/nearest_rotation.h"

#include <Eigen/Dense>

namespace etude {

NearestRotation NearestRotationTo(const glm::dmat3& m) {
  using Eigen::Matrix3d;
  Matrix3d matrix;
  for (int column = 0; column < 3; ++column) matrix.col(column) << m[column].x, m[column].y, m[column].z;
  const Eigen::JacobiSVD<Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);

  // Avoid a reflection by turning the singular vector of the smallest singular value.
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Eigen::Vector3d signs(1, 1, sign);
  const Matrix3d rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();

  NearestRotation nearest;
  for (int column = 0; column < 3; ++column) {
    nearest.rotation[column] = {rotation(0, column), rotation(1, column), rotation(2, column)};
  }
  const Eigen::Vector3d values = svd.singularValues().cwiseProduct(signs);
  nearest.signed_singular_values = {values[0], values[1], values[2]};
  return nearest;
}

}  // namespace etude
