// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/perceive/kinds_about.h"

#include <algorithm>
#include <atomic>

namespace aquarama::behaviour {

namespace {

constexpr int kBlockBits = 2;  // a block is 4 cells wide
constexpr std::uint8_t kEmpty = 0xff;
constexpr std::uint8_t kMixed = 0xfe;

int blocksAcross(int cells) {
    return ((cells - 1) >> kBlockBits) + 1;
}

}  // namespace

KindsAbout::KindsAbout(const SpatialGrid& grid)
    : cells_(grid.cells()),
      blocks_{blocksAcross(cells_.x), blocksAcross(cells_.y), blocksAcross(cells_.z)},
      kindOfCell_(std::size_t(cells_.x) * std::size_t(cells_.y) * std::size_t(cells_.z)),
      kindsOfBlock_(std::size_t(blocks_.x) * std::size_t(blocks_.y) * std::size_t(blocks_.z)) {}

void KindsAbout::clear() {
    std::fill(kindsOfBlock_.begin(), kindsOfBlock_.end(), 0U);
}

std::size_t KindsAbout::blockOf(int x, int y, int z) const {
    return static_cast<std::size_t>(
        ((z >> kBlockBits) * blocks_.y + (y >> kBlockBits)) * blocks_.x + (x >> kBlockBits));
}

void KindsAbout::note(const SpatialGrid& grid,
                      std::size_t bucket,
                      std::span<const std::uint8_t> kinds) {
    const auto width = static_cast<std::size_t>(cells_.x);
    const auto height = static_cast<std::size_t>(cells_.y);
    const SpatialGrid::CellRun cells = grid.cellsOfBucket(bucket);
    for (std::size_t cell = cells.first; cell < cells.last; ++cell) {
        const SpatialGrid::Slots slots = grid.slotsOfCell(bucket, cell);
        kindOfCell_[cell] = kEmpty;
        if (slots.first == slots.last) continue;
        // The fish of a cell stand in the order of their index, those of a kind together.
        const std::uint8_t first = kinds[grid.index()[slots.first]];
        const std::uint8_t last = kinds[grid.index()[slots.last - 1]];
        kindOfCell_[cell] = first == last ? first : kMixed;
        std::uint64_t present = std::uint64_t{1} << first | std::uint64_t{1} << last;
        if (first != last)
            for (std::uint32_t i = slots.first; i < slots.last; ++i)
                present |= std::uint64_t{1} << kinds[grid.index()[i]];
        const auto x = static_cast<int>(cell % width);
        const auto y = static_cast<int>(cell / width % height);
        const auto z = static_cast<int>(cell / width / height);
        // Threads may note cells of one block; a union is the same in any order.
        const std::atomic_ref<std::uint64_t> block(kindsOfBlock_[blockOf(x, y, z)]);
        if ((~block.load(std::memory_order_relaxed) & present) != 0)
            block.fetch_or(present, std::memory_order_relaxed);
    }
}

bool KindsAbout::mayHoldOthers(const SpatialGrid::Cell& from,
                               const SpatialGrid::Cell& to,
                               std::uint8_t own) const {
    std::uint64_t kinds = 0;
    for (int z = from.z >> kBlockBits; z <= to.z >> kBlockBits; ++z)
        for (int y = from.y >> kBlockBits; y <= to.y >> kBlockBits; ++y)
            for (int x = from.x >> kBlockBits; x <= to.x >> kBlockBits; ++x)
                kinds |=
                    kindsOfBlock_[static_cast<std::size_t>((z * blocks_.y + y) * blocks_.x + x)];
    return (kinds & ~(std::uint64_t{1} << own)) != 0;
}

bool KindsAbout::rowHoldsOthers(std::size_t first, std::size_t last, std::uint8_t own) const {
    for (std::size_t cell = first; cell <= last; ++cell)
        if (kindOfCell_[cell] != kEmpty && kindOfCell_[cell] != own) return true;
    return false;
}

std::size_t KindsAbout::bytes() const {
    return kindOfCell_.size() + sizeof(std::uint64_t) * kindsOfBlock_.size();
}

}  // namespace aquarama::behaviour
