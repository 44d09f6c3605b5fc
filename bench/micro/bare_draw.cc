#include "bench/micro/bare_draw.h"

#include <cstddef>

#include "sim/render/capsule_batch.h"
#include "sim/render/gl_context.h"
#include "sim/render/kept_rooms.h"
#include "sim/render/pixel_geometry.h"
#include "sim/render/shaders.h"
#include "sim/render/vertex_stream.h"

namespace etude {

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
  ASSIGN_OR_RETURN(auto context, GlContext::Create());
  const std::vector<std::string> inputs{"start_and_radius", "end_and_label", "paint_in", "front_in"};
  ASSIGN_OR_RETURN(const auto studio, context->LinkProgram(FullScreenVertexShader(), RoomFragmentShader()));
  ASSIGN_OR_RETURN(const auto backdrop, context->LinkProgram(FullScreenVertexShader(), BackdropFragmentShader()));
  ASSIGN_OR_RETURN(const auto shadow,
                   context->LinkProgram(CapsuleShadowVertexShader(), CapsuleShadowFragmentShader(), inputs));
  ASSIGN_OR_RETURN(const auto body, context->LinkProgram(CapsuleVertexShader(), CapsuleFragmentShader(true), inputs));
  auto state = std::make_unique<State>(std::move(context), room, camera);
  const GlFunctions& gl = state->gl;
  gl.GenVertexArrays(1, &state->vertices);
  state->backdrop = backdrop;
  state->shadow = shadow;
  state->body = body;
  state->rooms = std::make_unique<KeptRooms>(gl, studio, 0, state->vertices);
  const KeptRoom& kept = state->rooms->FindOrDraw(room, camera);
  gl.UseProgram(backdrop);
  gl.Uniform1i(gl.GetUniformLocation(backdrop, "kept_extra"), 1);
  gl.ActiveTexture(GL_TEXTURE1);
  gl.BindTexture(GL_TEXTURE_2D, kept.extra);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, kept.room);
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
  s.capsules.Upload(MakeInstances(figures, s.camera.p_WC));
  gl.DepthFunc(GL_ALWAYS);
  s.Use(s.backdrop);
  gl.BindVertexArray(s.vertices);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);

  gl.Disable(GL_DEPTH_TEST);
  gl.Enable(GL_CULL_FACE);
  gl.Enablei(GL_BLEND, 0);
  s.Use(s.shadow);
  for (const int onto_wall : {0, 1}) {
    gl.Uniform1i(gl.GetUniformLocation(s.shadow, "onto_wall"), onto_wall);
    s.capsules.Draw();
  }
  gl.Disablei(GL_BLEND, 0);

  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LESS);
  s.Use(s.body);
  SetLights(gl, s.body, LightsOf(s.room));
  s.capsules.Draw();
  gl.Disable(GL_CULL_FACE);

  const int width = s.camera.intrinsics.width, height = s.camera.intrinsics.height;
  gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, s.colour.data());
  gl.ReadBuffer(GL_COLOR_ATTACHMENT1);
  gl.ReadPixels(0, 0, width, height, GL_RED_INTEGER, GL_UNSIGNED_BYTE, s.labels.data());
}

}  // namespace etude
