#include "bench/peers/bare_draw.h"

#include <cstddef>

#include "sim/render/empty_room.h"
#include "sim/render/figure_batches.h"
#include "sim/render/gl_context.h"
#include "sim/render/gl_objects.h"
#include "sim/render/shaders.h"
#include "sim/render/uniforms.h"

namespace etude {
namespace {

// This shader copies the stored picture of the empty room.
constexpr const char* kBackdrop = R"glsl(
uniform sampler2D kept_room;
uniform sampler2D kept_extra;
uniform float brightness;

layout(location = 0) out vec4 colour;
layout(location = 1) out uint label;

void main() {
  colour = vec4(texelFetch(kept_room, ivec2(gl_FragCoord.xy), 0).rgb * brightness, 1.0);
  label = uint(texelFetch(kept_extra, ivec2(gl_FragCoord.xy), 0).a);
}
)glsl";

// This shader projects a capsule's bounding box from the lamp onto the floor or the wall. kShadow then draws the shadow
// there.
constexpr const char* kShadowPlace = R"glsl(
uniform vec3 eye;
uniform vec3 lamp;
uniform float wall_z;
uniform bool onto_wall;

void main() {
  vec3 lamp_E = lamp - eye;
  vec3 from_lamp = BoxCorner() - lamp_E;
  float drop = onto_wall ? lamp.z - wall_z : lamp.y;
  // A corner level with the lamp would throw its shadow to infinity: far is enough.
  float fall = max(onto_wall ? -from_lamp.z : -from_lamp.y, 0.05);
  Place(lamp_E + from_lamp * (drop / fall));
}
)glsl";

constexpr const char* kSegmentDistance = R"glsl(
// The squared distance between the segments p1-q1 and p2-q2 (Ericson 2005, section 5.1.9).
float SquaredDistance(vec3 p1, vec3 q1, vec3 p2, vec3 q2) {
  vec3 d1 = q1 - p1, d2 = q2 - p2, r = p1 - p2;
  float a = dot(d1, d1), e = dot(d2, d2), f = dot(d2, r), c = dot(d1, r), b = dot(d1, d2);
  float denominator = a * e - b * b;
  float s = denominator > 1e-12 ? clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
  float t = e > 0.0 ? clamp((b * s + f) / e, 0.0, 1.0) : 0.0;
  s = clamp((b * t - c) / a, 0.0, 1.0);
  vec3 gap = p1 + s * d1 - p2 - t * d2;
  return dot(gap, gap);
}
)glsl";

constexpr const char* kShadow = R"glsl(
uniform bool onto_wall;

flat in vec4 capsule_start;
flat in vec4 capsule_end;

layout(location = 0) out vec4 colour;
layout(location = 1) out uint label;

void main() {
  vec3 ray = PixelRay();
  RoomHit hit = MeetRoom(ray);
  if (hit.is_wall != onto_wall || hit.depth == kInfinity) discard;
  vec3 point = hit.depth * ray, lamp_E = lamp - eye;
  float gap = sqrt(SquaredDistance(point, lamp_E, capsule_start.xyz, capsule_end.xyz));
  float inside = 1.0 - gap / capsule_start.w;
  if (inside <= 0.0) discard;

  // The shadow is softer the farther it falls.
  float softness = clamp(0.2 * distance(point, capsule_start.xyz), 0.15, 0.6);
  colour = RoomInShadow(hit, point, inside, softness);
  label = 1u;
}
)glsl";

}  // namespace

struct BareDraw::State {
  State(std::unique_ptr<GlContext> made, const Room& of, const Camera& by)
      : context(std::move(made)),
        gl(context->functions()),
        room(of),
        camera(by),
        capsules(gl, sizeof(CapsuleInstance), 14,
                 {{4, offsetof(CapsuleInstance, start_and_radius)},
                  {4, offsetof(CapsuleInstance, end_and_label)},
                  {4, offsetof(CapsuleInstance, paint)},
                  {3, offsetof(CapsuleInstance, front)}}) {}

  GLuint Framebuffer() {
    const int width = camera.intrinsics.width, height = camera.intrinsics.height;
    GLuint framebuffer = 0, buffers[3];
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.GenRenderbuffers(3, buffers);
    constexpr GLenum kFormats[] = {GL_RGBA8, GL_R8UI, GL_DEPTH_COMPONENT32F};
    constexpr GLenum kPlaces[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_DEPTH_ATTACHMENT};
    for (int i = 0; i < 3; ++i) {
      gl.BindRenderbuffer(GL_RENDERBUFFER, buffers[i]);
      gl.RenderbufferStorage(GL_RENDERBUFFER, kFormats[i], width, height);
      gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, kPlaces[i], GL_RENDERBUFFER, buffers[i]);
    }
    gl.DrawBuffers(2, kPlaces);
    gl.Viewport(0, 0, width, height);
    return framebuffer;
  }

  void Use(GLuint program) {
    gl.UseProgram(program);
    gl.Uniform1f(gl.GetUniformLocation(program, "brightness"), static_cast<float>(room.brightness));
    gl.Uniform1f(gl.GetUniformLocation(program, "farthest"), 200);
    SetPixelGeometry(gl, program, camera, room);
  }

  std::unique_ptr<GlContext> context;
  const GlFunctions& gl;
  Room room;
  Camera camera;
  VertexStream capsules;
  std::unique_ptr<KeptRooms> rooms;
  GLuint backdrop = 0, shadow = 0, body = 0, vertices = 0;
  std::vector<std::uint8_t> colour, labels;
};

