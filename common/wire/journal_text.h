// SPDX-License-Identifier: Apache-2.0
// What operators are told of the journal of a show and of its standby, in words.
#pragma once

#include <string>

#include "common/wire/messages.h"

namespace aquarama::wire {

// "written, newest save 3 s old, file 12 MB, folder 140 MB, disk 80 GB free"; with another
// separator than the comma.
[[nodiscard]] std::string journalText(const v1::JournalStatus& journal,
                                      const std::string& separator = ", ");
// What somebody has to look after; empty where nothing is wrong.
[[nodiscard]] std::string journalProblem(const v1::JournalStatus& journal);
// "the world goes on from 0:00:15, away for 2 s"; empty for a new world.
[[nodiscard]] std::string wentOnText(const v1::JournalStatus& journal);

// "main is the master (for 3 min); spare simulates along".
[[nodiscard]] std::string standbyText(const v1::StandbyStatus& standby);
// What somebody has to look after; empty where the other machine would take over.
[[nodiscard]] std::string standbyProblem(const v1::StandbyStatus& standby);

}  // namespace aquarama::wire
