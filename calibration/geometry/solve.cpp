// SPDX-License-Identifier: Apache-2.0
#include "calibration/geometry/solve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "calibration/geometry/begin.h"
#include "calibration/geometry/correct.h"
#include "calibration/geometry/joint.h"
#include "common/base/statistics.h"

namespace aquarama::geometry {

namespace {

// The cells of the displacement over the screen, each about kMetres wide.
glm::ivec2 cellsFor(const wall::ScreenSurface& screen) {
    constexpr double kMetres = 0.30;
    constexpr int kSteps = 32;
    glm::dvec2 length(0);
    for (int i = 0; i < kSteps; ++i) {
        const auto far = [&](glm::dvec2 from, glm::dvec2 to) {
            const auto a = screen.at(from), b = screen.at(to);
            return a && b ? glm::distance(*a, *b) : 0.0;
        };
        const double t = static_cast<double>(i) / kSteps, next = t + 1.0 / kSteps;
        length.x += far({t, 0.5}, {next, 0.5});
        length.y += far({0.5, t}, {0.5, next});
    }
    return glm::clamp(glm::ivec2(glm::round(length / kMetres)), glm::ivec2(4), glm::ivec2(40));
}

// How far apart two channels show the place of these two ties.
std::optional<Parting> partedBy(const SolvedHall& hall, const Tie& tie, const Tie& other) {
    const auto a = hall.placeOf(tie.channel, tie.place);
    const auto b = hall.placeOf(other.channel, other.place);
    if (!a || !b) return std::nullopt;
    const glm::dvec2 one = hall.panoramaPixel(a->point), two = hall.panoramaPixel(b->point);
    return Parting{(one + two) / 2.0, glm::distance(one, two)};
}

// The errors between channels in held-out windows.
std::vector<Parting> overlapErrors(const SolvedHall& hall, const std::vector<Tie>& ties) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<const Tie*>> windows;
    for (const Tie& tie : ties)
        if (tie.heldOut) windows[{tie.camera, tie.window}].push_back(&tie);
    std::vector<Parting> errors;
    for (const auto& [key, seen] : windows)
        for (std::size_t i = 0; i < seen.size(); ++i)
            for (std::size_t j = i + 1; j < seen.size(); ++j)
                if (const auto parted = partedBy(hall, *seen[i], *seen[j]))
                    errors.push_back(*parted);
    return errors;
}

double fitRms(const SolvedHall& hall, const std::vector<Tie>& ties) {
    std::vector<double> errors;
    for (const Tie& tie : ties)
        if (!tie.heldOut)
            if (const auto place = hall.modelled(tie))
                errors.push_back(glm::distance(*place, tie.place));
    return rootMeanSquare(errors);
}

std::vector<OutlineTie> outlinesOf(const SolvedHall& hall,
                                   const std::vector<scan::CameraView>& views,
                                   double reachShare) {
    std::vector<OutlineTie> ties;
    for (std::uint32_t i = 0; i < views.size(); ++i) {
        const auto more = outlineTies(views[i].room,
                                      i,
                                      hall.screen,
                                      hall.cameras[i].lens,
                                      hall.cameras[i].pose,
                                      reachShare * views[i].sizePixels.x);
        ties.insert(ties.end(), more.begin(), more.end());
    }
    return ties;
}

std::vector<MarkTie> marksOf(const SolvedHall& hall, const std::vector<scan::CameraView>& views) {
    std::vector<MarkTie> marks;
    for (std::uint32_t i = 0; i < views.size(); ++i) {
        const Device& camera = hall.cameras[i];
        const std::vector<MarkTie> more = markTies(
            views[i].room, i, hall.rig.screen.shape, hall.screen, camera.lens, camera.pose);
        marks.insert(marks.end(), more.begin(), more.end());
    }
    return marks;
}

// One round of the joint solve: the free parameters, how far the outline is searched, and standard
// deviations of outline and ties beside their own noise.
struct Pass {
    FreeParts stage;
    double outlineReach;  // of the picture's width
    double outlinePixels, tiePixels;
    int mostSteps;
};
constexpr std::array kPasses{Pass{FreeParts::Poses, 0.04, 8, 4, 25},
                             Pass{FreeParts::Lenses, 0.015, 2, 1, 60},
                             Pass{FreeParts::Bumps, 0.006, 0.7, 0.3, 60},
                             Pass{FreeParts::Bumps, 0.003, 0.2, 0.12, 60}};

// The standard deviation of a tie in the last round. Errors of the lens model are alike in
// neighbouring windows, so that many windows measure no better than one: the error of the fit
// before is multiplied by the root of their number.
double lastTiePixels(double fitRms) {
    constexpr double kNeighbours = 16, kLeast = kPasses.back().tiePixels, kMost = 0.5;
    return std::clamp(std::sqrt(kNeighbours) * fitRms, kLeast, kMost);
}

double outlineRms(const SolvedHall& hall, const std::vector<OutlineTie>& outline) {
    std::vector<double> off;
    for (const OutlineTie& tie : outline) {
        const Device& camera = hall.cameras[tie.camera];
        const glm::dvec3 point = hall.screen.at(tie.unrolled).point;
        const Two<double> seen = pixelOf(
            camera.lens.data(), camera.pose.data(), Three<double>{point.x, point.y, point.z});
        off.push_back(glm::dot(glm::dvec2(seen[0], seen[1]) - tie.seen, tie.across));
    }
    return rootMeanSquare(off);
}

// Pixels of the first camera, spread over all of the screen.
std::vector<glm::dvec2> someSeen(const std::vector<Tie>& ties) {
    constexpr std::size_t kPlaces = 60;
    std::vector<glm::dvec2> seen;
    const std::size_t step = std::max<std::size_t>(1, ties.size() / kPlaces);
    for (std::size_t i = 0; i < ties.size(); i += step)
        if (ties[i].camera == 0) seen.push_back(ties[i].seen);
    return seen;
}

// The pixel where a camera sees a point; nothing outside its picture.
std::optional<glm::dvec2> seenBy(const Device& camera, glm::ivec2 size, glm::dvec3 point) {
    const Three<double> at{point.x, point.y, point.z};
    if (inFrame(camera.pose.data(), at)[2] <= 0) return std::nullopt;
    const Two<double> seen = pixelOf(camera.lens.data(), camera.pose.data(), at);
    const glm::dvec2 pixel(seen[0], seen[1]);
    const bool inside = glm::clamp(pixel, glm::dvec2(0), glm::dvec2(size)) == pixel;
    return inside ? std::optional(pixel) : std::nullopt;
}

// A cell of the uncertainty map that a camera sees.
struct SeenCell {
    std::size_t index;
    glm::dvec2 pixel;
};
std::vector<SeenCell> cellsSeen(const UncertaintyMap& map,
                                const SolvedHall& hall,
                                const Device& camera,
                                glm::ivec2 cameraSize) {
    std::vector<SeenCell> cells;
    for (std::size_t i = 0; i < map.pixels.size(); ++i) {
        const int index = static_cast<int>(i);
        const glm::dvec2 place =
            (glm::dvec2(index % map.size.x, index / map.size.x) + 0.5) / glm::dvec2(map.size);
        if (!std::isnan(map.pixels[i]) || !hall.nominal.screen().at(place)) continue;
        if (const auto pixel = seenBy(camera, cameraSize, hall.screen.at(place).point))
            cells.push_back({i, *pixel});
    }
    return cells;
}

// The map, for each cell by the first camera that sees it.
UncertaintyMap uncertaintyMap(JointProblem& joint,
                              const SolvedHall& hall,
                              const std::vector<glm::ivec2>& cameraSizes) {
    constexpr int kColumns = 40;
    const glm::ivec2 panorama = hall.rig.panoramaPixels;
    UncertaintyMap map{{kColumns, std::max(2, kColumns * panorama.y / panorama.x)}, {}};
    map.pixels.assign(static_cast<std::size_t>(map.size.x * map.size.y),
                      std::numeric_limits<double>::quiet_NaN());
    for (std::size_t camera = 0; camera < hall.cameras.size(); ++camera) {
        const std::vector<SeenCell> cells =
            cellsSeen(map, hall, hall.cameras[camera], cameraSizes[camera]);
        std::vector<glm::dvec2> seen;
        for (const SeenCell& cell : cells) seen.push_back(cell.pixel);
        const std::vector<double> sigma = joint.uncertainty(camera, seen);
        for (std::size_t i = 0; i < cells.size(); ++i) map.pixels[cells[i].index] = sigma[i];
    }
    return map;
}

void fit(Solved& solved, const std::vector<scan::CameraView>& views) {
    SolvedHall& hall = *solved.hall;
    const std::vector<Device> expected = hall.projectors;
    std::vector<glm::ivec2> sizes;
    for (const scan::CameraView& view : views) sizes.push_back(view.sizePixels);
    for (const Pass& round : kPasses) {
        JointProblem joint(hall, expected, sizes);
        const bool isLast = &round == &kPasses.back();
        const double tiePixels =
            isLast ? lastTiePixels(fitRms(hall, solved.ties)) : round.tiePixels;
        for (const Tie& tie : solved.ties)
            if (!tie.heldOut) joint.add(tie, tiePixels);
        const std::vector<OutlineTie> outline = outlinesOf(hall, views, round.outlineReach);
        for (const OutlineTie& tie : outline) joint.add(tie, round.outlinePixels);
        const std::vector<MarkTie> marks = marksOf(hall, views);
        for (const MarkTie& mark : marks) joint.add(mark.tie, mark.sigma);
        joint.solve(round.stage, round.mostSteps);
        if (!isLast) continue;
        solved.figures.marks = marks.size();
        solved.figures.outlinePoints = outline.size();
        solved.figures.outlineRms = outlineRms(hall, outline);
        solved.figures.absoluteSigma = rootMeanSquare(joint.uncertainty(0, someSeen(solved.ties)));
        solved.uncertainty = uncertaintyMap(joint, hall, sizes);
    }
}

// The reason why a camera cannot be found: a fault of its pictures, if they have one.
scan::ScanFault tooLittleSeen(const std::vector<scan::CameraView>& views, std::uint32_t camera) {
    for (const scan::ScanFault& fault : views[camera].faults)
        if (fault.refuses) return fault;
    return {"wall_not_seen",
            fmt::format("camera {} sees too little of the wall: place it where it sees the whole "
                        "screen, and scan again",
                        camera)};
}

// Finds the cameras, with the projectors as the rig has them. False where a camera sees too little
// or cables are exchanged.
bool begin(Solved& solved, const std::vector<scan::CameraView>& views) {
    SolvedHall& hall = *solved.hall;
    std::vector<std::size_t> order(hall.rig.channels.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::uint32_t i = 0; i < views.size(); ++i) {
        const auto camera = bestSighted(solved.ties, i, hall.nominal, views[i].sizePixels, order);
        if (!camera) {
            solved.faults.push_back(tooLittleSeen(views, i));
            return false;
        }
        hall.cameras.push_back(camera->camera);
        if (i > 0) continue;
        const auto swapped =
            swappedPair(hall.rig, hall.nominal, solved.ties, views[i].sizePixels, camera->loss);
        if (!swapped) continue;
        solved.faults.push_back(
            {"swapped_outputs",
             fmt::format("channel \"{}\" is seen where \"{}\" hangs: exchange their cables, or "
                         "their outputs in the rig, and scan again",
                         hall.rig.channels[swapped->first].name,
                         hall.rig.channels[swapped->second].name)});
        return false;
    }
    return true;
}

}  // namespace

