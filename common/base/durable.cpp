// SPDX-License-Identifier: Apache-2.0
#include "common/base/durable.h"

#include <cerrno>

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/vfs.h>
#include <unistd.h>

#include "common/base/log.h"
#include "common/base/output_file.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

// Throws Error, which names `path`, after a failure or where its folder cannot be synchronised.
void finish(const fs::path& path, const std::error_code& failure) {
    if (failure) throw Error(path.string() + ": " + whyNotWritten(failure.value()));
    if (!syncFolder(path.parent_path())) throw Error(path.string() + ": " + whyNotWritten(errno));
}

bool isFat(int file) {
    struct statfs system {};
    return fstatfs(file, &system) == 0 && system.f_type == MSDOS_SUPER_MAGIC;
}

}  // namespace

// On FAT, Linux writes no names when a folder is synchronised, and the length of a renamed file
// only when that file is. So the whole file system is synchronised there.
bool syncFolder(const fs::path& folder) {
    const int file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return false;
    const bool isSynced = (isFat(file) ? syncfs(file) : fsync(file)) == 0;
    const int error = errno;
    close(file);
    errno = error;
    return isSynced;
}

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
