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

/// A piece of a character: a surface on the body at rest (metres), and the joints that move it.
struct Piece {
  struct Vertex {
    glm::dvec3 position{0};
    std::array<Role, 2> joints{};
    std::array<double, 2> weights{1, 0};  ///< the weights of the two joints that move the vertex; sum 1
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< three vertices each, counter-clockwise seen from outside
};

/// Returns the mirror image of a piece for the body's other side.
Piece MirrorImage(const Piece& piece);

/// An ellipsoid that moves with one joint. Lengths are in centimetres; axes belong to the body at rest: left, up,
/// forward.
struct Blob {
  std::string name;
  Role joint;
  glm::dvec3 centre_cm;    ///< position relative to the joint
  glm::dvec3 half_cm;      ///< half sizes along the three axes, before the tilt
  glm::dvec3 tilt_deg{0};  ///< rotation about the axes left, then up, then forward
  /// The minimum height of vertices above the floor: it gives a foot a flat sole.
  double sole_cm = -std::numeric_limits<double>::infinity();
  int around = 16;  ///< number of corners around the equator; from pole to pole there are half as many rings
};
Piece MakePiece(const Blob& blob, const BodyPose& rest);

/// A tube with round ends along a chain of joints; lengths in centimetres. Every section between two joints moves with
/// its first joint; around the joints between sections, the skin is blended.
struct Tube {
  struct Ring {
    double along_cm;      ///< distance from the first joint; may lie before the first and behind the last joint
    double side_cm;       ///< half the width, seen from the front
    double front_cm;      ///< half the depth
    double ahead_cm = 0;  ///< forward offset from the chain
  };
  std::string name;
  std::vector<Role> chain;  ///< the joints along the tube; with a single joint, the tube goes straight up from it
  std::vector<Ring> rings;  ///< rings in ascending order of `along_cm`
  double blend_cm = 0;      ///< half the length over which the skin is blended between two joints
  double first_cap_cm = 0;  ///< lengths of the round ends beyond the first and last ring
  double last_cap_cm = 0;
  int around = 16;  ///< number of corners around a ring
};
Piece MakePiece(const Tube& tube, const BodyPose& rest);

/// A thin oval sheet on the front of a tube. Its edge lies inside the tube, and the sheet moves with the tube's skin.
struct Patch {
  std::string name;
  double along_cm;        ///< position of the centre along the tube
  double half_along_cm;   ///< half the length of the patch along the tube
  double half_angle_deg;  ///< half the angle that the patch covers around the tube
  double lift_cm;         ///< height above the tube's skin
};
Piece MakePiece(const Patch& patch, const Tube& tube, const BodyPose& rest);

/// A thin rope along points that are given in centimetres from a joint. The rope moves with this joint.
struct Rope {
  std::string name;
  Role joint;
  std::vector<glm::dvec3> points_cm;
  double radius_cm;
};
Piece MakePiece(const Rope& rope, const BodyPose& rest);

/// Combines pieces into a character bound to BodySkeleton(rest): one mesh per material. Normals are smooth within a
/// piece, but not between pieces.
class CharacterBuilder {
 public:
  CharacterBuilder(std::string name, const BodyPose& rest);

  /// Adds a material with a colour in sRGB; returns the material's index for `Add`.
  int AddMaterial(std::string name, Rgb8 colour);
  /// Adds a piece; `material` is an index from AddMaterial.
  void Add(int material, const Piece& piece);
  /// Adds a piece, and its mirror image on the other side.
  void AddOnBothSides(int material, const Piece& piece);

  Character Take() && { return std::move(character_); }

 private:
  BodyPose rest_;
  Character character_;
};

}  // namespace etude
