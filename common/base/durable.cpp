// SPDX-License-Identifier: Apache-2.0
#include "common/base/durable.h"

#include <fcntl.h>
#include <unistd.h>

#include "common/base/log.h"
#include "common/base/output_file.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

// Throws Error, which names `path`, after a failure or where the folder cannot be synchronised.
void finish(const fs::path& path, const std::error_code& failure) {
    if (failure) throw Error(path.string() + ": " + whyNotWritten(failure.value()));
    const int folder = open(path.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool isSynced = folder >= 0 && fsync(folder) == 0;
    const int error = errno;
    if (folder >= 0) close(folder);
    if (!isSynced) throw Error(path.string() + ": " + whyNotWritten(error));
}

}  // namespace

void renameDurably(const fs::path& file, const std::string& name) {
    std::error_code failure;
    fs::rename(file, file.parent_path() / name, failure);
    finish(file, failure);
}

void removeDurably(const fs::path& file) {
    std::error_code failure;
    fs::remove(file, failure);
    finish(file, failure);
}

}  // namespace aquarama
