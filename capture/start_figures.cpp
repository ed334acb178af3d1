// SPDX-License-Identifier: Apache-2.0
#include "capture/start_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "capture/biomechanical_fish.h"
#include "capture/compile_segment.h"
#include "capture/dynamics.h"
#include "capture/motor_controllers.h"
#include "capture/speed_response.h"
#include "capture/turn.h"

namespace aquarama::capture {

namespace {

// The work on the springs, at the lengths that they have, of a change of their stiffness and rest
// length; fish masses (body lengths / s)^2.
double workOf(const BiomechanicalFish& fish,
              const std::array<UnitState, kUnits>& before,
              const std::array<UnitState, kUnits>& now,
              const NodeVectors& nodes) {
    double work = 0;
    for (std::size_t i = 0; i < kUnits; ++i) {
        const Spring& spring = fish.springs[i];
        const double length = glm::distance(nodes[static_cast<std::size_t>(spring.first)],
                                            nodes[static_cast<std::size_t>(spring.second)]);
        const auto energy = [&](const UnitState& unit) {
            return unit.stiffness * (length - unit.restLength) * (length - unit.restLength) / 2;
        };
        work += energy(now[i]) - energy(before[i]);
    }
    return work;
}

// The circle nearest to the points, seen from above, by least squares of the squared distances
// (Kasa 1976).
double radiusOf(const std::vector<glm::dvec3>& points) {
    const auto count = static_cast<double>(points.size());
    glm::dvec3 mean{};
    for (const glm::dvec3& point : points) mean += point / count;
    double xx = 0, zz = 0, xz = 0, xq = 0, zq = 0;
    for (const glm::dvec3& point : points) {
        const double x = point.x - mean.x, z = point.z - mean.z, q = x * x + z * z;
        xx += x * x;
        zz += z * z;
        xz += x * z;
        xq += x * q / 2;
        zq += z * q / 2;
    }
    const double determinant = xx * zz - xz * xz;
    const double x = (xq * zz - zq * xz) / determinant;
    const double z = (zq * xx - xq * xz) / determinant;
    return std::sqrt(x * x + z * z + (xx + zz) / count);
}

// A fast start while it is simulated.
class Trial {
  public:
    Trial(const config::Species& species, Swimmer swimmer, const glm::dvec3& course, double share)
        : fish_(makeBiomechanicalFish(species)),
          swimmer_(std::move(swimmer)),
          course_(course),
          units_(unitStates(fish_, swimmer_.control())),
          path_{meanOf(fish_, swimmer_.state().positions)} {
        figures_.bendSeconds = share * species.start.bend.seconds;
        figures_.seconds = secondsOf(species.start, share);
        swimmer_.give({.controller = Controller::LeftStart, .bendShare = share});
    }

    // Until as long after the stroke as both stages take.
    StartFigures run(double lengthMetres) {
        const double step = swimmer_.stepSeconds();
        double now = 0;
        while (now < 2 * figures_.seconds) {
            const NodeVectors before = swimmer_.state().positions;
            swimmer_.advance(1);
            now += step;
            if (now <= figures_.seconds + step / 2) addWork(before);
            note(now, step / 2);
        }
        figures_.courseLaterRadians = course();
        if (below_ + step < figures_.seconds) figures_.turnedSeconds = below_;
        figures_.power *= lengthMetres * lengthMetres;
        return figures_;
    }

  private:
    [[nodiscard]] double course() const {
        return yawRadians(course_, meanOf(fish_, swimmer_.state().velocities));
    }

    void addWork(const NodeVectors& nodes) {
        const auto now = unitStates(fish_, swimmer_.control());
        work_ += workOf(fish_, units_, now, nodes);
        workSeconds_ += swimmer_.stepSeconds();
        units_ = now;
        if (workSeconds_ <= kPowerSeconds) return;
        figures_.power = std::max(figures_.power, work_ / workSeconds_);
        work_ = workSeconds_ = 0;
    }

    void note(double now, double tolerance) {
        const FishState& state = swimmer_.state();
        if (now <= figures_.bendSeconds + tolerance)
            figures_.headRadians = yawRadians(course_, frameOf(state.positions).worldFromBody[0]);
        if (now > figures_.seconds + tolerance) return;
        if (course() < kTurnedRadians) below_ = now;
        path_.push_back(meanOf(fish_, state.positions));
        figures_.way += glm::distance(path_.back(), path_[path_.size() - 2]);
        figures_.courseRadians = course();
        figures_.speed = glm::length(meanOf(fish_, state.velocities));
        figures_.radius = radiusOf(path_);
    }

