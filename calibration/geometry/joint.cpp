// SPDX-License-Identifier: Apache-2.0
#include "calibration/geometry/joint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <thread>
#include <tuple>
#include <utility>

#include <Eigen/Sparse>
#include <ceres/ceres.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace aquarama::geometry {

namespace {

// The value of a dual number, without its derivatives.
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

template <class T>
glm::dvec3 vectorOf(const Three<T>& v) {
    return {valueOf(v[0]), valueOf(v[1]), valueOf(v[2])};
}

// Blocks of parameters and the residual behind them, as Ceres passes them.
template <class T, std::size_t kBlocks>
struct Arguments {
    std::array<const T*, kBlocks> blocks;
    T* residual;
};
template <class T, std::size_t kBlocks, class... Pointers>
Arguments<T, kBlocks> parted(Pointers*... pointers) {
    static_assert(sizeof...(pointers) == kBlocks + 1);
    const std::array<const T*, kBlocks + 1> all{pointers...};
    Arguments<T, kBlocks> arguments{{}, std::get<kBlocks>(std::tuple(pointers...))};
    std::copy_n(all.begin(), kBlocks, arguments.blocks.begin());
    return arguments;
}
template <class T>
std::array<T, 16> controlsFrom(const T* const* blocks) {
    std::array<T, 16> controls;
    for (std::size_t i = 0; i < 16; ++i) controls[i] = *blocks[i];
    return controls;
}

// A cost whose last blocks are the sixteen controls of a cell.
template <class Cost, int kResiduals, int... kBlocks>
using WithControls = ceres::AutoDiffCostFunction<Cost,
                                                 kResiduals,
                                                 kBlocks...,
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
                                                 1>;

// The displacement of the screen by the sixteen controls of one cell; it continues a little beyond
// the cell.
class CellDisplacement {
  public:
    CellDisplacement(glm::ivec2 cells, glm::ivec2 index) : cells_{cells}, index_{index} {}
    [[nodiscard]] glm::dvec2 within(glm::dvec2 place) const { return place * cells_ - index_; }
    // Place and controls have one type, or the place is a number and the controls are dual numbers.
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

// The same together with its controls, as a displacement for BumpyScreen.
struct HeldDisplacement {
    CellDisplacement cell;
    std::array<double, 16> controls;
    [[nodiscard]] double at(glm::dvec2 place) const { return cell.sum(place, controls); }
};

// The residual of a tie: the distance between its measured place and that of the model, in pixels
// of the channel. The point on the screen is found in double; its derivatives are those of the
// tangent plane there.
class TieCost {
  public:
    TieCost(const BumpyScreen& screen, const Tie& tie, CellDisplacement cell, double sigma)
        : screen_{screen}, tie_{tie}, cell_{cell}, weight_{1 / sigma} {}

    // Blocks: lens and pose of the camera, lens and pose of the projector, controls, residual.
    template <class T, class... Rest>
    bool operator()(const T* cameraLens, Rest*... rest) const {
        const auto [blocks, residual] = parted<T, 19>(rest...);
        const std::array<T, 16> controls = controlsFrom<T>(&blocks[3]);
        const Tangent tangent = tangentOf(valuesOf(cameraLens), tie_.seen);
        const RayOf<T> ray = rayOf(cameraLens, blocks[0], tie_.seen, tangent);
        const auto point = met(ray, controls);
        if (!point) return farOff(residual);
        const Three<T> seen = inFrame(blocks[2], *point);
        if (valueOf(seen[2]) < kNearest) return farOff(residual);
        const Two<T> place = imaged(blocks[1], Two<T>{seen[0] / seen[2], seen[1] / seen[2]});
        residual[0] = (place[0] - tie_.place.x) * weight_;
        residual[1] = (place[1] - tie_.place.y) * weight_;
        return true;
    }

  private:
    static constexpr double kNearest = 0.01;  // metres before a lens

    // An error as large as a picture is wide; the robust loss gives it little weight.
    template <class T>
    static bool farOff(T* residual) {
        residual[0] = residual[1] = T(1000.0);
        return true;
    }

