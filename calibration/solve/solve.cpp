// SPDX-License-Identifier: Apache-2.0
#include "calibration/solve/solve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <thread>
#include <utility>

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "calibration/solve/correct.h"
#include "common/base/log.h"

namespace aquarama::solve {

namespace {

// The part of a dual number that is no derivative.
double valueOf(double x) {
    return x;
}
template <class T, int N>
double valueOf(const ceres::Jet<T, N>& x) {
    return x.a;
}
template <class T>
LensParameters valuesOf(const T* lens) {
    LensParameters values;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = valueOf(lens[i]);
    return values;
}
template <class T>
PoseParameters poseValuesOf(const T* pose) {
    PoseParameters values;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = valueOf(pose[i]);
    return values;
}

// The screen's displacement by the sixteen controls of one cell, also a little beyond the cell.
class CellDisplacement {
  public:
    CellDisplacement(glm::ivec2 cells, glm::ivec2 index) : cells_{cells}, index_{index} {}
    [[nodiscard]] glm::dvec2 within(glm::dvec2 place) const { return place * cells_ - index_; }
    // Of values and controls of one type: a number, or a dual one at a place without derivatives.
    template <class T>
    [[nodiscard]] T sum(glm::dvec2 place, const std::array<T, 16>& controls) const {
        const glm::dvec2 at = within(place);
        const auto across = splineWeights(at.x);
        const auto down = splineWeights(at.y);
        T sum(0.0);
        for (std::size_t i = 0; i < 16; ++i) sum += across[i % 4] * down[i / 4] * controls[i];
        return sum;
    }

  private:
    glm::dvec2 cells_, index_;
};

// The same with its controls, as BumpyScreen wants it.
struct HeldDisplacement {
    CellDisplacement cell;
    std::array<double, 16> controls;
    [[nodiscard]] double at(glm::dvec2 place) const { return cell.sum(place, controls); }
};

// Pixels of a channel between the place that lights what a camera sees and the one that the model
// says. The screen is met in double; its derivatives are those of the plane that touches it there.
class TieCost {
  public:
    TieCost(const BumpyScreen& screen, const Tie& tie, CellDisplacement cell, double sigma)
        : screen_{screen}, tie_{tie}, cell_{cell}, weight_{1 / sigma} {}

    // clang-format off
    template <class T>
    bool operator()(const T* cameraLens, const T* cameraPose, const T* lens, const T* pose,
                    const T* c0, const T* c1, const T* c2, const T* c3,
                    const T* c4, const T* c5, const T* c6, const T* c7,
                    const T* c8, const T* c9, const T* c10, const T* c11,
                    const T* c12, const T* c13, const T* c14, const T* c15, T* residual) const {
        return evaluate(cameraLens, cameraPose, lens, pose,
                        {*c0, *c1, *c2, *c3, *c4, *c5, *c6, *c7,
                         *c8, *c9, *c10, *c11, *c12, *c13, *c14, *c15}, residual);
    }
    // clang-format on

  private:
    template <class T>
    bool evaluate(const T* cameraLens,
                  const T* cameraPose,
                  const T* lens,
                  const T* pose,
                  const std::array<T, 16>& controls,
                  T* residual) const {
        const Tangent tangent = tangentOf(valuesOf(cameraLens), tie_.seen);
        const RayOf<T> ray = rayOf(cameraLens, cameraPose, tie_.seen, tangent);
        HeldDisplacement held{cell_, {}};
        for (std::size_t i = 0; i < 16; ++i) held.controls[i] = valueOf(controls[i]);
        const auto hit = screen_.hit(
            {{valueOf(ray.origin[0]), valueOf(ray.origin[1]), valueOf(ray.origin[2])},
             {valueOf(ray.direction[0]), valueOf(ray.direction[1]), valueOf(ray.direction[2])}},
            held);
        if (!hit) {  // as far off as a picture is wide: a loss that bends makes little of it
            residual[0] = residual[1] = T(1000.0);
            return true;
        }
        const T moved = cell_.sum(hit->unrolled, controls) - held.at(hit->unrolled);
        const Three<T> normal{T(hit->normal.x), T(hit->normal.y), T(hit->normal.z)};
        Three<T> from;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto axis = static_cast<glm::length_t>(i);
            from[i] = hit->point[axis] + moved * hit->baseNormal[axis] - ray.origin[i];
        }
        const T along = dot(normal, from) / dot(normal, ray.direction);
        Three<T> point;
        for (std::size_t i = 0; i < 3; ++i) point[i] = ray.origin[i] + along * ray.direction[i];
        const Three<T> seen = inFrame(pose, point);
        if (valueOf(seen[2]) <= 0.01) {
            residual[0] = residual[1] = T(1000.0);
            return true;
        }
        const Two<T> place = imaged(lens, Two<T>{seen[0] / seen[2], seen[1] / seen[2]});
        residual[0] = (place[0] - tie_.place.x) * weight_;
        residual[1] = (place[1] - tie_.place.y) * weight_;
        return true;
    }

