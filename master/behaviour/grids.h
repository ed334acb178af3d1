// SPDX-License-Identifier: Apache-2.0
// Spatial search: points sorted into the cells of a uniform grid, so that a search reads a few
// short runs of memory. World frame, metres.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "common/place/place.h"
#include "master/behaviour/loops.h"
#include "master/fish/fish_view.h"
#include "master/surroundings/food.h"
#include "master/surroundings/surroundings.h"

namespace aquarama::behaviour {

// Most points that a search reads at a time: the widest vector, and the padding behind arrays.
inline constexpr std::size_t kMostLanes = 16;

// Positions of points, in metres; not owned. Either columns (stride 1) or members of records of
// `stride` floats.
struct Points {
    const float *x = nullptr, *y = nullptr, *z = nullptr;
    std::size_t count = 0;
    std::size_t stride = 1;

    // Position of point i.
    [[nodiscard]] glm::vec3 operator[](std::size_t i) const {
        return {x[i * stride], y[i * stride], z[i * stride]};
    }
};

// How a box of water is divided into cells, which lie row by row along x. Points outside the water
// belong to the border cells.
class CellLayout {
  public:
    // Place of a cell, or the number of cells, along each axis.
    struct Cell {
        int x, y, z;
    };

    // Cells are enlarged in steps of 25 % until there are at most `mostCells`.
    CellLayout(const place::Region& water, float cellMetres, std::size_t mostCells);

    // The number of cells along each axis.
    [[nodiscard]] Cell cells() const { return cells_; }
    // The number of all cells.
    [[nodiscard]] std::size_t count() const { return rowOf(0, cells_.z); }
    // Edge of a cell.
    [[nodiscard]] float cellMetres() const { return cellMetres_; }
    // The corner with the least coordinates, metres.
    [[nodiscard]] glm::vec3 origin() const { return origin_; }
    // A point in cells from the origin.
    [[nodiscard]] glm::vec3 inCells(glm::vec3 point) const {
        return (point - origin_) * cellsPerMetre_;
    }
    // A length in cells.
    [[nodiscard]] float inCells(float metres) const { return metres * cellsPerMetre_; }
    // The cell that a point belongs to.
    [[nodiscard]] Cell cellOf(glm::vec3 point) const {
        const glm::vec3 at = inCells(point);
        return {clamped(at.x, cells_.x), clamped(at.y, cells_.y), clamped(at.z, cells_.z)};
    }
    // Index of the first cell of a row.
    [[nodiscard]] std::size_t rowOf(int y, int z) const {
        return (std::size_t(z) * std::size_t(cells_.y) + std::size_t(y)) * std::size_t(cells_.x);
    }
    // Index of the cell that a point belongs to.
    [[nodiscard]] std::uint32_t indexOf(glm::vec3 point) const {
        const Cell cell = cellOf(point);
        return static_cast<std::uint32_t>(rowOf(cell.y, cell.z)) +
               static_cast<std::uint32_t>(cell.x);
    }
    // The cell at a place along one axis of so many cells. Clamped: border cells extend outwards
    // without end.
    [[nodiscard]] static int clamped(float cell, int cells) {
        return static_cast<int>(std::clamp(cell, 0.0F, static_cast<float>(cells - 1)));
    }

  private:
    glm::vec3 origin_;
    float cellMetres_;
    float cellsPerMetre_ = 0;
    Cell cells_{};
};

// The grid and a sorted copy of its points. rebuild() is one thread's work; the steps below it may
// be shared out. While it is not rebuilt any number of threads may search it.
class SpatialGrid {
  public:
    using Cell = CellLayout::Cell;  // place of a cell

    // Room for `most` points. Points outside `water` are kept in the border cells and found all the
    // same. The number of cells is limited, so that a wide sea takes no more memory than its fish.
    SpatialGrid(const place::Region& water,
                float cellMetres,
                std::size_t most,
                std::size_t mostCells);

    // Takes those of `points` that have these ascending indices, at most `most`. In each cell they
    // stand in the order of their index. A counting sort: O(chosen + cells). Allocates nothing.
    void rebuild(const Points& points, std::span<const std::uint32_t> chosen);

