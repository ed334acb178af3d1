// SPDX-License-Identifier: Apache-2.0
#include "common/skin/face_grid.h"

#include <map>
#include <utility>

namespace aquarama::skin {

namespace {

// The two ends of the edge on which a border point lies, and how many cuts it is from the first.
struct OnEdge {
    std::uint16_t from, to;
    int step;
};

OnEdge onEdge(const std::array<std::uint16_t, 4>& face, int i, int j, int cuts) {
    if (j == 0) return {face[0], face[1], i};
    if (i == cuts) return {face[1], face[2], j};
    if (j == cuts) return {face[3], face[2], i};
    return {face[0], face[3], j};
}

}  // namespace

FaceGrid::FaceGrid(const body::ControlCage& cage, int cuts) : cuts_{cuts} {
    using EdgePoint = std::array<int, 3>;  // lower end, higher end, cuts from the lower
    std::map<EdgePoint, std::uint32_t> edgePoints;
    locations_.resize(cage.vertices.size());

    const auto number = [&](std::uint32_t face, int i, int j) -> std::uint32_t {
        const Location location{face,
                                static_cast<float>(i) / static_cast<float>(cuts),
                                static_cast<float>(j) / static_cast<float>(cuts)};
        const bool atI = i == 0 || i == cuts, atJ = j == 0 || j == cuts;
        const auto& corners = cage.faces[face];
        if (atI && atJ) {
            const std::uint16_t corner = j == 0 ? corners[i == 0 ? 0 : 1] : corners[i == 0 ? 3 : 2];
            locations_[corner] = location;
            return corner;
        }
        const auto fresh = static_cast<std::uint32_t>(locations_.size());
        if (atI || atJ) {
            auto [from, to, step] = onEdge(corners, i, j, cuts);
            if (from > to) {
                std::swap(from, to);
                step = cuts - step;
            }
            const auto [found, isNew] = edgePoints.try_emplace({from, to, step}, fresh);
            if (!isNew) return found->second;
        }
        locations_.push_back(location);
        return fresh;
    };

    for (std::uint32_t face = 0; face < cage.faces.size(); ++face) {
        for (int j = 0; j <= cuts; ++j) {
            for (int i = 0; i <= cuts; ++i) numbers_.push_back(number(face, i, j));
        }
    }
}

std::uint32_t FaceGrid::at(std::size_t face, int i, int j) const {
    const std::size_t side = static_cast<std::size_t>(cuts_) + 1;
    return numbers_[face * side * side + static_cast<std::size_t>(j) * side +
                    static_cast<std::size_t>(i)];
}

}  // namespace aquarama::skin
