// SPDX-License-Identifier: Apache-2.0
#include "common/skin/coarser_level.h"

#include <algorithm>
#include <set>
#include <utility>

#include "common/skin/face_grid.h"

namespace aquarama::skin {

namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

Pair ordered(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

// The edges that only the two triangles of one quad share. A quad's triangles follow each other,
// and those of attachments stand between.
std::set<Pair> diagonalsOf(const LimitTable& table) {
    std::vector<std::array<std::uint32_t, 3>> skin;
    for (std::size_t t = 0; t < table.indices.size(); t += 3) {
        const std::array triangle{table.indices[t], table.indices[t + 1], table.indices[t + 2]};
        if (std::ranges::max(triangle) < table.skinVertices) skin.push_back(triangle);
    }
    std::set<Pair> diagonals;
    for (std::size_t t = 0; t + 1 < skin.size(); t += 2) {
        std::vector<std::uint32_t> shared;
        for (const std::uint32_t vertex : skin[t])
            if (std::ranges::find(skin[t + 1], vertex) != skin[t + 1].end())
                shared.push_back(vertex);
        diagonals.insert(ordered(shared.at(0), shared.at(1)));
    }
    return diagonals;
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> coarserParents(const body::FishBody& body,
                                                         int level,
                                                         const LimitTable& coarser) {
    const FaceGrid fine{body.cage, 1 << level};
    const FaceGrid coarse{body.cage, 1 << (level - 1)};
    const std::set<Pair> diagonals = diagonalsOf(coarser);
    std::vector<std::array<std::uint32_t, 2>> parents(fine.locations().size());
    const int n = fine.cuts();
    const auto parentsAt = [&](std::size_t face, int i, int j) -> std::array<std::uint32_t, 2> {
        const int di = i % 2, dj = j % 2;
        if (di == 0 || dj == 0)
            return {fine.at(face, i - di, j - dj), fine.at(face, i + di, j + dj)};
        const Pair rising =
            ordered(coarse.at(face, i / 2, j / 2), coarse.at(face, i / 2 + 1, j / 2 + 1));
        if (diagonals.contains(rising))
            return {fine.at(face, i - 1, j - 1), fine.at(face, i + 1, j + 1)};
        return {fine.at(face, i + 1, j - 1), fine.at(face, i - 1, j + 1)};
    };
    for (std::size_t face = 0; face < body.cage.faces.size(); ++face)
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) parents[fine.at(face, i, j)] = parentsAt(face, i, j);
    // Attachments are the same at every level.
    for (std::size_t k = coarser.skinVertices; k < coarser.vertices.size(); ++k) {
        const auto own = static_cast<std::uint32_t>(parents.size());
        parents.push_back({own, own});
    }
    return parents;
}

}  // namespace aquarama::skin
