// SPDX-License-Identifier: Apache-2.0
#include "commands/tour_record.h"

#include <span>

#include <nlohmann/json.hpp>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/config/text_file.h"
#include "common/wire/wanted_show.h"

namespace aquarama {

namespace {

using nlohmann::json;

StepRecord stepIn(const json& kept) {
    return {.seconds = kept.at("seconds").get<double>(),
            .lookedAt = kept.at("looked_at").get<double>(),
            .doneAt = kept.at("done_at").get<double>(),
            .confirmed = kept.at("confirmed").get<std::string>()};
}

TourRecord recordIn(const json& kept) {
    TourRecord record{.backupFolder = kept.at("backup_folder").get<std::string>(),
                      .backupWrittenAt = kept.at("backup_written_at").get<double>()};
    for (const auto& [name, step] : kept.at("steps").items()) record.steps[name] = stepIn(step);
    return record;
}

}  // namespace

// A clock that was put back counts nothing.
void noteLook(StepRecord& step, double now, bool isDone) {
    const double since = step.lookedAt > 0 ? now - step.lookedAt : 0;
    if (step.doneAt == 0 && since > 0 && since <= kLongestWork) step.seconds += since;
    step.lookedAt = now;
    if (!isDone) step.doneAt = 0;
    if (isDone && step.doneAt == 0) step.doneAt = now;
}

std::filesystem::path tourFileOf(const std::string& rigPath) {
    return wire::keptShowOf(rigPath).replace_extension(".tour.json");
}

TourRecord readTour(const std::filesystem::path& file) {
    if (!std::filesystem::exists(file)) return {};
    try {
        return recordIn(json::parse(config::readTextFile(file.string())));
    } catch (const json::exception& problem) {
        throw Error(file.string() + ": cannot be read (" + problem.what() +
                    "); remove it, and the tour begins anew");
    }
}

void keepTour(const std::filesystem::path& file, const TourRecord& record) {
    json steps = json::object();
    for (const auto& [name, step] : record.steps)
        steps[name] = {{"seconds", step.seconds},
                       {"looked_at", step.lookedAt},
                       {"done_at", step.doneAt},
                       {"confirmed", step.confirmed}};
    const json kept{{"steps", steps},
                    {"backup_folder", record.backupFolder},
                    {"backup_written_at", record.backupWrittenAt}};
    const std::string text = kept.dump(2) + '\n';
    writeWhole(file, std::as_bytes(std::span(text)));
}

}  // namespace aquarama
