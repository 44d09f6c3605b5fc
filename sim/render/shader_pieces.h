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

/// `float SquaredDistance(p1, q1, p2, q2)` of two segments.
extern const char* const kSegmentDistance;
/// `vec3 StudioPaint(place, is_wall, blur)`: the studio's tiles and spots.
extern const char* const kStudioPaint;
/// `vec3 Painted(index, place, blur)`: the patterns of paint.h.
extern const char* const kPaintPatterns;

/// One shader's source, version first.
std::string AssembleShader(std::initializer_list<const char*> pieces);

}  // namespace etude
