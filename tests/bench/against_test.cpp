// SPDX-License-Identifier: Apache-2.0
// Figures of two runs beside each other: what is compared, how noise is told, what is refused.
#include "tests/bench/against.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "tests/bench/machine.h"

namespace aquarama::bench {
namespace {

using testing::HasSubstr;

class Against : public testing::Test {
  protected:
    [[nodiscard]] Measurements read(const std::string& machine = "One (R) @ 2 GHz") const {
        return readMeasurements(path(), machine);
    }
    [[nodiscard]] std::string path() const { return folder_.path() / "one.csv"; }
    [[nodiscard]] std::string objection(const std::string& machine = "One (R) @ 2 GHz") const {
        try {
            static_cast<void>(read(machine));
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }

    TemporaryFolder folder_{"against"};
};

TEST_F(Against, readsWhatIsWritten) {
    {
        std::ofstream file(path());
        CsvWriter rows(file, "One (R) @ 2 GHz");
        for (const double time : {100.0, 110.0, 90.0}) {
            rows.time("tick/fish:60", time);
            rows.counter("tick/fish:60", "p99_ms", time / 50);
        }
        rows.time("tick/fish:60_mean", 100);
        rows.time("tick/fish:60_cv", 0.1);
        rows.time("pair<a,b>/x:1", 5);
    }
    const Measurements expected{{"tick/fish:60", {100, 110, 90}},
                                {"tick/fish:60 p99_ms", {2, 2.2, 1.8}},
                                {"pair<a,b>/x:1", {5}}};
    EXPECT_EQ(read(), expected);
}

TEST_F(Against, refusesAnotherMachineByName) {
    {
        std::ofstream file(path());
        CsvWriter(file, "Other").time("tick", 1);
    }
    EXPECT_EQ(objection(),
              path() +
                  ":2: was measured on \"Other\", this machine is \"One (R) @ 2 GHz\"; compare "
                  "runs of one machine");
}

TEST_F(Against, refusesWhatIsNoFileOfMeasurements) {
    EXPECT_THAT(objection(), HasSubstr("cannot be read"));
    std::ofstream(path()) << "name,time\n";
    EXPECT_THAT(objection(), HasSubstr("one.csv:1: this is no file of measurements"));
    std::ofstream(path()) << kCsvHead << "\n\"One (R) @ 2 GHz\",tick,fast,,\n";
    EXPECT_THAT(objection(), HasSubstr("one.csv:2: \"fast\" is no number"));
    std::ofstream(path()) << kCsvHead << "\ntick,1,,\n";
    EXPECT_THAT(objection(), HasSubstr("one.csv:2: this is no row"));
}

TEST_F(Against, comparesMediansAndTellsTheNoiseOfBoth) {
    const auto compared =
        compare({{"a", {100, 90, 110}}, {"b", {4}}, {"gone", {1}}, {"same", {7}}},
                {{"a", {52, 50, 48}}, {"b", {2, 2}}, {"new", {1}}, {"same", {7}}});
    ASSERT_EQ(compared.size(), 2U);
    EXPECT_EQ(compared[0].name, "a");
    EXPECT_EQ(compared[0].before, 100);
    EXPECT_EQ(compared[0].now, 50);
    // Half spreads of 10 % and 4 %.
    EXPECT_NEAR(*compared[0].noise, std::sqrt(0.1 * 0.1 + 0.04 * 0.04), 1e-12);
    EXPECT_EQ(compared[1].name, "b");
    EXPECT_FALSE(compared[1].noise) << "of one repetition it is not known";
    std::ostringstream out;
    print(compared, out);
    EXPECT_THAT(out.str(), HasSubstr("0.500  ±10.8 % a\n"));
    EXPECT_THAT(out.str(), HasSubstr("0.500        ? b\n"));
}

}  // namespace
}  // namespace aquarama::bench