    BiomechanicalFish fish_;
    Swimmer swimmer_;
    glm::dvec3 course_;
    std::array<UnitState, kUnits> units_;
    std::vector<glm::dvec3> path_;
    double work_ = 0, workSeconds_ = 0;
    double below_ = 0;  // the last time at which the course had not turned
    StartFigures figures_{.turnedSeconds = std::numeric_limits<double>::infinity()};
};

}  // namespace

StartFigures startFigures(const config::Species& species,
                          Swimmer swimmer,
                          const glm::dvec3& course,
                          double bendShare) {
    return Trial(species, std::move(swimmer), course, bendShare)
        .run(static_cast<double>(species.size.meanMetres));
}

namespace {

// The table.

constexpr double kDegrees = 180 / std::numbers::pi;  // in a radian
constexpr double kMilliseconds = 1000;
constexpr glm::dvec3 kAhead{1, 0, 0};

// At kRecordedPhases phases of the beat.
std::vector<StartFigures> outOf(const config::Species& species, const config::Gait& gait) {
    const SteadySwimming entry = swimUntilSteady(species, gait);
    std::vector<StartFigures> starts;
    for (int i = 0; i < kRecordedPhases; ++i) {
        Swimmer swimmer = entry.swimmer;
        swimmer.advance(i * motion::kPhases / kRecordedPhases * entry.stepsPerPhase);
        starts.push_back(startFigures(species, std::move(swimmer), entry.beat.course, 1));
    }
    return starts;
}

// "least–most", or one number where both are alike; "never" where it is infinite.
std::string spread(const std::vector<StartFigures>& starts,
                   double StartFigures::*figure,
                   double unit,
                   int decimals) {
    const auto [least, most] = std::ranges::minmax(starts, {}, figure);
    const auto told = [&](double value) {
        std::ostringstream text;
        if (std::isinf(value)) return std::string("never");
        text << std::fixed << std::setprecision(decimals) << value * unit;
        return text.str();
    };
    const std::string first = told(least.*figure), last = told(most.*figure);
    return first == last ? first : first + "–" + last;
}

std::string rowOf(const std::string& head, const std::vector<StartFigures>& starts) {
    const auto cell = [&](double StartFigures::*figure, double unit, int decimals) {
        return " | " + spread(starts, figure, unit, decimals);
    };
    return head + cell(&StartFigures::headRadians, kDegrees, 0) +
           cell(&StartFigures::courseRadians, kDegrees, 0) +
           cell(&StartFigures::courseLaterRadians, kDegrees, 0) +
           cell(&StartFigures::turnedSeconds, kMilliseconds, 0) + cell(&StartFigures::speed, 1, 1) +
           cell(&StartFigures::radius, 1, 2) + cell(&StartFigures::way, 1, 2) +
           cell(&StartFigures::power, 1, 0) + " |\n";
}

}  // namespace

std::string startTableHead() {
    return "| species | out of | stages, ms | head, ° | course, ° | later, ° | 60° after, ms | "
           "speed, L/s | radius, L | way, L | power, W/kg |\n"
           "|---|---|---|---|---|---|---|---|---|---|---|\n";
}

std::string startTableRows(const config::Species& species) {
    constexpr std::array kSizes{"small", "middle", "large"};
    std::string name = species.name;
    std::ranges::replace(name, '_', ' ');
    std::ostringstream rows;
    for (std::size_t i = 0; i < kSizes.size(); ++i) {
        const StartFigures start =
            startFigures(species, Swimmer(species), kAhead, kBendShares.at(i));
        std::ostringstream head;
        head << "| " << (i == 0 ? name : "") << " | rest, " << kSizes.at(i) << " | "
             << std::lround(start.bendSeconds * kMilliseconds) << " + "
             << std::lround((start.seconds - start.bendSeconds) * kMilliseconds);
        rows << rowOf(head.str(), {start});
    }
    rows << rowOf("|  | slow, large | ", outOf(species, species.swim.slow))
         << rowOf("|  | medium, large | ", outOf(species, species.swim.medium));
    return rows.str();
}

}  // namespace aquarama::capture