BareDraw::BareDraw(std::unique_ptr<State> state) : state_(std::move(state)) {}
BareDraw::~BareDraw() { state_->context->MakeCurrent(); }

Result<std::unique_ptr<BareDraw>> BareDraw::Create(const Room& room, const Camera& camera) {
  // Compile the shaders.
  ASSIGN_OR_RETURN(auto context, GlContext::Create());
  const std::vector<std::string> inputs{"start_and_radius", "end_and_label", "paint_in", "front_in"};
  ASSIGN_OR_RETURN(const auto studio, context->LinkProgram(FullScreenVertexShader(), RoomFragmentShader()));
  ASSIGN_OR_RETURN(const auto backdrop, context->LinkProgram(FullScreenVertexShader(), AssembleShader({kBackdrop})));
  ASSIGN_OR_RETURN(
      const auto shadow,
      context->LinkProgram(AssembleShader({kCapsuleBox, kShadowPlace}),
                           AssembleShader({kRoomGeometry, kShadowLight, kSegmentDistance, kShadow}), inputs));
  ASSIGN_OR_RETURN(const auto body, context->LinkProgram(CapsuleVertexShader(), CapsuleFragmentShader(true), inputs));
  auto state = std::make_unique<State>(std::move(context), room, camera);
  const GlFunctions& gl = state->gl;
  gl.GenVertexArrays(1, &state->vertices);
  state->backdrop = backdrop;
  state->shadow = shadow;
  state->body = body;
  // Draw the empty room once, and bind it as textures.
  state->rooms = std::make_unique<KeptRooms>(gl, studio, 0, state->vertices);
  const KeptRoom& kept = state->rooms->FindOrDraw(room, camera);
  gl.UseProgram(backdrop);
  gl.Uniform1i(gl.GetUniformLocation(backdrop, "kept_extra"), 1);
  gl.ActiveTexture(GL_TEXTURE1);
  gl.BindTexture(GL_TEXTURE_2D, kept.extra);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, kept.room);
  // Make the framebuffer and the buffers to read back.
  state->Framebuffer();
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.CullFace(GL_FRONT);
  gl.BlendEquation(GL_MIN);
  gl.Enable(GL_DEPTH_TEST);
  const std::size_t pixels = static_cast<std::size_t>(camera.intrinsics.width) * camera.intrinsics.height;
  state->colour.resize(4 * pixels);
  state->labels.resize(pixels);
  return std::unique_ptr<BareDraw>(new BareDraw(std::move(state)));
}

void BareDraw::Draw(const std::vector<Figure>& figures) {
  State& s = *state_;
  const GlFunctions& gl = s.gl;
  // Draw the empty room.
  s.capsules.Upload(MakeInstances(figures, s.camera.p_WC));
  constexpr GLfloat kFarthest[] = {1};
  gl.ClearBufferfv(GL_DEPTH, 0, kFarthest);
  gl.Disable(GL_DEPTH_TEST);
  s.Use(s.backdrop);
  gl.BindVertexArray(s.vertices);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);

  // Draw the shadows. Where they overlap, the darkest one counts (GL_MIN).
  gl.Enable(GL_CULL_FACE);
  gl.Enablei(GL_BLEND, 0);
  s.Use(s.shadow);
  for (const int onto_wall : {0, 1}) {
    gl.Uniform1i(gl.GetUniformLocation(s.shadow, "onto_wall"), onto_wall);
    s.capsules.Draw();
  }
  gl.Disablei(GL_BLEND, 0);

  // Draw the capsules.
  gl.Enable(GL_DEPTH_TEST);
  s.Use(s.body);
  SetLights(gl, s.body, LightsOf(s.room));
  s.capsules.Draw();
  gl.Disable(GL_CULL_FACE);

  // Read back colour and labels.
  const int width = s.camera.intrinsics.width, height = s.camera.intrinsics.height;
  gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, s.colour.data());
  gl.ReadBuffer(GL_COLOR_ATTACHMENT1);
  gl.ReadPixels(0, 0, width, height, GL_RED_INTEGER, GL_UNSIGNED_BYTE, s.labels.data());
}

}  // namespace etude
