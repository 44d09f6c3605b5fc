#include "sim/render/shader_pieces.h"

namespace etude {

const char* const kRoomGeometry = R"glsl(
uniform mat3 ray_of_pixel;  // (u, v, 1) -> direction in E, of length 1 along the viewing axis
uniform vec3 eye;           // the camera's centre in the world
uniform vec3 lamp;          // in the world
uniform float wall_z;

const float kInfinity = uintBitsToFloat(0x7f800000u);

vec3 PixelRay() { return ray_of_pixel * vec3(gl_FragCoord.xy, 1.0); }

struct RoomHit {
  float depth;  // along the viewing axis; infinity when nothing is met
  bool is_wall;
};

RoomHit MeetRoom(vec3 ray) {
  float floor_depth = ray.y < 0.0 && eye.y > 0.0 ? -eye.y / ray.y : kInfinity;
  float wall_depth = ray.z < 0.0 && eye.z > wall_z ? (wall_z - eye.z) / ray.z : kInfinity;
  return RoomHit(min(floor_depth, wall_depth), wall_depth < floor_depth);
}

// The light of a room's surface: x = what is left in shadow, y = what the lamp adds.
vec2 RoomLight(vec3 point, vec3 normal) {
  vec3 to_lamp = lamp - point;
  float square = dot(to_lamp, to_lamp);
  float slant = max(dot(normal, to_lamp) / sqrt(square), 0.0);
  return vec2(0.54, 1.05 * slant * 60.0 / (50.0 + square));
}

vec3 RoomNormal(bool is_wall) { return is_wall ? vec3(0.0, 0.0, 1.0) : vec3(0.0, 1.0, 0.0); }
)glsl";

const char* const kBodyLight = R"glsl(
uniform float brightness;

// `point` in E, `normal` unit.
vec4 LitPaint(vec3 skin, vec3 normal, vec3 point, vec3 ray) {
  vec3 to_lamp = normalize(lamp - eye - point);
  float facing = max(-dot(normal, normalize(ray)), 0.0);
  float sky = 0.5 + 0.5 * normal.y;
  float sun = max((dot(normal, to_lamp) + 0.2) / 1.2, 0.0);
  float rim = (1.0 - facing) * (1.0 - facing) * (1.0 - facing);
  float light = 0.36 + 0.18 * sky + 0.52 * sun;
  return vec4((skin * light + 0.12 * rim * sky) * brightness, 1.0);
}
)glsl";

const char* const kShadowLight = R"glsl(
uniform sampler2D kept_room;
uniform float brightness;

// `point` of the room in E; `inside` = how deep the light's way runs inside the body: 0 at its skin, 1 through its
// middle; `softness` = from where on the shadow is full. The outermost edge is where the label ends.
vec4 RoomInShadow(RoomHit hit, vec3 point, float inside, float softness) {
  vec2 light = RoomLight(eye + point, RoomNormal(hit.is_wall));
  float left_over = 1.0 - smoothstep(0.0, softness, inside) * light.y / (light.x + light.y);
  vec3 room = texelFetch(kept_room, ivec2(gl_FragCoord.xy), 0).rgb;
  return vec4(room * (brightness * left_over), 1.0);
}
)glsl";

std::string AssembleShader(std::initializer_list<const char*> pieces) {
  std::string source = "#version 330 core\n";
  for (const char* piece : pieces) source += piece;
  return source;
}

}  // namespace etude
