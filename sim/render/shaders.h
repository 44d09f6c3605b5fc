#pragma once

#include <initializer_list>
#include <string>

namespace etude {

// The GLSL programs. Rooms and capsules are computed per pixel: the pixel's viewing ray is intersected with planes and
// capsules in closed form, so edges, labels and depths are exact. Surfaces are drawn as triangles.
//
// Frame E has the world's axes and its origin at the camera's centre, which keeps floats small.

/// Draws one triangle that covers the whole picture.
std::string FullScreenVertexShader();
/// Paints the empty studio: RGB = colour at brightness 1, A = depth. The picture is kept for each camera.
std::string RoomFragmentShader();
/// Paints a furnished room: RGB = colour at brightness 1, A = depth. Like RoomFragmentShader, it also writes RGB = the
/// lamp's share of the light, A = the label.
std::string InteriorFragmentShader();

/// Draws a box around each capsule. The fragment shader then computes only the pixels of this box.
std::string CapsuleVertexShader();
/// Paints the surface of capsules. With `with_face`, the head has hair, eyes and a smile, which is slower.
std::string CapsuleFragmentShader(bool with_face);

/// The way in which a surface is coloured. The fragment shader of kColour is the fastest.
enum class Skin { kColour, kPaint, kTexture };

/// These two shaders draw the triangles of surfaces.
std::string SurfaceVertexShader();
std::string SurfaceFragmentShader(Skin skin);
/// These two shaders draw the triangles of surfaces, projected from the lamp onto the floor or the wall.
std::string SurfaceShadowVertexShader();
std::string SurfaceShadowFragmentShader();
/// Returns a shader that only marks shadows (Overlay::kShadow).
std::string ShadowMarkFragmentShader();

// The GLSL code below is shared by several programs.

/// Defines the pixel's ray, the ray's intersection with the empty room, and the room's light.
extern const char* const kRoomGeometry;
/// Defines `vec4 LitPaint(paint, normal, point, ray)`, the light of lamp and room on people. It must follow
/// kRoomGeometry.
extern const char* const kBodyLight;
/// Defines `bool IsBehindRoom(depth)`, which is true if the empty room hides a point at that depth in the pixel.
/// Declares the uniform `farthest`.
extern const char* const kRoomInFront;
/// Defines `vec4 RoomInShadow(hit, point, inside, softness)`, the colour of a pixel of the room in a body's shadow. It
/// must follow kRoomGeometry.
extern const char* const kShadowLight;

/// For vertex shaders: defines `vec3 BoxCorner()`, one of the 14 corners of the strip that forms a box around a
/// capsule, and `void Place(point)`. There is one instance per capsule (CapsuleInstance).
extern const char* const kCapsuleBox;
/// Defines `vec3 StudioPaint(place, is_wall, blur)`, the tiles and spots of the studio.
extern const char* const kStudioPaint;
/// These four texts define `vec3 Painted(index, place, blur)`, the patterns of SurfacePaint: code for all patterns;
/// then either the patterns of rooms or an empty replacement; then the function itself.
extern const char* const kPaintPatterns;
extern const char* const kRoomPatterns;
extern const char* const kNoRoomPatterns;
extern const char* const kPainted;

/// Concatenates the source of one shader. The GLSL version comes first.
std::string AssembleShader(std::initializer_list<const char*> pieces);

}  // namespace etude
