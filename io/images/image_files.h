#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "sim/depth_camera/normals.h"
#include "sim/render/scene.h"

namespace etude {

// Encodes and decodes pictures. Only this folder uses the libraries for PNG and OpenEXR. Files with more than
// kMaxPictureSide pixels per side are refused before memory is allocated. Errors name the file unless stated
// otherwise.

/// Returns the bytes of a PNG file, for embedding in a page. The same picture gives the same bytes. `image` must have
/// at least one pixel. With `pixels_per_metre` above 0, the file states the size at which the picture is printed.
std::string EncodePng(const ColourImage& image, double pixels_per_metre = 0);
/// Returns a mask as the bytes of a grey PNG: 0 becomes black, any other value white.
std::string EncodePng(const Mask& mask);

/// Returns the bytes of a binary PPM file (P6). Every picture library reads this format, and writing it takes no time
/// for compression.
std::string EncodePpm(const ColourImage& image);

/// Reads any PNG as 8-bit RGB; transparent pixels are blended with black.
Result<ColourImage> LoadColourPng(const std::string& path);
/// Decodes the bytes of a PNG file of at most `max_pixels` pixels, and of at most 16,384 pixels per side.
/// Transparency is ignored: pixels keep their stored colours. The error names no file.
Result<ColourImage> DecodeColourPng(std::string_view bytes, std::size_t max_pixels);

/// A picture of one number per pixel, as segmenters write it.
struct MaskPicture {
  /// Each pixel's grey value, 0 to 255, or 0 to 65535 in opaque pictures of 16 bits; or its index into a palette.
  Image<std::uint16_t> values = {};
  bool is_indexed = false;    ///< true: the file has a palette, and `values` are indices into it
  bool has_16_bits = false;   ///< true: `values` go to 65535
  Image<std::uint8_t> alpha = {};  ///< each pixel's opacity, 0 to 255; empty if every pixel is opaque
};
/// Reads a PNG of masks. Colours become grey; transparent pixels are blended with black.
Result<MaskPicture> LoadMaskPng(const std::string& path);

/// A depth image and the name of its channel.
struct DepthChannel {
  std::string name;
  DepthImage depth;
};

/// Returns the bytes of an OpenEXR file (ZIP, lossless) with the channels R, G, B (half; linear light, 1 is the
/// brightest value of an 8-bit picture), Z (float, metres along the viewing axis), label (float that holds a whole
/// number below 2²⁴), N.X, N.Y, N.Z (float, normals in world coordinates) and further depth images (float) under their
/// own names. Empty pictures are left out; all others must have the same size. The same pictures give the same bytes.
/// Fails with OpenEXR's message, which names no file.
Result<std::string> EncodeExr(const View& view, const NormalImage& normals = {},
                              std::span<const DepthChannel> measured = {});

}  // namespace etude
