// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/grids.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstring>

#include "master/behaviour/neighbours.h"

namespace aquarama::behaviour {

namespace {

// About so many points in a bucket, if they were evenly spread.
constexpr std::size_t kPointsInBucket = 1024;
constexpr std::size_t kMostBuckets = 1024;

// At least one.
int cellsAcross(float halfExtent, float cellMetres) {
    return std::max(1, static_cast<int>(2 * halfExtent / cellMetres) + 1);
}

// Widths of cells of the sparse grids and of food: about how far they are searched.
constexpr float kSparseCellMetres = 2.0F;
constexpr float kFoodCellMetres = 0.8F;

// Limit of the number of cells: a wide sea gets larger cells, as empty ones cost time and memory.
std::size_t mostCellsFor(std::size_t points) {
    constexpr std::size_t kFew = 4096;
    constexpr std::size_t kToPoint = 4;
    return std::max(kFew, points * kToPoint);
}

// A grid of points that are seen from so far that with small cells a search would pass many empty
// ones: at most one cell for two points.
SpatialGrid farSeen(const place::Region& water, std::size_t points) {
    return {water, kSparseCellMetres, points, points / 2};
}

bool isPredator(const fish::FishView& view,
                std::span<const fish::SpeciesParameters> speciesParameters,
                std::size_t fish) {
    return speciesParameters[view.kind[fish]].habits.role == config::Role::Predator;
}

// A block is 4 cells wide along each axis.
constexpr int kBlockBits = 2;
// Values of kindOfCell_ that are no kind: no fish, and fish of several kinds.
constexpr std::uint8_t kEmpty = 0xff;
constexpr std::uint8_t kMixed = 0xfe;

int blocksAcross(int cells) {
    return ((cells - 1) >> kBlockBits) + 1;
}

}  // namespace

CellLayout::CellLayout(const place::Region& water, float cellMetres, std::size_t mostCells)
    : origin_(water.centre - water.halfExtent), cellMetres_(cellMetres) {
    assert(cellMetres > 0);
    const auto cover = [&] {
        cells_ = {cellsAcross(water.halfExtent.x, cellMetres_),
                  cellsAcross(water.halfExtent.y, cellMetres_),
                  cellsAcross(water.halfExtent.z, cellMetres_)};
        return count();
    };
    while (cover() > std::max<std::size_t>(mostCells, 1)) cellMetres_ *= 1.25F;
    cellsPerMetre_ = 1 / cellMetres_;
}

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
    : layout_(water, cellMetres, mostCells),
      starts_(layout_.count() + 1),
      cellOfPoint_(most),
      parts_(std::max<std::size_t>(1, (most + kPointsInPart - 1) / kPointsInPart)) {
    sorted_.resize(most);
    buckets_ = std::clamp<std::size_t>(most / kPointsInBucket, 1, kMostBuckets);
    cellsInBucket_ = (layout_.count() + buckets_ - 1) / buckets_;
    bucketStarts_.resize(buckets_ + 1);
}

void SpatialGrid::makeRoomForSteps() {
    tallies_.resize(parts_ * buckets_);
    spread_.resize(cellOfPoint_.size());
    spreadCells_.resize(cellOfPoint_.size());
}

void SpatialGrid::rebuild(const Points& points, std::span<const std::uint32_t> chosen) {
    assert(chosen.size() <= cellOfPoint_.size());
    std::fill(starts_.begin(), starts_.end(), 0U);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        cellOfPoint_[i] = layout_.indexOf(points[chosen[i]]);
        ++starts_[cellOfPoint_[i]];
    }
    // Running sums: each start becomes the end of its cell, and moves back as the cell is filled.
    std::uint32_t end = 0;
    for (std::uint32_t& start : starts_) start = end += start;
    // Filled from the back, so that each cell keeps the order of the indices.
    for (std::size_t i = chosen.size(); i-- > 0;) {
        const std::uint32_t point = chosen[i];
        sorted_.put(--starts_[cellOfPoint_[i]], points[point], point);
    }
}

// O(parts x buckets), on one thread. Buckets follow one another; in each the parts do, in order.
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