    const BumpyScreen& screen_;
    Tie tie_;
    CellDisplacement cell_;
    double weight_;
};

// Pixels of a camera, across the outline.
class OutlineCost {
  public:
    OutlineCost(const OutlineTie& tie, CellDisplacement cell, double sigma)
        : tie_{tie}, cell_{cell}, weight_{1 / sigma} {}

    // clang-format off
    template <class T>
    bool operator()(const T* lens, const T* pose,
                    const T* c0, const T* c1, const T* c2, const T* c3,
                    const T* c4, const T* c5, const T* c6, const T* c7,
                    const T* c8, const T* c9, const T* c10, const T* c11,
                    const T* c12, const T* c13, const T* c14, const T* c15, T* residual) const {
        const std::array<T, 16> controls{*c0, *c1, *c2, *c3, *c4, *c5, *c6, *c7,
                                         *c8, *c9, *c10, *c11, *c12, *c13, *c14, *c15};
        // clang-format on
        const T moved = cell_.sum(tie_.unrolled, controls);
        Three<T> point;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto axis = static_cast<glm::length_t>(i);
            point[i] = tie_.base[axis] + moved * tie_.baseNormal[axis];
        }
        const Two<T> seen = pixelOf(lens, pose, point);
        residual[0] =
            ((seen[0] - tie_.seen.x) * tie_.across.x + (seen[1] - tie_.seen.y) * tie_.across.y) *
            weight_;
        return true;
    }

  private:
    OutlineTie tie_;
    CellDisplacement cell_;
    double weight_;
};

// Keeps each value near an expected one.
struct NearCost {
    std::vector<double> expected, sigma;
    template <class T>
    bool operator()(T const* const* parameters, T* residual) const {
        for (std::size_t i = 0; i < expected.size(); ++i)
            residual[i] = (parameters[0][i] - expected[i]) / sigma[i];
        return true;
    }
};

// Bends of the displacement, from one control to the next.
struct BendCost {
    double weight;
    template <class T>
    bool operator()(const T* before, const T* here, const T* after, T* residual) const {
        residual[0] = weight * (*before - 2.0 * *here + *after);
        return true;
    }
};
struct FlatCost {
    double weight;
    template <class T>
    bool operator()(const T* here, T* residual) const {
        residual[0] = weight * *here;
        return true;
    }
};

// How far a value may be from what the rig and makers of lenses say: standard deviations.
struct Expectation {
    static constexpr double kPositionMetres = 0.25;
    static constexpr double kTurnRadians = 0.15;
    static constexpr double kFocalShare = 0.1;
    static constexpr double kAspect = 0.004;
    static constexpr double kCentreShare = 0.3;  // of a projector's picture: lens shift
    static constexpr double kCameraCentreShare = 0.03;
    static constexpr double kCameraFocalShare = 0.5;
    static constexpr double kRadial = 0.15;
    static constexpr double kHigherRadial = 0.08;
    static constexpr double kTangential = 0.004;
    static constexpr double kDisplacementMetres = 0.06;
    static constexpr double kBendMetres = 0.008;  // between neighbouring controls
    static constexpr double kPlacePixels = 0.12;  // what the model does not know of lenses
    static constexpr double kOutlinePixels = 0.35;
};

enum class Stage : std::uint8_t { Poses, Lenses, Bumps };

std::vector<int> heldLensParameters(Stage stage, bool isCamera) {
    if (stage == Stage::Poses) {
        std::vector<int> held{lens::Aspect, lens::K1, lens::K2, lens::K3, lens::P1, lens::P2};
        if (isCamera) held.insert(held.end(), {lens::CentreX, lens::CentreY});
        return held;
    }
    if (isCamera) return {lens::Aspect};
    return stage == Stage::Lenses ? std::vector<int>{lens::K3} : std::vector<int>{};
}

