// SPDX-License-Identifier: Apache-2.0
// The measure of graphics cards, tried on software OpenGL.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/base/picture.h"

namespace aquarama::bench {
namespace {

namespace fs = std::filesystem;

struct Ended {
    int status = 0;
    std::string output;
};

Ended run(const std::string& arguments) {
    const std::string command = std::string(std::getenv("AQUARAMA_BIN")) +
                                "/aquarama_gpu_bench --device mesa " + arguments + " 2>&1";
    Ended ended;
    FILE* pipe = popen(command.c_str(), "r");
    std::array<char, 4096> piece{};
    while (std::fgets(piece.data(), piece.size(), pipe) != nullptr) ended.output += piece.data();
    ended.status = WEXITSTATUS(pclose(pipe));
    return ended;
}

// Times have the counter "cpu_ns". Fails at a row of another form.
std::map<std::string, double> figuresOf(const fs::path& csv) {
    std::ifstream file(csv);
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(line, "machine,benchmark,cpu_ns,counter,value");
    std::map<std::string, double> figures;
    while (std::getline(file, line)) {
        const std::size_t quote = line.rfind('"');
        EXPECT_TRUE(line.starts_with('"') && quote > 0) << line;
        std::istringstream rest(line.substr(quote + 2) + ",");
        std::vector<std::string> cells;
        for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
        EXPECT_EQ(cells.size(), 4U) << line;
        if (cells.size() != 4) continue;
        const bool isTime = !cells[1].empty();
        figures[cells[0] + " " + (isTime ? "cpu_ns" : cells[2])] = std::stod(cells[isTime ? 1 : 3]);
    }
    return figures;
}

TEST(GpuBench, withoutACardItSaysSoInALineAndIsSkipped) {
    const Ended ended = run("");
    EXPECT_EQ(ended.status, 77);
    EXPECT_TRUE(ended.output.starts_with("no GPU here: ")) << ended.output;
    EXPECT_EQ(std::ranges::count(ended.output, '\n'), 1) << ended.output;
}

TEST(GpuBench, writesFiguresAndPicturesOfWhatItDrew) {
    const fs::path out = fs::temp_directory_path() / ("aquarama-gpu-" + std::to_string(getpid()));
    const Ended ended = run(
        "--software --only theatre/bait_ball_100000/medium surface/window --out " + out.string());
    ASSERT_EQ(ended.status, 0) << ended.output;
    std::vector<fs::path> tables;
    for (const auto& entry : fs::directory_iterator(out))
        if (entry.path().extension() == ".csv") tables.push_back(entry.path());
    ASSERT_EQ(tables.size(), 1U);
    auto figures = figuresOf(tables.front());
    const std::string wall = "gpu/theatre/bait_ball_100000/medium ";
    EXPECT_GT(figures[wall + "cpu_ns"], 0);
    EXPECT_GT(figures[wall + "frame_p50_ms"], 0);
    EXPECT_GE(figures[wall + "frame_p99_ms"], figures[wall + "frame_p50_ms"]);
    EXPECT_GT(figures[wall + "textures_mib"], 1);
    for (const char* stage : {"fish_sort",
                              "fish_surfaces",
                              "fish_bodies",
                              "fish_blended",
                              "caustics",
                              "shafts",
                              "water",
                              "tone",
                              "warp",
                              "other"})
        EXPECT_TRUE(figures.contains("gpu/theatre/bait_ball_100000/medium/" + std::string(stage) +
                                     " gpu_vertex_ms"))
            << stage;
    EXPECT_EQ(figures["gpu/golden/surface/window within_bounds"], 1);
    const Picture picture = readPng((out / "gpu-theatre-bait_ball_100000-medium.png").string());
    EXPECT_EQ(picture.sizePixels, glm::ivec2(250, 62));
    const std::set<std::uint16_t> codes(picture.rgb.begin(), picture.rgb.end());
    EXPECT_GT(codes.size(), 40U) << "flat";
    fs::remove_all(out);
}

// Rows of counts.csv, by stage and program; the first cell of each is the row's number of calls.
std::map<std::string, std::vector<std::uint64_t>> countsIn(const fs::path& csv) {
    std::ifstream file(csv);
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(line,
              "wall,stage,program,calls,vertices,primitives,fragments,samples,target_samples,"
              "pixel_bytes,computed,bytes");
    std::map<std::string, std::vector<std::uint64_t>> counts;
    while (std::getline(file, line)) {
        std::istringstream rest(line);
        std::string wall;
        std::string stage;
        std::string program;
        std::getline(rest, wall, ',');
        std::getline(rest, stage, ',');
        std::getline(rest, program, ',');
        for (std::string cell; std::getline(rest, cell, ',');)
            counts[stage + ": " + program].push_back(std::stoull(cell));
    }
    return counts;
}

TEST(GpuBench, countsWhatCallsOfAFrameGiveACardToDo) {
    const fs::path out =
        fs::temp_directory_path() / ("aquarama-counts-" + std::to_string(getpid()));
    const Ended ended = run("--software --counts --only desk/reef_1998/low --out " + out.string());
    ASSERT_EQ(ended.status, 0) << ended.output;
    auto counts = countsIn(out / "counts.csv");
    const std::vector<std::uint64_t>& warp = counts["warp: quad.vert project.frag"];
    ASSERT_EQ(warp.size(), 9U);
    constexpr std::uint64_t kPixels = 3 * 480 * 360;  // of the desk
    EXPECT_EQ(warp[0], 3U) << "calls";
    EXPECT_EQ(warp[1], 9U) << "vertices";
    EXPECT_GE(warp[3], kPixels) << "fragments";
    EXPECT_EQ(warp[4], kPixels) << "samples";
    EXPECT_EQ(warp[5], 1U) << "samples of a pixel";
    EXPECT_EQ(warp[6], 4U) << "bytes of a pixel";
    const std::vector<std::uint64_t>& cull = counts["fish sort: fish_cull.comp"];
    ASSERT_EQ(cull.size(), 9U);
    EXPECT_GT(cull[7], 0U);
    EXPECT_EQ(cull[7] % (3 * 64), 0U) << "whole groups, alike on each channel";
    const std::vector<std::uint64_t>& upload = counts["fish records: upload"];
    ASSERT_EQ(upload.size(), 9U);
    EXPECT_GT(upload[8], 0U);
    EXPECT_TRUE(fs::exists(out / "shaders.txt"));
    fs::remove_all(out);
}

}  // namespace
}  // namespace aquarama::bench
