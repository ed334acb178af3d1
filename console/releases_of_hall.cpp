// SPDX-License-Identifier: Apache-2.0
#include "console/releases_of_hall.h"

#include <nlohmann/json.hpp>

#include "console/json_fields.h"
#include "console/run_aquarama.h"

namespace aquarama::console {

namespace {

using nlohmann::json;

// The version of a release; empty where there is none.
std::string versionIn(const json& object, const char* field) {
    const auto found = object.find(field);
    return found != object.end() && found->is_object() ? textIn(*found, "version") : "";
}

void add(browser::Releases& releases, const json& from) {
    browser::ReleaseMachine& machine = *releases.add_machines();
    machine.set_name(textIn(from, "name"));
    machine.set_runs(versionIn(from, "runs"));
    machine.set_silent_s(numberIn(from, "silent_s"));
    machine.set_problem(textIn(from, "problem"));
}

}  // namespace

browser::Releases releasesIn(const std::string& text) {
    browser::Releases releases;
    const json status = json::parse(text, nullptr, false);
    if (!status.is_object()) {
        releases.set_problem("the depot's answer cannot be read");
        return releases;
    }
    releases.set_phase(textIn(status, "phase"));
    releases.set_stable(versionIn(status, "stable"));
    releases.set_candidate(versionIn(status, "candidate"));
    releases.set_before(versionIn(status, "before"));
    releases.set_reason(textIn(status, "reason"));
    releases.set_waiting_for(textIn(status, "waiting_for"));
    releases.set_ready(status.value("ready", json()) == true);
    const auto machines = status.find("machines");
    if (machines == status.end() || !machines->is_array()) return releases;
    for (const json& machine : *machines)
        if (machine.is_object()) add(releases, machine);
    return releases;
}

browser::Releases releasesOf(const std::string& rigFile) {
    const Said said = runAquarama({"release", "status", rigFile, "--json"}, true);
    if (said.status == 0) return releasesIn(said.text);
    browser::Releases releases;
    releases.set_problem(lastLineOf(said, "no depot of releases answers"));
    return releases;
}

bool isReleaseWord(std::string_view word) {
    return word == "go" || word == "back";
}

std::string changeRelease(const std::string& rigFile, const std::string& word) {
    const Said said = runAquarama({"release", word, rigFile}, true);
    return said.status == 0 ? std::string() : lastLineOf(said, "no depot of releases answers");
}

}  // namespace aquarama::console