// One problem for Ceres, built of the hall as it is so far; solving it moves the hall.
class Joint {
  public:
    Joint(SolvedHall& hall,
          const std::vector<Device>& expected,
          const std::vector<glm::ivec2>& cameraSizes)
        : hall_{hall} {
        ceres::Problem::Options options;
        options.enable_fast_removal = false;
        for (double& control : hall_.screen.displacement().controls())
            problem_.AddParameterBlock(&control, 1);
        for (std::size_t i = 0; i < hall_.cameras.size(); ++i)
            expectCamera(hall_.cameras[i], cameraSizes[i]);
        for (std::size_t i = 0; i < hall_.projectors.size(); ++i)
            expectProjector(hall_.projectors[i], expected[i], hall_.rig.channels[i].sizePixels);
        expectScreen();
    }

    void add(const Tie& tie, double leastSigma) {
        const auto seen = hall_.placeSeen(tie.camera, tie.seen);
        if (!seen || glm::any(glm::greaterThan(glm::abs(seen->unrolled - 0.5), glm::dvec2(0.5))))
            return;
        const CellDisplacement cell = cellAt(seen->unrolled);
        Device& camera = hall_.cameras[tie.camera];
        Device& projector = hall_.projectors[tie.channel];
        std::vector<double*> blocks{
            camera.lens.data(), camera.pose.data(), projector.lens.data(), projector.pose.data()};
        addControls(blocks, seen->unrolled);
        const double sigma = std::hypot(tie.sigma, leastSigma);
        auto* cost =
            new ceres::AutoDiffCostFunction<TieCost,
                                            2,
                                            lens::Count,
                                            6,
                                            lens::Count,
                                            6,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1>(new TieCost(hall_.screen, tie, cell, sigma));
        problem_.AddResidualBlock(cost, new ceres::CauchyLoss(2.0), blocks);
    }
    void add(const OutlineTie& tie, double sigma) {
        Device& camera = hall_.cameras[tie.camera];
        std::vector<double*> blocks{camera.lens.data(), camera.pose.data()};
        addControls(blocks, tie.unrolled);
        auto* cost =
            new ceres::AutoDiffCostFunction<OutlineCost,
                                            1,
                                            lens::Count,
                                            6,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1,
                                            1>(new OutlineCost(tie, cellAt(tie.unrolled), sigma));
        problem_.AddResidualBlock(cost, new ceres::CauchyLoss(2.0), blocks);
    }

    void solve(Stage stage, int steps) {
        for (Device& camera : hall_.cameras) hold(camera, heldLensParameters(stage, true));
        for (Device& projector : hall_.projectors)
            hold(projector, heldLensParameters(stage, false));
        if (stage != Stage::Bumps)
            for (double& control : hall_.screen.displacement().controls())
                problem_.SetParameterBlockConstant(&control);
        ceres::Solver::Options options;
        options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
        options.max_num_iterations = steps;
        options.function_tolerance = 1e-5;
        options.num_threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
        options.logging_type = ceres::SILENT;
        ceres::Solver::Summary summary;
        ceres::Solve(options, &problem_, &summary);
        if (std::getenv("AQ_SOLVE")) fmt::print("{}\n", summary.BriefReport());
    }