    // Where a ray meets the screen.
    template <class T>
    [[nodiscard]] std::optional<Three<T>> met(const RayOf<T>& ray,
                                              const std::array<T, 16>& controls) const {
        HeldDisplacement held{cell_, {}};
        for (std::size_t i = 0; i < 16; ++i) held.controls[i] = valueOf(controls[i]);
        const auto hit = screen_.hit({vectorOf(ray.origin), vectorOf(ray.direction)}, held);
        if (!hit) return std::nullopt;
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
        return point;
    }

    const BumpyScreen& screen_;
    Tie tie_;
    CellDisplacement cell_;
    double weight_;
};

// The residual of a tie of the outline: pixels of the camera, across the outline.
class OutlineCost {
  public:
    OutlineCost(const OutlineTie& tie, CellDisplacement cell, double sigma)
        : tie_{tie}, cell_{cell}, weight_{1 / sigma} {}

    // Blocks: lens and pose of the camera, controls, residual.
    template <class T, class... Rest>
    bool operator()(const T* lens, Rest*... rest) const {
        const auto [blocks, residual] = parted<T, 17>(rest...);
        const T* pose = blocks[0];
        const std::array<T, 16> controls = controlsFrom<T>(&blocks[1]);
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

// The residual that keeps one value of a block near an expected value.
struct NearCost {
    std::size_t index;
    double expected, sigma;
    template <class T>
    bool operator()(T const* const* parameters, T* residual) const {
        residual[0] = (parameters[0][index] - expected) / sigma;
        return true;
    }
};

// The residual that keeps the displacement from bending between neighbouring controls.
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

// Standard deviations of values from those of the rig and of usual lenses. They only decide what
// the pictures leave open. Values that are far off have little weight (Cauchy's loss).
struct Expectation {
    static constexpr double kPositionMetres = 0.08;
    static constexpr double kTurnRadians = 0.04;
    static constexpr double kFocalShare = 0.02;
    static constexpr double kAspect = 0.004;
    static constexpr double kCentreShare = 0.03;  // of a projector's picture: lens shift
    static constexpr double kCameraCentreShare = 0.005;
    static constexpr double kCameraFocalShare = 0.5;
    // Of the distance from the axis of the picture's farthest corner: r^2, r^4, r^6 of Brown's
    // model.
    static constexpr glm::dvec3 kRadial{0.008, 0.004, 0.002};
    static constexpr glm::dvec3 kCameraRadial{0.03, 0.01, 0.003};
    static constexpr double kTangential = 0.0005;
    static constexpr double kDisplacementMetres = 0.03;
    static constexpr double kBendMetres = 0.015;  // between neighbouring controls
};

std::vector<int> heldLensParameters(FreeParts stage, bool isCamera) {
    if (stage == FreeParts::Poses) {
        std::vector<int> held{lens::Aspect, lens::K1, lens::K2, lens::K3, lens::P1, lens::P2};
        if (isCamera) held.insert(held.end(), {lens::CentreX, lens::CentreY});
        return held;
    }
    if (isCamera) return {lens::Aspect};
    return stage == FreeParts::Lenses ? std::vector<int>{lens::K3} : std::vector<int>{};
}

}  // namespace

// The implementation, with one problem of Ceres.
class JointProblem::Problem {
  public:
    Problem(SolvedHall& hall,
            const std::vector<Device>& expected,
            const std::vector<glm::ivec2>& cameraSizes)
        : hall_{hall} {
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
        auto* cost = new WithControls<TieCost, 2, lens::Count, 6, lens::Count, 6>(
            new TieCost(hall_.screen, tie, cell, sigma));
        problem_.AddResidualBlock(cost, new ceres::CauchyLoss(2.0), blocks);
    }
    void add(const OutlineTie& tie, double sigma) {
        Device& camera = hall_.cameras[tie.camera];
        std::vector<double*> blocks{camera.lens.data(), camera.pose.data()};
        addControls(blocks, tie.unrolled);
        auto* cost = new WithControls<OutlineCost, 1, lens::Count, 6>(
            new OutlineCost(tie, cellAt(tie.unrolled), sigma));
        problem_.AddResidualBlock(cost, new ceres::CauchyLoss(2.0), blocks);
    }

