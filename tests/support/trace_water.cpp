// SPDX-License-Identifier: Apache-2.0
// Traces the table of render_node/water/water_lobes.h and writes its C++. The same seed and number
// of paths give the same table.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>

#include "common/base/log.h"
#include "render_node/water/water_lobes.h"
#include "render_node/water/water_tables.h"
#include "tests/support/water_comparison.h"
#include "tests/support/water_light.h"

namespace {

using namespace aquarama;

struct Options {
    std::uint64_t seed = 1;
    int paths = 30000;
    std::string out = "water_lobes_table.cpp";
    bool compare = false;
};

// The direction of an entry, sun's azimuth and all.
glm::dvec3 directionOf(double rise, double azimuthDegrees, glm::dvec3 sun) {
    const double flat = std::sqrt(std::max(1 - rise * rise, 0.0));
    const glm::dvec3 ahead = glm::normalize(glm::dvec3{sun.x, 0, sun.z});
    const glm::dvec3 aside = glm::cross(ahead, glm::dvec3{0, 1, 0});
    const double around = azimuthDegrees * std::numbers::pi / 180;
    return flat * (std::cos(around) * ahead + std::sin(around) * aside) + glm::dvec3{0, rise, 0};
}

constexpr double kFarthest = 4.0;  // optical

double grown(double loss, double range) {
    return (1 - std::exp(-loss * range)) / loss;
}

// What is scattered by less does not count as scattered: it is light that stays in the picture.
constexpr double kPeakRadians = 4.0 * std::numbers::pi / 180;

// The plain guess at the loss: of what goes straight, less the light that grows as one looks up.
double guessedLoss(double albedo, double rise, double peakShare) {
    const double absorbed = 1 - albedo;
    const double downwelling = std::sqrt(absorbed * absorbed + 0.256 * absorbed * albedo) / 0.9;
    return std::max(1 - peakShare * albedo - downwelling * rise, 0.02);
}

// ln L = ln source + ln((1 - e^(-loss r)) / loss) at three ranges: least squares, drawn a little
// towards the guess where noise would decide.
scene::WaterLobe fitted(const std::vector<double>& ranges,
                        const std::vector<double>& lights,
                        double guess) {
    constexpr double kTrust = 0.002;
    scene::WaterLobe best;
    double least = 1e30;
    for (double loss = 0.02; loss < 3.0; loss += 0.005) {
        double mean = 0;
        double squares = 0;
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            const double ln = std::log(lights[i] / grown(loss, ranges[i]));
            mean += ln;
            squares += ln * ln;
        }
        const auto count = static_cast<double>(ranges.size());
        mean /= count;
        const double error =
            squares / count - mean * mean + kTrust * (loss - guess) * (loss - guess);
        if (error >= least) continue;
        least = error;
        best = {std::exp(mean), loss};
    }
    return best;
}

// One albedo and depth of the table, in the lengths of the light that does not go straight.
struct Water {
    const test::ForwardPhase& phase;
    double albedo, depth;
    [[nodiscard]] double scale() const { return 1 - phase.peakShare() * albedo; }
    [[nodiscard]] double scaledAlbedo() const { return albedo * (1 - phase.peakShare()) / scale(); }
};

scene::WaterLobe traced(const Water& water,
                        double irradiance,
                        glm::dvec3 direction,
                        const Options& options) {
    const glm::dvec3 sun{scene::sunInWater()};
    const double farthest =
        direction.y > 0 ? std::min(water.depth / direction.y, kFarthest) : kFarthest;
    std::vector<double> ranges;
    std::vector<double> lights;
    for (const double share : {0.12, 0.4, 1.0}) {
        ranges.push_back(share * farthest);
        const test::SeenWater seen{water.scaledAlbedo(),
                                   water.depth * water.scale(),
                                   direction,
                                   ranges.back() * water.scale()};
        lights.push_back(
            test::scatteredIn(water.phase, seen, sun, options.paths, options.seed).mean /
            (water.albedo * irradiance * scene::plainLobe(direction, sun)));
    }
    return fitted(ranges, lights, guessedLoss(water.albedo, direction.y, water.phase.peakShare()));
}

void write(const Options& options) {
    const test::ForwardPhase phase{kPeakRadians};
    std::ofstream file(options.out);
    file << "// SPDX-License-Identifier: Apache-2.0\n"
            "// Written by aquarama_trace_water --seed "
         << options.seed << " --paths " << options.paths
         << ": trace it anew, do not edit it.\n"
            "#include \"render_node/water/water_lobes.h\"\n\nnamespace aquarama::scene {\n\n"
            "// clang-format off\n"
            "const std::array<LobeEntry, kLobeEntries> kLobeTable{{\n";
    for (const double albedo : scene::kLobeAlbedos)
        for (const double depth : scene::kLobeDepths) {
            const Water water{phase, albedo, depth};
            const double light = test::irradiance(phase,
                                                  water.scaledAlbedo(),
                                                  depth * water.scale(),
                                                  glm::dvec3{scene::sunInWater()},
                                                  8 * options.paths,
                                                  options.seed)
                                     .mean;
            std::fprintf(stderr, "albedo %.2f depth %.2f irradiance %.4g\n", albedo, depth, light);
            for (const double rise : scene::kLobeRises) {
                scene::WaterLobe lobe;
                for (const double azimuth : scene::kLobeAzimuths) {
                    // Straight up and down there is one direction.
                    if (std::abs(rise) < 1 || azimuth == 0)
                        lobe = traced(water,
                                      light,
                                      directionOf(rise, azimuth, glm::dvec3{scene::sunInWater()}),
                                      options);
                    file << '{' << std::lround(1000 * std::log(lobe.source)) << ','
                         << std::lround(1000 * lobe.loss) << "},";
                }
                file << '\n';
            }
            file.flush();
        }
    file << "}};\n// clang-format on\n\n}  // namespace aquarama::scene\n";
    if (!file) throw Error("cannot write " + options.out + ": is the folder there?");
}

// CIEDE2000 over range and depth, for every type of water.
bool compare(const Options& options) {
    constexpr double kMost = 2.2;  // 2 but for the noise, in the haziest type
    const test::ForwardPhase phase{kPeakRadians};
    bool isWithin = true;
    std::printf("type   mean   95 %%    max of CIEDE2000, table to Monte Carlo\n");
    for (std::size_t i = 0; i < config::kWaterTypeNames.size(); ++i) {
        std::vector<double> off = test::differences(
            phase,
            static_cast<config::WaterType>(i),
            {{2.0, 5.0, 10.0, 20.0}, {2.0, 6.0, 18.0}, options.paths, options.seed + 1000});
        std::ranges::sort(off);
        const double mean =
            std::accumulate(off.begin(), off.end(), 0.0) / static_cast<double>(off.size());
        std::printf("%-4s %6.2f %6.2f %6.2f\n",
                    std::string(config::kWaterTypeNames.at(i)).c_str(),
                    mean,
                    off[off.size() * 95 / 100],
                    off.back());
        std::fflush(stdout);
        isWithin = isWithin && mean <= kMost;
    }
    return isWithin;
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app{"Traces how sea water scatters light and writes the table of its lobes."};
    Options options;
    app.add_option("--seed", options.seed, "of the paths");
    app.add_option("--paths", options.paths, "for each of the 4 000 radiances");
    app.add_option("--out", options.out, "C++ file");
    app.add_flag("--compare", options.compare, "the table that is built in with a new tracing");
    CLI11_PARSE(app, argc, argv);
    if (options.compare) return compare(options) ? 0 : 1;
    write(options);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "aquarama_trace_water: %s\n", error.what());
    return 1;
}
