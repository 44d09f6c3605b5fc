#include "sim/render/shader_pieces.h"
#include "sim/render/shaders.h"

namespace etude {
namespace {

constexpr const char* kFullScreen = R"glsl(
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }
)glsl";

constexpr const char* kRoomPaint = R"glsl(
uniform vec4 floor_tiles[64];
uniform vec4 wall_tiles[64];
uniform float pixel_angle;  // the width of a pixel at depth 1

out vec4 room;

int Wrap(float tile) { return int(tile - 8.0 * floor(tile / 8.0)); }

// Hues stay between 140 and 240 degrees: people wear the others.
vec3 SpotPaint(float tone, bool is_wall) {
  float pick = fract(tone * 7.0);
  if (!is_wall) return mix(vec3(0.26, 0.50, 0.62), vec3(0.34, 0.60, 0.64), pick);
  if (pick < 0.34) return vec3(0.24, 0.58, 0.48);
  if (pick < 0.67) return vec3(0.28, 0.48, 0.72);
  return vec3(0.44, 0.74, 0.74);
}

vec3 Paint(vec2 place, bool is_wall, float blur) {
  float size = is_wall ? 0.85 : 0.6;
  vec2 tile = floor(place / size);
  vec2 within = place / size - tile;
  int index = Wrap(tile.x) + 8 * Wrap(tile.y);
  vec4 pattern = is_wall ? wall_tiles[index] : floor_tiles[index];
  blur /= size;

  vec3 paint = is_wall ? mix(vec3(0.34, 0.62, 0.62), vec3(0.36, 0.56, 0.68), pattern.w)
                       : mix(vec3(0.30, 0.42, 0.62), vec3(0.36, 0.48, 0.70), pattern.w);
  float spot = 1.0 - smoothstep(-blur, blur, distance(within, pattern.xy) - pattern.z);
  paint = mix(paint, SpotPaint(pattern.w, is_wall), pattern.z > 0.0 ? 0.85 * spot : 0.0);

  float to_joint = min(min(within.x, 1.0 - within.x), min(within.y, 1.0 - within.y));
  float joint = 1.0 - smoothstep(-blur, blur, to_joint - 0.008);
  return paint * (1.0 - (is_wall ? 0.10 : 0.20) * joint);
}

void main() {
  vec3 ray = PixelRay();
  RoomHit hit = MeetRoom(ray);
  if (hit.depth == kInfinity) {
    room = vec4(0.30, 0.40, 0.50, kInfinity);
    return;
  }
  vec3 point = eye + hit.depth * ray;
  vec2 light = RoomLight(point, RoomNormal(hit.is_wall));
  float blur = 0.7 * hit.depth * pixel_angle;
  vec3 paint = Paint(hit.is_wall ? point.xy : point.xz, hit.is_wall, blur);
  // A skirting board ends the wall.
  if (hit.is_wall) paint *= 1.0 - 0.35 * (1.0 - smoothstep(-blur, blur, point.y - 0.09));
  room = vec4(paint * (light.x + light.y), hit.depth);
}
)glsl";

constexpr const char* kBackdrop = R"glsl(
uniform sampler2D kept_room;
uniform float brightness;

layout(location = 0) out vec4 colour;
layout(location = 1) out uint label;
layout(location = 2) out float depth;

void main() {
  vec4 room = texelFetch(kept_room, ivec2(gl_FragCoord.xy), 0);
  colour = vec4(room.rgb * brightness, 1.0);
  label = 0u;
  depth = room.a;
}
)glsl";

}  // namespace

std::string FullScreenVertexShader() { return AssembleShader({kFullScreen}); }
std::string RoomFragmentShader() { return AssembleShader({kRoomGeometry, kRoomPaint}); }
std::string BackdropFragmentShader() { return AssembleShader({kBackdrop}); }

}  // namespace etude
