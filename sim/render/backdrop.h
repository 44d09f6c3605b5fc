#pragma once

#include "sim/render/kept_rooms.h"
#include "sim/render/touched_pixels.h"

namespace etude {

/// Fills `view` with those rows of the empty room at `brightness`, `width` pixels each: the very bytes that GL draws
/// (round to nearest even). Pictures of another size are made anew.
void FillBackdrop(const KeptRoom& room, int width, double brightness, Targets targets, const RowRange& rows,
                  View& view);

/// The same of a rectangle of a whole picture, its colours only.
void FillBackdrop(const KeptRoom& room, double brightness, const PixelRect& rect, ColourImage& picture);

/// The levels of `count` numbers times the brightness, as GL rounds them.
void RoundToBytes(const float* light, std::size_t count, float brightness, std::uint8_t* bytes);

}  // namespace etude
