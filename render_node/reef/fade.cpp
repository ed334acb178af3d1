// SPDX-License-Identifier: Apache-2.0
#include "render_node/reef/fade.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <limits>
#include <map>
#include <vector>

#include <glm/geometric.hpp>

namespace aquarama::scene {

namespace {

const SolidVertex& cornerOf(const Mesh& mesh, const Patch& patch, int row, int column) {
    return mesh.vertices[patch.first + static_cast<std::uint32_t>(row * patch.columns + column)];
}

// Whether the last column of a patch is its first one, as around a tube.
bool isClosed(const Mesh& mesh, const Patch& patch) {
    return patch.columns > 2 && cornerOf(mesh, patch, 0, 0).position ==
                                    cornerOf(mesh, patch, 0, patch.columns - 1).position;
}

}  // namespace

Step stepOf(int i, int from, int to) {
    assert(from > 0);
    assert(i <= from);
    const int cell = std::min(i * to / from, to - 1);
    return {cell, static_cast<float>(i * to - cell * from) / static_cast<float>(from)};
}

CoarseVertex pointOn(const Mesh& mesh, const Patch& patch, Step down, Step across) {
    const bool isFirst = down.share >= across.share;
    const std::array corners{
        &cornerOf(mesh, patch, down.cell, across.cell),
        &cornerOf(mesh, patch, down.cell + (isFirst ? 1 : 0), across.cell + (isFirst ? 0 : 1)),
        &cornerOf(mesh, patch, down.cell + 1, across.cell + 1)};
    const float most = std::max(down.share, across.share);
    const float least = std::min(down.share, across.share);
    const std::array weights{1.0F - most, most - least, least};
    glm::vec3 position{0.0F};
    glm::vec3 normal{0.0F};
    glm::vec4 albedo{0.5F};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        position += weights.at(k) * corners.at(k)->position;
        normal += weights.at(k) * glm::vec3(corners.at(k)->normal);
        albedo += weights.at(k) * glm::vec4(corners.at(k)->albedo);
    }
    const float length = glm::max(glm::length(normal), 1.0F);
    return {position,
            glm::i8vec4(glm::vec4(normal * (127.0F / length), corners[0]->normal.w)),
            glm::u8vec4(albedo)};
}

namespace {

// Fades one level into the next.
class Fading {
  public:
    Fading(Mesh& fine, const Mesh& coarse) : fine_{fine}, coarse_{coarse} {
        for (const Patch& patch : coarse.patches) known_[patch.key] = &patch;
    }

    void run() {
        fine_.coarse.resize(fine_.vertices.size());
        for (const Patch& patch : fine_.patches)
            if (known_.contains(patch.key)) match(patch, *known_[patch.key]);
        for (const Patch& patch : fine_.patches)
            if (!known_.contains(patch.key)) shrink(patch);
    }

  private:
    // A tube becomes a ribbon by being pressed flat.
    void match(const Patch& from, const Patch& to) {
        const bool isPressed = isClosed(fine_, from) && !isClosed(coarse_, to);
        const int width = isPressed ? (from.columns - 1) / 2 : from.columns - 1;
        for (int row = 0; row < from.rows; ++row)
            for (int column = 0; column < from.columns; ++column) {
                const int across =
                    isPressed ? std::min({column, from.columns - 1 - column, width}) : column;
                const auto at =
                    from.first + static_cast<std::uint32_t>(row * from.columns + column);
                fine_.coarse[at] = pointOn(coarse_,
                                           to,
                                           stepOf(row, from.rows - 1, to.rows - 1),
                                           stepOf(across, width, to.columns - 1));
                matched_.push_back(at);
            }
    }

    // Into the point where the nearest part that stays will be; light and colour remain its own.
    void shrink(const Patch& patch) {
        glm::vec3 foot{0.0F};
        for (int column = 0; column < patch.columns; ++column)
            foot += cornerOf(fine_, patch, 0, column).position / static_cast<float>(patch.columns);
        const glm::vec3 end = fine_.coarse[nearestTo(foot)].position;
        for (int i = 0; i < patch.rows * patch.columns; ++i) {
            const auto at = patch.first + static_cast<std::uint32_t>(i);
            fine_.coarse[at] = {end, fine_.vertices[at].normal, fine_.vertices[at].albedo};
        }
    }

    // The matched vertex that is nearest to a place.
    [[nodiscard]] std::uint32_t nearestTo(glm::vec3 place) const {
        assert(!matched_.empty());
        return *std::ranges::min_element(matched_, {}, [&](std::uint32_t i) {
            return glm::distance(fine_.vertices[i].position, place);
        });
    }

    Mesh& fine_;
    const Mesh& coarse_;
    std::map<std::uint32_t, const Patch*> known_;
    std::vector<std::uint32_t> matched_;
};

}  // namespace

void setCoarse(Levels& levels) {
    for (std::size_t level = 0; level + 1 < kLevels; ++level)
        Fading{levels.at(level), levels.at(level + 1)}.run();
    Mesh& last = levels.back();
    last.coarse.clear();
    for (const SolidVertex& vertex : last.vertices)
        last.coarse.push_back({vertex.position, vertex.normal, vertex.albedo});
}

}  // namespace aquarama::scene
