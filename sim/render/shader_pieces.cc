#include "sim/render/shaders.h"

namespace etude {

const char* const kRoomGeometry = R"glsl(
uniform mat3 ray_of_pixel;  // (u, v, 1) -> direction in E, of length 1 along the viewing axis
uniform vec3 eye;           // the camera's centre in the world
uniform vec3 lamp;          // in the world
uniform float wall_z;

const float kInfinity = uintBitsToFloat(0x7f800000u);

vec3 PixelRay() { return ray_of_pixel * vec3(gl_FragCoord.xy, 1.0); }

struct RoomHit {
  float depth;  // along the viewing axis; infinity if the ray hits nothing
  bool is_wall;
};

RoomHit MeetRoom(vec3 ray) {
  float floor_depth = ray.y < 0.0 && eye.y > 0.0 ? -eye.y / ray.y : kInfinity;
  float wall_depth = ray.z < 0.0 && eye.z > wall_z ? (wall_z - eye.z) / ray.z : kInfinity;
  return RoomHit(min(floor_depth, wall_depth), wall_depth < floor_depth);
}

// The light on a room's surface: x = the part without the lamp, which remains in shadow; y = the lamp's part.
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
uniform vec3 key_colour;
uniform vec3 ambient_colour;
uniform vec3 fill_direction;
uniform vec3 fill_colour;
uniform vec3 window;  // in the world
uniform vec3 window_colour;

// `point` in E, `normal` unit. An alpha of 0 marks the pixel as drawn (FrameTargets).
vec4 LitPaint(vec3 skin, vec3 normal, vec3 point, vec3 ray) {
  vec3 to_lamp = normalize(lamp - eye - point);
  float facing = max(-dot(normal, normalize(ray)), 0.0);
  float sky = 0.5 + 0.5 * normal.y;
  float sun = max((dot(normal, to_lamp) + 0.2) / 1.2, 0.0);
  float rim = (1.0 - facing) * (1.0 - facing) * (1.0 - facing);
  vec3 light = (0.36 + 0.18 * sky) * ambient_colour + 0.52 * sun * key_colour;
  light += max(dot(normal, fill_direction), 0.0) * fill_colour;
  vec3 to_window = window - eye - point;
  float square = dot(to_window, to_window);
  light += max(dot(normal, to_window), 0.0) * inversesqrt(square) * 6.0 / (3.0 + square) * window_colour;
  return vec4((skin * light + 0.12 * rim * sky) * brightness, 0.0);
}
)glsl";

const char* const kRoomInFront = R"glsl(
uniform sampler2D kept_room;
uniform float farthest;

// Returns true if the empty room hides a point at that depth in this pixel.
bool IsBehindRoom(float depth) {
  return texelFetch(kept_room, ivec2(gl_FragCoord.xy), 0).a / farthest <= depth / farthest;
}
)glsl";

const char* const kShadowLight = R"glsl(
uniform sampler2D kept_room;
uniform float brightness;

// The alpha of 0.5 marks a shadow (FrameTargets). `point` is the point of the room, in the eye's frame E. `inside` is
// the depth of the light's path inside the body: 0 at its skin, 1 through its middle. The shadow is full from
// `softness` on; its outermost edge is where the label ends.
vec4 RoomInShadow(RoomHit hit, vec3 point, float inside, float softness) {
  vec2 light = RoomLight(eye + point, RoomNormal(hit.is_wall));
  float left_over = 1.0 - smoothstep(0.0, softness, inside) * light.y / (light.x + light.y);
  vec3 room = texelFetch(kept_room, ivec2(gl_FragCoord.xy), 0).rgb;
  return vec4(room * (brightness * left_over), 0.5);
}
)glsl";

const char* const kCapsuleBox = R"glsl(
in vec4 start_and_radius;  // in E
in vec4 end_and_label;
in vec4 paint_in;          // rgb; a = 1 for a head with a face
in vec3 front_in;          // direction of the face

uniform mat3 image_of_direction;  // E -> (u w, v w, w)
uniform vec2 image_size;

flat out vec4 capsule_start;
flat out vec4 capsule_end;
flat out vec4 paint;
flat out vec3 front;

