// SPDX-License-Identifier: Apache-2.0
#include "console/alerts.h"

#include <algorithm>

namespace aquarama::console {

namespace {

// Whether the fault of this key is there now.
bool hasKey(const std::vector<Fault>& faults, const std::string& key) {
    return std::ranges::find(faults, key, &Fault::key) != faults.end();
}

}  // namespace

// A minute is more than a busy machine leaves between two looks.
void Alerts::follow(UnixSeconds now) {
    constexpr double kLongest = 60;
    const double passed = now - last_.value_or(now);
    last_ = now;
    if (passed >= 0 && passed <= kLongest) return;
    for (auto& [key, since] : pending_) since += passed;
    for (StandingAlert& alert : standing_) alert.since += passed;
}

// What is over ends first, so that a fault that came back is new.
std::vector<std::string> Alerts::update(const std::vector<Fault>& faults,
                                        UnixSeconds now,
                                        bool isQuiet) {
    follow(now);
    std::vector<std::string> lines;
    std::erase_if(pending_, [&](const auto& one) { return !hasKey(faults, one.first); });
    for (StandingAlert& alert : standing_) {
        if (alert.isOver || hasKey(faults, alert.key)) continue;
        alert.isOver = true;
        lines.push_back("over: " + alert.text);
    }
    for (const Fault& fault : faults) {
        const UnixSeconds since = pending_.emplace(fault.key, now).first->second;
        const auto known = std::ranges::find(standing_, fault.key, &StandingAlert::key);
        if (known != standing_.end() && !known->isOver) {
            known->text = fault.text;
            continue;
        }
        if (isQuiet || now - since < fault.lastsSeconds) continue;
        if (known != standing_.end()) standing_.erase(known);
        standing_.push_back({fault.key, fault.text, since, false, false});
        lines.push_back(fault.text);
    }
    std::erase_if(standing_,
                  [](const StandingAlert& one) { return one.isOver && one.isAcknowledged; });
    return lines;
}

// One that is over goes at once; one that lasts stays, without asking again.
bool Alerts::acknowledge(const std::string& key) {
    const auto known = std::ranges::find(standing_, key, &StandingAlert::key);
    if (known == standing_.end()) return false;
    known->isAcknowledged = true;
    std::erase_if(standing_,
                  [](const StandingAlert& one) { return one.isOver && one.isAcknowledged; });
    return true;
}

}  // namespace aquarama::console
