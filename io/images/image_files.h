#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "sim/depth_camera/normals.h"
#include "sim/render/scene.h"

namespace etude {

// Pictures as files: the one door to PNG and OpenEXR. Pictures of more than kMaxPictureSide pixels a
// side are refused before memory is taken. Every error names the file.

/// Returns the bytes of a PNG file, for embedding in a page; the same for the same picture. `image` has at least one
/// pixel.
std::string EncodePng(const ColourImage& image);
/// Returns the bytes of a mask as a grey PNG: 0 is black, anything else white.
std::string EncodePng(const Mask& mask);

/// Returns the bytes of a binary PPM file (P6), which every picture library reads, and which costs no time.
std::string EncodePpm(const ColourImage& image);

/// Reads any PNG as 8-bit RGB; transparent parts lie on black.
Result<ColourImage> LoadColourPng(const std::string& path);
/// Decodes the bytes of a PNG file of at most so many pixels; transparent parts keep their own colours. The error names
/// no file.
Result<ColourImage> DecodeColourPng(std::string_view bytes, std::size_t most_pixels);

/// A depth image and the name of its channel.
struct DepthChannel {
  std::string name;
  DepthImage depth;
};

/// Returns the bytes of an OpenEXR file (ZIP, lossless) with the channels R, G, B (half, linear light: 1 is the
/// brightest that an 8-bit picture can show), Z (float, metres along the viewing axis), label (uint) and N.X, N.Y, N.Z
/// (float, normals in the world), and further depth images (float) under names of their own. Empty pictures are left
/// out; the others have one size. The same for the same pictures.
Result<std::string> EncodeExr(const View& view, const NormalImage& normals = {},
                              std::span<const DepthChannel> measured = {});

}  // namespace etude