    // Rebuilds the grid for many points, in steps: count() for every part, arrange(), spread() for
    // every part, sort() for every bucket. The jobs of one step may run on several threads; the
    // next step begins when all are done. A part is a run of indices, a bucket a run of cells. Both
    // depend on `most` alone, so that any number of threads makes the same grid. Allocates what the
    // steps need. Once, before the first step.
    void makeRoomForSteps();
    // The number of parts and of buckets, and the first index of a part.
    [[nodiscard]] std::size_t parts() const { return parts_; }
    [[nodiscard]] std::size_t buckets() const { return buckets_; }
    [[nodiscard]] static std::size_t firstOfPart(std::size_t part) { return part * kPointsInPart; }
    // Finds the cell of each point of a part, for which isThere(i) holds, and counts them by
    // bucket.
    template <class IsThere>
    void count(std::size_t part, const Points& points, const IsThere& isThere) {
        assert(part < parts_);
        assert(points.count <= cellOfPoint_.size());
        std::uint32_t* const tally = tallies_.data() + part * buckets_;
        std::fill_n(tally, buckets_, 0U);
        const std::size_t last = std::min(points.count, firstOfPart(part + 1));
        for (std::size_t i = firstOfPart(part); i < last; ++i) {
            cellOfPoint_[i] = isThere(i) ? layout_.indexOf(points[i]) : kNowhere;
            if (cellOfPoint_[i] != kNowhere) ++tally[cellOfPoint_[i] / cellsInBucket_];
        }
    }
    // Turns the counts into the places where each part writes into each bucket.
    void arrange();
    // Copies the points of a part into their buckets.
    void spread(std::size_t part, const Points& points);
    // Sorts the points of a bucket by cell; in a cell they keep the order of their index.
    void sort(std::size_t bucket);

    // The points of one run of cells, as a structure of arrays.
    struct Candidates {
        std::span<const float> x, y, z;
        std::span<const std::uint32_t> index;
    };
    // Calls visit(Candidates) for rows of cells, in square rings from the point outwards. Together
    // they hold every point within sqrt(reachSquared), and others. The visitor may lower
    // reachSquared when it has found something: then the search ends sooner.
    template <class Visit>
    void visitAround(glm::vec3 point, const float& reachSquared, Visit&& visit) const {
        const glm::vec3 at = layout_.inCells(point);
        const Cell centre = cellOf(point);
        const Cell most = cells();
        const auto row = [&](int y, int z) {
            if (y < 0 || y >= most.y || z < 0 || z >= most.z) return;
            const float dy = outside(at.y, centre.y, y);
            const float dz = outside(at.z, centre.z, z);
            const float left =
                reachSquared * kSlack - (dy * dy + dz * dz) * cellMetres() * cellMetres();
            if (left < 0) return;
            const float halfWidth = layout_.inCells(std::sqrt(left));
            const int first = CellLayout::clamped(at.x - halfWidth, most.x);
            const int last = CellLayout::clamped(at.x + halfWidth, most.x);
            const Slots slots = slotsOf(first, last, y, z);
            if (slots.first < slots.last) visit(candidates(slots));
        };
        row(centre.y, centre.z);
        // From any cell the farthest is not so far.
        const auto across = static_cast<float>(std::max(most.y, most.z));
        const int cells =
            1 + static_cast<int>(std::min(across, layout_.inCells(std::sqrt(reachSquared))));
        for (int ring = 1; ring <= cells; ++ring) {
            const float nearest = static_cast<float>(ring - 1) * cellMetres();
            if (nearest * nearest > reachSquared * kSlack) return;  // enough was found
            for (int i = -ring; i < ring;
                 ++i) {  // the four sides of a square, each without its end
                row(centre.y + i, centre.z - ring);
                row(centre.y + ring, centre.z + i);
                row(centre.y - i, centre.z + ring);
                row(centre.y - ring, centre.z - i);
            }
        }
    }

