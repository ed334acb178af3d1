// SPDX-License-Identifier: Apache-2.0
// A passphrase of whoever sits at the terminal, or of a file; never of the command line, which
// other users can read.
#pragma once

#include <string>

namespace aquarama::cli {

// Whether a passphrase is thought up, and so asked twice, or must be the one of before.
enum class PassphraseUse : bool { New, Known };

// The first line of `file` ("-": standard input). Empty: asks at the terminal, without echo. Throws
// Error where there is neither, where both answers differ, and after Ctrl-C.
[[nodiscard]] std::string readPassphrase(const std::string& file, PassphraseUse use);

}  // namespace aquarama::cli
