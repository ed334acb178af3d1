// SPDX-License-Identifier: Apache-2.0
#include "common/school/school_state.h"

#include <cassert>

#include "common/base/digest.h"

namespace aquarama::school {

void SchoolState::resize(std::size_t fish) {
    states.resize(fish);
    commands.resize(fish);
    skins.resize(fish);
}

void SchoolState::records(std::vector<motion::FishRecord>& records) const {
    records.resize(size());
    for (std::size_t fish = 0; fish < size(); ++fish) {
        records[fish] = motion::recordOf(states, fish);
        records[fish].skin = skins[fish];
    }
}

void SchoolState::set(std::size_t fish, const motion::FishRecord& record) {
    motion::setFromRecord(states, fish, record);
    skins[fish] = record.skin;
}

std::uint64_t hashOf(const std::vector<motion::FishRecord>& records,
                     const motion::MotorCommands& commands) {
    assert(commands.action.size() == records.size());
    const auto seen = [](const motion::FishRecord& record) {
        return std::uint64_t{record.skin} << 16U | unsigned{record.mouth} << 8U | record.gaze;
    };
    std::uint64_t hash = folded(motion::hashOf(records), records, seen);
    hash = folded(hash, commands.action);
    hash = folded(hash, commands.phaseRate);
    hash = folded(hash, commands.brake);
    hash = folded(hash, commands.mouth);
    hash = folded(hash, commands.gaze);
    hash = folded(hash, commands.pitch);
    return folded(hash, commands.yawRate);
}

RecordedRates recordedRates(const motion::MotorTables& tables,
                            std::uint32_t first,
                            std::uint32_t last) {
    RecordedRates rates{first, last, {}};
    for (std::size_t action = 0; action < rates.phaseRate.size(); ++action)
        rates.phaseRate[action] =
            motion::recordedPhaseRate(tables, static_cast<motion::Action>(action));
    return rates;
}

}  // namespace aquarama::school
