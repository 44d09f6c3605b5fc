#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>

#include "engine/base/image.h"

namespace etude {

/// A colour and its opacity, each 0…1.
struct Paint {
  double r = 0, g = 0, b = 0, a = 1;
};

/// A rectangle of a canvas in pixels; the origin is the top left corner.
struct Box {
  double x = 0, y = 0, width = 0, height = 0;
};

/// A drawing surface of fixed size, opaque black at first. Coordinates are pixels from the top left corner. Only this
/// class uses cairo.
class Canvas {
 public:
  Canvas(int width, int height);
  ~Canvas();
  Canvas(Canvas&&) noexcept;
  Canvas& operator=(Canvas&&) noexcept;

  int width() const;
  int height() const;

  void FillBox(const Box& box, const Paint& paint, double radius = 0);
  /// Fills a box with a gradient from `top` at the box's upper edge to `bottom` at the lower edge.
  void FillShade(const Box& box, const Paint& top, const Paint& bottom);
  void DrawImage(const ColourImage& image, const Box& box, double radius = 0);
  /// Copies a picture of pixels 0x00RRGGBB to (`left`, `top`) without scaling, with rounded corners. The picture must
  /// fit into the canvas.
  void Put(const Image<std::uint32_t>& picture, int left, int top, int radius = 0);
  /// Paints where the mask is set; the mask is stretched over the box.
  void DrawMask(const Mask& mask, const Box& box, const Paint& paint);
  void DrawLine(const glm::dvec2& from, const glm::dvec2& to, double width, const Paint& paint);
  /// Draws straight lines through the points; at least one point.
  void DrawPath(std::span<const glm::dvec2> points, double width, const Paint& paint);
  void DrawDot(const glm::dvec2& centre, double radius, const Paint& paint);
  void DrawRing(const glm::dvec2& centre, double radius, double width, const Paint& paint);
  /// Draws text; `origin` is the left end of the text's baseline. Text wider than `room` pixels is drawn smaller, by a
  /// quarter at most; if it is still too wide, it is cut and ends in "…".
  void DrawText(const glm::dvec2& origin, const std::string& text, double size, const Paint& paint, double room,
                bool bold = false);
  double TextWidth(const std::string& text, double size, bool bold = false) const;

  ColourImage Pixels() const;
  /// Returns the pixels as 0x00RRGGBB.
  Image<std::uint32_t> Copy() const;
  /// Writes the picture in the form that encoders take (I420): one byte of luma for every pixel, then two planes of
  /// chroma of half the width and height (BT.601, 16…235). Width and height must be even.
  void ToI420(std::uint8_t* planes) const;
  /// Returns the bytes of a PNG file.
  std::string Png() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace etude
