// SPDX-License-Identifier: Apache-2.0
// The species of tests/support/all_species.h and their repertoires, captured once for all tests.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "capture/capture_repertoire.h"
#include "common/base/log.h"
#include "tests/support/all_species.h"

namespace aquarama::capture {

using test::allSpecies;

// In the order of allSpecies().
inline const std::vector<motion::Repertoire>& allRepertoires() {
    static const auto kAll = [] {
        std::vector<motion::Repertoire> all;
        for (CaptureOutcome& outcome : captureRepertoires(allSpecies(), {})) {
            if (!outcome.repertoire) throw Error(outcome.error);
            all.push_back(*std::move(outcome.repertoire));
        }
        return all;
    }();
    return kAll;
}

// Tests named after their species.
class EachSpecies : public testing::TestWithParam<std::size_t> {
  protected:
    [[nodiscard]] static const config::Species& species() { return allSpecies().at(GetParam()); }
    [[nodiscard]] static const motion::Repertoire& repertoire() {
        return allRepertoires().at(GetParam());
    }
    [[nodiscard]] static const motion::ActionSegment& segment(motion::Action action) {
        return repertoire().segments.at(static_cast<std::size_t>(action));
    }
};
inline std::string nameOfSpecies(const testing::TestParamInfo<std::size_t>& info) {
    return allSpecies().at(info.param).name;
}

}  // namespace aquarama::capture
