// SPDX-License-Identifier: Apache-2.0
#include "drawings/flatten.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace aquarama::drawings {

namespace {

// Moves points about the origin, at a mean distance of one.
glm::dmat3 normalisation(const std::vector<Correspondence>& pairs,
                         glm::dvec2 Correspondence::*side) {
    const auto count = static_cast<double>(pairs.size());
    glm::dvec2 centre{};
    for (const Correspondence& one : pairs) centre += one.*side / count;
    double distance = 0;
    for (const Correspondence& one : pairs) distance += glm::distance(one.*side, centre) / count;
    const double scale = 1 / std::max(distance, 1e-9);
    return {scale, 0, 0, 0, scale, 0, -scale * centre.x, -scale * centre.y, 1};
}

glm::dvec2 applied(const glm::dmat3& map, glm::dvec2 at) {
    const glm::dvec3 to = map * glm::dvec3{at, 1};
    return glm::dvec2{to} / to.z;
}

// The direct linear transform (Hartley and Zisserman 2004, section 4.1) of normalised points.
glm::dmat3 directTransform(const std::vector<Correspondence>& pairs,
                           const glm::dmat3& sheet,
                           const glm::dmat3& photo) {
    const auto rows = static_cast<Eigen::Index>(2 * pairs.size());
    Eigen::MatrixXd equations(rows, 9);
    Eigen::Index row = 0;
    for (const Correspondence& one : pairs) {
        const glm::dvec2 a = applied(sheet, one.onSheet), b = applied(photo, one.inPhoto);
        equations.row(row++) << a.x, a.y, 1, 0, 0, 0, -b.x * a.x, -b.x * a.y, -b.x;
        equations.row(row++) << 0, 0, 0, a.x, a.y, 1, -b.y * a.x, -b.y * a.y, -b.y;
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(equations, Eigen::ComputeFullV);
    const Eigen::VectorXd h = svd.matrixV().col(8);
    return {h(0), h(3), h(6), h(1), h(4), h(7), h(2), h(5), h(8)};
}

}  // namespace

glm::dvec2 Flattening::pixelsPerMillimetre(glm::dvec2 sheet) const {
    const glm::dvec2 at = photoAt(sheet);
    const glm::dmat2 map(photoAt(sheet + glm::dvec2{1, 0}) - at,
                         photoAt(sheet + glm::dvec2{0, 1}) - at);
    // Singular values of a 2 x 2 matrix.
    const double sum = glm::dot(map[0], map[0]) + glm::dot(map[1], map[1]);
    const double area = std::abs(glm::determinant(map));
    const double gap = std::sqrt(std::max(0.0, sum * sum - 4 * area * area));
    return {std::sqrt(std::max(0.0, (sum - gap) / 2)), std::sqrt((sum + gap) / 2)};
}

Flattening flatten(const std::vector<Correspondence>& pairs) {
    const glm::dmat3 sheet = normalisation(pairs, &Correspondence::onSheet);
    const glm::dmat3 photo = normalisation(pairs, &Correspondence::inPhoto);
    Flattening flat{.photoFromSheet =
                        glm::inverse(photo) * directTransform(pairs, sheet, photo) * sheet};
    const glm::dmat3 sheetFromPhoto = glm::inverse(flat.photoFromSheet);
    for (const Correspondence& one : pairs)
        flat.worstMillimetres =
            std::max(flat.worstMillimetres,
                     glm::distance(applied(sheetFromPhoto, one.inPhoto), one.onSheet));
    return flat;
}

}  // namespace aquarama::drawings
