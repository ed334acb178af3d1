// SPDX-License-Identifier: Apache-2.0
#include <locale>
#include <sstream>

#include <gtest/gtest.h>

#include "capture/report/take.h"
#include "tests/support/scad.h"

namespace aquarama::report {
namespace {

std::vector<std::vector<std::string>> cellsOf(const std::string& text) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream cells(line);
        rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
    }
    return rows;
}

TEST(Csv, givesBackEveryFloatOfTheTake) {
    const Take take = takeAtTicks(test::scadRepertoire(), motion::Action::ForwardFast, 3);
    const auto rows = cellsOf(csvOf(take));
    ASSERT_EQ(rows.size(), 1 + take.frames.size());
    EXPECT_EQ(rows[0].size(), 1U + 3 * body::kNodalPoints);
    EXPECT_EQ(rows[0][0], "time_s");
    EXPECT_EQ(rows[0][1], "n0_x_m");
    EXPECT_EQ(rows[0].back(), "n22_z_m");
    for (std::size_t f = 0; f < take.frames.size(); ++f) {
        ASSERT_EQ(rows[f + 1].size(), rows[0].size());
        for (std::size_t i = 0; i < body::kNodalPoints; ++i) {
            const glm::dvec3 node = take.frames[f].nodes.at(i);
            EXPECT_EQ(std::stof(rows[f + 1][1 + 3 * i]), static_cast<float>(node.x));
            EXPECT_EQ(std::stof(rows[f + 1][2 + 3 * i]), static_cast<float>(node.y));
            EXPECT_EQ(std::stof(rows[f + 1][3 + 3 * i]), static_cast<float>(node.z));
        }
    }
}

TEST(Csv, isTheSameWhereCommasMakeDecimals) {
    struct Continental : std::numpunct<char> {
        [[nodiscard]] char do_decimal_point() const override { return ','; }
        [[nodiscard]] std::string do_grouping() const override { return "\3"; }
    };
    const Take take = takeAtTicks(test::scadRepertoire(), motion::Action::ForwardFast, 1);
    const std::string here = csvOf(take);
    const std::locale before =
        std::locale::global(std::locale(std::locale::classic(), new Continental));
    const std::string there = csvOf(take);
    std::locale::global(before);
    EXPECT_EQ(here, there);
}

}  // namespace
}  // namespace aquarama::report
