#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <vector>

#include "engine/base/image.h"
#include "engine/motion/body.h"
#include "engine/motion/character.h"

namespace etude {

/// A piece of a character: a surface on the body at rest (metres), and which joints move it.
struct Piece {
  struct Vertex {
    glm::dvec3 position{0};
    std::array<Role, 2> joints{};
    std::array<double, 2> weights{1, 0};  ///< sum to 1
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
};

/// Returns the mirror image of a piece, for the body's other side.
Piece MirrorImage(const Piece& piece);

/// A rounded body that moves with one joint; lengths in centimetres, axes as the body at rest: left, up, forward.
struct Blob {
  std::string name;
  Role joint;
  glm::dvec3 centre_cm;    ///< from the joint
  glm::dvec3 half_cm;      ///< half its size along the three axes, before it is tilted
  glm::dvec3 tilt_deg{0};  ///< about left, then up, then forward
  /// The lowest height above the floor, for a foot's flat sole.
  double sole_cm = -std::numeric_limits<double>::infinity();
  int around = 16;  ///< corners of its equator; half as many rings from pole to pole
};
Piece MakePiece(const Blob& blob, const BodyPose& rest);

/// A tube along a chain of joints, round at both ends; lengths in centimetres. Every stretch moves with the joint at
/// its beginning; across the joints between, the skin passes gradually from one to the next.
struct Tube {
  struct Ring {
    double along_cm;      ///< from the first joint on; before the first and behind the last joint too
    double side_cm;       ///< half its width, as seen from the front
    double front_cm;      ///< half its depth
    double ahead_cm = 0;  ///< of the chain, forward
  };
  std::string name;
  std::vector<Role> chain;  ///< of a single joint: straight up from there
  std::vector<Ring> rings;  ///< in order
  double blend_cm = 0;      ///< half the length over which the skin passes from joint to joint
  double first_cap_cm = 0;  ///< lengths of the round ends, beyond the first and last ring
  double last_cap_cm = 0;
  int around = 16;  ///< corners of a ring
};
Piece MakePiece(const Tube& tube, const BodyPose& rest);

/// A thin oval sheet on a tube's front, its edge tucked under the tube's skin, with which it moves.
struct Patch {
  std::string name;
  double along_cm;        ///< its centre, along the tube
  double half_along_cm;   ///< half its length
  double half_angle_deg;  ///< half the angle that it takes of the tube's round
  double lift_cm;         ///< above the tube's skin
};
Piece MakePiece(const Patch& patch, const Tube& tube, const BodyPose& rest);

/// A thin rope through points, which moves with one joint; centimetres from the joint.
struct Rope {
  std::string name;
  Role joint;
  std::vector<glm::dvec3> points_cm;
  double radius_cm;
};
Piece MakePiece(const Rope& rope, const BodyPose& rest);

/// Puts pieces together to a character bound to BodySkeleton(rest): one mesh per material, normals smoothed within
/// each piece.
class CharacterBuilder {
 public:
  CharacterBuilder(std::string name, const BodyPose& rest);

  /// Adds a material of a colour in sRGB; returns the number to add pieces with.
  int AddMaterial(std::string name, Rgb8 colour);
  void Add(int material, const Piece& piece);
  /// Adds a piece and its mirror image on the other side.
  void AddOnBothSides(int material, const Piece& piece);

  Character Take() && { return std::move(character_); }

 private:
  BodyPose rest_;
  Character character_;
};

}  // namespace etude
