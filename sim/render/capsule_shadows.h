#pragma once

#include <vector>

#include "sim/render/empty_room.h"
#include "sim/render/scene.h"

namespace etude {

/// Draws the shadows that the capsules of figures throw on the empty room: how deep the light's way from the lamp to a
/// pixel runs inside a capsule says how much of the lamp's light is left, softer the farther the shadow falls; where
/// shadows overlap the deepest counts. In interiors what stands close to the floor also takes the light that comes from
/// all sides. `view` shows those rows of the empty room; shadows of the lamp are labelled kShadow, but furniture keeps
/// its label.
void ThrowCapsuleShadows(const KeptRoom& kept, const Room& room, const std::vector<Figure>& figures, Targets targets,
                         const RowRange& rows, View& view);

/// Marks where the capsules of figures darken the studio's room, in pixels of the overlay that show nothing else.
void MarkCapsuleShadows(const KeptRoom& kept, const std::vector<Figure>& figures, Overlay& overlay);

}  // namespace etude
