// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "capture/search.h"
#include "common/base/log.h"
#include "tests/support/scad.h"

namespace aquarama::capture {
namespace {

TEST(SpeciesText, changesOneNumberAndNothingElse) {
    const std::string text =
        "name: \"gain: 1 {\"  # gain: 2 }\n"
        "swim { back_gain: 3 slow { gain : 0.5 } fast {\n  gain: 1  # all\n } }\n";
    EXPECT_EQ(withNumber(text, {"swim", "fast", "gain"}, 1.23456),
              "name: \"gain: 1 {\"  # gain: 2 }\n"
              "swim { back_gain: 3 slow { gain : 0.5 } fast {\n  gain: 1.235  # all\n } }\n");
    EXPECT_EQ(withNumber(text, {"swim", "slow", "gain"}, 2),
              "name: \"gain: 1 {\"  # gain: 2 }\n"
              "swim { back_gain: 3 slow { gain : 2 } fast {\n  gain: 1  # all\n } }\n");
}

TEST(SpeciesText, namesAFieldThatIsNotThere) {
    try {
        static_cast<void>(withNumber("swim { slow { } }", {"swim", "slow", "gain"}, 1));
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "the species file has no field swim.slow.gain");
    }
}

TEST(SpeciesText, readsBackAsTheSpeciesThatWasWritten) {
    SearchPoint point = pointOf(test::scad());
    for (double& coordinate : point) coordinate = 0.9 * coordinate + 0.04;
    const config::Species wanted = speciesAt(point, test::scad());
    std::ifstream file(test::kScadFile);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const SearchPoint read = pointOf(config::parseSpecies(withGaitsOf(wanted, text), "written"));
    ASSERT_EQ(read.size(), point.size());
    for (std::size_t i = 0; i < point.size(); ++i) EXPECT_NEAR(read[i], point[i], 1e-3) << i;
}

}  // namespace
}  // namespace aquarama::capture