  private:
    [[nodiscard]] CellDisplacement cellAt(glm::dvec2 unrolled) const {
        const SmoothField& field = hall_.screen.displacement();
        return {field.cells(), field.cellAt(unrolled).index};
    }
    void addControls(std::vector<double*>& blocks, glm::dvec2 unrolled) {
        SmoothField& field = hall_.screen.displacement();
        const glm::ivec2 index = field.cellAt(unrolled).index;
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < 4; ++column)
                blocks.push_back(&field.controls()[field.control(index.x + column, index.y + row)]);
    }
    void hold(Device& device, const std::vector<int>& held) {
        problem_.SetManifold(device.lens.data(),
                             held.empty() ? nullptr : new ceres::SubsetManifold(lens::Count, held));
    }
    void expect(double* block, std::vector<double> expected, std::vector<double> sigma) {
        const int count = static_cast<int>(expected.size());
        auto* cost = new ceres::DynamicAutoDiffCostFunction<NearCost, 4>(
            new NearCost{std::move(expected), std::move(sigma)});
        cost->AddParameterBlock(count);
        cost->SetNumResiduals(count);
        problem_.AddResidualBlock(cost, nullptr, block);
    }
    static std::vector<double> lensSigma(double focal, double centre, const LensParameters& lens) {
        std::vector<double> sigma(lens::Count);
        sigma[lens::Focal] = focal * lens[lens::Focal];
        sigma[lens::Aspect] = Expectation::kAspect;
        sigma[lens::CentreX] = sigma[lens::CentreY] = centre;
        sigma[lens::K1] = sigma[lens::K2] = Expectation::kRadial;
        sigma[lens::K3] = Expectation::kHigherRadial;
        sigma[lens::P1] = sigma[lens::P2] = Expectation::kTangential;
        return sigma;
    }
    void expectCamera(Device& camera, glm::ivec2 size) {
        LensParameters likely = camera.lens;
        likely[lens::CentreX] = 0.5 * size.x;
        likely[lens::CentreY] = 0.5 * size.y;
        for (const auto i : {lens::K1, lens::K2, lens::K3, lens::P1, lens::P2}) likely[i] = 0;
        expect(
            camera.lens.data(),
            {likely.begin(), likely.end()},
            lensSigma(
                Expectation::kCameraFocalShare, Expectation::kCameraCentreShare * size.x, likely));
        problem_.AddParameterBlock(camera.pose.data(), 6);
    }
    void expectProjector(Device& projector, const Device& expected, glm::ivec2 size) {
        const LensParameters& lens = expected.lens;
        expect(projector.lens.data(),
               {lens.begin(), lens.end()},
               lensSigma(Expectation::kFocalShare, Expectation::kCentreShare * size.x, lens));
        problem_.AddParameterBlock(projector.pose.data(), 6);
        // Of the turn, and of the position: the shift of a pose is in its own frame, so it is held
        // as loosely as the larger of the two moves it.
        std::vector<double> sigma(6, Expectation::kTurnRadians);
        const double arm = glm::length(positionOf(expected.pose));
        for (std::size_t i = 3; i < 6; ++i)
            sigma[i] = Expectation::kPositionMetres + arm * Expectation::kTurnRadians;
        expect(projector.pose.data(), {expected.pose.begin(), expected.pose.end()}, sigma);
    }
    void expectScreen() {
        SmoothField& field = hall_.screen.displacement();
        const glm::ivec2 controls = field.cells() + 3;
        const auto at = [&](int column, int row) {
            return &field.controls()[field.control(column, row)];
        };
        const auto bend = [&](double* before, double* here, double* after) {
            problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<BendCost, 1, 1, 1, 1>(
                                          new BendCost{1 / Expectation::kBendMetres}),
                                      nullptr,
                                      before,
                                      here,
                                      after);
        };
        for (int row = 0; row < controls.y; ++row)
            for (int column = 0; column < controls.x; ++column) {
                problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<FlatCost, 1, 1>(
                                              new FlatCost{1 / Expectation::kDisplacementMetres}),
                                          nullptr,
                                          at(column, row));
                if (column > 0 && column + 1 < controls.x)
                    bend(at(column - 1, row), at(column, row), at(column + 1, row));
                if (row > 0 && row + 1 < controls.y)
                    bend(at(column, row - 1), at(column, row), at(column, row + 1));
            }
    }

    SolvedHall& hall_;
    ceres::Problem problem_;
};

}  // namespace

SolvedHall::SolvedHall(const config::Rig& theRig, const wall::Wall& wall, glm::ivec2 cells)
    : rig{theRig}, nominal{wall}, screen{wall.screen(), cells} {
    for (const config::Channel& channel : rig.channels)
        projectors.push_back({lensOf(channel.projector), poseOf(channel.projector)});
    corrections.resize(projectors.size());
}

std::optional<BumpyScreen::Place> SolvedHall::placeOf(std::size_t channel, glm::dvec2 pixel) const {
    const glm::dvec2 share = pixel / glm::dvec2(rig.channels[channel].sizePixels);
    const Device& projector = projectors[channel];
    return screen.hit(
        solve::rayOf(projector.lens, projector.pose, pixel - corrections[channel].at(share)));
}

std::optional<BumpyScreen::Place> SolvedHall::placeSeen(std::size_t camera,
                                                        glm::dvec2 pixel) const {
    return screen.hit(solve::rayOf(cameras[camera].lens, cameras[camera].pose, pixel));
}

