// SPDX-License-Identifier: Apache-2.0
#include "common/base/log.h"

#include <spdlog/spdlog.h>

namespace aquarama {

void writeInfo(const std::string& line) {
    spdlog::info(line);
}

void writeWarning(const std::string& line) {
    spdlog::warn(line);
}

void writeError(const std::string& line) {
    spdlog::error(line);
}

}  // namespace aquarama
