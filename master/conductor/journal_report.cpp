// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/journal_report.h"

#include <algorithm>
#include <chrono>

#include "common/base/characters.h"

namespace aquarama::conductor {

namespace {

// A disk that has not answered for so long stands still.
constexpr net::Duration kLongestAnswer = std::chrono::seconds(3);

}  // namespace

JournalReport::JournalReport(v1::JournalStatus::Condition condition, const std::string& reason) {
    status_.set_condition(condition);
    if (!reason.empty()) status_.set_reason(legible(reason, wire::kMostReasonBytes));
}

void JournalReport::saved(net::Moment now) {
    const std::lock_guard lock(mutex_);
    savedAt_ = now;
}

void JournalReport::measured(const JournalSizes& sizes) {
    const std::lock_guard lock(mutex_);
    status_.set_file_bytes(sizes.file);
    status_.set_folder_bytes(sizes.folder);
    status_.set_free_disk_bytes(sizes.free);
}

void JournalReport::paused(const std::string& reason) {
    const std::string told = legible(reason, wire::kMostReasonBytes);
    const std::lock_guard lock(mutex_);
    status_.set_condition(v1::JournalStatus::PAUSED);
    status_.set_reason(told);
    status_.set_pauses(status_.pauses() + 1);
}

void JournalReport::goesOn() {
    const std::lock_guard lock(mutex_);
    status_.set_condition(v1::JournalStatus::WRITTEN);
    status_.clear_reason();
}

void JournalReport::inputWasLate(bool isFirst) {
    ++lateInputs_;
    if (isFirst) ++lateSpells_;
}

void JournalReport::wentOn(Tick tick, double awaySeconds) {
    const std::lock_guard lock(mutex_);
    status_.set_went_on_tick(tick.value);
    status_.set_away_s(awaySeconds);
}

v1::JournalStatus JournalReport::status(net::Moment now) const {
    v1::JournalStatus status;
    std::optional<net::Moment> savedAt;
    {
        const std::lock_guard lock(mutex_);
        status = status_;
        savedAt = savedAt_;
    }
    if (savedAt) status.set_save_age_s(net::secondsIn(std::max(now - *savedAt, net::Duration{})));
    status.set_late_inputs(lateInputs_);
    status.set_late_spells(lateSpells_);
    const net::Moment askedAt = askedAt_;
    const bool isWaiting = askedAt != net::Moment{} && now - askedAt > kLongestAnswer;
    if (isWaiting && status.condition() == v1::JournalStatus::WRITTEN) {
        status.set_condition(v1::JournalStatus::WAITING);
        status.set_reason("it stands still");
    }
    return status;
}

}  // namespace aquarama::conductor