    // Memory in use.
    [[nodiscard]] std::size_t bytes() const;

    // For searches that go over the cells themselves. The sorted points stand in slots [first,
    // last); those of a row of cells along x follow one another. Behind the last slot a whole
    // vector may be read.
    struct Slots {
        std::uint32_t first, last;
    };
    // As in CellLayout.
    [[nodiscard]] Cell cellOf(glm::vec3 point) const { return layout_.cellOf(point); }
    [[nodiscard]] Cell cells() const { return layout_.cells(); }
    [[nodiscard]] float cellMetres() const { return layout_.cellMetres(); }
    [[nodiscard]] glm::vec3 origin() const { return layout_.origin(); }
    [[nodiscard]] std::size_t rowOf(int y, int z) const { return layout_.rowOf(y, z); }
    // The slots of cells firstX to lastX, both included, of a row.
    [[nodiscard]] Slots slotsOf(int firstX, int lastX, int y, int z) const {
        const std::uint32_t* const starts = starts_.data() + rowOf(y, z);
        return {starts[firstX], starts[lastX + 1]};
    }
    // Indices [first, last) of cells.
    struct CellRun {
        std::size_t first, last;
    };
    // The cells of a bucket.
    [[nodiscard]] CellRun cellsOfBucket(std::size_t bucket) const {
        return {std::min(bucket * cellsInBucket_, starts_.size() - 1),
                std::min((bucket + 1) * cellsInBucket_, starts_.size() - 1)};
    }
    // Slots of a cell of this bucket. Reads nothing of other buckets, which may not be sorted yet.
    [[nodiscard]] Slots slotsOfCell(std::size_t bucket, std::size_t cell) const {
        const bool isLast = cell + 1 == cellsOfBucket(bucket).last;
        return {starts_[cell], isLast ? bucketStarts_[bucket + 1] : starts_[cell + 1]};
    }
    // Number of points in the grid.
    [[nodiscard]] std::size_t size() const { return starts_.back(); }
    // Columns of the sorted points, by slot.
    [[nodiscard]] const float* x() const { return sorted_.x.data(); }
    [[nodiscard]] const float* y() const { return sorted_.y.data(); }
    [[nodiscard]] const float* z() const { return sorted_.z.data(); }
    [[nodiscard]] const std::uint32_t* index() const { return sorted_.index.data(); }

  private:
    // Points by slot, with room for a vector behind the last.
    struct Columns {
        std::vector<float> x, y, z;
        std::vector<std::uint32_t> index;

        void resize(std::size_t points);
        void put(std::size_t slot, glm::vec3 point, std::uint32_t i) {
            x[slot] = point.x;
            y[slot] = point.y;
            z[slot] = point.z;
            index[slot] = i;
        }
        [[nodiscard]] std::size_t bytes() const;
    };
    // Enlarges a reach by more than rounding can take off it.
    static constexpr float kSlack = 1.001F;
    static constexpr std::size_t kPointsInPart = 4096;
    // Cell of a point that is not there.
    static constexpr std::uint32_t kNowhere = 0xffffffffU;

    // Distance from a point in cell `own` to cell `other` along one axis, in cells.
    [[nodiscard]] static float outside(float at, int own, int other) {
        return other > own   ? static_cast<float>(other) - at
               : other < own ? at - static_cast<float>(other + 1)
                             : 0.0F;
    }
    [[nodiscard]] Candidates candidates(const Slots& slots) const;

    CellLayout layout_;
    std::vector<std::uint32_t> starts_;       // first slot of each cell; one more at the end
    std::vector<std::uint32_t> cellOfPoint_;  // by index; by place where the points are chosen
    Columns sorted_;
    // Data of the steps. tallies_ has for each part and bucket first the number of points, then the
    // place of the next one; bucketStarts_ the first slot of each bucket; spread_ the points by
    // bucket.
    std::size_t parts_, buckets_ = 1, cellsInBucket_ = 1;
    std::vector<std::uint32_t> tallies_, bucketStarts_;
    Columns spread_;
    std::vector<std::uint32_t> spreadCells_;
};

// Which species are in each cell of the grid of all fish, and in each block of 4 x 4 x 4 cells. A
// fish in a school of its own species, as most are, then skips the search for others.
class KindsAbout {
  public:
    // For the cells of a grid; no kind is noted.
    explicit KindsAbout(const SpatialGrid& grid);

