// SPDX-License-Identifier: Apache-2.0
#include "render_node/reef/place_tables.h"

#include <utility>

namespace aquarama::scene {

DerivedKey derivedKey(std::string kind, const place::PlaceKey& place) {
    DerivedKey key(std::move(kind));
    key.add(place.seed).add(place.kind).add(place.heads.size());
    for (const config::Head& head : place.heads)
        key.add(head.xz.x).add(head.xz.y).add(head.radiusMetres).add(head.heightMetres);
    for (const config::SiteGroup& group : place.sites) {
        const glm::vec2 xz = group.xz.value_or(glm::vec2{});
        key.add(group.kind).add(group.xz.has_value()).add(xz.x).add(xz.y).add(group.number);
    }
    for (const glm::vec3 point : {place.settled.centre, place.settled.halfExtent})
        key.add(point.x).add(point.y).add(point.z);
    return key;
}

}  // namespace aquarama::scene
