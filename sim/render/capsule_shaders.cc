#include "sim/render/shader_pieces.h"
#include "sim/render/shaders.h"

namespace etude {
namespace {

constexpr const char* kBodyPlace = R"glsl(
void main() { Place(BoxCorner()); }
)glsl";

constexpr const char* kBody = R"glsl(
flat in vec4 capsule_start;
flat in vec4 capsule_end;
flat in vec4 paint;
flat in vec3 front;

layout(location = 0) out vec4 colour;
layout(location = 1) out uint label;
layout(location = 2) out float depth;

// The depth at which `ray` enters the capsule, or infinity. The ray's start is moved next to the
// capsule first: far away, the difference of squares would lose most of a float's digits.
float MeetCapsule(vec3 ray) {
  vec3 start = capsule_start.xyz, along = capsule_end.xyz - start;
  float radius = capsule_start.w;
  float square = dot(ray, ray);
  float shift = dot(start + 0.5 * along, ray) / square;
  vec3 origin = shift * ray - start;

  float along_along = dot(along, along), along_ray = dot(along, ray), along_origin = dot(along, origin);
  float a = along_along * square - along_ray * along_ray;
  float b = along_along * dot(origin, ray) - along_origin * along_ray;
  float c = along_along * (dot(origin, origin) - radius * radius) - along_origin * along_origin;
  float h = b * b - a * c;
  if (along_along > 0.0 && h < 0.0) return kInfinity;

  // First the endless cylinder; beyond its ends, the half-sphere of that end.
  float cylinder = -(b + sqrt(max(h, 0.0))) / max(a, 1e-20);
  float share = along_origin + cylinder * along_ray;
  if (along_along > 0.0 && share > 0.0 && share < along_along) return shift + cylinder;
  vec3 from_end = share <= 0.0 ? origin : origin - along;
  b = dot(from_end, ray);
  h = b * b - square * (dot(from_end, from_end) - radius * radius);
  return h < 0.0 ? kInfinity : shift - (b + sqrt(h)) / square;
}

vec3 Normal(vec3 point) {
  vec3 along = capsule_end.xyz - capsule_start.xyz, from_start = point - capsule_start.xyz;
  float share = clamp(dot(from_start, along) / max(dot(along, along), 1e-20), 0.0, 1.0);
  return (from_start - share * along) / capsule_start.w;
}

)glsl";

constexpr const char* kPlainSkin = R"glsl(
vec3 SkinPaint(vec3 point) { return paint.rgb; }
)glsl";

constexpr const char* kFaceSkin = R"glsl(
// Hair, eyes and a smile, so that one sees where the person looks.
vec3 FacePaint(vec3 skin, vec3 point) {
  vec3 middle = 0.5 * (capsule_start.xyz + capsule_end.xyz);
  vec3 upward = capsule_end.xyz - capsule_start.xyz;
  float height = length(upward);
  upward = height > 0.0 ? upward / height : vec3(0.0, 1.0, 0.0);
  vec3 forward = front - dot(front, upward) * upward;
  forward /= max(length(forward), 1e-6);
  vec3 place = (point - middle) / capsule_start.w;
  vec3 face = vec3(dot(place, cross(upward, forward)), dot(place, upward), dot(place, forward));

  if (face.y - 0.75 * face.z > 0.25) return vec3(0.26, 0.13, 0.08);
  if (face.z < 0.0) return skin;
  if (length(vec2(abs(face.x) - 0.36, 0.7 * (face.y - 0.05))) < 0.11) return vec3(0.16, 0.08, 0.06);
  float smile = abs(length(vec2(face.x, face.y + 0.22)) - 0.34);
  if (smile < 0.05 && face.y < -0.40) return vec3(0.62, 0.20, 0.18);
  return skin;
}

vec3 SkinPaint(vec3 point) { return FacePaint(paint.rgb, point); }
)glsl";

constexpr const char* kBodyMain = R"glsl(
void main() {
  vec3 ray = PixelRay();
  depth = MeetCapsule(ray);
  if (!(depth > 0.0 && depth < farthest) || IsBehindRoom(depth)) discard;
  vec3 point = depth * ray;
  vec3 normal = Normal(point);

  colour = LitPaint(SkinPaint(point), normal, point, ray);
  label = uint(capsule_end.w);
  gl_FragDepth = depth / farthest;
}
)glsl";

}  // namespace

std::string CapsuleVertexShader() { return AssembleShader({kCapsuleBox, kBodyPlace}); }
std::string CapsuleFragmentShader(bool with_face) {
  return AssembleShader(
      {kRoomGeometry, kBodyLight, kRoomInFront, kBody, with_face ? kFaceSkin : kPlainSkin, kBodyMain});
}

}  // namespace etude
