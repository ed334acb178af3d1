// SPDX-License-Identifier: Apache-2.0
#include "master/capture/dynamics/rigidity.h"

#include <Eigen/QR>

namespace aquarama::capture {

// A row a unit: how fast its length grows, times that length, as each coordinate does.
int freeShapeChanges(const NodeVectors& positions, std::span<const Unit> units) {
    constexpr Eigen::Index kCoordinates = 3 * Eigen::Index{body::kNodalPoints};
    Eigen::MatrixXd rigidity =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(units.size()), kCoordinates);
    for (std::size_t i = 0; i < units.size(); ++i) {
        const Unit& unit = units[i];
        const glm::dvec3 r = positions.at(unit.second) - positions.at(unit.first);
        for (int p = 0; p < 3; ++p) {
            rigidity(static_cast<Eigen::Index>(i), 3 * unit.first + p) = -r[p];
            rigidity(static_cast<Eigen::Index>(i), 3 * unit.second + p) = r[p];
        }
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> reduced(rigidity);
    // The softest change of shape of a thin fish has a pivot of a hundredth of the largest; what a
    // missing unit leaves is rounding.
    reduced.setThreshold(1e-6);
    return kShapeChanges - static_cast<int>(reduced.rank());
}

}  // namespace aquarama::capture
