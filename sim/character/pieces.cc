#include "sim/character/pieces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/angles.h"
#include "engine/base/image.h"
#include "engine/base/smoothstep.h"
#include "engine/motion/clip.h"
#include "sim/choreography/rotations.h"

namespace etude {
namespace {

constexpr double kMetresPerCm = 0.01;

/// Connects rings of `around` vertices each to a closed surface. The vertices must be in this order: first pole, rings,
/// last pole. Seen from the last pole, rings must run counter-clockwise.
void CloseRings(Piece& piece, int around) {
  const auto n = static_cast<std::uint32_t>(around);
  const auto last_pole = static_cast<std::uint32_t>(piece.vertices.size() - 1);
  const std::uint32_t rings = (last_pole - 1) / n;
  const auto at = [&](std::uint32_t ring, std::uint32_t corner) { return 1 + ring * n + corner % n; };
  for (std::uint32_t i = 0; i < n; ++i) {
    piece.triangles.push_back({0, at(0, i + 1), at(0, i)});
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
      piece.triangles.push_back({at(ring, i), at(ring, i + 1), at(ring + 1, i + 1)});
      piece.triangles.push_back({at(ring, i), at(ring + 1, i + 1), at(ring + 1, i)});
    }
    piece.triangles.push_back({at(rings - 1, i), at(rings - 1, i + 1), last_pole});
  }
}

double CornerAngle(int corner, int around) { return 2 * kPi * corner / around; }

/// The geometry of a tube, in metres.
class TubeShape {
 public:
  TubeShape(const Tube& tube, const BodyPose& rest) : tube_(tube) {
    for (const Role role : tube.chain) joints_.push_back(rest[role]);
    if (joints_.size() == 1) joints_.push_back(joints_[0] + glm::dvec3(0, 1, 0));
    double along = 0;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      if (i > 0) along += glm::distance(joints_[i - 1], joints_[i]);
      starts_.push_back(along);
    }
  }

  /// Returns the ring interpolated at `along_cm`, which is clamped to the tube.
  Tube::Ring RingAt(double along_cm) const {
    std::size_t i = 0;
    while (i + 2 < tube_.rings.size() && tube_.rings[i + 1].along_cm < along_cm) ++i;
    const Tube::Ring &a = tube_.rings[i], &b = tube_.rings[i + 1];
    const double t = std::clamp((along_cm - a.along_cm) / (b.along_cm - a.along_cm), 0.0, 1.0);
    return {std::lerp(a.along_cm, b.along_cm, t), std::lerp(a.side_cm, b.side_cm, t),
            std::lerp(a.front_cm, b.front_cm, t), std::lerp(a.ahead_cm, b.ahead_cm, t)};
  }

  /// Returns the vertex of a ring at `angle` (0 = left, π/2 = front), `lift` metres above the skin, with the vertex's
  /// joint weights.
  Piece::Vertex VertexAt(const Tube::Ring& ring, double angle, double lift = 0) const {
    const double along = ring.along_cm * kMetresPerCm;
    const auto [centre, direction] = PathAt(along);
    const glm::dvec3 forward(0, 0, 1);
    const glm::dvec3 front = glm::normalize(forward - glm::dot(forward, direction) * direction);
    // The left side must be the same direction for ascending and descending chains.
    const glm::dvec3 side = glm::cross(direction, front) * (direction.y < 0 ? -1.0 : 1.0);
    const double c = std::cos(angle), s = std::sin(angle);
    glm::dvec3 position =
        centre + (ring.side_cm * c * side + (ring.front_cm * s + ring.ahead_cm) * front) * kMetresPerCm;
    if (lift != 0) position += lift * glm::normalize(c / ring.side_cm * side + s / ring.front_cm * front);
    return Weighted(position, along);
  }

  bool Descends() const { return joints_[1].y < joints_[0].y; }

 private:
  struct PathPoint {
    glm::dvec3 position, direction;
  };

  PathPoint PathAt(double along) const {
    std::size_t i = 0;
    while (i + 2 < joints_.size() && along > starts_[i + 1]) ++i;
    const glm::dvec3 direction = glm::normalize(joints_[i + 1] - joints_[i]);
    return {joints_[i] + (along - starts_[i]) * direction, direction};
  }

  Piece::Vertex Weighted(const glm::dvec3& position, double along) const {
    Piece::Vertex vertex{.position = position, .joints = {tube_.chain[0], tube_.chain[0]}};
    const double blend = tube_.blend_cm * kMetresPerCm;
    for (std::size_t i = 1; i < tube_.chain.size(); ++i) {
      if (along <= starts_[i] - blend) break;
      vertex.joints = {tube_.chain[i - 1], tube_.chain[i]};
      const double share = blend > 0 ? Smoothstep(starts_[i] - blend, starts_[i] + blend, along) : 1;
      vertex.weights = {1 - share, share};
    }
    return vertex;
  }

