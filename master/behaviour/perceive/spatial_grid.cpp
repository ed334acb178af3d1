// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/perceive/spatial_grid.h"

#include <algorithm>

namespace aquarama::behaviour {

namespace {

constexpr std::size_t kPointsInBucket = 1024;  // about so many, were they evenly spread
constexpr std::size_t kMostBuckets = 1024;

int cellsAcross(float halfExtent, float cellMetres) {
    return std::max(1, static_cast<int>(2 * halfExtent / cellMetres) + 1);
}

std::size_t cellsIn(const SpatialGrid::Cell& cells) {
    return std::size_t(cells.x) * std::size_t(cells.y) * std::size_t(cells.z);
}

}  // namespace

void SpatialGrid::Columns::resize(std::size_t points) {
    for (auto* values : {&x, &y, &z}) values->resize(points + kMostLanes);
    index.resize(points + kMostLanes);
}

std::size_t SpatialGrid::Columns::bytes() const {
    return sizeof(float) * (x.size() + y.size() + z.size()) + sizeof(std::uint32_t) * index.size();
}

SpatialGrid::SpatialGrid(const place::Region& water,
                         float cellMetres,
                         std::size_t most,
                         std::size_t mostCells)
    : origin_(water.centre - water.halfExtent),
      cellMetres_(cellMetres),
      cellOfPoint_(most),
      parts_(std::max<std::size_t>(1, (most + kPointsInPart - 1) / kPointsInPart)) {
    const auto cover = [&] {
        cells_ = {cellsAcross(water.halfExtent.x, cellMetres_),
                  cellsAcross(water.halfExtent.y, cellMetres_),
                  cellsAcross(water.halfExtent.z, cellMetres_)};
        return cellsIn(cells_);
    };
    while (cover() > std::max<std::size_t>(mostCells, 1)) cellMetres_ *= 1.25F;
    cellsPerMetre_ = 1 / cellMetres_;
    starts_.resize(cellsIn(cells_) + 1);
    sorted_.resize(most);
    buckets_ = std::clamp<std::size_t>(most / kPointsInBucket, 1, kMostBuckets);
    cellsInBucket_ = (cellsIn(cells_) + buckets_ - 1) / buckets_;
    bucketStarts_.resize(buckets_ + 1);
}

void SpatialGrid::makeRoomForSteps() {
    tallies_.resize(parts_ * buckets_);
    spread_.resize(cellOfPoint_.size());
    spreadCells_.resize(cellOfPoint_.size());
}

void SpatialGrid::rebuild(const Points& points, std::span<const std::uint32_t> chosen) {
    std::fill(starts_.begin(), starts_.end(), 0U);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        cellOfPoint_[i] = cellIndex(points[chosen[i]]);
        ++starts_[cellOfPoint_[i]];
    }
    std::uint32_t end = 0;
    for (std::uint32_t& start : starts_) start = end += start;
    // Filled from the back, each start moves down to where its cell begins.
    for (std::size_t i = chosen.size(); i-- > 0;) {
        const std::uint32_t point = chosen[i];
        sorted_.put(--starts_[cellOfPoint_[i]], points[point], point);
    }
}

void SpatialGrid::arrange() {
    std::uint32_t next = 0;
    for (std::size_t bucket = 0; bucket < buckets_; ++bucket) {
        bucketStarts_[bucket] = next;
        for (std::size_t part = 0; part < parts_; ++part) {
            std::uint32_t& tally = tallies_[part * buckets_ + bucket];
            const std::uint32_t points = tally;
            tally = next;
            next += points;
        }
    }
    bucketStarts_[buckets_] = next;
    starts_.back() = next;
}

void SpatialGrid::spread(std::size_t part, const Points& points) {
    std::uint32_t* const next = tallies_.data() + part * buckets_;
    const std::size_t last = std::min(points.count, firstOfPart(part + 1));
    for (std::size_t i = firstOfPart(part); i < last; ++i) {
        const std::uint32_t cell = cellOfPoint_[i];
        if (cell == kNowhere) continue;
        const std::uint32_t slot = next[cell / cellsInBucket_]++;
        spread_.put(slot, points[i], static_cast<std::uint32_t>(i));
        spreadCells_[slot] = cell;
    }
}

void SpatialGrid::sort(std::size_t bucket) {
    const CellRun cells = cellsOfBucket(bucket);
    const std::uint32_t first = bucketStarts_[bucket];
    const std::uint32_t last = bucketStarts_[bucket + 1];
    std::fill(&starts_[cells.first], &starts_[cells.last], 0U);
    for (std::uint32_t i = first; i < last; ++i) ++starts_[spreadCells_[i]];
    std::uint32_t end = first;
    for (std::size_t cell = cells.first; cell < cells.last; ++cell) {
        end += starts_[cell];
        starts_[cell] = end;
    }
    // Filled from the back, each start moves down to where its cell begins.
    for (std::uint32_t i = last; i-- > first;)
        sorted_.put(--starts_[spreadCells_[i]],
                    {spread_.x[i], spread_.y[i], spread_.z[i]},
                    spread_.index[i]);
}

SpatialGrid::Candidates SpatialGrid::candidates(const Slots& slots) const {
    const std::size_t count = slots.last - slots.first;
    return {{x() + slots.first, count},
            {y() + slots.first, count},
            {z() + slots.first, count},
            {index() + slots.first, count}};
}

std::size_t SpatialGrid::bytes() const {
    return sizeof(std::uint32_t) * (starts_.size() + cellOfPoint_.size() + tallies_.size() +
                                    bucketStarts_.size() + spreadCells_.size()) +
           sorted_.bytes() + spread_.bytes();
}

}  // namespace aquarama::behaviour
