// SPDX-License-Identifier: Apache-2.0
#include "common/motion/pose_tables.h"

namespace aquarama::motion {

ReconstructTables makeReconstructTables(const Repertoire& repertoire) {
    const auto nodesOf = [](const ActionSegment& segment) -> const auto& {
        return segment.nodes;
    };
    const auto controlPointsOf = [](const ActionSegment& segment) -> const auto& {
        return segment.controlPoints;
    };
    return {{repertoire, nodesOf}, {repertoire, controlPointsOf}};
}

}  // namespace aquarama::motion
