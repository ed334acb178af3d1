// SPDX-License-Identifier: Apache-2.0
#include "console/touch/port_loan.h"

#include <chrono>
#include <filesystem>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "common/base/log.h"
#include "common/base/output_file.h"
#include "common/config/hours.h"

namespace aquarama::console {

namespace {

// Its lock is the loan; nothing lies in it.
std::filesystem::path folderOf(const std::string& rigFile) {
    return config::consoleFolderOf(rigFile) / "touch";
}

int opened(const std::filesystem::path& folder) {
    return open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

}  // namespace

// A console looks for a moment now and then.
PortLoan::PortLoan(const std::string& rigFile) {
    constexpr int kTries = 5;
    constexpr auto kBetween = std::chrono::milliseconds(20);
    requireWritableFolder(folderOf(rigFile));
    lock_ = opened(folderOf(rigFile));
    for (int i = 0; lock_ >= 0 && i < kTries; ++i) {
        if (flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
        std::this_thread::sleep_for(kBetween);
    }
    if (lock_ >= 0) close(lock_);
    throw Error("another aquarama touch runs for " + rigFile + "; end that first");
}

PortLoan::~PortLoan() {
    close(lock_);
}

bool PortLoan::isAsked(const std::string& rigFile) {
    const int folder = opened(folderOf(rigFile));
    if (folder < 0) return false;
    const bool isAsked = flock(folder, LOCK_SH | LOCK_NB) != 0;
    close(folder);
    return isAsked;
}

}  // namespace aquarama::console