  const Tube& tube_;
  std::vector<glm::dvec3> joints_;
  std::vector<double> starts_;
};

/// Makes half an ellipsoid at the end of a tube: rings that shrink from the tube outwards, then the pole. `out` is −1
/// at the tube's first ring and 1 at its last ring.
std::vector<Tube::Ring> Cap(const Tube::Ring& end, double length_cm, double out) {
  constexpr int kRings = 3;
  std::vector<Tube::Ring> cap;
  for (int i = 1; i <= kRings; ++i) {
    const double angle = 0.5 * kPi * i / (kRings + 1);
    cap.push_back({end.along_cm + out * length_cm * std::sin(angle), end.side_cm * std::cos(angle),
                   end.front_cm * std::cos(angle), end.ahead_cm});
  }
  cap.push_back({end.along_cm + out * length_cm, 0, 0, end.ahead_cm});
  return cap;
}

void TurnInsideOut(Piece& piece) {
  for (auto& triangle : piece.triangles) std::swap(triangle[1], triangle[2]);
}

/// Computes the normal of each vertex as the area-weighted mean of the normals of the triangles at this vertex.
std::vector<glm::dvec3> Normals(const Piece& piece) {
  std::vector<glm::dvec3> normals(piece.vertices.size(), glm::dvec3(0));
  for (const auto& [a, b, c] : piece.triangles) {
    const glm::dvec3 at = piece.vertices[a].position;
    const glm::dvec3 normal = glm::cross(piece.vertices[b].position - at, piece.vertices[c].position - at);
    for (const std::uint32_t corner : {a, b, c}) normals[corner] += normal;
  }
  for (glm::dvec3& normal : normals) normal = glm::normalize(normal);
  return normals;
}

}  // namespace

Piece MirrorImage(const Piece& piece) {
  Piece mirrored = piece;
  for (Piece::Vertex& vertex : mirrored.vertices) {
    vertex.position.x = -vertex.position.x;
    for (Role& joint : vertex.joints) joint = Mirrored(joint);
  }
  TurnInsideOut(mirrored);
  return mirrored;
}

Piece MakePiece(const Blob& blob, const BodyPose& rest) {
  Piece piece;
  // Add a vertex of the tilted ellipsoid at a latitude and longitude. The sole is cut flat.
  const glm::dmat3 tilt =
      RotationZ(Radians(blob.tilt_deg.z)) * RotationY(Radians(blob.tilt_deg.y)) * RotationX(Radians(blob.tilt_deg.x));
  const glm::dvec3 centre = rest[blob.joint] + blob.centre_cm * kMetresPerCm;
  const auto add = [&](double latitude, double longitude) {
    const glm::dvec3 unit(std::cos(latitude) * std::cos(longitude), std::sin(latitude),
                          std::cos(latitude) * std::sin(longitude));
    glm::dvec3 position = centre + tilt * (unit * blob.half_cm) * kMetresPerCm;
    position.y = std::max(position.y, blob.sole_cm * kMetresPerCm);
    piece.vertices.push_back({.position = position, .joints = {blob.joint, blob.joint}});
  };
  // Make poles and rings.
  const int steps = blob.around / 2;
  add(-kPi / 2, 0);
  for (int ring = 1; ring < steps; ++ring) {
    // Decrease the angle, because rings must run counter-clockwise as seen from the upper pole.
    for (int i = 0; i < blob.around; ++i) add(kPi * ring / steps - kPi / 2, -CornerAngle(i, blob.around));
  }
  add(kPi / 2, 0);
  CloseRings(piece, blob.around);
  return piece;
}

Piece MakePiece(const Tube& tube, const BodyPose& rest) {
  const TubeShape shape(tube, rest);
  std::vector<Tube::Ring> rings = Cap(tube.rings.front(), tube.first_cap_cm, -1);
  std::reverse(rings.begin(), rings.end());
  for (const Tube::Ring& ring : tube.rings) rings.push_back(ring);
  for (const Tube::Ring& ring : Cap(tube.rings.back(), tube.last_cap_cm, 1)) rings.push_back(ring);

  Piece piece;
  piece.vertices.push_back(shape.VertexAt(rings.front(), 0));
  for (std::size_t i = 1; i + 1 < rings.size(); ++i) {
    for (int corner = 0; corner < tube.around; ++corner) {
      piece.vertices.push_back(shape.VertexAt(rings[i], -CornerAngle(corner, tube.around)));
    }
  }
  piece.vertices.push_back(shape.VertexAt(rings.back(), 0));
  CloseRings(piece, tube.around);
  if (shape.Descends()) TurnInsideOut(piece);
  return piece;
}

