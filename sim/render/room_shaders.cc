#include "sim/render/shader_pieces.h"
#include "sim/render/shaders.h"

namespace etude {
namespace {

constexpr const char* kFullScreen = R"glsl(
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }
)glsl";

constexpr const char* kRoomPaint = R"glsl(
uniform float pixel_angle;  // the width of a pixel at depth 1

layout(location = 0) out vec4 room;   // rgb, depth
layout(location = 1) out vec4 extra;  // rgb = the lamp's share of the light; a = label

void main() {
  vec3 ray = PixelRay();
  RoomHit hit = MeetRoom(ray);
  if (hit.depth == kInfinity) {
    room = vec4(0.30, 0.40, 0.50, kInfinity);
    extra = vec4(0.0);
    return;
  }
  vec3 point = eye + hit.depth * ray;
  vec2 light = RoomLight(point, RoomNormal(hit.is_wall));
  float blur = 0.7 * hit.depth * pixel_angle;
  vec3 paint = StudioPaint(hit.is_wall ? point.xy : point.xz, hit.is_wall, blur);
  // A skirting board ends the wall.
  if (hit.is_wall) paint *= 1.0 - 0.35 * (1.0 - smoothstep(-blur, blur, point.y - 0.09));
  room = vec4(paint * (light.x + light.y), hit.depth);
  extra = vec4(vec3(light.y / (light.x + light.y)), 0.0);
}
)glsl";

}  // namespace

std::string FullScreenVertexShader() { return AssembleShader({kFullScreen}); }
std::string RoomFragmentShader() { return AssembleShader({kRoomGeometry, kStudioPaint, kRoomPaint}); }

}  // namespace etude
