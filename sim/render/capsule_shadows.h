#pragma once

#include <vector>

#include "sim/render/empty_room.h"
#include "sim/render/scene.h"

namespace etude {

/// Draws the shadows that the capsules of figures cast on the empty room. The lamp's remaining light at a pixel depends
/// on how deep the line from the lamp to the pixel runs inside a capsule. The farther a shadow falls, the softer it is.
/// Where shadows overlap, the darkest counts. In interiors, capsules also darken a surface close to them by contact
/// shadows. Before the call, `view` must show `rows` of the empty room. Shadows of the lamp are labelled kShadow,
/// except on furniture, which keeps its label.
void CastCapsuleShadows(const KeptRoom& kept, const Room& room, const std::vector<Figure>& figures, Targets targets,
                        const RowRange& rows, View& view);

/// Marks the pixels of the overlay at which capsules of figures cast a shadow in the studio's room, unless a body is
/// drawn there.
void MarkCapsuleShadows(const KeptRoom& kept, const std::vector<Figure>& figures, Overlay& overlay);

}  // namespace etude
