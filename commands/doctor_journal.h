// SPDX-License-Identifier: Apache-2.0
// Checks of `aquarama doctor` of the journal of a show.
#pragma once

#include <filesystem>

#include "commands/findings.h"
#include "common/wire/journal_text.h"

namespace aquarama {

// Whether a journal can be written to a folder for three days, and what the newest of its
// recordings is. Changes nothing.
void lookAtJournal(Findings& findings, const std::filesystem::path& folder);
// That of the running show.
void lookAtJournal(Findings& findings, const v1::JournalStatus& journal);

}  // namespace aquarama
