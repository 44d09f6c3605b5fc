#pragma once

#include "sim/render/kept_rooms.h"

namespace etude {

/// Fills `rows` of `view` with the empty room at `brightness`: the very bytes that GL draws (round to nearest even).
/// Pictures of another size are made anew.
void FillBackdrop(const KeptRoom& room, int width, int height, double brightness, Targets targets, const Rows& rows,
                  View& view);

}  // namespace etude