std::optional<glm::dvec2> SolvedHall::modelled(const Tie& tie) const {
    const auto place = placeSeen(tie.camera, tie.seen);
    if (!place) return std::nullopt;
    const Device& projector = projectors[tie.channel];
    const Three<double> point{place->point.x, place->point.y, place->point.z};
    if (inFrame(projector.pose.data(), point)[2] <= 0) return std::nullopt;
    const Two<double> pixel = pixelOf(projector.lens.data(), projector.pose.data(), point);
    return glm::dvec2(pixel[0], pixel[1]);
}

glm::dvec2 SolvedHall::panoramaPixel(glm::dvec3 point) const {
    const glm::dvec3 eye = rig.sweetSpotMetres;
    constexpr double kBeyondMetres = 1.0;
    const auto there = nominal.screen().hit({eye, point - eye}, kBeyondMetres);
    return nominal.screen().unrolled(there.value_or(point)) * glm::dvec2(rig.panoramaPixels);
}

namespace {

// A tie of a camera with a point of the hall as the rig says it.
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
        if (valueOf(seen[2]) < 0.01) {
            residual[0] = residual[1] = T(100.0) - seen[2];
            return true;
        }
        const Two<T> place = imaged(lens, Two<T>{seen[0] / seen[2], seen[1] / seen[2]});
        residual[0] = (place[0] - sighting.seen.x) * weight;
        residual[1] = (place[1] - sighting.seen.y) * weight;
        return true;
    }
};

// The camera that sees the hall of the rig best, and how badly: the mean loss of a sighting.
struct Sighted {
    Device camera;
    double loss = 0;
};

Device cameraBefore(const std::vector<Sighting>& sightings,
                    const wall::ScreenSurface& screen,
                    glm::ivec2 size,
                    double focal) {
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
    const glm::dvec3 up =
        std::abs(normal.y) > 0.9 ? glm::dvec3(0, 0, normal.y > 0 ? -1 : 1) : glm::dvec3(0, 1, 0);
    const glm::dmat3 wallFromOwn(glm::transpose(glm::dmat3(glm::lookAt(position, middle, up))));
    Device camera;
    camera.lens[lens::Focal] = focal;
    camera.lens[lens::Aspect] = 1;
    camera.lens[lens::CentreX] = 0.5 * size.x;
    camera.lens[lens::CentreY] = 0.5 * size.y;
    camera.pose = poseOf(position, wallFromOwn);
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

Sighted bestSighted(const std::vector<Tie>& ties,
                    std::uint32_t camera,
                    const wall::Wall& wall,
                    glm::ivec2 size,
                    const std::vector<std::size_t>& order) {
    const std::vector<Sighting> sightings = sightingsOf(ties, camera, wall, order);
    constexpr std::size_t kLeast = 30;
    if (sightings.size() < kLeast)
        throw Error("camera " + std::to_string(camera) +
                    " sees too little of the wall: place it where it sees the whole screen");
    Sighted best{.camera = {}, .loss = 1e30};
    for (const double focal : {0.55, 0.8, 1.2}) {
        const Sighted now =
            sighted(cameraBefore(sightings, wall.screen(), size, focal * size.x), sightings, size);
        if (now.loss < best.loss) best = now;
    }
    return best;
}

// Two channels whose places the cables have exchanged, where that explains the view far better.
std::optional<std::pair<std::size_t, std::size_t>> swappedPair(const std::vector<Tie>& ties,
                                                               const wall::Wall& wall,
                                                               const config::Rig& rig,
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
            const double now = bestSighted(ties, 0, wall, size, order).loss;
            std::swap(order[i], order[j]);
            if (now >= least) continue;
            least = now;
            found = {i, j};
        }
    return found;
}