    void solve(FreeParts stage, int steps) {
        for (Device& camera : hall_.cameras) hold(camera, heldLensParameters(stage, true));
        for (Device& projector : hall_.projectors)
            hold(projector, heldLensParameters(stage, false));
        if (stage != FreeParts::Bumps)
            for (double& control : hall_.screen.displacement().controls())
                problem_.SetParameterBlockConstant(&control);
        ceres::Solver::Options options;
        options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
        options.max_num_iterations = steps;
        // Tight, since the last steps find what the pictures hardly show, such as the distance of a
        // camera from a flat wall.
        options.function_tolerance = 1e-7;
        options.num_threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
        options.logging_type = ceres::SILENT;
        ceres::Solver::Summary summary;
        ceres::Solve(options, &problem_, &summary);
    }

    [[nodiscard]] std::vector<double> uncertainty(std::size_t camera,
                                                  const std::vector<glm::dvec2>& seen) {
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> normal(normalMatrix());
        std::vector<double> sigma;
        for (const glm::dvec2 pixel : seen) {
            const Eigen::MatrixX2d slope = slopeOf(camera, pixel);
            const Eigen::Matrix2d variance = slope.transpose() * normal.solve(slope);
            sigma.push_back(std::sqrt(std::max(0.0, variance.trace())));
        }
        return sigma;
    }

