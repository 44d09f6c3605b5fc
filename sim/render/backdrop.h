#pragma once

#include "sim/render/kept_rooms.h"

namespace etude {

/// Fills `view` with those rows of the empty room at `brightness`, `width` pixels each: the very bytes that GL draws
/// (round to nearest even). Pictures of another size are made anew.
void FillBackdrop(const KeptRoom& room, int width, double brightness, Targets targets, const RowRange& rows, View& view);

}  // namespace etude