    // Forgets all kinds. Before the first note() of a tick.
    void clear();
    // Notes the kinds of the fish of a bucket, once it is sorted. `kinds` is by fish, below 64.
    // Several threads may note different buckets.
    void note(const SpatialGrid& grid, std::size_t bucket, std::span<const std::uint8_t> kinds);

    // Whether the block of cells from `from` to `to` may hold fish of other kinds than `own`. It
    // may wrongly say yes, never wrongly no.
    [[nodiscard]] bool mayHoldOthers(const SpatialGrid::Cell& from,
                                     const SpatialGrid::Cell& to,
                                     std::uint8_t own) const;
    // The same, exact, for a run of cells [first, last] by their index in the whole grid.
    [[nodiscard]] bool rowHoldsOthers(std::size_t first, std::size_t last, std::uint8_t own) const;

    // Memory in use.
    [[nodiscard]] std::size_t bytes() const;

  private:
    [[nodiscard]] std::size_t blockOf(int x, int y, int z) const;

    SpatialGrid::Cell cells_;
    SpatialGrid::Cell blocks_;
    std::vector<std::uint8_t> kindOfCell_;     // kEmpty, kMixed or the kind of all its fish
    std::vector<std::uint64_t> kindsOfBlock_;  // a bit for each kind
};

// A grid of places that do not move, by their index. While none were taken, all are visited: the
// reference for tests.
class PlacesKnown {
  public:
    // Keeps a grid of so many places, of which placeOf(i) is the i-th, in this water.
    template <class PlaceOf>
    void take(const place::Region& water, std::size_t count, const PlaceOf& placeOf) {
        std::vector<glm::vec3> places;
        std::vector<std::uint32_t> all;
        for (std::uint32_t i = 0; i < count; ++i) {
            places.push_back(placeOf(i));
            all.push_back(i);
        }
        grid_ = {water, kCellMetres, count, 4 * count};
        if (count == 0) return;
        const glm::vec3& first = places.front();
        grid_.rebuild({&first.x, &first.y, &first.z, count, 3}, all);
    }
    // Calls visit(i) for the places [0, count) that may be within sqrt(reachSquared) of a point,
    // roughly from there outwards. The visitor may lower reachSquared.
    template <class Visit>
    void visit(glm::vec3 point,
               const float& reachSquared,
               std::size_t count,
               const Visit& visit) const {
        if (grid_.size() != count) {
            for (std::uint32_t i = 0; i < count; ++i) visit(i);
            return;
        }
        grid_.visitAround(point, reachSquared, [&](const SpatialGrid::Candidates& row) {
            for (const std::uint32_t i : row.index) visit(i);
        });
    }

    // Calls find(reachSquared), which visits so far, for growing reaches until it returns true; the
    // last is without end.
    template <class Find>
    static void findOutwards(const Find& find) {
        for (float reach = kCellMetres; reach < kFarthestMetres; reach *= 2)
            if (find(reach * reach)) return;
        find(std::numeric_limits<float>::infinity());
    }

  private:
    static constexpr float kCellMetres = 2.0F;
    static constexpr float kFarthestMetres = 100;

    SpatialGrid grid_{{}, kCellMetres, 0, 1};
};

// A fish of this length or more is a large body: it hides others and is felt from afar.
inline constexpr float kLargeBodyMetres = 0.6F;

// The grids of a world: all fish in a fine grid; predators, large bodies, willing mates and food in
// sparse grids of their own. Owned by the world and rebuilt at each tick; constant while fish
// think.
class Grids {
  public:
    // Room for so many fish and particles of food.
    Grids(const place::Region& water, std::size_t fish, std::size_t food);

