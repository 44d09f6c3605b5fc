#pragma once

#include <glm/glm.hpp>

namespace etude {

/// The proper rotation nearest to a matrix in the Frobenius norm.
struct NearestRotation {
  glm::dmat3 rotation = glm::dmat3(1);
  /// Singular values of the matrix in descending order. The last one is negative if the nearest orthogonal matrix is a
  /// reflection. Their sum is the trace of rotationᵀ · matrix.
  glm::dvec3 signed_singular_values = glm::dvec3(0);
};

/// Returns the proper rotation nearest to `m`, by the singular value decomposition. For m = Σ to · fromᵀ, it is the
/// rotation that turns the vectors `from` closest to the vectors `to` in the sense of least squares (Kabsch 1976). If
/// `m` has a rank below 2, several rotations are equally near, and the function returns one of them.
NearestRotation NearestRotationTo(const glm::dmat3& m);

}  // namespace etude