OverlapFigures overlapFigures(const std::vector<double>& errors) {
    return {.points = errors.size(),
            .rms = rootMeanSquare(errors),
            .p95 = quantile(errors, 0.95),
            .most = quantile(errors, 1)};
}

Solved solveHall(const config::Rig& rig,
                 const wall::Wall& wall,
                 const std::vector<scan::CameraView>& views,
                 const std::function<void(const std::string&)>& progress) {
    constexpr std::size_t kMostWindows = 2500;
    std::vector<Tie> ties;
    for (std::uint32_t i = 0; i < views.size(); ++i) {
        const std::vector<Tie> more = tiesOf(views[i], i, kMostWindows);
        ties.insert(ties.end(), more.begin(), more.end());
    }
    return solveTies(rig, wall, views, std::move(ties), progress);
}

Solved solveTies(const config::Rig& rig,
                 const wall::Wall& wall,
                 const std::vector<scan::CameraView>& views,
                 std::vector<Tie> ties,
                 const std::function<void(const std::string&)>& progress) {
    Solved solved{.hall = std::make_unique<SolvedHall>(rig, wall, cellsFor(wall.screen())),
                  .ties = std::move(ties),
                  .figures = {},
                  .faults = {}};
    progress("finding the camera");
    if (!begin(solved, views)) return solved;
    progress("fitting projectors, camera and screen");
    fit(solved, views);
    progress("fitting what is left of the lenses");
    solved.figures.fitRms = fitRms(*solved.hall, solved.ties);
    correct(*solved.hall, solved.ties);
    solved.partings = overlapErrors(*solved.hall, solved.ties);
    std::vector<double> errors;
    for (const Parting& parting : solved.partings) errors.push_back(parting.pixels);
    solved.figures.overlap = overlapFigures(errors);
    return solved;
}

}  // namespace aquarama::geometry