Piece MakePiece(const Patch& patch, const Tube& tube, const BodyPose& rest) {
  constexpr int kRings = 5, kAround = 20;
  // Add a vertex of the sheet at a radius (1 = edge) and an angle around the sheet's centre.
  const TubeShape shape(tube, rest);
  Piece piece;
  const auto add = [&](double radius, double angle, double lift_cm) {
    const Tube::Ring ring = shape.RingAt(patch.along_cm + patch.half_along_cm * radius * std::sin(angle));
    const double round = kPi / 2 - Radians(patch.half_angle_deg) * radius * std::cos(angle);
    piece.vertices.push_back(shape.VertexAt(ring, round, lift_cm * kMetresPerCm));
  };
  // Make rings from the centre to the edge.
  add(0, 0, patch.lift_cm);
  for (int ring = 1; ring <= kRings; ++ring) {
    // The inner rings are level; the outermost ring goes down into the tube.
    const bool edge = ring == kRings;
    const double radius = edge ? 1 : 0.97 * ring / (kRings - 1);
    for (int i = 0; i < kAround; ++i) {
      add(radius, CornerAngle(i, kAround), edge ? -patch.lift_cm : patch.lift_cm);
    }
  }
  add(0, 0, -2 * patch.lift_cm);  // the centre of the back, hidden in the tube
  // Connect the rings on the front; connect the edge with the back.
  const auto back = static_cast<std::uint32_t>(piece.vertices.size() - 1);
  const auto at = [&](int ring, int i) { return static_cast<std::uint32_t>(1 + (ring - 1) * kAround + i % kAround); };
  for (int i = 0; i < kAround; ++i) {
    piece.triangles.push_back({0, at(1, i), at(1, i + 1)});
    for (int ring = 1; ring < kRings; ++ring) {
      piece.triangles.push_back({at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)});
      piece.triangles.push_back({at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)});
    }
    piece.triangles.push_back({back, at(kRings, i + 1), at(kRings, i)});
  }
  return piece;
}

Piece MakePiece(const Rope& rope, const BodyPose& rest) {
  constexpr int kAround = 6;
  Piece piece;
  const auto& points = rope.points_cm;
  // Make one ring of corners per point, between two poles.
  const auto add = [&](const glm::dvec3& from_joint_cm) {
    piece.vertices.push_back(
        {.position = rest[rope.joint] + from_joint_cm * kMetresPerCm, .joints = {rope.joint, rope.joint}});
  };
  const glm::dvec3 first = glm::normalize(points[1] - points[0]);
  add(points[0] - rope.radius_cm * first);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 along = glm::normalize(points[std::min(i + 1, points.size() - 1)] - points[i > 0 ? i - 1 : 0]);
    const glm::dvec3 forward(0, 0, 1);
    const glm::dvec3 front = glm::normalize(forward - glm::dot(forward, along) * along);
    const glm::dvec3 across = glm::cross(along, front);
    for (int corner = 0; corner < kAround; ++corner) {
      const double angle = CornerAngle(corner, kAround);
      add(points[i] + rope.radius_cm * (std::cos(angle) * front + std::sin(angle) * across));
    }
  }
  add(points.back() + rope.radius_cm * glm::normalize(points.back() - points[points.size() - 2]));
  CloseRings(piece, kAround);
  return piece;
}

CharacterBuilder::CharacterBuilder(std::string name, const BodyPose& rest) : rest_(rest) {
  character_.name = std::move(name);
  character_.skeleton = BodySkeleton(rest);
}

int CharacterBuilder::AddMaterial(std::string name, Rgb8 colour) {
  const int material = static_cast<int>(character_.materials.size());
  SkinnedMesh mesh{.name = name, .material = material, .bindings = {}, .vertices = {}, .triangles = {}};
  // Bindings have the indices of the roles; at rest, all joints have the world's axes.
  for (const Role role : AllRoles()) {
    glm::dmat4 inverse_bind(1);
    inverse_bind[3] = glm::dvec4(-rest_[role], 1);
    mesh.bindings.push_back({static_cast<int>(Index(role)), inverse_bind});
  }
  character_.meshes.push_back(std::move(mesh));
  character_.materials.push_back(
      {std::move(name), {LinearOfSrgb(colour.r), LinearOfSrgb(colour.g), LinearOfSrgb(colour.b)}});
  return material;
}

void CharacterBuilder::Add(int material, const Piece& piece) {
  SkinnedMesh& mesh = character_.meshes[material];
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const std::vector<glm::dvec3> normals = Normals(piece);
  for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
    const Piece::Vertex& vertex = piece.vertices[i];
    SkinnedMesh::Vertex& bound = mesh.vertices.emplace_back();
    bound.position = vertex.position;
    bound.normal = normals[i];
    for (std::size_t k = 0; k < vertex.joints.size(); ++k) {
      bound.bindings[k] = static_cast<int>(Index(vertex.joints[k]));
      bound.weights[k] = vertex.weights[k];
    }
  }
  for (const auto& [a, b, c] : piece.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

void CharacterBuilder::AddOnBothSides(int material, const Piece& piece) {
  Add(material, piece);
  Add(material, MirrorImage(piece));
}

}  // namespace etude
