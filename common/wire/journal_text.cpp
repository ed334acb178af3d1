// SPDX-License-Identifier: Apache-2.0
#include "common/wire/journal_text.h"

#include <spdlog/fmt/fmt.h>

#include "common/base/amounts.h"

namespace aquarama::wire {

namespace {

const char* nameOf(v1::JournalStatus::Condition condition) {
    switch (condition) {
        case v1::JournalStatus::WRITTEN:
            return "written";
        case v1::JournalStatus::WAITING:
            return "waits for its disk";
        case v1::JournalStatus::PAUSED:
            return "paused";
        default:
            return "none";
    }
}

}  // namespace

std::string journalText(const v1::JournalStatus& journal, const std::string& separator) {
    std::string text = nameOf(journal.condition());
    if (!journal.reason().empty()) text += ": " + journal.reason();
    const auto add = [&](bool isTold, const std::string& what) {
        if (isTold) text += separator + what;
    };
    add(journal.has_save_age_s(), "newest save " + durationOf(journal.save_age_s()) + " old");
    add(journal.has_folder_bytes(), "file " + sizeOf(journal.file_bytes()));
    add(journal.has_folder_bytes(), "folder " + sizeOf(journal.folder_bytes()));
    add(journal.has_folder_bytes(), "disk " + sizeOf(journal.free_disk_bytes()) + " free");
    add(journal.pauses() > 0, fmt::format("pauses {}", journal.pauses()));
    add(journal.late_inputs() > 0, fmt::format("late inputs {}", journal.late_inputs()));
    add(journal.has_went_on_tick(), wentOnText(journal));
    return text;
}

std::string journalProblem(const v1::JournalStatus& journal) {
    switch (journal.condition()) {
        case v1::JournalStatus::WAITING:
            return "the journal waits for its disk: " + journal.reason();
        case v1::JournalStatus::PAUSED:
            return "the journal is paused: " + journal.reason();
        case v1::JournalStatus::REFUSED:
            return "no journal is kept: " + journal.reason();
        default:
            return {};
    }
}

std::string standbyText(const v1::StandbyStatus& standby) {
    return standby.master() + " is the master (for " + durationOf(standby.master_s()) + "); " +
           (standby.has_machine() ? standby.machine() + " simulates along"
                                  : "no machine simulates along");
}

std::string standbyProblem(const v1::StandbyStatus& standby) {
    if (standby.has_machine()) return {};
    return "nobody would take over from " + standby.master() +
           ": no machine simulates along; see the log of the other machine";
}

std::string wentOnText(const v1::JournalStatus& journal) {
    if (!journal.has_went_on_tick()) return {};
    return fmt::format("the world goes on from {}, away for {}",
                       timeOf(Tick{journal.went_on_tick()}),
                       durationOf(journal.away_s()));
}

}  // namespace aquarama::wire
