// SPDX-License-Identifier: Apache-2.0
// The species of tests/support/all_species.h with their repertoires, captured once for all tests of
// a program.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "capture/capture_repertoire.h"
#include "common/motion/motor.h"
#include "tests/support/all_species.h"

namespace aquarama::motion {

using test::allSpeciesNames;

inline const Repertoire& repertoireOf(const std::string& name) {
    static std::map<std::string, Repertoire> captured;
    if (!captured.contains(name)) {
        const auto species = std::ranges::find(test::allSpecies(), name, &config::Species::name);
        captured.emplace(name, capture::captureRepertoire(*species, [](double) {}));
    }
    return captured.at(name);
}

inline const MotorTables& tablesOf(const std::string& name) {
    static std::map<std::string, std::shared_ptr<const MotorTables>> made;
    auto& tables = made[name];
    if (!tables) tables = makeMotorTables(repertoireOf(name));
    return *tables;
}

// The same motion, but a speed that goes after the segment's as stated here.
inline std::shared_ptr<const MotorTables> tablesOf(const std::string& name,
                                                   const SpeedResponse& response) {
    Repertoire repertoire = repertoireOf(name);
    repertoire.response = response;
    return makeMotorTables(repertoire);
}

// A claim about each species.
class OfEachSpecies : public testing::TestWithParam<std::string> {
  public:
    static std::string suffix(const testing::TestParamInfo<std::string>& info) {
        return info.param;
    }
};

}  // namespace aquarama::motion
