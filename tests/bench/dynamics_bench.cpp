// SPDX-License-Identifier: Apache-2.0
// What one biomechanical fish costs: the paper's Table 1, "Dynamics"; and the solver in it against
// kept ones.
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <benchmark/benchmark.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "capture/dynamics.h"
#include "capture/swimmer.h"
#include "common/base/units.h"
#include "common/config/species.h"

namespace aquarama::bench {
namespace {

// A scad in its stride, so that muscles pull and water pushes.
struct SwimmingScad {
    capture::Swimmer swimmer{
        config::readSpecies(AQUARAMA_SOURCE_DIR "/config/species/bigeye_scad.txtpb")};

    SwimmingScad() {
        const config::Species species =
            config::readSpecies(AQUARAMA_SOURCE_DIR "/config/species/bigeye_scad.txtpb");
        swimmer.give({.controller = capture::Controller::ForwardSwim, .gait = species.swim.medium});
        swimmer.advance(static_cast<int>(std::lround(2 / swimmer.stepSeconds())));
    }
};

void dynamicsStep(benchmark::State& run) {
    SwimmingScad scad;
    for (auto _ : run) scad.swimmer.advance(1);
}
BENCHMARK(dynamicsStep)->Name("dynamics_step");

// One frame of a 60 Hz display: 8 steps for each of the fish's own seconds in one of ours.
void dynamicsTick(benchmark::State& run) {
    SwimmingScad scad;
    const auto steps =
        static_cast<int>(std::lround(1 / (kTicksPerSecond * scad.swimmer.stepSeconds())));
    for (auto _ : run) scad.swimmer.advance(steps);
    run.counters["steps"] = steps;
}
BENCHMARK(dynamicsTick)->Name("dynamics_tick");

// The system of one step, with the pattern of the fish: each unit joins two nodes by a 3 x 3 block.
struct Joint {
    int first, second;
    glm::dmat3 block;
};

std::vector<Joint> joints() {
    std::vector<Joint> joints;
    for (const capture::Unit& unit : capture::anatomy().units) {
        const glm::dvec3 u = glm::normalize(
            glm::dvec3(std::sin(unit.first), std::cos(unit.second), std::sin(unit.second)));
        joints.push_back({unit.first, unit.second, glm::outerProduct(u, u) + glm::dmat3(0.1)});
    }
    return joints;
}

void solveByEnvelope(benchmark::State& run) {
    capture::EnvelopeSystem assembled;
    for (int node = 0; node < body::kNodalPoints; ++node) {
        assembled.addToDiagonal(node, 1);
        assembled.addToRightSide(node, {1, 2, 3});
    }
    for (const Joint& joint : joints()) {
        assembled.addDiagonalBlock(joint.first, joint.block);
        assembled.addDiagonalBlock(joint.second, joint.block);
        assembled.addOffDiagonalBlock(joint.first, joint.second, -joint.block);
    }
    for (auto _ : run) {
        capture::EnvelopeSystem system = assembled;
        system.solve();
        benchmark::DoNotOptimize(system.solution(0));
    }
}
BENCHMARK(solveByEnvelope)->Name("solve/envelope");

using SparseMatrix = Eigen::SparseMatrix<double>;
constexpr int kUnknowns = 3 * body::kNodalPoints;

SparseMatrix assembledByEigen() {
    std::vector<Eigen::Triplet<double>> elements;
    const auto add = [&](int row, int column, const glm::dmat3& block) {
        for (int p = 0; p < 3; ++p)
            for (int q = 0; q < 3; ++q)
                elements.emplace_back(3 * row + p, 3 * column + q, block[p][q]);
    };
    for (int node = 0; node < body::kNodalPoints; ++node) add(node, node, glm::dmat3(1));
    for (const Joint& joint : joints()) {
        add(joint.first, joint.first, joint.block);
        add(joint.second, joint.second, joint.block);
        add(joint.first, joint.second, -joint.block);
        add(joint.second, joint.first, -joint.block);
    }
    SparseMatrix matrix(kUnknowns, kUnknowns);
    matrix.setFromTriplets(elements.begin(), elements.end());
    return matrix;
}

// As a user of a kept sparse solver would: the pattern is analysed once, only the values change.
template <class Ordering>
void solveByEigen(benchmark::State& run) {
    const SparseMatrix matrix = assembledByEigen();
    Eigen::VectorXd right(kUnknowns);
    for (int node = 0; node < body::kNodalPoints; ++node)
        right.segment<3>(Eigen::Index{3} * node) = Eigen::Vector3d(1, 2, 3);
    Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Ordering> solver;
    solver.analyzePattern(matrix);
    Eigen::VectorXd solution;
    for (auto _ : run) {
        solver.factorize(matrix);
        solution = solver.solve(right);
        benchmark::DoNotOptimize(solution.data());
    }
}
BENCHMARK(solveByEigen<Eigen::AMDOrdering<int>>)->Name("solve/eigen_simplicial_amd");
BENCHMARK(solveByEigen<Eigen::NaturalOrdering<int>>)->Name("solve/eigen_simplicial_natural");

void solveByDenseEigen(benchmark::State& run) {
    const Eigen::Matrix<double, kUnknowns, kUnknowns> matrix = assembledByEigen();
    const Eigen::VectorXd right = Eigen::VectorXd::Ones(kUnknowns);
    for (auto _ : run) {
        Eigen::VectorXd solution = matrix.llt().solve(right);
        benchmark::DoNotOptimize(solution.data());
    }
}
BENCHMARK(solveByDenseEigen)->Name("solve/eigen_dense");

}  // namespace
}  // namespace aquarama::bench
