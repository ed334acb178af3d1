// SPDX-License-Identifier: Apache-2.0
#include "console/waiting_nodes.h"

#include <string_view>

#include "common/base/log.h"
#include "common/config/keys.h"
#include "common/enrol/hand_over.h"

namespace aquarama::console {

std::string assignNode(const Assignment& assignment) {
    try {
        enrol::assignChannel(assignment.rigFile,
                             config::keyFolderOf(assignment.rigFile, assignment.keyFolder),
                             assignment.node,
                             assignment.channel,
                             assignment.code,
                             enrol::dayOfNewKey(unixNow(), assignment.built));
        return {};
    } catch (const Error& problem) {
        return problem.what();
    }
}

NodeSearch::NodeSearch(const config::Rig& rig) {
    if (!config::needsKeys(rig)) return;
    try {
        discovery_ = std::make_unique<enrol::Discovery>();
    } catch (const Error& problem) {
        logWarning("{}", problem.what());
    }
}

std::vector<enrol::FoundNode> NodeSearch::nodes() const {
    return discovery_ ? discovery_->nodes() : std::vector<enrol::FoundNode>{};
}

browser::WaitingNodes listOf(const std::vector<enrol::FoundNode>& nodes, bool isSearched) {
    constexpr std::size_t kSchemeLetters = std::string_view("tcp://").size();
    browser::WaitingNodes list;
    if (isSearched) list.set_searched(true);
    for (const enrol::FoundNode& from : nodes) {
        browser::WaitingNode& node = *list.add_nodes();
        node.set_letter(from.letter);
        node.set_address(from.address.substr(kSchemeLetters));
    }
    return list;
}

}  // namespace aquarama::console
