#pragma once

#include <initializer_list>
#include <string>

namespace etude {

// The GLSL programs. Room and capsules work per pixel: a pixel's viewing ray meets planes and capsules in closed form,
// so edges, labels and depths are exact. Surfaces are triangles, drawn as such.
//
// Frame E: the world's axes, with the origin at the camera's centre (keeps floats small).

/// Draws a triangle that covers the whole picture.
std::string FullScreenVertexShader();
/// Paints the empty room: RGB = its colour at brightness 1, A = its depth. Drawn once per camera, then kept.
std::string RoomFragmentShader();
/// Paints a furnished room likewise. Both also write RGB = the share of the lamp in the light, A = the label.
std::string InteriorFragmentShader();

/// Draws a box around each capsule, only to find the pixels worth asking.
std::string CapsuleVertexShader();
/// Paints the skin of capsules, with hair, eyes and a smile, or without them, which is faster.
std::string CapsuleFragmentShader(bool with_face);

/// The cover of a surface; the simpler, the faster.
enum class Skin { kColour, kPaint, kTexture };

/// Draw the triangles of surfaces.
std::string SurfaceVertexShader();
std::string SurfaceFragmentShader(Skin skin);
/// Draw the same triangles, thrown from the lamp onto the floor or the wall.
std::string SurfaceShadowVertexShader();
std::string SurfaceShadowFragmentShader();
/// Returns a shader that only marks where shadows fall (Overlay::kShadow).
std::string ShadowMarkFragmentShader();

// GLSL that several programs share.

/// The pixel's ray, where it meets the empty room, and the room's light.
extern const char* const kRoomGeometry;
/// Defines `vec4 LitPaint(paint, normal, point, ray)`, the light of the lamp and of the room on people. Comes after
/// kRoomGeometry.
extern const char* const kBodyLight;
/// Defines `bool IsBehindRoom(depth)`, which tells whether the empty room hides that depth of the pixel; has the
/// uniform `farthest`.
extern const char* const kRoomInFront;
/// Defines `vec4 RoomInShadow(hit, point, inside, softness)`, a pixel of the room that a body darkens. Comes after
/// kRoomGeometry.
extern const char* const kShadowLight;

/// Defines a vertex shader's `vec3 BoxCorner()`, one of the 14 of the strip that is a box around a capsule, and `void
/// Place(point)`. One instance per capsule (CapsuleInstance).
extern const char* const kCapsuleBox;
/// Defines `vec3 StudioPaint(place, is_wall, blur)`, the studio's tiles and spots.
extern const char* const kStudioPaint;
/// These four define `vec3 Painted(index, place, blur)`, the patterns of SurfacePaint: what the patterns share, those
/// of rooms or nothing in their place, and the function itself.
extern const char* const kPaintPatterns;
extern const char* const kRoomPatterns;
extern const char* const kNoRoomPatterns;
extern const char* const kPainted;

/// Puts the source of one shader together, with the version first.
std::string AssembleShader(std::initializer_list<const char*> pieces);

}  // namespace etude
