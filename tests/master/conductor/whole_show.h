// SPDX-License-Identifier: Apache-2.0
// The three nodes of a desk, for tests of whole shows.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/support/stage.h"

namespace aquarama::conductor {

inline const std::vector<std::string> kNames = {"left", "middle", "right"};

inline std::vector<std::unique_ptr<test::StageNode>> nodesOf(const test::StageMaster& master,
                                                             test::Journal& journal,
                                                             test::StageNode::Habits habits = {}) {
    std::vector<std::unique_ptr<test::StageNode>> nodes;
    for (const std::string& name : kNames) {
        nodes.push_back(std::make_unique<test::StageNode>(name, master.connect(), journal, habits));
    }
    return nodes;
}

}  // namespace aquarama::conductor
