// SPDX-License-Identifier: Apache-2.0
#include "master/study/school_path.h"

#include <algorithm>
#include <cassert>

#include <glm/common.hpp>

namespace aquarama::study {

namespace {

// A coordinate varies where its variance is above this, square metres.
constexpr double kLeastVariance = 1e-12;

glm::dvec3 meanProduct(std::span<const glm::dvec3> differences, std::size_t lag) {
    glm::dvec3 sum{};
    for (std::size_t i = 0; i + lag < differences.size(); ++i)
        sum += differences[i] * differences[i + lag];
    return sum / static_cast<double>(differences.size() - lag);
}

}  // namespace

std::vector<double> autocorrelationOf(std::span<const glm::dvec3> path, std::size_t mostLag) {
    assert(mostLag < path.size());
    glm::dvec3 mean{};
    for (const glm::dvec3& point : path) mean += point / static_cast<double>(path.size());
    std::vector<glm::dvec3> differences;
    for (const glm::dvec3& point : path) differences.push_back(point - mean);
    const glm::dvec3 variance = meanProduct(differences, 0);
    std::vector<double> correlation(mostLag + 1);
    for (std::size_t lag = 0; lag <= mostLag; ++lag) {
        const glm::dvec3 product = meanProduct(differences, lag);
        double sum = 0;
        int varying = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (variance[axis] <= kLeastVariance) continue;
            sum += product[axis] / variance[axis];
            ++varying;
        }
        correlation[lag] = varying > 0 ? sum / varying : 0;
    }
    return correlation;
}

PathPeak highestPeak(std::span<const double> autocorrelation,
                     std::span<const std::size_t> periods,
                     std::size_t tolerance) {
    const auto isOfAPeriod = [&](std::size_t lag) {
        return std::ranges::any_of(periods, [&](std::size_t period) {
            const std::size_t past = lag % period;
            return std::min(past, period - past) <= tolerance;
        });
    };
    const auto zero =
        std::ranges::find_if(autocorrelation, [](double value) { return value <= 0; });
    std::vector<PathPeak> peaks;
    const auto first = static_cast<std::size_t>(zero - autocorrelation.begin()) + 1;
    for (std::size_t lag = first; lag + 1 < autocorrelation.size(); ++lag) {
        const double height = autocorrelation[lag];
        const bool isPeak =
            height >= autocorrelation[lag - 1] && height >= autocorrelation[lag + 1];
        if (isPeak && height > 0 && !isOfAPeriod(lag)) peaks.push_back({height, lag, lag});
    }
    if (peaks.empty()) return {};
    PathPeak highest = *std::ranges::max_element(peaks, {}, &PathPeak::height);
    highest.firstLag = std::ranges::find_if(peaks, [&](const PathPeak& peak) {
                           return peak.height >= highest.height - kAlikePeaks;
                       })->lag;
    return highest;
}

}  // namespace aquarama::study
