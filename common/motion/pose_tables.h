// SPDX-License-Identifier: Apache-2.0
// The poses of a repertoire as vector units like to read them, made once for a species.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/body/point_groups.h"
#include "common/motion/repertoire.h"

namespace aquarama::motion {

// Every pose of every segment: groups of x, y, z. Behind each cycle its first pose again, so that
// the two poses about a phase always follow one another.
template <std::size_t kPoints, class Number>
class PoseTable {
  public:
    struct alignas(body::kPointGroup * sizeof(Number)) Group {
        std::array<std::array<Number, body::kPointGroup>, 3> axes;
    };
    static constexpr std::size_t kGroups = body::groupsOf(kPoints);
    using Pose = std::array<Group, kGroups>;

    static constexpr std::size_t firstPointOf(std::size_t group) {
        return body::firstPointOf(group, kPoints);
    }

    // posesOf(segment)[phase][point] are three numbers. No poses at all where a segment has none.
    template <class PosesOf>
    PoseTable(const Repertoire& repertoire, const PosesOf& posesOf) {
        for (const ActionSegment& segment : repertoire.segments) {
            const auto& poses = posesOf(segment);
            if (poses.size() != kPhases) continue;
            for (std::size_t k = 0; k <= kPhases; ++k) add(poses[k % kPhases]);
        }
    }

    // The pose at or before the phase; the next follows it.
    [[nodiscard]] const Pose* at(std::uint32_t segment, std::size_t phase) const {
        const std::size_t cycle = std::min<std::size_t>(segment, kActions - 1);
        return &poses_[cycle * (kPhases + 1) + phase];
    }
    [[nodiscard]] bool empty() const { return poses_.empty(); }
    [[nodiscard]] std::size_t bytes() const { return poses_.size() * sizeof(Pose); }

  private:
    template <class Points>
    void add(const Points& points) {
        Pose& pose = poses_.emplace_back();
        for (std::size_t group = 0; group < kGroups; ++group)
            for (std::size_t i = 0; i < body::kPointGroup; ++i)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    pose[group].axes[axis][i] = points[firstPointOf(group) + i][axis];
    }

    std::vector<Pose> poses_;
};

// Nodal points as floats, because a fish's two or four poses are read from the nearest cache;
// control points as the 16 bits in which they were recorded, because theirs are read from farther.
// Both in units of kPoseUnit.
struct ReconstructTables {
    PoseTable<body::kNodalPoints, float> nodes;
    PoseTable<body::kControlPoints, std::int16_t> controlPoints;  // empty where none were recorded
};

[[nodiscard]] ReconstructTables makeReconstructTables(const Repertoire& repertoire);

}  // namespace aquarama::motion
