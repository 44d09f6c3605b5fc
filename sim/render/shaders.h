#pragma once

#include <string>

namespace etude {

// The GLSL programs. Room and capsules work per pixel: a pixel's viewing ray meets planes and capsules in closed form,
// so edges, labels and depths are exact. Surfaces are triangles, drawn as such.
//
// Frame E: the world's axes, with the origin at the camera's centre (keeps floats small).

/// Covers the whole picture.
std::string FullScreenVertexShader();
/// The empty room: RGB = its colour at brightness 1, A = its depth. Drawn once per camera, then kept.
std::string RoomFragmentShader();
/// The same of a furnished room. Both also write RGB = the share of the lamp in the light, A = the label.
std::string InteriorFragmentShader();

/// A box around each capsule, drawn only to find the pixels worth asking.
std::string CapsuleVertexShader();
/// With hair, eyes and a smile, or without, which is faster.
std::string CapsuleFragmentShader(bool with_face);

/// What covers a surface: the simpler, the faster.
enum class Skin { kColour, kPaint, kTexture };

/// The triangles of surfaces.
std::string SurfaceVertexShader();
std::string SurfaceFragmentShader(Skin skin);
/// The same triangles, thrown from the lamp onto the floor or the wall.
std::string SurfaceShadowVertexShader();
std::string SurfaceShadowFragmentShader();

}  // namespace etude