  private:
    // Of all free parameters, in the order of freeBlocks().
    Eigen::SparseMatrix<double> normalMatrix() {
        ceres::Problem::EvaluateOptions options;
        options.parameter_blocks = freeBlocks();
        ceres::CRSMatrix rows;
        problem_.Evaluate(options, nullptr, nullptr, nullptr, &rows);
        const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> jacobian(
            rows.num_rows,
            rows.num_cols,
            static_cast<Eigen::Index>(rows.values.size()),
            rows.rows.data(),
            rows.cols.data(),
            rows.values.data());
        return jacobian.transpose() * jacobian;
    }
    std::vector<double*> freeBlocks() {
        std::vector<double*> blocks;
        for (std::vector<Device>* devices : {&hall_.cameras, &hall_.projectors})
            for (Device& device : *devices) {
                blocks.push_back(device.lens.data());
                blocks.push_back(device.pose.data());
            }
        for (double& control : hall_.screen.displacement().controls()) blocks.push_back(&control);
        return blocks;
    }
    // The derivative of the panorama place of a camera pixel by the free parameters, by
    // differences. Only the parameters of the camera and the controls near the place move it.
    Eigen::MatrixX2d slopeOf(std::size_t camera, glm::dvec2 seen) {
        Eigen::MatrixX2d slope = Eigen::MatrixX2d::Zero(freeCount(), 2);
        const auto here = hall_.placeSeen(camera, seen);
        if (!here) return slope;
        const glm::dvec2 at = hall_.panoramaPixel(here->point);
        std::vector<double*> moving{hall_.cameras[camera].lens.data(),
                                    hall_.cameras[camera].pose.data()};
        addControls(moving, here->unrolled);
        Eigen::Index row = 0;
        for (double* block : freeBlocks()) {
            const int size = problem_.ParameterBlockTangentSize(block);
            if (std::ranges::find(moving, block) != moving.end())
                for (int i = 0; i < size; ++i) {
                    const glm::dvec2 moved = movedBy(block, i, camera, seen, at);
                    slope.row(row + i) << moved.x, moved.y;
                }
            row += size;
        }
        return slope;
    }
    glm::dvec2 movedBy(double* block, int i, std::size_t camera, glm::dvec2 seen, glm::dvec2 at) {
        const int size = problem_.ParameterBlockSize(block);
        // In a lens only the aspect may be fixed.
        const bool isHeld = problem_.ParameterBlockTangentSize(block) < size;
        double& value = block[isHeld && i >= int{lens::Aspect} ? i + 1 : i];
        const double kept = value, step = 1e-5 * std::max(1.0, std::abs(value));
        value += step;
        const auto moved = hall_.placeSeen(camera, seen);
        value = kept;
        return moved ? (hall_.panoramaPixel(moved->point) - at) / step : glm::dvec2(0);
    }
    Eigen::Index freeCount() {
        Eigen::Index count = 0;
        for (double* block : freeBlocks()) count += problem_.ParameterBlockTangentSize(block);
        return count;
    }
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
    void expect(double* block,
                const std::vector<double>& expected,
                const std::vector<double>& sigma) {
        for (std::size_t i = 0; i < expected.size(); ++i) {
            auto* cost = new ceres::DynamicAutoDiffCostFunction<NearCost, 4>(
                new NearCost{i, expected[i], sigma[i]});
            cost->AddParameterBlock(static_cast<int>(expected.size()));
            cost->SetNumResiduals(1);
            problem_.AddResidualBlock(cost, new ceres::CauchyLoss(3.0), block);
        }
    }
    // Shares of the focal length and of the picture's width, and of the distance of its farthest
    // corner from the axis.
    struct LensSpread {
        double focal, centre;
        glm::dvec3 radial;
    };
    static std::vector<double> lensSigma(const LensSpread& spread,
                                         const LensParameters& lens,
                                         glm::ivec2 size) {
        const glm::dvec2 centre(lens[lens::CentreX], lens[lens::CentreY]);
        const glm::dvec2 farthest = glm::max(centre, glm::dvec2(size) - centre);
        const double corner = glm::length(farthest) / lens[lens::Focal];
        std::vector<double> sigma(lens::Count);
        sigma[lens::Focal] = spread.focal * lens[lens::Focal];
        sigma[lens::Aspect] = Expectation::kAspect;
        sigma[lens::CentreX] = sigma[lens::CentreY] = spread.centre * size.x;
        sigma[lens::K1] = spread.radial.x / std::pow(corner, 2);
        sigma[lens::K2] = spread.radial.y / std::pow(corner, 4);
        sigma[lens::K3] = spread.radial.z / std::pow(corner, 6);
        sigma[lens::P1] = sigma[lens::P2] = Expectation::kTangential / corner;
        return sigma;
    }
    void expectCamera(Device& camera, glm::ivec2 size) {
        LensParameters likely = camera.lens;
        likely[lens::CentreX] = 0.5 * size.x;
        likely[lens::CentreY] = 0.5 * size.y;
        for (const auto i : {lens::K1, lens::K2, lens::K3, lens::P1, lens::P2}) likely[i] = 0;
        expect(camera.lens.data(),
               {likely.begin(), likely.end()},
               lensSigma({Expectation::kCameraFocalShare,
                          Expectation::kCameraCentreShare,
                          Expectation::kCameraRadial},
                         likely,
                         size));
        problem_.AddParameterBlock(camera.pose.data(), 6);
    }
    void expectProjector(Device& projector, const Device& expected, glm::ivec2 size) {
        const LensParameters& lens = expected.lens;
        expect(
            projector.lens.data(),
            {lens.begin(), lens.end()},
            lensSigma({Expectation::kFocalShare, Expectation::kCentreShare, Expectation::kRadial},
                      lens,
                      size));
        problem_.AddParameterBlock(projector.pose.data(), 6);
        // The shift of a pose is in its own frame, so that turning the projector changes it too:
        // its standard deviation is the larger effect of turn and position.
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

JointProblem::JointProblem(SolvedHall& hall,
                           const std::vector<Device>& expected,
                           const std::vector<glm::ivec2>& cameraSizes)
    : problem_{std::make_unique<Problem>(hall, expected, cameraSizes)} {}

JointProblem::~JointProblem() = default;

void JointProblem::add(const Tie& tie, double sigma) {
    problem_->add(tie, sigma);
}
void JointProblem::add(const OutlineTie& tie, double sigma) {
    problem_->add(tie, sigma);
}
void JointProblem::solve(FreeParts stage, int mostSteps) {
    problem_->solve(stage, mostSteps);
}
std::vector<double> JointProblem::uncertainty(std::size_t camera,
                                              const std::vector<glm::dvec2>& seen) {
    return problem_->uncertainty(camera, seen);
}

}  // namespace aquarama::geometry