    // Makes the grids of predators and of large bodies large enough for these fish, also for those
    // that are away. rebuild() enlarges a grid that is too small, but then it allocates.
    void expect(const fish::FishView& view,
                std::span<const fish::SpeciesParameters> speciesParameters);

    // Makes grids of what does not move in these surroundings, and the rounds of grazers.
    void know(const surroundings::Surroundings& surroundings,
              std::span<const fish::SpeciesParameters> speciesParameters);
    // Rebuilds all grids from the fish and the food that are there. Allocates nothing after
    // expect().
    void rebuild(const fish::FishView& view,
                 const surroundings::Food& particles,
                 std::span<const fish::SpeciesParameters> speciesParameters) {
        rebuild(
            view,
            particles,
            speciesParameters,
            [](std::size_t jobs, const auto& job) {
                for (std::size_t i = 0; i < jobs; ++i) job(i);
            },
            [](std::size_t, std::size_t) {});
    }
    // The same, shared out: share(jobs, job) calls job(i) once for each of [0, jobs), in any order
    // and on any thread, and returns when all are done. look(first, last) is called before fish
    // [first, last) are read, and may write them.
    template <class Share, class Look>
    void rebuild(const fish::FishView& view,
                 const surroundings::Food& particles,
                 std::span<const fish::SpeciesParameters> speciesParameters,
                 const Share& share,
                 const Look& look) {
        const Points points = placesOf(view);
        assert(view.size() <= marks_.size());
        share(fish.parts(), [&](std::size_t part) {
            const std::size_t first = SpatialGrid::firstOfPart(part);
            const std::size_t last = std::min(view.size(), SpatialGrid::firstOfPart(part + 1));
            look(first, last);
            mark(view, speciesParameters, first, last);
            fish.count(part, points, [&](std::size_t i) { return (marks_[i] & kPresent) != 0; });
        });
        fish.arrange();
        kinds.clear();
        share(fish.parts(), [&](std::size_t part) { fish.spread(part, points); });
        share(kSparseGrids + fish.buckets(), [&](std::size_t job) {
            if (job < kSparseGrids) return rebuildSparse(job, points, particles);
            const std::size_t bucket = job - kSparseGrids;
            fish.sort(bucket);
            kinds.note(fish, bucket, view.kind);
        });
    }

    // Memory in use.
    [[nodiscard]] std::size_t bytes() const;

    SpatialGrid fish;
    KindsAbout kinds;  // of the cells of `fish`
    SpatialGrid predators;
    SpatialGrid large;
    SpatialGrid mates;
    SpatialGrid food;
    // Of the surroundings: their sites and patches of turf.
    PlacesKnown sites;
    PlacesKnown turf;
    Loops loops;

  private:
    // Marks of each fish: by them the sparse grids are filled.
    enum Mark : std::uint8_t { kPresent = 1, kPredator = 2, kLarge = 4, kMate = 8 };
    enum Sparse : std::size_t { kMates, kFood, kPredators, kLarges, kSparseGrids };

    // Writes the marks of fish [first, last); a fish that is away gets none.
    void mark(const fish::FishView& view,
              std::span<const fish::SpeciesParameters> speciesParameters,
              std::size_t first,
              std::size_t last);
    [[nodiscard]] static Points placesOf(const fish::FishView& view) {
        constexpr std::size_t kStride = sizeof(fish::VisibleFish) / sizeof(float);
        if (view.size() == 0) return {};
        const glm::vec3& first = view.fish.front().position;
        return {&first.x, &first.y, &first.z, view.size(), kStride};
    }
    void rebuildSparse(std::size_t which,
                       const Points& fishPoints,
                       const surroundings::Food& particles);
    // Indices, ascending, of all fish that have a mark.
    [[nodiscard]] std::span<const std::uint32_t> marked(Sparse which, Mark mark);
    void expect(SpatialGrid& grid, Sparse which, std::size_t count);

    place::Region water_;
    std::vector<std::uint8_t> marks_;  // of each fish
    std::vector<std::uint32_t> chosen_[kSparseGrids];
};

}  // namespace aquarama::behaviour
