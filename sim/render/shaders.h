#pragma once

#include <initializer_list>
#include <string>

namespace etude {

// The GLSL programs. Rooms and capsules are computed per pixel: the pixel's viewing ray is intersected with planes and
// capsules in closed form, so edges, labels and depths are exact. Surfaces are drawn as triangles.
//
// Frame E: the world's axes, with the origin at the camera's centre (keeps floats small).

/// A triangle that covers the whole picture.
std::string FullScreenVertexShader();
/// Paints the empty studio: RGB = its colour at brightness 1, A = its depth. The result is kept per camera.
std::string RoomFragmentShader();
/// Paints a furnished room in the same way. Both also write RGB = the lamp's share of the light, A = the label.
std::string InteriorFragmentShader();

/// Draws a box around each capsule, which selects the pixels to compute.
std::string CapsuleVertexShader();
/// Paints the surface of capsules, with or without hair, eyes and a smile; without is faster.
std::string CapsuleFragmentShader(bool with_face);

/// How a surface is coloured. The fragment shader of kColour is the fastest.
enum class Skin { kColour, kPaint, kTexture };

/// Draw the triangles of surfaces.
std::string SurfaceVertexShader();
std::string SurfaceFragmentShader(Skin skin);
/// Draw the same triangles projected from the lamp onto the floor or the wall.
std::string SurfaceShadowVertexShader();
std::string SurfaceShadowFragmentShader();
/// Returns a shader that only marks shadows (Overlay::kShadow).
std::string ShadowMarkFragmentShader();

// GLSL code that several programs share.

/// The pixel's ray, its intersection with the empty room, and the room's light.
extern const char* const kRoomGeometry;
/// Defines `vec4 LitPaint(paint, normal, point, ray)`, the light of lamp and room on people. Must follow kRoomGeometry.
extern const char* const kBodyLight;
/// Defines `bool IsBehindRoom(depth)`, which is true if the empty room hides that depth at the pixel; declares the
/// uniform `farthest`.
extern const char* const kRoomInFront;
/// Defines `vec4 RoomInShadow(hit, point, inside, softness)`, a pixel of the room in a body's shadow. Must follow
/// kRoomGeometry.
extern const char* const kShadowLight;

/// For a vertex shader: defines `vec3 BoxCorner()`, one of the 14 corners of the strip that forms a box around a
/// capsule, and `void Place(point)`. There is one instance per capsule (CapsuleInstance).
extern const char* const kCapsuleBox;
/// Defines `vec3 StudioPaint(place, is_wall, blur)`, the studio's tiles and spots.
extern const char* const kStudioPaint;
/// These four define `vec3 Painted(index, place, blur)`, the patterns of SurfacePaint: code that all patterns share,
/// the patterns of rooms or an empty replacement, and the function itself.
extern const char* const kPaintPatterns;
extern const char* const kRoomPatterns;
extern const char* const kNoRoomPatterns;
extern const char* const kPainted;

/// Concatenates the source of one shader, with the version first.
std::string AssembleShader(std::initializer_list<const char*> pieces);

}  // namespace etude