// A cell of the displacement for each so many metres of the screen.
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

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}
double rootMeanSquare(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

// How far apart two channels show what a camera sees at one place: held-out windows alone.
std::vector<double> overlapErrors(const SolvedHall& hall, const std::vector<Tie>& ties) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<const Tie*>> windows;
    for (const Tie& tie : ties)
        if (tie.heldOut) windows[{tie.camera, tie.window}].push_back(&tie);
    std::vector<double> errors;
    for (const auto& [key, seen] : windows)
        for (std::size_t i = 0; i < seen.size(); ++i)
            for (std::size_t j = i + 1; j < seen.size(); ++j) {
                const auto a = hall.placeOf(seen[i]->channel, seen[i]->place);
                const auto b = hall.placeOf(seen[j]->channel, seen[j]->place);
                if (!a || !b) continue;
                errors.push_back(
                    glm::distance(hall.panoramaPixel(a->point), hall.panoramaPixel(b->point)));
            }
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

struct Round {
    Stage stage;
    double outlineReach;  // of the picture's width
    double outlineSigma, tieSigma;
    int steps;
};

void run(SolvedHall& hall,
         const Round& round,
         const std::vector<Device>& expected,
         const std::vector<Tie>& ties,
         const std::vector<scan::CameraView>& views,
         SolveFigures& figures) {
    std::vector<glm::ivec2> sizes;
    for (const scan::CameraView& view : views) sizes.push_back(view.sizePixels);
    Joint joint(hall, expected, sizes);
    for (const Tie& tie : ties)
        if (!tie.heldOut) joint.add(tie, round.tieSigma);
    const std::vector<OutlineTie> outline = outlinesOf(hall, views, round.outlineReach);
    for (const OutlineTie& tie : outline) joint.add(tie, round.outlineSigma);
    joint.solve(round.stage, round.steps);
    figures.outlinePoints = outline.size();
    std::vector<double> off;
    for (const OutlineTie& tie : outline) {
        const Device& camera = hall.cameras[tie.camera];
        const glm::dvec3 point = hall.screen.at(tie.unrolled).point;
        const Two<double> seen = pixelOf(
            camera.lens.data(), camera.pose.data(), Three<double>{point.x, point.y, point.z});
        off.push_back(glm::dot(glm::dvec2(seen[0], seen[1]) - tie.seen, tie.across));
    }
    figures.outlineRms = rootMeanSquare(off);
}

}  // namespace

Solved solveHall(const config::Rig& rig,
                 const wall::Wall& wall,
                 const std::vector<scan::CameraView>& views,
                 const std::function<void(const std::string&)>& progress) {
    constexpr std::size_t kMostWindows = 2500;
    Solved solved{.hall = std::make_unique<SolvedHall>(rig, wall, cellsFor(wall.screen())),
                  .ties = {},
                  .figures = {},
                  .faults = {}};
    SolvedHall& hall = *solved.hall;
    for (std::uint32_t i = 0; i < views.size(); ++i) {
        const std::vector<Tie> ties = tiesOf(views[i], i, kMostWindows);
        solved.ties.insert(solved.ties.end(), ties.begin(), ties.end());
    }
    progress("finding the camera");
    std::vector<std::size_t> order(rig.channels.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::uint32_t i = 0; i < views.size(); ++i) {
        const Sighted camera = bestSighted(solved.ties, i, wall, views[i].sizePixels, order);
        hall.cameras.push_back(camera.camera);
        if (i > 0) continue;
        if (const auto swapped =
                swappedPair(solved.ties, wall, rig, views[i].sizePixels, camera.loss)) {
            solved.faults.push_back(
                {"swapped_outputs",
                 fmt::format("channel \"{}\" is seen where \"{}\" hangs: exchange their cables",
                             rig.channels[swapped->first].name,
                             rig.channels[swapped->second].name)});
            return solved;
        }
    }
    progress("fitting projectors, camera and screen");
    const std::vector<Device> expected = hall.projectors;
    for (const Round& round :
         {Round{Stage::Poses, 0.04, 8, 4, 25},
          Round{Stage::Lenses, 0.015, 2, 1, 20},
          Round{Stage::Bumps, 0.006, 0.7, 0.3, 20},
          Round{Stage::Bumps, 0.003, Expectation::kOutlinePixels, Expectation::kPlacePixels, 15}})
        run(hall, round, expected, solved.ties, views, solved.figures);
    progress("what is left of the lenses");
    solved.figures.fitRms = fitRms(hall, solved.ties);
    correct(hall, solved.ties);
    const std::vector<double> errors = overlapErrors(hall, solved.ties);
    solved.figures.overlapPoints = errors.size();
    solved.figures.overlapRms = rootMeanSquare(errors);
    solved.figures.overlapP95 = quantile(errors, 0.95);
    solved.figures.overlapMax = quantile(errors, 1);
    return solved;
}

}  // namespace aquarama::solve