// Parts write to disjoint places, so that threads do not meet.
void SpatialGrid::spread(std::size_t part, const Points& points) {
    assert(part < parts_);
    assert(tallies_.size() == parts_ * buckets_);
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

// A counting sort by cell within the bucket.
void SpatialGrid::sort(std::size_t bucket) {
    assert(bucket < buckets_);
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
    // Filled from the back, so that each cell keeps the order of the indices.
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

Grids::Grids(const place::Region& water, std::size_t fishCount, std::size_t foodCount)
    : fish(water, kCellMetres, fishCount, mostCellsFor(fishCount)),
      kinds(fish),
      predators(farSeen(water, 0)),
      large(farSeen(water, 0)),
      mates(water, kSparseCellMetres, fishCount, mostCellsFor(fishCount)),
      food(water, kFoodCellMetres, foodCount, mostCellsFor(foodCount)),
      water_(water),
      marks_(fishCount) {
    fish.makeRoomForSteps();
    chosen_[kMates].reserve(fishCount);
    chosen_[kFood].reserve(foodCount);
}

// Replaces a grid by a larger one where it has too little room.
void Grids::expect(SpatialGrid& grid, Sparse which, std::size_t count) {
    if (count <= chosen_[which].capacity()) return;
    chosen_[which].reserve(count);
    grid = farSeen(water_, chosen_[which].capacity());
}

void Grids::expect(const fish::FishView& view,
                   std::span<const fish::SpeciesParameters> speciesParameters) {
    std::size_t hunting = 0;
    std::size_t big = 0;
    for (std::size_t i = 0; i < view.size(); ++i) {
        hunting += isPredator(view, speciesParameters, i) ? 1 : 0;
        big += view.fish[i].length >= kLargeBodyMetres ? 1 : 0;
    }
    expect(predators, kPredators, hunting);
    expect(large, kLarges, big);
}

void Grids::know(const surroundings::Surroundings& surroundings,
                 std::span<const fish::SpeciesParameters> speciesParameters) {
    const std::vector<place::Site>& all = surroundings.sites;
    const std::vector<surroundings::TurfPatch>& patches = surroundings.turf.patches;
    sites.take(water_, all.size(), [&](std::uint32_t i) { return all[i].place; });
    turf.take(water_, patches.size(), [&](std::uint32_t i) { return patches[i].place; });
    loops = {surroundings.turf, surroundings.seed, speciesParameters};
}

void Grids::mark(const fish::FishView& view,
                 std::span<const fish::SpeciesParameters> speciesParameters,
                 std::size_t first,
                 std::size_t last) {
    assert(last <= view.size());
    assert(last <= marks_.size());
    for (std::size_t i = first; i < last; ++i) {
        const std::uint8_t signs = view.signs[i];
        int marks = kPresent;
        if (isPredator(view, speciesParameters, i)) marks |= kPredator;
        if (view.fish[i].length >= kLargeBodyMetres) marks |= kLarge;
        if ((signs & fish::kWilling) != 0) marks |= kMate;
        marks_[i] = static_cast<std::uint8_t>((signs & fish::kAway) != 0 ? 0 : marks);
    }
}

// Few fish have these marks, so eight are tested at a time, as one 64-bit number.
std::span<const std::uint32_t> Grids::marked(Sparse which, Mark mark) {
    std::vector<std::uint32_t>& chosen = chosen_[which];
    chosen.clear();
    std::uint64_t eightMarks = 0;
    std::memset(&eightMarks, mark, sizeof(eightMarks));
    for (std::size_t first = 0; first < marks_.size(); first += sizeof(eightMarks)) {
        const std::size_t last = std::min(marks_.size(), first + sizeof(eightMarks));
        std::uint64_t eight = 0;
        std::memcpy(&eight, &marks_[first], last - first);
        if ((eight & eightMarks) == 0) continue;
        for (std::size_t i = first; i < last; ++i)
            if ((marks_[i] & mark) != 0) chosen.push_back(static_cast<std::uint32_t>(i));
    }
    return chosen;
}

// One job of the last step of rebuild().
void Grids::rebuildSparse(std::size_t which,
                          const Points& fishPoints,
                          const surroundings::Food& particles) {
    const auto of = [&](SpatialGrid& grid, Sparse sparse, Mark mark) {
        const std::size_t room = chosen_[sparse].capacity();
        const std::span<const std::uint32_t> chosen = marked(sparse, mark);
        if (chosen.size() > room) grid = farSeen(water_, chosen_[sparse].capacity());
        grid.rebuild(fishPoints, chosen);
    };
    if (which == kPredators) of(predators, kPredators, kPredator);
    if (which == kLarges) of(large, kLarges, kLarge);
    if (which == kMates) of(mates, kMates, kMate);
    if (which != kFood) return;
    std::vector<std::uint32_t>& there = chosen_[kFood];
    there.clear();
    for (std::uint32_t i = 0; i < particles.size(); ++i)
        if (particles.isFree(i)) there.push_back(i);
    food.rebuild({particles.x.data(), particles.y.data(), particles.z.data(), particles.size()},
                 there);
}

std::size_t Grids::bytes() const {
    std::size_t lists = marks_.size();
    for (const auto& chosen : chosen_) lists += chosen.capacity() * sizeof(std::uint32_t);
    return lists + fish.bytes() + kinds.bytes() + predators.bytes() + large.bytes() +
           mates.bytes() + food.bytes();
}

KindsAbout::KindsAbout(const SpatialGrid& grid)
    : cells_(grid.cells()),
      blocks_{blocksAcross(cells_.x), blocksAcross(cells_.y), blocksAcross(cells_.z)},
      kindOfCell_(std::size_t(cells_.x) * std::size_t(cells_.y) * std::size_t(cells_.z)),
      kindsOfBlock_(std::size_t(blocks_.x) * std::size_t(blocks_.y) * std::size_t(blocks_.z)) {}

void KindsAbout::clear() {
    std::fill(kindsOfBlock_.begin(), kindsOfBlock_.end(), 0U);
}

// Index of the block that a cell is in.
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
        // Fish of a cell stand in the order of their index, and a species has a run of indices: if
        // the first and the last are of one kind, all are.
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
        // Several threads may note cells of one block. A union is the same in any order; it is read
        // first, because it seldom changes and a write would take the cache line from other
        // threads.
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
    assert(last < kindOfCell_.size());
    for (std::size_t cell = first; cell <= last; ++cell)
        if (kindOfCell_[cell] != kEmpty && kindOfCell_[cell] != own) return true;
    return false;
}

std::size_t KindsAbout::bytes() const {
    return kindOfCell_.size() + sizeof(std::uint64_t) * kindsOfBlock_.size();
}

}  // namespace aquarama::behaviour