vec3 BoxCorner() {
  vec3 start = start_and_radius.xyz, end = end_and_label.xyz;
  float radius = 1.01 * start_and_radius.w;
  float span = distance(start, end);
  vec3 along = span > 0.0 ? (end - start) / span : vec3(0.0, 1.0, 0.0);
  vec3 across = normalize(cross(along, abs(along.y) < 0.7 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
  vec3 third = cross(along, across);
  int bit = 1 << gl_VertexID;
  vec3 side = vec3((0x287a & bit) != 0, (0x02af & bit) != 0, (0x31e3 & bit) != 0) * 2.0 - 1.0;
  return 0.5 * (start + end) + along * side.x * (0.5 * span + radius) + (across * side.y + third * side.z) * radius;
}

void Place(vec3 point) {
  vec3 image = image_of_direction * point;
  // Row 0 of the framebuffer is the picture's top row, so nothing is flipped. Depth is written per pixel; z = 0 keeps
  // near boxes from being clipped.
  gl_Position = vec4(2.0 * image.xy / image_size - image.z, 0.0, image.z);
  capsule_start = start_and_radius;
  capsule_end = end_and_label;
  paint = paint_in;
  front = front_in;
}
)glsl";

const char* const kStudioPaint = R"glsl(
uniform vec4 floor_tiles[64];
uniform vec4 wall_tiles[64];

int Wrap(float tile) { return int(tile - 8.0 * floor(tile / 8.0)); }

// The studio's hues are between 150 and 230 degrees; those of people are not (stage/palette.h).
vec3 SpotPaint(float tone, bool is_wall) {
  float pick = fract(tone * 7.0);
  if (!is_wall) return mix(vec3(0.26, 0.50, 0.62), vec3(0.34, 0.60, 0.64), pick);
  if (pick < 0.34) return vec3(0.24, 0.58, 0.48);
  if (pick < 0.67) return vec3(0.28, 0.48, 0.72);
  return vec3(0.44, 0.74, 0.74);
}

vec3 StudioPaint(vec2 place, bool is_wall, float blur) {
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
)glsl";

std::string AssembleShader(std::initializer_list<const char*> pieces) {
  std::string source = "#version 330 core\n";
  for (const char* piece : pieces) source += piece;
  return source;
}

const char* const kPaintPatterns = R"glsl(
uniform vec4 paint_first[64];   // rgb; a = pattern
uniform vec4 paint_second[64];  // rgb; a = size in metres
uniform vec4 paint_patch[64];   // x, y, half width (negative: cloth without a patch), half height

float Hash(ivec3 cell) {
  uint h = uint(cell.x) * 73856093u ^ uint(cell.y) * 19349663u ^ uint(cell.z) * 83492791u;
  h = (h ^ (h >> 13u)) * 0x5bd1e995u;
  return float((h ^ (h >> 15u)) & 0xffffu) / 65535.0;
}

// Returns 1 in every second half of `period`, 0 in the others, smoothed over `blur`, the width of a pixel there.
float Bands(float place, float period, float blur) {
  float edge = clamp(2.0 * blur / period, 0.001, 0.5);
  return smoothstep(0.5 - edge, 0.5 + edge, abs(2.0 * fract(place / period) - 1.0));
}

// Returns the brightness of a dark line at 0 with half width `half_width`.
float Line(float place, float half_width, float blur) {
  return (1.0 - smoothstep(half_width, half_width + blur, abs(place))) * half_width / (half_width + 0.5 * blur);
}
)glsl";

const char* const kRoomPatterns = R"glsl(
float RoomPattern(int pattern, vec3 place, float size, float blur, inout float tone) {
  float share = 0.0;
  if (pattern == 5) {
    float lane = floor(place.x / size);
    float along = place.y / (9.0 * size) + Hash(ivec3(int(lane), 7, 1));
    share = Hash(ivec3(int(lane), int(floor(along)), 3));
    vec2 within = vec2(fract(place.x / size) * size, fract(along) * 9.0 * size);
    within = min(within, vec2(size, 9.0 * size) - within);
    float joint = max(Line(within.x, 0.002, blur), Line(within.y, 0.002, blur));
    tone = (1.0 - 0.35 * joint) * (0.97 + 0.06 * Hash(ivec3(int(floor(place.x / 0.011)), int(floor(along * 3.0)), 5)));
  } else if (pattern == 6) {
    vec2 cell = floor(place.xy / size), within = (place.xy / size - cell) * size;
    share = Hash(ivec3(ivec2(cell), 11));
    vec2 border = min(within, size - within);
    tone = 1.0 - 0.3 * (1.0 - smoothstep(0.003, 0.003 + blur, min(border.x, border.y)));
  } else if (pattern == 7) {
    ivec3 cell = ivec3(floor(place / size));
    share = Hash(cell) / (1.0 + 2.0 * blur / size) + 0.5 - 0.5 / (1.0 + 2.0 * blur / size);
  } else if (pattern == 8) {
    vec2 cell = floor(place.xy / (size * vec2(1.0, 1.7)));
    share = Hash(ivec3(ivec2(cell), 13));
    tone = 0.75 + 0.25 * Hash(ivec3(ivec2(cell), 17));
  }
  return share;
}
)glsl";

// Shaders execute every branch, so the shader for clothes leaves out the patterns of rooms.
const char* const kNoRoomPatterns = R"glsl(
float RoomPattern(int pattern, vec3 place, float size, float blur, inout float tone) { return 0.0; }
)glsl";

const char* const kPainted = R"glsl(
vec3 Painted(int index, vec3 place, float blur) {
  vec4 first = paint_first[index], second = paint_second[index], patch_at = paint_patch[index];
  int pattern = int(first.a + 0.5);
  float size = second.a, share = 0.0, tone = 1.0;
  if (pattern == 1) {
    share = Bands(place.y, size, blur);
  } else if (pattern == 2) {
    share = Bands(place.x + place.z, size, blur);
  } else if (pattern == 3) {
    share = 0.5 * (Bands(place.y, size, blur) + Bands(place.x + place.z, size, blur));
  } else if (pattern == 4) {
    share = 1.0 - smoothstep(size - blur, size + blur, place.y);
  } else if (pattern > 4) {
    share = RoomPattern(pattern, place, size, blur, tone);
  }
  if (abs(patch_at.z) > 0.0 && place.z > 0.0 && patch_at.w > 0.0) {
    vec2 inside = abs(patch_at.zw) - abs(place.xy - patch_at.xy);
    share = mix(share, 1.0, smoothstep(-blur, blur, min(inside.x, inside.y)));
  }
  if (patch_at.z < 0.0) {
    // Darken seams along the sides and the middle, and soft creases; both move with the body.
    tone *= 1.0 - 0.30 * max(Line(place.z, 0.0025, blur), place.z > 0.0 ? Line(place.x, 0.002, blur) : 0.0);
    tone *= 1.0 + 0.07 * sin(41.0 * place.y + 9.0 * sin(13.0 * (place.x + place.z))) *
                      sin(23.0 * (place.x - place.z) + 5.0 * place.y);
  }
  return mix(first.rgb, second.rgb, share) * tone;
}
)glsl";

}  // namespace etude
