// SPDX-License-Identifier: Apache-2.0
#include "calibration/geometry/begin.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <ceres/ceres.h>
#include <glm/geometric.hpp>

namespace aquarama::geometry {

namespace {

// The residual of a tie between a camera and a point of the hall as the rig describes it.
struct Sighting {
    glm::dvec2 seen;
    glm::dvec3 point;
};

struct SightCost {
    Sighting sighting;
    double weight;
    template <class T>
    bool operator()(const T* lens, const T* pose, T* residual) const {
        const Three<T> point{T(sighting.point.x), T(sighting.point.y), T(sighting.point.z)};
        const Three<T> seen = inFrame(pose, point);
        if (seen[2] < 0.01) {
            residual[0] = residual[1] = T(100.0) - seen[2];
            return true;
        }
        const Two<T> place = imaged(lens, Two<T>{seen[0] / seen[2], seen[1] / seen[2]});
        residual[0] = (place[0] - sighting.seen.x) * weight;
        residual[1] = (place[1] - sighting.seen.y) * weight;
        return true;
    }
};

// A first guess: a camera straight before the points that it sees, at the distance where they have
// the size that it sees, rolled by quarter turns.
Device cameraBefore(const std::vector<Sighting>& sightings,
                    const wall::ScreenSurface& screen,
                    glm::ivec2 size,
                    double focal,
                    int quarters) {
    glm::dvec3 middle(0), normal(0);
    glm::dvec2 seenMiddle(0);
    const auto count = static_cast<double>(sightings.size());
    for (const Sighting& one : sightings) {
        middle += one.point / count;
        normal += glm::normalize(screen.normalAt(one.point)) / count;
        seenMiddle += one.seen / count;
    }
    normal = glm::normalize(normal);
    double spread = 0, seenSpread = 0;
    for (const Sighting& one : sightings) {
        spread += glm::distance(one.point, middle) / count;
        seenSpread += glm::distance(one.seen, seenMiddle) / count;
    }
    const glm::dvec3 position = middle + normal * (focal * spread / std::max(1.0, seenSpread));
    const glm::dvec3 aside = glm::normalize(
        glm::cross(std::abs(normal.y) > 0.9 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0), normal));
    const glm::dvec3 up = glm::cross(normal, aside);
    const double roll = quarters * std::numbers::pi / 2;
    const glm::dvec3 right = std::cos(roll) * aside + std::sin(roll) * up;
    Device camera;
    camera.lens[lens::Focal] = focal;
    camera.lens[lens::Aspect] = 1;
    camera.lens[lens::CentreX] = 0.5 * size.x;
    camera.lens[lens::CentreY] = 0.5 * size.y;
    camera.pose = poseOf(position, glm::dmat3(right, glm::cross(normal, right), normal));
    return camera;
}

Sighted sighted(Device camera, const std::vector<Sighting>& sightings, glm::ivec2 size) {
    ceres::Problem problem;
    const double weight = 100.0 / size.x;  // a hundredth of the picture's width is an error of one
    for (const Sighting& one : sightings)
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<SightCost, 2, lens::Count, 6>(
                                     new SightCost{one, weight}),
                                 new ceres::CauchyLoss(2.0),
                                 camera.lens.data(),
                                 camera.pose.data());
    problem.SetManifold(
        camera.lens.data(),
        new ceres::SubsetManifold(
            lens::Count,
            {lens::Aspect, lens::CentreX, lens::CentreY, lens::K2, lens::K3, lens::P1, lens::P2}));
    problem.SetParameterLowerBound(camera.lens.data(), lens::Focal, 0.25 * size.x);
    problem.SetParameterUpperBound(camera.lens.data(), lens::Focal, 10.0 * size.x);
    problem.SetParameterLowerBound(camera.lens.data(), lens::K1, -0.3);
    problem.SetParameterUpperBound(camera.lens.data(), lens::K1, 0.3);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 60;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return {camera, summary.final_cost / static_cast<double>(sightings.size())};
}

// `order[i]`: the channel of the rig that hangs where channel i of the scan is seen.
std::vector<Sighting> sightingsOf(const std::vector<Tie>& ties,
                                  std::uint32_t camera,
                                  const wall::Wall& wall,
                                  const std::vector<std::size_t>& order) {
    constexpr std::size_t kMost = 500;
    std::vector<Sighting> sightings;
    const std::size_t step = std::max<std::size_t>(1, ties.size() / kMost);
    for (std::size_t i = 0; i < ties.size(); i += step) {
        const Tie& tie = ties[i];
        if (tie.camera != camera) continue;
        if (const auto point = wall.channel(order[tie.channel]).pointOf(tie.place, 0.5))
            sightings.push_back({tie.seen, *point});
    }
    return sightings;
}

}  // namespace

std::optional<Sighted> bestSighted(const std::vector<Tie>& ties,
                                   std::uint32_t camera,
                                   const wall::Wall& wall,
                                   glm::ivec2 size,
                                   const std::vector<std::size_t>& order) {
    const std::vector<Sighting> sightings = sightingsOf(ties, camera, wall, order);
    constexpr std::size_t kLeast = 30;
    if (sightings.size() < kLeast) return std::nullopt;
    constexpr double kGood = 0.1;
    Sighted best{.camera = {}, .loss = 1e30};
    for (const int quarters : {0, 2, 1, 3})
        for (const double focal : {0.55, 0.8, 1.2}) {
            const Sighted now =
                sighted(cameraBefore(sightings, wall.screen(), size, focal * size.x, quarters),
                        sightings,
                        size);
            if (now.loss < best.loss) best = now;
            if (best.loss < kGood) return best;
        }
    return best;
}

std::optional<std::pair<std::size_t, std::size_t>> swappedPair(const config::Rig& rig,
                                                               const wall::Wall& wall,
                                                               const std::vector<Tie>& ties,
                                                               glm::ivec2 size,
                                                               double loss) {
    constexpr double kSuspicious = 0.6, kMuchBetter = 0.4;
    if (loss < kSuspicious) return std::nullopt;
    std::vector<std::size_t> order(rig.channels.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::optional<std::pair<std::size_t, std::size_t>> found;
    double least = kMuchBetter * loss;
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            if (rig.channels[i].sizePixels != rig.channels[j].sizePixels) continue;
            std::swap(order[i], order[j]);
            const auto now = bestSighted(ties, 0, wall, size, order);
            std::swap(order[i], order[j]);
            if (!now || now->loss >= least) continue;
            least = now->loss;
            found = {i, j};
        }
    return found;
}

}  // namespace aquarama::geometry
