#pragma once

#include <initializer_list>
#include <string>

namespace etude {

// GLSL that several programs share.

/// The pixel's ray, where it meets the empty room, and the room's light.
extern const char* const kRoomGeometry;
/// `vec4 LitPaint(paint, normal, point, ray)`: how the lamp and the room's light show on people. After kRoomGeometry.
extern const char* const kBodyLight;
/// `vec4 RoomInShadow(hit, point, inside, softness)`: a pixel of the room that a body darkens. After kRoomGeometry.
extern const char* const kShadowLight;

/// One shader's source, version first.
std::string AssembleShader(std::initializer_list<const char*> pieces);

}  // namespace etude
