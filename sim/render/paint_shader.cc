#include "sim/render/shader_pieces.h"

namespace etude {

const char* const kPaintPatterns = R"glsl(
uniform vec4 paint_first[64];   // rgb; a = pattern
uniform vec4 paint_second[64];  // rgb; a = size in metres
uniform vec4 paint_patch[64];   // x, y, half width (negative: cloth without a patch), half height

float Hash(ivec3 cell) {
  uint h = uint(cell.x) * 73856093u ^ uint(cell.y) * 19349663u ^ uint(cell.z) * 83492791u;
  h = (h ^ (h >> 13u)) * 0x5bd1e995u;
  return float((h ^ (h >> 15u)) & 0xffffu) / 65535.0;
}

// 1 in every other half of `period`; `blur` is the width of a pixel there.
float Bands(float place, float period, float blur) {
  float edge = clamp(2.0 * blur / period, 0.001, 0.5);
  return smoothstep(0.5 - edge, 0.5 + edge, abs(2.0 * fract(place / period) - 1.0));
}

// A dark line of half width `half_width` at 0.
float Line(float place, float half_width, float blur) {
  return (1.0 - smoothstep(half_width, half_width + blur, abs(place))) * half_width / (half_width + 0.5 * blur);
}

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
  } else if (pattern == 5) {
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
  if (abs(patch_at.z) > 0.0 && place.z > 0.0 && patch_at.w > 0.0) {
    vec2 inside = abs(patch_at.zw) - abs(place.xy - patch_at.xy);
    share = mix(share, 1.0, smoothstep(-blur, blur, min(inside.x, inside.y)));
  }
  if (patch_at.z < 0.0) {
    // Seams down the sides and the middle, and soft creases, which bend with the body.
    tone *= 1.0 - 0.30 * max(Line(place.z, 0.0025, blur), place.z > 0.0 ? Line(place.x, 0.002, blur) : 0.0);
    tone *= 1.0 + 0.07 * sin(41.0 * place.y + 9.0 * sin(13.0 * (place.x + place.z))) *
                      sin(23.0 * (place.x - place.z) + 5.0 * place.y);
  }
  return mix(first.rgb, second.rgb, share) * tone;
}
)glsl";

}  // namespace etude
